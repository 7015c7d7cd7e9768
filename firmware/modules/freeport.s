; Module 10: the serial line in freeport mode: XMT, RCV, and Freeport, which the assembler puts
; after what writes SMB30. It means what plc-vm means (plc/vm/src/modules/freeport.rs), and beside
; that it knows what only a real line has: errors of characters, and the break that XMT of no
; characters sends.
;
; The line belongs to the firmware, or to this module while FREEPORT_ON is set. Characters are moved
; by interrupts, between the line and the program's memory. A timer of its own counts milliseconds
; from the last character, or from what else a time is measured from. Routines share the state with
; the interrupts: they change it with interrupts disabled.
;
; SM4.5, the transmitter is idle, is in a byte that others read and write back. An interrupt
; within that is forgotten, so that each tick of the timer says it again.

.include "interface.inc"

OPERANDS
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB abandon, ABANDON

; ---- registers of the processor

.equ DDRD, 0x0A
.equ TRANSMIT_PIN, 1
.equ TIFR2, 0x17
.equ TIMSK2, 0x70
.equ COMPARE_2A, 1
.equ TCCR2A, 0xB0
.equ CLEAR_ON_COMPARE, 2
.equ TCCR2B, 0xB1
.equ PRESCALE_64, 4
.equ TCNT2, 0xB2
.equ OCR2A, 0xB3
.equ COUNTS_PER_MS, 250
.equ UCSR0A, 0xC0
.equ TRANSMITTED, 1 << 6
.equ DOUBLE_SPEED, 1 << 1
; Frame, overrun, parity.
.equ ERRORS, 0x1C
.equ UCSR0B, 0xC1
.equ RECEIVES, 1 << 7 | 1 << 4
.equ TRANSMITS, 1 << 3
.equ TELLS_TRANSMITTED, 1 << 6
; The firmware has more to send.
.equ TELLS_EMPTY, 5
.equ UCSR0C, 0xC2
.equ BITS_8, 0x06
.equ BITS_7, 0x04
.equ PARITY_EVEN, 0x20
.equ PARITY_ODD, 0x10
.equ UBRR0L, 0xC4
.equ UBRR0H, 0xC5
.equ UDR0, 0xC6

; ---- special memory

.equ RECEIVED, 0x0142
.equ CHARACTER_ERROR, 0x0143
.equ SETTINGS, 0x015E
; Bit of SMB4.
.equ IDLE, 5
; In SMB30.
.equ MODE_MASK, 0x03
.equ FREEPORT, 0x01
.equ RATE_MASK, 0x1C
.equ HAS_7_BITS, 5
.equ HAS_PARITY, 6
.equ IS_ODD, 7

; From SMB86 on: status, control, start and end character, idle time, time limit, most characters.
.equ RECEIVE, SPECIAL_IN_RANGES + 86
.equ CONTROL_AT, 1
.equ START_AT, 2
.equ END_AT, 3
.equ IDLE_TIME_AT, 4
.equ LIMIT_AT, 6
.equ COUNT_MAX_AT, 8
; Control.
.equ ENABLE, 7
.equ USE_START, 6
.equ USE_END, 5
.equ USE_IDLE, 4
.equ WHOLE_MESSAGE, 3
.equ USE_LIMIT, 2
.equ USE_BREAK, 1
; Status.
.equ STOPPED, 0x80
.equ WRONG, 0x40
.equ AT_END, 0x20
.equ AT_LIMIT, 0x04
.equ AT_COUNT, 0x02
.equ AT_ERROR, 0x01

; ---- state

; XMT is under way; RCV is; its message has begun; the line is not the module's yet.
.equ STATE, FREEPORT_STATE
.equ SENDING, 0
.equ RECEIVING, 1
.equ BEGUN, 2
.equ SETTLING, 3
; Milliseconds until it is, or until a break is over.
.equ PAUSE, FREEPORT_STATE + 1
; What the line is set up as: SMB30, and what follows from it.
.equ IN_FORCE, FREEPORT_STATE + 2
.equ DIVIDER, FREEPORT_STATE + 3
.equ BREAK_LEN, FREEPORT_STATE + 5
.equ FORMAT, FREEPORT_STATE + 6
; XMT: characters that are left, address of the next.
.equ LEFT, FREEPORT_STATE + 7
.equ NEXT, FREEPORT_STATE + 8
; RCV: the address of SMB86, control, buffer, most characters, characters.
.equ SPECIAL, FREEPORT_STATE + 10
.equ CONTROL, FREEPORT_STATE + 12
.equ BUFFER, FREEPORT_STATE + 13
.equ COUNT_MAX, FREEPORT_STATE + 15
.equ COUNT, FREEPORT_STATE + 16
; Milliseconds since the last character or RCV, or since the message began where its whole time is
; limited.
.equ ELAPSED, FREEPORT_STATE + 17

; The state above means something: since then the firmware has not left RUN.
.equ STATE_VALID, 5
; For so long at least the firmware's last characters can be on their way.
.equ SETTLING_MS, 2

.include "freeport_instructions.inc"
.include "freeport_interrupts.inc"
.include "special.inc"
