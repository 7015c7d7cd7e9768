; Module 12: PID, bit for bit as plc/vm/src/pid.rs, which says what is computed and why. Needs
; module 1, real.

.include "interface.inc"
.include "real.inc"

    OPERANDS
    STUB target_table, WRITE + ROOM + 1
    REAL

.equ SYSTEM_BITS, RESULT_BITS - 1
.equ FIRST_SCAN, 1

; Computed in steps. A step is a byte: what is done with r25:r22, and with which real of the loop
; table, at Y, or of those on the stack.
.equ ADD, 0 << 6
.equ SUB, 1 << 6
.equ MUL, 2 << 6
.equ DIV, 3 << 6
.equ LOAD, 1
.equ STORE, 2
.equ END, 3

.equ PROCESS, 0
.equ SETPOINT, 4
.equ OUTPUT, 8
.equ GAIN, 12
.equ SAMPLE_TIME, 16
.equ INTEGRAL_TIME, 20
.equ DERIVATIVE_TIME, 24
.equ TABLE_BIAS, 28
.equ TABLE_LAST, 32
.equ TABLE_LEN, 36
; On the stack.
.equ WANTED, 36
.equ LAST, 40
.equ ERROR, 44
.equ OTHER_GAIN, 48
.equ SUM, 52
.equ REST, 56
.equ SIXTY, 60
.equ STACK_LEN, 28
; Of an integral time without effect, its exponent, which is even.
.equ NO_INTEGRAL_EXPONENT, 113 + BIAS

; STEPS is all of them; many begin with FIRST_STEPS and end with LAST_STEPS.
.macro FIRST_STEPS steps:vararg
        rcall   steps
        .irp    step, \steps
        .byte   \step
        .endr
.endm
.macro LAST_STEPS steps:vararg
        .irp    step, \steps
        .byte   \step
        .endr
        .byte   END
        .balign 2
.endm
.macro STEPS steps:vararg
        rcall   steps
        LAST_STEPS \steps
.endm

; Controls a loop. The third operand is the number of the history bit: power flow was missing.
; Means: plc-vm modules/real.rs pid, pid.rs execute.
; in: TBL, LOOP, history, T power flow   ends: with the loop table, or SM1.1, ENO 0
Pid:
        ; Executed without power flow, too, but a box.
        ldi     r18, 1
        sts     ENO, r18
        ; The edge memories end where the bytes of the events begin, the last of the arena.
        ldi     r30, lo8(IMAGE_ARENA_LEN)
        ldi     r31, hi8(IMAGE_ARENA_LEN)
        lpm     r26, Z+
        lpm     r27, Z+
        lpm     r24, Z+
        lpm     r25, Z
        ldi     r30, lo8(IMAGE_EVENTS)
        lpm     r18, Z
        sub     r26, r18
        sbc     r27, r1
        ; So many bytes have the bits.
        adiw    r24, 7
        lsr     r25
        ror     r24
        lsr     r24
        lsr     r24
        sub     r26, r24
        sbc     r27, r1
        ; The byte of the history bit, and its mask in r19.
        movw    r30, r28
        adiw    r30, 3
        lpm     r24, Z
        mov     r18, r24
        andi    r18, 7
        lsr     r24
        lsr     r24
        lsr     r24
        add     r26, r24
        adc     r27, r1
        subi    r26, lo8(-ARENA_START)
        sbci    r27, hi8(-ARENA_START)
        cpi     r27, hi8(DATA_END)
        brsh    abandon
        BIT_MASK r19, r18
        ld      r18, X
        mov     r20, r18
        and     r20, r19                ; not zero: a start
        or      r18, r19
        brtc    3f
        eor     r18, r19
3:      st      X, r18
        brts    4f
        sts     ENO, r1
        DONE
4:      lds     r18, SYSTEM_BITS
        sbrc    r18, FIRST_SCAN
        clr     r20
        rcall   target_table
        sbiw    r30, TABLE_LEN
        brcc    5f
; in: -   ends: abandons the instruction
abandon:
        ldi     r26, ABANDON
        rjmp    operands
        ; The reals on the stack, the last one first: 60.0, then zeros.
5:      movw    r28, r26
        push    r1                      ; 60.0
        push    r1
        ldi     r18, 0x70
        push    r18
        ldi     r18, 0x42
        push    r18
        ldi     r18, STACK_LEN / 4 - 1
6:      push    r1
        push    r1
        push    r1
        push    r1
        dec     r18
        brne    6b
        ; A start takes the process value for the setpoint and the last one, and the output for the
        ; bias.
        tst     r20
        breq    7f
        STEPS   LOAD + PROCESS, STORE + WANTED, STORE + LAST, LOAD + OUTPUT
        rjmp    8f
7:      STEPS   LOAD + SETPOINT, STORE + WANTED, LOAD + TABLE_LAST, STORE + LAST, LOAD + TABLE_BIAS
8:      STEPS   STORE + SUM, LOAD + WANTED, SUB + PROCESS, STORE + ERROR, LOAD + GAIN
        ; Without a gain the other two actions have one of 1.
        rcall   is_zero
        brne    9f
        ldi     r25, 0x3F               ; 1.0
        ldi     r24, 0x80
9:      STEPS   STORE + OTHER_GAIN
        rcall   no_integral
        breq    10f
        FIRST_STEPS MUL + SIXTY, STORE + REST, LOAD + OTHER_GAIN, MUL + SAMPLE_TIME
        LAST_STEPS DIV + REST, MUL + ERROR, ADD + SUM, STORE + SUM
10:     STEPS   LOAD + GAIN, MUL + ERROR, STORE + REST, LOAD + DERIVATIVE_TIME
        rcall   is_zero
        breq    11f
        FIRST_STEPS MUL + SIXTY, MUL + OTHER_GAIN, DIV + SAMPLE_TIME, STORE + ERROR, LOAD + LAST
        LAST_STEPS SUB + PROCESS, MUL + ERROR, ADD + REST, STORE + REST
11:     STEPS   LOAD + SUM, ADD + REST
        ; The output; and when it was limited, the integral sum that belongs to it.
        rcall   limit
        STEPS   STORE + OUTPUT
        rcall   no_integral
        breq    13f
        brtc    12f
        STEPS   LOAD + OUTPUT, SUB + REST, STORE + SUM
12:     STEPS   LOAD + SUM
        rcall   limit
        STEPS   STORE + SUM
13:     FIRST_STEPS LOAD + SUM, STORE + TABLE_BIAS, LOAD + WANTED, STORE + SETPOINT
        LAST_STEPS LOAD + PROCESS, STORE + TABLE_LAST
        ldi     r19, 0
        rjmp    14f

; There is no result.
; in: two bytes more on the stack than the reals   ends: SM1.1 := 1, ENO := 0
failed:
        pop     r0
        pop     r0
        ldi     r19, 1 << OVERFLOW
        sts     ENO, r1
14:     ldi     r18, STACK_LEN / 4
15:     pop     r0
        pop     r0
        pop     r0
        pop     r0
        dec     r18
        brne    15b
        lds     r30, RESULT_BITS
        andi    r30, 0xFF - (1 << OVERFLOW)
        or      r30, r19
        sts     RESULT_BITS, r30
        set
        DONE

; The steps after the call, which is not from a subroutine if it needs the stack.
; in: Y the loop table, r25:r22 a real   out: r25:r22 a real   destroys: r0, r18-r21, X, Z, T
steps:
        BYTES_AFTER_CALL
1:      lpm     r20, Z+
        cpi     r20, END
        breq    5f
        mov     r19, r20
        andi    r19, 0x3C
        ; X at the real: in the table, or on the stack, where the first one has the number
        ; TABLE_LEN.
        movw    r26, r28
        cpi     r19, TABLE_LEN
        brcs    2f
        in      r26, SPL
        in      r27, SPH
        sbiw    r26, TABLE_LEN - 1
2:      add     r26, r19
        adc     r27, r1
        sbrc    r20, 0
        rjmp    3f
        sbrc    r20, 1
        rjmp    4f
        push    r30
        push    r31
        lsl     r20
        rol     r20
        rol     r20
        andi    r20, 3
        mov     r31, r20
        subi    r31, 0x100 - REAL_ADD
        ld      r21, X+
        ld      r20, X+
        ld      r19, X+
        ld      r18, X+
        rcall   real
        brcs    failed
        pop     r31
        pop     r30
        rjmp    1b
3:      ld      r25, X+
        ld      r24, X+
        ld      r23, X+
        ld      r22, X+
        rjmp    1b
4:      st      X+, r25
        st      X+, r24
        st      X+, r23
        st      X+, r22
        rjmp    1b
5:      adiw    r30, 1
        rjmp    go_on

; Whether the integral time is zero, or 2^113 or more: without effect.
; in: Y the loop table   out: r25:r22 the integral time, zero flag: it is
; destroys: r0, r18-r21, X, Z, T
no_integral:
        STEPS   LOAD + INTEGRAL_TIME
        mov     r30, r25
        lsl     r30
        cpi     r30, NO_INTEGRAL_EXPONENT
        brcc    1f
; in: r25:r22 real   out: zero flag: it is zero   destroys: r30
is_zero:
        mov     r30, r25
        lsl     r30
        or      r30, r24
        or      r30, r23
        or      r30, r22
        ret
1:      cp      r1, r1
        ret

; The nearest value from 0.0 to 1.0. Means: plc-vm pid.rs limit.
; in: r25:r22 real   out: r25:r22 that value, T: it is another one   destroys: r30
limit:
        clt
        sbrc    r25, 7
        rjmp    1f
        cp      r1, r22
        cpc     r1, r23
        ldi     r30, 0x80
        cpc     r30, r24
        ldi     r30, 0x3F
        cpc     r30, r25
        brcc    3f
        mov     r25, r30
        ldi     r24, 0x80
        rjmp    2f
1:      clr     r25
        clr     r24
2:      clr     r23
        clr     r22
        set
3:      ret
