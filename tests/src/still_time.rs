//! Time for the interpreter in tests that set it themselves, scan by scan.

use plc_vm::Environment;

/// The time in milliseconds, which stands still within a scan. A program that loops is overdue at
/// once.
pub struct StillTime(pub u32);

impl Environment for StillTime {
    fn now_ms(&mut self) -> u32 {
        self.0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        true
    }
    fn retrigger_watchdog(&mut self) {}
}
