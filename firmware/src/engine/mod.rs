//! The engine: executes the program of a scan. With the feature `engine` that is assembly for most instructions and for
//! native programs, without it the interpreter of plc-vm.

#[cfg(feature = "engine")]
mod fast;
pub mod link;
#[cfg(feature = "engine")]
pub use fast::{HAS_MODULES, Left, NATIVE_INTERFACE, advance_timers, run};

#[cfg(not(feature = "engine"))]
pub use plain::{HAS_MODULES, LEFT_OUT, Left, NATIVE_INTERFACE, run};

#[cfg(not(feature = "engine"))]
mod plain {
    use plc_isa::Op;
    use plc_vm::{Exit, Interpreter};

    use crate::board::flash::ProgramSlot;
    use crate::environment::ScanTime;

    /// Instructions that only the fast engine has: sequence control, routines, events, AENO. A program with one of them ends
    /// with a fault.
    pub const LEFT_OUT: u128 = (1 << (Op::Aeno as u32 + 1)) - (1 << Op::Lscr as u32);
    /// Modules need the engine.
    pub const HAS_MODULES: bool = false;
    /// There is nothing that machine code could call.
    pub const NATIVE_INTERFACE: u8 = 0;

    /// Why the program was left.
    #[derive(Clone, Copy)]
    pub struct Left(Exit);

    impl Left {
        /// Whether the program came to its end.
        pub fn is_at_end(self) -> bool {
            self.0 == Exit::End
        }

        /// The same in words.
        pub fn exit(self) -> Exit {
            self.0
        }
    }

    /// Executes the program. Returns why it was left, and the offset of the instruction that left it.
    pub fn run(execution: Interpreter<'_, ProgramSlot, ScanTime>) -> (Left, u16) {
        let (exit, at) = execution.run();
        (Left(exit), at)
    }
}
