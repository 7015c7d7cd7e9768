; Timers: what TON, TOF and TONR do with a slot.

; The preset r24 and r25 into the slot X. X at the state.
.macro STORE_PRESET
    adiw r26, 2
    st X+, r25
    st X+, r24
.endm
; The value of the timer whose state is at X. X at its low byte.
.macro CLEAR_VALUE
    sbiw r26, 4
    st X+, r1
    st X, r1
.endm
; The bit with mask r18 in the byte at Z.
.macro CLEAR_BIT
    com r18
    ld r20, Z
    and r20, r18
    st Z, r20
.endm

; TON. Means: plc-vm timer.rs on_delay.
; in: X slot, r25:r24 preset, Z byte of the bit, r18 its mask, r19 bit 0: counts in 100 ms, T
; out: -   destroys: r18-r23, X
on_delay:
    STORE_PRESET
    brts 1f
    st X, r1
    CLEAR_VALUE
    CLEAR_BIT
    ret
1:  ld r20, X
    ldi r21, 1
    st X, r21
    sbiw r26, 4
    clr r22
    clr r23
    sbrc r20, 0
    rjmp count_on
    adiw r26, 1
    rjmp store_value

; TONR. Means: plc-vm timer.rs execute.
; in: as on_delay   out: -   destroys: r18-r23, X
retentive_on_delay:
    STORE_PRESET
    brts 1f
    st X, r1
    ret
1:  ld r20, X
    ldi r21, 1
    st X, r21
    sbiw r26, 4
    sbrs r20, 0
    ldi r19, 0
; in: X value, the rest as on_delay   out: -   destroys: r18-r23, X
count_on:
    rcall add_ticks
; Writes a value, and the bit from its comparison with the preset.
; in: X low byte of the value, r23:r22 value, r25:r24 preset, Z byte of the bit, r18 its mask
; out: -   destroys: r20, X
store_value:
    st X, r22
    st -X, r23
    cp r22, r24
    cpc r23, r25
; in: signed flags of value less preset, Z byte of the bit, r18 its mask   out: -   destroys: r20
write_timer_bit:
    ld r20, Z
    brge 1f
    or r20, r18
    eor r20, r18
    st Z, r20
    ret
1:  or r20, r18
    st Z, r20
    ret

; in: X value, r19 bit 0: the time that has passed is added
; out: r23:r22 value, X its low byte   destroys: r20, r21
add_ticks:
    ld r23, X+
    ld r22, X
    sbrs r19, 0
    ret
    lds r20, CONTEXT + TICKS_100
    lds r21, CONTEXT + TICKS_100 + 1
; Neither is, nor becomes, more than 32,767.
; in: r21:r20 time, r23:r22 value   out: r23:r22 value   destroys: r20, r21
add_time:
    sbrs r21, 7
    rjmp 1f
    ldi r20, 0xFF
    ldi r21, 0x7F
1:  add r22, r20
    adc r23, r21
    brvc 2f
    ldi r22, 0xFF
    ldi r23, 0x7F
2:  ret

; TOF. Means: plc-vm timer.rs off_delay.
; in: as on_delay   out: -   destroys: r18-r23, X
off_delay:
    STORE_PRESET
    ld r20, X
    brtc 1f
    ldi r21, 2
    st X, r21
    CLEAR_VALUE
    ld r20, Z
    or r20, r18
    st Z, r20
    ret
1:  ldi r21, 1
    sbrs r20, 1
    rjmp 2f
    st X, r21
    CLEAR_VALUE
    clr r22
    clr r23
    rjmp 3f
2:  sbrs r20, 0
    ret
    sbiw r26, 4
    rcall add_ticks
; The value is r22 and r23, X at its low byte.
3:
; The value of a TOF that runs, and its end.
; in: X low byte of the value, r23:r22 value, r25:r24 preset, Z byte of the bit, r18 its mask
; out: -   destroys: r20, r24, r25, X
off_delay_counts:
    cp r22, r24
    cpc r23, r25
    brge 4f
    st X, r22
    st -X, r23
    ret
4:  ; The time is over: the value is the preset, but not below 0.
    sbrc r25, 7
    clr r24
    sbrc r25, 7
    clr r25
    st X, r24
    st -X, r25
    adiw r26, 4
    st X, r1
    ld r20, Z
    or r20, r18
    eor r20, r18
    st Z, r20
    ret
