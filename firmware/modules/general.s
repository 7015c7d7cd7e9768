; Module 0: bytes, words and double words with any operand: moves, arithmetic, logic, shifts,
; conversions, comparisons, ranges of bits. They do what plc-vm does (plc/vm/src/modules).
;
; Most routines share one way: IN1 and OUT are brought to 32 bits with their sign, and what becomes
; of them is written in the width of OUT. Routines that do the same in three widths have numbers in
; a row.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB abandon, ABANDON

; Reads IN.
; in: r20 its length, 1, 2 or 4   out: r25:r22 the value, Y after the operand   destroys: r0, X, Z
read_in:
    mov r26, r20
    ori r26, READ
    rjmp operands

; Finds OUT.
; in: r19 its length, 1, 2 or 4   out: X its address, Y after the operand   destroys: r0, r22-r25, Z
target_out:
    mov r26, r19
    ori r26, WRITE
    rjmp operands

; ---- subroutines

; Of a routine's number in its group: which operation it is, and its width.
; in: r26 number   out: r18 number / 3, r26 the remainder   destroys: -
divide_by_3:
    ldi r18, -1
1:  inc r18
    subi r26, 3
    brcc 1b
    subi r26, -3
    ret

; The width that a routine's number stands for.
; in: r26 0 byte, 1 word, 2 double word   out: r19 and r26 the length, 1, 2 or 4   destroys: -
width:
    lsl r26
    brne 1f
    inc r26
1:  mov r19, r26
    ret

; Reads a value with its sign. Means: plc-vm references.rs get.
; in: X address, r31 length   out: r25:r22 value, X after it   destroys: -
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

; Writes a value. Means: plc-vm references.rs put.
; in: X address, r31 length, r25:r22 value   out: X the address again   destroys: -
store_at:
    add r26, r31
    adc r27, r1
; Writes a value before an address: backwards, because the lowest byte, which all have, is the last.
; in: X the address after it, r31 length, r25:r22 value   out: X its first byte   destroys: -
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

; Whether a value can be written in a length. Means: plc-vm references.rs holds.
; in: r25:r22 value, r31 length   out: zero flag: it fits   destroys: r0
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

; Whether as much of a value as is written is 0.
; in: r25:r22 value, r31 length   out: zero flag: it is   destroys: r0
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

; in: r25:r22 a number   out: r25:r22 with the other sign   destroys: -
negate:
    NEGATE r25, r24, r23, r22
    ret

; ---- moves and conversions: lengths of IN in r20, of OUT in r19

; Copies a double word or a real. Means: plc-vm modules/mod.rs move_.
; in: IN, OUT   ends: OUT := IN
Movd:
Movr:
    ldi r20, 4
    rjmp 1f

; A word with its sign. Means: plc-vm modules/convert.rs map.
; in: IN, OUT   ends: OUT := IN
Itd:
    ldi r20, 2
1:  ldi r19, 4
    rjmp convert

; A double word that fits a word. Means: plc-vm modules/convert.rs narrow.
; in: IN, OUT   ends: OUT := IN, or SM1.1
Dti:
    ldi r20, 4
    rjmp 1f

; A byte without a sign. Means: plc-vm modules/convert.rs map.
; in: IN, OUT   ends: OUT := IN
Bti:
    ldi r20, 1
    rjmp 1f

; Copies a word. Means: plc-vm modules/mod.rs move_.
; in: IN, OUT   ends: OUT := IN
MovwAny:
    ldi r20, 2
1:  ldi r19, 2
    rjmp convert

; A word that fits a byte. Means: plc-vm modules/convert.rs narrow.
; in: IN, OUT   ends: OUT := IN, or SM1.1
Itb:
    ldi r20, 2
    rjmp 1f

; Copies a byte. Means: plc-vm modules/mod.rs move_.
; in: IN, OUT   ends: OUT := IN
MovbAny:
    ldi r20, 1
1:  ldi r19, 1
; Copies between lengths; where OUT is the shorter one, what does not fit is an overflow.
; in: r20 length of IN, r19 of OUT   ends: OUT := IN, or SM1.1
convert:
    rcall read_in
    rcall target_out
    mov r31, r19
    cp r19, r20
    brsh write
    rcall fits
    ldi r20, 1 << OVERFLOW
; Ends with a value, if there is one. Means: plc-vm modules/convert.rs put_if.
; in: zero flag: there is one, r25:r22 it, X address, r31 length, r20 bit of SMB1 for none
; ends: with the value, the bit 0; or with the bit 1, ENO 0
write_if:
    ldi r18, 0
    breq 1f
    sts ENO, r1
    mov r18, r20
    rjmp status
1:  rcall store_at
    rjmp status

; The segments of a hexadecimal digit: bit 0 is a, bit 6 is g. Means: plc-vm modules/convert.rs
; convert.
; in: IN, OUT   ends: OUT := segments
Seg:
    ldi r20, 1
    ldi r19, 1
    rcall read_in
    rcall target_out
    rcall 1f
    .byte 0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07
    .byte 0x7F, 0x67, 0x77, 0x7C, 0x39, 0x5E, 0x79, 0x71
1:  BYTES_AFTER_CALL
    andi r22, 0x0F
    add r30, r22
    adc r31, r1
    lpm r22, Z
    ldi r31, 1
    rjmp write

; The word with the bit whose number is in IN. Means: plc-vm modules/convert.rs convert.
; in: IN, OUT   ends: OUT := word
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

; The number of the lowest bit that is 1, and 0 for none. Means: plc-vm modules/convert.rs convert.
; in: IN, OUT   ends: OUT := number
Enco:
    ldi r20, 2
    ldi r19, 1
    rcall read_in
    rcall target_out
    mov r31, r19
    ; After the 16 bits is one more, for 0.
    ldi r18, -1
    sec
1:  inc r18
    ror r23
    ror r22
    brcc 1b
    andi r18, 0x0F
    mov r22, r18
; Ends with a value.
; in: r25:r22 value, X address, r31 length   ends: with it written
write:
    rcall store_at
    rjmp done

; Exchanges the bytes of a word. Means: plc-vm modules/mod.rs move_.
; in: OUT   ends: OUT exchanged
Swap:
    ldi r19, 2
    rcall target_out
    ld r24, X+
    ld r25, X
    st X, r24
    st -X, r25
; in: -   ends: with nothing more
done:
    DONE

; ---- BCD, in place

; A number of four BCD digits in place. Means: plc-vm modules/convert.rs of_bcd.
; in: OUT   ends: OUT := number, or SM1.6
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
    ; Times ten: twice, and four times that.
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

; The four BCD digits of a number in place. Means: plc-vm modules/convert.rs to_bcd.
; in: OUT   ends: OUT := digits, or SM1.6
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
; in: r23:r22 result, X address, r31 length 2   ends: OUT := result, SM1.6 := 0
is_bcd:
    sez
    rjmp 1f

; in: -   ends: SM1.6 := 1, ENO := 0
no_bcd:
    clz
1:  ldi r20, 1 << NO_BCD
    rjmp write_if

; Reads the word of BCDI and IBCD.
; in: X its address, r19 length 2
; out: r25:r24 the word, r23:r22 0, r31 length, X the address again   destroys: -
begin_bcd:
    mov r31, r19
    ld r25, X+
    ld r24, X
    sbiw r26, 1
    clr r22
    clr r23
    ret

; Takes a decimal digit out of a number, by subtraction.
; in: r23:r22 number, r21:r20 what the digit counts, r25:r24 digits before it
; out: r25:r24 with the digit, r23:r22 the rest   destroys: r18
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

; in: r25:r24   out: r25:r24 a hexadecimal digit to the left   destroys: r18
shift_digit:
    ldi r18, 4
1:  lsl r24
    rol r25
    dec r18
    brne 1b
    ret

.include "arithmetic.inc"
.include "bits.inc"
