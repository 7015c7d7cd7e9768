//! References: how the service functions name an operand, three bytes. From addresses to
//! references; no text.

use awl_asm::Address;
use awl_asm::units::LocalPlace;
use plc_isa::{AC_START, AQW_START, AnalogInput, Area, HC0, HC3, L_START, LOCALS_IN_V};

/// An operand as it stands in a request (docs/protocol.md): area and size, then byte offset or
/// number, high byte first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Reference(pub [u8; 3]);

/// Sizes 0 to 7 are that bit.
const BYTE: u8 = 8;
const WORD: u8 = 9;
const DOUBLE: u8 = 10;

/// The area of everything in the second page of data memory: analog inputs and outputs,
/// accumulators, fast counters.
const SECOND_PAGE: u8 = 9;
/// First data address of the second page.
const SECOND_PAGE_START: u16 = 0x0200;

impl Reference {
    /// Stands for "no operand" in a status window.
    pub const NONE: Reference = Reference([0xFF, 0, 0]);

    /// The reference to the value at an address. Of a timer or counter: its bit. `None` for HC1,
    /// HC2, HC4, HC5, which the board does not have, and for local memory, which every unit has
    /// elsewhere.
    pub fn to(address: Address) -> Option<Reference> {
        match address {
            Address::Bit { area, byte, bit } => outside(area, bit, byte),
            Address::Byte { area, byte } => outside(area, BYTE, byte),
            Address::Word { area, byte } => outside(area, WORD, byte),
            Address::Double { area, byte } => outside(area, DOUBLE, byte),
            Address::Timer(number) => Some(new(code(Area::T), 0, number.into())),
            Address::Counter(number) => Some(new(code(Area::C), 0, number.into())),
            Address::Analog(input) => Some(second_page(WORD, input.address())),
            Address::AnalogOutput(channel) => {
                Some(second_page(WORD, AQW_START + 2 * u16::from(channel)))
            }
            Address::Accumulator(number) => {
                Some(second_page(DOUBLE, AC_START + 4 * u16::from(number)))
            }
            Address::HighSpeedCounter(0) => Some(second_page(DOUBLE, HC0)),
            Address::HighSpeedCounter(3) => Some(second_page(DOUBLE, HC3)),
            Address::HighSpeedCounter(_) => None,
        }
    }

    /// The same, and local memory by the place that a unit gives a byte of it.
    pub fn in_unit(
        address: Address,
        local: impl Fn(u16) -> Option<LocalPlace>,
    ) -> Option<Reference> {
        let (size, byte) = match address {
            Address::Bit { area: Area::L, byte, bit } => (bit, byte),
            Address::Byte { area: Area::L, byte } => (BYTE, byte),
            Address::Word { area: Area::L, byte } => (WORD, byte),
            Address::Double { area: Area::L, byte } => (DOUBLE, byte),
            other => return Reference::to(other),
        };
        Some(match local(byte)? {
            LocalPlace::Page(address) => new(code(Area::L), size, address.checked_sub(L_START)?),
            LocalPlace::Arena(number) => new(code(Area::V), size, LOCALS_IN_V + number),
        })
    }

    /// The reference to a timer's current value.
    pub fn to_timer_value(number: u8) -> Reference {
        new(code(Area::T), WORD, number.into())
    }

    /// The reference to a counter's current value.
    pub fn to_counter_value(number: u8) -> Reference {
        new(code(Area::C), WORD, number.into())
    }

    /// The address it names; a current value of a timer or counter is its timer or counter. `None`
    /// for local memory and what is no reference.
    pub fn address(self) -> Option<Address> {
        let [first, high, low] = self.0;
        let (size, offset) = (first & 0x0F, u16::from_be_bytes([high, low]));
        let area = match first >> 4 {
            SECOND_PAGE => return second_page_address(offset),
            code => AREAS.get(usize::from(code)).copied()?,
        };
        match (area, size) {
            (Area::L, _) => None,
            (Area::V, _) if offset >= Area::V.size() => None,
            (Area::T, _) => Some(Address::Timer(u8::try_from(offset).ok()?)),
            (Area::C, _) => Some(Address::Counter(u8::try_from(offset).ok()?)),
            (area, BYTE) => Some(Address::Byte { area, byte: offset }),
            (area, WORD) => Some(Address::Word { area, byte: offset }),
            (area, DOUBLE) => Some(Address::Double { area, byte: offset }),
            (area, bit @ 0..=7) => Some(Address::Bit { area, byte: offset, bit }),
            _ => None,
        }
    }

    /// Bytes of its value in an answer: 1, 2 or 4.
    pub fn value_len(self) -> usize {
        match self.0[0] & 0x0F {
            WORD => 2,
            DOUBLE => 4,
            _ => 1,
        }
    }
}

fn new(area: u8, size: u8, offset: u16) -> Reference {
    let [high, low] = offset.to_be_bytes();
    Reference([area << 4 | size, high, low])
}

fn outside(area: Area, size: u8, byte: u16) -> Option<Reference> {
    (area != Area::L).then(|| new(code(area), size, byte))
}

fn second_page(size: u8, address: u16) -> Reference {
    new(SECOND_PAGE, size, address - SECOND_PAGE_START)
}

/// The areas by their codes.
const AREAS: [Area; 9] =
    [Area::I, Area::Q, Area::M, Area::Sm, Area::S, Area::T, Area::C, Area::L, Area::V];

fn code(area: Area) -> u8 {
    AREAS.iter().position(|&other| other == area).unwrap_or(usize::from(SECOND_PAGE)) as u8
}

fn second_page_address(offset: u16) -> Option<Address> {
    let address = SECOND_PAGE_START.checked_add(offset)?;
    let number = |start: u16, len: u16| u8::try_from((address - start) / len).ok();
    match address {
        AC_START..HC0 => Some(Address::Accumulator(number(AC_START, 4)?)),
        HC0 => Some(Address::HighSpeedCounter(0)),
        HC3 => Some(Address::HighSpeedCounter(3)),
        AQW_START.. if address < AQW_START + 4 => {
            Some(Address::AnalogOutput(number(AQW_START, 2)?))
        }
        _ => AnalogInput::at_address(address).map(Address::Analog),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(text: &str) -> Option<[u8; 3]> {
        Reference::to(Address::parse(text).unwrap()).map(|reference| reference.0)
    }

    #[test]
    fn every_area_and_size() {
        let cases = [
            ("I0.3", [0x03, 0, 0]),
            ("Q1.7", [0x17, 0, 1]),
            ("MB3", [0x28, 0, 3]),
            ("MW3", [0x29, 0, 3]),
            ("MD4", [0x2A, 0, 4]),
            ("SMB500", [0x38, 1, 0xF4]),
            ("S0.1", [0x41, 0, 0]),
            ("T37", [0x50, 0, 37]),
            ("C255", [0x60, 0, 255]),
            ("VW1000", [0x89, 3, 0xE8]),
            ("V5.2", [0x82, 0, 5]),
            ("AIW4", [0x99, 0, 4]),
            ("Ain1", [0x99, 0, 14]),
            ("AC3", [0x9A, 0, 36]),
            ("HC0", [0x9A, 0, 40]),
            ("HC3", [0x9A, 0, 44]),
            ("AQW2", [0x99, 0, 50]),
        ];
        for (text, expected) in cases {
            assert_eq!(bytes(text), Some(expected), "{text}");
            assert_eq!(Reference(expected).address(), Address::parse(text).ok(), "{text}");
        }
        assert_eq!((bytes("HC1"), bytes("L0.0"), bytes("LW2")), (None, None, None));
        assert_eq!(Reference::to_timer_value(37).0, [0x59, 0, 37]);
        assert_eq!(Reference::to_counter_value(5).0, [0x69, 0, 5]);
    }

    #[test]
    fn local_memory_is_where_the_unit_has_it() {
        let local = |byte: u16| match byte {
            0..4 => Some(LocalPlace::Page(L_START + 20 + byte)),
            60.. => Some(LocalPlace::Arena(byte - 60)),
            _ => None,
        };
        let of = |text| {
            Reference::in_unit(Address::parse(text).unwrap(), local).map(|reference| reference.0)
        };
        assert_eq!(of("LW2"), Some([0x79, 0, 22]));
        assert_eq!(of("L0.5"), Some([0x75, 0, 20]));
        assert_eq!(of("LB9"), None);
        assert_eq!(of("LW62"), Some([0x89, 0x28, 0x04]));
        assert_eq!(Reference([0x89, 0x28, 0x04]).address(), None);
        assert_eq!(of("I0.1"), Some([0x01, 0, 0]));
    }

    #[test]
    fn values_have_their_lengths() {
        let len = |text| Reference::to(Address::parse(text).unwrap()).unwrap().value_len();
        assert_eq!(
            ["I0.0", "T37", "MB0", "MW0", "AIW0", "VD0", "AC0"].map(len),
            [1, 1, 1, 2, 2, 4, 4]
        );
    }
}
