//! The held clock: each scan of the firmware begins at the time that the harness gives it.
//!
//! The interrupt that counts milliseconds is off from the start, so that time stands still within a
//! scan, as it does for the host machine. A program that never ends its scan needs time to pass:
//! after [`Uno::hold_clock_for`] the clock jumps by the longest time that any scan may take, and
//! the firmware's supervision ends the scan.

use plc_isa::{ANALOG_INPUTS, AnalogInput, I_START};
use plc_vm::{Inputs, SCAN_MS_MAX};
use simavr::Reset;

use super::board::{BOOT_MAX, Board, Broken, MS, Mark};
use super::{At, Uno};

/// As long as a scan can last at all.
pub(super) const HELD_CYCLES_MAX: u64 = SCAN_MS_MAX as u64 * MS;
/// Longest time between scans, and from the clock's jump to the end of the scan: both are short.
const PAUSE_MAX: u64 = 1_000 * MS;
/// Cycles from a look of the harness at the held clock to the next: far less than a millisecond.
const HELD_STEP: u64 = 200;
/// Cycles between two feedings of the hardware watchdog while the clock is held: far less than its
/// half second.
const HELD_LONG_STEP: u64 = 100 * MS;
/// Steps from the mark before the inputs are read until they certainly have been.
const STEPS_TO_INPUTS: usize = 2_000;
/// A bit for each analog input.
const ALL_ANALOGS: u8 = (1 << ANALOG_INPUTS) - 1;

impl Uno {
    /// Lets the held clock begin at another value, to come near its wrap. Before the first scan.
    pub fn start_clock_at(&mut self, clock_ms: u32) {
        self.clock_start_ms = clock_ms;
    }

    /// How many cycles a scan may take before the held clock jumps. At first as many as a scan can
    /// ever take, and too many to wait for: whoever knows that the scan will not end chooses fewer.
    pub fn hold_clock_for(&mut self, cycles: u64) {
        self.held_cycles_max = cycles;
    }

    pub(super) fn scan_held(&mut self, now_ms: u64) {
        // The board's clock has 32 bits and wraps.
        let now_ms = self.clock_start_ms.wrapping_add(now_ms as u32);
        if self.at == At::Off {
            self.prepare_power();
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
        if self.at == At::ScanEnd && !self.board.run_held_to(Mark::ScanStart, PAUSE_MAX)? {
            return Err(
                "the next scan is not due yet: the program sets a longer period (//# scan)"
                    .to_string(),
            );
        }
        self.drive_inputs();
        self.write_memory();
        self.give_points_without_pin()?;
        self.give_analog();
        if !self.board.run_held_to(Mark::ScanEnd, self.held_cycles_max)? {
            self.board.hold_clock(now_ms.wrapping_add(SCAN_MS_MAX));
            if !self.board.run_held_to(Mark::ScanEnd, PAUSE_MAX)? {
                return Err("the scan does not end, however late it is".to_string());
            }
        }
        self.scan_cycles = self.board.avr.cycles() - self.board.scan_start();
        Ok(())
    }

    /// I0.6 and I0.7, which the firmware reads as 0.
    fn give_points_without_pin(&mut self) -> Result<(), Broken> {
        let [wanted, ..] = self.inputs.digital;
        match self.input_pins() {
            pins if pins == wanted => Ok(()),
            pins => self.board.add_to_inputs(pins, wanted),
        }
    }

    /// The firmware takes what its converter could have given; a value between two steps goes to
    /// memory.
    fn give_analog(&mut self) {
        let is_step = |channel: usize| {
            self.inputs.scaled[channel] == AnalogInput::scale(self.inputs.raw[channel])
        };
        let channels = 0..usize::from(ANALOG_INPUTS);
        let steps = channels
            .filter(|&channel| is_step(channel))
            .fold(0, |bits, channel| bits | 1 << channel);
        self.board.give_analog(&self.inputs, steps);
        for channel in (0..ANALOG_INPUTS as u8).filter(|channel| steps >> channel & 1 == 0) {
            let at = usize::from(channel);
            let (raw, scaled) = (self.inputs.raw[at], self.inputs.scaled[at]);
            self.board.write(AnalogInput::Raw(channel).address(), &raw.to_be_bytes());
            self.board.write(AnalogInput::Scaled(channel).address(), &scaled.to_be_bytes());
        }
    }
}

impl Board {
    /// Stops the millisecond clock and sets it.
    fn hold_clock(&mut self, now_ms: u32) {
        self.stop_clock();
        self.set_tick(now_ms);
    }

    /// Power, until the first scan starts, with a clock that stands still at this time. The clock's
    /// interrupt also serves the converter; the firmware, which waits for it, gets what it would
    /// give.
    fn power_up_held(&mut self, now_ms: u32, inputs: &Inputs) -> Result<(), Broken> {
        self.avr.reset(Reset::PowerOn);
        for _ in 0..BOOT_MAX / HELD_STEP {
            self.hold_clock(now_ms);
            self.give_analog(inputs, ALL_ANALOGS);
            if self.run(HELD_STEP)?.is_some() {
                return Ok(());
            }
        }
        Err("the board does not start".to_string())
    }

    /// Runs to the next mark, which must be this one, with the clock held. False if the time is
    /// over before.
    fn run_held_to(&mut self, mark: Mark, cycles_max: u64) -> Result<bool, Broken> {
        let end = self.avr.cycles() + cycles_max;
        while self.avr.cycles() < end {
            // The firmware feeds its watchdog only while the clock goes on.
            self.avr.feed_watchdog();
            match self.run(HELD_LONG_STEP.min(end - self.avr.cycles()))? {
                Some(found) if found == mark as u8 => return Ok(true),
                Some(_) => return Err("the board was reset in the middle of a scan".to_string()),
                None => {}
            }
        }
        Ok(false)
    }

    /// Gives the next scan the analog inputs that these bits name, as if they had just been
    /// converted.
    fn give_analog(&mut self, inputs: &Inputs, channels: u8) {
        let counts: Vec<u8> = inputs.raw.iter().flat_map(|counts| counts.to_le_bytes()).collect();
        self.write(self.places.analog, &counts);
        self.write(self.places.analog_fresh, &[channels]);
    }

    /// Lets the firmware read its inputs, then writes to the process image what it cannot have read
    /// from pins.
    ///
    /// It is at the start of the scan, and its pins give `from_pins` for IB0.
    fn add_to_inputs(&mut self, from_pins: u8, wanted: u8) -> Result<(), Broken> {
        // Seen to be overwritten because it is different.
        self.write(I_START, &[!from_pins]);
        for _ in 0..STEPS_TO_INPUTS {
            self.step()?;
            if self.byte(I_START) == from_pins {
                self.write(I_START, &[wanted]);
                return Ok(());
            }
        }
        Err("the firmware does not read its inputs".to_string())
    }
}
