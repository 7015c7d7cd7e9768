; Functions 69 and 100: what the logic stack and operands are right after some instructions, in the
; next scan or in a single scan

; The request becomes entries for the engine, from the last to the first; the engine fills them in,
; and the answer is made of them. They are those of plc-link/src/status.rs, but for the way the
; engine knows instructions and stacks.
.equ FIRST_ENTRY, 3
.equ ENTRY_LEN, 10
.equ ENTRIES_MAX, 24
.equ STATUS_REFERENCE_LEN, 5
.equ NO_OPERAND, 0xFF
.equ PROGRAM_BITS, 0x0A
.equ BYTECODE_LOADED, 0x02
; The engine knows an instruction by an address in flash, two bytes after its first.
.equ AT_ENGINE, SLOT_START + 2

; Means: plc-link status.rs status.
; in: -   ends: the answer, or a part of the work on it
status:
    lds r24, PHASE
    lds r25, STATE
    cpi r24, ARMED
    brlo 1f
    brne 0f
    sbrc r25, 0
    rjmp not_yet
0:  sbrc r24, 2
    rjmp collect
    ; A scan has filled them in. The answer is made at the end of the next one.
    ldi r24, READY
    sts PHASE, r24
    rcall put_scans
    rjmp not_yet
1:  andi r25, PROGRAM_BITS
    cpi r25, BYTECODE_LOADED
    breq 2f
    rjmp refuse_busy
; in: -   ends: the answer is exception 3
wrong_status:
    rjmp refuse_value
2:  cpi r16, SCAN_STATUS
    brne 3f
    lds r24, STATE
    sbrc r24, 0
    rjmp refuse_busy
3:  ldi r24, ENTRIES_MAX
    ldi r25, STATUS_REFERENCE_LEN
    rcall expect_list
    rcall behind_entries
    sub r30, r28
    subi r30, lo8(-(FIRST_ENTRY + 2))
    lds r24, ROOM
    cp r24, r30
    brlo wrong_status
    ALLOW ANYTHING
8:  lds r20, LEFT
    subi r20, 1
    brcs arm
    ldi r19, STATUS_REFERENCE_LEN
    rcall times
    ldd r24, Z+4
    ldi r25, 0
    cpi r24, NO_OPERAND
    ldi r24, 0
    breq 4f
    push r30
    push r31
    adiw r30, 4
    rcall reference
    pop r31
    pop r30
4:  ldd r23, Z+2
    ldd r22, Z+3
    cpi r23, hi8(SLOT_LEN)
    brsh wrong_status
    subi r22, lo8(-(AT_ENGINE))
    sbci r23, hi8(-(AT_ENGINE))
    ; Offsets ascend.
    lds r20, LEFT
    rcall behind_entries_of
    ldd r18, Y+1
    cp r20, r18
    breq 5f
    ldd r18, Z+FIRST_ENTRY
    ldd r19, Z+FIRST_ENTRY+1
    cp r22, r18
    cpc r23, r19
    brsh wrong_status
5:  sbiw r30, ENTRY_LEN - FIRST_ENTRY
    st Z+, r22
    st Z+, r23
    st Z+, r24
    st Z+, r25
    ldi r24, 6
6:  st Z+, r1
    dec r24
    brne 6b
    dec r20
    sts LEFT, r20
    mov r18, r20
    rcall next_part
    rjmp 8b
; Means: plc-link status.rs status. After the last entry.
; in: -   ends: the engine looks for the entries in the next scan
arm:
    rcall behind_entries
    ldi r24, 0xFF
    std Z+FIRST_ENTRY, r24
    std Z+FIRST_ENTRY+1, r24
    sbiw r30, ENTRY_LEN - FIRST_ENTRY
    ldd r24, Y+1
    sts LEFT, r24
    ; The engine finds the last instruction before the entries.
    ld r24, Z
    ldd r25, Z+1
    std Y+FIRST_ENTRY-2, r24
    std Y+FIRST_ENTRY-1, r25
    ldd r18, Y+FIRST_ENTRY
    ldd r19, Y+FIRST_ENTRY+1
    sub r24, r18
    sbc r25, r19
    cpi r25, hi8(WINDOW_LEN)
    brlo 1f
    rjmp wrong_status
1:  ldi r24, ARMED
    sts PHASE, r24
    cpi r16, SCAN_STATUS
    brne 2f
    ldi r24, 1
    sts SCANS_WANTED, r24
    sts SCANS_WANTED + 1, r1
    ldi r24, SCANS_COMMAND
    sts COMMAND, r24
2:  rjmp not_yet

; The entries end FIRST_ENTRY bytes after Z.
; in: -   out: Z, r20 how many there are   destroys: r19
behind_entries:
    ldd r20, Y+1
; The same of the first ones.
; in: r20 how many   out: Z   destroys: r19
behind_entries_of:
    ldi r19, ENTRY_LEN
; in: r20, r19   out: Z so many times so many bytes after the frame   destroys: r0
times:
    mul r20, r19
    movw r30, r0
    clr r1
    add r30, r28
    adc r31, r29
    ret

; The answer, with the operands right-aligned. Means: plc-link status.rs collect.
; in: -   ends: the answer
collect:
    lds r22, LEFT
    adiw r28, 3
    movw r26, r28
1:  ldd r0, Y+2
    ldd r25, Y+3
    ldd r23, Y+4
    ldd r24, Y+5
    ; The top of the stack, a bit of SREG, joins its levels.
    bst r23, 6
    lsl r24
    bld r24, 0
    andi r23, 0x80
    adc r23, r1
    ldd r18, Y+6
    ldd r19, Y+7
    ldd r20, Y+8
    ldd r21, Y+9
    st X+, r23
    st X+, r24
    or r0, r25
    brne 2f
    ldi r18, 0
2:  swap r25
    andi r25, 0x0F
    ldi r24, 3
    cpi r25, 9
    brlo 3f
    ldi r24, 2
    breq 3f
    ldi r24, 0
3:  subi r24, 1
    brcs 4f
    mov r21, r20
    mov r20, r19
    mov r19, r18
    ldi r18, 0
    rjmp 3b
4:  cpi r25, 8
    brsh 7f
5:  subi r25, 1
    brcs 6f
    lsr r21
    rjmp 5b
6:  andi r21, 1
7:  st X+, r18
    st X+, r19
    st X+, r20
    st X+, r21
    adiw r28, ENTRY_LEN
    dec r22
    brne 1b
    movw r30, r26
    rjmp done_at_z
