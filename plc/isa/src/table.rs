//! The instruction table: one entry per instruction, one line per encoded form. The only place that describes them.
//!
//! From it follow the enum [`Op`], the decoder, the encoder, the trait [`Execute`] that an engine
//! implements, the mnemonics of the assembler and disassembler, and docs/instructions.md. Tokens are
//! explicit because images outlive builds; `tests/tokens.txt` pins them a second time.

use crate::core_instructions::core_instructions;
use crate::image::ProgramMemory;
use crate::module_instructions::module_instructions;
use crate::modules::module_of_token;
use crate::operand::{
    Bit, ByteSource, Kind, MODE_MEMORY, OfRaw, Operand, OperandKind, OperandReader, Raw, Relation, WordSource, kinds,
};
use crate::reference::Operands;
use crate::tokens::{Fetched, OPERANDS_MAX};

/// The token that announces a second token byte.
pub const WIDE_PREFIX: u8 = 0xFE;
/// The token of module 0; those of the others follow. The routine of the module is the next byte.
pub const MODULE_PREFIX: u8 = 0xF0;

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
    /// Subroutines.
    Call,
    /// Sequence control.
    Sequence,
    /// Interrupt routines.
    Interrupt,
    /// Logic operations on bytes, words and double words.
    Logic,
    /// Shifts and rotations.
    Shift,
    /// Conversions.
    Conversion,
    /// Real numbers.
    Real,
    /// Character strings and ASCII.
    Text,
    /// Tables and blocks of memory.
    Table,
    /// Points of the board beside the process image, high-speed counters, pulses.
    InputOutput,
    /// Clock and serial line.
    Communication,
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
    /// The token before it: [`WIDE_PREFIX`] or that of a module.
    pub prefix: Option<u8>,
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
    )+ modules { $(
        $(#[doc = $module_doc:literal])+
        $module_op:ident ( $( $module_arg:ident ),* )
        [ $( $module_mnemonic:literal )* ] $module_group:ident, needs $module_needs:literal, adds $module_adds:literal, $module_flow:ident {
            $prefix:literal $routine:literal ( $( $module_kind:ident ),* );
        }
    )+ }) => {
        /// The instructions.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Op {
            $( $(#[doc = $doc])+ $op, )+
            $( $(#[doc = $module_doc])+ $module_op, )+
        }

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
                    $( Form { first_token: $first, last_token: $last, prefix: None, kinds: &[ $( Kind::$kind ),* ] }, )*
                    $( Form {
                        first_token: $wide_first,
                        last_token: $wide_last,
                        prefix: Some(WIDE_PREFIX),
                        kinds: &[ $( Kind::$wide_kind ),* ],
                    }, )*
                ],
            },
        )+ $(
            Instruction {
                op: Op::$module_op,
                doc: concat!($($module_doc),+),
                mnemonics: &[ $( $module_mnemonic ),* ],
                operand_names: &[ $( stringify!($module_arg) ),* ],
                group: Group::$module_group,
                stack: StackEffect { needs: $module_needs, adds: $module_adds },
                power_flow: PowerFlow::$module_flow,
                forms: &[
                    Form { first_token: $routine, last_token: $routine, prefix: Some($prefix), kinds: &[ $( Kind::$module_kind ),* ] },
                ],
            },
        )+ ];

        /// How many instructions the core has; those of modules stand behind them in the table.
        pub const CORE_INSTRUCTIONS: usize = [ $( Op::$op ),+ ].len();

        /// An engine: one method for each instruction, whatever its encoded form.
        pub trait Execute {
            /// Instructions that never come here, a bit each by [`Op`]: [`execute_compact`] leaves their arms out.
            const EXECUTED_ELSEWHERE: u128 = 0;

            $(
                $(#[doc = $doc])+
                fn $method(&mut self, $( $arg: $value ),*) -> Flow;
            )+
            /// An instruction of a module. `next` is the offset behind it.
            fn module_instruction(&mut self, op: Op, operands: &Operands) -> Flow;
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
                _ => execute_module(engine, code, pc),
            }
        }

        /// An instruction of a module, or none.
        #[inline(never)]
        fn execute_module<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let mut fetched = Fetched::NOTHING;
            if module_of_token(code.byte(pc)).is_none() || !fetched.fetch(code, pc) {
                return engine.undefined();
            }
            let flow = engine.module_instruction(fetched.op, &Operands::of(&fetched.operands));
            go_on(flow, fetched.next)
        }

        /// The same as [`execute`] in a tenth of the room and several times the cycles: operands are read by their
        /// kinds, as the decoder does, sources by their addresses, and there is one arm for an instruction instead of
        /// one for a form.
        pub fn execute_compact<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let mut fetched = Fetched::NOTHING;
            if !fetched.fetch(code, pc) {
                return engine.undefined();
            }
            for operand in &mut fetched.operands {
                if operand.tag != MODE_MEMORY {
                    continue;
                }
                match operand.kind() {
                    Some(Kind::Byte | Kind::AnyByte) => operand.value = u16::from(engine.byte_at(operand.value)),
                    Some(Kind::Word | Kind::AnyInt) => operand.value = engine.word_at(operand.value),
                    _ => {}
                }
            }
            let mut raw = RawOperands { raw: &fetched.operands, next: 0 };
            let flow = match fetched.op {
                $(
                    Op::$op if E::EXECUTED_ELSEWHERE >> Op::$op as u32 & 1 == 1 => engine.undefined(),
                    Op::$op => { $( let $arg = <$value>::of_value(raw.take()); )* engine.$method( $( $arg ),* ) }
                )+
                op => engine.module_instruction(op, &Operands::of(&fetched.operands)),
            };
            go_on(flow, fetched.next)
        }

        const _: () = assert!(CORE_INSTRUCTIONS <= 128, "sets of instructions are 128 bits");

        impl Op {
            /// The instruction of the core with this number in the order of the table.
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
        self.raw.get(self.next - 1).copied().unwrap_or(Raw::NONE)
    }
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn go_on(flow: Flow, next: u16) -> Flow {
    match flow {
        Flow::Next => Flow::Jump(next),
        other => other,
    }
}

core_instructions! { module_instructions ! instruction_table }

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
        let relations = |form: &Form| form.kinds.iter().any(|kind| matches!(kind, Kind::Relation | Kind::RelationByte));
        self.forms.iter().any(relations)
    }

    /// The module that executes the instruction on the board, by its number; `None` in the core.
    pub fn module(&self) -> Option<u8> {
        let prefix = self.forms.first()?.prefix?;
        (prefix != WIDE_PREFIX).then(|| prefix - MODULE_PREFIX)
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
        1 + u16::from(self.prefix.is_some()) + self.kinds.iter().map(|kind| u16::from(kind.stored_len())).sum::<u16>()
    }

    fn encode(&self, operands: &[Operand]) -> Option<Encoded> {
        let stored = || self.kinds.iter().copied().filter(|&kind| kind != Kind::Here);
        if stored().count() != operands.len() || !stored().zip(operands).all(|(kind, &operand)| kind.accepts(operand)) {
            return None;
        }
        let mut encoded = Encoded { bytes: [0; 16], len: 0 };
        if let Some(prefix) = self.prefix {
            encoded.push(&[prefix]);
        }
        let offset: u8 = stored().zip(operands).map(|(kind, &operand)| kind.token_offset(operand)).sum();
        encoded.push(&[self.first_token + offset]);
        for (kind, &operand) in stored().zip(operands) {
            encoded.push(&kind.stored(operand)[..usize::from(kind.stored_len())]);
        }
        Some(encoded)
    }
}
