; Results of words: OUT and SMB1.

; A result that wrapped around, or did not. Means: plc-vm math.rs write_wrapped.
; in: r25:r24 result, overflow flag, X low byte of OUT, Z the next instruction
; ends: goes on there
write_wrapped:
    st X, r24
    st -X, r25
    ldi r19, 0
    brvc write_status
    ldi r19, 0x02
    rjmp write_status
; A result; OUT stays as it is when it does not fit. Means: plc-vm math.rs write_result.
; in: as write_wrapped   ends: as there
write_result:
    brvs overflow
    st X, r24
    st -X, r25
    ldi r19, 0
; Means: plc-vm math.rs write_status.
; in: r25:r24 result, r19 SM1.1 in its place, Z the next instruction   ends: goes on there
write_status:
    or r24, r25
    brne 1f
    ori r19, 0x01
1:  sbrc r25, 7
    ori r19, 0x04
    lds r24, RESULT_BITS
    andi r24, 0xF8
    or r24, r19
    sts RESULT_BITS, r24
; As next_z_x, nearer to those who go here.
; in: Z the next instruction   ends: goes on there
next_z_x_too:
    ldi r27, 1
    NEXT_Z

; in: Z the next instruction   ends: goes on there; OUT is not written
overflow:
    ldi r18, 0xF8
    ldi r19, 0x02
; in: r19 bits of SMB1, r18 the others that stay, Z the next instruction   ends: goes on there
write_bits:
    lds r24, RESULT_BITS
    and r24, r18
    or r24, r19
    sts RESULT_BITS, r24
    rjmp next_z_x
