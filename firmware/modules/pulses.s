; Module 9: pulse and analog outputs, all by timer 1. PLS 1 is at Q0.1 (pin D9, OC1A), AQW0 at D9, AQW2 at D10 (OC1B); a
; program has either pulses or analog outputs. While the timer drives a pin, the process image does not.
;
; Modulation in microseconds and analog outputs are the timer's alone. Modulation in milliseconds and trains consist of
; ticks of the timer: the interrupt at the end of one only decides which level the next end brings, so edges are exact
; whenever it comes, and none is too many.

.include "interface.inc"

OPERANDS
STUB abandon, ABANDON

.equ IMAGE_INVERTED_OUTPUTS, IMAGE + 28
.equ DDRB, 0x04
.equ PULSE_PIN, 1
.equ ANALOG_PIN_0, 1
.equ ANALOG_PIN_2, 2

; ---- timer 1, in data memory. In every mode here it counts up to ICR1 and begins again: fast PWM.

.equ TIFR1_IO, 0x16
.equ TIMSK1, 0x6F
.equ TCCR1A, 0x80
.equ TCCR1B, 0x81
.equ TCCR1C, 0x82
.equ TCNT1, 0x84
.equ ICR1, 0x86
.equ OCR1A, 0x88
.equ OCR1B, 0x8A
.equ TIMER_OVERFLOW, 1 << 0
; TCCR1B: the mode, and counts in this many cycles.
.equ FAST, 0x18
.equ EVERY_CYCLE, 1
.equ EVERY_8, 2
.equ EVERY_64, 3
; TCCR1A: the mode, and that the end of a tick switches OC1A on; or that it switches it off, and the compare value on.
.equ FAST_A, 0x02
.equ ON, 0x80 | FAST_A
.equ OFF, 0xC0 | FAST_A

; TCCR1A outside of that mode: what a forced compare makes of OC1A.
.equ FORCE_OFF, 0x80
.equ FORCE_ON, 0xC0
; What of these is the other way round for an output that is inverted.
.equ INVERTS, 0x40
; TCCR1C: forces a compare.
.equ FORCE_A, 0x80
.equ FORCE_A_B, 0xC0

; ---- PLS: special memory, from SMB76 on

.equ STATUS, SPECIAL_IN_RANGES + 76
.equ CONTROL_AT, 1
.equ CYCLE_AT, 2
.equ WIDTH_AT, 4
.equ COUNT_AT, 6
; Bits of the control byte.
.equ TAKE_CYCLE, 0
.equ TAKE_WIDTH, 1
.equ TAKE_COUNT, 2
.equ MILLISECONDS, 3
.equ SEGMENTS, 5
.equ MODULATION, 6
.equ ENABLE, 7
; The status.
.equ ABORTED, 1 << 5
.equ NO_ROOM, 1 << 6
.equ IDLE, 1 << 7

.equ CYCLE_MIN, 2
; Of trains, in microseconds: with two interrupts a pulse, more would leave too little time for the program.
.equ TRAIN_CYCLE_MIN, 50

; ---- PLS: state, low bytes first

; What is under way: ENABLE, MODULATION and MILLISECONDS as in the control byte, or 0. And of trains: one waits, in
; milliseconds; the end of this tick is the end of the train.
.equ TASK, 0
.equ WAITS, 0
.equ WAITS_IN_MILLISECONDS, 1
.equ ENDS, 2
; INVERTS for an output that is inverted, or 0.
.equ POLARITY, 1
; Ticks to the next edge, and ticks off behind it that belong to the same cycle.
.equ LEFT, 2
.equ REST, 4
; Ticks on and off in each cycle.
.equ TICKS_ON, 6
.equ TICKS_OFF, 8
; Pulses behind this one.
.equ PULSES, 10
; The train that waits.
.equ NEXT_CYCLE, 14
.equ NEXT_PULSES, 16
; Where SMB76 is.
.equ STATUS_ADDRESS, 20
; As they were taken over last.
.equ CYCLE, 22
.equ WIDTH, 24
.equ COUNT, 26
; The cycle of the modulation under way.
.equ MODULATED_CYCLE, 30

; An event of a pulse output, in HARDWARE_EVENTS.
.equ TRAIN_EVENT, 7

; ---- PLS

Pls:
    movw r30, r28
    lpm r18, Z
    cpi r18, 1
    brne refused
    ldi r24, lo8(STATUS)
    ldi r25, hi8(STATUS)
    rcall special
    brcs refused
    movw r28, r26
    ldi r30, lo8(PULSES_STATE)
    ldi r31, hi8(PULSES_STATE)
    in r19, SREG
    cli
    rcall first
    ldd r20, Y + CONTROL_AT
    sbrs r20, SEGMENTS
    rjmp 1f
    sbrs r20, MODULATION
    rjmp 2f
1:  rcall take_over
    rcall begin
    brcs 2f
    st Y, r21
    out SREG, r19
    DONE
2:  out SREG, r19
refused:
    rjmp abandon

; The first time in this RUN: nothing is under way, nothing has been taken over. Keeps Z, r19.
first:
    in r18, FLAGS
    sbrc r18, PULSES_ON
    ret
    ori r18, 1 << PULSES_ON
    out FLAGS, r18
    movw r26, r30
    ldi r30, lo8(IMAGE_INVERTED_OUTPUTS)
    ldi r31, hi8(IMAGE_INVERTED_OUTPUTS)
    lpm r18, Z
    movw r30, r26
    ldi r20, 0
    sbrc r18, PULSE_PIN
    ldi r20, INVERTS
    std Z + POLARITY, r20
    std Z + STATUS_ADDRESS, r28
    std Z + STATUS_ADDRESS + 1, r29
    std Z + TASK, r1
    ldi r18, CYCLE_MIN
    std Z + CYCLE, r18
    std Z + CYCLE + 1, r1
    std Z + WIDTH, r1
    std Z + WIDTH + 1, r1
    ldi r18, 1
    std Z + COUNT, r18
    std Z + COUNT + 1, r1
    std Z + COUNT + 2, r1
    std Z + COUNT + 3, r1
    ret

; Takes over what the control byte, r20, says. Changes r18, r22 to r25.
take_over:
    sbrs r20, TAKE_CYCLE
    rjmp 2f
    ldd r25, Y + CYCLE_AT
    ldd r24, Y + CYCLE_AT + 1
    sbiw r24, CYCLE_MIN
    brsh 1f
    ldi r24, 0
    ldi r25, 0
1:  adiw r24, CYCLE_MIN
    std Z + CYCLE, r24
    std Z + CYCLE + 1, r25
2:  sbrs r20, TAKE_WIDTH
    rjmp 3f
    ldd r25, Y + WIDTH_AT
    ldd r24, Y + WIDTH_AT + 1
    std Z + WIDTH, r24
    std Z + WIDTH + 1, r25
3:  sbrs r20, TAKE_COUNT
    ret
    ldd r25, Y + COUNT_AT
    ldd r24, Y + COUNT_AT + 1
    ldd r23, Y + COUNT_AT + 2
    ldd r22, Y + COUNT_AT + 3
    mov r18, r22
    or r18, r23
    or r18, r24
    or r18, r25
    brne 4f
    ldi r22, 1
4:  std Z + COUNT, r22
    std Z + COUNT + 1, r23
    std Z + COUNT + 2, r24
    std Z + COUNT + 3, r25
    ret

; Does what the control byte, r20, says, with what has been taken over. The status in r21; carry: it cannot be done. With
; interrupts disabled. Keeps r19, Y, Z.
begin:
    ldi r21, IDLE
    ldd r18, Z + TASK
    sbrs r20, ENABLE
    rjmp 1f
    sbrs r20, MODULATION
    rjmp train
1:  sbrs r18, ENABLE
    rjmp 2f
    sbrs r18, MODULATION
    ori r21, ABORTED
2:  sbrc r20, ENABLE
    rjmp modulate
    rcall stop
    clc
    ret

; A train; r18: what is under way.
train:
    ldd r24, Z + CYCLE
    ldd r25, Z + CYCLE + 1
    sbrc r20, MILLISECONDS
    rjmp 1f
    cpi r24, TRAIN_CYCLE_MIN
    cpc r25, r1
    brlo 4f
1:  ldi r21, 0
    sbrs r18, ENABLE
    rjmp 2f
    sbrs r18, MODULATION
    rjmp 3f
2:  ldi r26, lo8(PULSES_STATE + PULSES)
    rcall pulses
    mov r26, r20
    rcall begin_train
    clc
    ret
    ; There is a train: this one waits for its end, if no other does.
3:  ldi r21, NO_ROOM
    sbrc r18, WAITS
    rjmp 5f
    ldi r21, 0
    ori r18, 1 << WAITS
    sbrc r20, MILLISECONDS
    ori r18, 1 << WAITS_IN_MILLISECONDS
    std Z + TASK, r18
    std Z + NEXT_CYCLE, r24
    std Z + NEXT_CYCLE + 1, r25
    ldi r26, lo8(PULSES_STATE + NEXT_PULSES)
    rcall pulses
5:  clc
4:  ret

; The pulses of a train behind its first one, to r26 in the state. Keeps r24, r25.
pulses:
    ldi r27, hi8(PULSES_STATE)
    ldd r18, Z + COUNT
    ldd r22, Z + COUNT + 1
    subi r18, 1
    sbci r22, 0
    st X+, r18
    st X+, r22
    ldd r18, Z + COUNT + 2
    ldd r22, Z + COUNT + 3
    sbci r18, 0
    sbci r22, 0
    st X+, r18
    st X, r22
    ret

; Modulation; r18: what is under way.
modulate:
    ldd r24, Z + CYCLE
    ldd r25, Z + CYCLE + 1
    ldd r22, Z + WIDTH
    ldd r23, Z + WIDTH + 1
    cp r24, r22
    cpc r25, r23
    brsh 1f
    movw r22, r24
    ; r18 becomes 0 when only the width changes.
1:  andi r20, 1 << ENABLE | 1 << MODULATION | 1 << MILLISECONDS
    std Z + TASK, r20
    eor r18, r20
    ldd r27, Z + MODULATED_CYCLE
    eor r27, r24
    or r18, r27
    ldd r27, Z + MODULATED_CYCLE + 1
    eor r27, r25
    or r18, r27
    std Z + MODULATED_CYCLE, r24
    std Z + MODULATED_CYCLE + 1, r25
    sbrc r20, MILLISECONDS
    rjmp by_ticks
    ; In half microseconds, or in units of four where those do not fit into a word.
    ldi r26, EVERY_8
    tst r25
    brmi 2f
    lsl r24
    rol r25
    lsl r22
    rol r23
    rjmp 3f
2:  movw r26, r24
    movw r24, r22
    rcall quarter
    movw r22, r24
    movw r24, r26
    rcall quarter
    ldi r26, EVERY_64
    ; On from the count in r23 and r22 to the last one.
3:  sub r22, r24
    sbc r23, r25
    com r22
    com r23
    sbiw r24, 1
    cp r24, r22
    cpc r25, r23
    brlo 5f
    tst r18
    breq 4f
    ldi r27, FORCE_OFF
    rcall prepare
    ldi r27, OFF
    rjmp 6f
    ; The timer takes it at the end of the cycle.
4:  sts OCR1A + 1, r23
    sts OCR1A, r22
    ldi r27, OFF
    rcall level
    clc
    ret
    ; Always on: a count that is never reached.
5:  ldi r27, FORCE_ON
    rcall prepare
    ldi r27, ON
6:  rcall level
    ori r26, FAST
    sts TCCR1B, r26
    ; The cycle begins with its part that is on.
    movw r24, r22
    sbiw r24, 1
    sts TCNT1 + 1, r25
    sts TCNT1, r24
    clc
    ret

; A quarter of r25 and r24, rounded.
quarter:
    adiw r24, 2
    ror r25
    ror r24
    lsr r25
    ror r24
    ret

; The same by ticks of a millisecond. A new width is taken at the end of the cycle.
by_ticks:
    sub r24, r22
    sbc r25, r23
    std Z + TICKS_ON, r22
    std Z + TICKS_ON + 1, r23
    std Z + TICKS_OFF, r24
    std Z + TICKS_OFF + 1, r25
    tst r18
    breq 1f
    ldi r24, 250 - 1
    ldi r25, 0
    ldi r26, EVERY_64
    rcall begin_ticks
1:  clc
    ret

; ---- what the interrupt calls, too: where r1 is not 0, and what is changed must be named

; The process image drives the pin. Changes r24.
stop:
    ldi r24, 0
    sts TIMSK1, r24
    sts TCCR1A, r24
    std Z + TASK, r24
    ret

; A train with cycles of r25 and r24, in the unit of the control byte in r26. Changes r0, r22 to r27.
begin_train:
    andi r26, 1 << MILLISECONDS
    ori r26, 1 << ENABLE
    std Z + TASK, r26
    sbrc r26, MILLISECONDS
    rjmp 1f
    ; A tick is half a cycle: as many half microseconds as the cycle has microseconds.
    ldi r22, 1
    ldi r23, 0
    sbiw r24, 1
    ldi r26, EVERY_8
    rjmp 2f
    ; A tick is half a millisecond.
1:  movw r22, r24
    ldi r24, 125 - 1
    ldi r25, 0
    ldi r26, EVERY_64
2:  std Z + TICKS_ON, r22
    std Z + TICKS_ON + 1, r23
    std Z + TICKS_OFF, r22
    std Z + TICKS_OFF + 1, r23

; Begins with ticks of r25 and r24, less 1, counts of r26. Changes r0, r22 to r27.
begin_ticks:
    ldi r22, 0xFF
    ldi r23, 0xFF
    ldi r27, FORCE_OFF
    rcall prepare
    rcall next_cycle
    ori r26, FAST
    sts TCCR1B, r26
    ; The tick before the first one is nearly over.
    lds r24, ICR1
    lds r25, ICR1 + 1
    sbiw r24, 1
    sts TCNT1 + 1, r25
    sts TCNT1, r24
    ldi r24, TIMER_OVERFLOW
    out TIFR1_IO, r24
    sts TIMSK1, r24
    ret

; Stops timer 1 with the pin as r27 says, ready to count to r25 and r24, with the compare value r23 and r22. Changes r0, r27.
prepare:
    ldd r0, Z + POLARITY
    eor r27, r0
    sts TCCR1A, r27
    ldi r27, 0
    sts TIMSK1, r27
    sts TCCR1B, r27
    ldi r27, FORCE_A
    sts TCCR1C, r27
    sbi DDRB, PULSE_PIN
    ; At once here, and in the other mode at the end of a cycle: both.
    sts OCR1A + 1, r23
    sts OCR1A, r22
    ldi r27, OFF
    rcall level
    ldi r27, FAST
    sts TCCR1B, r27
    sts OCR1A + 1, r23
    sts OCR1A, r22
    ; That has a top which can be set in that mode alone.
    sts ICR1 + 1, r25
    sts ICR1, r24
    ret

; What the end of this tick brings, ON or OFF, in r27. Changes r0, r27.
level:
    ldd r0, Z + POLARITY
    eor r27, r0
    sts TCCR1A, r27
    ret

; The end of this tick is the beginning of a cycle. Changes r0, r24, r25, r27.
next_cycle:
    ldd r24, Z + TICKS_ON
    ldd r25, Z + TICKS_ON + 1
    sbiw r24, 0
    breq 1f
    std Z + LEFT, r24
    std Z + LEFT + 1, r25
    ldd r24, Z + TICKS_OFF
    ldd r25, Z + TICKS_OFF + 1
    std Z + REST, r24
    std Z + REST + 1, r25
    ldi r27, ON
    rjmp level
1:  ldd r24, Z + TICKS_OFF
    ldd r25, Z + TICKS_OFF + 1

; With the end of this tick the output is off for the last ticks of the cycle, r25 and r24. Changes r0, r24, r27.
off:
    std Z + LEFT, r24
    std Z + LEFT + 1, r25
    ldi r24, 0
    std Z + REST, r24
    std Z + REST + 1, r24
    ldi r27, OFF
    rjmp level

; ---- the interrupt: the timer has ended a cycle of its own, and a tick begins

cycle_end:
    push r24
    push r25
    push r27
    ldi r30, lo8(PULSES_STATE)
    ldi r31, hi8(PULSES_STATE)
    ldd r24, Z + LEFT
    ldd r25, Z + LEFT + 1
    sbiw r24, 1
    std Z + LEFT, r24
    std Z + LEFT + 1, r25
    brne 3f
    ldd r24, Z + REST
    ldd r25, Z + REST + 1
    sbiw r24, 0
    breq 1f
    rcall off
    rjmp 3f
    ; The cycle ends with this tick. Trains have so many of them.
1:  ldd r24, Z + TASK
    sbrc r24, MODULATION
    rjmp 2f
    sbrc r24, ENDS
    rjmp train_ends
    ldd r24, Z + PULSES
    ldd r25, Z + PULSES + 1
    sbiw r24, 1
    std Z + PULSES, r24
    std Z + PULSES + 1, r25
    ldd r24, Z + PULSES + 2
    ldd r25, Z + PULSES + 3
    sbci r24, 0
    sbci r25, 0
    std Z + PULSES + 2, r24
    std Z + PULSES + 3, r25
    brcc 2f
    ldd r24, Z + TASK
    ori r24, 1 << ENDS
    std Z + TASK, r24
    ldi r24, 1
    std Z + LEFT, r24
    rjmp 3f
2:  rcall next_cycle
3:  pop r27
    pop r25
    pop r24
    INTERRUPT_DONE

; The train is over: with the next one, if one waits.
train_ends:
    EVENT TRAIN_EVENT
    ldi r30, lo8(PULSES_STATE)
    push r26
    ldd r26, Z + TASK
    sbrc r26, WAITS
    rjmp 1f
    rcall stop
    ldd r26, Z + STATUS_ADDRESS
    ldd r27, Z + STATUS_ADDRESS + 1
    ld r24, X
    ori r24, IDLE
    st X, r24
    rjmp 2f
1:  push r22
    push r23
    ldd r24, Z + NEXT_PULSES
    ldd r25, Z + NEXT_PULSES + 1
    std Z + PULSES, r24
    std Z + PULSES + 1, r25
    ldd r24, Z + NEXT_PULSES + 2
    ldd r25, Z + NEXT_PULSES + 3
    std Z + PULSES + 2, r24
    std Z + PULSES + 3, r25
    ldd r24, Z + NEXT_CYCLE
    ldd r25, Z + NEXT_CYCLE + 1
    ; Bit WAITS_IN_MILLISECONDS to MILLISECONDS.
    lsl r26
    lsl r26
    rcall begin_train
    pop r23
    pop r22
2:  pop r26
    rjmp 3b

; ---- analog outputs

; Steps from off to on, as many as an EM 232 has: 8,000 cycles a second.
.equ STEPS, 2000
; Of the values 0 to 32000, 16 are a step.
.equ VALUE_MAX, 32000
.equ SHIFTS, 4
; In TCCR1A, of OC1A and of OC1B: OFF, ON.
.equ BOTH_OFF, 0xF0
.equ BOTH_ON, 0xA0
; Outside of that mode, what forced compares make of both.
.equ FORCE_BOTH_OFF, 0xA0
.equ OUTPUT_0, 0xC0
.equ OUTPUT_2, 0x30

; The operand has a bit for each output that the program uses: the others are digital ones.
AnalogOutputs:
    ; Without power flow nothing has been written.
    brtc 2f
    movw r30, r28
    lpm r20, Z
    in r18, FLAGS
    sbrs r18, ANALOG_OUTPUTS_ON
    rcall begin_analog
    sbrs r20, 0
    rjmp 1f
    lds r25, ANALOG_OUTPUTS
    lds r24, ANALOG_OUTPUTS + 1
    rcall compare_value
    sts OCR1A + 1, r23
    sts OCR1A, r22
    ldi r18, OUTPUT_0
    rcall connect
    sbi DDRB, ANALOG_PIN_0
1:  sbrs r20, 1
    rjmp 2f
    lds r25, ANALOG_OUTPUTS + 2
    lds r24, ANALOG_OUTPUTS + 3
    rcall compare_value
    sts OCR1B + 1, r23
    sts OCR1B, r22
    ldi r18, OUTPUT_2
    rcall connect
    sbi DDRB, ANALOG_PIN_2
2:  DONE

; The first time in this RUN: timer 1 runs, with both outputs off as soon as they are connected. Changes r18, r19.
begin_analog:
    in r19, SREG
    cli
    in r18, FLAGS
    ori r18, 1 << ANALOG_OUTPUTS_ON
    out FLAGS, r18
    out SREG, r19
    ldi r18, FORCE_BOTH_OFF
    sts TCCR1A, r18
    sts TCCR1B, r1
    ldi r18, FORCE_A_B
    sts TCCR1C, r18
    ; In the first cycle they stay off.
    ldi r18, 0xFF
    sts OCR1A + 1, r18
    sts OCR1A, r18
    sts OCR1B + 1, r18
    sts OCR1B, r18
    ldi r18, FAST_A
    sts TCCR1A, r18
    ldi r18, FAST
    sts TCCR1B, r18
    ldi r18, hi8(STEPS - 1)
    sts ICR1 + 1, r18
    ldi r18, lo8(STEPS - 1)
    sts ICR1, r18
    sts TCNT1 + 1, r1
    sts TCNT1, r1
    ldi r18, FAST | EVERY_CYCLE
    sts TCCR1B, r18
    ret

; For the value r25 and r24 the compare value in r23 and r22, and BOTH_OFF in r19, or BOTH_ON for an output that is always
; on. On from the compare value to the last count. Changes r24, r25.
compare_value:
    tst r25
    brpl 1f
    ldi r24, 0
    ldi r25, 0
1:  cpi r24, lo8(VALUE_MAX)
    ldi r19, hi8(VALUE_MAX)
    cpc r25, r19
    brlo 2f
    ldi r24, lo8(VALUE_MAX)
    ldi r25, hi8(VALUE_MAX)
2:  ldi r19, SHIFTS
3:  lsr r25
    ror r24
    dec r19
    brne 3b
    ldi r22, lo8(STEPS - 1)
    ldi r23, hi8(STEPS - 1)
    ldi r19, BOTH_OFF
    sub r22, r24
    sbc r23, r25
    brcc 4f
    ldi r19, BOTH_ON
4:  ret

; Connects the output with the bits r18 of TCCR1A as r19 says. Changes r18, r19, r24.
connect:
    and r19, r18
    com r18
    lds r24, TCCR1A
    and r24, r18
    or r24, r19
    sts TCCR1A, r24
    ret

.include "special.inc"
