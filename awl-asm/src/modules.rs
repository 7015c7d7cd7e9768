//! The machine code of modules, as it is put into images. Made from `firmware/modules` by `cargo xtask modules`.

use plc_isa::MODULES;

/// The modules in the order of their numbers; empty where there is none yet.
static BLOBS: [&[u8]; MODULES] = [
    include_bytes!("../modules/general.bin"),
    include_bytes!("../modules/real.bin"),
    include_bytes!("../modules/function.bin"),
    include_bytes!("../modules/text.bin"),
    include_bytes!("../modules/table.bin"),
    include_bytes!("../modules/inputs_outputs.bin"),
    include_bytes!("../modules/communication.bin"),
    include_bytes!("../modules/operands.bin"),
];

/// The bytes of a module as they stand in an image; `None` if the board does not have it yet.
pub fn bytes(module: u8) -> Option<&'static [u8]> {
    BLOBS.get(usize::from(module)).copied().filter(|bytes| !bytes.is_empty())
}

/// Offset of the jump table in a module's bytes.
pub fn jump_table_at(bytes: &[u8]) -> u16 {
    match bytes {
        [_, _, _, _, low, high, ..] => u16::from_le_bytes([*low, *high]),
        _ => 0,
    }
}
