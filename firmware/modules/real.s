; Module 1, real: +R -R *R /R, DTR ROUND TRUNC and the comparisons of reals, bit for bit as plc/vm/src/real.rs.
; IEEE single, rounded to nearest even, denormals included. No functions (function.s) and no texts.
;
; Other modules reach the entries real_..., which are no instructions, through the jump table. It must have them behind
; the routines, in this order (entries 10 to 17):
;   real_add real_sub real_mul real_div real_from_int real_to_int real_from_fraction real_result
; Arithmetic: first operand r25:r22, second r21:r18, result r25:r22. Changes r18-r27, r30, r31, r0 and T; r1 = 0.
; Carry set: no result, because an operand or the result is infinite or not a number; r19 then has the bit for SMB1.

.include "interface.inc"

.equ BIAS, 127
; The exponent of what is infinite or not a number.
.equ INFINITE, 255
; The number of LoadReal; AndReal and OrReal follow.
.equ LOAD_REAL, 7

    OPERANDS
    STUB read_double, READ + 4
    STUB target_double, WRITE + 4
    STUB compared_double, COMPARE + READ + 4

; ---- routines

; IN1, OUT: OUT := OUT op IN1.
AddReal:
SubReal:
MulReal:
DivReal:
        mov     r18, r26
        rcall   read_double
        rcall   target_double
        push    r26
        push    r27
        mov     r30, r18
        movw    r18, r22
        movw    r20, r24
        ld      r25, X+
        ld      r24, X+
        ld      r23, X+
        ld      r22, X
        push    r30
        rcall   operate
        pop     r20
        ldi     r18, 0xFF - (1 << ZERO | 1 << OVERFLOW | 1 << NEGATIVE)
        sbrc    r20, 1
        andi    r18, 0xFF - (1 << DIVISION_BY_ZERO) ; *R and /R
        rjmp    write_result

; Ends an instruction. Bit 0 of r20: there is no result, bits of SMB1 in r19 say why. Otherwise the result r25:r22 is
; written to the address on the stack (high byte on top), and the bits of SMB1 follow from it. r18: the bits that stay.
real_result:
        lsr     r20
write_result:
        pop     r27
        pop     r26
        brcs    no_result
        rcall   store
        ldi     r19, 1 << ZERO
        lsl     r25
        or      r25, r24
        or      r25, r23
        or      r25, r22
        breq    write_bits
        ldi     r19, 1 << NEGATIVE
        brcs    write_bits
        ldi     r19, 0
write_bits:
        lds     r30, RESULT_BITS
        and     r30, r18
        or      r30, r19
        sts     RESULT_BITS, r30
done:
        set
        DONE
no_result:
        sts     ENO, r1
        sbrc    r19, DIVISION_BY_ZERO
        ldi     r18, 0xFF
        rjmp    write_bits

; IN, OUT
Dtr:
        rcall   read_double
        rcall   target_double
        push    r26
        push    r27
        rcall   real_from_int
        pop     r27
        pop     r26
        rcall   store
        rjmp    done

; IN, OUT. The number of ROUND is odd.
Round:
Trunc:
        mov     r18, r26
        rcall   read_double
        rcall   target_double
        push    r26
        push    r27
        mov     r30, r18
        rcall   real_to_int
        pop     r27
        pop     r26
        ldi     r18, 0xFF - (1 << OVERFLOW)
        brcs    no_result
        rcall   store
        ldi     r19, 0
        rjmp    write_bits

store:
        st      X+, r25
        st      X+, r24
        st      X+, r23
        st      X+, r22
        ret

; Relation, IN1, IN2
LoadReal:
AndReal:
OrReal:
        subi    r26, LOAD_REAL - RELATE
        push    r26
        adiw    r28, 1
        rcall   compared_double
        movw    r18, r22
        movw    r20, r24
        rcall   compared_double
        rcall   order                   ; one, then the other; then they are in their places again
        rcall   order
        pop     r26
        rjmp    operands

; Makes of a real in r25:r22 an integer of the same order, and exchanges it with r21:r18.
order:
        mov     r27, r25
        andi    r25, 0x7F
        cp      r1, r22
        cpc     r1, r23
        ldi     r30, lo8(INFINITE << 7)
        cpc     r30, r24
        ldi     r30, hi8(INFINITE << 7)
        cpc     r30, r25
        brcs    not_a_number
        sbrc    r27, 7
        rcall   negate
exchange:
        movw    r30, r22
        movw    r22, r18
        movw    r18, r30
        movw    r30, r24
        movw    r24, r20
        movw    r20, r30
        ret

not_a_number:
        pop     r0
        pop     r0
        pop     r0
        ldi     r24, FAULT_REAL
        jmp     MODULE_FAULT

negate:
        com     r25
        com     r24
        com     r23
        neg     r22
        sbci    r23, 0xFF
        sbci    r24, 0xFF
        sbci    r25, 0xFF
        ret

; ---- arithmetic
;
; Inside, a number is a significand of 24 bits, r24:r22 or r20:r18, and a biased exponent, r25 or r21; it is not
; normal (denormal or 0) with an exponent of 1 and the significand's top bit clear.

; By the number of the instruction in r30.
operate:
        sbrs    r30, 1
        rjmp    1f
        sbrs    r30, 0
        rjmp    real_mul
        rjmp    real_div
1:      sbrc    r30, 0
real_sub:
        subi    r21, 0x80
real_add:
        mov     r27, r25
        eor     r27, r21                ; bit 7: a difference
        bst     r21, 7
        rcall   split
        brcc    illegal
        cp      r22, r18
        cpc     r23, r19
        cpc     r24, r20
        cpc     r25, r21
        brcs    1f
        rcall   exchange                ; the smaller one is in r24:r22; T is the sign of the other
        bld     r26, 7
        eor     r26, r27
        bst     r26, 7
1:      mov     r26, r21
        sub     r21, r25
        mov     r25, r21
        clr     r21                     ; r24:r21: 24 bits, and 8 behind them, the last one set if any follows
        rcall   shift_right
        sbrc    r27, 7
        rjmp    4f
        clr     r27
        add     r22, r18
        adc     r23, r19
        adc     r24, r20
        brcc    finish
        clr     r25
        rcall   shift_in
        adiw    r26, 1
        rjmp    finish

illegal:
        ldi     r19, 1 << OVERFLOW
        sec
        ret

4:      clr     r27
        neg     r21
        sbc     r18, r22
        sbc     r19, r23
        sbc     r20, r24
        movw    r22, r18
        mov     r24, r20
        brne    finish                  ; sbc leaves Z only if all bytes were 0
        clt                             ; an exact difference of zero is +0
; A number r24:r21 that may be zero, exponent r27:r26, sign T.
finish_or_zero:
        mov     r25, r24
        or      r25, r23
        or      r25, r22
        or      r25, r21
        breq    sign
; The result r24:r21, not zero, exponent r27:r26 (signed), sign T: shifts until it is normal, or denormal; rounds.
finish:
        cpi     r26, 2
        cpc     r27, r1
        brlt    1f
        sbrc    r24, 7
        rjmp    round
        lsl     r21
        rol     r22
        rol     r23
        rol     r24
        sbiw    r26, 1
        rjmp    finish
1:      ldi     r25, 1
        sub     r25, r26
        rcall   shift_right
        ldi     r26, 1
        clr     r27
; Exponent 1 or more: rounds and packs. The leading bit adds 1 to the exponent, so does the carry of the rounding.
round:
        clr     r25
        lsl     r21
        brcc    2f
        brne    1f
        sbrs    r22, 0                  ; half-way: to even
        rjmp    2f
1:      subi    r22, 0xFF
        sbci    r23, 0xFF
        sbci    r24, 0xFF
        sbci    r25, 0xFF
2:      sbiw    r26, 1
        lsr     r27
        ror     r26
        ror     r27
        add     r24, r27
        adc     r25, r26
        cpi     r24, lo8(INFINITE << 7)
        ldi     r26, hi8(INFINITE << 7)
        cpc     r25, r26
        brcc    illegal
sign:
        bld     r25, 7
        clc
        ret

; Shifts r24:r21 right by r25; bit 0 stays set once it was.
shift_right:
        cpi     r25, 32
        brcs    1f
        ldi     r25, 32
1:      cpi     r25, 8
        brcs    2f
        subi    r25, 8
        cp      r1, r21
        mov     r21, r22
        mov     r22, r23
        mov     r23, r24
        ldi     r24, 0
        brcc    1b
        ori     r21, 1
        rjmp    1b
2:      subi    r25, 1
        brcs    3f
        lsr     r24
        rjmp    4f
; With r25 = 0: by one, and the carry comes in.
shift_in:
        ror     r24
4:      ror     r23
        ror     r22
        ror     r21
        brcc    2b
        ori     r21, 1
        rjmp    2b
3:      ret

real_from_int:
        bst     r25, 7
        sbrc    r25, 7
        rcall   negate
        ldi     r26, BIAS + 31
        ldi     r27, 0
; The real nearest to r25:r22, whose top bit counts 2^(r27:r26 - BIAS); T: its sign.
real_from_fraction:
        mov     r21, r22
        mov     r22, r23
        mov     r23, r24
        mov     r24, r25
        rjmp    finish_or_zero

; r30 bit 0: rounds, half away from zero; else cuts off.
real_to_int:
        movw    r18, r22
        movw    r20, r24
        bst     r25, 7
        rcall   split
        brcc    4f
        ldi     r18, BIAS + 31
        sub     r18, r25
        brcs    4f
        mov     r25, r24
        mov     r24, r23
        mov     r23, r22
        clr     r22
        cpi     r18, 33
        brcs    1f
        ldi     r18, 33
1:      inc     r18
        clc
        rjmp    3f
2:      lsr     r25
        ror     r24
        ror     r23
        ror     r22
3:      dec     r18                     ; leaves the carry: the bit shifted out last
        brne    2b
        sbrs    r30, 0
        clc
        adc     r22, r1
        adc     r23, r1
        adc     r24, r1
        adc     r25, r1
        mov     r27, r25
        brtc    5f
        rcall   negate
        sbrc    r25, 7
        clr     r27
        rjmp    5f
4:      ldi     r27, 0x80
5:      lsl     r27                     ; carry: 2^31 or more, or less than -2^31
        ldi     r19, 1 << OVERFLOW
        ret

; Takes r25:r22 and r21:r18 apart. Carry clear when one is not finite. Keeps T, r26, r27, r30, r31.
split:
        lsl     r24
        rol     r25
        lsr     r24
        cpse    r25, r1
        ori     r24, 0x80
        cpi     r25, 1
        adc     r25, r1
        lsl     r20
        rol     r21
        lsr     r20
        cpse    r21, r1
        ori     r20, 0x80
        cpi     r21, 1
        adc     r21, r1
        cpi     r25, INFINITE
        brcc    1f
        cpi     r21, INFINITE
1:      ret

; Takes both apart; T: the sign of product and quotient; continues with the first.
factors:
        mov     r27, r25
        eor     r27, r21
        bst     r27, 7
        rcall   split
        brcc    2f
        clr     r26
        clr     r27
; Makes r24:r22 normal, adds its exponent to r27:r26, exchanges it with the other one. Leaves the caller when it is 0.
next_factor:
        add     r26, r25
        adc     r27, r1
        mov     r25, r24
        or      r25, r23
        or      r25, r22
        breq    3f
1:      sbrc    r24, 7
        rjmp    exchange
        lsl     r22
        rol     r23
        rol     r24
        sbiw    r26, 1
        rjmp    1b
2:      pop     r0
        pop     r0
        rjmp    illegal
3:      pop     r0
        pop     r0
        rjmp    sign

real_mul:
        rcall   factors
        rcall   next_factor
        subi    r26, BIAS - 1
        sbc     r27, r1
        clr     r21
        clr     r25
        clr     r30
        clr     r31
        rcall   multiply_and_shift
        rcall   multiply_and_shift
        rcall   multiply
        clr     r1
        or      r19, r20
; A result in r31:r30:r25:r21, more behind it unless Z.
take_result:
        breq    1f
        ori     r21, 1
1:      mov     r22, r25
        mov     r23, r30
        mov     r24, r31
        rjmp    finish

; r31:r30:r25:r21 += r24:r22 * r18; then its last byte goes into r20, r20 into r19, r19 into r18.
multiply_and_shift:
        rcall   multiply
        mov     r18, r19
        mov     r19, r20
        mov     r20, r21
        mov     r21, r25
        mov     r25, r30
        mov     r30, r31
        clr     r31
        ret
multiply:
        mul     r24, r18
        add     r30, r0
        adc     r31, r1
        mul     r23, r18
        add     r25, r0
        adc     r30, r1
        brcc    1f
        inc     r31
1:      mul     r22, r18
        add     r21, r0
        adc     r25, r1
        brcc    2f
        adiw    r30, 1
2:      ret

real_div:
        mov     r30, r21
        lsl     r30
        or      r30, r20
        or      r30, r19
        or      r30, r18
        breq    by_zero
        rcall   factors
        rcall   negate_exponent
        rcall   next_factor
        rcall   negate_exponent
        subi    r26, 0x100 - BIAS
        sbci    r27, 0xFF
        clr     r0
        inc     r0
        rcall   3f                      ; the first bit without a shift
        rcall   divide_on
        rcall   divide_on
        swap    r0                      ; two more bits are enough
        lsl     r0
        lsl     r0
        rcall   divide_on
        andi    r21, 3
        swap    r21
        lsl     r21
        lsl     r21
        or      r22, r23
        or      r22, r24
        rjmp    take_result
; More bits of the quotient r31:r30:r25:r21: as many as there are from the one in r0 to the left end.
divide_on:
        mov     r31, r30
        mov     r30, r25
        mov     r25, r21
        mov     r21, r0                 ; they are collected inverted
1:      lsl     r22
        rol     r23
        rol     r24
        brcs    4f                      ; the remainder has 25 bits
2:      cp      r22, r18
        cpc     r23, r19
        cpc     r24, r20
        brcs    5f
4:      sub     r22, r18
        sbc     r23, r19
        sbc     r24, r20
        clc
5:      rol     r21
        brcc    1b
        com     r21
        ret
3:      mov     r21, r0
        rjmp    2b
by_zero:
        ldi     r19, 1 << DIVISION_BY_ZERO
        sec
        ret

negate_exponent:
        com     r27
        neg     r26
        sbci    r27, 0xFF
        ret
