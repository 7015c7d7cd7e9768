; Modbus: functions 1 to 6, 15, 16 and 23.

; Means: plc-link modbus.rs answer. T: it is about bits. r15: bytes to read. r14: what is looked for
; is to be written. r11: where the values to write are.
; in: r16 function   ends: the answer
modbus:
    set
    cpi r16, 3
    brlo 1f
    cpi r16, 5
    breq 1f
    cpi r16, 15
    breq 1f
    clt
1:  lds r24, PHASE
    cpi r24, NEW
    brne 4f
    rcall said_of_written
    ldi r25, 3
    ldi r24, 5
    cpi r16, 7
    brlo 2f
    rcall byte_count
    ldd r18, Z+5
    cp r18, r24
    brne wrong_value
    ldi r25, 6
    cpi r16, 23
    brne 1f
    ldi r25, 10
1:  add r24, r25
    brcc 3f
; in: -   ends: the answer is exception 3
wrong_value:
    rjmp refuse_value
2:  cpi r16, 5
    brne 3f
    tst r22
    brne wrong_value
    inc r23
    cpi r23, 2
    brsh wrong_value
3:  mov r11, r25
    rcall expect_len
    cpi r16, 23
    breq 4f
    cpi r16, 5
    brsh 5f
4:  ldd r22, Y+4
    ldd r23, Y+3
    rcall byte_count
    mov r15, r24
    subi r24, -2
    lds r25, ROOM
    cp r25, r24
    brlo wrong_value
    cpi r16, 23
    brne read
    lds r24, PHASE
    cpi r24, NEW
    brne read
    ; Both are looked for before anything is written.
    rcall find_read
5:  rcall find_written
    movw r30, r26
    movw r26, r28
    add r26, r11
    adc r27, r1
    brtc 1f
    rcall line_write_bits
    rjmp 2f
1:  mov r21, r20
    ldi r20, 2
    rcall copy_words
2:  ldi r24, 5
    cpi r16, 23
    brne 3f
    ; It is read when there is time again.
    sts PHASE, r24
    rjmp not_yet
; in: as modbus, when nothing is left to write   ends: the answer
read:
    rcall find_read
    movw r30, r28
    adiw r30, 2
    brtc 1f
    rcall read_bits
    rjmp 2f
1:  ldi r21, 2
    cpi r16, 4
    brne 1f
    set
1:  rcall copy_words
2:  std Y+1, r15
    mov r24, r15
    subi r24, -2
3:  rjmp done

; Means: plc-link modbus.rs byte_count.
; in: r23:r22 bits or registers, T   out: r24 their bytes   destroys: r18, r25
byte_count:
    movw r24, r22
    sbiw r24, 1
    brts 1f
    ; 125 registers at most.
    cpi r24, 125
    cpc r25, r1
    brsh too_long
    mov r24, r22
    lsl r24
    ret
1:  ; 2000 bits at most.
    ldi r18, hi8(2000)
    cpi r24, lo8(2000)
    cpc r25, r18
    brsh too_long
    adiw r24, 8
    lsr r25
    ror r24
    lsr r25
    ror r24
    lsr r25
    ror r24
    ret

; in: -   ends: the answer is exception 3
too_long:
    rjmp refuse_value

; What a request says of the values to write.
; in: r16 function   out: Z the byte before, r23:r22 their number   destroys: -
said_of_written:
    movw r30, r28
    cpi r16, 23
    brne 1f
    adiw r30, 4
1:  ldd r22, Z+4
    ldd r23, Z+3
    ret
