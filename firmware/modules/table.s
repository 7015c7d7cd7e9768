; Module 4: tables, FILL and copies of blocks. They do what plc-vm does
; (plc/vm/src/modules/table.rs).

.include "interface.inc"

OPERANDS
STUB read_byte, READ + 1
STUB read_word, READ + 2
STUB target_word, WRITE + 2
STUB words, ROOM + 2
STUB target_words, WRITE + ROOM + 2
STUB abandon, ABANDON

.equ ENTRIES_MAX, 100
; Routine 2 is LIFO, 1 FIFO.
.equ LIFO_BIT, 1
.equ FIRST_BLOCK, 5

; A table: its length, its number of entries, the entries, all words. Means: plc-vm modules/table.rs
; table_at.
; in: X address, Z room
; out: r20 length, r21 number of entries, X the first, carry: it is not complete
; destroys: r24, r25, Z
check_table:
    sbiw r30, 4
    brcs 1f
    ld r24, X+
    ld r25, X+
    mov r20, r25
    rcall check_room
    brcs 1f
    ld r24, X+
    ld r21, X+
    cp r20, r21
    cpc r1, r24
1:  ret

; in: r24, r25 a word, its high byte in r24, Z room in bytes
; out: carry: it is no number of entries, or they have no room   destroys: r25
check_room:
    tst r24
    brne 1f
    cpi r25, ENTRIES_MAX + 1
    brsh 1f
    lsl r25
    cp r30, r25
    cpc r31, r1
    ret
1:  sec
    ret

; A bit of SMB1 that tells that nothing can be done. Keeps the carry.
; in: r25 the bit, carry: it becomes 0, otherwise 1 and ENO 0   out: the carry as it was
; destroys: r24
status:
    lds r24, RESULT_BITS
    or r24, r25
    brcs 1f
    sts ENO, r1
    rjmp 2f
1:  eor r24, r25
2:  sts RESULT_BITS, r24
    ret

; in: X the first entry, r25 number of an entry   out: Z that entry   destroys: r25
at_entry:
    movw r30, r26
    lsl r25
    add r30, r25
    adc r31, r1
    ret

; Appends to a table. Means: plc-vm modules/table.rs add_to_table.
; in: DATA, TBL   ends: with DATA in TBL, or SM1.4
Att:
    rcall read_word
    movw r18, r22
    rcall target_words
    movw r22, r18
    rcall check_table
    brcs bad
    cp r21, r20
    ldi r25, 1 << TABLE_FULL
    rcall status
    brcc done
    mov r25, r21
    rcall at_entry
    st Z+, r23
    st Z, r22
    inc r21
    st -X, r21
; in: -   ends: with nothing more
done:
    DONE

; in: -   ends: abandons the instruction
bad:
    rjmp abandon

; Takes the first, the last entry out of a table. Means: plc-vm modules/table.rs take_from_table.
; in: TBL, DATA   ends: DATA := the entry, or SM1.5
Fifo:
Lifo:
    mov r19, r26
    rcall target_words
    rcall check_table
    brcs bad
    ; X at the first entry, r22 and r23 at DATA.
    movw r22, r26
    rcall target_word
    movw r24, r26
    movw r26, r22
    movw r22, r24
    cp r1, r21
    ldi r25, 1 << TABLE_EMPTY
    rcall status
    brcc done
    ; LIFO takes the last one, FIFO number 0.
    dec r21
    mov r25, r21
    sbrs r19, LIFO_BIT
    clr r25
    rcall at_entry
    ld r25, Z+
    ld r24, Z+
    sbiw r26, 1
    st X+, r21
    sbrc r19, LIFO_BIT
    rjmp 2f
    ; The others move up.
    lsl r21
    breq 2f
1:  ld r20, Z+
    st X+, r20
    dec r21
    brne 1b
2:  movw r30, r22
    st Z+, r25
    st Z, r24
    rjmp done

; Looks in a table, which begins with its number of entries here. Means: plc-vm modules/table.rs
; find.
; in: relation, TBL, PTN, INDX
; ends: INDX := the first entry from INDX on with the relation to PTN, or their number
Fnd:
    movw r30, r28
    adiw r28, 1
    lpm r19, Z
    rcall words
    ld r24, X+
    ld r25, X+
    mov r20, r25
    sbiw r30, 2
    rcall check_room
    brcs bad
    ; X waits in r18 and r21, as r20 is the number of entries.
    mov r18, r26
    mov r21, r27
    rcall read_word
    rcall target_word
    ld r25, X+
    ld r24, X
    cp r20, r24
    cpc r1, r25
    brcs bad
    ; In r19 the bit of the relation.
    mov r0, r19
    ldi r19, 1
1:  dec r0
    brmi 2f
    lsl r19
    rjmp 1b
2:  mov r30, r18
    mov r31, r21
    mov r25, r24
    lsl r25
    add r30, r25
    adc r31, r1
3:  cp r24, r20
    brsh 5f
    ld r0, Z+
    ld r25, Z+
    ; A bit for each relation that holds, in their order.
    ldi r18, EQUAL_HOLD
    cp r25, r22
    cpc r0, r23
    breq 4f
    ldi r18, LESS_HOLD
    brlt 4f
    ldi r18, GREATER_HOLD
4:  and r18, r19
    brne 5f
    inc r24
    rjmp 3b
5:  st X, r24
    st -X, r1
    rjmp done

; Fills words. Means: plc-vm modules/table.rs fill.
; in: IN, OUT, N   ends: with N words from OUT on as IN
Fill:
    ; N first: it is what IN and OUT must have room for.
    adiw r28, 4
    rcall read_byte
    mov r20, r22
    sbiw r28, 6
    rcall read_word
    rcall target_words
    ldi r25, 0
    mov r24, r20
    lsl r24
    rol r25
    cp r30, r24
    cpc r31, r25
    brcs far_bad
1:  subi r20, 1
    brcs far_done
    st X+, r23
    st X+, r22
    rjmp 1b

; Copies bytes, words, double words. Means: plc-vm modules/table.rs copy_block.
; in: IN, OUT, N   ends: with N values from OUT on as those from IN on
Bmb:
Bmw:
Bmd:
    ; Bytes of a value.
    subi r26, FIRST_BLOCK
    lsl r26
    brne 1f
    inc r26
1:  mov r19, r26
    adiw r28, 4
    rcall read_byte
    sbiw r28, 6
    ; The length in r24 and r25.
    mov r24, r22
    clr r25
    mov r18, r19
2:  lsr r18
    breq 3f
    lsl r24
    rol r25
    rjmp 2b
3:  mov r26, r19
    ori r26, ROOM
    rcall operands
    cp r30, r24
    cpc r31, r25
    brcs far_bad
    movw r22, r26
    mov r26, r19
    ori r26, WRITE + ROOM
    rcall operands
    cp r30, r24
    cpc r31, r25
    brcs far_bad
    sbiw r24, 0
    breq far_done
    ; As if all was read before the first is written.
    movw r30, r22
    cp r30, r26
    cpc r31, r27
    brlo 5f
4:  ld r0, Z+
    st X+, r0
    sbiw r24, 1
    brne 4b
; in: -   ends: with nothing more
far_done:
    DONE
5:  add r30, r24
    adc r31, r25
    add r26, r24
    adc r27, r25
6:  ld r0, -Z
    st -X, r0
    sbiw r24, 1
    brne 6b
    rjmp far_done

; in: -   ends: abandons the instruction
far_bad:
    rjmp abandon
