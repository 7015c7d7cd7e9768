; Function 67: values of one moment.

; Means: plc-link service.rs watch.
; in: -   ends: the answer, or a part of the work on it
watch:
    ALLOW ANYTHING
    ldi r24, 32
    ldi r25, 3
    rcall expect_list
1:  lds r18, LEFT
    tst r18
    breq gather
    dec r18
    mov r19, r18
    add r19, r19
    add r19, r18
    movw r30, r28
    add r30, r19
    adc r31, r1
    adiw r30, 2
    push r18
    rcall reference
    pop r18
    sts LEFT, r18
    rcall waiting_places
    add r26, r18
    adc r27, r1
    add r26, r18
    adc r27, r1
    st X+, r24
    st X, r25
    rcall next_part
    rjmp 1b

; in: -   out: X where the first place waits, at the end of the room, r20 how many   destroys: r19
waiting_places:
    ldd r20, Y+1
    lds r19, ROOM
    sub r19, r20
    sub r19, r20
    movw r26, r28
    add r26, r19
    adc r27, r1
    ret

; Means: plc-link service.rs gather.
; in: -   ends: the answer
gather:
    rcall waiting_places
    rcall put_scans
1:  ld r30, X+
    ld r31, X+
    movw r24, r28
    adiw r24, 4
    cp r26, r24
    cpc r27, r25
    brlo bad_value
    rcall append_value
    dec r20
    brne 1b
    movw r30, r28
    rjmp done_at_z

; Means: plc-link place.rs bytes_in.
; in: Z place, Y   out: Y after the value, r24 its last byte   destroys: r18, Z
append_value:
    mov r18, r31
    andi r31, 0x0F
    swap r18
    andi r18, 0x0F
    ld r24, Z+
    sbrs r18, 3
    rjmp 4f
    st Y+, r24
    cpi r18, 9
    brlo 2f
    ld r24, Z+
    st Y+, r24
    breq 2f
    ld r24, Z+
    st Y+, r24
    ld r24, Z+
    st Y+, r24
2:  ret
3:  lsr r24
4:  dec r18
    brpl 3b
    andi r24, 1
    st Y+, r24
    ret

; in: Y the function code   out: Y after the scan, which is appended   destroys: r24
put_scans:
    adiw r28, 1
    lds r24, SCANS + 1
    st Y+, r24
    lds r24, SCANS
    st Y+, r24
    ret
