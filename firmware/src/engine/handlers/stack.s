; The logic stack. As all handlers (contacts.s).

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
