//! The instruction table: one entry per instruction, one line per encoded form. The only place that
//! describes them.
//!
//! From it follow the enum [`Op`], the decoder, the encoder, the trait [`Execute`](crate::Execute)
//! that an engine implements, the mnemonics of the assembler and disassembler, and
//! docs/instructions.md. Tokens are explicit because images outlive builds; `tests/tokens.txt` pins
//! them a second time.

use crate::core_instructions::core_instructions;
use crate::kind::Kind;
use crate::module_instructions::module_instructions;
use crate::modules::MODULE_PREFIX;
use crate::operand::{Operand, Relation};
use crate::profile::Profile;
use crate::role::{IN, Many::*, NUMBER, OUT, Role, Takes, Takes::*, UPDATE, flags::*};

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

/// Whether the top of the stack decides if an instruction is executed (docs/s7-200.md 1.0).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PowerFlow {
    /// Executed whatever the top of the stack is.
    Always,
    /// A box: executed only with power flow, which it keeps.
    Needed,
}

/// How an instruction takes part in a rung.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rung {
    /// A contact that pushes a value: begins a rung, or a branch of one.
    Loads,
    /// A contact that is combined by AND: in series with what is before it.
    Ands,
    /// A contact that is combined by OR: parallel to what is before it.
    Ors,
    /// Only works on the logic stack.
    Combines,
    /// Does something whatever the power flow is: a load after it begins a new rung.
    Drives,
    /// A box, executed only with power flow, which it keeps: a load after it begins a new rung.
    Boxed,
}

impl Rung {
    /// Whether the instruction only combines values of the logic stack; after any other a load
    /// begins a new rung.
    pub const fn is_contact(self) -> bool {
        match self {
            Rung::Loads | Rung::Ands | Rung::Ors | Rung::Combines => true,
            Rung::Drives | Rung::Boxed => false,
        }
    }

    const fn power_flow(self) -> PowerFlow {
        match self {
            Rung::Boxed => PowerFlow::Needed,
            Rung::Loads | Rung::Ands | Rung::Ors | Rung::Combines => PowerFlow::Always,
            Rung::Drives => PowerFlow::Always,
        }
    }
}

/// What an instruction asks of the logic stack and does to its depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StackEffect {
    /// Values that must be on the stack. `LDS n` needs `n` more than is here.
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
    /// The international mnemonic first, then German and other spellings. Comparisons carry no
    /// relation here.
    pub mnemonics: &'static [&'static str],
    /// The operands' names, parallel to the kinds of each form.
    pub operand_names: &'static [&'static str],
    /// What it does with each operand.
    pub roles: &'static [Role],
    /// Its chapter.
    pub group: Group,
    /// Its effect on the logic stack.
    pub stack: StackEffect,
    /// The names of the values that it takes from the logic stack, the deepest first, as boxes
    /// have them for their inputs; none where the only one is EN.
    pub inputs: &'static [&'static str],
    /// How it takes part in a rung.
    pub rung: Rung,
    /// The bits of SMB1 that it sets or resets.
    pub flags: u8,
    /// Whether it needs power flow.
    pub power_flow: PowerFlow,
    /// Encoded forms, the shortest first: the encoder takes the first that fits.
    pub forms: &'static [Form],
}

macro_rules! instruction_table {
    ($(
        $(#[doc = $doc:literal])+
        $op:ident $method:ident ( $( $arg:ident : $value:ty = $role:expr ),* )
        [ $( $mnemonic:literal )* ] $group:ident,
        needs $needs:literal $( ( $( $input:literal )+ ) )?, adds $adds:literal, $rung:ident,
        flags $( $flag:ident )|+ {
            $( $first:literal ..= $last:literal ( $( $kind:ident ),* ); )*
            $( wide $wide_first:literal ..= $wide_last:literal ( $( $wide_kind:ident ),* ); )*
        }
    )+ modules { $(
        $(#[doc = $module_doc:literal])+
        $module_op:ident $prefix:literal $routine:literal
        ( $( $module_arg:ident : $module_kind:ident $module_role:expr ),* )
        [ $( $module_mnemonic:literal )* ] $module_group:ident,
        needs $module_needs:literal, adds $module_adds:literal, $module_rung:ident,
        flags $( $module_flag:ident )|+;
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
                roles: &[ $( $role ),* ],
                group: Group::$group,
                stack: StackEffect { needs: $needs, adds: $adds },
                inputs: &[ $( $( $input ),+ )? ],
                rung: Rung::$rung,
                power_flow: Rung::$rung.power_flow(),
                flags: $( $flag )|+,
                forms: &[
                    $( Form {
                        first_token: $first,
                        last_token: $last,
                        prefix: None,
                        kinds: &[ $( Kind::$kind ),* ],
                    }, )*
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
                roles: &[ $( $module_role ),* ],
                group: Group::$module_group,
                stack: StackEffect { needs: $module_needs, adds: $module_adds },
                inputs: &[],
                rung: Rung::$module_rung,
                power_flow: Rung::$module_rung.power_flow(),
                flags: $( $module_flag )|+,
                forms: &[Form {
                    first_token: $routine,
                    last_token: $routine,
                    prefix: Some($prefix),
                    kinds: &[ $( Kind::$module_kind ),* ],
                }],
            },
        )+ ];

        /// How many instructions the core has; those of modules are after them in the table.
        pub const CORE_INSTRUCTIONS: usize = [ $( Op::$op ),+ ].len();

        impl Op {
            /// The instruction of the core with this number in the order of the table.
            pub(crate) fn of_number(number: u8) -> Option<Op> {
                $( if number == Op::$op as u8 { return Some(Op::$op); } )+
                None
            }
        }
    };
}

core_instructions! { module_instructions ! instruction_table }

// The roles of a row are those of its kinds: there is one for each, and it writes where they do.
// Named inputs are all that it takes.
const _: () = {
    let mut index = 0;
    while index < INSTRUCTIONS.len() {
        let (roles, forms) = (INSTRUCTIONS[index].roles, INSTRUCTIONS[index].forms);
        let mut form = 0;
        let (inputs, needs) = (INSTRUCTIONS[index].inputs.len(), INSTRUCTIONS[index].stack.needs);
        assert!(inputs == needs as usize || inputs == 0 && needs <= 2);
        while form < forms.len() {
            let kinds = forms[form].kinds;
            assert!(kinds.len() == roles.len());
            let mut place = 0;
            while place < kinds.len() {
                assert!(kinds[place].is_output() == roles[place].writes());
                place += 1;
            }
            form += 1;
        }
        index += 1;
    }
};

impl Op {
    /// The instruction's entry in the table.
    pub fn instruction(self) -> &'static Instruction {
        // The table is generated in the order of the enum.
        &INSTRUCTIONS[self as usize]
    }

    /// Whether it is a box with ENO: all others leave the ENO of the last one alone.
    pub fn has_eno(self) -> bool {
        match self.instruction().group {
            Group::Control => self == Op::For,
            Group::Interrupt => matches!(self, Op::Atch | Op::Dtch | Op::Cevnt),
            Group::Call | Group::Sequence => false,
            // PID is executed without power flow, too: to remember that there was none.
            _ => self.instruction().power_flow == PowerFlow::Needed || self == Op::Pid,
        }
    }
}

impl Instruction {
    /// The name in messages and listings.
    pub fn mnemonic(&self) -> &'static str {
        self.mnemonics.first().copied().unwrap_or("")
    }

    /// Whether the mnemonic is completed by a relation, as in `LDW>=`.
    pub fn has_relation(&self) -> bool {
        let relations = |form: &Form| {
            form.kinds.iter().any(|kind| matches!(kind, Kind::Relation | Kind::RelationByte))
        };
        self.forms.iter().any(relations)
    }

    /// What it does with the operands that are in the AWL text.
    pub fn written_roles(&self) -> impl Iterator<Item = Role> {
        let kinds = self.forms.first().map_or(&[][..], |form| form.kinds);
        let written = kinds.iter().zip(self.roles).filter(|(kind, _)| kind.is_written());
        written.map(|(_, &role)| role)
    }

    /// The comparisons that it knows; none if it is no comparison.
    pub fn relations(&self) -> &'static [Relation] {
        let takes = |takes: Takes| self.roles.iter().any(|role| role.takes == takes);
        if takes(Equality) {
            &[Relation::Equal, Relation::NotEqual]
        } else if takes(Searched) {
            &[Relation::Equal, Relation::NotEqual, Relation::Less, Relation::Greater]
        } else if self.has_relation() {
            &Relation::ALL
        } else {
            &[]
        }
    }

    /// The module that executes the instruction on the board, by its number; `None` in the core.
    pub fn module(&self) -> Option<u8> {
        let prefix = self.forms.first()?.prefix?;
        (prefix != WIDE_PREFIX).then(|| prefix - MODULE_PREFIX)
    }

    /// Encodes the instruction for a profile in its first form that can hold the operands. The
    /// operands are those of the form's kinds in order, without [`Kind::Here`].
    pub fn encode(&self, operands: &[Operand], profile: &Profile) -> Option<Encoded> {
        self.forms.iter().find_map(|form| form.encode(operands, profile))
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
    /// Bytes of an instruction in this form, in narrow images.
    pub fn encoded_len(&self) -> u16 {
        1 + u16::from(self.prefix.is_some())
            + self.kinds.iter().map(|kind| u16::from(kind.stored_len())).sum::<u16>()
    }

    fn encode(&self, operands: &[Operand], profile: &Profile) -> Option<Encoded> {
        let stored = || self.kinds.iter().copied().filter(|&kind| kind != Kind::Here);
        if stored().count() != operands.len()
            || !stored().zip(operands).all(|(kind, &operand)| kind.accepts(operand))
        {
            return None;
        }
        let mut encoded = Encoded { bytes: [0; 16], len: 0 };
        if let Some(prefix) = self.prefix {
            encoded.push(&[prefix]);
        }
        let offset: u8 =
            stored().zip(operands).map(|(kind, &operand)| kind.shape().token_offset(operand)).sum();
        encoded.push(&[self.first_token + offset]);
        for (kind, &operand) in stored().zip(operands) {
            let len = usize::from(kind.stored_len_in(profile));
            encoded.push(&kind.shape().stored(operand, profile)[..len]);
        }
        Some(encoded)
    }
}
