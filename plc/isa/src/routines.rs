//! What the loader must know of the modules' routines.
//!
//! The host executes them itself and takes this from the instruction table; the board finds the
//! same in the module.

use crate::modules::{MODULE_PREFIX, MODULES};
use crate::table::{CORE_INSTRUCTIONS, INSTRUCTIONS, Instruction, Op};
use crate::token_table::packed;

/// Kinds of module routines are asked for at [`ProgramMemory::kind`](crate::ProgramMemory::kind)
/// from here on.
pub(crate) const MODULE_KINDS_AT: u16 = 0x8000;

/// What decoding needs of a module's routine.
#[derive(Debug, Clone, Copy)]
pub struct Routine {
    /// The instruction. On the board, where nobody asks, any of the modules.
    pub op: Op,
    /// Its effect on the stack, packed as in the token table.
    pub stack: u8,
    /// Where its kinds stand for [`ProgramMemory::kind`](crate::ProgramMemory::kind), a 0 after
    /// the last.
    pub kinds_at: u16,
}

/// The instructions of a module in the order of their routines.
pub fn module_instructions(module: u8) -> impl Iterator<Item = &'static Instruction> {
    INSTRUCTIONS
        .iter()
        .skip(CORE_INSTRUCTIONS)
        .filter(move |instruction| instruction.module() == Some(module))
}

/// What a module says of an instruction's operands: their kinds as bytes, a 0 after the last.
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
    let kinds = INSTRUCTIONS
        .get(index)
        .and_then(|instruction| instruction.forms.first())
        .map_or(&[][..], |form| form.kinds);
    kinds.get(usize::from(offset % KINDS_LEN)).map_or(0, |kind| kind.number())
}
