//! Time and supervision of a running program, and what it sends on the line.

use heapless::Deque;
use plc_isa::LogicStack;
use plc_link::status;
use plc_vm::{Environment, Memory, SCAN_MS_MAX};

use crate::board::Board;
use crate::clock::Clock;

/// Characters that can wait until the line takes them: as many as XMT sends at once, twice.
pub const OUTGOING: usize = 512;

/// The outside of a program in one scan.
pub struct ScanTime<'b, B> {
    pub board: &'b mut B,
    pub clock: &'b Clock,
    pub outgoing: &'b mut Deque<u8, OUTGOING>,
    pub start_ms: u32,
    pub watchdog_start_ms: u32,
    pub watchdog_ms: u16,
    /// When the hardware watchdog was fed.
    pub fed_ms: u32,
    /// What this scan notes for the status of instructions: data address of the first entry, and
    /// their number.
    pub noted: (u16, u8),
}

impl<B: Board> ScanTime<'_, B> {
    /// Whether the scan has taken longer than it may. In whole milliseconds, never early.
    pub fn is_over(&mut self) -> bool {
        let now_ms = self.now_ms();
        now_ms.wrapping_sub(self.watchdog_start_ms) > u32::from(self.watchdog_ms)
            || now_ms.wrapping_sub(self.start_ms) > SCAN_MS_MAX
    }
}

impl<B: Board> Environment for ScanTime<'_, B> {
    fn now_ms(&mut self) -> u32 {
        let now_ms = self.clock.peek(self.board.now_us());
        // A clock that stands still does not count as life.
        if now_ms != self.fed_ms {
            self.fed_ms = now_ms;
            self.board.feed_watchdog();
        }
        now_ms
    }

    fn is_overdue(&mut self, _bytes: u16) -> bool {
        self.is_over()
    }

    fn retrigger_watchdog(&mut self) {
        self.watchdog_start_ms = self.now_ms();
    }

    fn transmit(&mut self, character: u8) {
        // A line that takes nothing loses what there is no room for, as a line without a wire does.
        let _ = self.outgoing.push_back(character);
    }

    #[inline(always)]
    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        if self.noted.1 > 0 {
            status::executed(memory, self.noted, at, stack);
        }
    }
}
