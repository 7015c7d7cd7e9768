; Frames of Modbus RTU on the serial line: the interrupts of a received character, of an empty
; transmitter, and of the pause after a character, which Timer2 measures. What is in a frame is not
; known here.
;
; Requests are written to data memory as they come, to the frame of the engine (link.s), without
; address but with checksum; answers are read from there. Over a whole frame the checksum is 0. r31
; is on the stack when an interrupt begins.

.equ TIFR2, 0x17
.equ TIMSK2, 0x70
.equ COMPARE_2A, 1 << 1
.equ TCNT2, 0xB2
.equ UCSR0A, 0xC0
; Frame, overrun, parity.
.equ ERRORS, 0x1C
.equ UCSR0B, 0xC1
.equ TELLS_EMPTY, 1 << 5
.equ UDR0, 0xC6
.equ SREG, 0x3F

.macro ENTER_LINE
    push r30
    push r25
    push r24
    in r24, SREG
    push r24
.endm

.section .text.uno200_line, "ax", @progbits

; The first character of a frame: for this unit, or for all.
; in: r24 character, as in uno200_character   ends: the interrupt
first:
    sts RTU + RTU_ADDRESS, r24
    lds r25, RTU + RTU_UNIT
    tst r24
    breq 1f
    cpse r24, r25
    rjmp ignore
1:  ldi r25, RECEIVING
    sts RTU + RTU_STATE, r25
    lds r25, FRAME
    sts RTU + RTU_NEXT, r25
    lds r25, FRAME + 1
    sts RTU + RTU_NEXT + 1, r25
    lds r25, RTU + RTU_ROOM
    sts RTU + RTU_LEFT, r25
; in: r24 first byte of a frame   ends: the interrupt, with its checksum in RTU_CRC
begin_crc:
    ldi r30, 0xFF
    ldi r31, 0xFF
    rjmp crc_step

; Until the next pause.
; in: -   ends: the interrupt
ignore:
    ldi r31, IGNORING
    sts RTU + RTU_STATE, r31
    rjmp leave_line

; A character was received.
; in: r31 on the hardware stack   ends: the interrupt
.global uno200_character
uno200_character:
    ENTER_LINE
    lds r25, UCSR0A
    lds r24, UDR0
    lds r31, RTU + RTU_STATE
    cpi r31, BUSY
    brsh leave_line
    ; The pause begins anew.
    ldi r30, 0
    sts TCNT2, r30
    ldi r30, COMPARE_2A
    out TIFR2, r30
    sts TIMSK2, r30
    andi r25, ERRORS
    brne ignore
    cpi r31, RECEIVING
    brlo first
    brne leave_line
    ; What there is no room for is counted only.
    lds r31, RTU + RTU_LEFT
    cpi r31, TOO_LONG
    breq only_crc
    subi r31, 1
    sts RTU + RTU_LEFT, r31
    brcs only_crc
    lds r30, RTU + RTU_NEXT
    lds r31, RTU + RTU_NEXT + 1
    st Z+, r24
; in: Z place of the next byte, r24 this one   ends: the interrupt, with the checksum over both
next_byte:
    sts RTU + RTU_NEXT, r30
    sts RTU + RTU_NEXT + 1, r31
; in: r24 byte   ends: the interrupt, with the checksum over it, too
only_crc:
    lds r30, RTU + RTU_CRC
    lds r31, RTU + RTU_CRC + 1
; The checksum over one more byte: its polynomial has so few terms that a byte is a parity and two
; shifts.
; in: r31, r30 checksum, r24 byte   ends: the interrupt, with the new one in RTU_CRC
crc_step:
    eor r30, r24
    mov r24, r30
    swap r24
    eor r24, r30
    mov r25, r24
    lsr r25
    lsr r25
    eor r24, r25
    mov r25, r24
    lsr r25
    eor r24, r25
    andi r24, 1
    mov r25, r31
    eor r25, r24
    lsr r24
    ror r30
    ror r24
    mov r31, r30
    eor r25, r24
    lsr r30
    ror r24
    eor r31, r30
    eor r25, r24
    sts RTU + RTU_CRC, r25
    sts RTU + RTU_CRC + 1, r31
; in: the hardware stack as ENTER_LINE leaves it   ends: the interrupt
leave_line:
    pop r24
    out SREG, r24
    pop r24
    pop r25
    pop r30
    pop r31
    reti

; The pause has lasted long enough.
; in: r31 on the hardware stack   ends: the interrupt
.global uno200_pause
uno200_pause:
    ENTER_LINE
    ldi r24, LISTENING
    sts TIMSK2, r24
    lds r25, RTU + RTU_STATE
    cpi r25, IGNORING
    breq 1f
    cpi r25, RECEIVING
    brne leave_line
    lds r30, RTU + RTU_CRC
    lds r31, RTU + RTU_CRC + 1
    or r30, r31
    brne 1f
    ldi r24, COMPLETE
1:  sts RTU + RTU_STATE, r24
    rjmp leave_line

; The transmitter has room for a byte: the address, then what is in the frame, then the checksum.
; in: -   ends: the interrupt
.global __vector_19
__vector_19:
    push r31
    ENTER_LINE
    lds r31, RTU + RTU_STATE
    cpi r31, SENDING
    brne 1f
    lds r25, RTU + RTU_LEFT
    subi r25, 1
    sts RTU + RTU_LEFT, r25
    cpi r25, CRC_LEN
    brlo 2f
    lds r30, RTU + RTU_NEXT
    lds r31, RTU + RTU_NEXT + 1
    ld r24, Z+
    sts UDR0, r24
    rjmp next_byte
1:  ldi r31, SENDING
    sts RTU + RTU_STATE, r31
    lds r24, RTU + RTU_UNIT
    sts UDR0, r24
    rjmp begin_crc
2:  lds r24, RTU + RTU_CRC
    lds r31, RTU + RTU_CRC + 1
    sts RTU + RTU_CRC, r31
    sts UDR0, r24
    tst r25
    brne 3f
    ; That was the last one.
    sts RTU + RTU_STATE, r25
    lds r24, UCSR0B
    andi r24, lo8(~TELLS_EMPTY)
    sts UCSR0B, r24
3:  rjmp leave_line
