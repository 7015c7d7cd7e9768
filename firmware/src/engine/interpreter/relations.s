; Comparisons that are small rather than fast.

; Compares and combines with the stack. Means: plc-vm interpreter.rs words, bytes.
; in: r18 6 for each way to combine (push, AND, OR) and 1 for each relation, r25:r24 IN1,
;   r23:r22 IN2, Z the next instruction   ends: goes on there
combine:
    clr r19
1:  cpi r18, 6
    brlo 2f
    subi r18, 6
    inc r19
    rjmp 1b
2:  cpi r18, 2
    brlo 4f
    ; > and <= are < and >= with the operands exchanged.
    cpi r18, 3
    breq 3f
    cpi r18, 4
    brne 4f
3:  movw r20, r24
    movw r24, r22
    movw r22, r20
4:  cp r24, r22
    cpc r25, r23
    in r20, SREG
    ; Bit 0 of r20: equal, or less.
    cpi r18, 2
    brsh 5f
    lsr r20
    rjmp 6f
5:  swap r20
6:  cpi r18, 1
    breq 7f
    cpi r18, 4
    brlo 8f
7:  com r20
8:  tst r19
    brne 9f
    lsl r16
    bld r16, 0
    bst r20, 0
    rjmp next_z_x_too
9:  dec r19
    brne 1f
    sbrs r20, 0
    clt
    rjmp next_z_x_too
1:  sbrc r20, 0
    set
    rjmp next_z_x_too
