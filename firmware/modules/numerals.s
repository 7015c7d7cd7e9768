; Module 11: numbers as characters and back, hexadecimal digits. They do what plc-vm does
; (plc/vm/src/modules: ascii.rs, numeral.rs). Numbers of 64 bits are on the hardware stack, the
; most significant byte first.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB abandon, ABANDON

.include "strings.inc"

.include "hexadecimal.inc"
.include "number.inc"
.include "number_to_text.inc"
.include "text_to_number.inc"
