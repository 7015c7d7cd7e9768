//! Modules: instructions whose machine code comes with the program. Which there are, what they
//! need, and what of data memory is theirs. Their routines are in routines.rs.

use crate::profile::{DATA_END, Profile};

/// The token of module 0; those of the others follow. The routine of the module is the next byte.
pub const MODULE_PREFIX: u8 = 0xF0;
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
/// Where in its jump table that begins: after its routines.
pub const EVENTS_ENTRY: u8 = 12;
/// The module that all others need: it reads their operands.
pub const OPERANDS_MODULE: u8 = 7;
/// The high-speed counters. After its routines: what is done at edges of I0.0, of I0.1, of any
/// input.
pub const COUNTERS_MODULE: u8 = 8;
/// Where these entries begin in its jump table.
pub const COUNTERS_ENTRY: u8 = 2;
/// The pulse and analog outputs. After its routines: what is done at the end of a cycle.
pub const PULSES_MODULE: u8 = 9;
/// Where this entry is in its jump table.
pub const PULSES_ENTRY: u8 = 2;
/// The freeport. After its routines: what is done when a character has come, when all are sent,
/// and at its timer.
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

/// Bytes at the end of data memory that a program with this module leaves alone: the module's
/// state, 32 bytes, and those of modules after it.
const fn state_len(module: u8) -> u16 {
    match module {
        EVENTS_MODULE => 32,
        COUNTERS_MODULE => 64,
        PULSES_MODULE => 96,
        FREEPORT_MODULE => 128,
        _ => 0,
    }
}

/// Where a module's state begins on the Uno: one past the last data address of a program with this
/// module.
pub const fn state_at(module: u8) -> u16 {
    DATA_END - state_len(module)
}

impl Profile {
    /// One past the last data address of a program with these modules.
    pub fn data_end_with(&self, modules: impl Iterator<Item = u8>) -> u16 {
        self.data_end - modules.map(state_len).max().unwrap_or(0)
    }
}

/// Bytes of a module before its jump table: its length, the offset of the table, bytes at the end
/// of data memory that the program leaves alone, routines.
pub const MODULE_HEAD_LEN: u16 = 6;
