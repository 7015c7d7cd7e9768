; Module 0: bytes, words and double words with any operand: moves, arithmetic, logic, shifts, conversions, comparisons, ranges
; of bits. They do what plc-vm does (plc/vm/src/modules).
;
; Most routines share one way: IN1 and OUT are brought to 32 bits with their sign, and what becomes of them is written in
; the width of OUT. Routines that do the same in three widths have numbers in a row.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB abandon, ABANDON

; The numbers of the first of several routines.
.equ FIRST_STEP, 0x0E
.equ FIRST_LOGIC, 0x14
.equ FIRST_COMPARISON, 0x36
.equ SET_ANY, 0x40

; Operations on OUT (r25 to r22) and IN1 (r21 to r18).
.equ ADD, 0
.equ MULTIPLY, 2
.equ DIVIDE, 3
.equ AND, 4
.equ EXCLUSIVE_OR, 6
; Besides: what does not fit is written all the same; OUT is the lower word of a double word.
.equ WRAPS, 0x10
.equ WORDS, 0x20

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

; ---- arithmetic and logic

Incb:
Decb:
IncwAny:
DecwAny:
Incd:
Decd:
    subi r26, FIRST_STEP
    mov r18, r26
    andi r18, 1
    ori r18, WRAPS
    lsr r26
    rcall width
    ldi r22, 1
    clr r23
    clr r24
    clr r25
    rjmp with_out

Andb:
Andw:
Andd:
Orb:
Orw:
Ord:
Xorb:
Xorw:
Xord:
    rcall logic
    rjmp equally_long
Invb:
Invw:
Invd:
    rcall logic
    ldi r18, EXCLUSIVE_OR
    ldi r22, -1
    mov r23, r22
    movw r24, r22
    rjmp with_out
logic:
    subi r26, FIRST_LOGIC
    rcall divide_by_3
    subi r18, -(AND - 1)
    rjmp width

Mul:
    ldi r18, MULTIPLY + WORDS
    rjmp 1f
Div:
    ldi r18, DIVIDE + WORDS
1:  ldi r20, 2
    ldi r19, 4
    rjmp with_in

AddIntAny:
SubIntAny:
MulIntAny:
DivIntAny:
AddDouble:
SubDouble:
MulDouble:
DivDouble:
    mov r18, r26
    andi r18, 3
    ldi r19, 2
    sbrc r26, 3
    ldi r19, 4
; The operation in r18, the length of OUT in r19, that of IN1 in r20.
equally_long:
    mov r20, r19
with_in:
    rcall read_in
; IN1 is read.
with_out:
    rcall target_out
    mov r30, r18
    mov r31, r19
    movw r18, r22
    movw r20, r24
    sbrs r30, 5
    rjmp 1f
    adiw r26, 2
    ldi r31, 2
1:  rcall load
    sbrc r30, 2
    rjmp bitwise
    bst r30, 4
    sbrc r30, 1
    rjmp multiply_or_divide
    sbrc r30, 0
    rjmp 2f
    add r22, r18
    adc r23, r19
    adc r24, r20
    adc r25, r21
    rjmp 3f
2:  sub r22, r18
    sbc r23, r19
    sbc r24, r20
    sbc r25, r21
3:  brvs overflow
finish:
    rcall fits
    ldi r18, 0
    breq 1f
overflow:
    ldi r18, 1 << OVERFLOW
    sts ENO, r1
    brtc math_status
1:  rcall store
    cpi r30, DIVIDE + WORDS
    brne 2f
    ; The remainder.
    st -X, r20
    st -X, r21
2:  rcall is_zero
    brne 3f
    ori r18, 1 << ZERO
3:  sbrc r31, 1
    mov r25, r23
    sbrc r25, 7
    ori r18, 1 << NEGATIVE
; The bits r18 of SMB1, and 0 to the others that belong to the operation.
math_status:
    ldi r20, 1 << ZERO | 1 << OVERFLOW | 1 << NEGATIVE
    sbrc r31, 0
    ldi r20, 1 << ZERO | 1 << OVERFLOW
    sbrc r30, 1
    ori r20, 1 << DIVISION_BY_ZERO
    and r18, r20
; The bits r18 of SMB1, and 0 to the others in r20.
status:
    lds r19, RESULT_BITS
    com r20
    and r19, r20
    or r19, r18
    sts RESULT_BITS, r19
    set
    DONE

bitwise:
    sbrc r30, 1
    rjmp 2f
    sbrc r30, 0
    rjmp 1f
    and r22, r18
    and r23, r19
    and r24, r20
    and r25, r21
    rjmp pattern
1:  or r22, r18
    or r23, r19
    or r24, r20
    or r25, r21
    rjmp pattern
2:  eor r22, r18
    eor r23, r19
    eor r24, r20
    eor r25, r21
; The value is written; SM1.0 if it is 0.
pattern:
    rcall store
    ldi r20, 1 << ZERO
    clr r18
    rcall is_zero
    brne status
    mov r18, r20
    rjmp status

; By magnitudes; T: the result is negative.
multiply_or_divide:
    mov r0, r25
    eor r0, r21
    bst r0, 7
    mov r0, r25
    sbrc r25, 7
    rcall negate
    sbrs r21, 7
    rjmp 1f
    com r21
    com r20
    com r19
    neg r18
    sbci r19, -1
    sbci r20, -1
    sbci r21, -1
1:  sbrs r30, 0
    rjmp 2f
    cp r18, r1
    cpc r19, r1
    cpc r20, r1
    cpc r21, r1
    brne 2f
    rjmp by_zero
2:  push r14
    push r15
    push r16
    push r17
    clr r14
    clr r15
    movw r16, r14
    sbrc r30, 0
    rjmp divide
    ; r17 to r14: the product; r0: the multiplicand is not complete any more.
    clr r0
2:  lsr r21
    ror r20
    ror r19
    ror r18
    brcc 3f
    add r14, r22
    adc r15, r23
    adc r16, r24
    adc r17, r25
    brcs 4f
    tst r0
    brne 4f
3:  cp r18, r1
    cpc r19, r1
    cpc r20, r1
    cpc r21, r1
    breq 5f
    lsl r22
    rol r23
    rol r24
    rol r25
    brcc 2b
    inc r0
    rjmp 2b
    ; Too large in any case.
4:  ser r17
    mov r16, r17
5:  movw r22, r14
    movw r24, r16
    ; OUT of MUL is a double word.
    cpi r30, MULTIPLY + WORDS
    brne signed
    ldi r31, 4
    rjmp signed

; r17 to r14: the remainder; the quotient comes where the dividend was.
divide:
    push r30
    ldi r30, 32
1:  lsl r22
    rol r23
    rol r24
    rol r25
    rol r14
    rol r15
    rol r16
    rol r17
    cp r14, r18
    cpc r15, r19
    cpc r16, r20
    cpc r17, r21
    brlo 2f
    sub r14, r18
    sbc r15, r19
    sbc r16, r20
    sbc r17, r21
    inc r22
2:  dec r30
    brne 1b
    pop r30
    ; The remainder has the sign of the dividend.
    movw r20, r14
    sbrs r0, 7
    rjmp signed
    com r21
    neg r20
    sbci r21, -1
signed:
    pop r17
    pop r16
    pop r15
    pop r14
    tst r25
    brpl 1f
    ; Only the least number has the top bit.
    brtc 3f
    cpi r25, 0x80
    cpc r24, r1
    cpc r23, r1
    cpc r22, r1
    brne 3f
1:  brtc 2f
    rcall negate
2:  clt
    rjmp finish
3:  clt
    rjmp overflow
by_zero:
    sts ENO, r1
    ldi r18, 1 << DIVISION_BY_ZERO
    mov r20, r18
    rjmp status

; ---- shifts and rotations: r18 bit 0: to the right, bit 1: rotates

.equ FIRST_SHIFT, 0x20

Slb:
Slw:
Sld:
Srb:
Srw:
Srd:
Rlb:
Rlw:
Rld:
Rrb:
Rrw:
Rrd:
    subi r26, FIRST_SHIFT
    rcall divide_by_3
    rcall width
    rcall target_out
    movw r20, r26
    rcall read_byte
    movw r26, r20
    mov r30, r22
    mov r31, r19
    ; The bits that there are.
    mov r20, r31
    lsl r20
    lsl r20
    lsl r20
    sbrc r18, 1
    rjmp 1f
    cp r30, r20
    brlo 2f
    mov r30, r20
    rjmp 2f
1:  dec r20
    and r30, r20
2:  rcall load
    ; To the right zeros come in from above. All others see the value in all of the bits: what leaves, and comes in again,
    ; is at the ends of them.
    cpi r18, 1
    brne 3f
    sbrc r31, 2
    rjmp 4f
    clr r24
    clr r25
    rjmp 4f
3:  sbrc r31, 0
    mov r23, r22
    sbrs r31, 2
    movw r24, r22
4:  tst r30
    breq 8f
    rjmp 7f
5:  sbrc r18, 0
    rjmp 6f
    ; T: the bit that leaves.
    bst r25, 7
    lsl r22
    rol r23
    rol r24
    rol r25
    sbrc r18, 1
    bld r22, 0
    rjmp 7f
6:  bst r22, 0
    lsr r25
    ror r24
    ror r23
    ror r22
    sbrc r18, 1
    bld r25, 7
7:  subi r30, 1
    brcc 5b
    lds r20, RESULT_BITS
    bld r20, OVERFLOW
    sts RESULT_BITS, r20
8:  rjmp pattern

; ---- comparisons

LoadByteAny:
AndByteAny:
OrByteAny:
LoadWordAny:
AndWordAny:
OrWordAny:
LoadDouble:
AndDouble:
OrDouble:
    adiw r28, 1
    subi r26, FIRST_COMPARISON
    rcall divide_by_3
    push r26
    mov r26, r18
    rcall width
    ori r26, READ + COMPARE
    push r26
    rcall operands
    movw r18, r22
    movw r20, r24
    pop r26
    rcall operands
    pop r26
    ori r26, RELATE
    rjmp operands

; ---- ranges of bits

; The bit operand at Y: address in r24 and r25, number in r19.
bit_operand:
    movw r30, r28
    adiw r28, 2
    lpm r24, Z+
    lpm r25, Z
    mov r19, r24
    andi r19, 7
    lsr r25
    ror r24
    lsr r25
    ror r24
    lsr r25
    ror r24
    subi r25, hi8(-(DATA_START))
    ret

; Its mask in r23.
bit_mask:
    ldi r23, 1
1:  subi r19, 1
    brcs 2f
    lsl r23
    rjmp 1b
2:  ret

; Bits in a row: the first is r19 of byte r20 and r21, there are r22. X at the byte; carry: they are not all in its area.
bits_in_area:
    movw r24, r20
    ldi r26, ROOM_AT
    rcall operands
    mov r24, r19
    ldi r25, 0
    add r24, r22
    adc r25, r1
    adiw r24, 7
    lsr r25
    ror r24
    lsr r24
    lsr r24
    cp r30, r24
    cpc r31, r1
    brcs 1f
    ; Flash can change under a running program.
    ldi r24, hi8(DATA_END - 1)
    cp r24, r27
1:  ret

SetAny:
ResetAny:
    ; 0, and -1 for what is complemented before and after.
    ldi r18, SET_ANY
    sub r18, r26
    rcall bit_operand
    movw r20, r24
    rcall read_byte
    rcall bits_in_area
    brcs out_of_area
    tst r22
    breq all_done
    rcall bit_mask
1:  ld r24, X
    eor r24, r18
2:  or r24, r23
    dec r22
    breq 3f
    lsl r23
    brcc 2b
    rol r23
    eor r24, r18
    st X+, r24
    rjmp 1b
3:  eor r24, r18
    st X, r24
all_done:
    DONE
out_of_area:
    rjmp abandon

.equ REGISTER_MAX, 64

Shrb:
    adiw r28, 2
    rcall bit_operand
    movw r20, r24
    rcall read_byte
    mov r18, r22
    sbrc r22, 7
    neg r22
    cpi r22, REGISTER_MAX + 1
    brsh out_of_area
    rcall bits_in_area
    brcs out_of_area
    tst r22
    breq all_done
    ; T: the bit that enters.
    mov r20, r19
    sbiw r28, 6
    rcall bit_operand
    movw r30, r24
    andi r31, 0x07
    rcall bit_mask
    ld r24, Z
    and r24, r23
    clt
    breq 1f
    set
1:  mov r19, r20
    sbrs r18, 7
    rjmp 2f
    ; From the last bit to the first.
    add r19, r22
    dec r19
    mov r24, r19
    lsr r24
    lsr r24
    lsr r24
    add r26, r24
    adc r27, r1
    andi r19, 7
2:  rcall bit_mask
3:  ld r24, X
    mov r25, r24
    or r24, r23
    brts 4f
    eor r24, r23
4:  st X, r24
    clt
    and r25, r23
    breq 5f
    set
5:  dec r22
    breq 7f
    sbrc r18, 7
    rjmp 6f
    lsl r23
    brcc 3b
    rol r23
    adiw r26, 1
    rjmp 3b
6:  lsr r23
    brcc 3b
    ror r23
    sbiw r26, 1
    rjmp 3b
7:  lds r24, RESULT_BITS
    bld r24, OVERFLOW
    sts RESULT_BITS, r24
    set
    rjmp all_done
