//! The PLC's outputs as a plant sees them: levels of pins, and of those that are modulated, for how
//! much of the time they are high.

/// Thousandths of the time.
const ALWAYS: u16 = 1000;

/// The output pins D8 to D13.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outputs {
    /// Electrical levels: bit n is the pin of Q0.n, 1 is high. Of a modulated pin the level that
    /// the process image gives it.
    pub levels: u8,
    pub(super) duties: [Option<u16>; 8],
}

impl Outputs {
    /// The same, but these pins are modulated, each for so many thousandths of the time high.
    pub fn with_duties(mut self, duties: impl IntoIterator<Item = (u8, Option<u16>)>) -> Outputs {
        for (output, duty) in duties {
            self.duties[usize::from(output & 7)] = duty.map(|thousandths| thousandths.min(ALWAYS));
        }
        self
    }

    /// Whether the pin of Q0.`output` is high.
    pub fn is_high(self, output: u8) -> bool {
        self.levels >> (output & 7) & 1 != 0
    }

    /// For how many thousandths of the time the pin of Q0.`output` is high.
    pub fn duty(self, output: u8) -> u16 {
        let steady = if self.is_high(output) { ALWAYS } else { 0 };
        self.duties[usize::from(output & 7)].unwrap_or(steady)
    }

    /// As they are after a board that inverts them.
    pub fn inverted(self) -> Outputs {
        let duties = self.duties.map(|duty| duty.map(|thousandths| ALWAYS - thousandths));
        Outputs { levels: !self.levels, duties }
    }
}

impl From<u8> for Outputs {
    /// Levels, without modulation.
    fn from(levels: u8) -> Outputs {
        Outputs { levels, ..Outputs::default() }
    }
}
