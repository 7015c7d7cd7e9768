; Interrupts that modules serve.

; To an entry of the module, with r31, r30, r0 and SREG on the stack.
.macro INTERRUPT vector, entry, by
.global \vector
\vector:
    push r31
    ldi r31, \entry
    rjmp \by
.endm
.macro BY_MODULE module
    push r30
    ldi r30, lo8(SLOT_START + DIRECTORY_AT + 2 * \module)
.endm

; A character: the firmware's own, unless a module has taken over the serial line. Before SREG is
; kept nothing changes it.
; in: -   ends: in the handler of the line, with r31 on the hardware stack
.global __vector_18
__vector_18:
    push r31
    in r31, MODULE_FLAGS
    sbrs r31, SERIAL_FLAG
    jmp uno200_character
    ldi r31, FREEPORT_ENTRY
    rjmp freeport_interrupt
; Timer2, which belongs to whoever has the line.
; in: -   ends: in the handler of the line, with r31 on the hardware stack
.global __vector_7
__vector_7:
    push r31
    in r31, MODULE_FLAGS
    sbrs r31, SERIAL_FLAG
    jmp uno200_pause
    ldi r31, FREEPORT_ENTRY + 2
    rjmp freeport_interrupt
    INTERRUPT __vector_20, FREEPORT_ENTRY + 1, freeport_interrupt
    INTERRUPT __vector_13, PULSES_ENTRY, pulses_interrupt
    INTERRUPT __vector_1, COUNTERS_ENTRY, counters_interrupt
    INTERRUPT __vector_2, COUNTERS_ENTRY + 1, counters_interrupt
    INTERRUPT __vector_5, COUNTERS_ENTRY + 2, counters_interrupt
; in: r31 entry of the module, the old r31 on the hardware stack   ends: as interrupt
pulses_interrupt:
    BY_MODULE PULSES_MODULE
    rjmp interrupt
; in: r31 entry of the module, the old r31 on the hardware stack   ends: as interrupt
freeport_interrupt:
    BY_MODULE FREEPORT_MODULE
    rjmp interrupt
; in: r31 entry of the module, the old r31 on the hardware stack   ends: as interrupt
counters_interrupt:
    BY_MODULE COUNTERS_MODULE
; in: r31 entry of the module, Z low the place of its address, r31 and r30 on the hardware stack
; ends: in the module, with r31, r30, r0 and SREG there
interrupt:
    push r0
    in r0, SREG
    push r0
    push r31
    ldi r31, hi8(SLOT_START)
    lpm r0, Z+
    lpm r31, Z
    mov r30, r0
    pop r0
    add r30, r0
    brcc 1f
    inc r31
1:  ijmp
