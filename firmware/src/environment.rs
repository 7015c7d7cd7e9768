//! Time and supervision of a running program, by the tick.

use plc_vm::Environment;

use crate::board::{clock, watchdog};

/// However often a program executes WDR, a scan ends after this time.
const SCAN_MS_MAX: u32 = 60_000;

/// The time of one scan.
pub struct ScanTime {
    scan_start_ms: u32,
    watchdog_start_ms: u32,
    watchdog_ms: u16,
}

impl ScanTime {
    /// A scan starts now and may take `watchdog_ms`.
    pub fn starting(now_ms: u32, watchdog_ms: u16) -> ScanTime {
        ScanTime { scan_start_ms: now_ms, watchdog_start_ms: now_ms, watchdog_ms }
    }
}

impl Environment for ScanTime {
    fn now_ms(&mut self) -> u32 {
        clock::now_ms()
    }

    fn is_overdue(&mut self, _bytes: u16) -> bool {
        let now_ms = clock::now_ms();
        watchdog::feed(now_ms);
        now_ms.wrapping_sub(self.watchdog_start_ms) >= u32::from(self.watchdog_ms)
            || now_ms.wrapping_sub(self.scan_start_ms) >= SCAN_MS_MAX
    }

    fn retrigger_watchdog(&mut self) {
        self.watchdog_start_ms = clock::now_ms();
    }
}
