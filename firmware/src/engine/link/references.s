; References: what an operand in a request names, and where it is.

; The place that a reference names. Means: plc-link place.rs resolve.
; in: Z reference, r15:r14 what it may name
; out: r25:r24 place, r20 its size, r21 its width   destroys: r11, r18, r19, r22, r23, X, Z
reference:
    ld r24, Z
    ldd r23, Z+1
    ldd r22, Z+2
    mov r20, r24
    andi r20, 0x0F
    swap r24
    andi r24, 0x0F
    mov r11, r24
    cpi r20, 11
    brsh bad_reference
    ldi r21, 1
    cpi r20, 9
    brlo 1f
    ldi r21, 2
    breq 1f
    ldi r21, 4
1:  sbrc r23, 7
    rjmp bad_reference
    cpi r24, 3
    brne 1f
    cpi r22, 32
    cpc r23, r1
    brlo paged
    ; Special memory behind the bit page.
    ori r23, 0x80
    rjmp in_v
1:  cpi r24, 8
    breq in_v
    brsh second_page
    cpi r24, 5
    breq numbered
    cpi r24, 6
    breq numbered
; in: r24 area of the bit page, r23:r22 number, r21 width   out: as reference
paged:
    tst r23
    brne bad_reference
    rcall page_start
    add r30, r22
    add r22, r21
    brcs bad_reference
    cp r25, r22
    brlo bad_reference
; in: r30 low byte of the address, r20 size, r11 area   out: as reference
in_page:
    ldi r31, 1
    rjmp placed
; in: -   ends: the answer is exception 2
bad_reference:
    rjmp refuse_address
; Areas after the bit page. Means: plc-link place.rs second_page.
; in: r24 area, r23:r22 number, r20 size, r21 width, r11   out: as reference
second_page:
    cpi r24, 10
    brsh bad_reference
    tst r23
    brne bad_reference
    cpi r22, 52
    brsh bad_reference
    ldi r25, 9
    cpi r22, 12
    brlo 1f
    inc r11
    cpi r22, 24
    brlo 1f
    inc r11
    ldi r25, 10
    cpi r22, 40
    brlo 1f
    inc r11
    cpi r22, 48
    brlo 1f
    inc r11
    ldi r25, 9
1:  cp r20, r25
    brne bad_reference
    mov r24, r21
    dec r24
    and r24, r22
    brne bad_reference
    mov r30, r22
    ldi r31, 2
    rjmp placed
; in: r23:r22 number, r21 width, r20, r11   out: as reference
in_v:
    rcall v_address
    movw r30, r26
    rjmp placed
; Timers and counters: bits, or current values.
; in: r24 area, r22 number, r20 size, r11   out: as reference
numbered:
    tst r23
    brne bad_reference
    cpi r20, 9
    breq 1f
    tst r20
    brne bad_reference
    rcall page_start
    mov r20, r22
    andi r20, 7
    lsr r22
    lsr r22
    lsr r22
    add r30, r22
    ldi r24, 14
    mov r11, r24
    rjmp in_page
1:  ldi r20, 5
    cpi r24, 5
    breq 1f
    ldi r20, 3
1:  rcall value_address
    movw r30, r26
    ldi r20, 9
; Whether the area may be named.
; in: Z address, r20 size, r11 number of the area in the mask r15:r14   out: as reference
placed:
    movw r18, r14
    rjmp 2f
1:  lsr r19
    ror r18
2:  dec r11
    brpl 1b
    sbrs r18, 0
    rjmp bad_reference
    movw r24, r30
    mov r18, r20
    swap r18
    or r25, r18
    ret

; Where an area of the bit page begins. Means: plc-link place.rs page_start, page_len.
; in: r24 area   out: r30 low byte of its address, r25 its bytes   destroys: r0
page_start:
    mov r30, r24
    ldi r25, 16
    cpi r24, 2
    brlo 1f
    dec r30
    ldi r25, 32
1:  mul r30, r25
    mov r30, r0
    clr r1
    cpi r24, 7
    brne 1f
    ldi r25, 64
1:  ret

; V memory that lies in one range. Means: plc-link place.rs v_address.
; in: r23:r22 number of the first byte, r21 bytes   out: X data address
; destroys: r18, r19, r24, r25, Z
v_address:
    lds r24, V_TABLE
    lds r25, V_TABLE + 1
    lds r18, TIMERS_TABLE
    lds r19, TIMERS_TABLE + 1
    ; Ranges before r24 and r25 begin at the number or before, those from r18 and r19 on after it.
1:  movw r30, r18
    sub r30, r24
    sbc r31, r25
    breq 3f
    lsr r31
    ror r30
    andi r30, 256 - V_RANGE_LEN
    add r30, r24
    adc r31, r25
    lpm r26, Z+
    lpm r27, Z+
    cp r22, r26
    cpc r23, r27
    brlo 2f
    adiw r30, V_RANGE_LEN - 2
    movw r24, r30
    rjmp 1b
2:  sbiw r30, 2
    movw r18, r30
    rjmp 1b
3:  lds r18, V_TABLE
    lds r19, V_TABLE + 1
    cp r24, r18
    cpc r25, r19
    breq bad_value_reference
    ; The range begins where the one before it ends.
    movw r30, r24
    sbiw r30, V_RANGE_LEN + 2
    lpm r26, Z+
    lpm r27, Z+
    cp r30, r18
    cpc r31, r19
    brne 4f
    ldi r26, 0
    ldi r27, 0
4:  lpm r24, Z+
    lpm r25, Z+
    movw r18, r22
    sub r18, r24
    sbc r19, r25
    lpm r24, Z+
    lpm r25, Z
    add r18, r26
    adc r19, r27
    movw r26, r18
    sub r24, r18
    sbc r25, r19
    brcs bad_value_reference
    cp r24, r21
    cpc r25, r1
    brlo bad_value_reference
    subi r26, lo8(-(ARENA_START))
    sbci r27, hi8(-(ARENA_START))
    ret
; in: -   ends: the answer is exception 2
bad_value_reference:
    rjmp refuse_address

; The current value of a timer or counter. Means: plc-link place.rs value_address.
; in: r22 number, r20 5 for timers, 3 for counters: the bytes of a slot   out: X data address
; destroys: r0, r18, r19, r23-r25, Z
value_address:
    ldi r30, lo8(TIMERS_TABLE)
    ldi r31, hi8(TIMERS_TABLE)
    sbrs r20, 2
    adiw r30, 2
    ld r24, Z
    ldd r25, Z+1
    ldd r18, Z+2
    ldd r19, Z+3
    ldd r26, Z+6
    ldd r27, Z+7
    push r24
    push r25
    ; Entries before r24 and r25 are of lower numbers, those from r18 and r19 on of higher ones.
1:  movw r30, r18
    sub r30, r24
    sbc r31, r25
    breq bad_value_reference
    lsr r31
    ror r30
    sbrc r20, 2
    andi r30, 0xFE
    add r30, r24
    adc r31, r25
    lpm r23, Z
    cp r22, r23
    breq 3f
    brlo 2f
    adiw r30, 1
    sbrc r20, 2
    adiw r30, 1
    movw r24, r30
    rjmp 1b
2:  movw r18, r30
    rjmp 1b
3:  ; As many entries are before it.
    pop r19
    pop r18
    sub r30, r18
    sbc r31, r19
    sbrs r20, 2
    rjmp 4f
    lsr r31
    ror r30
4:  mul r30, r20
    add r26, r0
    adc r27, r1
    clr r1
    ret
