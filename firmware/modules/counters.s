; Module 8: high-speed counters. HSC0 counts at I0.0 to I0.2, HSC3 at I0.1; they do what plc-vm does
; (plc/vm/src/modules: high_speed.rs).
;
; Single pulses come by INT0 and INT1, an interrupt for each rising edge; encoders, the direction
; and the reset by changes of pins. What happens most - the value changes in its last byte, and
; nothing else does - is done at once; all else by `step`. Two tracks that have both changed since
; the last look went on in the direction they had.

.include "interface.inc"

OPERANDS
STUB abandon, ABANDON
.include "special.inc"

; ---- registers of the processor

.equ PCIFR, 0x1B
.equ EIFR, 0x1C
.equ EIMSK, 0x1D
.equ PCICR, 0x68
.equ EICRA, 0x69
.equ PCMSK2, 0x6D
; The pins' flag in PCIFR and bit in PCICR.
.equ PINS_BIT, 2
; Bits of EIMSK.
.equ INT0, 0
.equ INT1, 1
; EICRA: rising edges. Without the lower of their bits falling ones.
.equ RISING, 0x0F
.equ RISING_0, 0
.equ RISING_1, 2

; Bits of PIND: I0.0 and I0.1, which are clocks or the tracks of an encoder, or clock and direction,
; and I0.2.
.equ FIRST, 2
.equ SECOND, 3
.equ RESET, 4
.equ TRACKS, 1 << FIRST | 1 << SECOND

; ---- data memory

; Of HSC0, and 4 bytes further of HSC3: the preset, its last byte first;
.equ PRESET, COUNTERS_STATE
; after those, where its special memory is; its bits of EIMSK, and of PCICR, while it counts.
.equ SPECIAL, 8
.equ EDGES, 10
.equ CHANGES, 11
.equ OTHER, 4
; The pins as HSC0 saw them last, as the program sees them; the reset is 1 when it resets. Which of
; them are inverted for that.
.equ PINS, COUNTERS_STATE + 16
.equ INVERTED, COUNTERS_STATE + 17

; Special memory: the status, the control byte, then the new value and the new preset, double words.
.equ SMB36, SPECIAL_IN_RANGES + 36
.equ SMB136, SPECIAL_IN_RANGES + 136
.equ CONTROL, 1
; Control.
.equ RESET_LOW, 0
.equ ONE_FOLD, 2
.equ UP, 3
.equ TAKE_DIRECTION, 4
.equ TAKE_PRESET, 5
.equ TAKE_CURRENT, 6
.equ ENABLE, 7
; Status.
.equ IS_UP, 5
.equ IS_EQUAL, 6
.equ IS_ABOVE, 7

; Bits of MORE_FLAGS, which are these counters'. Both directions;
.equ UP_0, 0
.equ UP_3, 1
; what HSC0 is, in the order of its modes;
.equ INTERNAL_DIRECTION, 2
.equ EXTERNAL_DIRECTION, 3
.equ TWO_CLOCKS, 4
.equ QUADRATURE, 5
; every edge of two tracks counts, and nothing resets or is inverted; pins that are looked at
; whenever they change.
.equ PLAIN, 6
.equ WATCHED, 7

; ---- interrupts: what happens most

; The next value of a counter, of which only the last byte changes. Otherwise all is looked at by
; `step`, for which more registers must be saved: when the byte goes round, and at the preset's last
; byte, before and after, because there the status changes.
.macro COUNT_UP offset
    lds r30, HIGH_SPEED_COUNTER_0 + \offset + 3
    lds r31, PRESET + \offset
    cp r30, r31
    breq .Lmore\@
    inc r30
    breq .Lmore\@
    cp r30, r31
    breq .Lmore\@
    sts HIGH_SPEED_COUNTER_0 + \offset + 3, r30
    INTERRUPT_DONE
.Lmore\@:
    ldi r31, 1
    ldi r30, lo8(PRESET + \offset)
    rjmp one_step
.endm
.macro COUNT_DOWN offset
    lds r30, HIGH_SPEED_COUNTER_0 + \offset + 3
    lds r31, PRESET + \offset
    cp r30, r31
    breq .Lmore\@
    subi r30, 1
    brcs .Lmore\@
    cp r30, r31
    breq .Lmore\@
    sts HIGH_SPEED_COUNTER_0 + \offset + 3, r30
    INTERRUPT_DONE
.Lmore\@:
    ldi r31, -1
    ldi r30, lo8(PRESET + \offset)
    rjmp one_step
.endm

; The pins now in r30 and before in r31, MORE_FLAGS in r0.
.macro LOOK
    in r30, PIND
    lds r31, INVERTED
    eor r30, r31
    lds r31, PINS
    sts PINS, r30
    in r0, MORE_FLAGS
.endm

; INT0: the clock of HSC0, or the one that counts up. Means: plc-vm modules/high_speed.rs edge.
; in: -   ends: the interrupt
first_input:
    in r0, MORE_FLAGS
    sbrc r0, WATCHED
    rcall watched
    sbrs r0, UP_0
    rjmp 1f
; in: r0 MORE_FLAGS, HSC0 counts up   ends: the interrupt, HSC0 one more
up:
    COUNT_UP 0
1:  sbrc r0, TWO_CLOCKS
    rjmp turn
; in: r0 MORE_FLAGS, HSC0 counts down   ends: the interrupt, HSC0 one less
down:
    COUNT_DOWN 0

; INT1: the clock of HSC3, or the one of HSC0 that counts down. Means: plc-vm modules/high_speed.rs
; edge.
; in: -   ends: the interrupt
second_input:
    in r0, MORE_FLAGS
    sbrc r0, TWO_CLOCKS
    rjmp 2f
    sbrs r0, UP_3
    rjmp 1f
    COUNT_UP OTHER
1:  COUNT_DOWN OTHER
2:  sbrc r0, WATCHED
    rcall watched
    sbrs r0, UP_0
    rjmp down
    rjmp turn

; PCINT2: the tracks of an encoder, the direction, the reset. Means: plc-vm modules/high_speed.rs
; edge.
; in: -   ends: the interrupt
any_input:
    in r0, MORE_FLAGS
    sbrs r0, PLAIN
    rjmp not_plain
    in r30, PIND
    lds r31, PINS
    sts PINS, r30
    eor r31, r30
; An encoder of which every edge counts.
; in: r30 the pins now, r31 what has changed, r0 MORE_FLAGS   ends: the interrupt
tracks:
    andi r31, TRACKS
    breq done
    cpi r31, TRACKS
    breq twice
    ; The first track, as it is now, and the second, as it was, are different: up.
    eor r31, r30
    lsr r31
    eor r31, r30
; in: r31 bit FIRST: HSC0 counts up; r0 MORE_FLAGS   ends: the interrupt, the direction as it counts
count:
    sbrs r31, FIRST
    rjmp 1f
    sbrc r0, UP_0
    rjmp up
    rjmp turn
1:  sbrs r0, UP_0
    rjmp down
; The direction of HSC0 changes, and it counts. Means: plc-vm modules/high_speed.rs turn.
; in: r0 MORE_FLAGS   ends: the interrupt
turn:
    ldi r30, 1 << UP_0
    eor r0, r30
    out MORE_FLAGS, r0
    rcall turned
    rcall on
    rjmp one_step

; ---- interrupts: what happens now and then

; The next step of HSC0 in its direction.
; in: r0 MORE_FLAGS   out: r30, r31 as `step` takes them   destroys: -
on:
    ldi r31, 1
    sbrs r0, UP_0
    ldi r31, -1
    ldi r30, lo8(PRESET)
    ret

; Both tracks have changed: two steps, at once when only the last byte changes and the preset is not
; near.
; in: r0 MORE_FLAGS   ends: the interrupt
twice:
    ; Up, the preset may not be 0, 1 or 2 further, in its last byte; down, not 0, 1 or 2 back.
    lds r30, HIGH_SPEED_COUNTER_0 + 3
    lds r31, PRESET
    sub r31, r30
    sbrs r0, UP_0
    rjmp 1f
    cpi r31, 3
    brlo 3f
    subi r30, -2
    brcc 3f
    rjmp 2f
1:  subi r31, -2
    cpi r31, 3
    brlo 3f
    subi r30, 2
    brcs 3f
2:  sts HIGH_SPEED_COUNTER_0 + 3, r30
    INTERRUPT_DONE
3:  rcall on
    rcall step
    mov r31, r0
; in: r30, r31 as `step` takes them   ends: the interrupt
one_step:
    rcall step
; in: -   ends: the interrupt
done:
    INTERRUPT_DONE

; in: -   out: the event of the direction   destroys: r30
turned:
    EVENT COUNTER_0_DIRECTION_EVENT
    ret

; A clock whose pins have changed, too: they come first. While it is reset the clock does not count:
; then this ends the interrupt.
; in: r0 MORE_FLAGS   out: r0 MORE_FLAGS   destroys: Z, T
watched:
    sbis PCIFR, PINS_BIT
    ret
    ; `watch` has switched the clock off when it is reset: then what was counting is left.
    LOOK
    rcall watch
    sbic EIMSK, INT0
    ret
    pop r0
    pop r0
    rjmp done

; Pins that do not only count: the direction and the reset; tracks with a reset, of which one edge
; of four counts, or which are inverted.
; in: -   ends: the interrupt
not_plain:
    LOOK
    sbrc r0, QUADRATURE
    rjmp 1f
    rcall watch
    rjmp done
    ; r31: what has changed; `watch` takes what was before, and is called for the reset alone.
1:  push r18
    lds r18, PCMSK2
    eor r31, r30
    sbrc r18, RESET
    sbrs r31, RESET
    rjmp 2f
    eor r31, r30
    rcall watch
    eor r31, r30
    ; T: every edge of both counts. Nothing counts while it is reset.
2:  bst r18, SECOND
    and r18, r30
    andi r18, 1 << RESET
    pop r18
    brne 3f
    brtc 4f
    rjmp tracks
    ; The first track's edges, while the second one is off.
4:  sbrc r31, FIRST
    sbrc r30, SECOND
3:  rjmp done
    mov r31, r30
    rjmp count

; What the pins say about direction and reset. Means: plc-vm modules/high_speed.rs direction, edge.
; in: r30 the pins now, r31 before, r0 MORE_FLAGS   out: r0 MORE_FLAGS   destroys: T
watch:
    EACH push, r18, r19, r20, r21, r22, r23, r26, r27, r30, r31
    mov r23, r30
    mov r22, r31
    eor r22, r30
    lds r18, PCMSK2
    and r22, r18
    sbrc r0, EXTERNAL_DIRECTION
    sbrs r22, SECOND
    rjmp 1f
    mov r18, r0
    bst r23, SECOND
    bld r18, UP_0
    cp r18, r0
    breq 1f
    mov r0, r18
    out MORE_FLAGS, r0
    rcall turned
    ldi r30, lo8(PRESET)
    rcall settle
1:  sbrs r22, RESET
    rjmp 3f
    lds r18, PRESET + EDGES
    in r19, EIMSK
    sbrs r23, RESET
    rjmp 2f
    com r18
    and r19, r18
    out EIMSK, r19
    clr r18
    sts HIGH_SPEED_COUNTER_0, r18
    sts HIGH_SPEED_COUNTER_0 + 1, r18
    sts HIGH_SPEED_COUNTER_0 + 2, r18
    sts HIGH_SPEED_COUNTER_0 + 3, r18
    EVENT COUNTER_0_RESET_EVENT
    ldi r30, lo8(PRESET)
    rcall settle
    rjmp 3f
    ; What came meanwhile does not count.
2:  out EIFR, r18
    or r19, r18
    out EIMSK, r19
3:  EACH pop, r31, r30, r27, r26, r23, r22, r21, r20, r19, r18
    ret

; A counter's next value, with what it causes. Means: plc-vm modules/high_speed.rs edge.
; in: r31 step, 1 or -1, r30 low byte of the counter's place in memory   out: r0 the step
; destroys: r31
step:
    mov r0, r31
    EACH push, r18, r19, r20, r21, r26, r27
    rcall current
    ; The step with its sign: r31 is its upper bytes.
    mov r31, r0
    lsl r31
    sbc r31, r31
    add r18, r0
    adc r19, r31
    adc r20, r31
    adc r21, r31
    st -X, r18
    st -X, r19
    st -X, r20
    st -X, r21
    rcall status
    ; EVENT changes r30.
    sbrs r18, IS_EQUAL
    rjmp 3f
    mov r26, r30
    cpi r30, lo8(PRESET)
    brne 1f
    EVENT COUNTER_0_PRESET_EVENT
    rjmp 2f
1:  EVENT COUNTER_3_PRESET_EVENT
2:  mov r30, r26
3:  EACH pop, r27, r26, r21, r20, r19, r18
    ret

; The status follows from value, preset and direction. Means: plc-vm modules/high_speed.rs
; write_status.
; in: r30 low byte of the counter's place   out: r18 the status   destroys: r19-r21, r31, X
settle:
    rcall current
    rjmp status

; in: r30 low byte of a counter's place   out: r21:r18 its value, X after it   destroys: -
current:
    mov r26, r30
    subi r26, lo8(PRESET - HIGH_SPEED_COUNTER_0)
    ldi r27, hi8(HIGH_SPEED_COUNTER_0)
    ld r21, X+
    ld r20, X+
    ld r19, X+
    ld r18, X+
    ret

; in: r30 low byte of a counter's place, r21:r18 its value   out: r18 its status, which is written
; destroys: r31, X
status:
    ldi r31, hi8(PRESET)
    ld r26, Z
    cp r26, r18
    ldd r26, Z + 1
    cpc r26, r19
    ldd r26, Z + 2
    cpc r26, r20
    ldd r26, Z + 3
    cpc r26, r21
    ldi r18, 1 << IS_EQUAL
    breq 1f
    ldi r18, 1 << IS_ABOVE
    brlt 1f
    ldi r18, 0
1:  in r26, MORE_FLAGS
    ; HSC3: its bit is the next one.
    sbrc r30, 2
    lsr r26
    sbrc r26, UP_0
    ori r18, 1 << IS_UP
    ldd r26, Z + SPECIAL
    ldd r27, Z + SPECIAL + 1
    st X, r18
    ret

.include "counter_instructions.inc"
