; Answers on the line: what plc-link does, in a third of the flash that a compiler takes for it.
; Names, order of checks and bytes are those of plc-link and of docs/protocol.md; a test compares
; the two.
;
; While a request is answered Y is the frame, r17 the request's length, r16 its function, r15 and
; r14 what references may name, r13 and r12 the stack pointer of whoever refuses, r10 when the
; answer was begun. r26 and r27 are X, r30 and r31 are Z.

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
.equ FORCES, LINE + 25
; From here on in the order of the answer to 65: state, fault, fault before the last reset,
; shortest, last and longest scan, scans, free stack, length of the image.
.equ STATE, LINE + 28
.equ SCAN_TIMES, LINE + 37
.equ SCANS, LINE + 49
.equ FORCED, LINE + 57
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

; The function beside those from 65 on.
.equ SCAN_STATUS, 100
; The command for single scans.
.equ SCANS_COMMAND, 3

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

; Answers a request. Means: plc-link answer.rs answer.
; in: r24 its bytes   out: r24 bytes of the answer; 0: not yet   destroys: what C functions may
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
    cpi r16, SCAN_STATUS
    breq scan_status
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
; in: -   ends: function 43
device:
    rjmp identification
; in: -   ends: function 100
scan_status:
    rjmp status
; in: r24 function less 65   ends: in that function
service:
    ldi r30, pm_lo8(services)
    ldi r31, pm_hi8(services)
    add r30, r24
    adc r31, r1
    ijmp
; in: -   ends: in the function of its number
services:
    rjmp identify
    rjmp control
    rjmp watch
    rjmp force
    rjmp status
    rjmp trace
    rjmp read_block
    rjmp set

; in: -   ends: the answer is exception 1. Can be gone to from subroutines.
refuse_function:
    ldi r24, 1
    rjmp refuse
; in: -   ends: the answer is exception 4
refuse_busy:
    ldi r24, 4
    rjmp refuse
; in: -   ends: the answer is exception 2
refuse_address:
    ldi r24, 2
    rjmp refuse
; in: -   ends: the answer is exception 3
refuse_value:
    ldi r24, 3
; in: r24 exception   ends: the answer is that
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
; in: Z after the last byte of the answer   ends: the answer is complete
done_at_z:
    mov r24, r30
    lds r25, FRAME
    sub r24, r25
; in: r24 bytes of the answer   ends: it is complete
done:
    sts PHASE, r1
    rjmp line_leave
; in: -   ends: the next scan goes on with the answer
not_yet:
    ldi r24, 0
; in: r24 as line_answer returns it   ends: returns to Rust
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

; Refuses a request of another length. Means: plc-link request.rs expect_len.
; in: r24 bytes   out: -   destroys: -
expect_len:
    cp r17, r24
    brne refuse_value
    ret

; Refuses a request with no entries or more than there may be. Means: plc-link service.rs
; expect_count.
; in: r24 most entries   out: r20 entries, Y+1   destroys: -
expect_entries:
    ldd r20, Y+1
    cp r24, r20
    brlo refuse_value
    cp r20, r1
    breq refuse_value
    ret
; Refuses a request that is not these entries and the two bytes before them. Begins with them or
; goes on.
; in: r24 most entries, r25 bytes of each   out: r20 entries   destroys: r24
expect_list:
    rcall expect_entries
    mul r20, r25
    mov r24, r0
    clr r1
    subi r24, -2
    rcall expect_len
; Means: plc-link service.rs begin.
; in: r20 entries   out: LEFT and AT, if it is the first time   destroys: r24
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

; Returns if there is time for the next part of an answer, otherwise ends with not_yet.
; Means: plc-link station.rs has_time.
; in: r18 parts that are left: the last one takes longer   out: -   destroys: r24, r25
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
