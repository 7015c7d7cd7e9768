; Module 9: pulse and analog outputs, all by timer 1. PLS 1 is at Q0.1 (pin D9, OC1A), AQW0 at D9,
; AQW2 at D10 (OC1B); a program has either pulses or analog outputs. While the timer drives a pin,
; the process image does not.
;
; Modulation in microseconds and analog outputs are the timer's alone. Modulation in milliseconds
; and trains consist of ticks of the timer: the interrupt at the end of one only decides which level
; the next end brings, so edges are exact whenever it comes, and none is too many.

.include "interface.inc"

OPERANDS
STUB abandon, ABANDON

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
; TCCR1A: the mode, and that the end of a tick switches OC1A on; or that it switches it off, and the
; compare value on.
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
; Of trains, in microseconds: with two interrupts a pulse, more would leave too little time for the
; program.
.equ TRAIN_CYCLE_MIN, 50

; ---- PLS: state, low bytes first

; What is under way: ENABLE, MODULATION and MILLISECONDS as in the control byte, or 0. And of
; trains: one waits, in milliseconds; the end of this tick is the end of the train.
.equ TASK, 0
.equ WAITS, 0
.equ WAITS_IN_MILLISECONDS, 1
.equ ENDS, 2
; INVERTS for an output that is inverted, or 0.
.equ POLARITY, 1
; Ticks to the next edge, and ticks off after it that belong to the same cycle.
.equ LEFT, 2
.equ REST, 4
; Ticks on and off in each cycle.
.equ TICKS_ON, 6
.equ TICKS_OFF, 8
; Pulses after this one.
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

.include "pulse_instruction.inc"
.include "pulse_ticks.inc"
.include "analog_outputs.inc"
.include "special.inc"
