; Module 7: references, the operands of all other modules, and how a comparison ends. No instruction of its own.
;
; One entry; r26 says what is asked for (interface.inc). A direct reference was checked by the loader. A pointer is resolved
; through the tables of the image, and so is the room behind an address.

.include "interface.inc"

; In r0, the access: the room is asked for by the address in X instead of by the pointer at X.
.equ BY_ADDRESS, 0x80
.equ ACCESS_LEN, 0x07

.macro EACH instruction, registers:vararg
    .irp register, \registers
    \instruction \register
    .endr
.endm

entry:
    sbrc r26, 7
    rjmp ending
    mov r0, r26
    movw r30, r28
    adiw r28, 2
    lpm r26, Z+
    lpm r27, Z
    sbrc r27, 7
    rjmp not_direct
    ; Flash can change under a running program until the self-test has seen it: no operand may lead outside.
    mov r30, r27
    subi r30, hi8(DATA_START)
    cpi r30, hi8(DATA_END - DATA_START)
    brsh bad
    sbrs r0, 6
    rjmp 1f
    mov r30, r0
    ori r30, BY_ADDRESS
    mov r0, r30
    rjmp resolve
1:  sbrs r0, 3
    ret

; The value at X.
load:
    sbrc r0, 2
    rjmp 1f
    clr r23
    sbrc r0, 1
    ld r23, X+
    ld r22, X
    rjmp extend
    ; High-speed counters are counted by interrupts.
1:  in r30, SREG
    cli
    ld r25, X+
    ld r24, X+
    ld r23, X+
    ld r22, X
    out SREG, r30
    ret

not_direct:
    sbrc r27, 6
    rjmp constant
    andi r27, 0x07
; The pointer at X: all that it leads to is checked here. By address: only the room is found.
resolve:
    EACH push, r18, r19, r20, r21, r22, r23, r24, r25
    rcall place
    brcs 1f
    ; Enough room for one value, which never is without room for 255.
    mov r24, r0
    andi r24, ACCESS_LEN
    cp r30, r24
    cpc r31, r1
1:  EACH pop, r25, r24, r23, r22, r21, r20, r19, r18
    brcs bad
    sbrs r0, 3
    ret
    rjmp load

room_at:
    ldi r26, BY_ADDRESS + ROOM
    mov r0, r26
    movw r26, r24
    rjmp resolve

; What cannot be done. Behind the caller, whose address is on the stack.
bad:
    sbrc r0, 5
    rjmp fault
    pop r0
    pop r0
; Boxes have power flow, and may use T for something else meanwhile.
abandon:
    set
    lds r24, ERROR_BITS
    ori r24, 1 << RUN_TIME_ERROR
    sts ERROR_BITS, r24
    sts ENO, r1
done:
    jmp MODULE_DONE
fault:
    ldi r24, FAULT_POINTER
    jmp MODULE_FAULT

; A constant, in the reference or in the pool.
constant:
    sbrc r27, 5
    rjmp pool
    andi r27, 0x1F
    sbrc r27, 4
    ori r27, 0xE0
    movw r22, r26
    sbrs r0, 1
    sbrc r0, 2
    rjmp extend
    clr r23
; A word with its sign.
extend:
    clr r24
    sbrc r23, 7
    com r24
    mov r25, r24
    ret
pool:
    andi r27, 0x1F
    subi r27, hi8(-(IMAGE))
    movw r30, r26
    sbrs r0, 3
    ret
    sbrc r0, 2
    rjmp 1f
    clr r23
    sbrc r0, 1
    lpm r23, Z+
    lpm r22, Z
    rjmp extend
1:  lpm r25, Z+
    lpm r24, Z+
    lpm r23, Z+
    lpm r22, Z
    ret

; Address X and room Z behind the pointer at X; carry: it leads nowhere. By address: the room there.
place:
    sbrs r0, 7
    rjmp pointer
    movw r22, r26
    cpi r27, hi8(ARENA_START)
    brlo page_room
    brne far_walk
    cpi r26, lo8(ARENA_START)
    brsh far_walk
    ; Accumulators and high-speed counters are double words; analog values follow one another.
    ldi r30, lo8(ANALOG_OUTPUTS + ANALOG_OUTPUTS_LEN)
    cpi r26, lo8(ANALOG_OUTPUTS)
    brsh to_end
    cpi r26, lo8(ACCUMULATORS)
    brsh 1f
    ldi r30, ANALOG_INPUTS_LEN
    cpi r26, ANALOG_INPUTS_LEN
    brlo to_end
    lsl r30
    rjmp to_end
1:  mov r30, r26
    ori r30, 3
    inc r30
; The room from X to r30, low bytes of addresses.
to_end:
    sub r30, r26
    clr r31
    ret

; The area that X is in ends at a multiple of its length: 16 for I and Q, 64 for L, 32 for the others.
page_room:
    mov r30, r26
    ori r30, 0x0F
    cpi r26, 0x20
    brlo 1f
    ori r30, 0x1F
    cpi r26, 0xC0
    brlo 1f
    ori r30, 0x3F
1:  sub r30, r26
    inc r30
    clr r31
    ret

; What has no place here goes to a place in the arena: V, SM behind the bit page, timers, counters.
pointer:
    ld r25, X+
    ld r24, X+
    ld r23, X+
    ld r22, X
    tst r24
    brne nowhere
    sbrc r23, 7
    rjmp nowhere
    cpi r25, 8
    brlo in_page
    breq far_walk
    cpi r25, 11
    brsh nowhere
    ; Timers and counters: the offset is twice the number, which is looked for behind all V bytes.
    sbrs r0, 1
    rjmp nowhere
    lsr r23
    ror r22
    brcs nowhere
    tst r23
    brne nowhere
    mov r23, r25
    ori r23, 0xF0
far_walk:
    rjmp walk

analog:
    cpi r25, 4
    breq nowhere
    sbrc r0, 1
    sbrc r22, 0
    rjmp nowhere
    ; Inputs can be read, outputs written.
    ldi r26, lo8(ANALOG_INPUTS)
    ldi r24, ANALOG_INPUTS_LEN
    mov r30, r0
    sbrs r25, 0
    rjmp 1f
    ldi r26, lo8(ANALOG_OUTPUTS)
    ldi r24, ANALOG_OUTPUTS_LEN
    com r30
1:  sbrc r30, 4
    rjmp nowhere
    cp r22, r24
    cpc r23, r1
    brsh nowhere
    mov r30, r26
    add r30, r24
    add r26, r22
    ldi r27, hi8(ANALOG_INPUTS)
    rjmp to_end

in_page:
    ldi r24, 16
    swap r25
    cpi r25, 0x20
    brlo 1f
    swap r25
    cpi r25, 5
    brlo analog
    ldi r24, 32
    cp r22, r24
    cpc r23, r1
    brlo 2f
    ; Only SM goes on behind its bytes in the page.
    ori r23, 0x80
    cpi r25, 6
    breq far_walk
nowhere:
    sec
    ret
2:  subi r25, 4
    swap r25
    lsl r25
1:  cp r22, r24
    cpc r23, r1
    brsh nowhere
    mov r26, r25
    add r26, r22
    ldi r27, hi8(DATA_START)
    ; Inputs and SMB0 to SMB29 are only read.
    sbrs r0, 4
    rjmp page_room
    cpi r26, 0x10
    brlo nowhere
    subi r26, 0x40
    cpi r26, 30
    brlo nowhere
    subi r26, -0x40
    rjmp page_room

; The place in the arena of the V byte r22 and r23 (from 0x8000 on: SM), of timer r22 (r23 = 0xF9) or counter (0xFA); by
; address: the room there.
walk:
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
    lpm r21, Z
    movw r30, r18
    subi r30, lo8(-(IMAGE + IMAGE_HEADER_LEN))
    sbci r31, hi8(-(IMAGE + IMAGE_HEADER_LEN))
    ldi r26, lo8(ARENA_START)
    ldi r27, hi8(ARENA_START)
1:  subi r20, 1
    sbci r21, 0
    brcs 3f
    lpm r18, Z+
    lpm r19, Z+
    ; Counted from the range's first byte or, by address, from its address.
    sbrc r0, 7
    movw r18, r26
    movw r24, r22
    sub r24, r18
    sbc r25, r19
    brcs not_there
    ; Its address if it is in this range; and where the memory of the range ends, that of the next one begins.
    add r24, r26
    adc r25, r27
    lpm r26, Z+
    lpm r27, Z+
    subi r26, lo8(-(ARENA_START))
    sbci r27, hi8(-(ARENA_START))
    cp r24, r26
    cpc r25, r27
    brsh 1b
    movw r30, r26
    movw r26, r24
    sub r30, r26
    sbc r31, r27
    ret
3:  sbrc r0, 7
    rjmp by_address
    ; Then the timers have entries of 2 bytes, the counters of 1.
    cpi r23, 0xF9
    brlo not_there
    brne 5f
    clr r23
5:  ldi r18, 2
    ldi r19, TIMER_SLOT_LEN
    ldi r20, lo8(IMAGE_TIMERS)
6:  movw r24, r30
    mov r30, r20
    ldi r31, hi8(IMAGE)
    lpm r20, Z+
    lpm r21, Z
    movw r30, r24
7:  subi r20, 1
    sbci r21, 0
    brcs 8f
    lpm r24, Z
    cp r24, r22
    cpc r1, r23
    breq one_word
    add r30, r18
    adc r31, r1
    add r26, r19
    adc r27, r1
    rjmp 7b
8:  tst r23
    breq not_there
    clr r23
    ldi r18, 1
    ldi r19, COUNTER_SLOT_LEN
    ldi r20, lo8(IMAGE_COUNTERS)
    rjmp 6b
by_address:
    movw r26, r22
one_word:
    ldi r30, 2
    clr r31
    clc
    ret
not_there:
    sec
    ret

; ---- how comparisons end

ending:
    sbrc r26, 4
    rjmp room_at
    sbrc r26, 3
    rjmp abandon
    sbrc r26, 2
    rjmp combine
    mov r27, r26
    andi r27, 0x03
    sbiw r28, 5
    movw r30, r28
    lpm r0, Z
    ; A bit for each relation that holds, in their order.
    ldi r30, 0x31
    cp r18, r22
    cpc r19, r23
    cpc r20, r24
    cpc r21, r25
    breq 1f
    ldi r30, 0x16
    brlt 1f
    ldi r30, 0x2A
1:  dec r0
    brmi 2f
    lsr r30
    rjmp 1b
2:  mov r18, r30
    mov r19, r27
combine:
    dec r19
    brmi 4f
    breq 3f
    sbrc r18, 0
    set
    rjmp done
3:  sbrs r18, 0
    clt
    rjmp done
4:  lsl r16
    bld r16, 0
    bst r18, 0
    rjmp done
