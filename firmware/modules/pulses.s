; Not written yet.
.include "interface.inc"

; not yet: Pls AnalogOutputs

cycle_end:
    INTERRUPT_DONE
