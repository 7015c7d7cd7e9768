; Counters: what CTU, CTD and CTUD do with a slot.

; Remembers S1 (or S2 and S1) in bit 0 (and 1) of the state after X; which of them rose is in r20.
.macro REMEMBER
    adiw r26, 2
    ld r20, X
    mov r22, r20
.endm
.macro ROSE
    st X, r22
    sbiw r26, 2
    com r20
    and r20, r22
    lds r21, SYSTEM_BITS
    sbrc r21, FIRST_SCAN
    clr r20
.endm

; CTU. Means: plc-vm counter.rs up.
; in: X slot, r25:r24 preset, Z byte of the bit, r18 its mask, r19 S1 in bit 1, T S0
; out: -   destroys: r18-r23, X
count_up:
    REMEMBER
    andi r22, 0xFE
    sbrc r19, 1
    ori r22, 0x01
    ROSE
    brts write_zero
    ld r23, X+
    ld r22, X
    sbrs r20, 0
    rjmp store_value
    subi r22, 0xFF
    sbci r23, 0xFF
    brvc 1f
    ldi r22, 0xFF
    ldi r23, 0x7F
1:  rjmp store_value
; Value and bit are 0.
; in: X value, Z byte of the bit, r18 its mask   out: -   destroys: r18, r20, X
write_zero:
    st X+, r1
    st X, r1
; in: Z byte, r18 mask   out: -   destroys: r18, r20
clear_bit:
    CLEAR_BIT
    ret

; CTD. Means: plc-vm counter.rs down.
; in: as count_up   out: -   destroys: r18-r23, X
count_down:
    REMEMBER
    andi r22, 0xFD
    sbrc r19, 1
    ori r22, 0x02
    ROSE
    brtc 1f
    st X+, r25
    st X, r24
    rjmp clear_bit
1:  ld r23, X+
    ld r22, X
    ; Down to 0 and no further.
    cp r1, r22
    cpc r1, r23
    brge 2f
    sbrs r20, 1
    rjmp 2f
    subi r22, 1
    sbci r23, 0
2:  st X, r22
    st -X, r23
    cp r1, r22
    cpc r1, r23
    rjmp write_timer_bit

; CTUD. Means: plc-vm counter.rs up_down.
; in: as count_up, r19 also S2 in bit 2   out: -   destroys: r18-r23, X
count_up_down:
    REMEMBER
    andi r22, 0xFC
    sbrc r19, 2
    ori r22, 0x01
    sbrc r19, 1
    ori r22, 0x02
    ROSE
    brts write_zero
    ld r23, X+
    ld r22, X
    sbrs r20, 0
    rjmp 1f
    subi r22, 0xFF
    sbci r23, 0xFF
1:  sbrs r20, 1
    rjmp 2f
    subi r22, 1
    sbci r23, 0
2:  rjmp store_value
