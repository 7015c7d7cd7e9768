; Vectors for native programs and modules; how a program is entered and left.

.section .progmem.gcc.engine, "ax", @progbits

; ---- vectors for native programs and modules

; A word each, at the address that plc-isa names: what they call and leave by. Timers and counters
; are as in timers.s and counters.s, the others where their labels are.
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

; u8 uno200_run(u16 address): executes bytecode. Means: plc-vm interpreter.rs run.
; in: r25:r24 address in flash   out: r24 why it was left   destroys: what C functions may
.global uno200_run
uno200_run:
    ENTER
    movw r30, r24
    FOR_HANDLERS
    clr r16
    clt
    rcall next_z
; in: the hardware stack as ENTER left it   ends: the program was executed to its end
finish:
    ldi r24, LEFT_AT_END
; in: r24 why the program was left, the hardware stack as ENTER left it   ends: returns to Rust
epilogue:
    POP_KEPT
; Where tests see that a run is over.
.global uno200_run_end
uno200_run_end:
    ret

; u8 uno200_run_native(u16 word_address): executes machine code. It may take two more arguments, as
; uno200_steps does.
; in: r25:r24 word address, r23:r22 and r21:r20 arguments   out: r24 why it was left
; destroys: what C functions may
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
; Where tests see that a run is over.
.global uno200_run_native_end
uno200_run_native_end:
    ret

; in: as uno200_run_native   out: r24 why it was left   destroys: r4-r15 and what C functions may
run_native:
    ENTER
    ldi r28, lo8(DATA_START)
    ldi r29, hi8(DATA_START)
    movw r30, r24
    clt
    icall
    rjmp finish

; An operand leads outside. Means: plc-vm instructions.rs undefined.
; in: Y as for leave   ends: leaves the program
outside:
    ldi r24, LEFT_BY_UNDEFINED
; Leaves the program from any level. Y tells the place: two bytes after the start of the
; instruction, or a little more. Means: plc-vm interpreter.rs leave.
; in: r24 the reason, Y   ends: returns to Rust
leave:
    sts CONTEXT + LEFT_AT, r28
    sts CONTEXT + LEFT_AT + 1, r29
; The same when the place is in LEFT_AT already.
; in: r24 the reason   ends: returns to Rust
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
