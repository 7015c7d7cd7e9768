; Comparisons: their operands.

; in: r26 low byte of the address of IN1, Y the rest, as many bytes as two words
; out: flags of IN1 less IN2, Z after the operands   destroys: r20-r25, r26
compare_words_straight:
    COMPARE_WORDS straight
    ret

; in: as compare_words_straight   out: flags of IN2 less IN1   destroys: as there
compare_words_swapped:
    COMPARE_WORDS swapped
    ret

; The same with a constant as IN2.
; in: r26, Y   out: flags of IN1 less IN2, Z after the operands   destroys: r22-r25, r26
compare_constant_straight:
    COMPARE_CONSTANT straight
    ret

; in: as compare_constant_straight   out: flags of IN2 less IN1   destroys: as there
compare_constant_swapped:
    COMPARE_CONSTANT swapped
    ret

; Means: plc-vm interpreter.rs bytes.
; in: r18 as combine, r26 and Y the addresses of two bytes   ends: goes on after them
compare_bytes:
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    ld r24, X
    lpm r26, Z+
    lpm r27, Z+
    READABLE r27
    ld r22, X
    rjmp 1f
; in: r18 as combine, r26 and Y the address of a byte, and a constant   ends: goes on after them
compare_byte_constant:
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    lpm r22, Z+
    ld r24, X
1:  clr r23
    clr r25
    rjmp combine

; The comparisons after the prefix.
; in: r26 their token, Y at the operands   ends: goes on after them
compare_any:
    cpi r26, WIDE_COMPARISONS
    brlo 1f
    rjmp rest
1:  movw r30, r28
    push r26
    cpi r26, WIDE_COMPARISONS / 2
    brsh 2f
    rcall any_int
    movw r22, r24
    rcall any_int
    rjmp 3f
2:  rcall any_byte
    movw r22, r24
    rcall any_byte
3:  ; IN2 was read last.
    movw r20, r24
    movw r24, r22
    movw r22, r20
    pop r18
    cpi r18, WIDE_COMPARISONS / 2
    brlo 4f
    subi r18, WIDE_COMPARISONS / 2
4:  rjmp combine
