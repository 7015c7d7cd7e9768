; Where timers and counters are, and the time that passes for them.

; The preset, by address or as a constant, in r24 and r25; r26 stays the slot. Y after both.
.macro PRESET_WORD
    mov r20, r26
    movw r30, r28
    lpm r26, Z+
    lpm r27, Z+
    movw r28, r30
    READABLE r27
    ld r25, X+
    ld r24, X
    mov r26, r20
.endm
.macro PRESET_CONSTANT
    movw r30, r28
    lpm r24, Z+
    lpm r25, Z+
    movw r28, r30
.endm
; The address of slot r26 in X.
.macro SLOT_ADDRESS start, len
    ldi r21, \len
    mul r26, r21
    movw r26, r0
    clr r1
    lds r18, LINE + \start
    add r26, r18
    lds r18, LINE + \start + 1
    adc r27, r18
.endm

; Z at the entry of the timer in slot r26, in the image's table.
.macro TIMER_ENTRY
    lds r30, LINE + TIMERS_IN_FLASH
    lds r31, LINE + TIMERS_IN_FLASH + 1
    add r30, r26
    adc r31, r1
    add r30, r26
    adc r31, r1
.endm

; void uno200_advance_timers(u8 is_10_ms, u16 ticks): running timers of 1 ms or 10 ms count on.
; Means: plc-vm timer.rs advance.
; in: r24 not 0: those of 10 ms, r23:r22 ticks   out: -   destroys: what C functions may
.global uno200_advance_timers
uno200_advance_timers:
    push r16
    push r17
    push r28
    push r29
    mov r17, r24
    movw r28, r22
    lds r16, CONTEXT + TIMERS
1:  subi r16, 1
    brcs 3f
    mov r26, r16
    rcall look_timer_up
    cpi r20, 101
    brsh 1b
    mov r18, r20
    andi r18, 31
    cpi r18, 5
    brsh 1b
    ; 0 for 1 ms, 1 for 10 ms.
    cpse r18, r1
    ldi r18, 1
    cpse r18, r17
    rjmp 1b
    SLOT_ADDRESS TIMERS_START, TIMER_SLOT_LEN
    ldi r21, lo8(T_BITS_START)
    rcall place_bit
    ld r23, X+
    ld r22, X+
    ld r25, X+
    ld r24, X+
    ld r20, X
    sbiw r26, 3
    sbrs r20, 0
    rjmp 1b
    movw r20, r28
    rcall add_time
    cpi r19, STARTED_BY_TOF
    breq 2f
    rcall store_value
    rjmp 1b
2:  rcall off_delay_counts
    rjmp 1b
3:  pop r29
    pop r28
    pop r17
    pop r16
    ret

; in: r26 slot   out: r20 number of the timer, r19 how it is started   destroys: Z
look_timer_up:
    TIMER_ENTRY
    lpm r20, Z+
    lpm r19, Z
    ret

; in: r26 slot, Y address of the preset
; out: X slot, r25:r24 preset, Y after it, Z byte of the bit, r18 its mask, r19 bit 0: counts in
;   100 ms   destroys: r17, r20, r21
timer_word:
    PRESET_WORD
    rjmp place_timer
; in: r26 slot, Y the preset   out: as timer_word   destroys: r17, r20, r21
timer_constant:
    PRESET_CONSTANT

; A timer of 1 ms is brought up to date first. Means: plc-vm interpreter.rs timer.
; in: r26 slot   out: as timer_word   destroys: r17, r20, r21
place_timer:
    TIMER_ENTRY
    lpm r20, Z
    SLOT_ADDRESS TIMERS_START, TIMER_SLOT_LEN
    cpi r27, hi8(DATA_END)
    brsh outside_afar
    ldi r19, 1
    ldi r21, lo8(T_BITS_START)
    cpi r20, 101
    brsh place_bit
    mov r18, r20
    andi r18, 31
    breq 1f
    cpi r18, 5
    brsh place_bit
    ldi r19, 0

; in: r20 number of a bit, r21 low byte of the address of bit 0, in the bit page
; out: Z its byte, r18 its mask   destroys: r20
place_bit:
    ldi r18, 1
    sbrc r20, 1
    ldi r18, 4
    sbrc r20, 0
    lsl r18
    sbrc r20, 2
    swap r18
    lsr r20
    lsr r20
    lsr r20
    add r20, r21
    mov r30, r20
    ldi r31, 1
    ret
; Reached by short jumps from far after the tables.
; in: Y as for leave   ends: leaves the program
outside_afar:
    jmp outside
; A timer of 1 ms is brought up to date first.
1:  bld r17, 0
    push r20
    push r24
    push r25
    push r26
    push r27
    call uno200_refresh_timers
    pop r27
    pop r26
    pop r25
    pop r24
    pop r20
    bst r17, 0
    ldi r19, 0
    ldi r21, lo8(T_BITS_START)
    rjmp place_bit

; in: r26 slot, Y address of the preset, r16
; out: X slot, r25:r24 preset, Y after it, Z byte of the bit, r18 its mask, r19 S1 in bit 1, S2 in
;   bit 2   destroys: r20, r21
counter_word:
    PRESET_WORD
    rjmp place_counter
; in: r26 slot, Y the preset, r16   out: as counter_word   destroys: r20, r21
counter_constant:
    PRESET_CONSTANT

; Means: plc-vm interpreter.rs counter.
; in: r26 slot, r16   out: as counter_word   destroys: r20, r21
place_counter:
    lds r30, LINE + COUNTERS_IN_FLASH
    lds r31, LINE + COUNTERS_IN_FLASH + 1
    add r30, r26
    adc r31, r1
    lpm r20, Z
    SLOT_ADDRESS COUNTERS_START, COUNTER_SLOT_LEN
    cpi r27, hi8(DATA_END)
    brsh 2f
    mov r19, r16
    lsl r19
    ldi r21, lo8(C_BITS_START)
    rjmp place_bit
2:  rjmp outside_afar
