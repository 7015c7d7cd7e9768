; Moves. As all handlers (contacts.s).

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
