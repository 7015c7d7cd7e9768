; Function 66: STOP, RUN, single scans.

; Means: plc-link service.rs control.
; in: -   ends: the answer, and COMMAND
control:
    ldi r24, 4
    rcall expect_len
    ldd r24, Y+1
    ldd r23, Y+2
    ldd r22, Y+3
    lds r25, STATE
    cpi r24, 3
    brsh 1f
    cpi r24, 1
    breq 2f
    rjmp 3f
1:  brne bad_value
    cp r22, r1
    cpc r23, r1
    breq bad_value
    sbrc r25, 0
    rjmp refuse_busy
2:  sbrs r25, 1
    rjmp refuse_busy
3:  sts SCANS_WANTED, r22
    sts SCANS_WANTED + 1, r23
    sts COMMAND, r24
    ldi r24, 4
    rjmp done
; in: -   ends: the answer is exception 3
bad_value:
    rjmp refuse_value
