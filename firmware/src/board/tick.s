; The interrupt of every millisecond: the clock, and one conversion of an analog input. And what
; takes the values of the inputs into the image. What the clock and the inputs are for is not known
; here.

.equ ADCL, 0x78
.equ ADCH, 0x79
.equ ADCSRA, 0x7A
.equ ADMUX, 0x7C
.equ SREG, 0x3F
; Starts a conversion at 125 kHz: full precision, 104 us.
.equ CONVERT, 0xC7
.equ CHANNEL_MASK, 7

.section .text.uno200_tick_interrupt, "ax", @progbits

; TIMER0_COMPA. Only what is pushed may be used, r1 may be anything.
; in: -   ends: the interrupt
.global __vector_14
__vector_14:
    push r31
    in r31, SREG
    push r31
    push r30
    push r25
    push r24
    push r19
    push r18
    ldi r30, lo8(UNO200_TICK)
    ldi r31, hi8(UNO200_TICK)
1:  ld r24, Z
    inc r24
    st Z+, r24
    brne 2f
    cpi r30, lo8(UNO200_TICK + 4)
    brne 1b
2:  ; The input that has been converted. A sample replaces its share of the sum, which is the value.
    lds r18, ADMUX
    andi r18, CHANNEL_MASK
    ldi r19, 0
    lsl r18
    ldi r30, lo8(ANALOG)
    ldi r31, hi8(ANALOG)
    add r30, r18
    adc r31, r19
    ld r18, Z
    ldd r19, Z+1
    ldd r24, Z+SUMS
    ldd r25, Z+SUMS + 1
    sub r24, r18
    sbc r25, r19
    lds r18, ADCL
    lds r19, ADCH
    add r24, r18
    adc r25, r19
    std Z+SUMS, r24
    std Z+SUMS + 1, r25
    lds r18, ANALOG + FILTER
    rjmp 4f
3:  lsr r25
    ror r24
4:  dec r18
    brpl 3b
    st Z, r24
    std Z+1, r25
    ; It is fresh.
    lds r18, ADMUX
    andi r18, CHANNEL_MASK
    mov r24, r18
    ldi r25, 1
    rjmp 6f
5:  lsl r25
6:  dec r24
    brpl 5b
    lds r24, ANALOG + FRESH
    or r24, r25
    sts ANALOG + FRESH, r24
    ; The next one.
    inc r18
    cpi r18, CHANNELS
    brlo 7f
    ldi r18, 0
7:  ori r18, REFERENCE
    sts ADMUX, r18
    ldi r18, CONVERT
    sts ADCSRA, r18
    pop r18
    pop r19
    pop r24
    pop r25
    pop r30
    pop r31
    out SREG, r31
    pop r31
    reti

; void uno200_take_analog(): gives the image the fresh values, as raw counts and to scale.
; in: -   out: -   destroys: r0, r18-r25, X, Z
.global uno200_take_analog
uno200_take_analog:
    ldi r26, lo8(ANALOG)
    ldi r27, hi8(ANALOG)
    ldi r30, lo8(AIW_START)
    ldi r31, hi8(AIW_START)
    ldi r19, 0
    in r0, SREG
    cli
    lds r20, ANALOG + FRESH
    sts ANALOG + FRESH, r19
    out SREG, r0
1:  in r0, SREG
    cli
    ld r24, X+
    ld r25, X+
    out SREG, r0
    lsr r20
    brcc 3f
    std Z+AIN_START - AIW_START, r25
    std Z+AIN_START - AIW_START + 1, r24
    cpi r25, hi8(RAW_MAX + 1)
    brlo 2f
    ldi r24, lo8(RAW_MAX)
    ldi r25, hi8(RAW_MAX)
2:  ; Bytes 1, 2 and 3 of the product in r21, r22 and r23, rounded.
    ldi r21, 0x80
    ldi r22, 0
    ldi r23, 0
    ldi r18, lo8(SCALE)
    mul r24, r18
    add r21, r1
    adc r22, r19
    mul r25, r18
    add r21, r0
    adc r22, r1
    ldi r18, hi8(SCALE)
    mul r24, r18
    add r21, r0
    adc r22, r1
    mul r25, r18
    add r22, r0
    adc r23, r19
    ldi r18, hlo8(SCALE)
    mul r24, r18
    add r22, r0
    adc r23, r1
    mul r25, r18
    add r23, r0
    st Z, r23
    std Z+1, r22
3:  adiw r30, 2
    tst r20
    brne 1b
    clr r1
    ret
