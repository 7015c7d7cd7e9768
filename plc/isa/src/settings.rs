//! System settings that ride in the image: what the `//#` lines of a program ask of the machine.

use crate::area::Area;

/// Main scan watchdog when the program sets none (reference 9).
pub const DEFAULT_WATCHDOG_MS: u16 = 500;

/// Settings of fixed size. The retained ranges are a table of the image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Inputs I0.0-I0.7 with the pull-up resistor on, a bit each.
    pub pullup: u8,
    /// Inputs I0.0-I0.7 whose pin level is inverted, a bit each.
    pub invert_inputs: u8,
    /// Outputs Q0.0-Q0.7 whose pin level is inverted, a bit each: off means a high pin.
    pub invert_outputs: u8,
    /// Longest execution of a scan in milliseconds, 1..=60000.
    pub watchdog_ms: u16,
    /// Fixed time from scan start to scan start in milliseconds; 0: the next scan starts at once.
    pub scan_ms: u16,
    /// Analog inputs are smoothed over 2 to the power of this many samples, 0..=6; 0: not at all.
    pub filter: u8,
}

impl Settings {
    /// Of a program that asks for nothing.
    pub const DEFAULT: Settings = Settings {
        pullup: 0,
        invert_inputs: 0,
        invert_outputs: 0,
        watchdog_ms: DEFAULT_WATCHDOG_MS,
        scan_ms: 0,
        filter: 0,
    };

    /// Longest watchdog time and scan period, in milliseconds.
    pub const TIME_MAX_MS: u16 = 60_000;

    /// Strongest filter: 64 samples, which is what 16 bits hold of 10-bit counts.
    pub const FILTER_MAX: u8 = 6;

    pub(crate) fn is_valid(&self) -> bool {
        let inputs = (1 << crate::layout::DIGITAL_INPUTS) - 1;
        let outputs = (1 << crate::layout::DIGITAL_OUTPUTS) - 1;
        (1..=Self::TIME_MAX_MS).contains(&self.watchdog_ms)
            && self.scan_ms <= Self::TIME_MAX_MS
            && self.filter <= Self::FILTER_MAX
            && self.pullup & !inputs == 0
            && self.invert_inputs & !inputs == 0
            && self.invert_outputs & !outputs == 0
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// A range that keeps its values without power.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Retained {
    /// V and M (bytes), T (retentive timers) or C.
    pub area: Area,
    /// First byte or number.
    pub first: u16,
    /// How many bytes or numbers.
    pub count: u16,
}

impl Retained {
    /// Most ranges in a program.
    pub const RANGES_MAX: u8 = 16;
    /// Bytes of a range in the image.
    pub const STORED_LEN: u16 = 5;

    /// Areas that can be retained (reference 6.4), in the order of their stored codes.
    pub const AREAS: [Area; 4] = [Area::V, Area::M, Area::T, Area::C];

    /// As stored in the image.
    pub fn to_bytes(self) -> [u8; Self::STORED_LEN as usize] {
        let code = Self::AREAS.iter().position(|&area| area == self.area).unwrap_or(usize::from(u8::MAX));
        let [first_low, first_high] = self.first.to_le_bytes();
        let [count_low, count_high] = self.count.to_le_bytes();
        [code as u8, first_low, first_high, count_low, count_high]
    }

    pub(crate) fn area_of_code(code: u8) -> Option<Area> {
        Self::AREAS.get(usize::from(code)).copied()
    }
}
