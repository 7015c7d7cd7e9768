; Status windows: what every instruction does while the program goes step by step.

; Every instruction of a program that goes step by step comes here, Z in the table of steps. Y is
; two bytes after its start. r4, r5: below this Y nothing is looked at; r5 = 0: the instruction
; that was just executed is in the window. r6, r7: the Y of the first one in the window. r8, r9:
; from here on steps lead to it. r10, r11: the data address of the next entry, or of the one that
; was just executed, after its Y. r12, r13: of the first. r14, r15: the Y of the last.
; Means: plc-link status.rs executed.
; in: as a handler, r4-r15   ends: in the handler of the token
step:
    cp r28, r4
    cpc r29, r5
    brsh 1f
; in: r30 the token, all else as a handler   ends: in its handler
handle:
    ldi r31, hi8(JUMP_TABLE / 2)
    ijmp
1:  movw r20, r28
    movw r28, r10
    cpse r5, r1
    rjmp 3f
    ; The logic stack and the operand right after the instruction of the window.
    ld r30, Y+
    ld r31, Y+
    andi r31, WINDOW_ADDRESS
    in r18, SREG
    st Y+, r18
    st Y+, r16
    ld r18, Z
    st Y+, r18
    ldd r18, Z + 1
    st Y+, r18
    ldd r18, Z + 2
    st Y+, r18
    ldd r18, Z + 3
    st Y+, r18
    ; Whether the next entry is of this instruction, or one after it.
2:  ld r18, Y+
    ld r19, Y+
    cp r18, r20
    cpc r19, r21
    brne 4f
    movw r10, r28
    movw r28, r20
    mov r30, r2
    ldi r31, hi8(JUMP_TABLE / 2)
    ijmp
3:  sbiw r28, WINDOW_Y_LEN
    clr r5
    rjmp 2b
4:  brsh 5f
    adiw r28, WINDOW_ENTRY_LEN - WINDOW_Y_LEN
    rjmp 2b
5:  movw r4, r18
    cp r28, r12
    cpc r29, r13
    breq 6f
    movw r30, r28
    sbiw r30, WINDOW_ENTRY_LEN + WINDOW_Y_LEN
    ld r22, Z
    ldd r23, Z + 1
    cp r22, r20
    cpc r23, r21
    brlo 7f
    ; The program has jumped back.
    movw r28, r12
    rjmp 3b
    ; Before the window, on the way to it or farther.
6:  cp r20, r8
    cpc r21, r9
    brlo 8f
    rjmp 9f
    ; Between two entries or after the last one.
7:  cpi r19, WINDOW_END
    brne 9f
    movw r4, r6
8:  NO_STEPS
9:  movw r10, r28
    movw r28, r20
    mov r30, r2
    rjmp handle
