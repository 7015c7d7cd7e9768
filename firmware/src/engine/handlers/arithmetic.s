; Integer arithmetic. As all handlers (contacts.s).

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
