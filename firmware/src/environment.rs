//! Time and supervision of a running program, by the tick; its events.

use plc_isa::{EVENTS_RUN_BEGINS, EVENTS_SEEN, Plan, ProgramMemory, TimerResolution};
use plc_vm::{Environment, EventSystem, Memory, SCAN_MS_MAX};

use crate::board::clock;
use crate::engine;

/// The time of one scan. In 16 bits: a loop that takes longer than a scan may is left, and code
/// without loops takes less than the five seconds that are left then.
pub struct ScanTime {
    scan_start_ms: u16,
    watchdog_start_ms: u16,
    watchdog_ms: u16,
}

impl ScanTime {
    /// A scan starts now and may take `watchdog_ms`.
    #[inline(always)]
    pub fn starting(now_ms: u16, watchdog_ms: u16) -> ScanTime {
        ScanTime { scan_start_ms: now_ms, watchdog_start_ms: now_ms, watchdog_ms }
    }

    /// Whether the scan has taken longer than it may. In whole ticks, so up to a millisecond late
    /// and never early.
    #[inline(never)]
    pub fn is_over(&self) -> bool {
        let now_ms = clock::now_ms_low();
        now_ms.wrapping_sub(self.watchdog_start_ms) > self.watchdog_ms
            || now_ms.wrapping_sub(self.scan_start_ms) > SCAN_MS_MAX as u16
    }
}

impl Environment for ScanTime {
    fn now_ms(&mut self) -> u32 {
        clock::now_ms()
    }

    fn is_overdue(&mut self, _bytes: u16) -> bool {
        self.is_over()
    }

    fn advance_timers<P: ProgramMemory>(
        _: &mut Memory,
        _: &Plan<P>,
        resolution: TimerResolution,
        ticks: u16,
    ) {
        engine::advance_timers(resolution, ticks);
    }

    fn retrigger_watchdog(&mut self) {
        self.watchdog_start_ms = clock::now_ms_low();
    }
}

/// Interrupt events on the board: a module in the program's image looks for them
/// (firmware/modules/inputs_outputs.s).
pub struct ModuleEvents;

impl EventSystem for ModuleEvents {
    #[inline(always)]
    fn restart<P: ProgramMemory>(&mut self, _: &Plan<P>, memory: &mut Memory) {
        memory.set_byte(EVENTS_SEEN, EVENTS_RUN_BEGINS);
    }

    fn pass<P: ProgramMemory>(&mut self, _: u32, _: u32, _: &Plan<P>, _: &mut Memory) {}

    /// The modules read the pins.
    #[inline(always)]
    fn note_points(&mut self, _: &Memory) {}

    /// Firmware and modules drive them.
    fn driven_outputs(&self) -> (u8, u8) {
        (0, 0)
    }
}
