//! System settings that ride in the image: what the `//#` lines of a program ask of the machine.

use crate::area::Area;
use crate::profile::Profile;

/// Main scan watchdog when the program sets none (docs/decisions.md).
pub const DEFAULT_WATCHDOG_MS: u16 = 500;

/// Settings of fixed size, in the order in which they are in the image. The retained ranges are a
/// table of it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Longest execution of a scan in milliseconds, 1..=60000.
    pub watchdog_ms: u16,
    /// Fixed time from scan start to scan start in milliseconds; 0: the next scan starts at once.
    pub scan_ms: u16,
    /// Inputs I0.0-I0.7 with the pull-up resistor on, a bit each.
    pub pullup: u8,
    /// Inputs I0.0-I0.7 whose pin level is inverted, a bit each.
    pub invert_inputs: u8,
    /// Outputs Q0.0-Q0.7 whose pin level is inverted, a bit each: off means a high pin.
    pub invert_outputs: u8,
    /// Analog inputs are smoothed over 2 to the power of this many samples, 0..=6; 0: not at all.
    pub filter: u8,
    /// Address of the controller on the serial line, 1..=247.
    pub modbus_address: u8,
    /// How characters are sent on it, see [`LineSettings`].
    pub line: u8,
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
        modbus_address: 1,
        line: 0,
    };

    /// Nothing but zeros, to be read into.
    pub(crate) const BLANK: Settings = Settings {
        watchdog_ms: 0,
        scan_ms: 0,
        pullup: 0,
        invert_inputs: 0,
        invert_outputs: 0,
        filter: 0,
        modbus_address: 0,
        line: 0,
    };

    /// Longest watchdog time and scan period, in milliseconds.
    pub const TIME_MAX_MS: u16 = 60_000;

    /// Strongest filter: 64 samples, which is what 16 bits hold of 10-bit counts.
    pub const FILTER_MAX: u8 = 6;

    /// Highest address on the serial line; what lies above is reserved by Modbus.
    pub const MODBUS_ADDRESS_MAX: u8 = 247;

    #[inline(always)]
    pub(crate) fn is_valid(&self, profile: &Profile) -> bool {
        let inputs = ((1u16 << profile.digital_inputs()) - 1) as u8;
        let outputs = ((1u16 << profile.digital_outputs()) - 1) as u8;
        (1..=Self::TIME_MAX_MS).contains(&self.watchdog_ms)
            && self.scan_ms <= Self::TIME_MAX_MS
            && self.filter <= Self::FILTER_MAX
            && (self.pullup | self.invert_inputs) & !inputs | self.invert_outputs & !outputs == 0
            && self.modbus_address.wrapping_sub(1) < Self::MODBUS_ADDRESS_MAX
            && LineSettings::is_valid(self.line)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Parity of the characters on the serial line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Parity {
    /// Eight data bits, a stop bit.
    #[default]
    None,
    /// A parity bit between them: the number of ones is even.
    Even,
    /// Odd.
    Odd,
}

/// Settings of the serial line in a byte: index of the rate in bits 0 to 2, parity in bits 4 and 5.
/// 0 is the default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LineSettings {
    /// Index in [`RATES`](Self::RATES), 0..=7.
    pub rate: u8,
    /// Parity.
    pub parity: Parity,
}

impl LineSettings {
    /// Bits per second, by their indices.
    pub const RATES: [u32; 8] = [115_200, 57_600, 38_400, 19_200, 9_600, 4_800, 2_400, 1_200];

    /// The byte.
    pub const fn to_byte(self) -> u8 {
        self.rate | (self.parity as u8) << 4
    }

    /// What a valid byte says.
    pub const fn of_byte(byte: u8) -> LineSettings {
        let parity = match byte >> 4 {
            1 => Parity::Even,
            2 => Parity::Odd,
            _ => Parity::None,
        };
        LineSettings { rate: byte & 7, parity }
    }

    fn is_valid(byte: u8) -> bool {
        byte & 0b1000_1000 == 0 && byte < 0x30
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

    /// Areas that can be retained (docs/s7-200.md 6.4), in the order of their stored codes.
    pub const AREAS: [Area; 4] = [Area::V, Area::M, Area::T, Area::C];

    /// As stored in the image.
    pub fn to_bytes(self) -> [u8; Self::STORED_LEN as usize] {
        let code =
            Self::AREAS.iter().position(|&area| area == self.area).unwrap_or(usize::from(u8::MAX));
        let [first_low, first_high] = self.first.to_le_bytes();
        let [count_low, count_high] = self.count.to_le_bytes();
        [code as u8, first_low, first_high, count_low, count_high]
    }

    pub(crate) fn area_of_code(code: u8) -> Option<Area> {
        Self::AREAS.get(usize::from(code)).copied()
    }
}
