//! An instruction of the program as all later passes see it: its entry in the instruction table,
//! its operands, and where it is in the text. How it is found is said elsewhere.

use plc_isa::{Kind, Op, Relation, Role, Rung};

use crate::text::address::Address;
use crate::text::ast::{Instruction, Program, Span, Statement, UnitId};

/// An operand whose kind is settled, but not its place in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Argument {
    /// A bit, including those of timers and counters.
    Bit(Address),
    /// A byte, word or double word in memory; timers and counters stand for their current values.
    Memory(Address),
    /// What the pointer in this double word leads to.
    Indirect(Address),
    /// A bit, byte, word or double word in the local memory of another unit: a parameter in a call.
    Parameter(UnitId, Address),
    /// A constant of a core instruction as it is stored.
    Constant(u16),
    /// A constant of a module instruction, extended to a double word.
    Literal(i32),
    /// A real constant: the bits of an IEEE single.
    Real(u32),
    /// A text constant: the number of the operand that holds it.
    Text(u8),
    /// A pointer to this address as a constant.
    Pointer(Address),
    /// A level, count or other number.
    Number(u8),
    /// The number of a label.
    Label(u16),
    /// A timer that is started or reset.
    Timer(u8),
    /// A counter that counts or is reset.
    Counter(u8),
    /// A subroutine or interrupt routine.
    Routine(UnitId),
    /// An interrupt event.
    Event(u8),
    /// No operand.
    None,
}

/// Most operands that are in the text of an instruction.
pub const ARGUMENTS_MAX: usize = 4;

/// An instruction whose table entry is known.
#[derive(Debug, Clone, Copy)]
pub struct Selected {
    /// The instruction.
    pub op: Op,
    /// Its comparison, if it is one.
    pub relation: Option<Relation>,
    /// Its operands in the order of the text.
    pub arguments: [Argument; ARGUMENTS_MAX],
    /// The kinds of a form that takes them, those included that are not written.
    pub kinds: &'static [Kind],
    /// Which of them it writes through, a bit each.
    pub written: u8,
    /// Its number among the statements of the program.
    pub statement: u32,
    /// For what is copied for a call, or from where a pointer leads: the number of the operand of
    /// the text.
    pub parameter: Option<u8>,
}

impl Selected {
    /// The operands in use, with whether each is written through.
    pub fn arguments(&self) -> impl Iterator<Item = (Argument, bool)> + '_ {
        let in_use = self.arguments.iter().take_while(|&&argument| argument != Argument::None);
        in_use.enumerate().map(|(index, &argument)| (argument, self.written >> index & 1 != 0))
    }

    /// What the instruction does with an operand of the text.
    pub fn role(&self, index: usize) -> Option<Role> {
        self.op.instruction().written_roles().nth(index)
    }

    /// The kinds of the operands in use.
    pub fn written_kinds(&self) -> impl Iterator<Item = Kind> + '_ {
        self.kinds.iter().copied().filter(|kind| kind.is_written())
    }
}

/// The parsed instruction after a selected one.
pub(crate) fn source_of<'p>(program: &'p Program, selected: &Selected) -> Option<&'p Instruction> {
    match program.statements.get(selected.statement as usize) {
        Some(Statement::Instruction(instruction)) => Some(instruction),
        _ => None,
    }
}

/// Where an instruction is.
pub(crate) fn span_of(program: &Program, selected: &Selected) -> Span {
    source_of(program, selected).map(|instruction| instruction.span).unwrap_or_default()
}

/// Whether an instruction only combines values of the logic stack; after any other a load begins a
/// new rung.
pub(crate) fn is_contact(op: Op) -> bool {
    op.instruction().rung.is_contact()
}

/// Whether an instruction pushes a value of its own: what begins a rung, and what a segment powers.
pub(crate) fn is_load(op: Op) -> bool {
    op.instruction().rung == Rung::Loads
}

/// Where an operand of an instruction is.
pub(crate) fn operand_span(program: &Program, selected: &Selected, index: usize) -> Span {
    let index = selected.parameter.map_or(index, usize::from);
    source_of(program, selected)
        .and_then(|instruction| instruction.operands.get(index))
        .map(|operand| operand.span)
        .unwrap_or_default()
}
