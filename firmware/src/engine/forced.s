; void uno200_tell_forces(): tells modules what is forced of IB0 and QB0, the bits and their values, for immediate
; access: it is found by what forces make of no bits and of all.
    .global uno200_tell_forces
uno200_tell_forces:
    lds r24, I_START
    push r24
    lds r24, Q_START
    push r24
    sts I_START, r1
    sts Q_START, r1
    rcall line_apply_forces
    lds r24, I_START
    sts FORCED_POINTS + 1, r24
    lds r24, Q_START
    sts FORCED_POINTS + 3, r24
    ldi r24, 0xFF
    sts I_START, r24
    sts Q_START, r24
    rcall line_apply_forces
    lds r24, I_START
    lds r25, FORCED_POINTS + 1
    eor r24, r25
    com r24
    sts FORCED_POINTS, r24
    lds r24, Q_START
    lds r25, FORCED_POINTS + 3
    eor r24, r25
    com r24
    sts FORCED_POINTS + 2, r24
    pop r24
    sts Q_START, r24
    pop r24
    sts I_START, r24
    ret
