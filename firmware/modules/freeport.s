; Module 10: the serial line in freeport mode: XMT, RCV, and Freeport, which the assembler puts behind what writes
; SMB30. It means what plc-vm means (plc/vm/src/modules/freeport.rs), and beside that it knows what only a real line
; has: errors of characters, and the break that XMT of no characters sends.
;
; The line belongs to the firmware, or to this module while FREEPORT_ON is set. Characters are moved by interrupts,
; between the line and the program's memory. A timer of its own counts milliseconds from the last character, or from
; what else a time is measured from. Routines share the state with the interrupts: they change it with interrupts
; disabled.
;
; SM4.5, the transmitter is idle, stands in a byte that others read and write back. An interrupt within that is
; forgotten, so that each tick of the timer says it again.

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
; Milliseconds since the last character or RCV, or since the message began where its whole time is limited.
.equ ELAPSED, FREEPORT_STATE + 17

; The state above means something: since then the firmware has not left RUN.
.equ STATE_VALID, 5
; For so long at least the firmware's last characters can be on their way.
.equ SETTLING_MS, 2

; ---- instructions

Freeport:
    rcall look
done:
    DONE

Xmt:
    rcall bytes_in
    ld r22, X+
    sbiw r30, 1
    cp r30, r22
    cpc r31, r1
    brlo bad
    rcall look
    brne bad
    lds r24, STATE
    mov r23, r24
    andi r23, 1 << SENDING | 1 << RECEIVING
    brne bad
    in r25, SREG
    cli
    sts LEFT, r22
    sts NEXT, r26
    sts NEXT + 1, r27
    lds r23, ERROR_BITS
    andi r23, lo8(~(1 << IDLE))
    sts ERROR_BITS, r23
    ; Again: it may have settled meanwhile.
    lds r24, STATE
    ori r24, 1 << SENDING
    sts STATE, r24
    sbrs r24, SETTLING
    rcall send
    out SREG, r25
    rjmp done
bad:
    rjmp abandon

Rcv:
    ldi r24, lo8(RECEIVE)
    ldi r25, hi8(RECEIVE)
    rcall special
    brcs bad
    movw r18, r26
    movw r30, r26
    ldd r22, Z + COUNT_MAX_AT
    ldd r23, Z + CONTROL_AT
    rcall bytes_to
    sbiw r30, 1
    cp r30, r22
    cpc r31, r1
    brlo bad
    rcall look
    brne bad
    in r25, SREG
    cli
    lds r24, STATE
    sbrc r24, SENDING
    rjmp 3f
    sbrs r23, ENABLE
    rjmp 2f
    sbrc r24, RECEIVING
    rjmp 3f
    sts SPECIAL, r18
    sts SPECIAL + 1, r19
    sts BUFFER, r26
    sts BUFFER + 1, r27
    sts CONTROL, r23
    sts COUNT_MAX, r22
    sts COUNT, r1
    rcall restart_time
    ; Ticks do not come while characters keep restarting the time.
    rcall tell_idle
    ldi r24, WRONG
    mov r20, r23
    andi r20, 1 << USE_START | 1 << USE_IDLE
    breq 4f
    sbrc r23, USE_BREAK
    rjmp 4f
    tst r22
    breq 4f
    movw r30, r18
    st Z, r1
    lds r24, STATE
    ori r24, 1 << RECEIVING
    sts STATE, r24
1:  out SREG, r25
    rjmp done
    ; Stops receiving.
2:  sbrs r24, RECEIVING
    rjmp 1b
    ldi r24, STOPPED
4:  rcall end
    rjmp 1b
3:  out SREG, r25
    rjmp abandon

; Makes the line what SMB30 says. Z: freeport mode. Changes r0, r20, r21, r24, r25, Z; without freeport mode X and r18
; to r23, too.
look:
    lds r20, SETTINGS
    in r21, FLAGS
    mov r24, r20
    andi r24, MODE_MASK
    cpi r24, FREEPORT
    brne give_back
    sbrs r21, FREEPORT_ON
    rjmp take
    lds r24, IN_FORCE
    cp r24, r20
    breq 1f
    in r25, SREG
    cli
    rcall settings
    lds r24, STATE
    sbrs r24, SETTLING
    rcall set_up
    out SREG, r25
    cp r1, r1
1:  ret

; From the firmware, which has nothing more to send from now on but what it has said already.
take:
    in r25, SREG
    cli
    sbrs r21, STATE_VALID
    sts STATE, r1
    ori r21, 1 << FREEPORT_ON | 1 << STATE_VALID
    out FLAGS, r21
    ; What was being sent when the line was given back is over.
    lds r24, STATE
    sbrc r24, SENDING
    rcall all_sent
    lds r24, STATE
    ori r24, 1 << SETTLING
    sts STATE, r24
    ldi r24, SETTLING_MS
    sts PAUSE, r24
    rcall settings
    ldi r24, CLEAR_ON_COMPARE
    sts TCCR2A, r24
    ldi r24, COUNTS_PER_MS - 1
    sts OCR2A, r24
    ldi r24, PRESCALE_64
    sts TCCR2B, r24
    rcall restart_time
    ldi r24, 1 << COMPARE_2A
    sts TIMSK2, r24
    out SREG, r25
    cp r1, r1
    ret

; To the firmware, at once. Z becomes 0. The firmware sets up line and timer as a C function: r17 keeps T.
give_back:
    sbrs r21, FREEPORT_ON
    ret
    cbi DDRD, TRANSMIT_PIN
    push r17
    bld r17, 0
    in r25, SREG
    cli
    andi r21, lo8(~(1 << FREEPORT_ON))
    out FLAGS, r21
    sts TIMSK2, r1
    out SREG, r25
    call MODULE_SET_LINE_UP
    bst r17, 0
    pop r17
    ; It is not 0.
    ori r24, 1
    ret

; What follows from SMB30, which is in r20. Changes r24, Z.
settings:
    sts IN_FORCE, r20
    ldi r24, BITS_8
    sbrc r20, HAS_7_BITS
    ldi r24, BITS_7
    sbrs r20, HAS_PARITY
    rjmp 1f
    ori r24, PARITY_EVEN
    sbrc r20, IS_ODD
    ori r24, PARITY_ODD
1:  sts FORMAT, r24
    mov r24, r20
    andi r24, RATE_MASK
    rcall 2f
    ; Of each rate the divider of 2 MHz, less 1, and the whole milliseconds of 16 bits. 115200 is 2.1 % fast, as it is
    ; for the firmware, 57600 0.8 % slow; the others are right within 0.2 %.
    .word 51, 1
    .word 103, 1
    .word 207, 2
    .word 416, 4
    .word 832, 7
    .word 1666, 14
    .word 16, 1
    .word 34, 1
2:  pop r31
    pop r30
    lsl r30
    rol r31
    add r30, r24
    adc r31, r1
    lpm r24, Z+
    sts DIVIDER, r24
    lpm r24, Z+
    sts DIVIDER + 1, r24
    lpm r24, Z
    sts BREAK_LEN, r24
    ret

; ---- for instructions and interrupts, with interrupts disabled

; The line as `settings` has it. Changes r30.
set_up:
    lds r30, FORMAT
    sts UCSR0C, r30
    lds r30, DIVIDER + 1
    sts UBRR0H, r30
    lds r30, DIVIDER
    sts UBRR0L, r30
    ret

; The time is measured from now on. Changes r0.
restart_time:
    clr r0
    sts ELAPSED, r0
    sts ELAPSED + 1, r0
    sts TCNT2, r0
    com r0
    out TIFR2, r0
    ret

; Begins what XMT asks for: the first character, or a break. Changes r0, Z.
send:
    lds r30, LEFT
    subi r30, 1
    brcs send_break
; The next character; r30 are left then.
send_next:
    sts LEFT, r30
    lds r30, NEXT
    lds r31, NEXT + 1
    ld r0, Z+
    sts UDR0, r0
    sts NEXT, r30
    sts NEXT + 1, r31
    ret
; The pin is low when the transmitter does not drive it.
send_break:
    rcall restart_time
    lds r30, BREAK_LEN
    sts PAUSE, r30
    sbi DDRD, TRANSMIT_PIN
    ldi r30, RECEIVES | TELLS_TRANSMITTED
    sts UCSR0B, r30
    ret

; XMT is over. Changes r30.
all_sent:
    lds r30, STATE
    andi r30, lo8(~(1 << SENDING))
    sts STATE, r30
    EVENT SENT_EVENT
tell_idle:
    lds r30, ERROR_BITS
    ori r30, 1 << IDLE
    sts ERROR_BITS, r30
    ret

; RCV is over, with the status in r24. Changes r24, Z.
end:
    lds r30, SPECIAL
    lds r31, SPECIAL + 1
    st Z, r24
    lds r30, BUFFER
    lds r31, BUFFER + 1
    lds r24, COUNT
    st Z, r24
    lds r30, STATE
    andi r30, lo8(~(1 << RECEIVING | 1 << BEGUN))
    sts STATE, r30
    EVENT MESSAGE_EVENT
    ret

; ---- interrupts

; A character was received.
character:
    lds r30, UCSR0A
    lds r31, UDR0
    lds r0, STATE
    sbrc r0, SETTLING
    rjmp 2f
    sts RECEIVED, r31
    andi r30, ERRORS
    breq 1f
    ldi r30, 1
1:  sts CHARACTER_ERROR, r30
    sbrc r0, RECEIVING
    rjmp message
    EVENT CHARACTER_EVENT
2:  INTERRUPT_DONE

; One of a message, in r31; r30 is not 0 when it has an error.
message:
    push r22
    push r23
    push r24
    push r25
    push r26
    push r27
    mov r22, r0
    mov r24, r31
    lds r25, CONTROL
    tst r30
    breq 1f
    rjmp with_error
1:  lds r30, SPECIAL
    lds r31, SPECIAL + 1
    sbrc r22, BEGUN
    rjmp 3f
    ; Does it begin with this one?
    lds r26, ELAPSED
    lds r27, ELAPSED + 1
    rcall restart_time
    sbrs r25, USE_IDLE
    rjmp 1f
    ldd r0, Z + IDLE_TIME_AT + 1
    cp r26, r0
    ldd r0, Z + IDLE_TIME_AT
    cpc r27, r0
    brlo message_done
1:  sbrs r25, USE_START
    rjmp 2f
    ldd r0, Z + START_AT
    cp r24, r0
    brne message_done
2:  ori r22, 1 << BEGUN
    sts STATE, r22
    rjmp 4f
3:  sbrs r25, WHOLE_MESSAGE
    rcall restart_time
4:  lds r22, COUNT
    inc r22
    sts COUNT, r22
    lds r26, BUFFER
    lds r27, BUFFER + 1
    ldi r23, 0
    add r26, r22
    adc r27, r23
    st X, r24
    sbrs r25, USE_END
    rjmp 6f
    ldd r0, Z + END_AT
    cp r24, r0
    brne 6f
    ; A start character that is the end character, too, does not end what it begins.
    cpi r22, 2
    brsh 5f
    sbrc r25, USE_START
    rjmp 6f
5:  ldi r24, AT_END
    rjmp message_over
6:  lds r23, COUNT_MAX
    cp r22, r23
    brlo message_done
    ldi r24, AT_COUNT
message_over:
    rcall end
message_done:
    pop r27
    pop r26
    pop r25
    pop r24
    pop r23
    pop r22
    INTERRUPT_DONE
; It ends a message, and is none that one begins with.
with_error:
    ldi r24, AT_ERROR
    sbrc r22, BEGUN
    rjmp message_over
    rcall restart_time
    rjmp message_done

; A character has left, and none was behind it.
sent:
    lds r30, LEFT
    subi r30, 1
    brcs 1f
    rcall send_next
    INTERRUPT_DONE
1:  rcall all_sent
    INTERRUPT_DONE

; A millisecond has passed.
timer:
    lds r30, PAUSE
    tst r30
    brne pause
; The transmitter is idle unless XMT is under way.
passed:
    lds r31, STATE
    sbrs r31, SENDING
    rcall tell_idle
    sbrs r31, RECEIVING
    rjmp 3f
    push r24
    push r25
    lds r24, ELAPSED
    lds r25, ELAPSED + 1
    adiw r24, 1
    breq 2f
    sts ELAPSED, r24
    sts ELAPSED + 1, r25
    sbrs r31, BEGUN
    rjmp 2f
    lds r30, CONTROL
    sbrs r30, USE_LIMIT
    rjmp 2f
    lds r30, SPECIAL
    lds r31, SPECIAL + 1
    ldd r0, Z + LIMIT_AT + 1
    cp r24, r0
    ldd r0, Z + LIMIT_AT
    cpc r25, r0
    brlo 2f
    ldi r24, AT_LIMIT
    rcall end
2:  pop r25
    pop r24
3:  INTERRUPT_DONE

; The line settles, for as long as the firmware has something to send and a little more, or a break lasts.
pause:
    lds r31, STATE
    lds r0, UCSR0B
    sbrc r31, SETTLING
    sbrs r0, TELLS_EMPTY
    rjmp 1f
    ldi r30, SETTLING_MS + 1
1:  dec r30
    sts PAUSE, r30
    brne passed
    ldi r30, DOUBLE_SPEED | TRANSMITTED
    sts UCSR0A, r30
    ldi r30, RECEIVES | TRANSMITS | TELLS_TRANSMITTED
    sts UCSR0B, r30
    cbi DDRD, TRANSMIT_PIN
    sbrs r31, SETTLING
    rjmp 2f
    andi r31, lo8(~(1 << SETTLING))
    sts STATE, r31
    rcall set_up
    sbrc r31, SENDING
    rcall send
    rjmp 3f
2:  rcall all_sent
3:  INTERRUPT_DONE

.include "special.inc"
