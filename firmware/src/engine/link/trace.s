; Function 70: values of many scans, around a trigger

; The memory of a trace lies after the frame: these, as docs/protocol.md has them, then the places
; of the values, then the samples. Words have the high byte first, places the low one.
.equ TRACE_EVERY, 0
.equ TRACE_BEFORE, 2
.equ TRACE_KIND, 4
.equ TRACE_TRIGGER, 5
.equ TRACE_VALUES, 8
.equ TRACE_WAS_ACTIVE, 9
.equ TRACE_SAMPLE_LEN, 10
.equ TRACE_WAIT, 11
.equ TRACE_CAPACITY, 13
.equ TRACE_SAMPLES, 15
.equ TRACE_TRIGGERED_AT, 17
.equ TRACE_SCAN, 19
.equ TRACE_FIRST, 21
.equ TRACE_NEXT, 23
.equ TRACE_HEAD_LEN, 25

.equ TRACE_DONE, 1
.equ TRACE_WAITING, 2
.equ TRACE_FILLING, 3

.equ TRIGGERED_BY_LEVEL, 3
.equ TRIGGERS, 5

; Actions.
.equ START_TRACE, 1
.equ STOP_TRACE, 2
; Where a request to start one has its parts.
.equ ASKED_EVERY, 2
.equ ASKED_BEFORE, 4
.equ ASKED_KIND, 6
.equ ASKED_TRIGGER, 7
.equ ASKED_COUNT, 10
.equ ASKED_VALUES, 11
.equ TRACE_VALUES_MAX, 8

; A word as requests and the trace's memory have it.
.macro LOAD_WORD low, high, at
    ldd \high, \at
    ldd \low, \at + 1
.endm
.macro STORE_WORD at, low, high
    std \at, \high
    std \at + 1, \low
.endm

; Means: plc-link trace.rs trace.
; in: -   ends: the answer, or a part of the work on it
trace:
    ldd r18, Y+1
    cpi r18, START_TRACE
    breq start_trace
    cpi r18, STOP_TRACE + 1
    brsh wrong_trace
    ldi r24, 2
    rcall expect_len
    lds r24, TRACE_STATE
    sbrs r18, 1
    rjmp tell_trace
    ; One that never was is not done.
    cpse r24, r1
    ldi r24, TRACE_DONE
; in: r24 state of the trace   ends: the answer is that
tell_trace:
    sts TRACE_STATE, r24
    std Y+1, r24
    ldi r24, 2
    rjmp done
; in: -   ends: the answer is exception 3
wrong_trace:
    rjmp refuse_value

; Means: plc-link trace.rs start_trace.
; in: -   ends: the answer, or a part of the work on it
start_trace:
    lds r24, PHASE
    cpse r24, r1
    rjmp next_place
    ldd r20, Y+ASKED_COUNT
    mov r24, r20
    dec r24
    cpi r24, TRACE_VALUES_MAX
    brsh wrong_trace
    add r24, r20
    add r24, r20
    subi r24, lo8(-(ASKED_VALUES + 1))
    rcall expect_len
    ldd r24, Y+ASKED_EVERY
    ldd r25, Y+ASKED_EVERY + 1
    or r24, r25
    breq wrong_trace
    rcall begin
    ALLOW ANYTHING
    ldd r24, Y+ASKED_KIND
    cpi r24, TRIGGERS
    brsh wrong_trace
    tst r24
    breq 1f
    movw r30, r28
    adiw r30, ASKED_TRIGGER
    rcall reference
    cpi r20, 8
    brlo 0f
    rjmp refuse_address
0:  std Y+ASKED_TRIGGER, r24
    std Y+ASKED_TRIGGER + 1, r25
1:  ; What there was is over, even if this one is refused.
    sts TRACE_STATE, r1
    rcall ring_start
    lds r24, RING_END
    lds r25, RING_END + 1
    sub r24, r30
    sbc r25, r31
    sbiw r24, TRACE_HEAD_LEN + 2 * TRACE_VALUES_MAX
    brcs no_room_for_trace
    std Z+TRACE_SAMPLE_LEN, r1
; The places, from the last to the first.
; in: LEFT   ends: as start_trace
next_place:
    ALLOW ANYTHING
    lds r18, LEFT
    subi r18, 1
    brcs start_samples
    push r18
    mov r19, r18
    lsl r19
    add r19, r18
    movw r30, r28
    add r30, r19
    adc r31, r1
    adiw r30, ASKED_VALUES
    rcall reference
    pop r18
    sts LEFT, r18
    rcall ring_start
    ldd r19, Z+TRACE_SAMPLE_LEN
    add r19, r21
    std Z+TRACE_SAMPLE_LEN, r19
    add r30, r18
    adc r31, r1
    add r30, r18
    adc r31, r1
    std Z+TRACE_HEAD_LEN, r24
    std Z+TRACE_HEAD_LEN + 1, r25
    rcall next_part
    rjmp next_place
; in: -   ends: the answer is exception 4
no_room_for_trace:
    rjmp refuse_busy
; in: the places in the trace's memory   ends: the trace waits for its trigger
start_samples:
    lds r26, RING
    lds r27, RING + 1
    adiw r26, TRACE_SAMPLE_LEN
    ld r22, X
    ldi r23, 0
    mov r17, r22
    ldd r24, Y+ASKED_COUNT
    lsl r24
    subi r24, lo8(-(TRACE_HEAD_LEN - TRACE_SAMPLE_LEN))
    add r26, r24
    adc r27, r1
    ; X: the first sample.
    push r26
    push r27
    lds r24, RING_END
    lds r25, RING_END + 1
    sub r24, r26
    sbc r25, r27
    call __udivmodhi4
    pop r19
    pop r18
    LOAD_WORD r24, r25, Y+ASKED_BEFORE
    cp r24, r22
    cpc r25, r23
    brsh no_room_for_trace
    rcall ring_start
    movw r26, r28
    adiw r26, ASKED_EVERY
    ldi r25, ASKED_VALUES - ASKED_EVERY
    rcall copy_bytes
    ; No edge is seen before the second sample.
    ldi r24, 1
    st Z+, r24
    st Z+, r17
    st Z+, r1
    st Z+, r24
    st Z+, r23
    st Z+, r22
    st Z+, r1
    st Z+, r1
    ldi r24, 0xFF
    st Z+, r24
    st Z+, r24
    st Z+, r1
    st Z+, r1
    st Z+, r19
    st Z+, r18
    st Z+, r19
    st Z, r18
    ldi r24, TRACE_WAITING
    rjmp tell_trace

; A scan has been executed, and the trace takes samples. Means: plc-link sampling.rs step.
; in: -   out: -   destroys: what C functions may
trace_step:
    push r28
    push r29
    lds r28, RING
    lds r29, RING + 1
    LOAD_WORD r24, r25, Y+TRACE_WAIT
    sbiw r24, 1
    breq 0f
9:  STORE_WORD Y+TRACE_WAIT, r24, r25
    pop r29
    pop r28
    ret
0:  ldd r20, Y+TRACE_KIND
    tst r20
    breq 1f
    ; r24: whether what triggers is so, r25: whether it was so. A falling edge and being off are
    ; those of the opposite.
    ldd r25, Y+TRACE_WAS_ACTIVE
    ldd r30, Y+TRACE_TRIGGER
    ldd r31, Y+TRACE_TRIGGER + 1
    adiw r28, TRACE_WAS_ACTIVE
    rcall append_value
    sbiw r28, TRACE_WAS_ACTIVE + 1
    sbrs r20, 0
    inc r24
    andi r24, 1
    std Y+TRACE_WAS_ACTIVE, r24
    breq 3f
    cpi r20, TRIGGERED_BY_LEVEL
    brsh 1f
    cpse r25, r1
    rjmp 3f
1:  lds r20, TRACE_STATE
    cpi r20, TRACE_WAITING
    brne 3f
    inc r20
    sts TRACE_STATE, r20
    LOAD_WORD r24, r25, Y+TRACE_SAMPLES
    LOAD_WORD r18, r19, Y+TRACE_BEFORE
    cp r18, r24
    cpc r19, r25
    brsh 2f
    movw r24, r18
2:  STORE_WORD Y+TRACE_SAMPLES, r24, r25
    STORE_WORD Y+TRACE_TRIGGERED_AT, r24, r25
3:  ; The sample.
    movw r26, r28
    adiw r26, TRACE_HEAD_LEN
    ldd r19, Y+TRACE_VALUES
    LOAD_WORD r30, r31, Y+TRACE_NEXT
    movw r28, r30
4:  ld r30, X+
    ld r31, X+
    rcall append_value
    dec r19
    brne 4b
    movw r24, r28
    lds r28, RING
    lds r29, RING + 1
    ; Where the next one goes.
    ldd r18, Y+TRACE_SAMPLE_LEN
    movw r30, r24
    add r30, r18
    adc r31, r1
    lds r18, RING_END
    lds r19, RING_END + 1
    cp r18, r30
    cpc r19, r31
    brsh 5f
    LOAD_WORD r24, r25, Y+TRACE_FIRST
5:  STORE_WORD Y+TRACE_NEXT, r24, r25
    lds r24, SCANS
    lds r25, SCANS + 1
    STORE_WORD Y+TRACE_SCAN, r24, r25
    LOAD_WORD r18, r19, Y+TRACE_CAPACITY
    LOAD_WORD r24, r25, Y+TRACE_SAMPLES
    cp r24, r18
    cpc r25, r19
    brsh 6f
    adiw r24, 1
    STORE_WORD Y+TRACE_SAMPLES, r24, r25
    cp r24, r18
    cpc r25, r19
    brlo 6f
    ; The ring is full.
    lds r20, TRACE_STATE
    cpi r20, TRACE_FILLING
    brne 6f
    ldi r20, TRACE_DONE
    sts TRACE_STATE, r20
6:  LOAD_WORD r24, r25, Y+TRACE_EVERY
    rjmp 9b
