; The fast engine: dispatch, entry and exit, subroutines of the handlers, and the vectors for native programs.
;
; Token threading: each handler ends by fetching the next token and its first operand byte and jumping through a table
; of 256 entries, so that no byte can lead outside. r26 and r27 are X, r28 and r29 are Y, r30 and r31 are Z.

.equ SREG, 0x3F
; GPIOR1: what modules have taken over.
.equ MODULE_FLAGS, 0x2A
.equ STACK_LOW, 0x3D
.equ STACK_HIGH, 0x3E
; The bit of SREG that says "less" after a comparison of signed numbers.
.equ SIGN, 4
; The pins of I0.0 to I0.3, whose edges are events.
.equ PIND, 0x09
.equ EDGE_PINS, 0x3C
; SMB0 with the first scan, and SMB1 with what a result is like.
.equ SYSTEM_BITS, SM_START
.equ FIRST_SCAN, 1
.equ RESULT_BITS, SM_START + 1
; SMB4 with the bit for a run-time programming problem.
.equ ERROR_BITS, SM_START + 4
.equ PROGRAMMING_ERROR, 3
; In the image's table of timers.
.equ STARTED_BY_TOF, 1

; Entries of a status window: 2 bytes for Y at the instruction, 2 for the address of the operand with its size in the upper
; 4 bits, 2 for the logic stack, 4 for what stands at that address. The stack is SREG, in which bit 7 is set and bit 6 the
; top, and the levels below. The last entry is followed by 0xFFFF.
.equ WINDOW_ENTRY_LEN, 10
.equ WINDOW_Y_LEN, 2
.equ WINDOW_END, 0xFF
.equ WINDOW_ADDRESS, 0x0F
; Steps begin no farther before a window. No more bytes lie between two places where the program looks whether they are to.
.equ WINDOW_APPROACH, APPROACH_LEN + 2
; A window and the way to it touch so many pages of 256 bytes at most.
.equ WINDOW_PAGES, (WINDOW_LEN - 1 + WINDOW_APPROACH) / 256 + 2

; ---- dispatch

; Flash can change under a running program until the self-test has seen it: no operand may lead far. What is read stays
; below 0x0800, what is written in data memory and the four bytes behind it, which the linker keeps free.
.macro READABLE high
    andi \high, 0x07
.endm

; Goes to `bad` when X is outside data memory.
.macro CHECK_OUTPUT bad
    cpi r27, hi8(DATA_START)
    brlo \bad
    cpi r27, hi8(DATA_END)
    brsh \bad
.endm

; Flags of r24 and r25 minus r22 and r23, or the other way round.
.macro COMPARE order
.ifc \order, swapped
    cp r22, r24
    cpc r23, r25
.else
    cp r24, r22
    cpc r25, r23
.endif
.endm

; The word whose address begins with r26 in r24 and r25, and the address behind that in X. Z at what follows.
.macro WORD_AND_ADDRESS
    movw r30, r28
    lpm r27, Z+
    lpm r20, Z+
    lpm r21, Z+
    READABLE r27
    ld r25, X+
    ld r24, X
    movw r26, r20
.endm

; Flags of one word minus another, or the other way round: both by their addresses. Z at what follows.
.macro COMPARE_WORDS order
    WORD_AND_ADDRESS
    READABLE r27
    ld r23, X+
    ld r22, X
    ldi r27, 1
    COMPARE \order
.endm

; The same for a word by its address, which begins with r26, and the constant behind it.
.macro COMPARE_CONSTANT order
    movw r30, r28
    lpm r27, Z+
    lpm r22, Z+
    lpm r23, Z+
    READABLE r27
    ld r25, X+
    ld r24, X
    ldi r27, 1
    COMPARE \order
.endm

; IN1 of a box in r22 and r23, the value of OUT in r24 and r25, X at the low byte of OUT, Z at what follows.
.macro BOX_OUT bad
    lpm r27, Z+
    CHECK_OUTPUT \bad
    ld r25, X+
    ld r24, X
.endm
.macro WORD_BOX bad
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    ld r23, X+
    ld r22, X
    lpm r26, Z+
    BOX_OUT \bad
.endm
.macro CONSTANT_BOX bad
    mov r22, r26
    movw r30, r28
    lpm r23, Z+
    lpm r26, Z+
    BOX_OUT \bad
.endm

; The program goes step by step no more, or not yet.
.macro NO_STEPS
    ldi r24, hi8(JUMP_TABLE / 2)
    mov r3, r24
.endm

; What all handlers find: the upper byte of the bit page, and that of their table beside the token in r2.
.macro FOR_HANDLERS
    NO_STEPS
    ldi r27, 1
.endm

; Goes to `near` when a status window may begin soon behind an address in flash with this upper byte.
.macro GO_WHERE_NEAR high, near
    lds r24, CONTEXT + WINDOW_PAGE
    sub r24, \high
    cpi r24, WINDOW_PAGES
    brlo \near
.endm

; Behind an instruction of more than two bytes, Z at the next one.
.macro NEXT_Z
    lpm r2, Z+
    lpm r26, Z+
    movw r28, r30
    movw r30, r2
    ijmp
.endm

; Behind an instruction of two bytes.
.macro NEXT
    movw r30, r28
    NEXT_Z
.endm

; Behind an instruction of one byte: its operand byte is the next token.
.macro NEXT_ONE_BYTE
    movw r30, r28
    mov r2, r26
    lpm r26, Z+
    movw r28, r30
    movw r30, r2
    ijmp
.endm

.section .progmem.gcc.engine, "ax", @progbits

; ---- vectors for native programs, a word each, at the address that plc-isa names

.global uno200_vectors
uno200_vectors:
    rjmp bytecode_vector
    rjmp stop_vector
    rjmp loop_vector
    rjmp watchdog_vector
    rjmp on_delay
    rjmp off_delay
    rjmp retentive_on_delay
    rjmp count_up
    rjmp count_down
    rjmp count_up_down
; What modules leave by.
    rjmp module_done
    rjmp module_fault
; What modules call for the clock.
    rjmp now_vector
; And for where they keep the time of day.
    rjmp state_vector
; What the module of the freeport calls when it gives the line back.
    rjmp line_vector

; ---- entry and exit

; What handlers change of the registers that a routine must keep.
.macro PUSH_KEPT
    push r2
    push r3
    push r16
    push r17
    push r28
    push r29
.endm
.macro POP_KEPT
    pop r29
    pop r28
    pop r17
    pop r16
    pop r3
    pop r2
.endm

; Also keeps where the stack is then, for those who leave from within subroutines.
.macro ENTER
    PUSH_KEPT
    in r18, STACK_LOW
    in r19, STACK_HIGH
    sts CONTEXT + STACK, r18
    sts CONTEXT + STACK + 1, r19
    sts CONTEXT + DEPTH, r1
    ; The watchdog has nothing to say before the clock moves.
    lds r18, UNO200_TICK
    sts CONTEXT + TICK, r18
.endm

; u8 uno200_run(u16 address): executes bytecode. Returns why it was left.
.global uno200_run
uno200_run:
    ENTER
    movw r30, r24
    FOR_HANDLERS
    clr r16
    clt
    rcall next_z
finish:
    ldi r24, LEFT_AT_END
epilogue:
    POP_KEPT
.global uno200_run_end
uno200_run_end:
    ret

; u8 uno200_run_native(u16 word_address): executes machine code. It may take two more arguments, as uno200_steps does.
.global uno200_run_native
.global uno200_run_steps
uno200_run_native:
uno200_run_steps:
    push r4
    push r5
    push r6
    push r7
    push r8
    push r9
    push r10
    push r11
    push r12
    push r13
    push r14
    push r15
    rcall run_native
    pop r15
    pop r14
    pop r13
    pop r12
    pop r11
    pop r10
    pop r9
    pop r8
    pop r7
    pop r6
    pop r5
    pop r4
.global uno200_run_native_end
uno200_run_native_end:
    ret

run_native:
    ENTER
    ldi r28, lo8(DATA_START)
    ldi r29, hi8(DATA_START)
    movw r30, r24
    clt
    icall
    rjmp finish

; An operand leads outside.
outside:
    ldi r24, LEFT_BY_UNDEFINED
; Leaves the program from any level with the reason in r24. Y tells the place: two bytes behind the start of the
; instruction, or a little more.
leave:
    sts CONTEXT + LEFT_AT, r28
    sts CONTEXT + LEFT_AT + 1, r29
leave_here:
    lds r18, CONTEXT + STACK
    lds r19, CONTEXT + STACK + 1
    in r0, SREG
    cli
    out STACK_HIGH, r19
    out SREG, r0
    out STACK_LOW, r18
    clr r1
    rjmp epilogue

; ---- what native programs call

bytecode_vector:
    PUSH_KEPT
    FOR_HANDLERS
    call landed
    POP_KEPT
    ret

; ---- status windows

; Every instruction of a program that goes step by step comes here, Z in the table of steps. Y is two bytes behind its start.
; r4, r5: below this Y nothing is looked at; r5 = 0: the instruction that was just executed is in the window. r6, r7: the Y
; of the first one in the window. r8, r9: from here on steps lead to it. r10, r11: the data address of the next entry, or of
; the one that was just executed, behind its Y. r12, r13: of the first. r14, r15: the Y of the last.
step:
    cp r28, r4
    cpc r29, r5
    brsh 1f
handle:
    ldi r31, hi8(JUMP_TABLE / 2)
    ijmp
1:  movw r20, r28
    movw r28, r10
    cpse r5, r1
    rjmp 3f
    ; The logic stack and the operand right behind the instruction of the window.
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
    ; Whether the next entry is of this instruction, or one behind it.
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
    ; Between two entries or behind the last one.
7:  cpi r19, WINDOW_END
    brne 9f
    movw r4, r6
8:  NO_STEPS
9:  movw r10, r28
    movw r28, r20
    mov r30, r2
    rjmp handle

; ---- the tables, at multiples of 512 bytes: of a program that goes step by step, and of handlers

.org JUMP_TABLE - 512 - NATIVE_VECTORS
    .rept 256
    rjmp step
    .endr
.global uno200_table
uno200_table:
    ENTRIES

; ---- instructions of modules

; r2: the token, which names the module; r26: its routine; Y at the operands.
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
    ; The word address of the jump table. The last byte before it says how many routines there are, and before its head
    ; stands a byte for each: the length of its operands, and in bit 7 whether it is executed without power flow: then it
    ; is no box and leaves ENO alone.
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
module_done:
    pop r29
    pop r28
    rjmp next_x
; r24: 1 for an illegal pointer, 2 for an illegal real, 0 for a routine that the module does not have.
module_fault:
    subi r24, lo8(-(LEFT_BY_UNDEFINED))
    jmp leave_here

; ---- the rest of the dispatch

loop_vector:
    lds r18, UNO200_TICK
    lds r19, CONTEXT + TICK
    ldi r24, 0
    cpse r18, r19
    rjmp ask_watchdog
    ret

stop_vector:
    ldi r24, LEFT_BY_STOP
    rjmp leave_here

; The place comes as an offset in the bytecode.
watchdog_vector:
    subi r24, lo8(-(SLOT_START + 2))
    sbci r25, hi8(-(SLOT_START + 2))
    sts CONTEXT + LEFT_AT, r24
    sts CONTEXT + LEFT_AT + 1, r25
    ldi r24, LEFT_BY_WATCHDOG
    rjmp leave_here

; Whether data memory at X may be written. It does not return if not.
check_output:
    cpi r27, hi8(DATA_START)
    brlo 1f
check_end:
    cpi r27, hi8(DATA_END)
    brsh 1f
    ret
1:  jmp outside

; Calls of Rust stand behind the table: the linker shortens them, and the table must not move.
ask_watchdog:
    jmp uno200_is_overdue
now_vector:
    jmp uno200_now
line_vector:
    jmp uno200_set_up_line
state_vector:
    ldi r30, lo8(TIME_OF_DAY)
    ldi r31, hi8(TIME_OF_DAY)
    ret

; A word, constant or in memory: mode byte and word at Z, value in r24 and r25.
any_int:
    lpm r20, Z+
    lpm r24, Z+
    lpm r25, Z+
    sbrs r20, 0
    ret
    movw r26, r24
    READABLE r27
    ld r25, X+
    ld r24, X
    ret

; The same for a byte.
any_byte:
    lpm r20, Z+
    lpm r24, Z+
    lpm r25, Z+
    sbrs r20, 0
    ret
    movw r26, r24
    READABLE r27
    ld r24, X
    clr r25
    ret

; Passes over operand bytes that nobody reads.
skip_3:
    adiw r28, 3
    NEXT
skip_1:
    adiw r28, 1
    rjmp next
skip_2:
    adiw r28, 2
    NEXT

top_from_flag:
    clt
    breq 1f
    set
1:
next_z_x:
    ldi r27, 1
next_z:
    NEXT_Z
next_x:
    ldi r27, 1
next:
    NEXT

next_one_byte:
    NEXT_ONE_BYTE

; What is not in the instruction table.
rest:
    jmp outside

; ---- timers

; The preset r24 and r25 into the slot X. X at the state.
.macro STORE_PRESET
    adiw r26, 2
    st X+, r25
    st X+, r24
.endm
; The value of the timer whose state is at X. X at its low byte.
.macro CLEAR_VALUE
    sbiw r26, 4
    st X+, r1
    st X, r1
.endm
; The bit with mask r18 in the byte at Z.
.macro CLEAR_BIT
    com r18
    ld r20, Z
    and r20, r18
    st Z, r20
.endm

; TON: slot X, preset r24 and r25, byte of the bit Z, mask of the bit r18, r19 bit 0: counts in 100 ms.
on_delay:
    STORE_PRESET
    brts 1f
    st X, r1
    CLEAR_VALUE
    CLEAR_BIT
    ret
1:  ld r20, X
    ldi r21, 1
    st X, r21
    sbiw r26, 4
    clr r22
    clr r23
    sbrc r20, 0
    rjmp count_on
    adiw r26, 1
    rjmp store_value

retentive_on_delay:
    STORE_PRESET
    brts 1f
    st X, r1
    ret
1:  ld r20, X
    ldi r21, 1
    st X, r21
    sbiw r26, 4
    sbrs r20, 0
    ldi r19, 0
count_on:
    rcall add_ticks
; The new value r22 and r23 at X, and the bit from the comparison with the preset.
store_value:
    st X, r22
    st -X, r23
    cp r22, r24
    cpc r23, r25
write_timer_bit:
    ld r20, Z
    brge 1f
    or r20, r18
    eor r20, r18
    st Z, r20
    ret
1:  or r20, r18
    st Z, r20
    ret

; The value at X, and with r19 bit 0 the time that has passed, in r22 and r23. X at its low byte.
add_ticks:
    ld r23, X+
    ld r22, X
    sbrs r19, 0
    ret
    lds r20, CONTEXT + TICKS_100
    lds r21, CONTEXT + TICKS_100 + 1
; The time r20 and r21 to the value r22 and r23, neither above 32,767.
add_time:
    sbrs r21, 7
    rjmp 1f
    ldi r20, 0xFF
    ldi r21, 0x7F
1:  add r22, r20
    adc r23, r21
    brvc 2f
    ldi r22, 0xFF
    ldi r23, 0x7F
2:  ret

off_delay:
    STORE_PRESET
    ld r20, X
    brtc 1f
    ldi r21, 2
    st X, r21
    CLEAR_VALUE
    ld r20, Z
    or r20, r18
    st Z, r20
    ret
1:  ldi r21, 1
    sbrs r20, 1
    rjmp 2f
    st X, r21
    CLEAR_VALUE
    clr r22
    clr r23
    rjmp 3f
2:  sbrs r20, 0
    ret
    sbiw r26, 4
    rcall add_ticks
; The value is r22 and r23, X at its low byte.
3:
off_delay_counts:
    cp r22, r24
    cpc r23, r25
    brge 4f
    st X, r22
    st -X, r23
    ret
4:  ; The time is over: the value is the preset, but not below 0.
    sbrc r25, 7
    clr r24
    sbrc r25, 7
    clr r25
    st X, r24
    st -X, r25
    adiw r26, 4
    st X, r1
    ld r20, Z
    or r20, r18
    eor r20, r18
    st Z, r20
    ret

; ---- counters

; Remembers S1 (or S2 and S1) in bit 0 (and 1) of the state behind X and leaves in r20 which of them rose.
.macro REMEMBER
    adiw r26, 2
    ld r20, X
    mov r22, r20
.endm
.macro ROSE
    st X, r22
    sbiw r26, 2
    com r20
    and r20, r22
    lds r21, SYSTEM_BITS
    sbrc r21, FIRST_SCAN
    clr r20
.endm

; CTU: slot X, preset r24 and r25, byte of the bit Z, mask of the bit r18, S1 in bit 1 of r19, S0 in T.
count_up:
    REMEMBER
    andi r22, 0xFE
    sbrc r19, 1
    ori r22, 0x01
    ROSE
    brts write_zero
    ld r23, X+
    ld r22, X
    sbrs r20, 0
    rjmp store_value
    subi r22, 0xFF
    sbci r23, 0xFF
    brvc 1f
    ldi r22, 0xFF
    ldi r23, 0x7F
1:  rjmp store_value
; Value and bit 0.
write_zero:
    st X+, r1
    st X, r1
clear_bit:
    CLEAR_BIT
    ret

count_down:
    REMEMBER
    andi r22, 0xFD
    sbrc r19, 1
    ori r22, 0x02
    ROSE
    brtc 1f
    st X+, r25
    st X, r24
    rjmp clear_bit
1:  ld r23, X+
    ld r22, X
    ; Down to 0 and no further.
    cp r1, r22
    cpc r1, r23
    brge 2f
    sbrs r20, 1
    rjmp 2f
    subi r22, 1
    sbci r23, 0
2:  st X, r22
    st -X, r23
    cp r1, r22
    cpc r1, r23
    rjmp write_timer_bit

count_up_down:
    REMEMBER
    andi r22, 0xFC
    sbrc r19, 2
    ori r22, 0x01
    sbrc r19, 1
    ori r22, 0x02
    ROSE
    brts write_zero
    ld r23, X+
    ld r22, X
    sbrs r20, 0
    rjmp 1f
    subi r22, 0xFF
    sbci r23, 0xFF
1:  sbrs r20, 1
    rjmp 2f
    subi r22, 1
    sbci r23, 0
2:  rjmp store_value

; ---- the handlers

    HANDLERS
; ---- what is farther away: places, comparisons, results, ranges, products

; A bit packed in a word, whose low byte is r26: mask in r19, address in X, byte in r24. Z at what follows.
load_far_bit:
    movw r30, r28
    lpm r27, Z+
far_bit:
    ldi r19, 1
    sbrc r26, 1
    ldi r19, 4
    sbrc r26, 0
    lsl r19
    sbrc r26, 2
    swap r19
    lsr r27
    ror r26
    lsr r27
    ror r26
    lsr r27
    ror r26
    inc r27
    rcall check_end
    ld r24, X
    ret

; The same with the bit in T, and r26 and Y at the operand behind it.
take_far_bit:
    rcall load_far_bit
    and r24, r19
    clt
    breq 1f
    set
1:  movw r28, r30
at_operand:
    movw r30, r28
    lpm r26, Z+
    movw r28, r30
    ret

; T to the bit that r26 and Y are at. Z behind it.
assign_second:
    rcall load_far_bit
    or r24, r19
    brts 1f
    eor r24, r19
1:  st X, r24
    ret

; Remembers T in edge memory r26. Not zero: it was remembered before, or this is the first scan, where r19 bit 1 is set.
remember_edge:
    ldi r21, 0
    mov r20, r26
    rcall place_bit
    lds r26, CONTEXT + EDGES_START
    lds r27, CONTEXT + EDGES_START + 1
    add r26, r30
    adc r27, r1
    rcall check_end
    ld r20, X
    mov r21, r20
    or r21, r18
    brts 1f
    eor r21, r18
1:  st X, r21
    ldi r27, 1
    lds r19, SYSTEM_BITS
    and r20, r18
    sbrc r19, FIRST_SCAN
    or r20, r18
    tst r20
    ret

; ---- comparisons

; Flags of the word at r26 with the next bytes minus another. Z at what follows.
compare_words_straight:
    COMPARE_WORDS straight
    ret

compare_words_swapped:
    COMPARE_WORDS swapped
    ret

compare_constant_straight:
    COMPARE_CONSTANT straight
    ret

compare_constant_swapped:
    COMPARE_CONSTANT swapped
    ret

compare_bytes:
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    ld r24, X
    lpm r26, Z+
    lpm r27, Z+
    READABLE r27
    ld r22, X
    rjmp 1f
compare_byte_constant:
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    lpm r22, Z+
    ld r24, X
1:  clr r23
    clr r25
    rjmp combine

; Behind the prefix: r26 is the token.
compare_any:
    cpi r26, WIDE_COMPARISONS
    brlo 1f
    rjmp rest
1:  movw r30, r28
    push r26
    cpi r26, WIDE_COMPARISONS / 2
    brsh 2f
    rcall any_int
    movw r22, r24
    rcall any_int
    rjmp 3f
2:  rcall any_byte
    movw r22, r24
    rcall any_byte
3:  ; IN2 was read last.
    movw r20, r24
    movw r24, r22
    movw r22, r20
    pop r18
    cpi r18, WIDE_COMPARISONS / 2
    brlo 4f
    subi r18, WIDE_COMPARISONS / 2
4:  rjmp combine

; ---- words

; Writes a result that wrapped around, or did not.
write_wrapped:
    st X, r24
    st -X, r25
    ldi r19, 0
    brvc write_status
    ldi r19, 0x02
    rjmp write_status
; Writes a result, or leaves OUT as it is when it does not fit.
write_result:
    brvs overflow
    st X, r24
    st -X, r25
    ldi r19, 0
write_status:
    or r24, r25
    brne 1f
    ori r19, 0x01
1:  sbrc r25, 7
    ori r19, 0x04
    lds r24, RESULT_BITS
    andi r24, 0xF8
    or r24, r19
    sts RESULT_BITS, r24
next_z_x_too:
    ldi r27, 1
    NEXT_Z

overflow:
    ldi r18, 0xF8
    ldi r19, 0x02
; Bits r19 of the result bits, of which r18 keeps the others.
write_bits:
    lds r24, RESULT_BITS
    and r24, r18
    or r24, r19
    sts RESULT_BITS, r24
    rjmp next_z_x

; ---- places of timers and counters

; The preset, by address or as a constant, in r24 and r25; r26 stays the slot. Y behind both.
.macro PRESET_WORD
    mov r20, r26
    movw r30, r28
    lpm r26, Z+
    lpm r27, Z+
    movw r28, r30
    READABLE r27
    ld r25, X+
    ld r24, X
    mov r26, r20
.endm
.macro PRESET_CONSTANT
    movw r30, r28
    lpm r24, Z+
    lpm r25, Z+
    movw r28, r30
.endm
; The address of slot r26 in X.
.macro SLOT_ADDRESS start, len
    ldi r21, \len
    mul r26, r21
    movw r26, r0
    clr r1
    lds r18, LINE + \start
    add r26, r18
    lds r18, LINE + \start + 1
    adc r27, r18
.endm

; Z at the entry of the timer in slot r26, in the image's table.
.macro TIMER_ENTRY
    lds r30, LINE + TIMERS_IN_FLASH
    lds r31, LINE + TIMERS_IN_FLASH + 1
    add r30, r26
    adc r31, r1
    add r30, r26
    adc r31, r1
.endm

; void uno200_advance_timers(u8 is_10_ms, u16 ticks): the running timers of 1 ms or 10 ms count on.
.global uno200_advance_timers
uno200_advance_timers:
    push r16
    push r17
    push r28
    push r29
    mov r17, r24
    movw r28, r22
    lds r16, CONTEXT + TIMERS
1:  subi r16, 1
    brcs 3f
    mov r26, r16
    rcall look_timer_up
    cpi r20, 101
    brsh 1b
    mov r18, r20
    andi r18, 31
    cpi r18, 5
    brsh 1b
    ; 0 for 1 ms, 1 for 10 ms.
    cpse r18, r1
    ldi r18, 1
    cpse r18, r17
    rjmp 1b
    SLOT_ADDRESS TIMERS_START, TIMER_SLOT_LEN
    ldi r21, lo8(T_BITS_START)
    rcall place_bit
    ld r23, X+
    ld r22, X+
    ld r25, X+
    ld r24, X+
    ld r20, X
    sbiw r26, 3
    sbrs r20, 0
    rjmp 1b
    movw r20, r28
    rcall add_time
    cpi r19, STARTED_BY_TOF
    breq 2f
    rcall store_value
    rjmp 1b
2:  rcall off_delay_counts
    rjmp 1b
3:  pop r29
    pop r28
    pop r17
    pop r16
    ret

; Timer in slot r26: its number in r20, how it is started in r19.
look_timer_up:
    TIMER_ENTRY
    lpm r20, Z+
    lpm r19, Z
    ret

timer_word:
    PRESET_WORD
    rjmp place_timer
timer_constant:
    PRESET_CONSTANT

; Timer in slot r26: X slot, Z byte of its bit, r18 mask of its bit, r19 bit 0: counts in 100 ms.
place_timer:
    TIMER_ENTRY
    lpm r20, Z
    SLOT_ADDRESS TIMERS_START, TIMER_SLOT_LEN
    cpi r27, hi8(DATA_END)
    brsh outside_afar
    ldi r19, 1
    ldi r21, lo8(T_BITS_START)
    cpi r20, 101
    brsh place_bit
    mov r18, r20
    andi r18, 31
    breq 1f
    cpi r18, 5
    brsh place_bit
    ldi r19, 0

; Bit r20 of the bytes from r21 of the bit page on: byte Z, mask r18.
place_bit:
    ldi r18, 1
    sbrc r20, 1
    ldi r18, 4
    sbrc r20, 0
    lsl r18
    sbrc r20, 2
    swap r18
    lsr r20
    lsr r20
    lsr r20
    add r20, r21
    mov r30, r20
    ldi r31, 1
    ret
; Reached by short jumps from far behind the tables.
outside_afar:
    jmp outside
; A timer of 1 ms is brought up to date first.
1:  bld r17, 0
    push r20
    push r24
    push r25
    push r26
    push r27
    call uno200_refresh_timers
    pop r27
    pop r26
    pop r25
    pop r24
    pop r20
    bst r17, 0
    ldi r19, 0
    ldi r21, lo8(T_BITS_START)
    rjmp place_bit

counter_word:
    PRESET_WORD
    rjmp place_counter
counter_constant:
    PRESET_CONSTANT

; Counter in slot r26: X slot, Z byte of its bit, r18 mask of its bit, r19: S1 in bit 1, S2 in bit 2.
place_counter:
    lds r30, LINE + COUNTERS_IN_FLASH
    lds r31, LINE + COUNTERS_IN_FLASH + 1
    add r30, r26
    adc r31, r1
    lpm r20, Z
    SLOT_ADDRESS COUNTERS_START, COUNTER_SLOT_LEN
    cpi r27, hi8(DATA_END)
    brsh 2f
    mov r19, r16
    lsl r19
    ldi r21, lo8(C_BITS_START)
    rjmp place_bit
2:  rjmp outside_afar

; ---- comparisons that are small rather than fast

; By r18, 6 for each way to combine (push, AND, OR) and 1 for each relation: IN1 in r24 and r25, IN2 in r22 and r23.
combine:
    clr r19
1:  cpi r18, 6
    brlo 2f
    subi r18, 6
    inc r19
    rjmp 1b
2:  cpi r18, 2
    brlo 4f
    ; > and <= are < and >= with the operands exchanged.
    cpi r18, 3
    breq 3f
    cpi r18, 4
    brne 4f
3:  movw r20, r24
    movw r24, r22
    movw r22, r20
4:  cp r24, r22
    cpc r25, r23
    in r20, SREG
    ; Bit 0 of r20: equal, or less.
    cpi r18, 2
    brsh 5f
    lsr r20
    rjmp 6f
5:  swap r20
6:  cpi r18, 1
    breq 7f
    cpi r18, 4
    brlo 8f
7:  com r20
8:  tst r19
    brne 9f
    lsl r16
    bld r16, 0
    bst r20, 0
    rjmp next_z_x_too
9:  dec r19
    brne 1f
    sbrs r20, 0
    clt
    rjmp next_z_x_too
1:  sbrc r20, 0
    set
    rjmp next_z_x_too

; ---- ranges

; Sets r18 bits from mask r19 of the byte r24 at X on. Bytes are inverted by r21, so that resetting is setting.
set_bits:
    eor r24, r21
1:  or r24, r19
    dec r18
    breq 2f
    lsl r19
    brcc 1b
    eor r24, r21
    st X+, r24
    call check_end
    ld r24, X
    eor r24, r21
    ldi r19, 1
    rjmp 1b
2:  eor r24, r21
    st X, r24
    ret

; R of r18 timers or counters from number r26 on; r27 is the upper byte of the first bit as far bits are packed.
reset_numbers:
    mov r22, r26
    mov r23, r18
    mov r20, r27
    ; None when the range would pass number 255.
    mov r24, r26
    add r24, r18
    brcc 1f
    brne 6f
1:  tst r18
    breq 6f
    ldi r21, 0xFF
    rcall far_bit
    rcall set_bits
    ldi r21, COUNTER_SLOT_LEN
    sbrc r20, 0
    rjmp 2f
    ldi r21, TIMER_SLOT_LEN
    lds r30, LINE + TIMERS_IN_FLASH
    lds r31, LINE + TIMERS_IN_FLASH + 1
    lds r26, LINE + TIMERS_START
    lds r27, LINE + TIMERS_START + 1
    lds r24, CONTEXT + TIMERS
    lds r25, CONTEXT + TIMERS + 1
    rjmp 3f
2:  lds r30, LINE + COUNTERS_IN_FLASH
    lds r31, LINE + COUNTERS_IN_FLASH + 1
    lds r26, LINE + COUNTERS_START
    lds r27, LINE + COUNTERS_START + 1
    lds r24, CONTEXT + COUNTERS
    lds r25, CONTEXT + COUNTERS + 1
    ; Each slot: of a timer its kind stands behind its number, and its state behind value and preset.
3:  sbiw r24, 1
    brcs 4f
    lpm r19, Z+
    sbrs r20, 0
    adiw r30, 1
    sub r19, r22
    cp r19, r23
    brsh 5f
    st X+, r1
    st X, r1
    adiw r26, 3
    sbrs r20, 0
    st X, r1
    sbiw r26, 4
5:  add r26, r21
    adc r27, r1
    rjmp 3b
    ; Many of these take longer than the hardware watchdog waits.
4:  bld r17, 0
    call loop_vector
    bst r17, 0
6:  jmp next_x

; ---- products and quotients

word_box:
    WORD_BOX 1f
    ret
constant_box:
    CONSTANT_BOX 1f
    ret
1:  rjmp outside_afar

; OUT := OUT * IN1, of 32 bits in r18 to r21.
multiply:
    push r27
    clr r27
    movw r20, r24
    muls r21, r23
    movw r24, r0
    mul r20, r22
    movw r18, r0
    mulsu r21, r22
    sbc r25, r27
    add r19, r0
    adc r24, r1
    adc r25, r27
    mulsu r23, r20
    sbc r25, r27
    add r19, r0
    adc r24, r1
    adc r25, r27
    clr r1
    pop r27
    ; It fits when the upper half is the sign of the lower one.
    clr r20
    sbrc r19, 7
    com r20
    cp r24, r20
    cpc r25, r20
    brne product_overflow
    movw r24, r18
write_product:
    st X, r24
    st -X, r25
    ; SM1.3 belongs to products and quotients.
    lds r19, RESULT_BITS
    andi r19, 0xF7
    sts RESULT_BITS, r19
    ldi r19, 0
    rjmp write_status
product_overflow:
    ldi r18, 0xF0
    ldi r19, 0x02
    rjmp write_bits

; OUT := OUT / IN1.
divide:
    ldi r18, 0xFF
    ldi r19, 0x08
    mov r20, r22
    or r20, r23
    brne 1f
    rjmp write_bits
    ; The only quotient that does not fit is that of -32768 and -1.
1:  mov r20, r22
    and r20, r23
    com r20
    mov r21, r25
    subi r21, 0x80
    or r20, r21
    or r20, r24
    breq product_overflow
    bld r17, 0
    push r30
    push r31
    push r26
    push r27
    call __divmodhi4
    pop r27
    pop r26
    pop r31
    pop r30
    bst r17, 0
    movw r24, r22
    rjmp write_product

; ---- status windows: their beginning

; Executes the bytecode at r20 and r21, step by step where a status window is: machine code like that of a native program,
; so that r4 to r15 are free. r22 and r23: the data address of the window's first entry. Before it stands what the last one
; begins with.
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
    ; The end of the program is reached. When what was executed last is to be entered, the end comes once more.
    cpse r5, r1
    ret
    ldi r29, 0xFF
    jmp step

.global uno200_engine_end
uno200_engine_end:

; ---- interrupts that modules serve

; To an entry of the module, with r31, r30, r0 and SREG on the stack.
.macro INTERRUPT vector, entry, by
.global \vector
\vector:
    push r31
    ldi r31, \entry
    rjmp \by
.endm
.macro BY_MODULE module
    push r30
    ldi r30, lo8(SLOT_START + DIRECTORY_AT + 2 * \module)
.endm

; A character: the firmware's own, unless a module has taken over the serial line. Before SREG is kept nothing changes it.
.global __vector_18
__vector_18:
    push r31
    in r31, MODULE_FLAGS
    sbrs r31, SERIAL_FLAG
    jmp uno200_character
    ldi r31, FREEPORT_ENTRY
    rjmp freeport_interrupt
; Timer2, which belongs to whoever has the line.
.global __vector_7
__vector_7:
    push r31
    in r31, MODULE_FLAGS
    sbrs r31, SERIAL_FLAG
    jmp uno200_pause
    ldi r31, FREEPORT_ENTRY + 2
    rjmp freeport_interrupt
    INTERRUPT __vector_20, FREEPORT_ENTRY + 1, freeport_interrupt
    INTERRUPT __vector_13, PULSES_ENTRY, pulses_interrupt
    INTERRUPT __vector_1, COUNTERS_ENTRY, counters_interrupt
    INTERRUPT __vector_2, COUNTERS_ENTRY + 1, counters_interrupt
    INTERRUPT __vector_5, COUNTERS_ENTRY + 2, counters_interrupt
pulses_interrupt:
    BY_MODULE PULSES_MODULE
    rjmp interrupt
freeport_interrupt:
    BY_MODULE FREEPORT_MODULE
    rjmp interrupt
counters_interrupt:
    BY_MODULE COUNTERS_MODULE
interrupt:
    push r0
    in r0, SREG
    push r0
    push r31
    ldi r31, hi8(SLOT_START)
    lpm r0, Z+
    lpm r31, Z
    mov r30, r0
    pop r0
    add r30, r0
    brcc 1f
    inc r31
1:  ijmp
