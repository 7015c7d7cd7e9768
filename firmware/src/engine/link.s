; Answers on the line: what plc-link does, in a third of the flash that a compiler takes for it. Names, order of checks and
; bytes are those of plc-link and of docs/protocol.md; a test compares the two.
;
; While a request is answered Y is the frame, r17 the request's length, r16 its function, r15 and r14 what references may
; name, r13 and r12 the stack pointer of whoever refuses, r10 when the answer was begun. r26 and r27 are X, r30 and r31 are Z.

; What LINE holds.
.equ FRAME, LINE + 0
.equ ROOM, LINE + 2
.equ TRACE_STATE, LINE + 3
.equ LEFT, LINE + 4
.equ AT, LINE + 5
.equ COMMAND, LINE + 6
.equ SCANS_WANTED, LINE + 7
.equ V_TABLE, LINE + 9
.equ TIMERS_TABLE, LINE + 11
.equ NAME_AT, LINE + 21
.equ NAME_LEN, LINE + 23
; From here on in the order of the answer to 65: state, fault, fault before the last reset, shortest, last and longest
; scan, scans, free stack, length of the image.
.equ STATE, LINE + 26
.equ SCAN_TIMES, LINE + 35
.equ SCANS, LINE + 47
.equ FORCES, LINE + 55
.equ FORCED, LINE + 56
.equ RING, LINE + 201
.equ RING_END, LINE + 203

; How far the work on a request has come.
.equ PHASE, LINE + 205
.equ NEW, 0
.equ GOES_ON, 1
.equ ARMED, 2
.equ READY, 4

.equ STACK_POINTER_LOW, 0x3D
.equ STACK_POINTER_HIGH, 0x3E
.equ SREG, 0x3F
.equ TCNT0, 0x26
; Timer counts of 4 us since an answer was begun after which another scan goes on with it.
.equ PARTS_COUNTS, 22
.equ PART_COUNTS, 5

; An entry of the forces: place (low byte first), reference, value.
.equ FORCE_LEN, 9
.equ FORCES_MAX, 16
.equ SM4, 0x0144

; What references may name: plc-link's ANYTHING, FORCED and WRITABLE.
.equ ANYTHING, 0xFFFF
.equ FORCEABLE, 0x2307
.equ WRITABLE, 0x2976

.macro ALLOW mask
    ldi r24, lo8(\mask)
    ldi r25, hi8(\mask)
    movw r14, r24
.endm

    .section .text.line, "ax", @progbits

; Answers the request of r24 bytes. Returns the length of the answer in r24; 0: not yet.
    .global line_answer
line_answer:
    push r10
    push r11
    push r12
    push r13
    push r14
    push r15
    push r16
    push r17
    push r28
    push r29
    in r12, STACK_POINTER_LOW
    in r13, STACK_POINTER_HIGH
    in r10, TCNT0
    mov r17, r24
    lds r28, FRAME
    lds r29, FRAME + 1
    ld r16, Y
    lds r24, ROOM
    cp r24, r17
    brlo refuse_value
    cpi r16, 43
    breq device
    mov r24, r16
    subi r24, 65
    cpi r24, 8
    brlo service
    cpi r16, 0
    breq refuse_function
    cpi r16, 7
    brlo 1f
    cpi r16, 15
    breq 1f
    cpi r16, 16
    breq 1f
    cpi r16, 23
    brne refuse_function
1:  rjmp modbus
device:
    rjmp identification
service:
    ldi r30, pm_lo8(services)
    ldi r31, pm_hi8(services)
    add r30, r24
    adc r31, r1
    ijmp
services:
    rjmp identify
    rjmp control
    rjmp watch
    rjmp force
    rjmp status
    rjmp trace
    rjmp read_block
    rjmp set

; Ends of an answer. Those that refuse can be gone to from subroutines.
refuse_function:
    ldi r24, 1
    rjmp refuse
refuse_busy:
    ldi r24, 4
    rjmp refuse
refuse_address:
    ldi r24, 2
    rjmp refuse
refuse_value:
    ldi r24, 3
refuse:
    in r0, SREG
    cli
    out STACK_POINTER_HIGH, r13
    out SREG, r0
    out STACK_POINTER_LOW, r12
    lds r28, FRAME
    lds r29, FRAME + 1
    std Y+1, r24
    ori r16, 0x80
    st Y, r16
    ldi r24, 2
    rjmp done
; The answer ends before Z.
done_at_z:
    mov r24, r30
    lds r25, FRAME
    sub r24, r25
done:
    sts PHASE, r1
    rjmp line_leave
not_yet:
    ldi r24, 0
line_leave:
    pop r29
    pop r28
    pop r17
    pop r16
    pop r15
    pop r14
    pop r13
    pop r12
    pop r11
    pop r10
    ret

; Refuses a request that has not r24 bytes.
expect_len:
    cp r17, r24
    brne refuse_value
    ret

; Y+1 is a number of entries, 1 to r24, in r20; r25 bytes each and the two before them are the request. Begins with them or
; goes on.
expect_entries:
    ldd r20, Y+1
    cp r24, r20
    brlo refuse_value
    cp r20, r1
    breq refuse_value
    ret
expect_list:
    rcall expect_entries
    mul r20, r25
    mov r24, r0
    clr r1
    subi r24, -2
    rcall expect_len
begin:
    lds r24, PHASE
    cpi r24, NEW
    brne 1f
    ldi r24, GOES_ON
    sts PHASE, r24
    sts LEFT, r20
    ldi r24, 2
    sts AT, r24
1:  ret

; The next part of an answer, if there is time for one; of r18 parts, the last one takes longer.
next_part:
    ldi r25, PART_COUNTS
    cpse r18, r1
    ldi r25, PARTS_COUNTS
    in r24, TCNT0
    sub r24, r10
    cp r24, r25
    brlo 1f
    pop r24
    pop r24
    rjmp not_yet
1:  ret

; ---- references

; The place that the reference at Z names in r24 and r25, its size in r20, its width in r21.
reference:
    ld r24, Z
    ldd r23, Z+1
    ldd r22, Z+2
    mov r20, r24
    andi r20, 0x0F
    swap r24
    andi r24, 0x0F
    mov r11, r24
    cpi r20, 11
    brsh bad_reference
    ldi r21, 1
    cpi r20, 9
    brlo 1f
    ldi r21, 2
    breq 1f
    ldi r21, 4
1:  sbrc r23, 7
    rjmp bad_reference
    cpi r24, 3
    brne 1f
    cpi r22, 32
    cpc r23, r1
    brlo paged
    ; Special memory behind the bit page.
    ori r23, 0x80
    rjmp in_v
1:  cpi r24, 8
    breq in_v
    brsh second_page
    cpi r24, 5
    breq numbered
    cpi r24, 6
    breq numbered
paged:
    tst r23
    brne bad_reference
    rcall page_start
    add r30, r22
    add r22, r21
    brcs bad_reference
    cp r25, r22
    brlo bad_reference
in_page:
    ldi r31, 1
    rjmp placed
bad_reference:
    rjmp refuse_address
second_page:
    cpi r24, 10
    brsh bad_reference
    tst r23
    brne bad_reference
    cpi r22, 52
    brsh bad_reference
    ldi r25, 9
    cpi r22, 12
    brlo 1f
    inc r11
    cpi r22, 24
    brlo 1f
    inc r11
    ldi r25, 10
    cpi r22, 40
    brlo 1f
    inc r11
    cpi r22, 48
    brlo 1f
    inc r11
    ldi r25, 9
1:  cp r20, r25
    brne bad_reference
    mov r24, r21
    dec r24
    and r24, r22
    brne bad_reference
    mov r30, r22
    ldi r31, 2
    rjmp placed
in_v:
    rcall v_address
    movw r30, r26
    rjmp placed
numbered:
    tst r23
    brne bad_reference
    cpi r20, 9
    breq 1f
    tst r20
    brne bad_reference
    rcall page_start
    mov r20, r22
    andi r20, 7
    lsr r22
    lsr r22
    lsr r22
    add r30, r22
    ldi r24, 14
    mov r11, r24
    rjmp in_page
1:  ldi r20, 5
    cpi r24, 5
    breq 1f
    ldi r20, 3
1:  rcall value_address
    movw r30, r26
    ldi r20, 9
placed:
    movw r18, r14
    rjmp 2f
1:  lsr r19
    ror r18
2:  dec r11
    brpl 1b
    sbrs r18, 0
    rjmp bad_reference
    movw r24, r30
    mov r18, r20
    swap r18
    or r25, r18
    ret

; Low byte of the address where area r24 of the bit page begins in r30, its bytes in r25.
page_start:
    mov r30, r24
    ldi r25, 16
    cpi r24, 2
    brlo 1f
    dec r30
    ldi r25, 32
1:  mul r30, r25
    mov r30, r0
    clr r1
    cpi r24, 7
    brne 1f
    ldi r25, 64
1:  ret

; Data address of r21 bytes of V memory from r22 and r23 on in X, if they lie in one range.
v_address:
    lds r24, V_TABLE
    lds r25, V_TABLE + 1
    lds r18, TIMERS_TABLE
    lds r19, TIMERS_TABLE + 1
    ; Ranges before r24 and r25 begin at the number or before, those from r18 and r19 on behind it.
1:  movw r30, r18
    sub r30, r24
    sbc r31, r25
    breq 3f
    lsr r31
    ror r30
    andi r30, 256 - V_RANGE_LEN
    add r30, r24
    adc r31, r25
    lpm r26, Z+
    lpm r27, Z+
    cp r22, r26
    cpc r23, r27
    brlo 2f
    adiw r30, V_RANGE_LEN - 2
    movw r24, r30
    rjmp 1b
2:  sbiw r30, 2
    movw r18, r30
    rjmp 1b
3:  lds r18, V_TABLE
    lds r19, V_TABLE + 1
    cp r24, r18
    cpc r25, r19
    breq bad_value_reference
    ; The range begins where the one before it ends.
    movw r30, r24
    sbiw r30, V_RANGE_LEN + 2
    lpm r26, Z+
    lpm r27, Z+
    cp r30, r18
    cpc r31, r19
    brne 4f
    ldi r26, 0
    ldi r27, 0
4:  lpm r24, Z+
    lpm r25, Z+
    movw r18, r22
    sub r18, r24
    sbc r19, r25
    lpm r24, Z+
    lpm r25, Z
    add r18, r26
    adc r19, r27
    movw r26, r18
    sub r24, r18
    sbc r25, r19
    brcs bad_value_reference
    cp r24, r21
    cpc r25, r1
    brlo bad_value_reference
    subi r26, lo8(-(ARENA_START))
    sbci r27, hi8(-(ARENA_START))
    ret
bad_value_reference:
    rjmp refuse_address

; Data address of the current value of timer r22 (r20 is 5, the bytes of its slot) or counter (3) in X.
value_address:
    ldi r30, lo8(TIMERS_TABLE)
    ldi r31, hi8(TIMERS_TABLE)
    sbrs r20, 2
    adiw r30, 2
    ld r24, Z
    ldd r25, Z+1
    ldd r18, Z+2
    ldd r19, Z+3
    ldd r26, Z+6
    ldd r27, Z+7
    push r24
    push r25
    ; Entries before r24 and r25 are of lower numbers, those from r18 and r19 on of higher ones.
1:  movw r30, r18
    sub r30, r24
    sbc r31, r25
    breq bad_value_reference
    lsr r31
    ror r30
    sbrc r20, 2
    andi r30, 0xFE
    add r30, r24
    adc r31, r25
    lpm r23, Z
    cp r22, r23
    breq 3f
    brlo 2f
    adiw r30, 1
    sbrc r20, 2
    adiw r30, 1
    movw r24, r30
    rjmp 1b
2:  movw r18, r30
    rjmp 1b
3:  ; As many entries are before it.
    pop r19
    pop r18
    sub r30, r18
    sbc r31, r19
    sbrs r20, 2
    rjmp 4f
    lsr r31
    ror r30
4:  mul r30, r20
    add r26, r0
    adc r27, r1
    clr r1
    ret

; ---- Modbus: functions 1 to 6, 15, 16 and 23

; T: it is about bits. r15: bytes to read. r14: what is looked for is to be written. r11: where the values to write are.
modbus:
    set
    cpi r16, 3
    brlo 1f
    cpi r16, 5
    breq 1f
    cpi r16, 15
    breq 1f
    clt
1:  lds r24, PHASE
    cpi r24, NEW
    brne 4f
    rcall said_of_written
    ldi r25, 3
    ldi r24, 5
    cpi r16, 7
    brlo 2f
    rcall byte_count
    ldd r18, Z+5
    cp r18, r24
    brne wrong_value
    ldi r25, 6
    cpi r16, 23
    brne 1f
    ldi r25, 10
1:  add r24, r25
    brcc 3f
wrong_value:
    rjmp refuse_value
2:  cpi r16, 5
    brne 3f
    tst r22
    brne wrong_value
    inc r23
    cpi r23, 2
    brsh wrong_value
3:  mov r11, r25
    rcall expect_len
    cpi r16, 23
    breq 4f
    cpi r16, 5
    brsh 5f
4:  ldd r22, Y+4
    ldd r23, Y+3
    rcall byte_count
    mov r15, r24
    subi r24, -2
    lds r25, ROOM
    cp r25, r24
    brlo wrong_value
    cpi r16, 23
    brne read
    lds r24, PHASE
    cpi r24, NEW
    brne read
    ; Both are looked for before anything is written.
    rcall find_read
5:  rcall find_written
    movw r30, r26
    movw r26, r28
    add r26, r11
    adc r27, r1
    brtc 1f
    rcall line_write_bits
    rjmp 2f
1:  mov r21, r20
    ldi r20, 2
    rcall copy_words
2:  ldi r24, 5
    cpi r16, 23
    brne 3f
    ; It is read when there is time again.
    sts PHASE, r24
    rjmp not_yet
read:
    rcall find_read
    movw r30, r28
    adiw r30, 2
    brtc 1f
    rcall read_bits
    rjmp 2f
1:  ldi r21, 2
    cpi r16, 4
    brne 1f
    set
1:  rcall copy_words
2:  std Y+1, r15
    mov r24, r15
    subi r24, -2
3:  rjmp done

; Bytes that r22 and r23 bits or registers take in r24.
byte_count:
    movw r24, r22
    sbiw r24, 1
    brts 1f
    ; 125 registers at most.
    cpi r24, 125
    cpc r25, r1
    brsh too_long
    mov r24, r22
    lsl r24
    ret
1:  ; 2000 bits at most.
    ldi r18, hi8(2000)
    cpi r24, lo8(2000)
    cpc r25, r18
    brsh too_long
    adiw r24, 8
    lsr r25
    ror r24
    lsr r25
    ror r24
    lsr r25
    ror r24
    ret

too_long:
    rjmp refuse_value

; Y+1 and on, or further behind it, says what is to be written: Z at the byte before, its number in r22 and r23.
said_of_written:
    movw r30, r28
    cpi r16, 23
    brne 1f
    adiw r30, 4
1:  ldd r22, Z+4
    ldd r23, Z+3
    ret

; Data address of the first bit or register in X; the bit's place in its byte, or the bytes from one register to the next,
; in r20; their number in r22 and r23.
find_written:
    rcall said_of_written
    mov r14, r16
    cpi r16, 7
    brsh 1f
    ldi r22, 1
    ldi r23, 0
    rjmp 1f
find_read:
    clr r14
    movw r30, r28
    ldd r22, Z+4
    ldd r23, Z+3
1:  ldd r24, Z+2
    ldd r25, Z+1
    brtc registers
    ldi r21, 0
1:  inc r21
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcc 1b
    subi r24, lo8(-(1000))
    sbci r25, hi8(-(1000))
    ; The areas are I, Q, M, SM, S, T, C; I is in block 6, and for function 2 in block 0, too.
    cpi r21, 7
    breq 1f
    brsh no_address
    cpi r16, 2
    brne 2f
    cpi r21, 1
    brne 2f
1:  ldi r21, 0
2:  movw r18, r24
    add r18, r22
    adc r19, r23
    ldi r20, 129
    cpi r21, 2
    brlo 1f
    ldi r20, 1
    dec r19
    brmi 2f
1:  cp r18, r20
    cpc r19, r1
    brsh no_address
2:  tst r14
    breq 1f
    cpi r21, 1
    breq 1f
    cpi r21, 2
    breq 1f
    cpi r21, 4
    brne no_address
1:  mov r20, r24
    mov r24, r21
    rcall page_start
    mov r24, r20
    lsr r24
    lsr r24
    lsr r24
    add r30, r24
    mov r26, r30
    ldi r27, 1
    andi r20, 7
    ret

no_address:
    rjmp refuse_address

registers:
    ; Values of timers and counters do not lie side by side.
    movw r30, r24
    subi r30, lo8(6000)
    sbci r31, hi8(6000)
    ldi r18, hi8(2000)
    cpi r30, lo8(2000)
    cpc r31, r18
    brsh 1f
    cpi r22, 33
    brsh too_many
1:  push r22
    push r24
    push r25
    rcall register
    pop r25
    pop r24
    pop r22
    push r22
    push r26
    push r27
    dec r22
    add r24, r22
    adc r25, r1
    rcall register
    pop r31
    pop r30
    pop r22
    mov r24, r22
    dec r24
    mul r24, r20
    movw r18, r0
    clr r1
    add r18, r30
    adc r19, r31
    cp r18, r26
    cpc r19, r27
    brne no_address
    ; HC0 and HC3 are not written.
    tst r14
    breq 1f
    ldi r18, hi8(HC0)
    cpi r26, lo8(HC0)
    cpc r27, r18
    brlo 1f
    cpi r30, lo8(AQW_START)
    cpc r31, r18
    brlo no_address
1:  movw r26, r30
    ldi r23, 0
    ret
too_many:
    rjmp refuse_value

; Data address of the register of this number, r24 and r25, in X; bytes from it to the next in r20.
register:
    ldi r20, 2
    cpi r16, 4
    brne 1f
    cpi r24, 32
    cpc r25, r1
    brsh no_register
    lsl r24
    subi r24, lo8(-(AIW_START))
    rjmp 5f
1:  cpi r25, hi8(5120)
    brsh 2f
    lsl r24
    rol r25
    movw r22, r24
    ldi r21, 2
    rjmp v_address
2:  subi r24, lo8(6000)
    sbci r25, hi8(6000)
    brcs no_register
    ldi r20, 5
    cp r25, r1
    breq 3f
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcs no_register
    ldi r20, 3
    cp r25, r1
    breq 3f
    subi r24, lo8(1000)
    sbci r25, hi8(1000)
    brcs no_register
    cpi r24, 14
    cpc r25, r1
    brsh no_register
    ldi r20, 2
    lsl r24
    subi r24, lo8(-(AC_START))
5:  ldi r25, hi8(AIW_START)
    movw r26, r24
    ret
3:  mov r22, r24
    rjmp value_address
no_register:
    rjmp refuse_address

; Copies r22 words from X, r20 bytes apart, to Z, r21 bytes apart. T: from analog inputs, of which there are six.
copy_words:
    brts 2f
    cpse r20, r21
    rjmp 2f
    ; Many can lie side by side.
1:  ld r24, X+
    ld r25, X+
    st Z+, r24
    st Z+, r25
    dec r22
    brne 1b
    ret
2:  dec r20
    dec r21
3:  ld r24, X+
    ld r25, X
    brtc 4f
    cpi r26, lo8(AIN_START)
    brlo 4f
    ldi r24, 0
    ldi r25, 0
4:  st Z+, r24
    st Z, r25
    add r26, r20
    adc r27, r1
    add r30, r21
    adc r31, r1
    dec r22
    brne 3b
    ret

; Copies r22 and r23 bits from X, the first of them at r20 in its byte, to bytes at Z. The rest of the last one is 0.
read_bits:
    ld r24, X+
1:  ld r25, X+
    movw r18, r24
    mov r0, r20
    rjmp 3f
2:  lsr r19
    ror r18
3:  dec r0
    brpl 2b
    rcall last_bits
    and r18, r21
    st Z+, r18
    mov r24, r25
    subi r22, 8
    sbci r23, 0
    brcs 4f
    mov r0, r22
    or r0, r23
    brne 1b
4:  ret

; The other way.
line_write_bits:
    mov r0, r20
    ldi r20, 1
    rjmp 2f
1:  lsl r20
2:  dec r0
    brpl 1b
3:  ld r24, X+
    rcall last_bits
    and r24, r21
    mul r21, r20
    movw r18, r0
    com r18
    com r19
    mul r24, r20
    ld r24, Z
    and r24, r18
    or r24, r0
    st Z+, r24
    ld r24, Z
    and r24, r19
    or r24, r1
    st Z, r24
    clr r1
    subi r22, 8
    sbci r23, 0
    brcs 4f
    mov r0, r22
    or r0, r23
    brne 3b
4:  ret

; The bits of a byte in r21 that are among r22 and r23.
last_bits:
    ldi r21, 0xFF
    cpi r22, 8
    cpc r23, r1
    brsh 2f
    mov r0, r22
    ldi r21, 0
1:  sec
    rol r21
    dec r0
    brne 1b
2:  ret

; ---- function 43: who answers

identification:
    ldd r24, Y+1
    cpi r24, 14
    breq 1f
    rjmp refuse_function
1:  ldi r24, 4
    rcall expect_len
    ; r20 and r21: the first and the last object asked for.
    ldd r18, Y+2
    ldd r20, Y+3
    ldi r21, 2
    cpi r18, 1
    brlo wrong_code
    breq 1f
    ldi r21, 6
    cpi r18, 4
    brlo 1f
    brne wrong_code
    mov r21, r20
    rjmp 2f
1:  cpi r20, 3
    brlo 2f
    cpi r20, 6
    breq 2f
    ldi r20, 0
2:  ldi r24, 0x82
    std Y+3, r24
    std Y+4, r1
    std Y+5, r1
    movw r26, r28
    adiw r26, 7
    ldi r19, 0
3:  rcall object
    cp r20, r21
    inc r20
    brlo 3b
    tst r19
    breq no_object
    std Y+6, r19
    movw r30, r26
    rjmp done_at_z
no_object:
    rjmp refuse_address
wrong_code:
    rjmp refuse_value

; Appends object r20 at X, if it is there; then r19 is one more.
object:
    ldi r30, lo8(texts)
    ldi r31, hi8(texts)
    mov r18, r20
    ldi r24, 0xFF
    cpi r20, 3
    brlo 2f
    cpi r20, 6
    brne 4f
    lds r30, NAME_AT
    lds r31, NAME_AT + 1
    lds r24, NAME_LEN
    tst r24
    breq 4f
    rjmp 3f
1:  lpm r0, Z+
    tst r0
    brne 1b
    dec r18
2:  tst r18
    brne 1b
3:  ; r24: bytes at most. r22 and r23: where the length is.
    inc r19
    st X+, r20
    movw r22, r26
    adiw r26, 1
    ldi r25, 0
1:  lpm r0, Z+
    tst r0
    breq 2f
    st X+, r0
    inc r25
    cp r25, r24
    brne 1b
2:  movw r30, r22
    st Z, r25
4:  ret

texts:
    .asciz "uno200"
    .asciz "Arduino Uno"
    VERSION_TEXT
    .balign 2

; ---- function 65: what this is and how it is

identify:
    ldi r24, 1
    rcall expect_len
    movw r30, r28
    adiw r30, 1
    st Z+, r24
    ldi r24, CAPABILITIES
    st Z+, r24
    ldi r26, lo8(STATE)
    ldi r27, hi8(STATE)
    ld r24, X+
    lds r25, FORCES
    cpse r25, r1
    ori r24, 4
    st Z+, r24
    ldi r25, 8
1:  ld r24, X+
    st Z+, r24
    dec r25
    brne 1b
    st Z+, r1
    ldi r24, COUNTS_PER_MS
    st Z+, r24
    ldi r18, 4
    rcall high_first
    rcall high_first
    rcall high_first
    rcall high_first
    ldi r18, 2
    rcall high_first
    st Z+, r1
    lds r24, ROOM
    st Z+, r24
    rcall high_first
    ; The checksum ends the image, its low byte first.
    ld r25, -X
    ld r24, -X
    movw r26, r30
    movw r30, r24
    or r24, r25
    breq 1f
    subi r30, lo8(-(SLOT_START))
    sbci r31, hi8(-(SLOT_START))
1:  ldi r18, 4
2:  sbiw r30, 1
    lpm r19, Z
    cpse r24, r1
    rjmp 3f
    ldi r19, 0
3:  st X+, r19
    dec r18
    brne 2b
    movw r30, r26
    rjmp done_at_z

; Appends the r18 bytes at X at Z, the last one first.
high_first:
    add r26, r18
    adc r27, r1
    mov r19, r18
1:  ld r0, -X
    st Z+, r0
    dec r19
    brne 1b
    add r26, r18
    adc r27, r1
    ret

; ---- function 66: STOP, RUN, single scans

control:
    ldi r24, 4
    rcall expect_len
    ldd r24, Y+1
    ldd r23, Y+2
    ldd r22, Y+3
    lds r25, STATE
    cpi r24, 3
    brsh 1f
    cpi r24, 1
    breq 2f
    rjmp 3f
1:  brne bad_value
    cp r22, r1
    cpc r23, r1
    breq bad_value
    sbrc r25, 0
    rjmp refuse_busy
2:  sbrs r25, 1
    rjmp refuse_busy
3:  sts SCANS_WANTED, r22
    sts SCANS_WANTED + 1, r23
    sts COMMAND, r24
    ldi r24, 4
    rjmp done
bad_value:
    rjmp refuse_value

; ---- function 67: values of one moment

watch:
    ALLOW ANYTHING
    ldi r24, 32
    ldi r25, 3
    rcall expect_list
1:  lds r18, LEFT
    tst r18
    breq gather
    dec r18
    mov r19, r18
    add r19, r19
    add r19, r18
    movw r30, r28
    add r30, r19
    adc r31, r1
    adiw r30, 2
    push r18
    rcall reference
    pop r18
    sts LEFT, r18
    rcall waiting_places
    add r26, r18
    adc r27, r1
    add r26, r18
    adc r27, r1
    st X+, r24
    st X, r25
    rcall next_part
    rjmp 1b

; Where the first of the places waits in X: at the end of the room. r20: how many there are.
waiting_places:
    ldd r20, Y+1
    lds r19, ROOM
    sub r19, r20
    sub r19, r20
    movw r26, r28
    add r26, r19
    adc r27, r1
    ret

gather:
    rcall waiting_places
    rcall put_scans
1:  ld r30, X+
    ld r31, X+
    movw r24, r28
    adiw r24, 4
    cp r26, r24
    cpc r27, r25
    brlo bad_value
    rcall append_value
    dec r20
    brne 1b
    movw r30, r28
    rjmp done_at_z

; Appends the value of place Z at Y.
append_value:
    mov r18, r31
    andi r31, 0x0F
    swap r18
    andi r18, 0x0F
    ld r24, Z+
    sbrs r18, 3
    rjmp 4f
    st Y+, r24
    cpi r18, 9
    brlo 2f
    ld r24, Z+
    st Y+, r24
    breq 2f
    ld r24, Z+
    st Y+, r24
    ld r24, Z+
    st Y+, r24
2:  ret
3:  lsr r24
4:  dec r18
    brpl 3b
    andi r24, 1
    st Y+, r24
    ret

; The scan goes behind the function code, and Y behind that.
put_scans:
    adiw r28, 1
    lds r24, SCANS + 1
    st Y+, r24
    lds r24, SCANS
    st Y+, r24
    ret

; ---- function 68: forces

force:
    lds r18, PHASE
    cpse r18, r1
    rjmp list_forces
    ldd r18, Y+1
    cpi r18, 4
    brsh force_value
    ldi r24, 2
    tst r18
    breq 1f
    cpi r18, 3
    breq 1f
    ldi r24, 9
1:  rcall expect_len
    tst r18
    breq list_forces
    cpi r18, 3
    brne 1f
    rcall line_clear_forces
    rjmp tell_forces
force_value:
    rjmp refuse_value
1:  ALLOW FORCEABLE
    movw r30, r28
    adiw r30, 2
    rcall reference
    ; r20 of r21 forces are not this one.
    ldi r30, lo8(FORCED)
    ldi r31, hi8(FORCED)
    lds r21, FORCES
    ldi r20, 0
2:  cp r20, r21
    breq 3f
    ld r18, Z
    ldd r19, Z+1
    cp r18, r24
    cpc r19, r25
    breq 3f
    adiw r30, FORCE_LEN
    inc r20
    rjmp 2b
3:  ldd r18, Y+1
    sbrc r18, 1
    rjmp unforce
    cpi r20, FORCES_MAX
    breq force_full
    cpse r20, r21
    rjmp 4f
    inc r21
    sts FORCES, r21
4:  lds r18, SM4
    ori r18, 0x80
    sts SM4, r18
    st Z+, r24
    st Z+, r25
    movw r26, r28
    adiw r26, 2
    ldi r25, 7
    rcall copy_bytes
; They have changed. The list follows at the end of the next scan.
tell_forces:
    rcall uno200_tell_forces
    ldi r24, GOES_ON
    sts PHASE, r24
    rjmp not_yet
list_forces:
    movw r30, r28
    adiw r30, 1
    ldi r26, lo8(FORCED)
    ldi r27, hi8(FORCED)
    lds r20, FORCES
    st Z+, r20
    lds r21, ROOM
    add r21, r28
5:  subi r20, 1
    brcs 6f
    mov r24, r21
    sub r24, r30
    cpi r24, 7
    brlo 6f
    adiw r26, 2
    ldi r25, 7
    rcall copy_bytes
    rjmp 5b
6:  rjmp done_at_z

; The last force takes the place of this one.
unforce:
    cp r20, r21
    breq list_forces
    dec r21
    sts FORCES, r21
    ldi r25, FORCE_LEN
    mul r21, r25
    movw r26, r0
    clr r1
    subi r26, lo8(-(FORCED))
    sbci r27, hi8(-(FORCED))
    rcall copy_bytes
    tst r21
    brne 7f
    rcall line_clear_forces
    rjmp tell_forces
7:  rcall release_inputs
    rjmp tell_forces
force_full:
    rjmp refuse_busy

; Copies r25 bytes from X to Z.
copy_bytes:
    ld r0, X+
    st Z+, r0
    dec r25
    brne copy_bytes
    ret

; Ends all forces.
    .global line_clear_forces
line_clear_forces:
    lds r24, FORCES
    tst r24
    breq 2f
    sts FORCES, r1
    lds r24, SM4
    andi r24, 0x7F
    sts SM4, r24
; Nothing but a force writes inputs that the board does not have.
release_inputs:
    ldi r26, lo8(I_START + 1)
    ldi r27, hi8(I_START + 1)
    ldi r24, 15
1:  st X+, r1
    dec r24
    brne 1b
2:  ret

; Gives forced operands their values.
    .global line_apply_forces
line_apply_forces:
    lds r20, FORCES
    ldi r30, lo8(FORCED)
    ldi r31, hi8(FORCED)
    rjmp 3f
1:  ld r26, Z
    ldd r27, Z+1
    ; The value ends the entry: four bytes of it, two or one.
    adiw r30, 5
    mov r18, r27
    swap r18
    andi r18, 0x0F
    cpi r18, 10
    breq 2f
    adiw r30, 2
    cpi r18, 9
    breq 2f
    adiw r30, 1
2:  rcall line_store_value
3:  subi r20, 1
    brcc 1b
    ret

; Writes the value at Z to place X. Z behind it.
line_store_value:
    mov r18, r27
    andi r27, 0x0F
    swap r18
    andi r18, 0x0F
    ld r24, Z+
    sbrs r18, 3
    rjmp 2f
    st X+, r24
    cpi r18, 9
    brlo 1f
    ld r24, Z+
    st X+, r24
    breq 1f
    ld r24, Z+
    st X+, r24
    ld r24, Z+
    st X+, r24
1:  ret
2:  ldi r25, 1
    rjmp 4f
3:  lsl r25
4:  dec r18
    brpl 3b
    ld r19, X
    or r19, r25
    sbrs r24, 0
    eor r19, r25
    st X, r19
    ret

; ---- function 71: bytes of the program slot or of the trace

read_block:
    ldi r24, 5
    rcall expect_len
    ldd r20, Y+4
    tst r20
    breq block_value
    cpi r20, 65
    brsh block_value
    lds r24, ROOM
    subi r24, 2
    cp r24, r20
    brlo block_value
    ldd r25, Y+2
    ldd r24, Y+3
    ldi r22, lo8(SLOT_LEN)
    ldi r23, hi8(SLOT_LEN)
    ldd r21, Y+1
    cpi r21, 2
    brsh block_address
    sbrs r21, 0
    rjmp 1f
    lds r22, RING_END
    lds r23, RING_END + 1
    lds r30, RING
    lds r31, RING + 1
    sub r22, r30
    sbc r23, r31
1:
    ; r22 and r23: bytes from there to the end.
    sub r22, r24
    sbc r23, r25
    brcs block_address
    cp r22, r20
    cpc r23, r1
    brlo block_address
    movw r26, r28
    adiw r26, 1
    st X+, r20
    add r30, r24
    adc r31, r25
    sbrc r21, 0
    rjmp 3f
    movw r30, r24
    subi r30, lo8(-(SLOT_START))
    sbci r31, hi8(-(SLOT_START))
2:  lpm r0, Z+
    st X+, r0
    dec r20
    brne 2b
    rjmp block_end
3:  ld r0, Z+
    st X+, r0
    dec r20
    brne 3b
block_end:
    movw r30, r26
    rjmp done_at_z
block_value:
    rjmp refuse_value
block_address:
    rjmp refuse_address

; ---- function 72: sets operands, all or none

set:
    ALLOW WRITABLE
    ldi r24, 16
    rcall expect_entries
    rcall begin
1:  lds r18, LEFT
    lds r19, AT
    tst r18
    breq 2f
    dec r18
    ; Nothing behind the request is a reference.
    ldi r24, 3
    add r24, r19
    brcs block_value
    cp r17, r24
    brlo block_value
    movw r30, r28
    add r30, r19
    adc r31, r1
    push r18
    push r19
    push r30
    push r31
    rcall reference
    pop r31
    pop r30
    pop r19
    pop r18
    std Z+1, r24
    std Z+2, r25
    subi r21, -3
    add r19, r21
    brcs block_value
    cp r17, r19
    brlo block_value
    sts LEFT, r18
    sts AT, r19
    rcall next_part
    rjmp 1b
2:  mov r24, r19
    rcall expect_len
    ldd r20, Y+1
    movw r30, r28
    adiw r30, 2
3:  ldd r26, Z+1
    ldd r27, Z+2
    adiw r30, 3
    rcall line_store_value
    dec r20
    brne 3b
    ldi r24, 2
    rjmp done
