//! How many bytes of memory an operand stands for: what a count, a text or a table behind an address takes along.

use plc_isa::Op;

use crate::address::Address;
use crate::ast::{Program, Value};
use crate::check::source_of;
use crate::select::{Argument, Selected};

/// Bytes of a loop table of PID.
const PID_TABLE: u16 = 36;
/// Bytes of a time.
const TIME: u16 = 8;
/// Most characters of a real.
const REAL_LEN_MAX: u16 = 15;

/// Bytes from the first that an operand names, as far as the text tells; what only the running program knows counts as
/// one element.
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

/// How many bits an instruction can touch from its bit operand on: what a count at run time can reach is part of the
/// plan.
fn bits(selected: &Selected, index: usize) -> u16 {
    match (selected.op, index, selected.arguments) {
        (Op::Set | Op::Reset, 0, [_, Argument::Constant(count), ..]) => count,
        (Op::SetAny | Op::ResetAny, 0, _) => 255,
        (Op::Shrb, 1, [_, _, Argument::Literal(count), _]) => (count as i8).unsigned_abs().into(),
        (Op::Shrb, 1, _) => 64,
        _ => 1,
    }
}

/// How many elements an operand stands for: where a format in memory decides, as many as it can ask for.
pub(crate) fn elements(program: &Program, selected: &Selected, index: usize) -> u16 {
    let literal = |place: usize| match selected.arguments[place] {
        Argument::Literal(count) => (count.clamp(1, 255)) as u16,
        _ => 1,
    };
    // The upper half of FMT; one that only the running program knows can ask for all.
    let characters = |place: usize| match selected.arguments[place] {
        Argument::Literal(format) => format as u16 >> 4 & REAL_LEN_MAX,
        _ => REAL_LEN_MAX,
    };
    match (selected.op, index) {
        (Op::Bmb | Op::Bmw | Op::Bmd, 0 | 1) | (Op::Fill, 1) => literal(2),
        (Op::Ath, 0) | (Op::Hta, 1) => literal(2),
        (Op::Ath, 1) | (Op::Hta, 0) => literal(2).div_ceil(2),
        (Op::Pid, 0) => PID_TABLE,
        (Op::Todr | Op::Todw, 0) => TIME,
        (Op::Ita, 1) => 8,
        (Op::Dta, 1) => 12,
        (Op::Rta, 1) => characters(2),
        (Op::Its, 2) => 1 + 8,
        (Op::Dts, 2) => 1 + 12,
        (Op::Rts, 2) => 1 + characters(1),
        (Op::Scpy, 1) => 1 + text_len(program, selected, 0),
        (Op::Sscpy, 3) => 1 + literal(2),
        _ => 1,
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

/// Whether an instruction reaches memory that only the running program knows: by pointers, tables, texts and counts in
/// memory.
pub(crate) fn is_open(selected: &Selected) -> bool {
    let arguments = &selected.arguments;
    let is_counted = |place: usize| !matches!(arguments[place], Argument::Literal(_));
    let has_memory = |place: usize| matches!(arguments[place], Argument::Memory(_));
    arguments.iter().any(|argument| matches!(argument, Argument::Indirect(_)))
        || match selected.op {
            Op::Att | Op::Fifo | Op::Lifo | Op::Fnd | Op::Scat | Op::Rcv | Op::Xmt => true,
            Op::Bmb | Op::Bmw | Op::Bmd | Op::Fill | Op::Ath | Op::Hta => is_counted(2),
            Op::SetAny | Op::ResetAny => true,
            Op::Scpy | Op::Slen | Op::Sti | Op::Std | Op::Str => has_memory(0),
            Op::Sscpy => has_memory(0) || is_counted(2),
            Op::Sfnd | Op::Cfnd | Op::LoadText | Op::AndText | Op::OrText => has_memory(0) || has_memory(1),
            _ => false,
        }
}
