; Function 65: what this is and how it is.

; Means: plc-link service.rs identify.
; in: -   ends: the answer
identify:
    ldi r24, 1
    rcall expect_len
    movw r30, r28
    adiw r30, 1
    st Z+, r24
    ldi r24, CAPABILITIES
    st Z+, r24
    ldi r26, lo8(STATE)
    ldi r27, hi8(STATE)
    ld r24, X+
    lds r25, FORCES
    cpse r25, r1
    ori r24, 4
    st Z+, r24
    ldi r25, 8
1:  ld r24, X+
    st Z+, r24
    dec r25
    brne 1b
    st Z+, r1
    ldi r24, COUNTS_PER_MS
    st Z+, r24
    ldi r18, 4
    rcall high_first
    rcall high_first
    rcall high_first
    rcall high_first
    ldi r18, 2
    rcall high_first
    st Z+, r1
    lds r24, ROOM
    st Z+, r24
    rcall high_first
    ; The checksum ends the image, its low byte first.
    ld r25, -X
    ld r24, -X
    movw r26, r30
    movw r30, r24
    or r24, r25
    breq 1f
    subi r30, lo8(-(SLOT_START))
    sbci r31, hi8(-(SLOT_START))
1:  ldi r18, 4
2:  sbiw r30, 1
    lpm r19, Z
    cpse r24, r1
    rjmp 3f
    ldi r19, 0
3:  st X+, r19
    dec r18
    brne 2b
    movw r30, r26
    rjmp done_at_z

; in: X number, its low byte first, r18 its bytes, Z   out: Z after it, X too   destroys: r0, r19
high_first:
    add r26, r18
    adc r27, r1
    mov r19, r18
1:  ld r0, -X
    st Z+, r0
    dec r19
    brne 1b
    add r26, r18
    adc r27, r1
    ret
