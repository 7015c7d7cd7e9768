//! The instruction table: one entry per instruction, one line per encoded form. The only place that describes them.
//!
//! From it follow the enum [`Op`], the decoder, the encoder, the trait [`Execute`] that an engine
//! implements, the mnemonics of the assembler and disassembler, and docs/instructions.md. Tokens are
//! explicit because images outlive builds; `tests/tokens.txt` pins them a second time.

use crate::image::ProgramMemory;
use crate::operand::{
    Bit, ByteSource, Kind, MODE_MEMORY, OfRaw, Operand, OperandKind, OperandReader, Raw, Relation, WordSource, kinds,
};
use crate::tokens::{Fetched, OPERANDS_MAX};

/// The token that announces a second token byte.
pub const WIDE_PREFIX: u8 = 0xFE;

/// Chapter of the manual an instruction belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Group {
    /// Contacts: operate on the logic stack only.
    Contact,
    /// Coils: write bits.
    Coil,
    /// Logic stack operations.
    Stack,
    /// Comparisons.
    Compare,
    /// Integer arithmetic.
    Math,
    /// Moves.
    Move,
    /// Timers.
    Timer,
    /// Counters.
    Counter,
    /// Program control.
    Control,
    /// Put in by the assembler, not written in AWL.
    Hidden,
}

/// Whether the top of the stack decides if an instruction is executed (reference 1.0).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PowerFlow {
    /// Executed whatever the top of the stack is.
    Always,
    /// A box: executed only with power flow, which it keeps.
    Needed,
}

/// What an instruction asks of the logic stack and does to its depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StackEffect {
    /// Values that must be on the stack. `LDS n` needs `n` more than stands here.
    pub needs: u8,
    /// Values added; negative: removed.
    pub adds: i8,
}

/// How an instruction can be encoded.
#[derive(Debug)]
pub struct Form {
    /// The first token, for the operands whose share of the token is 0.
    pub first_token: u8,
    /// The last token.
    pub last_token: u8,
    /// Whether [`WIDE_PREFIX`] stands before the token.
    pub wide: bool,
    /// The operands, in the order of the AWL text; those not written in AWL come last.
    pub kinds: &'static [Kind],
}

/// An entry of the instruction table.
#[derive(Debug)]
pub struct Instruction {
    /// Which instruction.
    pub op: Op,
    /// What it does, in a sentence or two.
    pub doc: &'static str,
    /// The international mnemonic first, then German and other spellings. Comparisons carry no relation here.
    pub mnemonics: &'static [&'static str],
    /// The operands' names, parallel to the kinds of each form.
    pub operand_names: &'static [&'static str],
    /// Its chapter.
    pub group: Group,
    /// Its effect on the logic stack.
    pub stack: StackEffect,
    /// Whether it needs power flow.
    pub power_flow: PowerFlow,
    /// Encoded forms, the shortest first: the encoder takes the first that fits.
    pub forms: &'static [Form],
}

/// What an engine does after an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Goes on with the next instruction.
    Next,
    /// Goes on at this code offset.
    Jump(u16),
    /// Leaves the program. Why, the engine knows.
    Leave,
}

macro_rules! instruction_table {
    ($(
        $(#[doc = $doc:literal])+
        $op:ident $method:ident ( $( $arg:ident : $value:ty ),* )
        [ $( $mnemonic:literal )* ] $group:ident, needs $needs:literal, adds $adds:literal, $flow:ident {
            $( $first:literal ..= $last:literal ( $( $kind:ident ),* ); )*
            $( wide $wide_first:literal ..= $wide_last:literal ( $( $wide_kind:ident ),* ); )*
        }
    )+) => {
        /// The instructions.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Op { $( $(#[doc = $doc])+ $op, )+ }

        /// The instruction table. For tools on the host: on the board it would cost SRAM.
        pub const INSTRUCTIONS: &[Instruction] = &[ $(
            Instruction {
                op: Op::$op,
                doc: concat!($($doc),+),
                mnemonics: &[ $( $mnemonic ),* ],
                operand_names: &[ $( stringify!($arg) ),* ],
                group: Group::$group,
                stack: StackEffect { needs: $needs, adds: $adds },
                power_flow: PowerFlow::$flow,
                forms: &[
                    $( Form { first_token: $first, last_token: $last, wide: false, kinds: &[ $( Kind::$kind ),* ] }, )*
                    $( Form { first_token: $wide_first, last_token: $wide_last, wide: true, kinds: &[ $( Kind::$wide_kind ),* ] }, )*
                ],
            },
        )+ ];

        /// An engine: one method for each instruction, whatever its encoded form.
        pub trait Execute {
            /// Instructions that never come here, a bit each by [`Op`]: [`execute_compact`] leaves their arms out.
            const EXECUTED_ELSEWHERE: u128 = 0;

            $(
                $(#[doc = $doc])+
                fn $method(&mut self, $( $arg: $value ),*) -> Flow;
            )+
            /// The byte at a data address.
            fn byte_at(&self, address: u16) -> u8;
            /// The word at a data address.
            fn word_at(&self, address: u16) -> u16;
            /// A token that is not in the table. The loader's check keeps it out of valid images.
            fn undefined(&mut self) -> Flow;
        }

        /// Executes the instruction at offset `pc`. Never returns [`Flow::Next`]: that has become a jump.
        #[cfg_attr(not(target_arch = "avr"), inline(always))]
        pub fn execute<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let token = code.byte(pc);
            match token {
                $( $( $first..=$last => {
                    #[allow(unused_mut)]
                    let mut reader = OperandReader::new(code, pc, pc.wrapping_add(1), token - $first);
                    let flow = engine.$method( $( kinds::$kind::read(&mut reader) ),* );
                    go_on(flow, reader.position())
                } )* )+
                WIDE_PREFIX => {
                    let token = code.byte(pc.wrapping_add(1));
                    match token {
                        $( $( $wide_first..=$wide_last => {
                            let mut reader = OperandReader::new(code, pc, pc.wrapping_add(2), token - $wide_first);
                            let flow = engine.$method( $( kinds::$wide_kind::read(&mut reader) ),* );
                            go_on(flow, reader.position())
                        } )* )+
                        _ => engine.undefined(),
                    }
                }
                _ => engine.undefined(),
            }
        }

        /// The same as [`execute`] in a tenth of the room and several times the cycles: operands are read by their
        /// kinds, as the decoder does, sources by their addresses, and there is one arm for an instruction instead of
        /// one for a form.
        pub fn execute_compact<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let mut fetched = Fetched::nothing();
            if !fetched.fetch(code, pc) {
                return engine.undefined();
            }
            for (operand, kind) in fetched.operands.iter_mut().zip(&fetched.kinds) {
                let Some(kind) = kind else { break };
                if operand.tag != MODE_MEMORY {
                    continue;
                }
                match kind {
                    Kind::Byte | Kind::AnyByte => operand.value = u16::from(engine.byte_at(operand.value)),
                    Kind::Word | Kind::AnyInt => operand.value = engine.word_at(operand.value),
                    _ => {}
                }
            }
            let mut raw = RawOperands { raw: &fetched.operands, next: 0 };
            let flow = match fetched.op {
                $(
                    Op::$op if E::EXECUTED_ELSEWHERE >> Op::$op as u32 & 1 == 1 => engine.undefined(),
                    Op::$op => { $( let $arg = <$value>::of_value(raw.take()); )* engine.$method( $( $arg ),* ) }
                )+
            };
            go_on(flow, fetched.next)
        }

        const _: () = assert!(INSTRUCTIONS.len() <= 128, "sets of instructions are 128 bits");

        impl Op {
            /// The instruction with this number in the order of the table.
            pub(crate) fn of_number(number: u8) -> Option<Op> {
                $( if number == Op::$op as u8 { return Some(Op::$op); } )+
                None
            }
        }
    };
}

/// Hands out the operands of an instruction in order.
struct RawOperands<'a> {
    raw: &'a [Raw; OPERANDS_MAX],
    next: usize,
}

impl RawOperands<'_> {
    #[inline(always)]
    fn take(&mut self) -> Raw {
        self.next += 1;
        self.raw.get(self.next - 1).copied().unwrap_or(Raw::ZERO)
    }
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn go_on(flow: Flow, next: u16) -> Flow {
    match flow {
        Flow::Next => Flow::Jump(next),
        other => other,
    }
}

instruction_table! {
    /// Load: pushes the bit onto the logic stack.
    Ld load(bit: Bit) ["LD"] Contact, needs 0, adds 1, Always {
        0x00..=0x07 (PageBit);
        0x48..=0x48 (FarBit);
    }
    /// Load Not: pushes the inverted bit onto the logic stack.
    Ldn load_not(bit: Bit) ["LDN"] Contact, needs 0, adds 1, Always {
        0x08..=0x0F (PageBit);
        0x49..=0x49 (FarBit);
    }
    /// And: combines the bit with the top of the stack.
    A and(bit: Bit) ["A" "U"] Contact, needs 1, adds 0, Always {
        0x10..=0x17 (PageBit);
        0x4A..=0x4A (FarBit);
    }
    /// And Not: combines the inverted bit with the top of the stack.
    An and_not(bit: Bit) ["AN" "UN"] Contact, needs 1, adds 0, Always {
        0x18..=0x1F (PageBit);
        0x4B..=0x4B (FarBit);
    }
    /// Or: combines the bit with the top of the stack.
    O or(bit: Bit) ["O"] Contact, needs 1, adds 0, Always {
        0x20..=0x27 (PageBit);
        0x4C..=0x4C (FarBit);
    }
    /// Or Not: combines the inverted bit with the top of the stack.
    On or_not(bit: Bit) ["ON"] Contact, needs 1, adds 0, Always {
        0x28..=0x2F (PageBit);
        0x4D..=0x4D (FarBit);
    }
    /// Inverts the top of the stack.
    Not not() ["NOT"] Contact, needs 1, adds 0, Always {
        0x60..=0x60 ();
    }
    /// Edge Up: the top of the stack becomes 1 for one execution when it rose from 0 to 1 since the last one.
    Eu edge_up(edge: u8) ["EU"] Contact, needs 1, adds 0, Always {
        0x61..=0x61 (Edge);
    }
    /// Edge Down: the top of the stack becomes 1 for one execution when it fell from 1 to 0 since the last one.
    Ed edge_down(edge: u8) ["ED"] Contact, needs 1, adds 0, Always {
        0x62..=0x62 (Edge);
    }
    /// Output: copies the top of the stack to the bit.
    Assign assign(bit: Bit) ["="] Coil, needs 1, adds 0, Always {
        0x30..=0x37 (PageBitOut);
        0x4E..=0x4E (FarBitOut);
    }
    /// Set: sets N consecutive bits.
    Set set(bit: Bit, n: ByteSource) ["S"] Coil, needs 1, adds 0, Needed {
        0x38..=0x3F (PageBitOut, One);
        0x4F..=0x4F (FarBitOut, Count);
        0x51..=0x51 (FarBitOut, Byte);
    }
    /// Reset: resets N consecutive bits.
    Reset reset(bit: Bit, n: ByteSource) ["R"] Coil, needs 1, adds 0, Needed {
        0x40..=0x47 (PageBitReset, One);
        0x50..=0x50 (FarBitReset, Count);
        0x52..=0x52 (FarBitReset, Byte);
    }
    /// Reset timers: bit and current value of N consecutive timers become 0.
    ResetTimers reset_timers(first: u8, n: ByteSource) ["R"] Coil, needs 1, adds 0, Needed {
        0x53..=0x53 (TimerNumber, Count);
        0x54..=0x54 (TimerNumber, Byte);
    }
    /// Reset counters: bit and current value of N consecutive counters become 0.
    ResetCounters reset_counters(first: u8, n: ByteSource) ["R"] Coil, needs 1, adds 0, Needed {
        0x55..=0x55 (CounterNumber, Count);
        0x56..=0x56 (CounterNumber, Byte);
    }
    /// No operation; the number has no effect.
    Nop no_operation(n: u8) ["NOP"] Contact, needs 0, adds 0, Always {
        0x63..=0x63 (Number);
    }
    /// And Load: combines the two top levels with AND into one.
    Ald and_load() ["ALD"] Stack, needs 2, adds -1, Always {
        0x64..=0x64 ();
    }
    /// Or Load: combines the two top levels with OR into one.
    Old or_load() ["OLD"] Stack, needs 2, adds -1, Always {
        0x65..=0x65 ();
    }
    /// Logic Push: pushes a copy of the top of the stack.
    Lps logic_push() ["LPS"] Stack, needs 1, adds 1, Always {
        0x66..=0x66 ();
    }
    /// Logic Read: copies the second level to the top of the stack.
    Lrd logic_read() ["LRD"] Stack, needs 2, adds 0, Always {
        0x67..=0x67 ();
    }
    /// Logic Pop: removes the top of the stack.
    Lpp logic_pop() ["LPP"] Stack, needs 2, adds -1, Always {
        0x68..=0x68 ();
    }
    /// Load Stack: pushes a copy of level n.
    Lds load_stack(n: u8) ["LDS"] Stack, needs 1, adds 1, Always {
        0x69..=0x69 (Level);
    }
    /// Compares two signed words and pushes the result.
    Ldw load_word(relation: Relation, in1: WordSource, in2: WordSource) ["LDW"] Compare, needs 0, adds 1, Always {
        0xA0..=0xA5 (Relation, Word, Word);
        0xB2..=0xB7 (Relation, Word, IntConst);
        wide 0x00..=0x05 (Relation, AnyInt, AnyInt);
    }
    /// Compares two signed words and combines the result with the top of the stack by AND.
    Aw and_word(relation: Relation, in1: WordSource, in2: WordSource) ["AW" "UW"] Compare, needs 1, adds 0, Always {
        0xA6..=0xAB (Relation, Word, Word);
        0xB8..=0xBD (Relation, Word, IntConst);
        wide 0x06..=0x0B (Relation, AnyInt, AnyInt);
    }
    /// Compares two signed words and combines the result with the top of the stack by OR.
    Ow or_word(relation: Relation, in1: WordSource, in2: WordSource) ["OW"] Compare, needs 1, adds 0, Always {
        0xAC..=0xB1 (Relation, Word, Word);
        0xBE..=0xC3 (Relation, Word, IntConst);
        wide 0x0C..=0x11 (Relation, AnyInt, AnyInt);
    }
    /// Compares two unsigned bytes and pushes the result.
    Ldb load_byte(relation: Relation, in1: ByteSource, in2: ByteSource) ["LDB"] Compare, needs 0, adds 1, Always {
        0xC4..=0xC9 (Relation, Byte, Byte);
        0xD6..=0xDB (Relation, Byte, ByteConst);
        wide 0x12..=0x17 (Relation, AnyByte, AnyByte);
    }
    /// Compares two unsigned bytes and combines the result with the top of the stack by AND.
    Ab and_byte(relation: Relation, in1: ByteSource, in2: ByteSource) ["AB" "UB"] Compare, needs 1, adds 0, Always {
        0xCA..=0xCF (Relation, Byte, Byte);
        0xDC..=0xE1 (Relation, Byte, ByteConst);
        wide 0x18..=0x1D (Relation, AnyByte, AnyByte);
    }
    /// Compares two unsigned bytes and combines the result with the top of the stack by OR.
    Ob or_byte(relation: Relation, in1: ByteSource, in2: ByteSource) ["OB"] Compare, needs 1, adds 0, Always {
        0xD0..=0xD5 (Relation, Byte, Byte);
        0xE2..=0xE7 (Relation, Byte, ByteConst);
        wide 0x1E..=0x23 (Relation, AnyByte, AnyByte);
    }
    /// Copies a byte.
    Movb move_byte(input: ByteSource, out: u16) ["MOVB"] Move, needs 1, adds 0, Needed {
        0x78..=0x78 (Byte, ByteOut);
        0x79..=0x79 (ByteConst, ByteOut);
    }
    /// Copies a word.
    Movw move_word(input: WordSource, out: u16) ["MOVW"] Move, needs 1, adds 0, Needed {
        0x7A..=0x7A (Word, WordOut);
        0x7B..=0x7B (WordConst, WordOut);
    }
    /// Adds integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
    AddInt add_int(in1: WordSource, out: u16) ["+I"] Math, needs 1, adds 0, Needed {
        0x80..=0x80 (Word, WordOut);
        0x81..=0x81 (IntConst, WordOut);
    }
    /// Subtracts integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
    SubInt sub_int(in1: WordSource, out: u16) ["-I"] Math, needs 1, adds 0, Needed {
        0x82..=0x82 (Word, WordOut);
        0x83..=0x83 (IntConst, WordOut);
    }
    /// Multiplies integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative; SM1.3 becomes 0.
    MulInt mul_int(in1: WordSource, out: u16) ["*I"] Math, needs 1, adds 0, Needed {
        0x84..=0x84 (Word, WordOut);
        0x85..=0x85 (IntConst, WordOut);
    }
    /// Divides integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative, SM1.3 division by zero.
    DivInt div_int(in1: WordSource, out: u16) ["/I"] Math, needs 1, adds 0, Needed {
        0x86..=0x86 (Word, WordOut);
        0x87..=0x87 (IntConst, WordOut);
    }
    /// Increments a word; 32767 wraps to -32768 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
    Incw increment_word(out: u16) ["INCW"] Math, needs 1, adds 0, Needed {
        0x88..=0x88 (WordOut);
    }
    /// Decrements a word; -32768 wraps to 32767 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
    Decw decrement_word(out: u16) ["DECW"] Math, needs 1, adds 0, Needed {
        0x89..=0x89 (WordOut);
    }
    /// On-delay timer: counts while power flows, its bit is 1 from the preset on; without power flow bit and current value are 0.
    Ton on_delay(timer: u8, pt: WordSource) ["TON"] Timer, needs 1, adds 0, Always {
        0x90..=0x90 (TimerSlot, Word);
        0x91..=0x91 (TimerSlot, IntConst);
    }
    /// Off-delay timer: its bit is 1 with power flow and until the preset has passed without it.
    Tof off_delay(timer: u8, pt: WordSource) ["TOF" "TOFF"] Timer, needs 1, adds 0, Always {
        0x92..=0x92 (TimerSlot, Word);
        0x93..=0x93 (TimerSlot, IntConst);
    }
    /// Retentive on-delay timer: counts while power flows and holds bit and current value without it; only R resets it.
    Tonr retentive_on_delay(timer: u8, pt: WordSource) ["TONR"] Timer, needs 1, adds 0, Always {
        0x94..=0x94 (TimerSlot, Word);
        0x95..=0x95 (TimerSlot, IntConst);
    }
    /// Count up: S1 counts on its rising edge, S0 resets; the bit is 1 from the preset on. Stops at 32767.
    Ctu count_up(counter: u8, pv: WordSource) ["CTU"] Counter, needs 2, adds 0, Always {
        0x98..=0x98 (CounterSlot, Word);
        0x99..=0x99 (CounterSlot, IntConst);
    }
    /// Count down: S1 counts on its rising edge, S0 loads the preset; the bit is 1 at zero, where it stops.
    Ctd count_down(counter: u8, pv: WordSource) ["CTD"] Counter, needs 2, adds 0, Always {
        0x9A..=0x9A (CounterSlot, Word);
        0x9B..=0x9B (CounterSlot, IntConst);
    }
    /// Count up and down: S2 counts up, S1 counts down, S0 resets; the bit is 1 from the preset on. Wraps at the ends.
    Ctud count_up_down(counter: u8, pv: WordSource) ["CTUD"] Counter, needs 3, adds 0, Always {
        0x9C..=0x9C (CounterSlot, Word);
        0x9D..=0x9D (CounterSlot, IntConst);
    }
    /// Loop: INDX := INIT, then repeats what stands before NEXT until INDX is greater than FINAL, adding 1 after each pass.
    For for_loop(indx: u16, init: WordSource, last: WordSource, end: u16) ["FOR"] Control, needs 1, adds 0, Needed {
        0x72..=0x72 (WordOut, AnyInt, AnyInt, LoopEnd);
    }
    /// Closes the innermost FOR. The top of the stack is 1 afterwards.
    Next next_pass(start: u16, here: u16) ["NEXT"] Control, needs 0, adds 0, Always {
        0x73..=0x73 (LoopStart, Here);
    }
    /// Jumps to the label. The top of the stack is 1 after a taken jump.
    Jmp jump(label: u8, here: u16) ["JMP"] Control, needs 1, adds 0, Needed {
        0x70..=0x70 (LabelIndex, Here);
    }
    /// Label: where JMP with the same number goes.
    Lbl label(n: u8) ["LBL"] Control, needs 0, adds 0, Always {
        0x71..=0x71 (LabelNumber);
    }
    /// Conditional end: ends the program for this scan.
    End end() ["END"] Control, needs 1, adds 0, Needed {
        0x74..=0x74 ();
    }
    /// Changes from RUN to STOP at once: outputs go off.
    Stop stop() ["STOP"] Control, needs 1, adds 0, Needed {
        0x75..=0x75 ();
    }
    /// Watchdog reset: gives the scan its full watchdog time again.
    Wdr watchdog_reset() ["WDR"] Control, needs 1, adds 0, Needed {
        0x76..=0x76 ();
    }
    /// Brings the 1 ms timers up to date, before an instruction that reads one.
    Refresh refresh_timers() [] Hidden, needs 0, adds 0, Always {
        0x6A..=0x6A ();
    }
    /// End of the program, behind the last instruction.
    MainEnd main_end() [] Hidden, needs 0, adds 0, Always {
        0x77..=0x77 ();
    }
}

impl Op {
    /// The instruction's entry in the table.
    pub fn instruction(self) -> &'static Instruction {
        // The table is generated in the order of the enum.
        &INSTRUCTIONS[self as usize]
    }
}

impl Instruction {
    /// The name in messages and listings.
    pub fn mnemonic(&self) -> &'static str {
        self.mnemonics.first().copied().unwrap_or("")
    }

    /// Whether the mnemonic is completed by a relation, as in `LDW>=`.
    pub fn has_relation(&self) -> bool {
        self.group == Group::Compare
    }

    /// Encodes the instruction in its first form that can hold the operands. The operands are those of
    /// the form's kinds in order, without [`Kind::Here`].
    pub fn encode(&self, operands: &[Operand]) -> Option<Encoded> {
        self.forms.iter().find_map(|form| form.encode(operands))
    }
}

/// The bytes of one instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Encoded {
    bytes: [u8; 16],
    len: u8,
}

impl Encoded {
    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..usize::from(self.len)]
    }

    fn push(&mut self, bytes: &[u8]) {
        let at = usize::from(self.len);
        self.bytes[at..at + bytes.len()].copy_from_slice(bytes);
        self.len += bytes.len() as u8;
    }
}

impl Form {
    /// Bytes of an instruction in this form.
    pub fn encoded_len(&self) -> u16 {
        1 + u16::from(self.wide) + self.kinds.iter().map(|kind| u16::from(kind.stored_len())).sum::<u16>()
    }

    fn encode(&self, operands: &[Operand]) -> Option<Encoded> {
        let stored = || self.kinds.iter().copied().filter(|&kind| kind != Kind::Here);
        if stored().count() != operands.len() || !stored().zip(operands).all(|(kind, &operand)| kind.accepts(operand)) {
            return None;
        }
        let mut encoded = Encoded { bytes: [0; 16], len: 0 };
        if self.wide {
            encoded.push(&[WIDE_PREFIX]);
        }
        let offset: u8 = stored().zip(operands).map(|(kind, &operand)| kind.token_offset(operand)).sum();
        encoded.push(&[self.first_token + offset]);
        for (kind, &operand) in stored().zip(operands) {
            encoded.push(&kind.stored(operand)[..usize::from(kind.stored_len())]);
        }
        Some(encoded)
    }
}
