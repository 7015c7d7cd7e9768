; Module 2: SQRT SIN COS TAN LN EXP, bit for bit as plc/vm/src/function.rs, which says what is computed and why. Needs
; module 1, real, for rounding.
;
; A function takes its operand apart, computes with integers and has module real round a fraction of 32 bits. Inside:
; r25:r22 a fraction, counting 2^-32; r25:r18 the same with 32 bits more, or an angle or exponent that counts 2^-62;
; T the sign of the operand, later of the result; r27:r26 an exponent: 2^(r27:r26 - BIAS) is what the top bit counts.

.include "interface.inc"

.include "real.inc"

; Numbers of the instructions.
.equ SQRT, 0
.equ COS, 2
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

; IN, OUT. r17 has the instruction's number, and in bit 7 whether a polynomial has plus signs only.
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

nothing:
        sec
        ret

; The result r25:r22 of the function r17, or carry.
function:
        bst     r25, 7
        clr     r18
        clr     r19
        movw    r20, r18
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
to_logarithm:
        rjmp    logarithm
to_exponential:
        rjmp    exponential
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

; The root, a bit at a time: r25:r18 what is left of the operand, 4 * root + 1 in r15:r12.
square_root:
        sbrs    r25, 7
        rjmp    pack
        brts    nothing
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

; Exponent and 1 + or (T) - a distance, which is a fraction. r29:r28 the exponent, r15:r12 the distance.
logarithm:
        sbrc    r25, 7
        brtc    4f
        sec
        ret
4:      movw    r28, r26
        cpi     r25, 0xB5
        brcs    1f
        rcall   negate
        adiw    r28, 1
        set
        rjmp    2f
1:      rcall   shift_left
2:      bld     r17, 7
        mov     r30, r25
        or      r30, r24
        or      r30, r23
        breq    3f
        movw    r12, r22
        movw    r14, r24
        ldi     r26, BIAS
        clr     r27
        rcall   normalize
        push    r26
        movw    r18, r12
        movw    r20, r14
        movw    r12, r22
        movw    r14, r24
        rcall   polynomial
        .byte   9
        .long   0x098BEC59, 0x1065BC87, 0x10FABDB5, 0x122CBD19, 0x15423CB6
        .long   0x1999EB00, 0x2000847C, 0x2AAAABA2, 0x3FFFFF09, 0x7FFFFFFF
        .balign 2
        movw    r18, r12
        movw    r20, r14
        rcall   multiply
        pop     r26
3:      mov     r30, r28
        or      r30, r29
        breq    pack
        ; ln 2 for every power of two, and the part r25:r22 in 2^-32; r26 in front of it.
        ldi     r30, BIAS - 1
        sub     r30, r26
4:      subi    r30, 1
        brcs    5f
        lsr     r25
        ror     r24
        ror     r23
        ror     r22
        rjmp    4b
5:      clr     r26
        bld     r30, 7
        eor     r30, r29
        sbrs    r30, 7
        rjmp    6f
        rcall   negate
        sbc     r26, r26
6:      mov     r30, r28
        sbrc    r29, 7
        neg     r30
7:      subi    r22, lo8(-0xB17217F7)
        sbci    r23, hi8(-0xB17217F7)
        sbci    r24, hlo8(-0xB17217F7)
        sbci    r25, hhi8(-0xB17217F7)
        sbci    r26, 0xFF
        dec     r30
        brne    7b
        bst     r29, 7
        clr     r20
        mov     r21, r22
        mov     r22, r23
        mov     r23, r24
        mov     r24, r25
        mov     r25, r26
        ldi     r26, BIAS + 7
        clr     r27
        rcall   normalize
; Has module real round the result and put it together.
pack:
        ldi     r31, REAL_FROM_FRACTION
        rjmp    real

exponential:
        cpi     r26, 7
        brlt    1f
        movw    r22, r18
        movw    r24, r18
        clc
        brts    2f
        sec
2:      ret
1:      rcall   divide
        .quad   0x2C5C85FDF473DE6B      ; ln 2
        brts    4f
        rcall   complement
        inc     r27
4:      mov     r28, r27
        rcall   shift_left
        rcall   shift_left
        movw    r18, r22
        movw    r20, r24
        rcall   polynomial
        .byte   6
        .long   0x00204D5E, 0x010539E9, 0x054FE69F, 0x1554096D, 0x3FFFDA03
        .long   0x7FFFFE5D, 0x7FFFFFFD
        .balign 2
        mov     r26, r28
        brtc    3f
        com     r27
        neg     r26
        sbci    r27, 0xFF
3:      subi    r26, 0x100 - BIAS
        sbci    r27, 0xFF
        clt
        rjmp    pack

; r29 the quarter turns, r16 bit 7 the sign, r15:r12 the angle that is left, its exponent in r28.
circular:
        rcall   divide
        .quad   0x6487ED5110B4611A      ; a quarter turn
        clr     r16
        bld     r16, 7
        sbrc    r17, 0
        rjmp    1f
        clr     r16                     ; COS: of |x| and a quarter turn
        inc     r27
1:      cpi     r25, FOLD
        brcs    3f
        rcall   complement
        inc     r27
        cpi     r17, TAN
        breq    2f
        sbrs    r27, 0
2:      subi    r16, 0x80
3:      mov     r29, r27
        cpi     r17, TAN
        brne    4f
        lsl     r27
4:      sbrc    r27, 1
        subi    r16, 0x80
        bst     r16, 7
        rcall   shift_left
        rcall   shift_left
        movw    r8, r22
        movw    r10, r24
        ldi     r26, BIAS
        clr     r27
        rcall   normalize
        mov     r28, r26
        movw    r12, r22
        movw    r14, r24
        movw    r22, r8
        movw    r24, r10
        movw    r18, r8
        movw    r20, r10
        rcall   multiply
        movw    r18, r22
        movw    r20, r24
        cpi     r17, TAN
        breq    tangent
        sbrc    r29, 0
        rjmp    5f
        rcall   sine
        mov     r26, r28
        rjmp    pack
5:      rcall   cosine
        ldi     r26, BIAS
        rjmp    pack

; A quarter of the quotient of sine and cosine, by a quarter turn of cosine and sine, in 32 bits.
tangent:
        rcall   cosine
        push    r22
        push    r23
        push    r24
        push    r25
        rcall   sine
        pop     r11
        pop     r10
        pop     r9
        pop     r8
        mov     r26, r28
        inc     r26
        sbrs    r29, 0
        rjmp    1f
        mov     r26, r28
        com     r26
        movw    r30, r22
        movw    r22, r8
        movw    r8, r30
        movw    r30, r24
        movw    r24, r10
        movw    r10, r30
1:      clr     r18
        clr     r19
        movw    r20, r18
        rcall   shift_right
        rcall   shift_right
        ldi     r30, 32
2:      rcall   shift_left
        cp      r22, r8
        cpc     r23, r9
        cpc     r24, r10
        cpc     r25, r11
        brcs    3f
        sub     r22, r8
        sbc     r23, r9
        sbc     r24, r10
        sbc     r25, r11
        inc     r18
3:      dec     r30
        brne    2b
        movw    r22, r18
        movw    r24, r20
        rjmp    pack

; Half the cosine of the angle whose square is in r21:r18, which is kept; r27 = 0.
cosine:
        rcall   polynomial
        .byte   4
        .long   0x0000CC7A, 0x002D80E6, 0x055554E7, 0x3FFFFFF7, 0x80000000
        .balign 2
        ret

; Half the sine of the angle r15:r12 in its exponent, square in r21:r18; r27 = 0.
sine:
        rcall   polynomial
        .byte   3
        .long   0x000663CE, 0x011105F3, 0x155553F3, 0x7FFFFFF9
        .balign 2
        movw    r18, r12
        movw    r20, r14
; r25:r22 := the first half of r25:r22 * r21:r18. Changes r8-r11, r26; r27 = 0.
multiply:
        clr     r8
        clr     r9
        movw    r10, r8
        clr     r27
        rcall   1f
        movw    r22, r8
        movw    r24, r10
        clr     r1
        ret
1:      rcall   2f                      ; four times: a byte of r25:r22, the lowest first
2:      rcall   3f
3:      mov     r26, r22
        mov     r22, r23
        mov     r23, r24
        mov     r24, r25
        mul     r21, r26
        add     r11, r0
        adc     r1, r27
        mov     r25, r1
        mul     r20, r26
        add     r10, r0
        adc     r11, r1
        adc     r25, r27
        mul     r19, r26
        add     r9, r0
        adc     r10, r1
        adc     r11, r27
        adc     r25, r27
        mul     r18, r26
        add     r8, r0
        adc     r9, r1
        adc     r10, r27
        adc     r11, r27
        adc     r25, r27
        mov     r8, r9
        mov     r9, r10
        mov     r10, r11
        mov     r11, r25
        ret

; Of x = r21:r18, with the coefficients behind the call, last one first: c0 - x (c1 - x (c2 - ...)), or with plus signs.
; A difference is 2^-32 too small. Keeps x; r27 = 0.
polynomial:
        pop     r31
        pop     r30
        lsl     r30
        rol     r31
        lpm     r16, Z+                 ; how many after the first
        lpm     r22, Z+
        lpm     r23, Z+
        lpm     r24, Z+
        lpm     r25, Z+
1:      rcall   multiply
        sbrc    r17, 7
        rjmp    2f
        com     r22
        com     r23
        com     r24
        com     r25
2:      lpm     r0, Z+
        add     r22, r0
        lpm     r0, Z+
        adc     r23, r0
        lpm     r0, Z+
        adc     r24, r0
        lpm     r0, Z+
        adc     r25, r0
        dec     r16
        brne    1b
        adiw    r30, 1
        rjmp    go_on

; How often the 64 bits behind the call, as 2^-62, fit r25:r22 * 2^(r27:r26), in r27; r25:r18 what is left, r15:r8 they.
; At first r21:r18 = 0.
divide:
        pop     r31
        pop     r30
        lsl     r30
        rol     r31
        .irp    register, r8, r9, r10, r11, r12, r13, r14, r15
        lpm     \register, Z+
        .endr
        rcall   shift_right
1:      rcall   shift_right
        cpi     r26, 0xFF
        brge    2f
        inc     r26
        rjmp    1b
2:      inc     r26
        ldi     r27, 0xFF               ; the bits of the quotient, inverted
3:      cp      r18, r8
        cpc     r19, r9
        cpc     r20, r10
        cpc     r21, r11
        cpc     r22, r12
        cpc     r23, r13
        cpc     r24, r14
        cpc     r25, r15
        brcs    4f
        sub     r18, r8
        sbc     r19, r9
        sbc     r20, r10
        sbc     r21, r11
        sbc     r22, r12
        sbc     r23, r13
        sbc     r24, r14
        sbc     r25, r15
4:      rol     r27
        dec     r26
        brmi    5f
        rcall   shift_left
        rjmp    3b
5:      com     r27
        rjmp    go_on
; What is left, up to the next multiple.
complement:
        sub     r8, r18
        sbc     r9, r19
        sbc     r10, r20
        sbc     r11, r21
        sbc     r12, r22
        sbc     r13, r23
        sbc     r14, r24
        sbc     r15, r25
        movw    r18, r8
        movw    r20, r10
        movw    r22, r12
        movw    r24, r14
        ret

; Shifts r25:r18, not zero, until the top bit is set, and adapts the exponent.
normalize:
        sbrc    r25, 7
        ret
        rcall   shift_left
        sbiw    r26, 1
        rjmp    normalize

shift_left:
        lsl     r18
        rol     r19
        rol     r20
        rol     r21
        rol     r22
        rol     r23
        rol     r24
        rol     r25
        ret

shift_right:
        lsr     r25
        ror     r24
        ror     r23
        ror     r22
        ror     r21
        ror     r20
        ror     r19
        ror     r18
        ret

negate:
        com     r25
        com     r24
        com     r23
        neg     r22
        sbci    r23, 0xFF
        sbci    r24, 0xFF
        sbci    r25, 0xFF
        ret
