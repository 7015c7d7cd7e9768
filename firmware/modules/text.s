; Module 3: strings, and numbers as characters. They do what plc-vm does (plc/vm/src/modules: text.rs, ascii.rs, numeral.rs).
;
; Strings stand in data memory or, as constants, in flash: one subroutine reads both. Numbers of 64 bits stand on the
; hardware stack, the most significant byte first.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB text_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB abandon, ABANDON

.equ CHARACTERS_MAX, 254
.equ FIRST_COMPARISON, 6

; ---- strings

; The next byte at Z, in memory or in flash (0x6000 and above), in r0.
fetch:
    sbrc r31, 6
    rjmp 1f
    ld r0, Z+
    ret
1:  lpm r0, Z+
    ret

; The string at X with room Z: its length in r0, X at its characters. No carry: it is too long, or leaves its room.
begin:
    movw r24, r30
    movw r30, r26
    rcall fetch
    movw r26, r30
    inc r0
    breq 1f
    cp r24, r0
    cpc r25, r1
    dec r0
    ...
