; Module 8: high-speed counters. HSC0 counts at I0.0 to I0.2, HSC3 at I0.1; they do what plc-vm does (plc/vm/src/modules:
; high_speed.rs).
;
; Single pulses come by INT0 and INT1, an interrupt for each rising edge; encoders, the direction and the reset by changes of
; pins. What happens most - the value changes in its last byte, and nothing else does - is done at once; all else by `step`.
; Two tracks that have both changed since the last look went on in the direction they had.

.include "interface.inc"

OPERANDS
STUB abandon, ABANDON
.include "special.inc"

; ---- the image

.equ IMAGE_INVERTED_INPUTS, IMAGE + 27

; ---- registers of the processor

.equ PIND, 0x09
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

; Bits of PIND: I0.0 and I0.1, which are clocks or the tracks of an encoder, or clock and direction, and I0.2.
.equ FIRST, 2
.equ SECOND, 3
.equ RESET, 4
.equ TRACKS, 1 << FIRST | 1 << SECOND

; ---- data memory

; Of HSC0, and 4 bytes further of HSC3: the preset, its last byte first;
.equ PRESET, COUNTERS_STATE
; behind those, where its special memory is; its bits of EIMSK, and of PCICR, while it counts.
.equ SPECIAL, 8
.equ EDGES, 10
.equ CHANGES, 11
.equ OTHER, 4
; The pins as HSC0 saw them last, as the program sees them; the reset is 1 when it resets. Which of them are inverted for that.
.equ PINS, COUNTERS_STATE + 16
.equ INVERTED, COUNTERS_STATE + 17

; Special memory.
.equ SMB36, SPECIAL_IN_RANGES + 36
.equ SMB136, SPECIAL_IN_RANGES + 136
.equ CONTROL, 1
.equ NEW_CURRENT, 2
.equ NEW_PRESET, 6
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
; every edge of two tracks counts, and nothing resets or is inverted; pins that are looked at whenever they change.
.equ PLAIN, 6
.equ WATCHED, 7

; ---- interrupts: what happens most

; The next value of a counter, of which only the last byte changes. Otherwise all is looked at.
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

; INT0: the clock of HSC0, or the one that counts up.
first_input:
    in r0, MORE_FLAGS
    sbrc r0, WATCHED
    rcall watched
    sbrs r0, UP_0
    rjmp 1f
up:
    COUNT_UP 0
1:  sbrc r0, TWO_CLOCKS
    rjmp turn
down:
    COUNT_DOWN 0

; INT1: the clock of HSC3, or the one of HSC0 that counts down.
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

; PCINT2: the tracks of an encoder, the direction, the reset.
any_input:
    in r0, MORE_FLAGS
    sbrs r0, PLAIN
    rjmp not_plain
    in r30, PIND
    lds r31, PINS
    sts PINS, r30
    eor r31, r30
; The pins now in r30, what has changed in r31.
tracks:
    andi r31, TRACKS
    breq done
    cpi r31, TRACKS
    breq twice
    ; The first track, as it is now, and the second, as it was, are different: up.
    eor r31, r30
    lsr r31
    eor r31, r30
; HSC0 counts, up when the bit FIRST of r31 says so.
count:
    sbrs r31, FIRST
    rjmp 1f
    sbrc r0, UP_0
    rjmp up
    rjmp turn
1:  sbrs r0, UP_0
    rjmp down

; The direction of HSC0 changes, and it counts. MORE_FLAGS in r0.
turn:
    ldi r30, 1 << UP_0
    eor r0, r30
    out MORE_FLAGS, r0
    rcall turned
    rcall on
    rjmp one_step

; ---- interrupts: what happens now and then

; The next step of HSC0 in its direction, for `step`.
on:
    ldi r31, 1
    sbrs r0, UP_0
    ldi r31, -1
    ldi r30, lo8(PRESET)
    ret

; Both tracks have changed: two steps, at once when only the last byte changes and the preset is not near.
twice:
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
one_step:
    rcall step
done:
    INTERRUPT_DONE

turned:
    EVENT COUNTER_0_DIRECTION_EVENT
    ret

; A clock whose pins have changed, too: they come first. While it is reset the clock does not count.
watched:
    sbis PCIFR, PINS_BIT
    ret
    LOOK
    rcall watch
    sbic EIMSK, INT0
    ret
    pop r0
    pop r0
    rjmp done

; Pins that do not only count: the direction and the reset; tracks with a reset, of which one edge of four counts, or which
; are inverted.
not_plain:
    LOOK
    sbrc r0, QUADRATURE
    rjmp 1f
    rcall watch
    rjmp done
1:  push r18
    lds r18, PCMSK2
    eor r31, r30
    sbrc r18, RESET
    sbrs r31, RESET
    rjmp 2f
    eor r31, r30
    rcall watch
    eor r31, r30
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

.macro EACH instruction, registers:vararg
    .irp register, \registers
    \instruction \register
    .endr
.endm

; What the pins say about direction and reset: r30 now, r31 before. MORE_FLAGS in r0, before and after; keeps r30, r31.
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

; A counter's next value, 1 or -1 in r31 further, with what it causes. In r30 the low byte of its place in memory. Keeps
; r30; the step then is in r0.
step:
    mov r0, r31
    EACH push, r18, r19, r20, r21, r26, r27
    rcall current
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

; The status follows from value, preset and direction of the counter at r30, the low byte of its place.
settle:
    rcall current
    rjmp status

; The value of the counter at r30 in r21 (highest) to r18, X behind it.
current:
    mov r26, r30
    subi r26, lo8(PRESET - HIGH_SPEED_COUNTER_0)
    ldi r27, hi8(HIGH_SPEED_COUNTER_0)
    ld r21, X+
    ld r20, X+
    ld r19, X+
    ld r18, X+
    ret

; The status, in r18 too, of the counter at r30 with the value in r21 to r18. Changes r26, r27, r31.
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

; ---- instructions

; The number at Y and the byte behind it in r18 and r19; in r22 how far behind HSC0's the counter's memory is, in r23 its bit
; of FLAGS. Carry: no such counter. Otherwise Z: it is not defined.
counter:
    movw r30, r28
    lpm r18, Z+
    lpm r19, Z
    ldi r22, 0
    ldi r23, 1 << COUNTER_0_DEFINED
    tst r18
    breq 1f
    ldi r22, OTHER
    ldi r23, 1 << COUNTER_3_DEFINED
    cpi r18, 3
    sec
    brne 2f
1:  in r20, FLAGS
    and r20, r23
    clc
2:  ret

Hdef:
    rcall counter
    brcs refuse
    brne refuse
    ldi r24, lo8(SMB36)
    ldi r25, hi8(SMB36)
    sbrc r22, 2
    ldi r24, lo8(SMB136)
    rcall special
    ; The assembler gives it to each counter.
    brcs refuse
    rcall counter
    in r20, FLAGS
    ; I0.1 is HSC3's, or HSC0 has it for all but one clock. What the flags say before both are undefined is from another RUN.
    tst r22
    breq 2f
    tst r19
    brne refuse
    ldi r21, 1 << UP_3
    in r0, MORE_FLAGS
    sbrs r20, COUNTER_0_DEFINED
    rjmp inputs
    sbrc r0, INTERNAL_DIRECTION
    rjmp inputs
refuse:
    rjmp abandon
2:  ldi r21, 1 << INTERNAL_DIRECTION
3:  cpi r19, 3
    brlo 4f
    subi r19, 3
    lsl r21
    sbrs r21, QUADRATURE + 1
    rjmp 3b
    rjmp refuse
4:  cpi r19, 2
    breq refuse
    ; T: there is a reset.
    bst r19, 0
    sbrs r21, INTERNAL_DIRECTION
    sbrs r20, COUNTER_3_DEFINED
    rjmp inputs
    rjmp refuse
inputs:
    ldi r30, lo8(IMAGE_INVERTED_INPUTS)
    ldi r31, hi8(IMAGE_INVERTED_INPUTS)
    lpm r18, Z
    ldi r19, RISING
    sbrc r18, 0
    andi r19, lo8(~(1 << RISING_0))
    sbrc r18, 1
    andi r19, lo8(~(1 << RISING_1))
    sts EICRA, r19
    ldi r24, 1 << INT1
    clr r25
    tst r22
    brne define
    rcall define_0
define:
    ; Memory of the counter: nothing is left of another RUN.
    ldi r30, lo8(PRESET)
    ldi r31, hi8(PRESET)
    add r30, r22
    st Z, r1
    std Z + 1, r1
    std Z + 2, r1
    std Z + 3, r1
    std Z + SPECIAL, r26
    std Z + SPECIAL + 1, r27
    std Z + EDGES, r24
    std Z + CHANGES, r25
    in r0, SREG
    cli
    in r18, FLAGS
    in r19, MORE_FLAGS
    mov r20, r18
    andi r20, 1 << COUNTER_0_DEFINED | 1 << COUNTER_3_DEFINED
    brne 1f
    clr r19
1:  or r19, r21
    out MORE_FLAGS, r19
    or r18, r23
    out FLAGS, r18
    out SREG, r0
    set
    DONE

; HSC0: what r21, its kind, and T, whether it has a reset, mean for pins and interrupts. In r18 the inverted inputs, X its
; special memory; the bits of EIMSK in r24, of PCICR in r25.
define_0:
    adiw r26, CONTROL
    ld r20, X
    sbiw r26, CONTROL
    lsl r18
    lsl r18
    andi r18, TRACKS | 1 << RESET
    ldi r19, 1 << RESET
    sbrc r20, RESET_LOW
    eor r18, r19
    sts INVERTED, r18
    in r19, PIND
    eor r19, r18
    ; Pins that are looked at whenever they change, in r18.
    ldi r24, 1 << INT0
    clr r18
    ori r21, 1 << UP_0
    sbrs r21, EXTERNAL_DIRECTION
    rjmp 1f
    ldi r18, 1 << SECOND
    sbrs r19, SECOND
    andi r21, lo8(~(1 << UP_0))
1:  sbrc r21, TWO_CLOCKS
    ldi r24, 1 << INT0 | 1 << INT1
    sbrs r21, QUADRATURE
    rjmp 2f
    clr r24
    ldi r18, TRACKS
    sbrc r20, ONE_FOLD
    ldi r18, 1 << FIRST
2:  brtc 3f
    ori r18, 1 << RESET
3:  sts PCMSK2, r18
    tst r18
    breq 4f
    ldi r25, 1 << PINS_BIT
    ori r21, 1 << WATCHED
    cpi r18, TRACKS
    brne 4f
    lds r19, INVERTED
    andi r19, TRACKS
    brne 4f
    ori r21, 1 << PLAIN
4:  ret

; A double word at X, r18 (highest) to r21. X behind it.
.macro NEW_DOUBLE
    ld r18, X+
    ld r19, X+
    ld r20, X+
    ld r21, X+
.endm

Hsc:
    rcall counter
    brcs 1f
    brne 2f
1:  rjmp refuse
2:  ldi r30, lo8(PRESET)
    ldi r31, hi8(PRESET)
    add r30, r22
    ldd r26, Z + SPECIAL
    ldd r27, Z + SPECIAL + 1
    adiw r26, CONTROL
    ld r23, X+
    in r0, SREG
    cli
    ; Only with one clock, which HSC3 always has, the direction is the program's.
    in r24, MORE_FLAGS
    ldi r25, 1 << UP_3
    tst r22
    brne 3f
    ldi r25, 1 << UP_0
    sbrs r24, INTERNAL_DIRECTION
    rjmp 4f
3:  sbrs r23, TAKE_DIRECTION
    rjmp 4f
    or r24, r25
    sbrs r23, UP
    eor r24, r25
    out MORE_FLAGS, r24
4:  NEW_DOUBLE
    sbrs r23, TAKE_CURRENT
    rjmp 5f
    movw r24, r26
    mov r26, r30
    subi r26, lo8(PRESET - HIGH_SPEED_COUNTER_0)
    ldi r27, hi8(HIGH_SPEED_COUNTER_0)
    st X+, r18
    st X+, r19
    st X+, r20
    st X+, r21
    movw r26, r24
5:  sbrs r23, TAKE_PRESET
    rjmp 6f
    NEW_DOUBLE
    std Z + 3, r18
    std Z + 2, r19
    std Z + 1, r20
    st Z, r21
6:  rcall settle
    ; Whether it counted: what happened since then must not be forgotten. It may have no bits while it is reset.
    ldd r18, Z + EDGES
    ldd r19, Z + CHANGES
    in r20, EIMSK
    lds r21, PCICR
    sbrs r23, ENABLE
    rjmp 8f
    mov r24, r20
    and r24, r18
    mov r25, r21
    and r25, r19
    or r24, r25
    brne 9f
    out EIFR, r18
    tst r19
    breq 7f
    in r24, PIND
    lds r25, INVERTED
    eor r24, r25
    sts PINS, r24
    lds r25, PCMSK2
    and r24, r25
    ; While it is reset the clocks do not count.
    sbrc r24, RESET
    clr r18
7:  or r20, r18
    or r21, r19
    rjmp 10f
8:  com r18
    com r19
    and r20, r18
    and r21, r19
10: out EIMSK, r20
    sts PCICR, r21
9:  out SREG, r0
    DONE
