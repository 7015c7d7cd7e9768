//! How many bytes of memory an operand stands for: what a count, a text or a table after an
//! address takes along.

use plc_isa::{Many, Written};

use crate::meaning::selected::{Argument, Selected, source_of};
use crate::text::address::Address;
use crate::text::ast::{Program, Value};

/// Most bits that a count at run time can reach, and those of a shift register.
const BITS_MAX: u16 = 255;
const REGISTER_MAX: u16 = 64;
/// Most characters of a real.
const REAL_LEN_MAX: u16 = 15;

/// Bytes from the first that an operand names, as far as the text tells; what only the running
/// program knows counts as one element.
pub(crate) fn extent(program: &Program, selected: &Selected, index: usize) -> u16 {
    let argument = selected.arguments[index];
    if let Argument::Bit(Address::Bit { bit, .. }) = argument {
        return (u16::from(bit) + bits(selected, index)).div_ceil(8);
    }
    if let Argument::Bit(_) = argument {
        return 0;
    }
    let element = match argument {
        Argument::Memory(Address::Double { .. }) => 4,
        Argument::Memory(Address::Word { .. }) => 2,
        _ => 1,
    };
    element * elements(program, selected, index)
}

/// How many bits an instruction can touch from its bit operand on: what a count at run time can
/// reach is part of the plan.
pub(crate) fn bits(selected: &Selected, index: usize) -> u16 {
    match selected.role(index).map_or(Many::One, |role| role.many) {
        Many::Counted(place) => known(selected, place).map_or(BITS_MAX, |count| count as u16),
        Many::Register(place) => {
            known(selected, place).map_or(REGISTER_MAX, |count| (count as i8).unsigned_abs().into())
        }
        Many::Elements(count) => count,
        Many::One | Many::Halved(_) | Many::Formatted(..) | Many::Text | Many::Copied(_) => 1,
        Many::Characters(_) | Many::Table | Many::Entries | Many::Open => 1,
    }
}

/// The constant that is the operand at a place of the text; `None`: only the running program knows.
pub(crate) fn known(selected: &Selected, place: u8) -> Option<i32> {
    match selected.arguments[usize::from(place)] {
        Argument::Literal(value) => Some(value),
        Argument::Constant(value) => Some(value.into()),
        _ => None,
    }
}

/// How many elements an operand stands for: where a format in memory decides, as many as it can ask
/// for; of what only the running program knows the first.
pub(crate) fn elements(program: &Program, selected: &Selected, index: usize) -> u16 {
    let count = |place: u8| known(selected, place).map_or(1, |count| count.clamp(1, 255) as u16);
    match selected.role(index).map_or(Many::One, |role| role.many) {
        Many::One | Many::Text | Many::Table | Many::Entries | Many::Open => 1,
        Many::Elements(count) => count,
        Many::Counted(place) => count(place),
        Many::Halved(place) => count(place).div_ceil(2),
        Many::Register(_) => 1,
        // The upper half of FMT; one that only the running program knows can ask for all.
        Many::Formatted(place, more) => {
            let characters = known(selected, place);
            more + characters.map_or(REAL_LEN_MAX, |format| format as u16 >> 4 & REAL_LEN_MAX)
        }
        Many::Copied(place) => 1 + text_len(program, selected, place.into()),
        Many::Characters(place) => 1 + count(place),
    }
    .max(1)
}

/// Characters of a text constant.
fn text_len(program: &Program, selected: &Selected, index: usize) -> u16 {
    let operand = source_of(program, selected).and_then(|source| source.operands.get(index));
    match operand.map(|operand| &operand.value) {
        Some(Value::Text(characters)) => characters.len() as u16,
        _ => 0,
    }
}

/// Whether an instruction reaches memory that only the running program knows: by pointers, tables,
/// texts and counts in memory.
pub(crate) fn is_open(selected: &Selected) -> bool {
    let roles = selected.op.instruction().written_roles();
    let operands = selected.arguments.iter().zip(roles).zip(selected.written_kinds());
    operands.into_iter().any(|((argument, role), kind)| {
        let is_memory = matches!(argument, Argument::Memory(_));
        match role.many {
            // Points of the board are not in V memory.
            Many::Counted(place) => {
                known(selected, place).is_none() && kind.written() != Written::Output
            }
            Many::Halved(place) | Many::Characters(place) => known(selected, place).is_none(),
            Many::Text => is_memory,
            Many::Table | Many::Entries | Many::Open => true,
            Many::One | Many::Elements(_) | Many::Register(_) => false,
            Many::Formatted(..) | Many::Copied(_) => false,
        }
    }) || selected.arguments.iter().any(|argument| matches!(argument, Argument::Indirect(_)))
}
