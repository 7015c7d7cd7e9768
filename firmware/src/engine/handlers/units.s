; Sequence control, 1 ms timers, subroutines, ENO and events. As all handlers (contacts.s).

% Lscr FarBit ScrBit
    lsl r16
    bld r16, 0
    rcall take_far_bit
    rjmp assign_far

% Scrt FarBitOut ScrBit
    brts 1f
    rjmp skip_3
; Its own S bit first: it may be the other one, too.
1:  movw r20, r28
    mov r22, r26
    adiw r28, 1
    rcall at_operand
    clt
    rcall assign_second
    movw r0, r30
    movw r28, r20
    mov r26, r22
    set
    rcall assign_second
    movw r30, r0
    clr r1
    rjmp next_z_x

% Scre
    NEXT_ONE_BYTE

; ---- timers of 1 ms

% Refresh
    sbiw r28, 1
    bld r17, 0
    call uno200_refresh_timers
    bst r17, 0
    rjmp next_x

; ---- subroutines

% CallBegin CallEnd
    brtc 1f
    rjmp skip_1
1:  movw r30, r28
    lpm r31, Z
    mov r30, r26
    subi r31, hi8(-(SLOT_START))
    rjmp landed

% Call Routine Here
    brtc 2f
    lds r18, CONTEXT + DEPTH
    cpi r18, CALLS_MAX
    brsh 1f
    inc r18
    sts CONTEXT + DEPTH, r18
    push r28
    push r29
    push r16
    clr r16
    lds r30, CONTEXT + ROUTINES_IN_FLASH
    lds r31, CONTEXT + ROUTINES_IN_FLASH + 1
    ldi r24, ROUTINE_LEN
    mul r26, r24
    add r30, r0
    adc r31, r1
    clr r1
    rjmp go_to_end
; Too deep: SM4.3.
1:  lds r18, ERROR_BITS
    ori r18, 1 << PROGRAMMING_ERROR
    sts ERROR_BITS, r18
2:  rjmp next

% Cret
% Creti
    brts 1f
    NEXT_ONE_BYTE
% Ret
1:  lds r18, CONTEXT + DEPTH
    subi r18, 1
    brcs 1f
    sts CONTEXT + DEPTH, r18
    pop r16
    pop r31
    pop r30
    set
    rjmp landed
; Flash has changed: nothing was called.
1:  jmp outside

; ---- ENO

; Of the box before: 1 with power flow and none of the errors.
% NoteEno ErrorMask
    lds r24, RESULT_BITS
    and r24, r26
    clr r25
    bld r25, 0
    cpse r24, r1
    clr r25
    sts ENO, r25
    rjmp next

% Aeno ErrorMask
    lds r24, RESULT_BITS
    and r24, r26
    andi r24, 0x7F
    brne 1f
    lds r24, ENO
    sbrc r26, 7
    cpse r24, r1
    rjmp 2f
1:  clt
2:  rjmp next

; Events are the module's. It is asked when pins, T32 and T96, or the clock are others than at the
; last poll, and for the instructions.
% Poll Here
    in r18, PIND
    andi r18, EDGE_PINS
    lds r19, T_BITS_START + 32 / 8
    sbrc r19, 0
    ori r18, 1
    lds r19, T_BITS_START + 96 / 8
    sbrc r19, 0
    ori r18, 2
    lds r19, UNO200_TICK
    lds r20, EVENTS_SEEN
    cpse r18, r20
    rjmp events
    lds r20, EVENTS_SEEN + 1
    cpse r19, r20
    rjmp events
    NEXT_ONE_BYTE

% Atch Routine Event
% Dtch Event
% Cevnt Event
% Eni
% Disi
; What events are, their module knows. Means: plc-vm instructions.rs attach, detach, clear_event,
; enable_interrupts, disable_interrupts, poll_events.
; in: as a handler   ends: in the module, or leaves the program
events:
    ldi r30, lo8(SLOT_START + DIRECTORY_AT + 2 * EVENTS_MODULE)
    ldi r31, hi8(SLOT_START + DIRECTORY_AT + 2 * EVENTS_MODULE)
    lpm r24, Z+
    lpm r25, Z
    ; The assembler puts the module into every program that has one of these.
    sbiw r24, 0
    breq 1f
    adiw r24, EVENTS_ENTRY
    movw r30, r24
    ijmp
1:  jmp outside
