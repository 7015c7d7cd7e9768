//! Time and supervision of a running program, by the tick.

use plc_isa::LogicStack;
#[cfg(feature = "engine")]
use plc_isa::{Plan, ProgramMemory, TimerResolution};
use plc_vm::{Environment, Memory, SCAN_MS_MAX};

use crate::board::{clock, watchdog};
use crate::engine;

/// The time of one scan. In 16 bits: a loop that takes longer than a scan may is left, and code without loops takes
/// less than the five seconds that are left then.
pub struct ScanTime {
    scan_start_ms: u16,
    watchdog_start_ms: u16,
    watchdog_ms: u16,
    /// Instructions executed, to feed the hardware watchdog now and then. The fast engine does that in its own way.
    executed: u8,
}

impl ScanTime {
    /// A scan starts now and may take `watchdog_ms`.
    #[inline(always)]
    pub fn starting(now_ms: u16, watchdog_ms: u16) -> ScanTime {
        ScanTime { scan_start_ms: now_ms, watchdog_start_ms: now_ms, watchdog_ms, executed: 0 }
    }

    /// Whether the scan has taken longer than it may. In whole ticks, so up to a millisecond late and never early.
    #[inline(never)]
    pub fn is_over(&self) -> bool {
        let now_ms = clock::now_ms_low();
        now_ms.wrapping_sub(self.watchdog_start_ms) > self.watchdog_ms
            || now_ms.wrapping_sub(self.scan_start_ms) > SCAN_MS_MAX as u16
    }
}

impl Environment for ScanTime {
    #[cfg(not(feature = "engine"))]
    const EXECUTED_ELSEWHERE: u128 = engine::LEFT_OUT;

    fn now_ms(&mut self) -> u32 {
        clock::now_ms()
    }

    fn is_overdue(&mut self, _bytes: u16) -> bool {
        watchdog::feed(clock::now_ms());
        self.is_over()
    }

    #[cfg(feature = "engine")]
    fn advance_timers<P: ProgramMemory>(_: &mut Memory, _: &Plan<P>, resolution: TimerResolution, ticks: u16) {
        if ticks != 0 {
            engine::advance_timers(resolution, ticks);
        }
    }

    fn retrigger_watchdog(&mut self) {
        self.watchdog_start_ms = clock::now_ms_low();
    }

    /// Code without loops can take longer than the hardware watchdog waits, too.
    fn executed(&mut self, _at: u16, _stack: LogicStack, _memory: &mut Memory) {
        self.executed = self.executed.wrapping_add(1);
        if self.executed == 0 {
            watchdog::feed(clock::now_ms());
        }
    }
}
