//! The engine: executes the program of a scan.

use plc_vm::{Exit, Interpreter};

use crate::board::flash::ProgramSlot;
use crate::environment::ScanTime;

/// Executes the program. Returns why it was left, and the offset of the instruction that left it.
pub fn run(execution: Interpreter<'_, ProgramSlot, ScanTime>) -> (Exit, u16) {
    execution.run()
}
