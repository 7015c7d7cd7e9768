; Function 71: bytes of the program slot or of the trace.

; Means: plc-link service.rs read_block.
; in: -   ends: the answer
read_block:
    ldi r24, 5
    rcall expect_len
    ldd r20, Y+4
    tst r20
    breq block_value
    cpi r20, 65
    brsh block_value
    lds r24, ROOM
    subi r24, 2
    cp r24, r20
    brlo block_value
    ldd r25, Y+2
    ldd r24, Y+3
    ldi r22, lo8(SLOT_LEN)
    ldi r23, hi8(SLOT_LEN)
    ldd r21, Y+1
    cpi r21, 2
    brsh block_address
    sbrs r21, 0
    rjmp 1f
    lds r22, RING_END
    lds r23, RING_END + 1
    rcall ring_start
    sub r22, r30
    sbc r23, r31
1:
    ; r22 and r23: bytes from there to the end.
    sub r22, r24
    sbc r23, r25
    brcs block_address
    cp r22, r20
    cpc r23, r1
    brlo block_address
    movw r26, r28
    adiw r26, 1
    st X+, r20
    add r30, r24
    adc r31, r25
    sbrc r21, 0
    rjmp 3f
    movw r30, r24
    subi r30, lo8(-(SLOT_START))
    sbci r31, hi8(-(SLOT_START))
2:  lpm r0, Z+
    st X+, r0
    dec r20
    brne 2b
    rjmp block_end
3:  ld r0, Z+
    st X+, r0
    dec r20
    brne 3b
; in: X after the last byte   ends: the answer is complete
block_end:
    movw r30, r26
    rjmp done_at_z
; in: -   ends: the answer is exception 3
block_value:
    rjmp refuse_value
; in: -   ends: the answer is exception 2
block_address:
    rjmp refuse_address

; in: -   out: Z data address of the memory for a trace   destroys: -
ring_start:
    lds r30, RING
    lds r31, RING + 1
    ret
