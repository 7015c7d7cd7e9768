//! Memory areas of the S7-200 and the numbers that are legal in them. No placement: that is the
//! plan's.

use crate::layout::*;

/// A memory area that AWL can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Area {
    /// Process image of the inputs.
    I,
    /// Process image of the outputs.
    Q,
    /// Marks.
    M,
    /// Special memory.
    Sm,
    /// Sequence control bits.
    S,
    /// Variable memory.
    V,
    /// Timers: the bit, or the current value as a word.
    T,
    /// Counters: the bit, or the current value as a word.
    C,
    /// Local memory of the program's units.
    L,
}

impl Area {
    /// The letters an address of this area starts with.
    pub const fn name(self) -> &'static str {
        match self {
            Area::I => "I",
            Area::Q => "Q",
            Area::M => "M",
            Area::Sm => "SM",
            Area::S => "S",
            Area::V => "V",
            Area::T => "T",
            Area::C => "C",
            Area::L => "L",
        }
    }

    /// How many bytes a program can address (docs/s7-200.md 4.1; V and SM: largest CPU). For T and
    /// C: how many numbers.
    pub const fn size(self) -> u16 {
        match self {
            Area::I | Area::Q => 16,
            Area::M | Area::S => 32,
            Area::Sm => 550,
            Area::L => 64,
            Area::V => 10240,
            Area::T | Area::C => 256,
        }
    }

    /// Data address of the area's first byte in the bit page; V has none, because the plan places
    /// it. For T and C this is where their bits are.
    pub const fn page_start(self) -> Option<u16> {
        match self {
            Area::I => Some(I_START),
            Area::Q => Some(Q_START),
            Area::M => Some(M_START),
            Area::Sm => Some(SM_START),
            Area::S => Some(S_START),
            Area::T => Some(T_BITS_START),
            Area::C => Some(C_BITS_START),
            Area::L => Some(L_START),
            Area::V => None,
        }
    }

    /// Bytes the area takes in the bit page. SM bytes after them are placed by the plan.
    pub const fn page_len(self) -> u16 {
        match self {
            Area::T | Area::C | Area::Sm => 32,
            Area::V => 0,
            other => other.size(),
        }
    }

    /// First byte a program may write: SMB0-SMB29 belong to the system (docs/s7-200.md 3.1).
    pub const fn first_writable(self) -> u16 {
        match self {
            Area::Sm => 30,
            _ => 0,
        }
    }

    /// The area of a bit page address, with the byte number in it. `None` outside of the page.
    pub fn of_page_address(address: u16) -> Option<(Area, u16)> {
        let area = match address {
            I_START..Q_START => Area::I,
            Q_START..M_START => Area::Q,
            M_START..SM_START => Area::M,
            SM_START..S_START => Area::Sm,
            S_START..T_BITS_START => Area::S,
            T_BITS_START..C_BITS_START => Area::T,
            C_BITS_START..L_START => Area::C,
            L_START..AIW_START => Area::L,
            _ => return None,
        };
        Some((area, address - area.page_start()?))
    }
}

/// An analog input, in one of its two scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AnalogInput {
    /// AIW0, AIW2, ...: 0..=32000. Holds the channel, 0..=5.
    Scaled(u8),
    /// Ain0, Ain1, ...: raw counts 0..=1023. Holds the channel, 0..=5.
    Raw(u8),
}

impl AnalogInput {
    /// Full scale of an AIW word at the reference voltage (docs/decisions.md).
    pub const SCALED_MAX: u16 = 32000;
    /// Full scale of the board's 10-bit converter.
    pub const RAW_MAX: u16 = 1023;

    /// Data address of the word.
    pub const fn address(self) -> u16 {
        match self {
            AnalogInput::Scaled(channel) => AIW_START + 2 * channel as u16,
            AnalogInput::Raw(channel) => AIN_START + 2 * channel as u16,
        }
    }

    /// The analog input whose word is at this data address.
    pub const fn at_address(address: u16) -> Option<AnalogInput> {
        if address < AIW_START
            || address >= AIN_START + 2 * ANALOG_INPUTS
            || !address.is_multiple_of(2)
        {
            return None;
        }
        let index = ((address - AIW_START) / 2) as u8;
        if index < ANALOG_INPUTS as u8 {
            Some(AnalogInput::Scaled(index))
        } else {
            Some(AnalogInput::Raw(index - ANALOG_INPUTS as u8))
        }
    }

    /// By 65,536 it is 32,000 / 1,023, near enough for every count: a division takes the board
    /// longer than a scan has.
    pub const SCALE: u32 = 2_050_002;

    /// The AIW value of a raw count, rounded to the nearest.
    pub const fn scale(raw: u16) -> u16 {
        let raw = if raw > Self::RAW_MAX { Self::RAW_MAX } else { raw };
        ((raw as u32 * Self::SCALE + 0x8000) >> 16) as u16
    }

    /// The raw count nearest to an AIW value.
    pub const fn unscale(scaled: u16) -> u16 {
        let scaled = if scaled > Self::SCALED_MAX { Self::SCALED_MAX } else { scaled } as u32;
        ((scaled * Self::RAW_MAX as u32 + Self::SCALED_MAX as u32 / 2) / Self::SCALED_MAX as u32)
            as u16
    }
}

/// What a timer counts in (docs/s7-200.md 2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TimerResolution {
    /// 1 ms, up to 32.767 s.
    Ms1,
    /// 10 ms, up to 327.67 s.
    Ms10,
    /// 100 ms, up to 3276.7 s.
    Ms100,
}

impl TimerResolution {
    /// Length of one count in milliseconds.
    pub const fn ms(self) -> u16 {
        match self {
            TimerResolution::Ms1 => 1,
            TimerResolution::Ms10 => 10,
            TimerResolution::Ms100 => 100,
        }
    }
}

/// Which instructions a timer number belongs to (docs/s7-200.md 2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TimerFamily {
    /// T0-T31 and T64-T95.
    Tonr,
    /// T32-T63 and T96-T255: TON or TOF.
    TonTof,
}

/// The resolution of a timer, by its number: the first five of each 32 up to T100 are the fast
/// ones.
pub const fn timer_resolution(number: u8) -> TimerResolution {
    match number % 32 {
        _ if number > 100 => TimerResolution::Ms100,
        0 => TimerResolution::Ms1,
        1..=4 => TimerResolution::Ms10,
        _ => TimerResolution::Ms100,
    }
}

/// The family of a timer, by its number.
pub const fn timer_family(number: u8) -> TimerFamily {
    match number {
        0..=31 | 64..=95 => TimerFamily::Tonr,
        _ => TimerFamily::TonTof,
    }
}

#[cfg(test)]
mod tests {
    use super::AnalogInput;

    #[test]
    fn every_raw_count_is_scaled_to_the_nearest() {
        let (raw_max, scaled_max) =
            (u32::from(AnalogInput::RAW_MAX), u32::from(AnalogInput::SCALED_MAX));
        for raw in 0..=raw_max {
            let nearest = (raw * scaled_max + raw_max / 2) / raw_max;
            assert_eq!(u32::from(AnalogInput::scale(raw as u16)), nearest, "{raw}");
        }
        assert_eq!(AnalogInput::scale(u16::MAX), AnalogInput::SCALED_MAX);
    }
}
