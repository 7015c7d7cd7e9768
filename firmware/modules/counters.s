; Not written yet.
.include "interface.inc"

; not yet: Hdef Hsc

first_input:
second_input:
any_input:
    INTERRUPT_DONE
