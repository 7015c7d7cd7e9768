//! The held clock: each scan of the firmware begins at the time that the harness gives it.
//!
//! The interrupt that counts milliseconds is off from the start, so that time stands still within a scan, as it does
//! for the host machine. A program that never ends its scan needs time to pass: after [`Uno::hold_clock_for`] the clock
//! jumps by the longest time that any scan may take, and the firmware's supervision ends the scan.

use plc_isa::{ANALOG_INPUTS, AnalogInput, I_START};
use plc_vm::SCAN_MS_MAX;

use super::board::{Broken, MS, SCAN_END, SCAN_START};
use super::{At, Uno};

/// As long as a scan can last at all.
pub(super) const HELD_CYCLES_MAX: u64 = SCAN_MS_MAX as u64 * MS;
/// Longest time between scans, and from the clock's jump to the end of the scan: both are short.
const PAUSE_MAX: u64 = 1_000 * MS;

impl Uno {
    /// Lets the held clock begin at another value, to come near its wrap. Before the first scan.
    pub fn start_clock_at(&mut self, clock_ms: u32) {
        self.clock_start_ms = clock_ms;
    }

    /// How many cycles a scan may take before the held clock jumps. At first as many as a scan can ever take, and too
    /// many to wait for: whoever knows that the scan will not end chooses fewer.
    pub fn hold_clock_for(&mut self, cycles: u64) {
        self.held_cycles_max = cycles;
    }

    pub(super) fn scan_held(&mut self, now_ms: u64) {
        // The board's clock has 32 bits and wraps.
        let now_ms = self.clock_start_ms.wrapping_add(now_ms as u32);
        if self.at == At::Off {
            self.drive_inputs();
            let started = self.board.power_up_held(now_ms, &self.inputs);
            self.arrive(At::ScanStart, started);
        }
        if matches!(self.at, At::ScanStart | At::ScanEnd) {
            let scanned = self.one_held_scan(now_ms);
            self.arrive(At::ScanEnd, scanned);
        }
    }

    fn one_held_scan(&mut self, now_ms: u32) -> Result<(), Broken> {
        self.board.hold_clock(now_ms);
        if self.at == At::ScanEnd && !self.board.run_held_to(SCAN_START, PAUSE_MAX)? {
            return Err("the next scan is not due yet: the program sets a longer period (//# scan)".to_string());
        }
        self.scan_start = self.board.avr().cycles();
        self.drive_inputs();
        self.write_memory();
        self.give_inputs_without_pin()?;
        self.give_analog();
        if !self.board.run_held_to(SCAN_END, self.held_cycles_max)? {
            self.board.hold_clock(now_ms.wrapping_add(SCAN_MS_MAX));
            if !self.board.run_held_to(SCAN_END, PAUSE_MAX)? {
                return Err("the scan does not end, however late it is".to_string());
            }
        }
        self.scan_cycles = self.board.avr().cycles() - self.scan_start;
        Ok(())
    }

    fn give_inputs_without_pin(&mut self) -> Result<(), Broken> {
        let [first, others @ ..] = self.inputs.digital;
        // The firmware leaves them alone.
        self.board.write(I_START + 1, &others);
        match self.input_pins() {
            pins if pins == first => Ok(()),
            pins => self.board.add_to_inputs(pins, first),
        }
    }

    /// The firmware takes what its converter could have given; a value between two steps goes to memory.
    fn give_analog(&mut self) {
        let is_step = |channel: usize| self.inputs.scaled[channel] == AnalogInput::scale(self.inputs.raw[channel]);
        let channels = 0..usize::from(ANALOG_INPUTS);
        let steps = channels.filter(|&channel| is_step(channel)).fold(0, |bits, channel| bits | 1 << channel);
        self.board.give_analog(&self.inputs, steps);
        if !self.board.takes_single_analogs() {
            return;
        }
        for channel in (0..ANALOG_INPUTS as u8).filter(|channel| steps >> channel & 1 == 0) {
            let at = usize::from(channel);
            let (raw, scaled) = (self.inputs.raw[at], self.inputs.scaled[at]);
            self.board.write(AnalogInput::Raw(channel).address(), &raw.to_be_bytes());
            self.board.write(AnalogInput::Scaled(channel).address(), &scaled.to_be_bytes());
        }
    }
}
