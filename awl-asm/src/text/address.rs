//! Addresses as people write them: `I0.0`, `MW3`, `VD8`, `T37`, `AC1`, `AIW0`; German letters too.
//! No placement.

use std::fmt;
use std::ops::Range;

use plc_isa::{ANALOG_INPUTS, AnalogInput, Area};

/// A memory address.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Address {
    /// A bit such as `I0.0`. Not of T or C.
    Bit {
        /// The area.
        area: Area,
        /// Byte number.
        byte: u16,
        /// Bit number, 0..=7.
        bit: u8,
    },
    /// A byte such as `MB3`.
    Byte {
        /// The area.
        area: Area,
        /// Byte number.
        byte: u16,
    },
    /// A word such as `MW3`, named by its first byte.
    Word {
        /// The area.
        area: Area,
        /// Number of its first byte.
        byte: u16,
    },
    /// A double word such as `VD0`, named by its first byte.
    Double {
        /// The area.
        area: Area,
        /// Number of its first byte.
        byte: u16,
    },
    /// A timer: its bit, or its current value where a word is asked for.
    Timer(u8),
    /// A counter: its bit, or its current value where a word is asked for.
    Counter(u8),
    /// An analog input word.
    Analog(AnalogInput),
    /// An analog output word, `AQW0` or `AQW2`. Holds the channel, 0..=1.
    AnalogOutput(u8),
    /// An accumulator, 0..=3: as long as the operand that is asked for.
    Accumulator(u8),
    /// The current value of a high-speed counter, 0..=5: a double word.
    HighSpeedCounter(u8),
}

/// Analog outputs: AQW0 and AQW2.
const ANALOG_OUTPUTS: u16 = 2;

/// Why a text is no address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AddressError {
    /// It does not look like an address at all: perhaps a symbol.
    NotAnAddress,
    /// It has the form of an address, but no such address exists. Message, and what may have been
    /// meant.
    OutOfRange(String, Option<String>),
}

impl Address {
    /// The area of a bit, byte, word or double word; `None` of what has a number alone.
    pub fn area(self) -> Option<Area> {
        match self {
            Address::Bit { area, .. }
            | Address::Byte { area, .. }
            | Address::Word { area, .. }
            | Address::Double { area, .. } => Some(area),
            Address::Timer(_)
            | Address::Counter(_)
            | Address::Accumulator(_)
            | Address::HighSpeedCounter(_)
            | Address::Analog(_)
            | Address::AnalogOutput(_) => None,
        }
    }

    /// The bytes of a byte, word or double word.
    pub fn bytes(self) -> Option<(Area, Range<u16>)> {
        match self {
            Address::Byte { area, byte } => Some((area, byte..byte + 1)),
            Address::Word { area, byte } => Some((area, byte..byte + 2)),
            Address::Double { area, byte } => Some((area, byte..byte + 4)),
            _ => None,
        }
    }

    /// Whether what is written to the one can change the other: `VW0` and `VB1`, `M0.0` and `MB0`.
    pub fn overlaps(self, other: Address) -> bool {
        let is_bit = |one| matches!(one, Address::Bit { .. });
        if self == other || (is_bit(self) && is_bit(other)) {
            return self == other;
        }
        let place = |one| match one {
            Address::Bit { area, byte, .. } => Some((area, byte..byte + 1)),
            _ => one.bytes(),
        };
        let (Some((area, own)), Some((other, bytes))) = (place(self), place(other)) else {
            return false;
        };
        area == other && own.start < bytes.end && bytes.start < own.end
    }

    /// Whether `text`, as which it is written, has a German area letter, such as E0.0 or Z1.
    pub(crate) fn is_german(self, text: &str) -> bool {
        let letter = self.to_string().chars().next();
        text.chars().next().map(|c| c.to_ascii_uppercase()) != letter
    }

    /// Reads an address in any letter case.
    ///
    /// Area letters: I Q M SM S V L T C AC HC AIW AQW, German E A Z HZ AEW AAW, and Ain0 to Ain5
    /// for raw counts.
    pub fn parse(text: &str) -> Result<Address, AddressError> {
        let digits_at =
            text.find(|c: char| c.is_ascii_digit()).ok_or(AddressError::NotAnAddress)?;
        let (letters, number) = text.split_at(digits_at);
        if !number.bytes().all(|b| b.is_ascii_digit() || b == b'.') || letters.len() > 3 {
            return Err(AddressError::NotAnAddress);
        }
        let mut upper = [0; 3];
        for (place, byte) in upper.iter_mut().zip(letters.bytes()) {
            *place = byte.to_ascii_uppercase();
        }
        let letters =
            std::str::from_utf8(&upper[..letters.len()]).map_err(|_| AddressError::NotAnAddress)?;
        let (area, size) = match letters {
            "T" => return TIMERS.read(text, number, Address::Timer),
            "C" | "Z" => return COUNTERS.read(text, number, Address::Counter),
            "AC" => return ACCUMULATORS.read(text, number, Address::Accumulator),
            "HC" | "HZ" => {
                return HIGH_SPEED_COUNTERS.read(text, number, Address::HighSpeedCounter);
            }
            "AIN" => return raw_analog(text, number),
            "AIW" | "AI" | "AEW" | "AE" => return scaled_analog(text, number),
            "AQW" | "AQ" | "AAW" | "AA" => return analog_output(text, number),
            _ => area_and_size(letters)?,
        };
        in_area(text, area, size, number)
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Size {
    Bit,
    Byte,
    Word,
    Double,
}

impl Size {
    /// Bytes from its first to after its last; a bit lies in one.
    fn bytes(self) -> u32 {
        match self {
            Size::Bit | Size::Byte => 1,
            Size::Word => 2,
            Size::Double => 4,
        }
    }

    /// The letter of the size, and what such addresses are called.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Size::Bit => ("", "bits"),
            Size::Byte => ("B", "bytes"),
            Size::Word => ("W", "words"),
            Size::Double => ("D", "double words"),
        }
    }
}

fn area_and_size(letters: &str) -> Result<(Area, Size), AddressError> {
    let (area, rest) = match letters.as_bytes() {
        [b'S', b'M', rest @ ..] => (Area::Sm, rest),
        [b'I' | b'E', rest @ ..] => (Area::I, rest),
        [b'Q', rest @ ..] => (Area::Q, rest),
        [b'A', rest @ ..] if matches!(rest, [] | [b'B' | b'W' | b'D' | b'X']) => (Area::Q, rest),
        [b'M', rest @ ..] => (Area::M, rest),
        [b'S', rest @ ..] => (Area::S, rest),
        [b'V', rest @ ..] => (Area::V, rest),
        [b'L', rest @ ..] => (Area::L, rest),
        _ => return Err(AddressError::NotAnAddress),
    };
    match rest {
        [] | [b'X'] => Ok((area, Size::Bit)),
        [b'B'] => Ok((area, Size::Byte)),
        [b'W'] => Ok((area, Size::Word)),
        [b'D'] => Ok((area, Size::Double)),
        _ => Err(AddressError::NotAnAddress),
    }
}

fn out_of_range(message: String, suggestion: impl Into<Option<String>>) -> AddressError {
    AddressError::OutOfRange(message, suggestion.into())
}

/// The number, saturated: too many digits are out of range everywhere.
fn number_of(digits: &str) -> u32 {
    digits.parse().unwrap_or(u32::MAX)
}

/// Addresses that are a number after letters.
struct Numbered {
    /// What they are called.
    what: &'static str,
    letters: &'static str,
    last: u8,
}

const TIMERS: Numbered = Numbered { what: "timers", letters: "T", last: 255 };
const COUNTERS: Numbered = Numbered { what: "counters", letters: "C", last: 255 };
const ACCUMULATORS: Numbered = Numbered { what: "accumulators", letters: "AC", last: 3 };
const HIGH_SPEED_COUNTERS: Numbered =
    Numbered { what: "high-speed counters", letters: "HC", last: 5 };

impl Numbered {
    fn read(
        &self,
        text: &str,
        number: &str,
        make: fn(u8) -> Address,
    ) -> Result<Address, AddressError> {
        let Numbered { what, letters, last } = self;
        if let Some((number, _)) = number.split_once('.') {
            return Err(out_of_range(
                format!("{text}: {what} have no bit number"),
                format!("{letters}{number}"),
            ));
        }
        match u8::try_from(number_of(number)) {
            Ok(number) if number <= *last => Ok(make(number)),
            _ => {
                Err(out_of_range(format!("{text}: {what} are {letters}0 to {letters}{last}"), None))
            }
        }
    }
}

fn raw_analog(text: &str, number: &str) -> Result<Address, AddressError> {
    match number_of(number) {
        channel if channel < u32::from(ANALOG_INPUTS) && !number.contains('.') => {
            Ok(Address::Analog(AnalogInput::Raw(channel as u8)))
        }
        _ => Err(out_of_range(format!("{text}: the raw analog inputs are Ain0 to Ain5"), None)),
    }
}

fn scaled_analog(text: &str, number: &str) -> Result<Address, AddressError> {
    let limit = 2 * u32::from(ANALOG_INPUTS);
    match number_of(number) {
        byte if byte < limit && byte % 2 == 0 && !number.contains('.') => {
            Ok(Address::Analog(AnalogInput::Scaled((byte / 2) as u8)))
        }
        byte if byte < limit && !number.contains('.') => Err(out_of_range(
            format!(
                "{text}: each analog input is a word, the first is AIW0, the second AIW2, to AIW10"
            ),
            None,
        )),
        _ => {
            Err(out_of_range(format!("{text}: the analog inputs are AIW0, AIW2, ... AIW10"), None))
        }
    }
}

fn analog_output(text: &str, number: &str) -> Result<Address, AddressError> {
    match number_of(number) {
        byte if byte < 2 * u32::from(ANALOG_OUTPUTS) && byte % 2 == 0 && !number.contains('.') => {
            Ok(Address::AnalogOutput((byte / 2) as u8))
        }
        _ => Err(out_of_range(format!("{text}: the analog outputs are AQW0 and AQW2"), None)),
    }
}

fn in_area(text: &str, area: Area, size: Size, number: &str) -> Result<Address, AddressError> {
    let (byte_digits, bit_digits) = match number.split_once('.') {
        Some((byte, bit)) => (byte, Some(bit)),
        None => (number, None),
    };
    if byte_digits.is_empty() || bit_digits.is_some_and(|bit| bit.is_empty() || bit.contains('.')) {
        return Err(out_of_range(format!("{text}: an address ends with its number"), None));
    }
    let name = area.name();
    let byte = number_of(byte_digits);
    let last = u32::from(area.size()) - 1;
    match (size, bit_digits) {
        (Size::Bit, Some(bit)) => {
            if byte > last {
                return Err(out_of_range(
                    format!("{text}: {name} has the bits {name}0.0 to {name}{last}.7"),
                    None,
                ));
            }
            match number_of(bit) {
                bit @ 0..=7 => Ok(Address::Bit { area, byte: byte as u16, bit: bit as u8 }),
                bit => Err(out_of_range(
                    format!("{text}: a byte has bits 0 to 7"),
                    // Special bits have a meaning each: none is near another.
                    (byte < last && (8..=15).contains(&bit) && area != Area::Sm)
                        .then(|| format!("{name}{}.{}", byte + 1, bit - 8)),
                )),
            }
        }
        (Size::Bit, None) => {
            let example = match (area, byte) {
                (Area::I | Area::Q, 0..=7) => format!("{name}0.{byte}"),
                _ => format!("{name}{}.0", byte.min(last)),
            };
            Err(out_of_range(
                format!("{text}: a bit address has a byte and a bit number, such as {example}"),
                without_point(number, last).map(|bit| format!("{name}{bit}")),
            ))
        }
        (_, Some(_)) => Err(out_of_range(
            format!("{text}: only a bit address has a bit number"),
            Some(format!("{name}{}.{}", byte.min(last), bit_digits.unwrap_or("0"))),
        )),
        (size, None) => {
            let last = u32::from(area.size()) - size.bytes();
            if byte > last {
                let (letter, what) = size.words();
                let message = format!(
                    "{text}: {name} has the {what} {name}{letter}0 to {name}{letter}{last}"
                );
                return Err(out_of_range(message, None));
            }
            let byte = byte as u16;
            Ok(match size {
                Size::Word => Address::Word { area, byte },
                Size::Double => Address::Double { area, byte },
                Size::Bit | Size::Byte => Address::Byte { area, byte },
            })
        }
    }
}

/// `0.1` of `01`: byte and bit without the point between them, where they are no byte alone.
fn without_point(digits: &str, last: u32) -> Option<String> {
    let (byte, bit) = digits.split_at_checked(digits.len().checked_sub(1)?)?;
    let is_pair = byte.starts_with('0') || number_of(digits) > last;
    let is_bit = is_pair && !byte.is_empty() && number_of(byte) <= last && number_of(bit) <= 7;
    is_bit.then(|| format!("{}.{bit}", number_of(byte)))
}

/// A range of bytes, or of timers or counters, as settings name it: `VB0-VB31`, `C3`.
pub fn range_text(area: Area, first: u16, count: u16) -> String {
    let letter = match area {
        Area::V => "VB",
        Area::M => "MB",
        other => other.name(),
    };
    match count {
        1 => format!("{letter}{first}"),
        count => format!("{letter}{first}-{letter}{}", first + count - 1),
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Address::Bit { area, byte, bit } => write!(f, "{}{byte}.{bit}", area.name()),
            Address::Byte { area, byte } => write!(f, "{}B{byte}", area.name()),
            Address::Word { area, byte } => write!(f, "{}W{byte}", area.name()),
            Address::Double { area, byte } => write!(f, "{}D{byte}", area.name()),
            Address::Timer(number) => write!(f, "T{number}"),
            Address::Counter(number) => write!(f, "C{number}"),
            Address::Analog(AnalogInput::Scaled(channel)) => write!(f, "AIW{}", 2 * channel),
            Address::Analog(AnalogInput::Raw(channel)) => write!(f, "Ain{channel}"),
            Address::AnalogOutput(channel) => write!(f, "AQW{}", 2 * channel),
            Address::Accumulator(number) => write!(f, "AC{number}"),
            Address::HighSpeedCounter(number) => write!(f, "HC{number}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        match Address::parse(text) {
            Ok(address) => address.to_string(),
            Err(AddressError::OutOfRange(message, _)) => message,
            Err(AddressError::NotAnAddress) => "none".to_owned(),
        }
    }

    #[test]
    fn every_class_reads_as_it_is_shown() {
        let bits = "I0.0 Q15.7 M31.7 SM0.1 SM549.7 S31.7 V10239.7 L63.7";
        let bytes = "IB15 QB0 MB31 SMB549 SB31 VB10239 LB63";
        let words = "IW14 QW0 MW30 SMW548 SW30 VW10238 LW62 T255 C0 AIW10 Ain5 AQW0 AQW2";
        let doubles = "ID12 QD0 MD28 SMD546 SD28 VD10236 LD60 AC0 AC3 HC0 HC5";
        for text in [bits, bytes, words, doubles].into_iter().flat_map(str::split_ascii_whitespace)
        {
            assert_eq!(shown(text), text);
            assert_eq!(shown(&text.to_lowercase()), text);
        }
    }

    #[test]
    fn other_spellings() {
        let german = [
            ("E0.0", "I0.0"),
            ("A0.1", "Q0.1"),
            ("AD0", "QD0"),
            ("ED4", "ID4"),
            ("Z5", "C5"),
            ("HZ3", "HC3"),
        ];
        let short = [
            ("AEW2", "AIW2"),
            ("AE2", "AIW2"),
            ("AI2", "AIW2"),
            ("AAW2", "AQW2"),
            ("AQ2", "AQW2"),
            ("VX0.1", "V0.1"),
        ];
        for (text, meant) in german.into_iter().chain(short) {
            assert_eq!(shown(text), meant);
        }
    }

    #[test]
    fn ends_of_ranges() {
        assert_eq!(shown("VD10237"), "VD10237: V has the double words VD0 to VD10236");
        assert_eq!(shown("MD29"), "MD29: M has the double words MD0 to MD28");
        assert_eq!(shown("L64.0"), "L64.0: L has the bits L0.0 to L63.7");
        assert_eq!(shown("SMB550"), "SMB550: SM has the bytes SMB0 to SMB549");
        assert_eq!(shown("AC4"), "AC4: accumulators are AC0 to AC3");
        assert_eq!(shown("AC0.1"), "AC0.1: accumulators have no bit number");
        assert_eq!(shown("HC6"), "HC6: high-speed counters are HC0 to HC5");
        assert_eq!(shown("AQW1"), "AQW1: the analog outputs are AQW0 and AQW2");
        assert_eq!(shown("VD"), "none");
        assert_eq!(shown("XD0"), "none");
    }
}
