; Modbus: where its bits and registers are.

; Where the values to write go. Means: plc-link modbus.rs find.
; in: T   out: X data address, r20 the first bit's place in its byte, or the bytes from one register
;   to the next, r23:r22 how many   destroys: r14, r18, r19, r21, r24, r25, Z
find_written:
    rcall said_of_written
    mov r14, r16
    cpi r16, 7
    brsh 1f
    ldi r22, 1
    ldi r23, 0
    rjmp 1f
; Where the values to read are. Means: plc-link modbus.rs find.
; in: T   out: as find_written   destroys: as find_written
find_read:
    clr r14
    movw r30, r28
    ldd r22, Z+4
    ldd r23, Z+3
1:  ldd r24, Z+2
    ldd r25, Z+1
    brtc registers
    ldi r21, 0
1:  inc r21
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcc 1b
    subi r24, lo8(-(1000))
    sbci r25, hi8(-(1000))
    ; The areas are I, Q, M, SM, S, T, C; I is in block 6, and for function 2 in block 0, too.
    cpi r21, 7
    breq 1f
    brsh no_address
    cpi r16, 2
    brne 2f
    cpi r21, 1
    brne 2f
1:  ldi r21, 0
2:  movw r18, r24
    add r18, r22
    adc r19, r23
    ldi r20, 129
    cpi r21, 2
    brlo 1f
    ldi r20, 1
    dec r19
    brmi 2f
1:  cp r18, r20
    cpc r19, r1
    brsh no_address
2:  tst r14
    breq 1f
    cpi r21, 1
    breq 1f
    cpi r21, 2
    breq 1f
    cpi r21, 4
    brne no_address
1:  mov r20, r24
    mov r24, r21
    rcall page_start
    mov r24, r20
    lsr r24
    lsr r24
    lsr r24
    add r30, r24
    mov r26, r30
    ldi r27, 1
    andi r20, 7
    ret

; in: -   ends: the answer is exception 2
no_address:
    rjmp refuse_address

; Means: plc-link modbus.rs find_registers.
; in: r25:r24 number of the first, r23:r22 how many   out: as find_written
; destroys: r18, r19, r21, r24, r25, Z
registers:
    ; Values of timers and counters do not lie side by side.
    movw r30, r24
    subi r30, lo8(6000)
    sbci r31, hi8(6000)
    ldi r18, hi8(2000)
    cpi r30, lo8(2000)
    cpc r31, r18
    brsh 1f
    cpi r22, 33
    brsh too_many
1:  push r22
    push r24
    push r25
    rcall register
    pop r25
    pop r24
    pop r22
    push r22
    push r26
    push r27
    dec r22
    add r24, r22
    adc r25, r1
    rcall register
    pop r31
    pop r30
    pop r22
    mov r24, r22
    dec r24
    mul r24, r20
    movw r18, r0
    clr r1
    add r18, r30
    adc r19, r31
    cp r18, r26
    cpc r19, r27
    brne no_address
    ; HC0 and HC3 are not written.
    tst r14
    breq 1f
    ldi r18, hi8(HC0)
    cpi r26, lo8(HC0)
    cpc r27, r18
    brlo 1f
    cpi r30, lo8(AQW_START)
    cpc r31, r18
    brlo no_address
1:  movw r26, r30
    ldi r23, 0
    ret
; in: -   ends: the answer is exception 3
too_many:
    rjmp refuse_value

; Means: plc-link modbus.rs register.
; in: r25:r24 number   out: X data address, r20 bytes from it to the next
; destroys: r18, r19, r21-r25, Z
register:
    ldi r20, 2
    cpi r16, 4
    brne 1f
    cpi r24, 32
    cpc r25, r1
    brsh no_register
    lsl r24
    subi r24, lo8(-(AIW_START))
    rjmp 5f
1:  cpi r25, hi8(5120)
    brsh 2f
    lsl r24
    rol r25
    movw r22, r24
    ldi r21, 2
    rjmp v_address
2:  subi r24, lo8(6000)
    sbci r25, hi8(6000)
    brcs no_register
    ldi r20, 5
    cp r25, r1
    breq 3f
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcs no_register
    ldi r20, 3
    cp r25, r1
    breq 3f
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcs no_register
    cpi r24, 14
    cpc r25, r1
    brsh no_register
    ldi r20, 2
    lsl r24
    subi r24, lo8(-(AC_START))
5:  ldi r25, hi8(AIW_START)
    movw r26, r24
    ret
3:  mov r22, r24
    rjmp value_address
; in: -   ends: the answer is exception 2
no_register:
    rjmp refuse_address
