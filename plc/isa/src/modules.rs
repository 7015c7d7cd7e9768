//! Modules: instructions whose machine code comes with the program. What the loader must know of their routines.
//!
//! The host executes them itself and takes this from the instruction table; the board finds the same in the module.

use crate::layout::DATA_END;
use crate::table::{CORE_INSTRUCTIONS, INSTRUCTIONS, Instruction, MODULE_PREFIX, Op};
use crate::tokens::packed;

/// How many modules there are.
pub const MODULES: usize = 13;
/// The modules' names, by their numbers.
pub const MODULE_NAMES: [&str; MODULES] = [
    "general",
    "real",
    "function",
    "text",
    "table",
    "inputs_outputs",
    "clock",
    "operands",
    "counters",
    "pulses",
    "freeport",
    "numerals",
    "pid",
];
/// The module of arithmetic with reals, which others call.
pub const REAL_MODULE: u8 = 1;
/// The module of functions.
pub const FUNCTION_MODULE: u8 = 2;
/// The module of the controller PID.
pub const PID_MODULE: u8 = 12;
/// The module that looks for interrupt events on the board.
pub const EVENTS_MODULE: u8 = 5;
/// Where in its jump table that begins: behind its routines.
pub const EVENTS_ENTRY: u8 = 12;
/// The module that all others need: it reads their operands.
pub const OPERANDS_MODULE: u8 = 7;
/// The high-speed counters. Behind its routines: what is done at edges of I0.0, of I0.1, of any input.
pub const COUNTERS_MODULE: u8 = 8;
/// Where these entries begin in its jump table.
pub const COUNTERS_ENTRY: u8 = 2;
/// The pulse and analog outputs. Behind its routines: what is done at the end of a cycle.
pub const PULSES_MODULE: u8 = 9;
/// Where this entry is in its jump table.
pub const PULSES_ENTRY: u8 = 2;
/// The freeport. Behind its routines: what is done when a character has come, when all are sent, and at its timer.
pub const FREEPORT_MODULE: u8 = 10;
/// Where these entries begin in its jump table.
pub const FREEPORT_ENTRY: u8 = 3;

/// The module that the first token of an instruction names, if it names one.
pub const fn module_of_token(token: u8) -> Option<u8> {
    let module = token.wrapping_sub(MODULE_PREFIX);
    if (module as usize) < MODULES { Some(module) } else { None }
}

/// The modules that a module calls, beside that of operands.
pub const fn needed_modules(module: u8) -> &'static [u8] {
    match module {
        // They compute with the operations of reals.
        FUNCTION_MODULE | PID_MODULE => &[REAL_MODULE],
        _ => &[],
    }
}

/// Bytes at the end of data memory that a program with this module leaves alone: the module's state, 32 bytes, and those of
/// modules behind it.
const fn state_len(module: u8) -> u16 {
    match module {
        EVENTS_MODULE => 32,
        COUNTERS_MODULE => 64,
        PULSES_MODULE => 96,
        FREEPORT_MODULE => 128,
        _ => 0,
    }
}

/// Where a module's state begins: one past the last data address of a program with this module.
pub const fn state_at(module: u8) -> u16 {
    DATA_END - state_len(module)
}

/// One past the last data address of a program with these modules.
pub fn data_end(modules: impl Iterator<Item = u8>) -> u16 {
    modules.map(state_at).min().unwrap_or(DATA_END)
}

/// Bytes of a module before its jump table: its length, the offset of the table, bytes at the end of data memory that the
/// program leaves alone, routines.
pub const MODULE_HEAD_LEN: u16 = 6;

/// Kinds of module routines are asked for at [`ProgramMemory::kind`](crate::ProgramMemory::kind) from here on.
pub(crate) const MODULE_KINDS_AT: u16 = 0x8000;

/// What decoding needs of a module's routine.
#[derive(Debug, Clone, Copy)]
pub struct Routine {
    /// The instruction. On the board, where nobody asks, any of the modules.
    pub op: Op,
    /// Its effect on the stack, packed as in the token table.
    pub stack: u8,
    /// Where its kinds stand for [`ProgramMemory::kind`](crate::ProgramMemory::kind), a 0 behind the last.
    pub kinds_at: u16,
}

/// The instructions of a module in the order of their routines.
pub fn module_instructions(module: u8) -> impl Iterator<Item = &'static Instruction> {
    INSTRUCTIONS.iter().skip(CORE_INSTRUCTIONS).filter(move |instruction| instruction.module() == Some(module))
}

/// What a module says of an instruction's operands: their kinds as bytes, a 0 behind the last.
pub fn kind_numbers(instruction: &Instruction) -> impl Iterator<Item = u8> {
    let kinds = instruction.forms.first().map_or(&[][..], |form| form.kinds);
    kinds.iter().map(|kind| kind.number()).chain([0])
}

/// What a module says of an instruction's effect on the stack.
pub fn packed_stack(instruction: &Instruction) -> u8 {
    packed(instruction.stack)
}

/// Bytes of a routine's kinds on the host: operands and the 0.
const KINDS_LEN: u16 = 8;

/// Most routines of a module.
pub const ROUTINES_MAX: usize = 80;

/// For every module and routine the instruction's place in the table; 0: there is none.
const PLACES: [[u8; ROUTINES_MAX]; MODULES] = {
    let (mut places, mut index) = ([[0; ROUTINES_MAX]; MODULES], CORE_INSTRUCTIONS);
    while index < INSTRUCTIONS.len() {
        let form = &INSTRUCTIONS[index].forms[0];
        if let Some(prefix) = form.prefix {
            places[(prefix - MODULE_PREFIX) as usize][form.first_token as usize] = index as u8;
        }
        index += 1;
    }
    places
};

/// The routine of a module in the instruction table.
pub(crate) fn routine(module: u8, routine: u8) -> Option<Routine> {
    let index = usize::from(*PLACES.get(usize::from(module))?.get(usize::from(routine))?);
    let instruction = INSTRUCTIONS.get(index).filter(|_| index != 0)?;
    let kinds_at = MODULE_KINDS_AT + KINDS_LEN * (index - CORE_INSTRUCTIONS) as u16;
    Some(Routine { op: instruction.op, stack: packed(instruction.stack), kinds_at })
}

/// The byte at an offset of the modules' kinds.
pub(crate) fn kind_byte(offset: u16) -> u8 {
    let index = CORE_INSTRUCTIONS + usize::from(offset / KINDS_LEN);
    let kinds =
        INSTRUCTIONS.get(index).and_then(|instruction| instruction.forms.first()).map_or(&[][..], |form| form.kinds);
    kinds.get(usize::from(offset % KINDS_LEN)).map_or(0, |kind| kind.number())
}
