; Status windows: how a program begins that goes step by step.

; Executes bytecode, step by step where a status window is: machine code like that of a native
; program, so that r4 to r15 are free. Before the first entry is what the last one begins with.
; in: r21:r20 address in flash, r23:r22 data address of the window's first entry
; out: -   destroys: r4-r15 and what native programs may
.global uno200_steps
uno200_steps:
    movw r30, r22
    sbiw r30, WINDOW_Y_LEN
    ld r14, Z+
    ld r15, Z+
    ld r4, Z+
    ld r5, Z+
    movw r12, r30
    movw r10, r30
    movw r6, r4
    movw r18, r4
    subi r18, lo8(WINDOW_APPROACH)
    sbci r19, hi8(WINDOW_APPROACH)
    movw r8, r18
    sts CONTEXT + WINDOW_PAGE, r15
    FOR_HANDLERS
    clr r16
    movw r30, r20
    call landed
    ; The end of the program is reached. When what was executed last is to be entered, the end comes
    ; once more.
    cpse r5, r1
    ret
    ldi r29, 0xFF
    jmp step

; Where the engine ends, for tests.
.global uno200_engine_end
uno200_engine_end:
