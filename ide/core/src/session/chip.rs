//! What whoever emulates the chip of the virtual Uno tells the core, and asks it.

use awl_sim::machine::emulated::Chip;

use super::Session;
use crate::build;
use crate::lock_step::{self, Comparison};
use crate::surroundings::{Levels, Surroundings};

impl Session {
    /// How many milliseconds of the virtual Uno's chip are due. Each that has passed is told by
    /// [`chip_passed`](Session::chip_passed); fewer make it slower.
    pub fn chip_due_ms(&self) -> u32 {
        self.chip.as_ref().map_or(0, Surroundings::due_ms)
    }

    /// What is at the pins of the virtual Uno's chip: levels of D2 to D7, then converter counts of
    /// A0 to A5.
    pub fn chip_pins(&self) -> Levels {
        self.chip.as_ref().map_or_else(Levels::default, Surroundings::levels)
    }

    /// A millisecond of the virtual Uno's chip has passed, `data` is its data memory now. Gives
    /// what is at its pins from now on.
    pub fn chip_passed(&mut self, data: &[u8]) -> Levels {
        self.chip.as_mut().map_or_else(Levels::default, |chip| chip.pass(data))
    }

    /// Bytes that are due on its line at this millisecond.
    pub fn chip_bytes(&mut self) -> Vec<u8> {
        let line_ms = self.line_ms(self.now_ms);
        let is_there = self.chip.is_some() && !self.bench.is_paused;
        let plc = self.plc.as_mut().filter(|_| is_there);
        plc.and_then(|plc| plc.transmit(line_ms)).unwrap_or_default()
    }

    /// Runs the program on the reference interpreter and, with the firmware, on this chip: scan by
    /// scan, with a scenario or for so long, and with a plant. Gives the scans and the operands
    /// that were the same after each of them, or what differs first.
    pub fn compare(
        &self,
        chip: impl Chip,
        scenario: Option<&str>,
        for_ms: u32,
        plant: Option<&str>,
    ) -> Result<(u64, usize), String> {
        let program = build::board_program(&self.editor)?;
        let text = |name| self.editor.text(name).ok_or_else(|| format!("there is no file {name}"));
        let scenario = scenario.map(|name| text(name).map(|text| (name, text))).transpose()?;
        let described =
            scenario.map(|(name, text)| self.editor.plant_of(name, text)).transpose()?;
        let described = described.flatten();
        let plant = plant.map(|spec| self.editor.plant(spec)).transpose()?;
        let (files, flash) = (build::files(&self.editor)?, build::flash(&program)?);
        let (described, plant) = (described.as_ref(), plant.as_ref());
        let comparison = Comparison { files: &files, flash, scenario, described, for_ms, plant };
        lock_step::compare(comparison, chip)
    }
}
