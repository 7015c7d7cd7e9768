; Contacts and coils. And what a handler is, here and in the other files of this folder: a block for
; each form of an instruction that has one.
;
; A block begins with % and the form as the instruction table writes it: instruction, kinds of its
; operands. The build script enters it for the tokens of that form; {n} becomes the token's distance
; from the form's first one (bit or relation), {token} that first one; {order}, {branch} and
; {inverse} follow from the relation. Every form of the core has one. It means the method of plc-vm
; (plc/vm/src/instructions.rs) that the row of its instruction names. Subroutines and macros are in
; the folder interpreter. Numbered labels reach into the next block here and there: the files are
; put together in the order that the build script has, and blocks of one kind stay together.
;
; At the start of a block: r2 token, X the address of the operand byte in the bit page, Y the
; address in flash after token and operand byte, T the top of the logic stack, r16 the levels
; below, S1 in bit 0. To keep: Y (or after more of the instruction), r3, r16, r27 = 1 (next_x
; restores it), r1 = 0. What goes on elsewhere than after itself does so at `landed`, with the
; address in Z. Free: r0, r2, r17 to r26, r30, r31.
;
; What is above a label, here and in all assembly of the firmware, modules/interface.inc describes:
; what the routine does, the function of plc-vm or plc-link that means the same, and what it takes,
; gives and destroys.

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
; The bit r26 with the byte at Y := T. Means: plc-vm instructions.rs assign.
; in: r26, Y a packed bit, T   ends: goes on after it
assign_far:
    rcall load_far_bit
    or r24, r19
    brts 1f
    eor r24, r19
1:  st X, r24
    rjmp next_z_x

; The bit in T, as it was before the bit was loaded in r17; Y and r26 at the next operand.
% BitCopy FarBit FarBitOut
    bld r17, 0
    rcall take_far_bit
    rcall assign_second
    bst r17, 0
    rjmp next_z_x
