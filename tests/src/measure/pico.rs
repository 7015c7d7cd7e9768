//! Measuring on the emulated Pico with the shipped firmware: cycles of whole scans, from which
//! those of a program or of an instruction come as differences. What is fast enough is for others
//! to say.
//!
//! The emulator counts the cycles of the processor, and no waiting for flash.

use awl_sim::machine::pico::Pico;
use awl_sim::machine::{Machine, Mode};
use fastrand::Rng;
use plc_isa::{Area, M_START, PICO, verify};
use plc_vm::Inputs;

use super::rows::Row;
use super::values;
use crate::image::valid_image_for;
use crate::pico::pico;

/// Scans in which an instruction is measured.
const SITUATIONS: usize = 16;
/// Scans after which inputs and clock are what they stay.
const FIRST_SCANS: usize = 3;
/// The byte of marks that decides about power flow in the programs of rows.
const FLOW: u16 = M_START + 30;

/// An emulated board that programs are measured on.
pub struct PicoMeter {
    pico: Pico,
    overhead: u32,
}

impl Default for PicoMeter {
    fn default() -> Self {
        Self::new()
    }
}

impl PicoMeter {
    /// A board with the firmware that was built.
    ///
    /// # Panics
    /// If there is no firmware or emulator.
    pub fn new() -> PicoMeter {
        let mut meter = PicoMeter { pico: pico(), overhead: 0 };
        meter.overhead = meter.program("NOP 0\n");
        meter
    }

    /// Cycles of a whole scan of a program that does nothing, when no millisecond passes and no
    /// input changes.
    pub fn overhead(&self) -> u32 {
        self.overhead
    }

    /// Cycles of the longest execution of a program over all states of its first six inputs.
    ///
    /// # Panics
    /// If it does not run on the Pico.
    pub fn program(&mut self, text: &str) -> u32 {
        assert!(self.starts(text), "does not run on the Pico:\n{text}");
        let longest = (0..64).map(|levels| {
            let mut inputs = Inputs::default();
            inputs.digital[0] = levels;
            self.pico.set_inputs(&inputs);
            // That an input changes the scan takes time for, not the program.
            self.scan();
            self.scan()
        });
        longest.max().unwrap_or(0).saturating_sub(self.overhead)
    }

    /// Cycles of a row's instruction, as the average of its forms: the fewest and the most. `None`
    /// where the Pico does not have it, or it ends RUN.
    ///
    /// What else is in its small program is taken off. Where that is no program without the
    /// instruction, it is not, so that the figure is too high.
    pub fn row(&mut self, row: &Row) -> Option<(f64, f64)> {
        let with = self.situations(row, &row.program().0)?;
        let without = self.situations(row, &row.rest());
        let rest = without.unwrap_or_else(|| vec![self.overhead; with.len()]);
        let count = row.program().1.len() as f64;
        let each = with.iter().zip(rest);
        let each = each.map(|(&with, rest)| f64::from(with.saturating_sub(rest)) / count);
        Some(each.fold((f64::MAX, 0.0), |(least, most), one| (least.min(one), most.max(one))))
    }

    /// Cycles of scans of a program with values in V memory, with all power flow and without by
    /// turns: the same for each program of a row.
    fn situations(&mut self, row: &Row, text: &str) -> Option<Vec<u32>> {
        let image = valid_image_for(text, &PICO)?;
        let plan = *verify(&*image).ok()?.plan();
        if !self.starts_image(&image) {
            return None;
        }
        let count = row.count.map_or(0, |count| count.usual);
        let mut rng = Rng::with_seed(1);
        (0..SITUATIONS)
            .map(|situation| {
                for (number, byte) in values::bytes(row.items, count, &mut rng) {
                    if let Some(address) = plan.byte_address(Area::V, number) {
                        self.pico.set_byte(address, byte);
                    }
                }
                self.pico.set_byte(FLOW, if situation % 2 == 0 { 0xFF } else { 0 });
                let cycles = self.scan();
                self.runs().then_some(cycles)
            })
            .collect()
    }

    /// Loads a program and executes the first scans. Whether it runs.
    fn starts(&mut self, text: &str) -> bool {
        valid_image_for(text, &PICO).is_some_and(|image| self.starts_image(&image))
    }

    fn starts_image(&mut self, image: &[u8]) -> bool {
        self.pico.load(image.to_vec());
        self.pico.scan(0);
        for _ in 1..FIRST_SCANS {
            self.scan();
        }
        self.runs()
    }

    /// A scan in which no time passes.
    fn scan(&mut self) -> u32 {
        self.pico.scan(1);
        self.pico.scan_cycles()
    }

    fn runs(&self) -> bool {
        self.pico.mode() == Mode::Run && self.pico.broken().is_none()
    }
}
