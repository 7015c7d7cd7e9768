; Module 5: points of the board beside the process image, and interrupt events.
;
; Events are looked for whenever the program polls: the engine comes to `events` when pins, T32 and
; T96, or the clock are others than at the last poll. Routines are entered as a call enters them;
; where they return to is bytecode of this module, which comes back here. Nothing of this is done by
; interrupts of the processor.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB source_byte, 1
STUB target_byte, WRITE + 1
STUB abandon, ABANDON

; ---- registers and data memory

.equ PORTB, 0x05
; IB0 begins at bit 2 of the pins.
.equ INPUTS, 0x3F
.equ OUTPUTS, 6
.equ Q_OFFSET, 0x10
.equ AREA_LEN, 16

; ---- points

; The inputs as they are now, like IB0: those that are forced with their values.
; in: -   out: r18   destroys: r19, Z
inputs:
    ldi r30, lo8(IMAGE_INVERTED_INPUTS)
    ldi r31, hi8(IMAGE_INVERTED_INPUTS)
    lpm r18, Z
    in r19, PIND
    lsr r19
    lsr r19
    eor r18, r19
    andi r18, INPUTS
    ; Forced bits become 0, then their values.
    lds r19, FORCED_INPUTS
    or r18, r19
    eor r18, r19
    lds r19, FORCED_INPUTS + 1
    or r18, r19
    ret

; in: Y at a word   out: r20 the number of its point, 0 to 7   destroys: Z
point:
    movw r30, r28
    lpm r20, Z
    andi r20, 7
    ret

; Contacts of an input as it is now: each pair loads, combines by AND, by OR; the second of a pair
; inverts. Means: plc-vm modules/points.rs input.
; in: BIT   ends: as COMBINE
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

; Means: plc-vm modules/points.rs points.
; in: BIT   ends: BIT := power flow
AssignImmediate:
    rcall point
    rcall write_point
; in: -   ends: with nothing more
done:
    DONE

; Means: plc-vm modules/mod.rs write_bits.
; in: BIT, N   ends: with N outputs from BIT on 1 or 0
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

; An output: its bit in the process image and, where there is one and the output is not forced, its
; pin. The pin of a forced one is left as the scan before left it.
; in: r20 number, T value   out: r20 as it was   destroys: r18, r19, r21, X, Z
write_point:
    mov r26, r20
    lsr r26
    lsr r26
    lsr r26
    subi r26, -Q_OFFSET
    ldi r27, hi8(DATA_START)
    mov r19, r20
    andi r19, 7
    BIT_MASK r18, r19
    ld r19, X
    or r19, r18
    brts 3f
    eor r19, r18
3:  st X, r19
    cpi r20, OUTPUTS
    brsh 5f
    lds r19, FORCED_OUTPUTS
    and r19, r18
    brne 5f
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

; in: -   out: r19 which outputs are inverted   destroys: Z
inverted_outputs:
    ldi r30, lo8(IMAGE_INVERTED_OUTPUTS)
    ldi r31, hi8(IMAGE_INVERTED_OUTPUTS)
    lpm r19, Z
    ret

; A byte of I, IB0 by its pins. Means: plc-vm modules/points.rs points.
; in: IN, OUT   ends: OUT := the byte
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

; A byte to Q, QB0 to its pins, too. Means: plc-vm modules/points.rs points.
; in: IN, OUT   ends: OUT := IN
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
    lds r19, FORCED_OUTPUTS
    or r22, r19
    eor r22, r19
    lds r19, FORCED_OUTPUTS + 1
    or r22, r19
    rcall inverted_outputs
    eor r22, r19
    andi r22, (1 << OUTPUTS) - 1
    out PORTB, r22
    ldi r22, (1 << OUTPUTS) - 1
    out DDRB, r22
2:  rjmp done

; The Uno has no LED for it: L is output Q0.5. Means: plc-vm modules/hardware.rs hardware.
; in: IN   ends: with IN read
Dled:
    rcall read_byte
    rjmp done

.include "events.inc"
.include "event_sources.inc"
.include "event_queues.inc"
.include "special.inc"
