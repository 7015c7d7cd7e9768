; Comparisons of words: by relation, with the flags of IN1 - IN2; of IN2 - IN1 for > and <=.
; Comparisons of bytes. As all handlers (contacts.s).

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

; ---- comparisons of bytes, and of whatever is after the prefix: smaller rather than fast

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
