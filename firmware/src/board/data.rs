//! The data memory of the controller, at the addresses that programs name.

use plc_isa::DATA_START;
use plc_vm::Memory;

/// The right to the data memory. It holds no reference: an address that the compiler knows makes
/// shorter code.
pub struct Data(());

impl Data {
    /// The data memory.
    #[inline(always)]
    pub fn memory(&mut self) -> &mut Memory {
        // SAFETY: the linker places nothing below DATA_END (build script), the type is 1,280 bytes
        // for which every value is valid, and there is one right to it, which is borrowed as long
        // as the reference lives.
        unsafe { &mut *(DATA_START as *mut Memory) }
    }
}
