; The jump tables, at multiples of 512 bytes.

.org JUMP_TABLE - 512 - NATIVE_VECTORS
    .rept 256
    rjmp step
    .endr
; Where each token leads: a word for each.
.global uno200_table
uno200_table:
    ENTRIES
