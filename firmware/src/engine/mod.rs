//! The engine: executes the program of a scan. With the feature `engine` that is assembly for most instructions and for
//! native programs, without it the interpreter of plc-vm.

#[cfg(feature = "engine")]
mod fast;
#[cfg(feature = "engine")]
pub use fast::{EXECUTED, NATIVE_INTERFACE, advance_timers, run};

#[cfg(not(feature = "engine"))]
pub use plain::{EXECUTED, NATIVE_INTERFACE, run};

#[cfg(not(feature = "engine"))]
mod plain {
    use plc_vm::{Exit, Interpreter};

    use crate::board::flash::ProgramSlot;
    use crate::environment::ScanTime;

    /// No instruction is executed by anybody else.
    pub const EXECUTED: u128 = 0;
    /// There is nothing that machine code could call.
    pub const NATIVE_INTERFACE: u8 = 0;

    /// Executes the program. Returns why it was left, and the offset of the instruction that left it.
    pub fn run(execution: Interpreter<'_, ProgramSlot, ScanTime>) -> (Exit, u16) {
        execution.run()
    }
}
