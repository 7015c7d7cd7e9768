; Modbus: values from data memory to the frame and back.

; Means: plc-link modbus.rs copy_words, clear_missing_inputs.
; in: X, Z from and to, r20, r21 bytes from one word to the next, r22 how many, T: from analog
;   inputs, of which there are six   out: Z after the last   destroys: r20-r22, r24, r25, X
copy_words:
    brts 2f
    cpse r20, r21
    rjmp 2f
    ; Many can lie side by side.
1:  ld r24, X+
    ld r25, X+
    st Z+, r24
    st Z+, r25
    dec r22
    brne 1b
    ret
2:  dec r20
    dec r21
3:  ld r24, X+
    ld r25, X
    brtc 4f
    cpi r26, lo8(AIN_START)
    brlo 4f
    ldi r24, 0
    ldi r25, 0
4:  st Z+, r24
    st Z, r25
    add r26, r20
    adc r27, r1
    add r30, r21
    adc r31, r1
    dec r22
    brne 3b
    ret

; The rest of the last byte is 0. Means: plc-link modbus.rs read_bits.
; in: X from, r20 place of the first bit, r23:r22 how many, Z to
; out: Z after the last   destroys: r0, r18, r19, r21-r25, X
read_bits:
    ld r24, X+
1:  ld r25, X+
    movw r18, r24
    mov r0, r20
    rjmp 3f
2:  lsr r19
    ror r18
3:  dec r0
    brpl 2b
    rcall last_bits
    and r18, r21
    st Z+, r18
    mov r24, r25
    subi r22, 8
    sbci r23, 0
    brcs 4f
    mov r0, r22
    or r0, r23
    brne 1b
4:  ret

; Means: plc-link modbus.rs write_bits.
; in: X bytes, r23:r22 bits, Z to, r20 place of the first bit
; out: -   destroys: r0, r18-r24, X, Z
line_write_bits:
    mov r0, r20
    ldi r20, 1
    rjmp 2f
1:  lsl r20
2:  dec r0
    brpl 1b
3:  ld r24, X+
    rcall last_bits
    and r24, r21
    mul r21, r20
    movw r18, r0
    com r18
    com r19
    mul r24, r20
    ld r24, Z
    and r24, r18
    or r24, r0
    st Z+, r24
    ld r24, Z
    and r24, r19
    or r24, r1
    st Z, r24
    clr r1
    subi r22, 8
    sbci r23, 0
    brcs 4f
    mov r0, r22
    or r0, r23
    brne 3b
4:  ret

; Means: plc-link modbus.rs mask.
; in: r23:r22 bits that are left   out: r21 those of the next byte   destroys: r0
last_bits:
    ldi r21, 0xFF
    cpi r22, 8
    cpc r23, r1
    brsh 2f
    mov r0, r22
    ldi r21, 0
1:  sec
    rol r21
    dec r0
    brne 1b
2:  ret
