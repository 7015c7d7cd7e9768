; Program control: loops, jumps, ends, status windows. As all handlers (contacts.s).

% For WordOut AnyInt AnyInt LoopEnd
    brts 1f
    adiw r28, 7
    movw r30, r28
    rjmp go_to_end
1:  movw r30, r28
    mov r18, r26
    lpm r19, Z+
    rcall any_int
    movw r22, r24
    rcall any_int
    movw r26, r18
    rcall check_output
    st X+, r23
    st X, r22
    ldi r27, 1
    cp r24, r22
    cpc r25, r23
    brlt go_to_end
    adiw r30, 2
    rjmp next_z
; in: Z where an offset in the code is stored   ends: goes on at that offset
go_to_end:
    lpm r24, Z+
    lpm r25, Z
    movw r30, r24
    subi r31, hi8(-(SLOT_START))
    rjmp landed

% Next LoopStart Here
    movw r30, r28
    lpm r27, Z+
    movw r22, r30
    movw r30, r26
    subi r31, hi8(-(SLOT_START))
    adiw r30, 1
    lpm r18, Z+
    lpm r19, Z+
    adiw r30, 3
    rcall any_int
    adiw r30, 2
    movw r26, r18
    rcall check_output
    ld r21, X+
    ld r20, X
    set
    cp r20, r24
    cpc r21, r25
    in r0, SREG
    subi r20, 0xFF
    sbci r21, 0xFF
    st X, r20
    st -X, r21
    ldi r27, 1
    sbrc r0, SIGN
    rjmp go_back
    movw r30, r22
    rjmp next_z

% Jmp LabelIndex Here
% Cscre SegmentEnd Here
    brts 1f
    rjmp next
1:  lds r30, LINE + LABELS_IN_FLASH
    lds r31, LINE + LABELS_IN_FLASH + 1
    add r30, r26
    adc r31, r1
    add r30, r26
    adc r31, r1
    lpm r24, Z+
    lpm r25, Z
    movw r30, r24
    subi r31, hi8(-(SLOT_START))
    cp r30, r28
    cpc r31, r29
    brsh landed
; Goes back to Z as long as the watchdog allows. Means: plc-vm interpreter.rs go_to.
; in: Z address in flash   ends: goes on there with T 1, or leaves the program
go_back:
    lds r18, UNO200_TICK
    lds r19, CONTEXT + TICK
    cpse r18, r19
    rjmp 3f
; Goes on at Z, which need not be after this instruction: a status window may be there.
; in: Z address in flash, T, r16   ends: goes on there
landed:
    GO_WHERE_NEAR r31, near
    NEXT_Z
3:  push r30
    push r31
    call uno200_is_overdue
    pop r31
    pop r30
    set
    ldi r27, 1
    tst r24
    breq landed
    ldi r24, LEFT_BY_WATCHDOG
; in: r24 the reason   ends: leaves the program
leave_afar:
    jmp leave

% Approach
    NO_STEPS
    GO_WHERE_NEAR r29, 1f
    NEXT_ONE_BYTE
1:  movw r30, r28
    sbiw r30, 1
; The page may be the right one. r4 to r15 are as steps know them, unless changed flash has led here
; without a window. Means: plc-link status.rs executed.
; in: Z address in flash   ends: goes on there, step by step when the window is near
near:
    lds r24, CONTEXT + WINDOW_PAGE
    tst r24
    breq 2f
    cp r30, r8
    cpc r31, r9
    brlo 2f
    cp r14, r30
    cpc r15, r31
    brlo 2f
    ; The upper byte for the table of steps is the same.
    mov r3, r27
    cpse r5, r1
    movw r4, r6
2:  rjmp next_z

% End
    brts end_of_main
    rjmp next_one_byte

% Stop
    brts 1f
    rjmp next_one_byte
1:  ldi r24, LEFT_BY_STOP
    rjmp leave_afar

% Wdr
    sbiw r28, 1
    brtc 1f
    call uno200_retrigger_watchdog
    set
    rjmp next_x
1:  rjmp next

% MainEnd
; The end of a routine is another, unless flash has changed.
; in: -   ends: returns to whoever runs the program
end_of_main:
    lds r18, CONTEXT + DEPTH
    cpse r18, r1
    rjmp outside_afar
    ret
