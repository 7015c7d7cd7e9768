; Module 3: strings. They do what plc-vm does (plc/vm/src/modules/text.rs).

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB target_byte, WRITE + 1
STUB bytes_in, ROOM + 1
STUB bytes_to, WRITE + ROOM + 1
STUB compared_in, COMPARE + ROOM + 1
STUB abandon, ABANDON

.equ CHARACTERS_MAX, 254
; The number of the first comparison.
.equ FIRST_COMPARISON, 6

; ---- strings

.include "strings.inc"

; Copies characters as if all were read before the first is written.
; in: r18 how many, r21:r20 from, X to   out: -   destroys: r0, r25, X, Z
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
    ; Backwards. Flash is above all of data memory, so that this never reads there.
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

; Compares characters of two strings.
; in: r25 how many, r21:r20, r23:r22 characters
; out: zero flag: they are the same; otherwise r26 and r0 differ, and carry: r26 is less
; destroys: r20-r23, r25, Z
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

; The length of a string. Means: plc-vm modules/text.rs text.
; in: IN, OUT   ends: OUT := length
Slen:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall target_byte
    st X, r18
; in: -   ends: with nothing more
done:
    DONE

; Copies a part of a string. Means: plc-vm modules/text.rs text.
; in: IN, INDX, N, OUT   ends: OUT := N characters of IN from INDX on
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

; Copies a string. Means: plc-vm modules/text.rs text.
; in: IN, OUT   ends: OUT := IN
Scpy:
    rcall bytes_in
    rcall begin_first
    brcs bad
; in: r18 length, r21:r20 characters, OUT   ends: OUT := them
write:
    rcall bytes_to
    clr r19
    rjmp append

; Appends a string to another one. Means: plc-vm modules/text.rs text.
; in: IN, OUT   ends: OUT := OUT and IN
Scat:
    rcall bytes_in
    rcall begin_first
    brcs bad
    rcall bytes_to
    ld r19, X
; Writes a string after the characters that OUT keeps.
; in: r18 length, r21:r20 characters, X OUT, Z its room, r19 how many characters it keeps
; ends: OUT := these and those
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

; in: -   ends: abandons the instruction
bad:
    rjmp abandon

; Looks for a string in another one. Means: plc-vm modules/text.rs find_text.
; in: IN1, IN2, OUT   ends: OUT := the first position from OUT on, or 0
Sfnd:
    clt
; Looks for the first character that is one of a set. From the common part on T says that it is
; CFND. Means: plc-vm modules/text.rs find_text.
; in: IN1, IN2, OUT   ends: OUT := its position from OUT on, or 0
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
    ; at_position takes it in r22, which is the low byte of the sought.
    mov r25, r22
    mov r22, r24
    rcall at_position
    mov r22, r25
    brcs 6f
1:  brts 3f
    ; Where the sought does not fit, it fits nowhere after either.
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

; Compares strings, and loads the result or combines it: of the characters, then of the lengths.
; Means: plc-vm modules/compare.rs compare_texts.
; in: relation, IN1, IN2   ends: as RELATE
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
