//! The kinds of operands, a row each. What the columns mean, kind.rs says; what the shapes are,
//! shape.rs.

/// Hands the rows to a macro: name, shape, what AWL has there, what is done with it, what the
/// loader's check allows.
macro_rules! kind_rows {
    ($last:ident !) => {
        // In groups that are stored alike: the board tells them apart by comparing numbers.
        $last! {
            /// A bit of the bit page, read: bit number in the token, page byte after it.
            PageBit: PageBit, Address, Reads(Bit), Areas(ALL);
            /// A bit of the bit page, written.
            PageBitOut: PageBit, Address, Writes(Bit), Areas(ALL);
            /// A bit of the bit page that a reset may write: no timer or counter, whose reset does
            /// more.
            PageBitReset: PageBit, Address, Writes(Bit), Areas(NO_NUMBERED);
            /// Any bit, read: (address - DATA_START) * 8 + bit as a word.
            FarBit: FarBit, Address, Reads(Bit), Areas(ALL);
            /// Any bit, written.
            FarBitOut: FarBit, Address, Writes(Bit), Areas(ALL);
            /// Any bit that a reset may write.
            FarBitReset: FarBit, Address, Writes(Bit), Areas(NO_NUMBERED);
            /// A byte, constant or address: mode byte, then a word.
            AnyByte: AnyByte, Value, Reads(Byte), Areas(ALL);
            /// A signed word, constant or address: mode byte, then a word.
            AnyInt: AnyWord, Value, Reads(Word), Areas(ALL);
            /// The address of a byte that is read.
            Byte: ByteAt, Address, Reads(Byte), Areas(ALL);
            /// The address of a word that is read.
            Word: WordAt, Address, Reads(Word), Areas(ALL);
            /// The address of a byte that is written.
            ByteOut: Address, Address, Writes(Byte), Areas(ALL);
            /// The address of a word that is written.
            WordOut: Address, Address, Writes(Word), Areas(ALL);
            /// A 16-bit constant: decimal -32768 to 65535.
            WordConst: WordConstant, Constant(-32768, 65535), Is, Any;
            /// A signed 16-bit constant: decimal -32768 to 32767.
            IntConst: WordConstant, Constant(-32768, 32767), Is, Any;
            /// Offset after the NEXT that closes a FOR; not written in AWL.
            LoopEnd: Offset, Hidden, Is, Any;
            /// Offset of the FOR that a NEXT closes; not written in AWL.
            LoopStart: Offset, Hidden, Is, Any;
            /// Offset after a call with parameters; not written in AWL.
            CallEnd: Offset, Hidden, Is, Any;
            /// The SCR bit of a unit, in its local memory, or the S bit of a segment; not written
            /// in AWL.
            ScrBit: FarBit, Hidden, Writes(Bit), Areas(ALL);
            /// A digital input of the board.
            InputPoint: FarBit, Input, Reads(Bit), Areas(INPUT);
            /// A digital output of the board.
            OutputPoint: FarBit, Output, Writes(Bit), Areas(OUTPUT);
            /// A byte that is read.
            ByteIn: Reference, Value, Reads(Byte), Areas(ALL);
            /// A word that is read.
            WordIn: Reference, Value, Reads(Word), Areas(ALL);
            /// A double word that is read.
            DoubleIn: Reference, Value, Reads(Double), Areas(ALL);
            /// A real that is read.
            RealIn: Reference, Value, Reads(Real), Areas(ALL);
            /// A string that is read.
            TextIn: Reference, Value, Reads(Text), Areas(ALL);
            /// The first of several bytes that are read.
            BytesAt: Reference, Address, Reads(Byte), Areas(ALL);
            /// The first of several words that are read.
            WordsAt: Reference, Address, Reads(Word), Areas(ALL);
            /// The first of several double words that are read.
            DoublesAt: Reference, Address, Reads(Double), Areas(ALL);
            /// A byte that is written, or the first of several.
            ByteTo: Reference, Address, Writes(Byte), Areas(ALL);
            /// A word that is written, or the first of several.
            WordTo: Reference, Address, Writes(Word), Areas(ALL);
            /// A double word that is written, or the first of several.
            DoubleTo: Reference, Address, Writes(Double), Areas(ALL);
            /// A real that is written.
            RealTo: Reference, Address, Writes(Real), Areas(ALL);
            /// A string that is written.
            TextTo: Reference, Address, Writes(Text), Areas(ALL);
            /// A byte constant.
            ByteConst: ByteConstant, Constant(0, 255), Is, Any;
            /// A constant count, 1 to 255.
            Count: ByteConstant, Constant(1, 255), Is, Count;
            /// The slot of a timer in the plan.
            TimerSlot: Number, Timer, Is, Planned(TIMERS_AT);
            /// The slot of a counter in the plan.
            CounterSlot: Number, Counter, Is, Planned(COUNTERS_AT);
            /// The number of a timer, T0 to T255.
            TimerNumber: Number, Timer, Is, Numbered;
            /// The number of a counter, C0 to C255.
            CounterNumber: Number, Counter, Is, Numbered;
            /// The number of an edge memory; not written in AWL.
            Edge: Number, Hidden, Is, Planned(EDGES_AT);
            /// A level of the logic stack, 0 to 8.
            Level: Number, Number(STACK_LEVELS - 1), Is, Level;
            /// A number without effect, 0 to 255.
            Number: Number, Number(255), Is, Any;
            /// A label as a jump names it: index into the label table.
            LabelIndex: Label, Label, Is, Planned(LABELS_AT);
            /// A label where it is: its number, 0 to 255.
            LabelNumber: Label, Label, Is, Any;
            /// A routine: its index in the table of routines.
            Routine: Number, Routine, Is, Planned(ROUTINES_AT);
            /// An interrupt event: its index in the table of events.
            Event: Number, Event, Is, Planned(EVENTS_AT);
            /// The number of a PID loop, 0 to 7.
            Loop: Number, Number(7), Is, Loop;
            /// What ENO follows from: bits of SMB1 that are errors of the box right before, for
            /// AENO bit 7 for the ENO that the last box left; not written in AWL.
            ErrorMask: Number, Hidden, Is, Any;
            /// The comparison in a byte of its own.
            RelationByte: RelationByte, Hidden, Is, Relation;
            /// The count 1: takes no room.
            One: One, Constant(1, 255), Is, Any;
            /// The comparison in a token.
            Relation: RelationInToken, Hidden, Is, Any;
            /// The instruction's own offset, for an executor that must know it; takes no room.
            Here: Here, Hidden, Is, Any;
            // The modules name kinds by their places: new ones come last.
            /// The end of a segment as CSCRE names it: index into the label table; not written in
            /// AWL.
            SegmentEnd: Label, Hidden, Is, Planned(LABELS_AT);
        }
    };
}
pub(crate) use kind_rows;
