//! How a board executes programs: by the interpreter, or by an engine of its own that does the same
//! faster.

use plc_isa::{Program, ProgramMemory};
use plc_vm::{Environment, Events, Exit, Interpreter, Scan};

/// What executes programs.
pub trait Engine<P> {
    /// A program was loaded and checked: it is the one that is executed from now on.
    fn prepare(&mut self, program: &Program<P>);

    /// Executes the program of a scan once. Returns why it was left, and the offset of the
    /// instruction that left it. Where somebody watches, [`Environment::executed`] is called after
    /// every instruction.
    fn run<E: Environment>(
        &mut self,
        scan: Scan<'_, P, E, Events>,
        is_watched: bool,
    ) -> (Exit, u16);
}

/// The interpreter of plc-vm.
#[derive(Debug, Clone, Copy)]
pub struct Interpreted;

impl<P: ProgramMemory> Engine<P> for Interpreted {
    fn prepare(&mut self, _program: &Program<P>) {}

    #[inline(always)]
    fn run<E: Environment>(
        &mut self,
        scan: Scan<'_, P, E, Events>,
        _is_watched: bool,
    ) -> (Exit, u16) {
        Interpreter::new(scan).run()
    }
}
