; Module 11: numbers as characters and back, hexadecimal digits. They do what plc-vm does (plc/vm/src/modules: ascii.rs,
; numeral.rs). Numbers of 64 bits stand on the hardware stack, the most significant byte first.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB abandon, ABANDON

; Numbers of routines.
.equ FIRST_NUMBER, 2
.equ FIRST_TEXT, 5
.equ DECIMALS_MAX, 5
; What ITA, DTA, RTA count from 0.
.equ REAL, 2
; The exponent of a real whose mantissa is a number of units.
.equ EXPONENT_OF_UNITS, 150

.include "strings.inc"

; ---- hexadecimal digits

; T: HTA. LEN in r18, the bytes that they make in r19.
Ath:
    clt
Hta:
    adiw r28, 4
    rcall read_byte
    sbiw r28, 6
    mov r18, r22
    mov r19, r22
    lsr r19
    adc r19, r1
    mov r24, r18
    mov r25, r19
    brtc 1f
    mov r24, r19
    mov r25, r18
1:  rcall bytes_in
    cp r30, r24
    cpc r31, r1
    brcs bad_digits
    movw r20, r26
    rcall bytes_to
    cp r30, r25
    cpc r31, r1
    brcs bad_digits
    ; What is written must not be read afterwards: digits (T: characters) come first, or begin at the same place.
    movw r22, r26
    sub r22, r20
    sbc r23, r21
    brtc 1f
    com r23
    neg r22
    sbci r23, -1
1:  cp r22, r18
    cpc r23, r1
    brcc 2f
    or r22, r23
    brne bad_digits
2:  movw r30, r20
    tst r18
    breq hex_done
    brts to_characters
    mov r24, r18
3:  ld r25, Z+
    rcall hex_digit
    brcc 7f
    dec r24
    brne 3b
    movw r30, r20
4:  ld r25, Z+
    rcall hex_digit
    swap r25
    mov r23, r25
    ; Behind an odd number the lower half stays.
    ld r25, X
    andi r25, 0x0F
    dec r18
    breq 5f
    ld r25, Z+
    rcall hex_digit
    dec r18
5:  or r25, r23
    st X+, r25
    tst r18
    brne 4b
    rcall result_bit
    andi r25, lo8(~(1 << NO_HEX))
    rjmp 8f
7:  sts ENO, r1
    rcall result_bit
    ori r25, 1 << NO_HEX
8:  sts RESULT_BITS, r25
hex_done:
    set
    DONE
bad_digits:
    rjmp abandon
result_bit:
    lds r25, RESULT_BITS
    ret

; The digit for the character r25. No carry: it is none.
hex_digit:
    subi r25, '0'
    cpi r25, 10
    brcs 2f
    subi r25, 'A' - '0' - 10
    cpi r25, 10
    brcs 1f
    cpi r25, 16
    ret
1:  clc
2:  ret

; The last one first.
to_characters:
    add r30, r19
    adc r31, r1
    add r26, r18
    adc r27, r1
1:  ld r23, -Z
    sbrc r18, 0
    rjmp 2f
    mov r25, r23
    rcall 3f
    dec r18
2:  mov r25, r23
    swap r25
    rcall 3f
    dec r18
    brne 1b
    rjmp hex_done
3:  andi r25, 0x0F
    subi r25, -'0'
    cpi r25, '9' + 1
    brlo 4f
    subi r25, -('A' - '9' - 1)
4:  st -X, r25
    ret

; ---- numbers of 64 bits, the first byte at r14 and r15. All change r18, Z, r28 and r29.

.equ NUMBER_LEN, 8

; Z at the number, its length in r28.
number:
    movw r30, r14
    ldi r28, NUMBER_LEN
    ret
; Z behind the number, its length in r28.
number_end:
    rcall number
    adiw r30, NUMBER_LEN
    ret

; The rest of a division by ten in r25; what is 0 when the number is 0, in r0.
divide_by_ten:
    rcall number
    clr r25
    clr r0
1:  ld r18, Z
    mov r29, r18
    or r29, r25
    breq 4f
    ldi r29, 8
2:  lsl r18
    rol r25
    cpi r25, 10
    brlo 3f
    subi r25, 10
    inc r18
3:  dec r29
    brne 2b
4:  st Z+, r18
    or r0, r18
    dec r28
    brne 1b
    ret

; Ten times the number and r25.
times_ten:
    rcall number_end
    ldi r29, 10
1:  ld r18, -Z
    mul r18, r29
    clr r18
    add r0, r25
    adc r1, r18
    st Z, r0
    mov r25, r1
    dec r28
    brne 1b
    clr r1
    ret

; By one place; the carry comes in (`shift_left`: 0) and goes out.
shift_left:
    rcall number_end
    clc
1:  ld r18, -Z
    rol r18
    st Z, r18
    dec r28
    brne 1b
    ret
shift_right:
    rcall number
    clc
1:  ld r18, Z
    ror r18
    st Z+, r18
    dec r28
    brne 1b
    ret

; Begins and ends the room for a number. Change r18, Z and r0.
.macro NUMBER_ON_STACK b0, b1, b2, b3
    push r14
    push r15
    push \b0
    push \b1
    push \b2
    push \b3
    push r1
    push r1
    push r1
    push r1
    in r30, 0x3D
    in r31, 0x3E
    adiw r30, 1
    movw r14, r30
.endm
.macro NUMBER_OFF_STACK
    ldi r18, NUMBER_LEN
1:  pop r0
    dec r18
    brne 1b
    pop r15
    pop r14
.endm

; ---- numbers to characters

; The number of the routine in r19, FMT in r18, the value in r25 to r22; T: to a string.
Ita:
Dta:
Rta:
    clt
Its:
Dts:
Rts:
    mov r19, r26
    brts 1f
    adiw r28, 2
1:  adiw r28, 2
    rcall read_byte
    mov r18, r22
    sbiw r28, 4
    brts 2f
    sbiw r28, 2
    ; Characters: 8, 12, or as many as FMT says.
2:  subi r19, FIRST_NUMBER
    cpi r19, FIRST_TEXT - FIRST_NUMBER
    brlo 3f
    subi r19, FIRST_TEXT - FIRST_NUMBER
3:  ldi r20, 8
    ldi r26, READ + 2
    cpi r19, 1
    brlo 4f
    ldi r20, 12
    ldi r26, READ + 4
    breq 4f
    mov r20, r18
    swap r20
    andi r20, 0x0F
    cpi r20, 3
    brlo bad_number
4:  rcall operands
    brtc 5f
    adiw r28, 2
5:  rcall bytes_to
    mov r21, r20
    brtc 6f
    inc r21
6:  cp r30, r21
    cpc r31, r1
    brcs bad_number
    brtc 7f
    st X+, r20
    ; From the last character on: r21 are left. r20 bit 7: there is no number, or it does not fit.
7:  add r26, r20
    adc r27, r1
    mov r21, r20
    mov r0, r18
    andi r18, 0x07
    cpi r18, DECIMALS_MAX + 1
    mov r18, r0
    brsh 1f
    bst r25, 7
    cpi r19, REAL
    breq 2f
    cpi r18, 0x10
    brsh 1f
    brtc 4f
    com r25
    com r24
    com r23
    neg r22
    sbci r23, -1
    sbci r24, -1
    sbci r25, -1
    rjmp 4f
1:  ori r20, 0x80
    rjmp fill
bad_number:
    rjmp abandon
    ; The exponent in r19, the mantissa in r24 to r22.
2:  mov r19, r24
    lsl r19
    mov r19, r25
    rol r19
    cpi r19, 255
    breq 1b
    clr r25
    andi r24, 0x7F
    tst r19
    brne 3f
    inc r19
    rjmp 5f
3:  ori r24, 0x80
    rjmp 5f
4:  ldi r19, 0
5:  NUMBER_ON_STACK r22, r23, r24, r25
    mov r22, r18
    andi r22, 0x07
    ldi r23, '.'
    sbrc r18, 3
    ldi r23, ','
    tst r19
    breq digits
    ; A real: in units of the last decimal, then times 2 to the power of its exponent, rounded.
    mov r24, r22
1:  subi r24, 1
    brcs 2f
    clr r25
    rcall times_ten
    rjmp 1b
2:  cpi r19, EXPONENT_OF_UNITS
    breq digits
    brlo 3f
    rcall shift_left
    movw r30, r14
    ld r18, Z
    sbrc r18, 7
    rjmp too_large
    dec r19
    rjmp 2b
3:  ldi r24, EXPONENT_OF_UNITS
    sub r24, r19
    cpi r24, 64
    brlo 4f
    ldi r24, 63
4:  rcall shift_right
    dec r24
    brne 4b
    rol r24
    rcall number_end
    lsr r24
5:  ld r18, -Z
    adc r18, r1
    st Z, r18
    dec r28
    brne 5b

; r22: decimals; r23: what stands before them. r24 counts digits; r19 is 0 when all are 0.
digits:
    clr r24
    clr r19
1:  rcall divide_by_ten
    or r19, r25
    subi r25, -'0'
    rcall put
    inc r24
    cp r22, r24
    breq 2f
    brsh 1b
    tst r0
    brne 1b
    brtc 3f
    tst r19
    breq 3f
    ldi r25, '-'
    rcall put
    rjmp 3f
2:  mov r25, r23
    rcall put
    rjmp 1b
too_large:
    ori r20, 0x80
3:  NUMBER_OFF_STACK
fill:
    sbrs r20, 7
    rjmp 1f
    ; Nothing but spaces.
    mov r18, r20
    andi r18, 0x7F
    sub r18, r21
    add r26, r18
    adc r27, r1
    add r21, r18
1:  ldi r25, ' '
2:  subi r21, 1
    brcs 3f
    st -X, r25
    rjmp 2b
3:  set
    sbrc r20, 7
    rjmp abandon
    DONE

; The character r25 before the others, if there is room.
put:
    tst r21
    breq 1f
    dec r21
    st -X, r25
    ret
1:  ori r20, 0x80
    ret

; ---- characters to numbers

; Bits in r19, beside the lowest of the routine's number.
.equ HAS_DIGITS, 7
.equ BEHIND_POINT, 6
.equ TENS_TO_COME, 5
.equ STI_BITS, 0
.equ STR_BITS, 2
.equ KIND_BITS, 3

; The next of r23 characters at r20 and r21, in r22. Carry: there is none.
next:
    subi r23, 1
    brcs 1f
    movw r30, r20
    rcall fetch
    movw r20, r30
    mov r22, r0
1:  ret

Sti:
Std:
Str:
    mov r19, r26
    andi r19, KIND_BITS
    rcall bytes_in
    rcall begin_first
    brcs bad_text
    rcall read_byte
    rcall at_position
    brcs bad_text
    ldi r26, WRITE + 4
    cpi r19, STI_BITS
    brne 1f
    ldi r26, WRITE + 2
1:  rcall operands
    mov r23, r18
    NUMBER_ON_STACK r1, r1, r1, r1
    ; The digits in the number; r24: the tens that it is to be multiplied with, or divided by.
    clr r24
    clt
2:  rcall next
    brcs ended
    cpi r22, ' '
    breq 2b
    cpi r22, '+'
    breq 3f
    cpi r22, '-'
    brne 4f
    set
3:  rcall next
    brcs ended
4:  subi r22, '0'
    cpi r22, 10
    brsh 6f
    ori r19, 1 << HAS_DIGITS
    movw r30, r14
    ld r25, Z
    cpi r25, 0x10
    brsh 5f
    mov r25, r22
    rcall times_ten
    sbrc r19, BEHIND_POINT
    inc r24
    rjmp 3b
    ; No more digits fit.
5:  sbrc r19, BEHIND_POINT
    rjmp 3b
    inc r24
    ori r19, 1 << TENS_TO_COME
    rjmp 3b
    ; One point or comma is part of a real.
6:  mov r25, r19
    andi r25, 1 << BEHIND_POINT | KIND_BITS
    cpi r25, STR_BITS
    brne ended
    ori r22, 2
    cpi r22, lo8('.' - '0')
    brne ended
    ori r19, 1 << BEHIND_POINT
    rjmp 3b
bad_text:
    rjmp abandon

ended:
    sbrs r19, HAS_DIGITS
    rjmp no_number
    andi r19, KIND_BITS | 1 << TENS_TO_COME
    cpi r19, STR_BITS
    breq 1f
    cpi r19, STR_BITS | 1 << TENS_TO_COME
    brne 2f
1:  rjmp to_real
2:  andi r19, KIND_BITS
    ; An integer: 32 bits with its sign.
    movw r30, r14
    ld r0, Z+
    ld r18, Z+
    or r0, r18
    ld r18, Z+
    or r0, r18
    ld r18, Z+
    or r0, r18
    brne no_number
    rcall load_value
    tst r25
    brpl 1f
    brtc no_number
    cpi r25, 0x80
    cpc r24, r1
    cpc r23, r1
    cpc r22, r1
    brne no_number
1:  brtc 2f
    com r25
    com r24
    com r23
    neg r22
    sbci r23, -1
    sbci r24, -1
    sbci r25, -1
2:  cpi r19, STI_BITS
    brne have_number
    clr r0
    sbrc r23, 7
    com r0
    cp r24, r0
    cpc r25, r0
    brne no_number
have_number:
    NUMBER_OFF_STACK
    cpi r19, STI_BITS
    breq 1f
    st X+, r25
    st X+, r24
1:  st X+, r23
    st X, r22
    lds r24, RESULT_BITS
    andi r24, lo8(~(1 << OVERFLOW))
    rjmp 2f
no_number:
    NUMBER_OFF_STACK
    sts ENO, r1
    lds r24, RESULT_BITS
    ori r24, 1 << OVERFLOW
2:  sts RESULT_BITS, r24
    set
    DONE

; The four bytes at Z.
load_value:
    ld r25, Z+
    ld r24, Z+
    ld r23, Z+
    ld r22, Z+
    ret

; Shifts the number until its top bit is set; the exponent in r20 and r21.
normalize:
    movw r30, r14
    ld r18, Z
    sbrc r18, 7
    ret
    rcall shift_left
    subi r20, 1
    sbci r21, 0
    rjmp normalize

to_real:
    rcall number
    clr r0
1:  ld r18, Z+
    or r0, r18
    dec r28
    brne 1b
    tst r0
    brne 1f
    rjmp zero
1:  ldi r20, NUMBER_LEN * 8 - 1
    ldi r21, 0
    rcall normalize
2:  subi r24, 1
    brcs 6f
    sbrs r19, TENS_TO_COME
    rjmp 4f
    ldi r29, 4
3:  rcall shift_right
    dec r29
    brne 3b
    clr r25
    rcall times_ten
    subi r20, -4
    sbci r21, -1
    rjmp 5f
4:  rcall divide_by_ten
5:  rcall normalize
    rjmp 2b
    ; The exponent as a real has it, less one. Below the least, bits of the number are lost: r19.
6:  clr r19
    subi r20, -126
    sbci r21, -1
    brpl 8f
    cpi r20, -24
    ldi r18, -1
    cpc r21, r18
    brsh 7f
    rjmp zero
7:  rcall shift_right
    sbc r18, r18
    or r19, r18
    inc r20
    brne 7b
    clr r21
8:  cpi r20, 254
    cpc r21, r1
    brge far_no_number
    ; The nearest of 24 bits, the even one of two.
    movw r30, r14
    ld r24, Z+
    ld r23, Z+
    ld r22, Z+
    ld r18, Z+
    ldi r28, 4
9:  ld r25, Z+
    or r19, r25
    dec r28
    brne 9b
    ldi r25, 0
    sbrs r18, 7
    rjmp 1f
    mov r25, r22
    andi r25, 1
    or r25, r19
    andi r18, 0x7F
    or r25, r18
1:  cp r1, r25
    ldi r25, 0
    adc r22, r1
    adc r23, r1
    adc r24, r1
    adc r25, r1
    ; The leading bit adds one to the exponent, so does the carry of the rounding.
    lsr r20
    ldi r18, 0
    ror r18
    add r24, r18
    adc r25, r20
    cpi r24, 0x80
    ldi r18, 0x7F
    cpc r25, r18
    brlo sign
far_no_number:
    rjmp no_number
zero:
    clr r22
    clr r23
    movw r24, r22
sign:
    bld r25, 7
    ldi r19, STR_BITS
    rjmp have_number
