; Module 6: intervals. The board has no clock that keeps the time of day, and no freeport mode: TODR TODW XMT RCV are run-time
; errors.

.include "interface.inc"

OPERANDS
STUB read_double, READ + 4
STUB target_double, WRITE + 4
STUB abandon, ABANDON

Bitim:
    call MODULE_NOW
    rjmp write

; OUT := the time that has passed since IN.
Citim:
    call MODULE_NOW
    movw r18, r22
    movw r20, r24
    rcall read_double
    sub r18, r22
    sbc r19, r23
    sbc r20, r24
    sbc r21, r25
    movw r22, r18
    movw r24, r20
write:
    rcall target_double
    st X+, r25
    st X+, r24
    st X+, r23
    st X, r22
    ; The firmware's own code may have changed it.
    set
    DONE

Todr:
Todw:
Xmt:
Rcv:
    rjmp abandon
