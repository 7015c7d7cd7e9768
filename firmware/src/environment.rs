//! Time and supervision of a running program, by the tick.

use plc_isa::LogicStack;
use plc_vm::{Environment, SCAN_MS_MAX};

use crate::board::{clock, watchdog};
use crate::engine;

/// The time of one scan.
pub struct ScanTime {
    scan_start_ms: u32,
    watchdog_start_ms: u32,
    watchdog_ms: u16,
    /// Instructions executed, to feed the hardware watchdog now and then.
    executed: u8,
}

impl ScanTime {
    /// A scan starts now and may take `watchdog_ms`.
    pub fn starting(now_ms: u32, watchdog_ms: u16) -> ScanTime {
        ScanTime { scan_start_ms: now_ms, watchdog_start_ms: now_ms, watchdog_ms, executed: 0 }
    }

    /// Whether the scan has taken longer than it may. In whole ticks, so up to a millisecond late and never early.
    pub fn is_over(&self, now_ms: u32) -> bool {
        now_ms.wrapping_sub(self.watchdog_start_ms) > u32::from(self.watchdog_ms)
            || now_ms.wrapping_sub(self.scan_start_ms) > SCAN_MS_MAX
    }
}

impl Environment for ScanTime {
    const EXECUTED_ELSEWHERE: u128 = engine::EXECUTED;

    fn now_ms(&mut self) -> u32 {
        clock::now_ms()
    }

    fn is_overdue(&mut self, _bytes: u16) -> bool {
        let now_ms = clock::now_ms();
        watchdog::feed(now_ms);
        self.is_over(now_ms)
    }

    fn retrigger_watchdog(&mut self) {
        self.watchdog_start_ms = clock::now_ms();
    }

    /// Code without loops can take longer than the hardware watchdog waits, too.
    fn executed(&mut self, _at: u16, _stack: LogicStack) {
        self.executed = self.executed.wrapping_add(1);
        if self.executed == 0 {
            watchdog::feed(clock::now_ms());
        }
    }
}
