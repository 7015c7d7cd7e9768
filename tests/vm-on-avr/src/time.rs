//! The time of a scan, which the tests give: it stands still, and loops may take so long and no
//! longer.

use plc_vm::Environment;

use crate::exchange;

/// The time of one scan.
pub struct GivenTime {
    now_ms: u32,
    /// So many bytes of code may still be looped over.
    left: u32,
}

impl GivenTime {
    /// The time of the scan that is asked for.
    pub fn of_scan() -> GivenTime {
        GivenTime { now_ms: exchange::clock(), left: exchange::looped_max() }
    }
}

impl Environment for GivenTime {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }

    fn is_overdue(&mut self, bytes: u16) -> bool {
        match self.left.checked_sub(bytes.into()) {
            Some(left) => self.left = left,
            None => return true,
        }
        false
    }

    /// Who gives the time knows how often.
    fn retrigger_watchdog(&mut self) {}
}
