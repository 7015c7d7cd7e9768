; Module 5: points of the board beside the process image, and interrupt events. High-speed counters and pulses are not
; here: their instructions are errors at run time.
;
; Events are looked for whenever the program polls: the engine comes to `events` when pins, T32 and T96, or the clock are
; others than at the last poll. Routines are entered as a call enters them; where they return to is bytecode of this module,
; which comes back here. Nothing of this is done by interrupts of the processor.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB source_byte, 1
STUB target_byte, WRITE + 1
STUB abandon, ABANDON

; ---- the image

.equ IMAGE_TOTAL_LEN, IMAGE + 6
.equ IMAGE_INVERTED_INPUTS, IMAGE + 27
.equ IMAGE_INVERTED_OUTPUTS, IMAGE + 28
.equ IMAGE_CONSTANTS_LEN, IMAGE + 34
.equ CRC_LEN, 4

; ---- registers and data memory

.equ DDRB, 0x04
.equ PORTB, 0x05
.equ PIND, 0x09
; IB0 begins at bit 2 of the pins.
.equ INPUTS, 0x3F
.equ OUTPUTS, 6
.equ Q_OFFSET, 0x10
.equ AREA_LEN, 16

; Events, in data memory that programs cannot name.
; The pins of I0.0 to I0.3 in bits 2 to 5, the bits of T32 and T96 in bits 0 and 1, as they were at the last poll.
.equ SEEN, 0x0235
; Instead: RUN begins. Bit 7 alone: looks again, whatever they are.
.equ RUN_BEGINS, 0xFF
.equ LOOK_AGAIN, 7
; The low byte of the clock then.
.equ TICK_SEEN, 0x0236
; What waits: a bit for each event, in the order in which they are served. I0.0 to I0.3 rising, the same falling;
.equ WAITING, 0x0237
; timed interrupts 10 and 11, T32, T96.
.equ WAITING_TIMES, 0x0238
.equ TIMED, 8
.equ T32_T96, 10
.equ ORDERS, 12
; Of each timed interrupt: its period, 0 for none; milliseconds left, 1 to the period; how many wait.
.equ TIMED_STATE, 0x0239
.equ TIMED_END, 0x023F
.equ TIMED_LEN, 3
; SMB34, with the period of 10, as V ranges carry it.
.equ PERIODS, 0x8022
; Most that wait.
.equ TIMED_MAX, 8

; In SMB4: an event came while it was waiting already. ENI is in force.
.equ INPUTS_LOST, 1
.equ TIMES_LOST, 2
.equ ENABLED, 4
.equ STATE_BITS, 1 << INPUTS_LOST | 1 << TIMES_LOST | 1 << ENABLED

; Tokens of the engine.
.equ CALL, 0x5E
.equ POLL, 0x6D
.equ ATCH, 0x6E
.equ DTCH, 0x6F
.equ CEVNT, 0x7C
.equ ENI, 0x7D
; No event has this number in the program's table: DTCH with it ends an interrupt routine.
.equ NO_EVENT, 0xFF

; ---- points

; The inputs as they are now, like IB0, in r18. Changes r19, Z.
inputs:
    ldi r30, lo8(IMAGE_INVERTED_INPUTS)
    ldi r31, hi8(IMAGE_INVERTED_INPUTS)
    lpm r18, Z
    in r19, PIND
    lsr r19
    lsr r19
    eor r18, r19
    andi r18, INPUTS
    ret

; The number of a point in the word at Y. Changes Z.
point:
    movw r30, r28
    lpm r20, Z
    andi r20, 7
    ret

; In the order of their numbers: each pair loads, combines by AND, by OR; the second of a pair inverts.
Ldi:
Ldni:
Ai:
Ani:
Oi:
Oni:
    rcall inputs
    rcall point
1:  subi r20, 1
    brcs 2f
    lsr r18
    rjmp 1b
2:  sbrc r26, 0
    com r18
    andi r18, 1
    mov r19, r26
    lsr r19
    ldi r26, COMBINE
    rjmp operands

AssignImmediate:
    rcall point
    rcall write_point
done:
    DONE

SetImmediate:
ResetImmediate:
    mov r18, r26
    adiw r28, 2
    rcall read_byte
    sbiw r28, 4
    rcall point
    mov r23, r20
    add r23, r22
    brcs 1f
    cpi r23, AREA_LEN * 8 + 1
    brsh 1f
    sbrs r18, 0
    clt
2:  subi r22, 1
    brcs 3f
    rcall write_point
    inc r20
    rjmp 2b
3:  set
    rjmp done
1:  rjmp abandon

; T to output r20 in the process image and, where there is one, to its pin. Keeps r20, r22.
write_point:
    mov r26, r20
    lsr r26
    lsr r26
    lsr r26
    subi r26, -Q_OFFSET
    ldi r27, hi8(DATA_START)
    mov r19, r20
    andi r19, 7
    ldi r18, 1
1:  subi r19, 1
    brcs 2f
    lsl r18
    rjmp 1b
2:  ld r19, X
    or r19, r18
    brts 3f
    eor r19, r18
3:  st X, r19
    cpi r20, OUTPUTS
    brsh 5f
    rcall inverted_outputs
    and r19, r18
    in r21, PORTB
    or r21, r18
    brts 4f
    eor r21, r18
4:  eor r21, r19
    out PORTB, r21
    in r21, DDRB
    or r21, r18
    out DDRB, r21
5:  ret

; Which outputs are inverted, in r19. Changes Z.
inverted_outputs:
    ldi r30, lo8(IMAGE_INVERTED_OUTPUTS)
    ldi r31, hi8(IMAGE_INVERTED_OUTPUTS)
    lpm r19, Z
    ret

; OUT := a byte of I: IB0 by its pins.
Bir:
    rcall source_byte
    cpi r27, hi8(DATA_START)
    brne 1f
    cpi r26, AREA_LEN
    brsh 1f
    ld r22, X
    tst r26
    brne 2f
    rcall inputs
    mov r22, r18
2:  rcall target_byte
    st X, r22
    rjmp done
1:  rjmp abandon

; A byte of Q := IN: QB0 to its pins, too.
Biw:
    rcall read_byte
    rcall target_byte
    cpi r27, hi8(DATA_START)
    brne 1b
    mov r18, r26
    subi r18, Q_OFFSET
    cpi r18, AREA_LEN
    brsh 1b
    st X, r22
    tst r18
    brne 2f
    rcall inverted_outputs
    eor r22, r19
    andi r22, (1 << OUTPUTS) - 1
    out PORTB, r22
    ldi r22, (1 << OUTPUTS) - 1
    out DDRB, r22
2:  rjmp done

; The Uno has no LED for it: L is output Q0.5.
Dled:
    rcall read_byte
    rjmp done

; not yet: Hdef Hsc Pls

; ---- events: instructions

; From the engine: r2 token, r26 the byte behind it, Y behind that. POLL: r18 what is seen now, r19 the clock now.
events:
    mov r20, r2
    cpi r20, POLL
    breq poll
    cpi r20, ENI
    brsh switch
    mov r21, r26
    cpi r20, ATCH
    brne 1f
    movw r30, r28
    lpm r21, Z
    adiw r28, 1
1:  brtc next
    cpi r21, NO_EVENT
    breq end_of_routine
    rjmp change

; ENI, DISI.
switch:
    sbiw r28, 1
    brtc next
    lds r18, ERROR_BITS
    andi r18, lo8(~(1 << ENABLED))
    cpi r20, ENI
    brne 1f
    ori r18, 1 << ENABLED
    ; What waits is served at the next poll.
    lds r19, SEEN
    ori r19, 1 << LOOK_AGAIN
    sts SEEN, r19
1:  sts ERROR_BITS, r18
; Goes on with the instruction at Y.
next:
    ldi r27, hi8(DATA_START)
    movw r30, r28
    lpm r2, Z+
    lpm r26, Z+
    movw r28, r30
    movw r30, r2
    ijmp

; An interrupt routine has come to its end: what it found is put back.
end_of_routine:
    ldi r26, lo8(ACCUMULATORS_END)
    ldi r27, hi8(ACCUMULATORS_END)
1:  pop r18
    st -X, r18
    cpi r26, lo8(ACCUMULATORS)
    brne 1b
    pop r18
    sts ENO, r18
    pop r18
    sts RESULT_BITS, r18
    pop r18
    bst r18, 0
    pop r29
    pop r28
    rjmp serve

poll:
    sbiw r28, 1
    lds r20, SEEN
    cpi r20, RUN_BEGINS
    brne 1f
    rjmp begin
1:  rcall look
; Executes the routine of the first event that waits.
serve:
    lds r20, ERROR_BITS
    sbrs r20, ENABLED
    rjmp next
    lds r18, WAITING
    lds r19, WAITING_TIMES
    clr r21
1:  lsr r19
    ror r18
    brcs 2f
    inc r21
    cpi r21, ORDERS
    brlo 1b
    ; None is left, and what was lost is forgotten.
    andi r20, lo8(~(1 << INPUTS_LOST | 1 << TIMES_LOST))
    sts ERROR_BITS, r20
    rjmp next
2:  rcall timed_state
    brcc 3f
    adiw r26, 2
    ld r18, X
    dec r18
    st X, r18
    brne 4f
3:  rcall forget
4:  rcall attached
    breq serve
    dec r24
    push r28
    push r29
    bld r18, 0
    push r18
    lds r18, RESULT_BITS
    push r18
    lds r18, ENO
    push r18
    ldi r26, lo8(ACCUMULATORS)
    ldi r27, hi8(ACCUMULATORS)
5:  ld r18, X+
    push r18
    cpi r26, lo8(ACCUMULATORS_END)
    brne 5b
    ; It returns to the bytecode behind this call.
    rcall 6f
    .byte DTCH, NO_EVENT
6:  pop r29
    pop r28
    lsl r28
    rol r29
    mov r26, r24
    ldi r27, hi8(DATA_START)
    ldi r18, CALL
    mov r2, r18
    set
    movw r30, r2
    ijmp

; RUN begins: nothing waits, nothing is attached, interrupts are disabled.
begin:
    sts SEEN, r18
    sts TICK_SEEN, r19
    ldi r26, lo8(WAITING)
    ldi r27, hi8(WAITING)
1:  st X+, r1
    cpi r26, lo8(TIMED_END)
    brne 1b
    lds r18, ERROR_BITS
    andi r18, lo8(~STATE_BITS)
    sts ERROR_BITS, r18
    rcall tables
    movw r26, r22
2:  subi r20, 1
    brcs 3f
    st X+, r1
    rjmp 2b
3:  rjmp next

; ATCH, DTCH, CEVNT by r20; r21 the event's place in the program's table, r26 the routine of ATCH.
change:
    mov r18, r26
    mov r19, r20
    rcall tables
    movw r30, r24
    add r30, r21
    adc r31, r1
    add r22, r21
    adc r23, r1
    movw r26, r22
    lpm r22, Z
    cpi r19, CEVNT
    breq 2f
    inc r18
    cpi r19, ATCH
    breq 1f
    clr r18
1:  st X, r18
    ; Its place in the order.
2:  clr r21
3:  rcall event_of
    cp r24, r22
    breq 4f
    inc r21
    cpi r21, ORDERS
    brlo 3b
    ; Nothing on this board causes it.
    rjmp next
4:  cpi r19, ATCH
    breq 6f
    rcall timed_state
    brcc 5f
    cpi r19, DTCH
    brne 7f
    st X, r1
7:  adiw r26, 2
    st X, r1
5:  rcall forget
    rjmp next
    ; A timed interrupt takes its period.
6:  rcall timed_state
    brcc 8f
    movw r22, r26
    rcall period
    movw r26, r22
    st X+, r18
    st X, r18
8:  rjmp next

; ---- events: what has occurred

; Enters what has occurred since the last poll: r20 what was seen then, r18 what is seen now, r19 the clock now. Keeps T.
look:
    sts SEEN, r18
    mov r23, r18
    eor r23, r20
    mov r22, r23
    and r22, r18
    andi r22, 0x03
    ; T32 and T96 rising.
    lsl r22
    lsl r22
    push r22
    rcall edges
    pop r23
    lds r20, TICK_SEEN
    sts TICK_SEEN, r19
    sub r19, r20
    breq 1f
    rcall pass
1:  mov r18, r22
    or r18, r23
    breq 3f
    rcall without_detached
    ; Of those that wait already one is lost.
    lds r18, ERROR_BITS
    lds r19, WAITING
    mov r20, r19
    and r20, r22
    breq 2f
    ori r18, 1 << INPUTS_LOST
2:  or r19, r22
    sts WAITING, r19
    lds r19, WAITING_TIMES
    mov r20, r19
    and r20, r23
    andi r20, 0x0C
    breq 4f
    ori r18, 1 << TIMES_LOST
4:  or r19, r23
    sts WAITING_TIMES, r19
    sts ERROR_BITS, r18
3:  ret

; The inputs that changed are in bits 2 to 5 of r23, all pins in r18: rising edges in bits 0 to 3 of r22, falling ones above.
edges:
    ldi r30, lo8(IMAGE_INVERTED_INPUTS)
    ldi r31, hi8(IMAGE_INVERTED_INPUTS)
    lpm r22, Z
    lsr r23
    lsr r23
    andi r23, 0x0F
    lsr r18
    lsr r18
    eor r22, r18
    and r22, r23
    eor r23, r22
    swap r23
    or r22, r23
    ret

; r19 milliseconds pass: the timed interrupts that occur, into bits 0 and 1 of r23. Keeps r22.
pass:
    ldi r26, lo8(TIMED_STATE)
    ldi r27, hi8(TIMED_STATE)
    ldi r21, 1
1:  ld r20, X+
    ld r24, X
    tst r20
    breq 4f
    clr r25
    sub r24, r19
    sbc r25, r1
2:  cp r1, r24
    cpc r1, r25
    brlt 3f
    add r24, r20
    adc r25, r1
    or r23, r21
    adiw r26, 1
    ld r18, X
    inc r18
    cpi r18, TIMED_MAX + 1
    brlo 5f
    ; Too many wait.
    lds r18, ERROR_BITS
    ori r18, 1 << TIMES_LOST
    sts ERROR_BITS, r18
    ldi r18, TIMED_MAX
5:  st X, r18
    sbiw r26, 1
    rjmp 2b
3:  st X, r24
4:  adiw r26, 2
    lsl r21
    sbrs r21, 2
    rjmp 1b
    ret

; Of the events that r22 and r23 have a bit for, those that a routine is attached to.
without_detached:
    push r16
    push r17
    push r22
    push r23
    movw r16, r22
    clr r21
1:  lsr r17
    ror r16
    brcc 2f
    rcall attached
    brne 2f
    rcall mask
    pop r23
    pop r22
    com r18
    com r19
    and r22, r18
    and r23, r19
    push r22
    push r23
2:  inc r21
    cpi r21, ORDERS
    brlo 1b
    pop r23
    pop r22
    pop r17
    pop r16
    ret

; ---- events: in their order

; The event in place r21 of the order, in r24.
event_of:
    mov r24, r21
    cpi r21, TIMED
    brsh 1f
    lsl r24
    sbrc r24, 3
    subi r24, 7
    ret
1:  subi r24, -(10 - TIMED)
    cpi r21, T32_T96
    brlo 2f
    subi r24, -(21 - 10 - (T32_T96 - TIMED))
2:  ret

; The bit of place r21 in r18 and r19.
mask:
    ldi r18, 1
    clr r19
    mov r0, r21
1:  tst r0
    breq 2f
    dec r0
    lsl r18
    rol r19
    rjmp 1b
2:  ret

; The event in place r21 does not wait. Keeps X.
forget:
    rcall mask
    com r18
    com r19
    lds r0, WAITING
    and r0, r18
    sts WAITING, r0
    lds r0, WAITING_TIMES
    and r0, r19
    sts WAITING_TIMES, r0
    ret

; Carry: place r21 is that of a timed interrupt, whose state is at X.
timed_state:
    ldi r26, lo8(TIMED_STATE)
    sbrc r21, 0
    ldi r26, lo8(TIMED_STATE + TIMED_LEN)
    ldi r27, hi8(TIMED_STATE)
    cpi r21, TIMED
    brlo 1f
    cpi r21, T32_T96
    ret
1:  clc
    ret

; The routine that is attached to the event in place r21, counted from 1, in r24; Z: none. Keeps r18, r19, r21.
attached:
    rcall event_of
    mov r27, r24
    rcall tables
    movw r30, r24
    mov r24, r27
    movw r26, r22
1:  subi r20, 1
    brcs 2f
    lpm r0, Z+
    cp r0, r24
    breq 3f
    adiw r26, 1
    rjmp 1b
2:  clr r24
    rjmp 4f
3:  ld r24, X
4:  tst r24
    ret

; ---- events: tables of the image

; The address of the table of events in flash in r24 and r25, of their bytes in data memory in r22 and r23, their number in
; r20. Keeps r18, r19, r21, X.
tables:
    ldi r30, lo8(IMAGE_TOTAL_LEN)
    ldi r31, hi8(IMAGE_TOTAL_LEN)
    lpm r24, Z+
    lpm r25, Z+
    lpm r22, Z+
    lpm r23, Z+
    sub r24, r22
    sbc r25, r23
    lpm r22, Z+
    lpm r23, Z
    ; Before the code stand constants and initial values.
    ldi r30, lo8(IMAGE_CONSTANTS_LEN)
    lpm r0, Z+
    sub r24, r0
    lpm r0, Z+
    sbc r25, r0
    lpm r0, Z+
    sub r24, r0
    lpm r0, Z+
    sbc r25, r0
    adiw r30, 1
    lpm r20, Z
    sub r24, r20
    sbc r25, r1
    sub r22, r20
    sbc r23, r1
    subi r24, lo8(-(IMAGE - CRC_LEN))
    sbci r25, hi8(-(IMAGE - CRC_LEN))
    subi r22, lo8(-(ARENA_START))
    sbci r23, hi8(-(ARENA_START))
    ret

; The period of the timed interrupt in place r21, SMB34 or SMB35, in r18; 0 when the program does not have it. Keeps r22, r23.
period:
    ldi r30, lo8(IMAGE_NAME_LEN)
    ldi r31, hi8(IMAGE_NAME_LEN)
    lpm r24, Z
    ldi r30, lo8(IMAGE_MODULES_LEN)
    lpm r18, Z+
    lpm r19, Z
    add r18, r24
    adc r19, r1
    ldi r30, lo8(IMAGE_V_RANGES)
    lpm r20, Z+
    lpm r0, Z
    movw r30, r18
    subi r30, lo8(-(IMAGE + IMAGE_HEADER_LEN))
    sbci r31, hi8(-(IMAGE + IMAGE_HEADER_LEN))
    andi r21, 1
    ldi r26, lo8(ARENA_START)
    ldi r27, hi8(ARENA_START)
1:  subi r20, 1
    brcc 2f
    tst r0
    breq 4f
    dec r0
2:  ldi r24, lo8(PERIODS)
    ldi r25, hi8(PERIODS)
    add r24, r21
    adc r25, r1
    lpm r18, Z+
    lpm r19, Z+
    sub r24, r18
    sbc r25, r19
    lpm r18, Z+
    lpm r19, Z+
    cp r24, r18
    cpc r25, r19
    brlo 3f
    add r26, r18
    adc r27, r19
    rjmp 1b
3:  add r26, r24
    adc r27, r25
    ld r18, X
    ret
4:  clr r18
    ret
