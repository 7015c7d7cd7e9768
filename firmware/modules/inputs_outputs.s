; Module 5: points of the board beside the process image, and interrupt events.
;
; Events are looked for whenever the program polls: the engine comes to `events` when pins, T32 and T96, or the clock
; are others than at the last poll. Routines are entered as a call enters them; where they return to is bytecode of this
; module, which comes back here. Nothing of this is done by interrupts of the processor.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB source_byte, 1
STUB target_byte, WRITE + 1
STUB abandon, ABANDON

; ---- the image

.equ IMAGE_INVERTED_INPUTS, IMAGE + 27
.equ IMAGE_INVERTED_OUTPUTS, IMAGE + 28

; ---- registers and data memory

.equ DDRB, 0x04
.equ PORTB, 0x05
.equ PIND, 0x09
; IB0 begins at bit 2 of the pins.
.equ INPUTS, 0x3F
.equ OUTPUTS, 6
.equ Q_OFFSET, 0x10
.equ AREA_LEN, 16

; ---- points

; The inputs as they are now, like IB0, in r18: those that are forced with their values. Changes r19, Z.
inputs:
    ldi r30, lo8(IMAGE_INVERTED_INPUTS)
    ldi r31, hi8(IMAGE_INVERTED_INPUTS)
    lpm r18, Z
    in r19, PIND
    lsr r19
    lsr r19
    eor r18, r19
    andi r18, INPUTS
    lds r19, FORCED_INPUTS
    or r18, r19
    eor r18, r19
    lds r19, FORCED_INPUTS + 1
    or r18, r19
    ret

; The number of a point in the word at Y. Changes Z.
point:
    movw r30, r28
    lpm r20, Z
    andi r20, 7
    ret

; In the order of their numbers: each pair loads, combines by AND, by OR; the second of a pair inverts.
Ldi:
Ldni:
Ai:
Ani:
Oi:
Oni:
    rcall inputs
    rcall point
1:  subi r20, 1
    brcs 2f
    lsr r18
    rjmp 1b
2:  sbrc r26, 0
    com r18
    andi r18, 1
    mov r19, r26
    lsr r19
    ldi r26, COMBINE
    rjmp operands

AssignImmediate:
    rcall point
    rcall write_point
done:
    DONE

SetImmediate:
ResetImmediate:
    mov r18, r26
    adiw r28, 2
    rcall read_byte
    sbiw r28, 4
    rcall point
    mov r23, r20
    add r23, r22
    brcs 1f
    cpi r23, AREA_LEN * 8 + 1
    brsh 1f
    sbrs r18, 0
    clt
2:  subi r22, 1
    brcs 3f
    rcall write_point
    inc r20
    rjmp 2b
3:  set
    rjmp done
1:  rjmp abandon

; T to output r20 in the process image and, where there is one and the output is not forced, to its pin: the pin of a
; forced one is left as the scan before left it. Keeps r20, r22.
write_point:
    mov r26, r20
    lsr r26
    lsr r26
    lsr r26
    subi r26, -Q_OFFSET
    ldi r27, hi8(DATA_START)
    mov r19, r20
    andi r19, 7
    ldi r18, 1
1:  subi r19, 1
    brcs 2f
    lsl r18
    rjmp 1b
2:  ld r19, X
    or r19, r18
    brts 3f
    eor r19, r18
3:  st X, r19
    cpi r20, OUTPUTS
    brsh 5f
    lds r19, FORCED_OUTPUTS
    and r19, r18
    brne 5f
    rcall inverted_outputs
    and r19, r18
    in r21, PORTB
    or r21, r18
    brts 4f
    eor r21, r18
4:  eor r21, r19
    out PORTB, r21
    in r21, DDRB
    or r21, r18
    out DDRB, r21
5:  ret

; Which outputs are inverted, in r19. Changes Z.
inverted_outputs:
    ldi r30, lo8(IMAGE_INVERTED_OUTPUTS)
    ldi r31, hi8(IMAGE_INVERTED_OUTPUTS)
    lpm r19, Z
    ret

; OUT := a byte of I: IB0 by its pins.
Bir:
    rcall source_byte
    cpi r27, hi8(DATA_START)
    brne 1f
    cpi r26, AREA_LEN
    brsh 1f
    ld r22, X
    tst r26
    brne 2f
    rcall inputs
    mov r22, r18
2:  rcall target_byte
    st X, r22
    rjmp done
1:  rjmp abandon

; A byte of Q := IN: QB0 to its pins, too.
Biw:
    rcall read_byte
    rcall target_byte
    cpi r27, hi8(DATA_START)
    brne 1b
    mov r18, r26
    subi r18, Q_OFFSET
    cpi r18, AREA_LEN
    brsh 1b
    st X, r22
    tst r18
    brne 2f
    lds r19, FORCED_OUTPUTS
    or r22, r19
    eor r22, r19
    lds r19, FORCED_OUTPUTS + 1
    or r22, r19
    rcall inverted_outputs
    eor r22, r19
    andi r22, (1 << OUTPUTS) - 1
    out PORTB, r22
    ldi r22, (1 << OUTPUTS) - 1
    out DDRB, r22
2:  rjmp done

; The Uno has no LED for it: L is output Q0.5.
Dled:
    rcall read_byte
    rjmp done

.include "events.inc"
