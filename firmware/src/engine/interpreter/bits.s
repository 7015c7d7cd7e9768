; Bits by their packed address, and the memory of edges.

; A bit packed in a word: the bit, then the distance from the start of data memory. Means: plc-vm
; memory.rs bit.
; in: r26 low byte of the word, Y the other
; out: r19 mask, X address, r24 byte there, Z after the word   destroys: -
load_far_bit:
    movw r30, r28
    lpm r27, Z+
; in: X the word   out: r19 mask, X address, r24 byte there   destroys: -
far_bit:
    ldi r19, 1
    sbrc r26, 1
    ldi r19, 4
    sbrc r26, 0
    lsl r19
    sbrc r26, 2
    swap r19
    lsr r27
    ror r26
    lsr r27
    ror r26
    lsr r27
    ror r26
    inc r27
    rcall check_end
    ld r24, X
    ret

; in: r26 low byte of the word, Y the other
; out: T the bit, r26 and Y at the next operand   destroys: r19, r24, r27, Z
take_far_bit:
    rcall load_far_bit
    and r24, r19
    clt
    breq 1f
    set
1:  movw r28, r30
; in: Y at an operand   out: r26 its first byte, Y after that   destroys: Z
at_operand:
    movw r30, r28
    lpm r26, Z+
    movw r28, r30
    ret

; Means: plc-vm memory.rs set_bit.
; in: T, r26 and Y a packed bit   out: Z after it   destroys: r19, r24, X
assign_second:
    rcall load_far_bit
    or r24, r19
    brts 1f
    eor r24, r19
1:  st X, r24
    ret

; Means: plc-vm edge.rs rose, fell.
; in: r26 number of the edge memory, T
; out: zero flag: it was 0 and this is no first scan; r19 bit 1: this is the first scan
; destroys: r18, r20, r21, X, Z
remember_edge:
    ldi r21, 0
    mov r20, r26
    rcall place_bit
    lds r26, CONTEXT + EDGES_START
    lds r27, CONTEXT + EDGES_START + 1
    add r26, r30
    adc r27, r1
    rcall check_end
    ld r20, X
    mov r21, r20
    or r21, r18
    brts 1f
    eor r21, r18
1:  st X, r21
    ldi r27, 1
    lds r19, SYSTEM_BITS
    and r20, r18
    sbrc r19, FIRST_SCAN
    or r20, r18
    tst r20
    ret

; ---- comparisons
