; Module 6: intervals and the time of day. They do what plc-vm does (plc/vm/src/modules: points.rs,
; clock.rs).

.include "interface.inc"

OPERANDS
STUB read_double, READ + 4
STUB target_double, WRITE + 4
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB abandon, ABANDON

; The clock in the firmware's memory: date and time as numbers (month 0: it was never set), and the
; millisecond clock then.
.equ YEAR, 0
.equ MONTH, 1
.equ DAY, 2
.equ HOUR, 3
.equ MINUTE, 4
.equ SECOND, 5
.equ SET_AT, 6
.equ FIELDS, 6

; Bytes of the buffer of TODR and TODW.
.equ BUFFER_LEN, 8

; The millisecond clock. Means: plc-vm modules/points.rs points.
; in: OUT   ends: OUT := it
Bitim:
    call MODULE_NOW
    rjmp write

; The time that has passed. Means: plc-vm modules/points.rs points.
; in: IN, OUT   ends: OUT := the clock - IN
Citim:
    call MODULE_NOW
    movw r18, r22
    movw r20, r24
    rcall read_double
    sub r18, r22
    sbc r19, r23
    sbc r20, r24
    sbc r21, r25
    movw r22, r18
    movw r24, r20
; in: r25:r22 milliseconds, OUT   ends: OUT := them
write:
    rcall target_double
    st X+, r25
    st X+, r24
    st X+, r23
    st X, r22
; The firmware's own code may have changed T.
; in: -   ends: with power flow
done:
    ; The firmware's own code may have changed it.
    set
    DONE

; ---- the time of day

; Means: plc-vm modules/clock.rs days_in.
; in: r18 year from 2000 on, r19 month   out: r24 days   destroys: r25
days_in:
    cpi r19, 2
    brne 1f
    ldi r24, 28
    mov r25, r18
    andi r25, 3
    brne 2f
    inc r24
2:  ret
    ; 31 in odd months up to July, and in even ones from August on.
1:  mov r24, r19
    sbrc r24, 3
    inc r24
    andi r24, 1
    subi r24, -30
    ret

; A field of the buffer.
; in: X, r30 what it must be less than
; out: r24 number, X after it, carry: it is a BCD number and less   destroys: r0, r25
bcd:
    ld r24, X+
    mov r25, r24
    swap r25
    andi r24, 0x0F
    andi r25, 0x0F
    cpi r24, 10
    brcc 1f
    cpi r25, 10
    brcc 1f
    mov r0, r25
    lsl r25
    lsl r25
    add r25, r0
    lsl r25
    add r24, r25
    cp r24, r30
1:  ret

; The next field of the buffer, in `register`.
.macro FIELD register, end
    ldi r30, \end
    rcall bcd
    brcc bad
    mov \register, r24
.endm

; Sets the clock, if the buffer is a time. Means: plc-vm modules/clock.rs from_buffer, set.
; in: BUFFER   ends: with the clock set
Todw:
    rcall bytes_in
    sbiw r30, BUFFER_LEN
    brcs bad
    FIELD r18, 100
    FIELD r19, 13
    FIELD r20, 32
    FIELD r21, 24
    FIELD r22, 60
    FIELD r23, 60
    FIELD r24, 100
    ; The date tells the day of the week.
    FIELD r24, 8
    tst r19
    breq bad
    rcall days_in
    subi r20, 1
    cp r20, r24
    brcc bad
    inc r20
    call MODULE_STATE
    std Z + YEAR, r18
    std Z + MONTH, r19
    std Z + DAY, r20
    std Z + HOUR, r21
    std Z + MINUTE, r22
    std Z + SECOND, r23
    ; The fields are written by now: MODULE_NOW destroys r18 to r23.
    call MODULE_NOW
    call MODULE_STATE
    rcall store_time
    rjmp done

; in: -   ends: abandons the instruction
bad:
    rjmp abandon

; in: Z the clock, r25:r22 milliseconds   out: SET_AT := them   destroys: -
store_time:
    std Z + SET_AT, r22
    std Z + SET_AT + 1, r23
    std Z + SET_AT + 2, r24
    std Z + SET_AT + 3, r25
    ret

; How often a time is in another one; by subtraction, as 49 days are all that 32 bits hold.
; in: r25:r22 time, r21:r18 unit   out: r26 how often, r25:r22 the rest   destroys: -
take:
    ldi r26, -1
1:  inc r26
    sub r22, r18
    sbc r23, r19
    sbc r24, r20
    sbc r25, r21
    brcc 1b
    add r22, r18
    adc r23, r19
    adc r24, r20
    adc r25, r21
    ret
.macro TAKE milliseconds
    ldi r18, (\milliseconds) & 0xFF
    ldi r19, ((\milliseconds) >> 8) & 0xFF
    ldi r20, ((\milliseconds) >> 16) & 0xFF
    ldi r21, ((\milliseconds) >> 24) & 0xFF
    rcall take
.endm

; Field and r26 and r27 together, r27 := 1 if that is r30 or more, which is subtracted.
.macro ADD_TO field, end
    ldd r18, Z + \field
    add r18, r26
    add r18, r27
    ldi r27, 0
    cpi r18, \end
    brlo 1f
    subi r18, \end
    inc r27
1:  std Z + \field, r18
.endm

; Brings the clock up to now and writes it. Means: plc-vm modules/clock.rs now, to_buffer.
; in: BUFFER   ends: with the time in the 8 bytes of BUFFER
Todr:
    call MODULE_STATE
    ldd r24, Z + MONTH
    tst r24
    breq bad
    call MODULE_NOW
    call MODULE_STATE
    ; Now, for SET_AT; then what has passed since.
    push r22
    push r23
    push r24
    push r25
    ldd r18, Z + SET_AT
    ldd r19, Z + SET_AT + 1
    ldd r20, Z + SET_AT + 2
    ldd r21, Z + SET_AT + 3
    sub r22, r18
    sbc r23, r19
    sbc r24, r20
    sbc r25, r21
    TAKE 24 * 60 * 60 * 1000
    push r26
    TAKE 60 * 60 * 1000
    push r26
    TAKE 60 * 1000
    push r26
    TAKE 1000
    ; What passed, from the seconds to the days in r26 and r27.
    ldi r27, 0
    ADD_TO SECOND, 60
    pop r26
    ADD_TO MINUTE, 60
    pop r26
    ADD_TO HOUR, 24
    pop r26
    add r26, r27
    ; The seconds were complete then.
    movw r18, r22
    movw r20, r24
    pop r25
    pop r24
    pop r23
    pop r22
    sub r22, r18
    sbc r23, r19
    sbc r24, r20
    sbc r25, r21
    rcall store_time
    ldd r18, Z + YEAR
    ldd r19, Z + MONTH
    ldd r20, Z + DAY
    ; The date, day by day: at most 50.
1:  subi r26, 1
    brcs 2f
    inc r20
    rcall days_in
    cp r24, r20
    brcc 1b
    ldi r20, 1
    inc r19
    cpi r19, 13
    brlo 1b
    ldi r19, 1
    inc r18
    cpi r18, 100
    brlo 1b
    clr r18
    rjmp 1b
2:  std Z + YEAR, r18
    std Z + MONTH, r19
    std Z + DAY, r20
    rcall bytes_to
    sbiw r30, BUFFER_LEN
    brcs far_bad
    ; The days since 2000-01-01, a Saturday, but for whole weeks: a year has one more than those, a
    ; leap year two, a month what it has beyond 28.
    mov r21, r18
    subi r21, -3
    lsr r21
    lsr r21
    add r21, r18
    add r21, r20
    subi r21, -5
3:  subi r19, 1
    breq 4f
    rcall days_in
    subi r24, 28
    add r21, r24
    rjmp 3b
    ; 1 is Sunday.
4:  subi r21, 7
    brcc 4b
    subi r21, -8
    call MODULE_STATE
    ldi r19, FIELDS
    ; The fields as BCD numbers, a 0, the day of the week.
5:  ld r24, Z+
    ldi r25, 0
6:  subi r24, 10
    brcs 7f
    subi r25, -0x10
    rjmp 6b
7:  subi r24, -10
    or r24, r25
    st X+, r24
    dec r19
    brne 5b
    st X+, r1
    st X, r21
    rjmp done

; in: -   ends: abandons the instruction
far_bad:
    rjmp abandon
