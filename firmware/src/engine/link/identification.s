; Function 43: who answers.

; Means: plc-link identity.rs answer.
; in: -   ends: the answer
identification:
    ldd r24, Y+1
    cpi r24, 14
    breq 1f
    rjmp refuse_function
1:  ldi r24, 4
    rcall expect_len
    ; r20 and r21: the first and the last object asked for.
    ldd r18, Y+2
    ldd r20, Y+3
    ldi r21, 2
    cpi r18, 1
    brlo wrong_code
    breq 1f
    ldi r21, 6
    cpi r18, 4
    brlo 1f
    brne wrong_code
    mov r21, r20
    rjmp 2f
1:  cpi r20, 3
    brlo 2f
    cpi r20, 6
    breq 2f
    ldi r20, 0
2:  ldi r24, 0x82
    std Y+3, r24
    std Y+4, r1
    std Y+5, r1
    movw r26, r28
    adiw r26, 7
    ldi r19, 0
3:  rcall object
    cp r20, r21
    inc r20
    brlo 3b
    tst r19
    breq no_object
    std Y+6, r19
    movw r30, r26
    rjmp done_at_z
; in: -   ends: the answer is exception 2
no_object:
    rjmp refuse_address
; in: -   ends: the answer is exception 3
wrong_code:
    rjmp refuse_value

; Means: plc-link identity.rs put_object.
; in: X, r20 number of an object, r19   out: X after the object, r19 one more, if it is there
; destroys: r0, r18, r22-r25, Z
object:
    ldi r30, lo8(texts)
    ldi r31, hi8(texts)
    mov r18, r20
    ldi r24, 0xFF
    cpi r20, 3
    brlo 2f
    cpi r20, 6
    brne 4f
    lds r30, NAME_AT
    lds r31, NAME_AT + 1
    lds r24, NAME_LEN
    tst r24
    breq 4f
    rjmp 3f
1:  lpm r0, Z+
    tst r0
    brne 1b
    dec r18
2:  tst r18
    brne 1b
3:  ; r24: bytes at most. r22 and r23: where the length is.
    inc r19
    st X+, r20
    movw r22, r26
    adiw r26, 1
    ldi r25, 0
1:  lpm r0, Z+
    tst r0
    breq 2f
    st X+, r0
    inc r25
    cp r25, r24
    brne 1b
2:  movw r30, r22
    st Z, r25
4:  ret

; Objects 0 to 2.
texts:
    .asciz "uno200"
    .asciz "Arduino Uno"
    VERSION_TEXT
    .balign 2
