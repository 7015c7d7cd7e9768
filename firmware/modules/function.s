; Module 2: SQRT SIN COS TAN LN EXP, bit for bit as plc/vm/src/function.rs, which says what is
; computed and why. Needs module 1, real, for rounding.
;
; A function takes its operand apart, computes with integers and has module real round a fraction of
; 32 bits. Inside: r25:r22 a fraction, counting 2^-32; r25:r18 the same with 32 bits more, or an
; angle or exponent that counts 2^-62; T the sign of the operand, later of the result; r27:r26 an
; exponent: 2^(r27:r26 - BIAS) is what the top bit counts.

.include "interface.inc"

.include "real.inc"

; Numbers of the instructions.
.equ SQRT, 0
.equ TAN, 3
.equ LN, 4
.equ EXP, 5

; Below 2^this, SIN x = TAN x = x and COS x = EXP x = 1.
.equ TINY_EXPONENT, -26
; An eighth of a turn roughly, in the highest byte.
.equ FOLD, 0x32

    OPERANDS
    STUB read_double, READ + 4
    STUB target_double, WRITE + 4
    REAL

; ---- functions

; A function of a real. Inside r17 has the instruction's number, and in bit 7 whether a polynomial
; has plus signs only. Means: plc-vm modules/real.rs function.
; in: IN, OUT   ends: OUT := the function of IN, or SM1.1, as real_result of module real
Sqrt:
Sin:
Cos:
Tan:
Ln:
Exp:
        mov     r18, r26
        rcall   read_double
        rcall   target_double
        push    r26
        push    r27
        ldi     r30, 8                  ; the registers are in data memory
        clr     r31
1:      ld      r0, Z+
        push    r0
        cpi     r30, 18
        brne    1b
        mov     r17, r18
        rcall   function
        ldi     r19, 1 << OVERFLOW
        ldi     r18, 0xFF - (1 << ZERO | 1 << OVERFLOW | 1 << NEGATIVE)
        sbc     r20, r20                ; carry: there is no result
        ldi     r30, 18
        clr     r31
1:      pop     r0
        st      -Z, r0
        cpi     r30, 8
        brne    1b
        ldi     r31, REAL_RESULT
        rjmp    real

; in: -   out: carry: there is no result   destroys: -
nothing:
        sec
        ret

; Takes the operand apart and goes on as its function does. Means: plc-vm function.rs parts.
; in: r17 which, r25:r22 operand   out: r25:r22 result, carry: there is none
; destroys: r0, r8-r21, X, Y, Z, T
function:
        bst     r25, 7
        clr     r18
        clr     r19
        movw    r20, r18
        ; The exponent, and the leading bit unless it is 0, which becomes 1; then a fraction of 32
        ; bits whose top bit is set.
        lsl     r24
        rol     r25
        mov     r26, r25
        clr     r27
        cpi     r25, 255
        breq    nothing
        lsr     r24
        cpse    r26, r1
        ori     r24, 0x80
        cpi     r26, 1
        adc     r26, r1
        mov     r25, r24
        mov     r24, r23
        mov     r23, r22
        clr     r22
        mov     r30, r25
        or      r30, r24
        or      r30, r23
        breq    1f
        rcall   normalize
1:      subi    r26, BIAS               ; until a result is there, the exponent alone
        sbc     r27, r1
        cpi     r17, SQRT
        breq    square_root
        cpi     r17, LN
        breq    to_logarithm
        ldi     r30, 0xFF
        cpi     r26, 0x100 + TINY_EXPONENT
        cpc     r27, r30
        brlt    tiny
        cpi     r17, EXP
        breq    to_exponential
        rjmp    circular

; in: as logarithm   out: as logarithm: r25:r22, carry   destroys: r0, r8-r21, X, Y, Z, T
to_logarithm:
        rjmp    logarithm

; in: as exponential   out: as exponential: r25:r22, carry
; destroys: r0, r8-r16, r18-r21, r28, X, Z, T
to_exponential:
        rjmp    exponential

; Of an operand near zero: the operand for SIN and TAN, 1 for COS and EXP.
; in: r17 which, r25:r22 fraction, r27:r26 exponent without BIAS, r19:r18 0, T sign
; out: r25:r22 result, carry: there is none   destroys: r0, r18-r21, X, Z, T
tiny:
        subi    r26, 0x100 - BIAS
        sbci    r27, 0xFF
        cpi     r17, EXP
        breq    2f
        sbrc    r17, 0                  ; SIN and TAN have odd numbers
        rjmp    pack
2:      ldi     r25, 0x3F
        ldi     r24, 0x80
        movw    r22, r18
        clc
        ret

; The root, a bit at a time, of 25 bits: what is left of the operand in r25:r18, 4 * root + 1 in
; r15:r12. Means: plc-vm function.rs sqrt.
; in: r25:r22 fraction, r27:r26 exponent without BIAS, r21:r18 0, T sign
; out: r25:r22 result, carry: there is none   destroys: r0, r12-r16, r18-r21, X, Z, T
square_root:
        sbrs    r25, 7
        rjmp    pack
        brts    nothing
        ; Half the exponent, and BIAS. The operand counts twice when a bit is left: it is not
        ; halved.
        subi    r26, lo8(-2 * BIAS)
        sbci    r27, hi8(-2 * BIAS)
        asr     r27
        ror     r26
        movw    r18, r22
        movw    r20, r24
        brcs    1f
        lsr     r21
        ror     r20
        ror     r19
        ror     r18
1:      clr     r22
        clr     r23
        movw    r24, r22
        movw    r12, r22
        movw    r14, r22
        inc     r12
        ldi     r16, 25
2:      rcall   shift_left
        rcall   shift_left
        cp      r22, r12
        cpc     r23, r13
        cpc     r24, r14
        cpc     r25, r15
        brcs    3f
        sub     r22, r12
        sbc     r23, r13
        sbc     r24, r14
        sbc     r25, r15
        inc     r12
        inc     r12
3:      lsl     r12
        rol     r13
        rol     r14
        rol     r15
        dec     r12
        dec     r16
        brne    2b
        movw    r22, r12
        movw    r24, r14
        adiw    r26, 5                  ; 27 bits; the last two only say that the root may go on
        rjmp    pack

.include "logarithm.inc"
.include "circular.inc"
.include "fraction.inc"
