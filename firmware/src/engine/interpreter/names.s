; The fast engine: its names, and the macros by which handlers check operands and go on.
;
; Token threading: each handler ends by fetching the next token and its first operand byte and
; jumping through a table of 256 entries, so that no byte can lead outside. r26 and r27 are X, r28
; and r29 are Y, r30 and r31 are Z.

.equ SREG, 0x3F
; GPIOR1: what modules have taken over.
.equ MODULE_FLAGS, 0x2A
.equ STACK_LOW, 0x3D
.equ STACK_HIGH, 0x3E
; The bit of SREG that says "less" after a comparison of signed numbers.
.equ SIGN, 4
; The pins of I0.0 to I0.3, whose edges are events.
.equ PIND, 0x09
.equ EDGE_PINS, 0x3C
; SMB0 with the first scan, and SMB1 with what a result is like.
.equ SYSTEM_BITS, SM_START
.equ FIRST_SCAN, 1
.equ RESULT_BITS, SM_START + 1
; SMB4 with the bit for a run-time programming problem.
.equ ERROR_BITS, SM_START + 4
.equ PROGRAMMING_ERROR, 3
; In the image's table of timers.
.equ STARTED_BY_TOF, 1

; Entries of a status window: 2 bytes for Y at the instruction, 2 for the address of the operand
; with its size in the upper 4 bits, 2 for the logic stack, 4 for what is at that address. The
; stack is SREG, in which bit 7 is set and bit 6 the top, and the levels below. The last entry is
; followed by 0xFFFF.
.equ WINDOW_ENTRY_LEN, 10
.equ WINDOW_Y_LEN, 2
.equ WINDOW_END, 0xFF
.equ WINDOW_ADDRESS, 0x0F
; Steps begin no farther before a window. No more bytes lie between two places where the program
; looks whether they are to.
.equ WINDOW_APPROACH, APPROACH_LEN + 2
; A window and the way to it touch so many pages of 256 bytes at most.
.equ WINDOW_PAGES, (WINDOW_LEN - 1 + WINDOW_APPROACH) / 256 + 2

; ---- dispatch

; Flash can change under a running program until the self-test has seen it: no operand may lead far.
; What is read stays below 0x0800, what is written in data memory and the four bytes after it,
; which the linker keeps free.
.macro READABLE high
    andi \high, 0x07
.endm

; Goes to `bad` when X is outside data memory.
.macro CHECK_OUTPUT bad
    cpi r27, hi8(DATA_START)
    brlo \bad
    cpi r27, hi8(DATA_END)
    brsh \bad
.endm

; Flags of r24 and r25 minus r22 and r23, or the other way round.
.macro COMPARE order
.ifc \order, swapped
    cp r22, r24
    cpc r23, r25
.else
    cp r24, r22
    cpc r25, r23
.endif
.endm

; The word whose address begins with r26 in r24 and r25, the address after that in X, Z behind both.
.macro WORD_AND_ADDRESS
    movw r30, r28
    lpm r27, Z+
    lpm r20, Z+
    lpm r21, Z+
    READABLE r27
    ld r25, X+
    ld r24, X
    movw r26, r20
.endm

; Flags of one word minus another, or the other way round: both by their addresses. Z behind them.
.macro COMPARE_WORDS order
    WORD_AND_ADDRESS
    READABLE r27
    ld r23, X+
    ld r22, X
    ldi r27, 1
    COMPARE \order
.endm

; The same for a word by its address, which begins with r26, and the constant after it.
.macro COMPARE_CONSTANT order
    movw r30, r28
    lpm r27, Z+
    lpm r22, Z+
    lpm r23, Z+
    READABLE r27
    ld r25, X+
    ld r24, X
    ldi r27, 1
    COMPARE \order
.endm

; IN1 of a box in r22 and r23, OUT in r24 and r25, X at the low byte of OUT, Z behind the operands.
.macro BOX_OUT bad
    lpm r27, Z+
    CHECK_OUTPUT \bad
    ld r25, X+
    ld r24, X
.endm
.macro WORD_BOX bad
    movw r30, r28
    lpm r27, Z+
    READABLE r27
    ld r23, X+
    ld r22, X
    lpm r26, Z+
    BOX_OUT \bad
.endm
.macro CONSTANT_BOX bad
    mov r22, r26
    movw r30, r28
    lpm r23, Z+
    lpm r26, Z+
    BOX_OUT \bad
.endm

; The program goes step by step no more, or not yet.
.macro NO_STEPS
    ldi r24, hi8(JUMP_TABLE / 2)
    mov r3, r24
.endm

; What all handlers find: the upper byte of the bit page, and beside the token in r2 that of their
; table.
.macro FOR_HANDLERS
    NO_STEPS
    ldi r27, 1
.endm

; Goes to `near` when a status window may begin soon after an address with this upper byte.
.macro GO_WHERE_NEAR high, near
    lds r24, CONTEXT + WINDOW_PAGE
    sub r24, \high
    cpi r24, WINDOW_PAGES
    brlo \near
.endm

; After an instruction of more than two bytes, Z at the next one.
.macro NEXT_Z
    lpm r2, Z+
    lpm r26, Z+
    movw r28, r30
    movw r30, r2
    ijmp
.endm

; After an instruction of two bytes.
.macro NEXT
    movw r30, r28
    NEXT_Z
.endm

; After an instruction of one byte: its operand byte is the next token.
.macro NEXT_ONE_BYTE
    movw r30, r28
    mov r2, r26
    lpm r26, Z+
    movw r28, r30
    movw r30, r2
    ijmp
.endm
