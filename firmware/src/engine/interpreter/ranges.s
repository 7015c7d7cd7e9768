; Ranges: several bits, timers or counters at once.

; Means: plc-vm range.rs write.
; in: X, r24 first byte, r19 mask of the first bit, r18 number of bits, r21 0xFF: reset, 0: set
; out: -   destroys: r18, r19, r24, X   Does not return when they lead out of data memory.
set_bits:
    eor r24, r21
1:  or r24, r19
    dec r18
    breq 2f
    lsl r19
    brcc 1b
    eor r24, r21
    st X+, r24
    call check_end
    ld r24, X
    eor r24, r21
    ldi r19, 1
    rjmp 1b
2:  eor r24, r21
    st X, r24
    ret

; R of timers or counters. Means: plc-vm instructions.rs reset_timers, reset_counters.
; in: r26 first number, r18 how many, r27 upper byte of the first bit as far bits are packed, Y the
;   next instruction   ends: goes on there
reset_numbers:
    mov r22, r26
    mov r23, r18
    mov r20, r27
    ; None when the range would pass number 255.
    mov r24, r26
    add r24, r18
    brcc 1f
    brne 6f
1:  tst r18
    breq 6f
    ldi r21, 0xFF
    rcall far_bit
    rcall set_bits
    ; Words of LINE: the table in flash, where it ends, the first slot.
    ldi r30, lo8(LINE + TIMERS_IN_FLASH)
    ldi r31, hi8(LINE + TIMERS_IN_FLASH)
    ldi r21, TIMER_SLOT_LEN
    sbrs r20, 0
    rjmp 2f
    adiw r30, COUNTERS_IN_FLASH - TIMERS_IN_FLASH
    ldi r21, COUNTER_SLOT_LEN
2:  ld r18, Z
    ldd r19, Z + 1
    ldd r24, Z + 2
    ldd r25, Z + 3
    ldd r26, Z + TIMERS_START - TIMERS_IN_FLASH
    ldd r27, Z + TIMERS_START - TIMERS_IN_FLASH + 1
    movw r30, r18
    ; Each slot. Of a timer the kind is after the number, and the state after value and preset.
3:  cp r30, r24
    cpc r31, r25
    brsh 4f
    lpm r19, Z+
    sbrs r20, 0
    adiw r30, 1
    sub r19, r22
    cp r19, r23
    brsh 5f
    st X+, r1
    st X, r1
    adiw r26, 3
    sbrs r20, 0
    st X, r1
    sbiw r26, 4
5:  add r26, r21
    adc r27, r1
    rjmp 3b
    ; Many of these take longer than the hardware watchdog waits.
4:  bld r17, 0
    call loop_vector
    bst r17, 0
6:  jmp next_x
