; Setting and resetting of bits, timers and counters; NOP and LBL. As all handlers (contacts.s).

% Set PageBitOut One
    brtc pass
    ld r24, X
    ori r24, 1 << {n}
    st X, r24
    rjmp pass

% Nop Number
% Lbl LabelNumber
; In the middle, where short branches reach it from both sides.
; in: Y the next instruction   ends: goes on there
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

; in: r26, Y packed bit and count, r21 as set_bits   ends: goes on after them
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

; in: r26 first number, Y count, r23 as r27 of reset_numbers   ends: goes on after them
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

; in: r26 first number, Y address of the count, r23 as r27 of reset_numbers
; ends: goes on after them
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
