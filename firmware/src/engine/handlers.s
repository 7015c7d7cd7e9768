; The handlers of the fast engine, one block for each form of an instruction that has one.
;
; A block begins with % and the form as the instruction table writes it: instruction, kinds of its operands. The build
; script enters it for the tokens of that form; {n} becomes the token's distance from the form's first one (bit or
; relation), {token} that first one; {order}, {branch} and {inverse} follow from the relation. Every form of the core has
; one. Subroutines and macros stand in engine.s. Numbered labels reach into the next block here and
; there: blocks of one kind stay together.
;
; At the start of a block: r2 token, X the address of the operand byte in the bit page, Y the address in flash behind
; token and operand byte, T the top of the logic stack, r16 the levels below, S1 in bit 0. To keep: Y (or behind more
; of the instruction), r3, r16, r27 = 1 (next_x restores it), r1 = 0. What goes on elsewhere than behind itself does so at
; `landed`, with the address in Z. Free: r0, r2, r17 to r26, r30, r31.

; ---- contacts

% Ld PageBit
    lsl r16
    bld r16, 0
    ld r24, X
    bst r24, {n}
    NEXT

% Ldn PageBit
    lsl r16
    bld r16, 0
    ld r24, X
    com r24
    bst r24, {n}
    NEXT

% A PageBit
    ld r24, X
    sbrs r24, {n}
    clt
    NEXT

% An PageBit
    ld r24, X
    sbrc r24, {n}
    clt
    NEXT

% O PageBit
    ld r24, X
    sbrc r24, {n}
    set
    NEXT

% On PageBit
    ld r24, X
    sbrs r24, {n}
    set
    NEXT

% Ld FarBit
    rcall load_far_bit
    rjmp 1f

% Ldn FarBit
    rcall load_far_bit
    com r24
1:  lsl r16
    bld r16, 0
    and r24, r19
    rjmp top_from_flag

; Within a sequence segment: the SCR bit.
% ScrAnd FarBit
% A FarBit
    rcall load_far_bit
    rjmp 1f

% An FarBit
    rcall load_far_bit
    com r24
1:  and r24, r19
    brne 2f
    clt
2:  rjmp next_z_x

% O FarBit
    rcall load_far_bit
    rjmp 1f

% On FarBit
    rcall load_far_bit
    com r24
1:  and r24, r19
    breq 2f
    set
2:  rjmp next_z_x

% Not
    bld r24, 0
    com r24
    bst r24, 0
    NEXT_ONE_BYTE

% Eu Edge
    rcall remember_edge
    breq 1f
    clt
1:  rjmp next

% Ed Edge
    rcall remember_edge
    brts 1f
    breq 2f
    sbrs r19, 1
    set
    rjmp next
1:  clt
2:  rjmp next

; ---- coils

% Assign PageBitOut
    ld r24, X
    bld r24, {n}
    st X, r24
    NEXT

% Assign FarBitOut
assign_far:
    rcall load_far_bit
    or r24, r19
    brts 1f
    eor r24, r19
1:  st X, r24
    rjmp next_z_x

; The bit in T, as it stood before the bit was loaded in r17; Y and r26 at the next operand.
% BitCopy FarBit FarBitOut
    bld r17, 0
    rcall take_far_bit
    rcall assign_second
    bst r17, 0
    rjmp next_z_x

; ---- sequence control

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

% Cscre ScrBit
    brts 1f
    rjmp skip_1
1:  clt
    rcall assign_second
    set
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
    mov r24, r26
    clr r25
    lsl r24
    rol r25
    lsl r24
    rol r25
    add r30, r24
    adc r31, r25
    lpm r24, Z+
    lpm r25, Z
    movw r30, r24
    subi r31, hi8(-(SLOT_START))
    rjmp landed
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

; Events are the module's. It is asked when pins, T32 and T96, or the clock are others than at the last poll, and for the
; instructions.
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

% Set PageBitOut One
    brtc pass
    ld r24, X
    ori r24, 1 << {n}
    st X, r24
    rjmp pass

; In the middle, where short branches reach it from both sides.
% Nop Number
% Lbl LabelNumber
pass:
    NEXT

% Reset PageBitReset One
    brtc pass
    ld r24, X
    andi r24, 0xFF ^ (1 << {n})
    st X, r24
    rjmp pass

% Set FarBitOut Count
    ldi r21, 0
    brts write_range
    rjmp skip_2

% Reset FarBitReset Count
    ldi r21, 0xFF
    brts write_range
    rjmp skip_2

write_range:
    rcall load_far_bit
    lpm r18, Z+
    rcall set_bits
    rjmp next_z_x

% ResetTimers TimerNumber Count
    ldi r23, hi8((T_BITS_START - 0x0100) << 3)
    brts reset_constant
    rjmp skip_1

% ResetCounters CounterNumber Count
    ldi r23, hi8((C_BITS_START - 0x0100) << 3)
    brts reset_constant
    rjmp skip_1

reset_constant:
    movw r30, r28
    lpm r18, Z+
    movw r28, r30
    mov r27, r23
    rjmp reset_numbers

% ResetTimers TimerNumber Byte
    ldi r23, hi8((T_BITS_START - 0x0100) << 3)
    brts reset_byte
    rjmp skip_2

% ResetCounters CounterNumber Byte
    ldi r23, hi8((C_BITS_START - 0x0100) << 3)
    brts reset_byte
    rjmp skip_2

reset_byte:
    mov r22, r26
    movw r30, r28
    lpm r26, Z+
    lpm r27, Z+
    movw r28, r30
    READABLE r27
    ld r18, X
    movw r26, r22
    rjmp reset_numbers

; ---- logic stack

% Ald
    lsr r16
    brcs 1f
    clt
1:  NEXT_ONE_BYTE

% Old
    lsr r16
    brcc 1f
    set
1:  NEXT_ONE_BYTE

% Lps
    lsl r16
    bld r16, 0
    NEXT_ONE_BYTE

% Lrd
    bst r16, 0
    NEXT_ONE_BYTE

% Lpp
    bst r16, 0
    lsr r16
    NEXT_ONE_BYTE

% Lds Level
    mov r24, r16
    clr r25
    lsl r24
    rol r25
    bld r24, 0
1:  subi r26, 1
    brcs 2f
    lsr r25
    ror r24
    rjmp 1b
2:  lsl r16
    bld r16, 0
    bst r24, 0
    rjmp next

; ---- comparisons of words: by relation, with the flags of IN1 - IN2; of IN2 - IN1 for > and <=

% Ldw Relation Word Word
    lsl r16
    bld r16, 0
    rcall compare_words_{order}
    set
    {branch} 1f
    clt
1:  rjmp next_z

% Aw Relation Word Word
    rcall compare_words_{order}
    {branch} 1f
    clt
1:  rjmp next_z

% Ow Relation Word Word
    rcall compare_words_{order}
    {inverse} 1f
    set
1:  rjmp next_z

% Ldw Relation Word IntConst
    lsl r16
    bld r16, 0
    COMPARE_CONSTANT {order}
    set
    {branch} 1f
    clt
1:  NEXT_Z

% Aw Relation Word IntConst
    COMPARE_CONSTANT {order}
    {branch} 1f
    clt
1:  NEXT_Z

% Ow Relation Word IntConst
    rcall compare_constant_{order}
    {inverse} 1f
    set
1:  rjmp next_z

; ---- comparisons of bytes, and of whatever stands behind the prefix: smaller rather than fast

% Ldb Relation Byte Byte
% Ab Relation Byte Byte
% Ob Relation Byte Byte
    mov r18, r2
    subi r18, {token}
    rjmp compare_bytes

% Ldb Relation Byte ByteConst
% Ab Relation Byte ByteConst
% Ob Relation Byte ByteConst
    mov r18, r2
    subi r18, {token}
    rjmp compare_byte_constant

% wide Ldw Relation AnyInt AnyInt
% wide Aw Relation AnyInt AnyInt
% wide Ow Relation AnyInt AnyInt
% wide Ldb Relation AnyByte AnyByte
% wide Ab Relation AnyByte AnyByte
% wide Ob Relation AnyByte AnyByte
    rjmp compare_any

; ---- moves

% Movb Byte ByteOut
    brtc 1f
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    ld r24, X
    rjmp 2f
1:  rjmp skip_3

% Movb ByteConst ByteOut
    brtc 1f
    mov r24, r26
    movw r30, r28
2:  lpm r26, Z+
    lpm r27, Z+
    rcall check_output
    st X, r24
    rjmp next_z_x
1:  rjmp skip_2

% Movw Word WordOut
    brtc 1f
    WORD_AND_ADDRESS
    rjmp 2f
1:  adiw r28, 3
    NEXT

% Movw WordConst WordOut
    brtc 1b
    mov r24, r26
    movw r30, r28
    lpm r25, Z+
    lpm r26, Z+
    lpm r27, Z+
2:  CHECK_OUTPUT 3f
    st X+, r25
    st X, r24
    ldi r27, 1
    NEXT_Z
3:  rjmp outside_afar

; ---- program control

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
; Goes back to Z as long as the watchdog allows.
go_back:
    lds r18, UNO200_TICK
    lds r19, CONTEXT + TICK
    cpse r18, r19
    rjmp 3f
; Goes on at Z, which need not be behind this instruction: a status window may be there.
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
leave_afar:
    jmp leave

% Approach
    NO_STEPS
    GO_WHERE_NEAR r29, 1f
    NEXT_ONE_BYTE
1:  movw r30, r28
    sbiw r30, 1
; The page may be the right one. r4 to r15 are as steps know them, unless changed flash has led here without a window.
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

; The end of a routine is another, unless flash has changed.
% MainEnd
end_of_main:
    lds r18, CONTEXT + DEPTH
    cpse r18, r1
    rjmp outside_afar
    ret

; ---- integer arithmetic

% AddInt Word WordOut
    brtc 1f
    WORD_BOX 2f
    add r24, r22
    adc r25, r23
    rjmp write_result

% AddInt IntConst WordOut
    brtc 1f
    CONSTANT_BOX 2f
    add r24, r22
    adc r25, r23
    rjmp write_result
1:  rjmp skip_3
2:  rjmp outside_afar

% SubInt Word WordOut
    brtc 1b
    WORD_BOX 2b
    sub r24, r22
    sbc r25, r23
    rjmp write_result

% SubInt IntConst WordOut
    brtc 1b
    CONSTANT_BOX 2b
    sub r24, r22
    sbc r25, r23
    rjmp write_result

% Incw WordOut
    brtc 1f
    movw r30, r28
    BOX_OUT 2f
    subi r24, 0xFF
    sbci r25, 0xFF
    rjmp write_wrapped
1:  rjmp skip_1
2:  rjmp outside_afar

% Decw WordOut
    brtc 1b
    movw r30, r28
    BOX_OUT 2b
    subi r24, 1
    sbci r25, 0
    rjmp write_wrapped

% MulInt Word WordOut
    brtc 1f
    rcall word_box
    rjmp multiply

% MulInt IntConst WordOut
    brtc 1f
    rcall constant_box
    rjmp multiply
1:  rjmp skip_3

% DivInt Word WordOut
    brtc 1b
    rcall word_box
    rjmp divide

% DivInt IntConst WordOut
    brtc 1b
    rcall constant_box
    rjmp divide

; ---- timers and counters

% Ton TimerSlot IntConst
    rcall timer_constant
    rcall on_delay
    rjmp next_x

% Ton TimerSlot Word
    rcall timer_word
    rcall on_delay
    rjmp next_x

% Tof TimerSlot IntConst
    rcall timer_constant
    rcall off_delay
    rjmp next_x

% Tof TimerSlot Word
    rcall timer_word
    rcall off_delay
    rjmp next_x

% Tonr TimerSlot IntConst
    rcall timer_constant
    rcall retentive_on_delay
    rjmp next_x

% Tonr TimerSlot Word
    rcall timer_word
    rcall retentive_on_delay
    rjmp next_x

% Ctu CounterSlot IntConst
    rcall counter_constant
    rcall count_up
    rjmp next_x

% Ctu CounterSlot Word
    rcall counter_word
    rcall count_up
    rjmp next_x

% Ctd CounterSlot IntConst
    rcall counter_constant
    rcall count_down
    rjmp next_x

% Ctd CounterSlot Word
    rcall counter_word
    rcall count_down
    rjmp next_x

% Ctud CounterSlot IntConst
    rcall counter_constant
    rcall count_up_down
    rjmp next_x

% Ctud CounterSlot Word
    rcall counter_word
    rcall count_up_down
    rjmp next_x
