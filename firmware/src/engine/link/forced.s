; What modules are told of forced points: for immediate access.

; void uno200_tell_forces(): the forced bits of IB0 and QB0 and their values, found by what forces
; make of no bits and of all.
; in: -   out: -   destroys: r18-r20, r22-r25, X, Z
    .global uno200_tell_forces
uno200_tell_forces:
    push r28
    push r29
    ldi r28, lo8(I_START)
    ldi r29, hi8(I_START)
    ld r24, Y
    push r24
    ldd r24, Y + Q_START - I_START
    push r24
    st Y, r1
    std Y + Q_START - I_START, r1
    rcall line_apply_forces
    ld r22, Y
    ldd r23, Y + Q_START - I_START
    ldi r24, 0xFF
    st Y, r24
    std Y + Q_START - I_START, r24
    rcall line_apply_forces
    ld r24, Y
    eor r24, r22
    com r24
    sts FORCED_POINTS, r24
    sts FORCED_POINTS + 1, r22
    ldd r24, Y + Q_START - I_START
    eor r24, r23
    com r24
    sts FORCED_POINTS + 2, r24
    sts FORCED_POINTS + 3, r23
    pop r24
    std Y + Q_START - I_START, r24
    pop r24
    st Y, r24
    pop r29
    pop r28
    ret
