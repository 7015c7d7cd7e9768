//! The board's own clock. Time 0 is the start of its first scan; what comes before is not counted.

use plc_vm::SCAN_MS_MAX;

use super::board::{Broken, MS, Mark};
use super::{At, Uno};

/// Longest time from mark to mark: the longest scan, the longest period, the slowest start after a
/// reset.
const PAUSE_MAX: u64 = 2 * SCAN_MS_MAX as u64 * MS;

impl Uno {
    /// Runs all scans that start before `now_ms`, takes what was written since, and runs those that
    /// start within this millisecond.
    pub(super) fn scan_free(&mut self, now_ms: u64) {
        if self.at == At::Off {
            self.prepare_power();
            let started = self.board.power_up();
            self.arrive(At::ScanStart, started);
            self.first_scan = self.board.scan_start();
            self.board.pulses.origin = Some(self.first_scan);
        }
        self.run_free(now_ms);
        if self.at == At::ScanStart {
            self.drive_inputs();
            self.write_memory();
        }
        self.run_free(now_ms + 1);
    }

    /// Runs all scans that start before this time.
    pub(super) fn run_free(&mut self, until_ms: u64) {
        while self.at == At::ScanStart && self.board.scan_start() - self.first_scan < until_ms * MS
        {
            let scanned = self.one_free_scan();
            self.arrive(At::ScanStart, scanned);
            self.inputs.digital[0] = self.board.pulses.changed(self.inputs.digital[0]);
        }
    }

    /// From the start of a scan to that of the next.
    fn one_free_scan(&mut self) -> Result<(), Broken> {
        self.board.run_to(Mark::ScanEnd, PAUSE_MAX)?;
        self.scan_cycles = self.board.avr.cycles() - self.board.scan_start();
        self.board.run_to(Mark::ScanStart, PAUSE_MAX)
    }
}
