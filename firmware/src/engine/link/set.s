; Function 72: sets operands, all or none.

; Means: plc-link service.rs set.
; in: -   ends: the answer, or a part of the work on it
set:
    ALLOW WRITABLE
    ldi r24, 16
    rcall expect_entries
    rcall begin
1:  lds r18, LEFT
    lds r19, AT
    tst r18
    breq 2f
    dec r18
    ; Nothing after the request is a reference.
    ldi r24, 3
    add r24, r19
    brcs block_value
    cp r17, r24
    brlo block_value
    movw r30, r28
    add r30, r19
    adc r31, r1
    push r18
    push r19
    push r30
    push r31
    rcall reference
    pop r31
    pop r30
    pop r19
    pop r18
    std Z+1, r24
    std Z+2, r25
    subi r21, -3
    add r19, r21
    brcs block_value
    cp r17, r19
    brlo block_value
    sts LEFT, r18
    sts AT, r19
    rcall next_part
    rjmp 1b
2:  mov r24, r19
    rcall expect_len
    ldd r20, Y+1
    movw r30, r28
    adiw r30, 2
3:  ldd r26, Z+1
    ldd r27, Z+2
    adiw r30, 3
    rcall line_store_value
    dec r20
    brne 3b
    ldi r24, 2
    rjmp done
