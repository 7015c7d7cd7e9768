; Function 68: forces, and what they do in a scan.

; Means: plc-link service.rs force.
; in: -   ends: the answer, in the next scan when forces have changed
force:
    lds r18, PHASE
    cpse r18, r1
    rjmp list_forces
    ldd r18, Y+1
    cpi r18, 4
    brsh force_value
    ldi r24, 2
    tst r18
    breq 1f
    cpi r18, 3
    breq 1f
    ldi r24, 9
1:  rcall expect_len
    tst r18
    breq list_forces
    cpi r18, 3
    brne 1f
    rcall line_clear_forces
    rjmp tell_forces
; in: -   ends: the answer is exception 3
force_value:
    rjmp refuse_value
1:  ALLOW FORCEABLE
    movw r30, r28
    adiw r30, 2
    rcall reference
    ; r20 of r21 forces are not this one.
    ldi r30, lo8(FORCED)
    ldi r31, hi8(FORCED)
    lds r21, FORCES
    ldi r20, 0
2:  cp r20, r21
    breq 3f
    ld r18, Z
    ldd r19, Z+1
    cp r18, r24
    cpc r19, r25
    breq 3f
    adiw r30, FORCE_LEN
    inc r20
    rjmp 2b
3:  ldd r18, Y+1
    sbrc r18, 1
    rjmp unforce
    cpi r20, FORCES_MAX
    breq force_full
    cpse r20, r21
    rjmp 4f
    inc r21
    sts FORCES, r21
4:  lds r18, SM4
    ori r18, 0x80
    sts SM4, r18
    st Z+, r24
    st Z+, r25
    movw r26, r28
    adiw r26, 2
    ldi r25, 7
    rcall copy_bytes
; They have changed. The list follows at the end of the next scan.
; in: -   ends: the next scan goes on with the answer
tell_forces:
    rcall uno200_tell_forces
    ldi r24, GOES_ON
    sts PHASE, r24
    rjmp not_yet
; Means: plc-link service.rs put_forces.
; in: -   ends: the answer
list_forces:
    movw r30, r28
    adiw r30, 1
    ldi r26, lo8(FORCED)
    ldi r27, hi8(FORCED)
    lds r20, FORCES
    st Z+, r20
    lds r21, ROOM
    add r21, r28
5:  subi r20, 1
    brcs 6f
    mov r24, r21
    sub r24, r30
    cpi r24, 7
    brlo 6f
    adiw r26, 2
    ldi r25, 7
    rcall copy_bytes
    rjmp 5b
6:  rjmp done_at_z

; The last force takes the place of this one. Means: plc-link forces.rs unset.
; in: Z force, r20 its number, r21 how many there are   ends: in tell_forces
unforce:
    cp r20, r21
    breq list_forces
    dec r21
    sts FORCES, r21
    ldi r25, FORCE_LEN
    mul r21, r25
    movw r26, r0
    clr r1
    subi r26, lo8(-(FORCED))
    sbci r27, hi8(-(FORCED))
    rcall copy_bytes
    tst r21
    brne 7f
    rcall line_clear_forces
    rjmp tell_forces
7:  rcall release_inputs
    rjmp tell_forces
; in: -   ends: the answer is exception 4
force_full:
    rjmp refuse_busy

; in: X from, Z to, r25 how many   out: X, Z after them   destroys: r0, r25
copy_bytes:
    ld r0, X+
    st Z+, r0
    dec r25
    brne copy_bytes
    ret

; void line_clear_forces(): ends all forces. Means: plc-link forces.rs clear.
; in: -   out: -   destroys: r24, X
    .global line_clear_forces
line_clear_forces:
    lds r24, FORCES
    tst r24
    breq 2f
    sts FORCES, r1
    lds r24, SM4
    andi r24, 0x7F
    sts SM4, r24
; Nothing but a force and the program writes inputs that the board does not have. Means: plc-link
; forces.rs release_inputs.
; in: -   out: -   destroys: r24, X
release_inputs:
    ldi r26, lo8(I_START + 1)
    ldi r27, hi8(I_START + 1)
    ldi r24, 15
1:  st X+, r1
    dec r24
    brne 1b
2:  ret

; void line_apply_forces(): gives forced operands their values. Means: plc-link forces.rs apply.
; in: -   out: -   destroys: r18-r20, r24, r25, X, Z
    .global line_apply_forces
line_apply_forces:
    lds r20, FORCES
    ldi r30, lo8(FORCED)
    ldi r31, hi8(FORCED)
    rjmp 3f
1:  ld r26, Z
    ldd r27, Z+1
    ; The value ends the entry: four bytes of it, two or one.
    adiw r30, 5
    mov r18, r27
    swap r18
    andi r18, 0x0F
    cpi r18, 10
    breq 2f
    adiw r30, 2
    cpi r18, 9
    breq 2f
    adiw r30, 1
2:  rcall line_store_value
3:  subi r20, 1
    brcc 1b
    ret

; Means: plc-link forces.rs apply, service.rs set_value.
; in: X place, Z value   out: Z after it   destroys: r18, r19, r24, r25, X
line_store_value:
    mov r18, r27
    andi r27, 0x0F
    swap r18
    andi r18, 0x0F
    ld r24, Z+
    sbrs r18, 3
    rjmp 2f
    st X+, r24
    cpi r18, 9
    brlo 1f
    ld r24, Z+
    st X+, r24
    breq 1f
    ld r24, Z+
    st X+, r24
    ld r24, Z+
    st X+, r24
1:  ret
2:  ldi r25, 1
    rjmp 4f
3:  lsl r25
4:  dec r18
    brpl 3b
    ld r19, X
    or r19, r25
    sbrs r24, 0
    eor r19, r25
    st X, r19
    ret
