; Instructions of modules: from their token to the routine of the module, and back.

; The instruction of a module. Means: plc-vm modules/mod.rs execute.
; in: r2 token, which names the module, r26 its routine, Y at the operands, T
; ends: in the routine, or goes on after the operands
module:
    sts CONTEXT + LEFT_AT, r28
    sts CONTEXT + LEFT_AT + 1, r29
    mov r30, r2
    andi r30, 0x0F
    lsl r30
    subi r30, lo8(-(DIRECTORY_AT))
    ldi r31, hi8(SLOT_START)
    lpm r24, Z+
    lpm r25, Z
    ; Flash can change under a running program: no module, or no such routine.
    adiw r24, 0
    breq 3f
    ; The word address of the jump table. The last byte before it says how many routines there are,
    ; and before its head is a byte for each: the length of its operands, and in bit 7 whether
    ; it is executed without power flow: then it is no box and leaves ENO alone.
    movw r30, r24
    lsl r30
    rol r31
    sbiw r30, 1
    lpm r18, Z
    cp r26, r18
    brsh 3f
    sbiw r30, MODULE_HEAD_LEN
    sub r30, r26
    sbc r31, r1
    lpm r18, Z
    mov r19, r18
    andi r19, 0x7F
    add r28, r19
    adc r29, r1
    sbrc r18, 7
    rjmp 1f
    brtc 2f
    ldi r18, 1
    sts ENO, r18
1:  push r28
    push r29
    sub r28, r19
    sbc r29, r1
    movw r30, r24
    add r30, r26
    adc r31, r1
    ijmp
; Without power flow.
2:  sts ENO, r1
    rjmp next_x
3:  jmp outside
; in: on the hardware stack the address after the operands   ends: goes on there
module_done:
    pop r29
    pop r28
    rjmp next_x
; in: r24 1: illegal pointer, 2: illegal real, 0: a routine that the module does not have
; ends: leaves the program
module_fault:
    subi r24, lo8(-(LEFT_BY_UNDEFINED))
    jmp leave_here
