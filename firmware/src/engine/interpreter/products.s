; Products and quotients.

; in: r26, Y addresses of IN1 and OUT
; out: r23:r22 IN1, r25:r24 OUT, X its low byte, Z after them   destroys: -
word_box:
    WORD_BOX 1f
    ret
; in: r26, Y IN1 and the address of OUT   out: as word_box   destroys: -
constant_box:
    CONSTANT_BOX 1f
    ret
1:  rjmp outside_afar

; OUT := OUT * IN1. Means: plc-vm instructions.rs mul_int.
; in: as word_box gives   ends: goes on at Z
multiply:
    push r27
    clr r27
    movw r20, r24
    muls r21, r23
    movw r24, r0
    mul r20, r22
    movw r18, r0
    mulsu r21, r22
    sbc r25, r27
    add r19, r0
    adc r24, r1
    adc r25, r27
    mulsu r23, r20
    sbc r25, r27
    add r19, r0
    adc r24, r1
    adc r25, r27
    clr r1
    pop r27
    ; It fits when the upper half is the sign of the lower one.
    clr r20
    sbrc r19, 7
    com r20
    cp r24, r20
    cpc r25, r20
    brne product_overflow
    movw r24, r18
; Means: plc-vm math.rs write_product.
; in: r25:r24 result, X low byte of OUT, Z the next instruction   ends: goes on there
write_product:
    st X, r24
    st -X, r25
    ; SM1.3 belongs to products and quotients.
    lds r19, RESULT_BITS
    andi r19, 0xF7
    sts RESULT_BITS, r19
    ldi r19, 0
    rjmp write_status
; in: Z the next instruction   ends: goes on there; OUT is not written
product_overflow:
    ldi r18, 0xF0
    ldi r19, 0x02
    rjmp write_bits

; OUT := OUT / IN1. Means: plc-vm math.rs divide.
; in: as word_box gives   ends: goes on at Z
divide:
    ldi r18, 0xFF
    ldi r19, 0x08
    mov r20, r22
    or r20, r23
    brne 1f
    rjmp write_bits
    ; The only quotient that does not fit is that of -32768 and -1.
1:  mov r20, r22
    and r20, r23
    com r20
    mov r21, r25
    subi r21, 0x80
    or r20, r21
    or r20, r24
    breq product_overflow
    bld r17, 0
    push r30
    push r31
    push r26
    push r27
    call __divmodhi4
    pop r27
    pop r26
    pop r31
    pop r30
    bst r17, 0
    movw r24, r22
    rjmp write_product
