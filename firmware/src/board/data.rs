//! The data memory of the controller, at the addresses that programs name.

use plc_isa::DATA_START;
use plc_vm::Memory;

/// The data memory, cleared. Called once, by [`Board::take`](super::Board::take).
pub(super) fn take() -> &'static mut Memory {
    // SAFETY: the linker places nothing below DATA_END (build.rs), the type is 1,280 bytes for which every value is
    // valid, and the only caller comes here once.
    let memory = unsafe { &mut *(DATA_START as *mut Memory) };
    memory.clear();
    memory
}
