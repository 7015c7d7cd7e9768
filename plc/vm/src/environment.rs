//! What the interpreter needs from outside while a program runs: time and supervision.

use plc_isa::{LogicStack, Plan, ProgramMemory, TimerResolution};

use crate::memory::Memory;
use crate::timer;

/// However often a program executes WDR, a scan ends after this time in milliseconds.
pub const SCAN_MS_MAX: u32 = 60_000;

/// The outside of a running program.
pub trait Environment {
    /// The millisecond clock. Wraps after 49.7 days; only differences count.
    fn now_ms(&mut self) -> u32;

    /// The program jumps back: `bytes` bytes of code, at least the jump's own, make up the pass
    /// that ends here. Or an interrupt routine begins, which takes as long as so many bytes.
    /// Returns whether the scan's watchdog time is over. Nothing else can spend unlimited time.
    fn is_overdue(&mut self, bytes: u16) -> bool;

    /// WDR: the watchdog time of this scan starts again.
    fn retrigger_watchdog(&mut self);

    /// XMT sends a character on the serial line.
    fn transmit(&mut self, character: u8) {
        let _ = character;
    }

    /// Advances every running timer of this resolution, 1 ms or 10 ms, by so many ticks. For an
    /// engine that does the same in another way.
    #[inline(always)]
    fn advance_timers<P: ProgramMemory>(
        memory: &mut Memory,
        plan: &Plan<P>,
        resolution: TimerResolution,
        ticks: u16,
    ) {
        timer::advance(memory, plan, resolution, ticks);
    }

    /// Called by the interpreter's own loop after every instruction, with its offset, and the stack
    /// and memory it left. For monitors, which write down what they see after the program's own
    /// memory, and for tests.
    #[inline(always)]
    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        let _ = (at, stack, memory);
    }
}
