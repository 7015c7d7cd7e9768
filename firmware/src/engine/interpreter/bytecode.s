; What native programs call for bytecode.

; Executes instructions of a native program that are bytecode; the last one is MainEnd.
; in: Z their address in flash, T, r16   out: T, r16 as they leave them   destroys: r0, r17-r27, Z
bytecode_vector:
    PUSH_KEPT
    FOR_HANDLERS
    call landed
    POP_KEPT
    ret
