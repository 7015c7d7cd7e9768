; The rest of the dispatch: vectors whose code is long, operands, what handlers end with.

; Before a native program jumps back. Means: plc-vm interpreter.rs go_to.
; in: -   out: r24 0: the scan may go on   destroys: what C functions may, T
loop_vector:
    lds r18, UNO200_TICK
    lds r19, CONTEXT + TICK
    ldi r24, 0
    cpse r18, r19
    rjmp ask_watchdog
    ret

; STOP of a native program. Means: plc-vm instructions.rs stop.
; in: -   ends: leaves the program
stop_vector:
    ldi r24, LEFT_BY_STOP
    rjmp leave_here

; The watchdog of a native program.
; in: r25:r24 place, an offset in the bytecode   ends: leaves the program
watchdog_vector:
    subi r24, lo8(-(SLOT_START + 2))
    sbci r25, hi8(-(SLOT_START + 2))
    sts CONTEXT + LEFT_AT, r24
    sts CONTEXT + LEFT_AT + 1, r25
    ldi r24, LEFT_BY_WATCHDOG
    rjmp leave_here

; Whether data memory may be written there.
; in: X address, Y as for leave   out: -   destroys: -   Does not return if not.
check_output:
    cpi r27, hi8(DATA_START)
    brlo 1f
; The same for an address that is not below data memory.
; in: X address, Y as for leave   out: -   destroys: -
check_end:
    cpi r27, hi8(DATA_END)
    brsh 1f
    ret
1:  jmp outside

; Calls of Rust are after the table: the linker shortens them, and the table must not move.
; in: -   out: r24 not 0: the scan takes too long   destroys: what C functions may, T
ask_watchdog:
    jmp uno200_is_overdue
; in: -   out: r25:r22 the clock in milliseconds   destroys: what C functions may, T
now_vector:
    jmp uno200_now
; The serial line is the firmware's again.
; in: -   out: -   destroys: what C functions may, T
line_vector:
    jmp uno200_set_up_line
; in: -   out: Z data address of the time of day   destroys: -
state_vector:
    ldi r30, lo8(TIME_OF_DAY)
    ldi r31, hi8(TIME_OF_DAY)
    ret

; A word, constant or in memory. Means: plc-vm memory.rs int_of.
; in: Z mode byte and word   out: r25:r24 value, Z after them   destroys: r20, X
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

; The same for a byte. Means: plc-vm memory.rs byte_of.
; in: Z mode byte and word   out: r25:r24 value, Z after them   destroys: r20, X
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
; in: Y   ends: goes on three bytes after Y
skip_3:
    adiw r28, 3
    NEXT
; in: Y   ends: goes on a byte after Y
skip_1:
    adiw r28, 1
    rjmp next
; in: Y   ends: goes on two bytes after Y
skip_2:
    adiw r28, 2
    NEXT

; in: zero flag, Z the next instruction   ends: goes on there with T 0 if it is set, otherwise 1
top_from_flag:
    clt
    breq 1f
    set
1:
; in: Z the next instruction   ends: goes on there; r27 was destroyed
next_z_x:
    ldi r27, 1
; in: Z the next instruction   ends: goes on there
next_z:
    NEXT_Z
; in: Y the next instruction   ends: goes on there; r27 was destroyed
next_x:
    ldi r27, 1
; in: Y the next instruction   ends: goes on there
next:
    NEXT

; in: r26 the token of the next instruction, Y after it   ends: goes on with it
next_one_byte:
    NEXT_ONE_BYTE

; What is not in the instruction table. Means: plc-vm instructions.rs undefined.
; in: Y as for leave   ends: leaves the program
rest:
    jmp outside
