//! The machine code of modules, as it is put into images, and which of it a program needs. Made
//! from `firmware/modules` by `cargo xtask modules`.

use plc_isa::{EVENTS_MODULE, Group, MODULES, OPERANDS_MODULE, needed_modules};

use crate::meaning::selected::Selected;
use crate::plan::takeover::Takeover;

/// The modules in the order of their numbers.
static BLOBS: [&[u8]; MODULES] = [
    include_bytes!("../../modules/general.bin"),
    include_bytes!("../../modules/real.bin"),
    include_bytes!("../../modules/function.bin"),
    include_bytes!("../../modules/text.bin"),
    include_bytes!("../../modules/table.bin"),
    include_bytes!("../../modules/inputs_outputs.bin"),
    include_bytes!("../../modules/clock.bin"),
    include_bytes!("../../modules/operands.bin"),
    include_bytes!("../../modules/counters.bin"),
    include_bytes!("../../modules/pulses.bin"),
    include_bytes!("../../modules/freeport.bin"),
    include_bytes!("../../modules/numerals.bin"),
    include_bytes!("../../modules/pid.bin"),
];

/// The bytes of a module as they stand in an image; none for a number that no module has.
pub fn bytes(module: u8) -> &'static [u8] {
    BLOBS.get(usize::from(module)).copied().unwrap_or(&[])
}

/// Offset of the jump table in a module's bytes: their first word.
pub fn jump_table_at(bytes: &[u8]) -> u16 {
    match bytes {
        [low, high, ..] => u16::from_le_bytes([*low, *high]),
        _ => 0,
    }
}

/// How many routines a module has: the byte before its jump table. The instructions after them are
/// missing on the board.
pub fn routines(module: u8) -> u8 {
    let bytes = bytes(module);
    usize::from(jump_table_at(bytes))
        .checked_sub(1)
        .and_then(|at| bytes.get(at).copied())
        .unwrap_or(0)
}

/// The numbers of the modules that a program needs on the board, by its instructions and whether it
/// has interrupts.
pub(crate) fn needed(
    code: &[&Selected],
    takeover: Takeover,
    has_interrupts: bool,
) -> [bool; MODULES] {
    let mut needed = [false; MODULES];
    let mut need = |module: u8| {
        for module in [module, OPERANDS_MODULE].iter().chain(needed_modules(module)) {
            if let Some(place) = needed.get_mut(usize::from(*module)) {
                *place = true;
            }
        }
    };
    let of_rows = code.iter().filter_map(|selected| selected.op.instruction().module());
    of_rows.chain(takeover.modules()).for_each(&mut need);
    // What has to do with events is not in a module, but what finds them on the board is.
    if has_interrupts
        || code.iter().any(|selected| selected.op.instruction().group == Group::Interrupt)
    {
        need(EVENTS_MODULE);
    }
    needed
}
