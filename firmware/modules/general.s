; Module 0: bytes, words and double words with any operand: moves, arithmetic, logic, shifts, conversions, comparisons, ranges
; of bits. They do what plc-vm does (plc/vm/src/modules).
;
; Most routines share one way: IN1 and OUT are brought to 32 bits with their sign, and what becomes of them is written in
; the width of OUT. Routines that do the same in three widths have numbers in a row.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB abandon, ABANDON

; The value of IN, as long as r20 says.
read_in:
    mov r26, r20
    ori r26, READ
    rjmp operands
; The address of OUT, as long as r19 says.
target_out:
    mov r26, r19
    ori r26, WRITE
    rjmp operands

; ---- subroutines

; r26 / 3 in r18, the remainder in r26.
divide_by_3:
    ldi r18, -1
1:  inc r18
    subi r26, 3
    brcc 1b
    subi r26, -3
    ret

; The width in bytes, r26 and r19, from its number 0, 1, 2 in r26.
width:
    lsl r26
    brne 1f
    inc r26
1:  mov r19, r26
    ret

; The value of r31 bytes at X, with its sign. X behind it.
load:
    sbrc r31, 2
    rjmp 2f
    clr r23
    sbrc r31, 1
    ld r23, X+
    ld r22, X+
    clr r24
    sbrc r23, 7
    com r24
    mov r25, r24
    ret
2:  ld r25, X+
    ld r24, X+
    ld r23, X+
    ld r22, X+
    ret

; The value to the r31 bytes at X or, `store`, before X, which is at the first of them then.
store_at:
    add r26, r31
    adc r27, r1
store:
    st -X, r22
    sbrc r31, 0
    ret
    st -X, r23
    sbrs r31, 2
    ret
    st -X, r24
    st -X, r25
    ret

; Z: the value fits r31 bytes.
fits:
    cp r1, r1
    sbrc r31, 2
    ret
    clr r0
    sbrc r31, 1
    sbrs r23, 7
    rjmp 1f
    com r0
1:  cp r24, r0
    cpc r25, r0
    sbrc r31, 0
    cpc r23, r0
    ret

; Z: the r31 lowest bytes of the value are 0.
is_zero:
    mov r0, r22
    sbrs r31, 0
    or r0, r23
    sbrs r31, 2
    rjmp 1f
    or r0, r24
    or r0, r25
1:  tst r0
    ret

; The value with the other sign.
negate:
    com r25
    com r24
    com r23
    neg r22
    sbci r23, -1
    sbci r24, -1
    sbci r25, -1
    ret

; ---- moves and conversions: lengths of IN in r20, of OUT in r19

Movd:
Movr:
    ldi r20, 4
    rjmp 1f
Itd:
    ldi r20, 2
1:  ldi r19, 4
    rjmp convert
Dti:
    ldi r20, 4
    rjmp 1f
Bti:
    ldi r20, 1
    rjmp 1f
MovwAny:
    ldi r20, 2
1:  ldi r19, 2
    rjmp convert
Itb:
    ldi r20, 2
    rjmp 1f
MovbAny:
    ldi r20, 1
1:  ldi r19, 1
convert:
    rcall read_in
    rcall target_out
    mov r31, r19
    cp r19, r20
    brsh write
    rcall fits
    ldi r20, 1 << OVERFLOW
; Z: the value is written and the bit r20 of SMB1 becomes 0. Otherwise it becomes 1.
write_if:
    ldi r18, 0
    breq 1f
    sts ENO, r1
    mov r18, r20
    rjmp status
1:  rcall store_at
    rjmp status

; The segments for the digits 0 to F: bit 0 is a, bit 6 is g.
Seg:
    ldi r20, 1
    ldi r19, 1
    rcall read_in
    rcall target_out
    rcall 1f
    .byte 0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07, 0x7F, 0x67, 0x77, 0x7C, 0x39, 0x5E, 0x79, 0x71
1:  pop r31
    pop r30
    lsl r30
    rol r31
    andi r22, 0x0F
    add r30, r22
    adc r31, r1
    lpm r22, Z
    ldi r31, 1
    rjmp write

Deco:
    ldi r20, 1
    ldi r19, 2
    rcall read_in
    rcall target_out
    mov r31, r19
    mov r18, r22
    andi r18, 0x0F
    ldi r22, 1
    clr r23
1:  dec r18
    brmi write
    lsl r22
    rol r23
    rjmp 1b

Enco:
    ldi r20, 2
    ldi r19, 1
    rcall read_in
    rcall target_out
    mov r31, r19
    ; Behind the 16 bits stands one more, for 0.
    ldi r18, -1
    sec
1:  inc r18
    ror r23
    ror r22
    brcc 1b
    andi r18, 0x0F
    mov r22, r18
write:
    rcall store_at
    rjmp done

Swap:
    ldi r19, 2
    rcall target_out
    ld r24, X+
    ld r25, X
    st X, r24
    st -X, r25
done:
    DONE

; ---- BCD, in place

Bcdi:
    ldi r19, 2
    rcall target_out
    rcall begin_bcd
    ldi r21, 4
1:  mov r20, r25
    swap r20
    andi r20, 0x0F
    cpi r20, 10
    brsh no_bcd
    rcall shift_digit
    lsl r22
    rol r23
    movw r18, r22
    lsl r18
    rol r19
    lsl r18
    rol r19
    add r22, r18
    adc r23, r19
    add r22, r20
    adc r23, r1
    dec r21
    brne 1b
    rjmp is_bcd

Ibcd:
    ldi r19, 2
    rcall target_out
    rcall begin_bcd
    ldi r18, hi8(10000)
    cpi r24, lo8(10000)
    cpc r25, r18
    brsh no_bcd
    ; The number in r22 and r23, its digits in r24 and r25.
    movw r22, r24
    clr r25
    ldi r20, lo8(1000)
    ldi r21, hi8(1000)
    rcall next_digit
    ldi r20, 100
    ldi r21, 0
    rcall next_digit
    ldi r20, 10
    rcall next_digit
    rcall shift_digit
    add r22, r24
    mov r23, r25
is_bcd:
    sez
    rjmp 1f
no_bcd:
    clz
1:  ldi r20, 1 << NO_BCD
    rjmp write_if

; The word at X in r24 and r25, 0 in r22 and r23.
begin_bcd:
    mov r31, r19
    ld r25, X+
    ld r24, X
    sbiw r26, 1
    clr r22
    clr r23
    ret

; Another digit of r24 and r25: how often r20 and r21 are in r22 and r23.
next_digit:
    rcall shift_digit
1:  sub r22, r20
    sbc r23, r21
    brcs 2f
    inc r24
    rjmp 1b
2:  add r22, r20
    adc r23, r21
    ret
; r24 and r25 a digit to the left.
shift_digit:
    ldi r18, 4
1:  lsl r24
    rol r25
    dec r18
    brne 1b
    ret

.include "arithmetic.inc"
.include "bits.inc"
