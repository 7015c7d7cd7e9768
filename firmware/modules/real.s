; Module 1, real: +R -R *R /R, DTR ROUND TRUNC and the comparisons of reals, bit for bit as
; plc/vm/src/real.rs. IEEE single, rounded to nearest even, denormals included. No functions
; (function.s) and no texts.
;
; Other modules reach the entries real_..., which are no instructions, through the jump table. It
; must have them after the routines, in this order (entries 10 to 17):
;   real_add real_sub real_mul real_div real_from_int real_to_int real_from_fraction real_result
; Arithmetic: first operand r25:r22, second r21:r18, result r25:r22. Changes r18-r27, r30, r31, r0
; and T; r1 = 0. Carry set: no result, because an operand or the result is infinite or not a number;
; r19 then has the bit for SMB1.

.include "interface.inc"
.include "real.inc"

; The exponent of what is infinite or not a number.
.equ INFINITE, 255
; The number of LoadReal; AndReal and OrReal follow.
.equ LOAD_REAL, 7

    OPERANDS
    STUB read_double, READ + 4
    STUB target_double, WRITE + 4
    STUB compared_double, COMPARE + READ + 4

; ---- routines

; Arithmetic of reals. Means: plc-vm modules/real.rs combine_reals, multiply_or_divide.
; in: IN1, OUT   ends: OUT := OUT op IN1, as write_result
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

; Ends an instruction of another module. Means: plc-vm modules/real.rs finish_real.
; in: r20 bit 0: there is no result, bits of SMB1 in r19 say why; r25:r22 result, r18 the bits of
;   SMB1 that stay, the address of OUT on the stack, its high byte on top   ends: as write_result
real_result:
        lsr     r20
; in: carry: there is no result, the rest as real_result
; ends: with the result, SM1.0 and SM1.2 of it; or with the bits r19 of SMB1, ENO 0
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
; in: r19 bits of SMB1 that become 1, r18 bits that stay   ends: with SMB1
write_bits:
        lds     r30, RESULT_BITS
        and     r30, r18
        or      r30, r19
        sts     RESULT_BITS, r30
; in: -   ends: with power flow
done:
        set
        DONE

; Division by zero leaves the others of SMB1.
; in: r19 bits of SMB1, r18 bits that stay   ends: ENO := 0, as write_bits
no_result:
        sts     ENO, r1
        sbrc    r19, DIVISION_BY_ZERO
        ldi     r18, 0xFF
        rjmp    write_bits

; The real nearest to an integer. Means: plc-vm modules/convert.rs convert.
; in: IN, OUT   ends: OUT := real
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

; The integer nearest to a real, or without its fraction: the number of ROUND is odd. Means: plc-vm
; modules/convert.rs real_to_double.
; in: IN, OUT   ends: OUT := integer, or SM1.1
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

; in: X address, r25:r22 value   out: X after it   destroys: -
store:
        st      X+, r25
        st      X+, r24
        st      X+, r23
        st      X+, r22
        ret

; Compares reals, and loads the result or combines it. Means: plc-vm modules/compare.rs
; compare_reals.
; in: relation, IN1, IN2   ends: as RELATE
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

; Makes of a real an integer of the same order, and exchanges it with the other one. Ends RUN when
; it is not a number. Means: plc-vm real.rs compare.
; in: r25:r22 real, r21:r18 the other one   out: r21:r18 integer, r25:r22 the other one
; destroys: r27, Z
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
; in: r25:r22, r21:r18   out: r21:r18, r25:r22 exchanged   destroys: Z
exchange:
        movw    r30, r22
        movw    r22, r18
        movw    r18, r30
        movw    r30, r24
        movw    r24, r20
        movw    r20, r30
        ret

; A comparison has no ENO.
; in: -   ends: RUN, with FAULT_REAL
not_a_number:
        pop     r0
        pop     r0
        pop     r0
        ldi     r24, FAULT_REAL
        jmp     MODULE_FAULT

; in: r25:r22 a number   out: r25:r22 with the other sign   destroys: -
negate:
        NEGATE  r25, r24, r23, r22
        ret

.include "real_sum.inc"
.include "real_product.inc"
