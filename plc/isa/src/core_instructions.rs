//! The instructions of the core: those that the firmware has itself. What the rows mean, table.rs
//! says.

/// Hands the rows to the macro `$next`, which adds its own and hands all to `$last`.
macro_rules! core_instructions {
    ($next:ident ! $last:ident) => {
        $next! { $last !
            /// Load: pushes the bit onto the logic stack.
            Ld load(bit: Bit = IN)
                ["LD"] Contact, needs 0, adds 1, Loads, flags NONE {
                    0x00..=0x07 (PageBit);
                    0x48..=0x48 (FarBit);
                }
            /// Load Not: pushes the inverted bit onto the logic stack.
            Ldn load_not(bit: Bit = IN)
                ["LDN"] Contact, needs 0, adds 1, Loads, flags NONE {
                    0x08..=0x0F (PageBit);
                    0x49..=0x49 (FarBit);
                }
            /// And: combines the bit with the top of the stack.
            A and(bit: Bit = IN)
                ["A" "U"] Contact, needs 1, adds 0, Ands, flags NONE {
                    0x10..=0x17 (PageBit);
                    0x4A..=0x4A (FarBit);
                }
            /// And Not: combines the inverted bit with the top of the stack.
            An and_not(bit: Bit = IN)
                ["AN" "UN"] Contact, needs 1, adds 0, Ands, flags NONE {
                    0x18..=0x1F (PageBit);
                    0x4B..=0x4B (FarBit);
                }
            /// Or: combines the bit with the top of the stack.
            O or(bit: Bit = IN)
                ["O"] Contact, needs 1, adds 0, Ors, flags NONE {
                    0x20..=0x27 (PageBit);
                    0x4C..=0x4C (FarBit);
                }
            /// Or Not: combines the inverted bit with the top of the stack.
            On or_not(bit: Bit = IN)
                ["ON"] Contact, needs 1, adds 0, Ors, flags NONE {
                    0x28..=0x2F (PageBit);
                    0x4D..=0x4D (FarBit);
                }
            /// Inverts the top of the stack.
            Not not()
                ["NOT"] Contact, needs 1, adds 0, Combines, flags NONE {
                    0x60..=0x60 ();
                }
            /// Edge Up: the top of the stack becomes 1 for one execution when it rose from 0 to 1
            /// since the last one.
            Eu edge_up(edge: u8 = NUMBER)
                ["EU"] Contact, needs 1, adds 0, Combines, flags NONE {
                    0x61..=0x61 (Edge);
                }
            /// Edge Down: the top of the stack becomes 1 for one execution when it fell from 1 to 0
            /// since the last one.
            Ed edge_down(edge: u8 = NUMBER)
                ["ED"] Contact, needs 1, adds 0, Combines, flags NONE {
                    0x62..=0x62 (Edge);
                }
            /// Output: copies the top of the stack to the bit.
            Assign assign(bit: Bit = OUT)
                ["="] Coil, needs 1, adds 0, Drives, flags NONE {
                    0x30..=0x37 (PageBitOut);
                    0x4E..=0x4E (FarBitOut);
                }
            /// Set: sets N consecutive bits.
            Set set(bit: Bit = OUT.many(Counted(1)), n: ByteSource = NUMBER)
                ["S"] Coil, needs 1, adds 0, Boxed, flags NONE {
                    0x38..=0x3F (PageBitOut, One);
                    0x4F..=0x4F (FarBitOut, Count);
                }
            /// Reset: resets N consecutive bits.
            Reset reset(bit: Bit = OUT.many(Counted(1)), n: ByteSource = NUMBER)
                ["R"] Coil, needs 1, adds 0, Boxed, flags NONE {
                    0x40..=0x47 (PageBitReset, One);
                    0x50..=0x50 (FarBitReset, Count);
                }
            /// Reset timers: bit and current value of N consecutive timers become 0.
            ResetTimers reset_timers(first: u8 = NUMBER.many(Counted(1)), n: ByteSource = IN)
                ["R"] Coil, needs 1, adds 0, Boxed, flags NONE {
                    0x53..=0x53 (TimerNumber, Count);
                    0x54..=0x54 (TimerNumber, Byte);
                }
            /// Reset counters: bit and current value of N consecutive counters become 0.
            ResetCounters reset_counters(first: u8 = NUMBER.many(Counted(1)), n: ByteSource = IN)
                ["R"] Coil, needs 1, adds 0, Boxed, flags NONE {
                    0x55..=0x55 (CounterNumber, Count);
                    0x56..=0x56 (CounterNumber, Byte);
                }
            /// No operation; the number has no effect.
            Nop no_operation(n: u8 = NUMBER)
                ["NOP"] Contact, needs 0, adds 0, Combines, flags NONE {
                    0x63..=0x63 (Number);
                }
            /// And Load: combines the two top levels with AND into one.
            Ald and_load()
                ["ALD" "ULD"] Stack, needs 2, adds -1, Combines, flags NONE {
                    0x64..=0x64 ();
                }
            /// Or Load: combines the two top levels with OR into one.
            Old or_load()
                ["OLD"] Stack, needs 2, adds -1, Combines, flags NONE {
                    0x65..=0x65 ();
                }
            /// Logic Push: pushes a copy of the top of the stack.
            Lps logic_push()
                ["LPS"] Stack, needs 1, adds 1, Combines, flags NONE {
                    0x66..=0x66 ();
                }
            /// Logic Read: copies the second level to the top of the stack.
            Lrd logic_read()
                ["LRD"] Stack, needs 2, adds 0, Combines, flags NONE {
                    0x67..=0x67 ();
                }
            /// Logic Pop: removes the top of the stack.
            Lpp logic_pop()
                ["LPP"] Stack, needs 2, adds -1, Combines, flags NONE {
                    0x68..=0x68 ();
                }
            /// Load Stack: pushes a copy of level n.
            Lds load_stack(n: u8 = NUMBER)
                ["LDS"] Stack, needs 1, adds 1, Combines, flags NONE {
                    0x69..=0x69 (Level);
                }
            /// Compares two signed words and pushes the result.
            Ldw load_word(
                relation: Relation = NUMBER,
                in1: WordSource = IN.takes(Signed),
                in2: WordSource = IN.takes(Signed)
            )
                ["LDW"] Compare, needs 0, adds 1, Loads, flags NONE {
                    0xA0..=0xA5 (Relation, Word, Word);
                    0xB2..=0xB7 (Relation, Word, IntConst);
                    wide 0x00..=0x05 (Relation, AnyInt, AnyInt);
                }
            /// Compares two signed words and combines the result with the top of the stack by AND.
            Aw and_word(
                relation: Relation = NUMBER,
                in1: WordSource = IN.takes(Signed),
                in2: WordSource = IN.takes(Signed)
            )
                ["AW" "UW"] Compare, needs 1, adds 0, Ands, flags NONE {
                    0xA6..=0xAB (Relation, Word, Word);
                    0xB8..=0xBD (Relation, Word, IntConst);
                    wide 0x06..=0x0B (Relation, AnyInt, AnyInt);
                }
            /// Compares two signed words and combines the result with the top of the stack by OR.
            Ow or_word(
                relation: Relation = NUMBER,
                in1: WordSource = IN.takes(Signed),
                in2: WordSource = IN.takes(Signed)
            )
                ["OW"] Compare, needs 1, adds 0, Ors, flags NONE {
                    0xAC..=0xB1 (Relation, Word, Word);
                    0xBE..=0xC3 (Relation, Word, IntConst);
                    wide 0x0C..=0x11 (Relation, AnyInt, AnyInt);
                }
            /// Compares two unsigned bytes and pushes the result.
            Ldb load_byte(relation: Relation = NUMBER, in1: ByteSource = IN, in2: ByteSource = IN)
                ["LDB"] Compare, needs 0, adds 1, Loads, flags NONE {
                    0xC4..=0xC9 (Relation, Byte, Byte);
                    0xD6..=0xDB (Relation, Byte, ByteConst);
                    wide 0x12..=0x17 (Relation, AnyByte, AnyByte);
                }
            /// Compares two unsigned bytes and combines the result with the top of the stack by
            /// AND.
            Ab and_byte(relation: Relation = NUMBER, in1: ByteSource = IN, in2: ByteSource = IN)
                ["AB" "UB"] Compare, needs 1, adds 0, Ands, flags NONE {
                    0xCA..=0xCF (Relation, Byte, Byte);
                    0xDC..=0xE1 (Relation, Byte, ByteConst);
                    wide 0x18..=0x1D (Relation, AnyByte, AnyByte);
                }
            /// Compares two unsigned bytes and combines the result with the top of the stack by OR.
            Ob or_byte(relation: Relation = NUMBER, in1: ByteSource = IN, in2: ByteSource = IN)
                ["OB"] Compare, needs 1, adds 0, Ors, flags NONE {
                    0xD0..=0xD5 (Relation, Byte, Byte);
                    0xE2..=0xE7 (Relation, Byte, ByteConst);
                    wide 0x1E..=0x23 (Relation, AnyByte, AnyByte);
                }
            /// Copies a byte.
            Movb move_byte(input: ByteSource = IN, out: u16 = OUT)
                ["MOVB"] Move, needs 1, adds 0, Boxed, flags NONE {
                    0x78..=0x78 (Byte, ByteOut);
                    0x79..=0x79 (ByteConst, ByteOut);
                }
            /// Copies a word.
            Movw move_word(input: WordSource = IN, out: u16 = OUT)
                ["MOVW"] Move, needs 1, adds 0, Boxed, flags NONE {
                    0x7A..=0x7A (Word, WordOut);
                    0x7B..=0x7B (WordConst, WordOut);
                }
            /// Adds integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
            AddInt add_int(in1: WordSource = IN.takes(Signed), out: u16 = UPDATE)
                ["+I"] Math, needs 1, adds 0, Boxed, flags RESULT {
                    0x80..=0x80 (Word, WordOut);
                    0x81..=0x81 (IntConst, WordOut);
                }
            /// Subtracts integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative.
            SubInt sub_int(in1: WordSource = IN.takes(Signed), out: u16 = UPDATE)
                ["-I"] Math, needs 1, adds 0, Boxed, flags RESULT {
                    0x82..=0x82 (Word, WordOut);
                    0x83..=0x83 (IntConst, WordOut);
                }
            /// Multiplies integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative; SM1.3 becomes 0.
            MulInt mul_int(in1: WordSource = IN.takes(Signed), out: u16 = UPDATE)
                ["*I"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION {
                    0x84..=0x84 (Word, WordOut);
                    0x85..=0x85 (IntConst, WordOut);
                }
            /// Divides integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1 overflow,
            /// SM1.2 negative, SM1.3 division by zero.
            DivInt div_int(in1: WordSource = IN.takes(Signed), out: u16 = UPDATE)
                ["/I"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION {
                    0x86..=0x86 (Word, WordOut);
                    0x87..=0x87 (IntConst, WordOut);
                }
            /// Increments a word; 32767 wraps to -32768 and sets SM1.1. Sets SM1.0 zero, SM1.1
            /// overflow, SM1.2 negative.
            Incw increment_word(out: u16 = UPDATE)
                ["INCW"] Math, needs 1, adds 0, Boxed, flags RESULT {
                    0x88..=0x88 (WordOut);
                }
            /// Decrements a word; -32768 wraps to 32767 and sets SM1.1. Sets SM1.0 zero, SM1.1
            /// overflow, SM1.2 negative.
            Decw decrement_word(out: u16 = UPDATE)
                ["DECW"] Math, needs 1, adds 0, Boxed, flags RESULT {
                    0x89..=0x89 (WordOut);
                }
            /// On-delay timer: counts while power flows, its bit is 1 from the preset on; without
            /// power flow bit and current value are 0.
            Ton on_delay(timer: u8 = NUMBER, pt: WordSource = IN)
                ["TON"] Timer, needs 1 ("IN"), adds 0, Drives, flags NONE {
                    0x90..=0x90 (TimerSlot, Word);
                    0x91..=0x91 (TimerSlot, IntConst);
                }
            /// Off-delay timer: its bit is 1 with power flow and until the preset has passed
            /// without it.
            Tof off_delay(timer: u8 = NUMBER, pt: WordSource = IN)
                ["TOF" "TOFF"] Timer, needs 1 ("IN"), adds 0, Drives, flags NONE {
                    0x92..=0x92 (TimerSlot, Word);
                    0x93..=0x93 (TimerSlot, IntConst);
                }
            /// Retentive on-delay timer: counts while power flows and holds bit and current value
            /// without it; only R resets it.
            Tonr retentive_on_delay(timer: u8 = NUMBER, pt: WordSource = IN)
                ["TONR"] Timer, needs 1 ("IN"), adds 0, Drives, flags NONE {
                    0x94..=0x94 (TimerSlot, Word);
                    0x95..=0x95 (TimerSlot, IntConst);
                }
            /// Count up: S1 counts on its rising edge, S0 resets; the bit is 1 from the preset on.
            /// Stops at 32767.
            Ctu count_up(counter: u8 = NUMBER, pv: WordSource = IN)
                ["CTU" "ZV"] Counter, needs 2 ("CU" "R"), adds 0, Drives, flags NONE {
                    0x98..=0x98 (CounterSlot, Word);
                    0x99..=0x99 (CounterSlot, IntConst);
                }
            /// Count down: S1 counts on its rising edge, S0 loads the preset; the bit is 1 at zero,
            /// where it stops.
            Ctd count_down(counter: u8 = NUMBER, pv: WordSource = IN)
                ["CTD" "ZR"] Counter, needs 2 ("CD" "LD"), adds 0, Drives, flags NONE {
                    0x9A..=0x9A (CounterSlot, Word);
                    0x9B..=0x9B (CounterSlot, IntConst);
                }
            /// Count up and down: S2 counts up, S1 counts down, S0 resets; the bit is 1 from the
            /// preset on. Wraps at the ends.
            Ctud count_up_down(counter: u8 = NUMBER, pv: WordSource = IN)
                ["CTUD" "ZVR"] Counter, needs 3 ("CU" "CD" "R"), adds 0, Drives, flags NONE {
                    0x9C..=0x9C (CounterSlot, Word);
                    0x9D..=0x9D (CounterSlot, IntConst);
                }
            /// Loop: INDX := INIT, then repeats what is before NEXT until INDX is greater than
            /// FINAL, adding 1 after each pass.
            For for_loop(
                indx: u16 = OUT,
                init: WordSource = IN,
                last: WordSource = IN,
                end: u16 = NUMBER
            )
                ["FOR"] Control, needs 1, adds 0, Boxed, flags NONE {
                    0x72..=0x72 (WordOut, AnyInt, AnyInt, LoopEnd);
                }
            /// Closes the innermost FOR. The top of the stack is 1 afterwards.
            Next next_pass(start: u16 = NUMBER, here: u16 = NUMBER)
                ["NEXT"] Control, needs 0, adds 0, Drives, flags NONE {
                    0x73..=0x73 (LoopStart, Here);
                }
            /// Jumps to the label. The top of the stack is 1 after a taken jump.
            Jmp jump(label: u16 = NUMBER, here: u16 = NUMBER)
                ["JMP"] Control, needs 1, adds 0, Boxed, flags NONE {
                    0x70..=0x70 (LabelIndex, Here);
                }
            /// Label: where JMP with the same number goes.
            Lbl label(n: u16 = NUMBER)
                ["LBL"] Control, needs 0, adds 0, Drives, flags NONE {
                    0x71..=0x71 (LabelNumber);
                }
            /// Conditional end: ends the program for this scan.
            End end()
                ["END"] Control, needs 1, adds 0, Boxed, flags NONE {
                    0x74..=0x74 ();
                }
            /// Changes from RUN to STOP at once: outputs go off.
            Stop stop()
                ["STOP"] Control, needs 1, adds 0, Boxed, flags NONE {
                    0x75..=0x75 ();
                }
            /// Watchdog reset: gives the scan its full watchdog time again.
            Wdr watchdog_reset()
                ["WDR"] Control, needs 1, adds 0, Boxed, flags NONE {
                    0x76..=0x76 ();
                }
            /// Load SCR: marks the start of a sequence segment and pushes its S bit, which powers
            /// the segment.
            Lscr load_scr(bit: Bit = IN, scr: Bit = OUT)
                ["LSCR"] Sequence, needs 0, adds 1, Drives, flags NONE {
                    0x57..=0x57 (FarBit, ScrBit);
                }
            /// Within a segment: combines what was loaded with the segment's SCR bit by AND.
            ScrAnd and_scr(scr: Bit = IN)
                [] Hidden, needs 1, adds 0, Combines, flags NONE {
                    0x58..=0x58 (FarBit);
                }
            /// SCR transition: sets the S bit of the next segment and resets that of this one.
            Scrt scr_transition(bit: Bit = OUT, own: Bit = OUT)
                ["SCRT"] Sequence, needs 1, adds 0, Boxed, flags NONE {
                    0x59..=0x59 (FarBitOut, ScrBit);
                }
            /// SCR end: the end of a sequence segment.
            Scre scr_end()
                ["SCRE"] Sequence, needs 0, adds 0, Drives, flags NONE {
                    0x5A..=0x5A ();
                }
            /// Conditional SCR end: leaves the segment. The top of the stack is 1 afterwards.
            Cscre conditional_scr_end(label: u16 = NUMBER, here: u16 = NUMBER)
                ["CSCRE"] Sequence, needs 1, adds 0, Boxed, flags NONE {
                    0x8A..=0x8A (SegmentEnd, Here);
                }
            /// Before a call with parameters: jumps after it without power flow.
            CallBegin begin_call(end: u16 = NUMBER)
                [] Hidden, needs 1, adds 0, Drives, flags NONE {
                    0x5C..=0x5C (CallEnd);
                }
            /// Copies a bit parameter.
            BitCopy copy_bit(bit: Bit = IN, out: Bit = OUT)
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x5D..=0x5D (FarBit, FarBitOut);
                }
            /// Calls a subroutine. It begins with a logic stack of its own, whose top is 1; the
            /// caller's comes back with the return.
            Call call(routine: u8 = NUMBER, here: u16 = NUMBER)
                ["CALL"] Call, needs 1, adds 0, Boxed, flags NONE {
                    0x5E..=0x5E (Routine, Here);
                }
            /// Return, after the last instruction of a routine.
            Ret return_()
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x5F..=0x5F ();
                }
            /// Conditional return from a subroutine.
            Cret conditional_return()
                ["CRET"] Call, needs 1, adds 0, Boxed, flags NONE {
                    0x6B..=0x6B ();
                }
            /// Conditional return from an interrupt routine.
            Creti conditional_return_from_interrupt()
                ["CRETI"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x6C..=0x6C ();
                }
            /// Executes the interrupt routines of the events that have occurred.
            Poll poll_events(here: u16 = NUMBER)
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x6D..=0x6D (Here);
                }
            /// Attach interrupt: the event EVNT executes the interrupt routine INT from now on.
            Atch attach(int: u8 = NUMBER, evnt: u8 = NUMBER)
                ["ATCH"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x6E..=0x6E (Routine, Event);
                }
            /// Detach interrupt: the event EVNT executes nothing any more.
            Dtch detach(evnt: u8 = NUMBER)
                ["DTCH"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x6F..=0x6F (Event);
                }
            /// Clear event: forgets the events EVNT that wait for their interrupt routine.
            Cevnt clear_event(evnt: u8 = NUMBER)
                ["CEVNT" "CEVENT"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x7C..=0x7C (Event);
                }
            /// Enable interrupts: events execute their routines.
            Eni enable_interrupts()
                ["ENI"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x7D..=0x7D ();
                }
            /// Disable interrupts: events wait.
            Disi disable_interrupts()
                ["DISI"] Interrupt, needs 1, adds 0, Boxed, flags NONE {
                    0x7E..=0x7E ();
                }
            /// ENO of a box of the core, right at the box, where an AENO is elsewhere: the top of
            /// the stack, or 0 when SMB1 has one of the errors.
            NoteEno note_eno(errors: u8 = NUMBER)
                [] Hidden, needs 1, adds 0, Drives, flags NONE {
                    0x52..=0x52 (ErrorMask);
                }
            /// And ENO: combines the top of the stack with ENO of the last box by AND.
            Aeno and_eno(errors: u8 = NUMBER)
                ["AENO" "UENO"] Stack, needs 1, adds 0, Combines, flags NONE {
                    0x7F..=0x7F (ErrorMask);
                }
            /// Brings the 1 ms timers up to date, before an instruction that reads one.
            Refresh refresh_timers()
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x6A..=0x6A ();
                }
            /// Looks whether instructions shortly after are watched: then the program goes to them
            /// step by step.
            Approach approach()
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x51..=0x51 ();
                }
            /// End of the program, after the last instruction.
            MainEnd main_end()
                [] Hidden, needs 0, adds 0, Drives, flags NONE {
                    0x77..=0x77 ();
                }
        }
    };
}
pub(crate) use core_instructions;
