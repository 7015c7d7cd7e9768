; Module 7: references, the operands of all other modules, and how a comparison ends. No instruction
; of its own.
;
; One entry; r26 says what is asked for (interface.inc). A direct reference was checked by the
; loader. A pointer is resolved through the tables of the image, and so is the room after an
; address.

.include "interface.inc"

; In r0, the access: the room is asked for by the address in X instead of by the pointer at X.
.equ BY_ADDRESS, 0x80
.equ ACCESS_LEN, 0x07

; All that is asked of this module comes here. Means: plc-vm references.rs read, source, target.
; in: r26 what, and what belongs to it (interface.inc), Y at the operand's reference
; out: as asked, Y after the reference; READ: r25:r22 the value; otherwise X the address, Z the room
; destroys: r0
entry:
    sbrc r26, 7
    rjmp ending
    mov r0, r26
    movw r30, r28
    adiw r28, 2
    lpm r26, Z+
    lpm r27, Z
    sbrc r27, 7
    rjmp not_direct
    ; Flash can change under a running program until the self-test has seen it: no operand may lead
    ; outside.
    mov r30, r27
    subi r30, hi8(DATA_START)
    cpi r30, hi8(DATA_END - DATA_START)
    brsh bad
    sbrs r0, 6
    rjmp 1f
    mov r30, r0
    ori r30, BY_ADDRESS
    mov r0, r30
    rjmp resolve
1:  sbrs r0, 3
    ret
; The value at an address. Means: plc-vm references.rs get.
; in: X address, r0 the access   out: r25:r22 the value   destroys: r30, X
load:
    sbrc r0, 2
    rjmp 1f
    clr r23
    sbrc r0, 1
    ld r23, X+
    ld r22, X
    rjmp extend
    ; High-speed counters are counted by interrupts.
1:  in r30, SREG
    cli
    ld r25, X+
    ld r24, X+
    ld r23, X+
    ld r22, X
    out SREG, r30
    ret

; A reference that is no address: a pointer's place, a small constant or a place in the pool.
; in: r27:r26 reference, r0 the access   out: as asked   destroys: r22-r25, X, Z
not_direct:
    sbrc r27, 6
    rjmp constant
    andi r27, 0x07
; The pointer at X: all that it leads to is checked here. By address: only the room is found. Means:
; plc-vm references.rs address.
; in: X where the pointer is, or the address, r0 the access
; out: as asked, r22 to r25 as they were unless READ   destroys: X, Z
resolve:
    ; Who asks keeps values in them.
    EACH push, r18, r19, r20, r21, r22, r23, r24, r25
    rcall place
    brcs 1f
    ; Enough room for one value, which never is without room for 255.
    mov r24, r0
    andi r24, ACCESS_LEN
    cp r30, r24
    cpc r31, r1
1:  EACH pop, r25, r24, r23, r22, r21, r20, r19, r18
    brcs bad
    sbrs r0, 3
    ret
    rjmp load

; The room after an address that an instruction has computed. Means: plc-vm references.rs room.
; in: r25:r24 address   out: X the address, Z the room   destroys: r0
room_at:
    ldi r26, BY_ADDRESS + ROOM
    mov r0, r26
    movw r26, r24
    rjmp resolve

; What cannot be done. Of COMPARE it is a fault; otherwise it takes the address of the routine that
; called from the stack and abandons the instruction.
; in: r0 the access   ends: as abandon or as fault
bad:
    sbrc r0, 5
    rjmp fault
    pop r0
    pop r0
; Boxes have power flow, and may use T for something else meanwhile. Means: plc-vm modules/mod.rs
; execute.
; in: -   ends: SM4.3 := 1, ENO := 0, T := 1
abandon:
    set
    lds r24, ERROR_BITS
    ori r24, 1 << RUN_TIME_ERROR
    sts ERROR_BITS, r24
    sts ENO, r1
; in: -   ends: with nothing more
done:
    jmp MODULE_DONE

; A pointer of a comparison, which has no ENO.
; in: -   ends: RUN, with FAULT_POINTER
fault:
    ldi r24, FAULT_POINTER
    jmp MODULE_FAULT

; A constant: 13 bits with their sign in the reference, or in the pool.
; in: r27:r26 reference, r0 the access
; out: r25:r22 the value; in the pool without READ: X and Z its address in flash   destroys: -
constant:
    sbrc r27, 5
    rjmp pool
    ; 13 bits with their sign; a byte is extended with zeros.
    andi r27, 0x1F
    sbrc r27, 4
    ori r27, 0xE0
    movw r22, r26
    sbrs r0, 1
    sbrc r0, 2
    rjmp extend
    clr r23
; in: r23:r22 word   out: r25:r24 its sign   destroys: -
extend:
    clr r24
    sbrc r23, 7
    com r24
    mov r25, r24
    ret

; A constant, or the beginning of a string, in the image.
; in: r27:r26 reference, r0 the access
; out: READ: r25:r22 the value; otherwise X and Z its address in flash   destroys: -
pool:
    andi r27, 0x1F
    subi r27, hi8(-(IMAGE))
    movw r30, r26
    sbrs r0, 3
    ret
    sbrc r0, 2
    rjmp 1f
    clr r23
    sbrc r0, 1
    lpm r23, Z+
    lpm r22, Z
    rjmp extend
1:  lpm r25, Z+
    lpm r24, Z+
    lpm r23, Z+
    lpm r22, Z
    ret

.include "places.inc"

; ---- how comparisons end

; What is asked for with a jump, or with an address: bits 4, 3, 2 of what is asked tell it.
; in: r26 what, and what belongs to it (interface.inc)
; out: ROOM_AT: X and Z as room_at; all others end the instruction   destroys: r0
ending:
    sbrc r26, 4
    rjmp room_at
    sbrc r26, 3
    rjmp abandon
    sbrc r26, 2
    rjmp combine
    mov r27, r26
    andi r27, 0x03
    sbiw r28, 5
    movw r30, r28
    lpm r0, Z
    ; A bit for each relation that holds, in their order.
    ldi r30, EQUAL_HOLD
    cp r18, r22
    cpc r19, r23
    cpc r20, r24
    cpc r21, r25
    breq 1f
    ldi r30, LESS_HOLD
    brlt 1f
    ldi r30, GREATER_HOLD
    ; That of the relation to bit 0.
1:  dec r0
    brmi 2f
    lsr r30
    rjmp 1b
2:  mov r18, r30
    mov r19, r27
; The logic stack takes the result of a contact. Means: plc-vm modules/compare.rs contact.
; in: r18 bit 0 result, r19 0 load, 1 AND, 2 OR, r16 and T the logic stack
; ends: r16 and T the logic stack after it
combine:
    dec r19
    brmi 4f
    breq 3f
    sbrc r18, 0
    set
    rjmp done
3:  sbrs r18, 0
    clt
    rjmp done
4:  lsl r16
    bld r16, 0
    bst r18, 0
    rjmp done
