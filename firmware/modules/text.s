; Module 3: strings, and numbers as characters. They do what plc-vm does (plc/vm/src/modules: text.rs, ascii.rs, numeral.rs).
;
; Strings stand in data memory or, as constants, in flash: one subroutine reads both. Numbers of 64 bits stand on the
; hardware stack, the most significant byte first.

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB target_byte, WRITE + 1
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB compared_in, COMPARE + ROOM + 1
STUB abandon, ABANDON

.equ CHARACTERS_MAX, 254
; Numbers of routines.
.equ FIRST_COMPARISON, 6
.equ FIRST_NUMBER, 11
.equ FIRST_TEXT, 14
.equ DECIMALS_MAX, 5
; What ITA, DTA, RTA count from 0.
.equ REAL, 2
; The exponent of a real whose mantissa is a number of units.
.equ EXPONENT_OF_UNITS, 150

; ---- strings

; The next byte at Z, in memory or in flash (0x6000 and above), in r0.
fetch:
    sbrc r31, 6
    rjmp 1f
    ld r0, Z+
    ret
1:  lpm r0, Z+
    ret

; The string at X with room Z: its length in r0, X at its characters. Carry: it is too long, or leaves its room.
begin:
    movw r24, r30
    movw r30, r26
    rcall fetch
    movw r26, r30
    inc r0
    breq set_carry
    cp r24, r0
    cpc r25, r1
    dec r0
    ret
; The same for the first one: length in r18, characters at r20 and r21.
begin_first:
    rcall begin
    mov r18, r0
    movw r20, r26
    ret
; For a second one: length in r19, characters at r22 and r23.
begin_second:
    rcall begin
    mov r19, r0
    movw r22, r26
    ret

; The first string without what stands before position r22. Carry: there is no such position.
at_position:
    subi r22, 1
    brcs 1f
    cp r22, r18
    brcc set_carry
    add r20, r22
    adc r21, r1
    sub r18, r22
1:  ret
set_carry:
    sec
    ret

; r18 bytes from r20 and r21 to X, as if all were read before the first is written.
move:
    mov r25, r18
    movw r30, r20
    cp r30, r26
    cpc r31, r27
    brlo 2f
1:  subi r25, 1
    brcs 4f
    rcall fetch
    st X+, r0
    rjmp 1b
2:  add r30, r25
    adc r31, r1
    add r26, r25
    adc r27, r1
3:  subi r25, 1
    brcs 4f
    ld r0, -Z
    st -X, r0
    rjmp 3b
4:  ret

; Compares r25 characters of two strings. Z: they are the same; otherwise those in r26 and r0 differ.
compare:
    subi r25, 1
    brcs 1f
    movw r30, r20
    rcall fetch
    movw r20, r30
    mov r26, r0
    movw r30, r22
    rcall fetch
    movw r22, r30
    cp r26, r0
    breq compare
    ret
1:  sez
    ret

Slen:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall target_byte
    st X, r18
done:
    DONE

Sscpy:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall read_byte
    rcall at_position
    brcs bad
    rcall read_byte
    cp r18, r22
    brcs bad
    mov r18, r22
    rjmp write

Scpy:
    rcall bytes_in
    rcall begin_first
    brcs bad
write:
    rcall bytes_to
    clr r19
    rjmp append

Scat:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall bytes_to
    ld r19, X
; The first string behind the r19 characters at X.
append:
    movw r22, r26
    adiw r26, 1
    add r26, r19
    adc r27, r1
    add r19, r18
    brcs bad
    cpi r19, CHARACTERS_MAX + 1
    brsh bad
    cp r19, r30
    cpc r1, r31
    brcc bad
    rcall move
    movw r26, r22
    st X, r19
    rjmp done
bad:
    rjmp abandon

; T: CFND.
Sfnd:
    clt
Cfnd:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall bytes_in
    rcall begin_second
    brcs bad
    rcall target_byte
    ld r24, X
    tst r24
    breq bad
    push r26
    push r27
    mov r25, r22
    mov r22, r24
    rcall at_position
    mov r22, r25
    brcs 6f
1:  brts 3f
    ; Where the sought does not fit, it fits nowhere behind either.
    tst r19
    breq 6f
    cp r18, r19
    brcs 6f
    push r20
    push r21
    push r22
    push r23
    mov r25, r19
    rcall compare
    pop r23
    pop r22
    pop r21
    pop r20
    brne 5f
2:  rjmp 7f
3:  movw r30, r20
    rcall fetch
    mov r26, r0
    movw r30, r22
    mov r25, r19
4:  subi r25, 1
    brcs 5f
    rcall fetch
    cp r0, r26
    breq 2b
    rjmp 4b
5:  subi r20, -1
    sbci r21, -1
    inc r24
    dec r18
    brne 1b
6:  clr r24
7:  pop r27
    pop r26
    st X, r24
    set
    rjmp done

LoadText:
AndText:
OrText:
    push r26
    adiw r28, 1
    rcall compared_in
    rcall begin_first
    brcs 3f
    rcall compared_in
    rcall begin_second
    brcs 3f
    mov r25, r18
    cp r19, r18
    brsh 1f
    mov r25, r19
1:  rcall compare
    brne 2f
    ; The longer one is greater.
    mov r26, r18
    mov r0, r19
2:  mov r18, r26
    clr r19
    clr r20
    clr r21
    mov r22, r0
    clr r23
    clr r24
    clr r25
    pop r26
    subi r26, FIRST_COMPARISON - RELATE
    rjmp operands
3:  ldi r24, FAULT_POINTER
    jmp MODULE_FAULT

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

.include "numerals.inc"
