; What the line tells of the scans since RUN: how many there were, and how long the shortest, the
; last and the longest took, in timer counts.

.equ SHORTEST, 0
.equ LAST, 4
.equ LONGEST, 8

; A number of counts in r18, r19 and r20, and the other way from r24, r25 and r26.
.macro LOAD_COUNTS at
    ldd r18, Z+\at
    ldd r19, Z+\at + 1
    ldd r20, Z+\at + 2
.endm
.macro STORE_COUNTS at
    std Z+\at, r24
    std Z+\at + 1, r25
    std Z+\at + 2, r26
.endm
; Flags of the first less the second.
.macro COMPARE_COUNTS
    cp r18, r24
    cpc r19, r25
    cpc r20, r26
.endm

; void line_count_scan(): the program has been executed. Means: plc-link station.rs enter.
; in: -   out: -   destroys: r24, Z
    .global line_count_scan
line_count_scan:
    ldi r30, lo8(SCANS)
    ldi r31, hi8(SCANS)
1:  ld r24, Z
    inc r24
    st Z+, r24
    brne 2f
    cpi r30, lo8(SCANS + 4)
    brne 1b
2:  ret

; void line_enter_scan(u8 ms_low, u8 ms_high, u8 counts): a scan is over. No scan takes longer
; than three bytes hold. Means: plc-link station.rs enter, sampling.rs step.
; in: r24, r22 its first millisecond, r20 timer count   out: -   destroys: what C functions may
    .global line_enter_scan
line_enter_scan:
    lds r18, UNO200_TICK
    lds r19, UNO200_TICK + 1
    in r25, TCNT0
    ; Neither the clock nor the timer may have gone on between.
    lds r21, UNO200_TICK
    cp r18, r21
    brne line_enter_scan
    sub r18, r24
    sbc r19, r22
    sub r25, r20
    mov r20, r25
    sbc r21, r21
    ldi r23, COUNTS_PER_MS
    mul r18, r23
    movw r24, r0
    mul r19, r23
    ldi r26, 0
    add r25, r0
    adc r26, r1
    add r24, r20
    adc r25, r21
    adc r26, r21
    clr r1
    ; Less 1, so that 0, for none, is more than any.
    ldi r30, lo8(SCAN_TIMES)
    ldi r31, hi8(SCAN_TIMES)
    LOAD_COUNTS SHORTEST
    subi r18, 1
    sbci r19, 0
    sbci r20, 0
    COMPARE_COUNTS
    brlo 1f
    STORE_COUNTS SHORTEST
1:  STORE_COUNTS LAST
    LOAD_COUNTS LONGEST
    COMPARE_COUNTS
    brsh 2f
    STORE_COUNTS LONGEST
2:  lds r24, TRACE_STATE
    cpi r24, TRACE_WAITING
    brlo 3f
    rjmp trace_step
3:  ret
