//! Addresses as people write them: `I0.0`, `MW3`, `T37`, `AIW0`, `Ain0`; German letters too. No placement.

use std::fmt;

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
    /// A timer: its bit, or its current value where a word is asked for.
    Timer(u8),
    /// A counter: its bit, or its current value where a word is asked for.
    Counter(u8),
    /// An analog input word.
    Analog(AnalogInput),
}

/// Why a text is no address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AddressError {
    /// It does not look like an address at all: perhaps a symbol.
    NotAnAddress,
    /// It is an address of an S7-200 that this version does not have.
    NotSupported(String),
    /// It has the form of an address, but no such address exists. Message, and what may have been meant.
    OutOfRange(String, Option<String>),
}

impl Address {
    /// Reads an address in any letter case.
    ///
    /// Area letters: I Q M SM S V T C, German E A Z, AIW and AEW, and Ain0 to Ain5 for raw counts.
    pub fn parse(text: &str) -> Result<Address, AddressError> {
        let digits_at = text.find(|c: char| c.is_ascii_digit()).ok_or(AddressError::NotAnAddress)?;
        let (letters, number) = text.split_at(digits_at);
        if !number.bytes().all(|b| b.is_ascii_digit() || b == b'.') || letters.len() > 3 {
            return Err(AddressError::NotAnAddress);
        }
        let mut upper = [0; 3];
        for (place, byte) in upper.iter_mut().zip(letters.bytes()) {
            *place = byte.to_ascii_uppercase();
        }
        let letters = std::str::from_utf8(&upper[..letters.len()]).map_err(|_| AddressError::NotAnAddress)?;
        let (area, size) = match letters {
            "T" => return numbered(text, number, "timers", "T", Address::Timer),
            "C" | "Z" => return numbered(text, number, "counters", "C", Address::Counter),
            "AIN" => return raw_analog(text, number),
            "AIW" | "AI" | "AEW" | "AE" => return scaled_analog(text, number),
            _ => area_and_size(letters, text)?,
        };
        in_area(text, area, size, number)
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Size {
    Bit,
    Byte,
    Word,
}

fn area_and_size(letters: &str, text: &str) -> Result<(Area, Size), AddressError> {
    let (area, rest) = match letters.as_bytes() {
        [b'S', b'M', rest @ ..] => (Area::Sm, rest),
        [b'I' | b'E', rest @ ..] => (Area::I, rest),
        [b'Q', rest @ ..] => (Area::Q, rest),
        [b'A', rest @ ..] if matches!(rest, [] | [b'B' | b'W' | b'D' | b'X']) => (Area::Q, rest),
        [b'M', rest @ ..] => (Area::M, rest),
        [b'S', rest @ ..] => (Area::S, rest),
        [b'V', rest @ ..] => (Area::V, rest),
        b"AC" => return Err(not_supported(text, "accumulators are")),
        b"L" | b"LB" | b"LW" | b"LD" => return Err(not_supported(text, "local memory is")),
        b"HC" | b"HZ" => return Err(not_supported(text, "high-speed counters are")),
        b"AQ" | b"AQW" | b"AA" | b"AAW" => return Err(not_supported(text, "analog outputs are")),
        _ => return Err(AddressError::NotAnAddress),
    };
    match rest {
        [] | [b'X'] => Ok((area, Size::Bit)),
        [b'B'] => Ok((area, Size::Byte)),
        [b'W'] => Ok((area, Size::Word)),
        [b'D'] => Err(not_supported(text, "double words are")),
        _ => Err(AddressError::NotAnAddress),
    }
}

fn not_supported(text: &str, what: &str) -> AddressError {
    AddressError::NotSupported(format!("{text}: {what} not supported yet"))
}

fn out_of_range(message: String, suggestion: impl Into<Option<String>>) -> AddressError {
    AddressError::OutOfRange(message, suggestion.into())
}

/// The number, saturated: too many digits are out of range everywhere.
fn number_of(digits: &str) -> u32 {
    digits.parse().unwrap_or(u32::MAX)
}

fn numbered(
    text: &str,
    number: &str,
    what: &str,
    letter: &str,
    make: fn(u8) -> Address,
) -> Result<Address, AddressError> {
    if number.contains('.') {
        let plain = format!("{letter}{}", number.split('.').next().unwrap_or(""));
        return Err(out_of_range(format!("{text}: {what} have no bit number"), plain));
    }
    match u8::try_from(number_of(number)) {
        Ok(number) => Ok(make(number)),
        Err(_) => Err(out_of_range(format!("{text}: {what} are {letter}0 to {letter}255"), None)),
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
        byte if byte < limit && !number.contains('.') => {
            Err(out_of_range(format!("{text}: analog inputs have even addresses"), Some(format!("AIW{}", byte - 1))))
        }
        _ => Err(out_of_range(format!("{text}: the analog inputs are AIW0, AIW2, ... AIW10"), None)),
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
                return Err(out_of_range(format!("{text}: {name} has the bits {name}0.0 to {name}{last}.7"), None));
            }
            match number_of(bit) {
                bit @ 0..=7 => Ok(Address::Bit { area, byte: byte as u16, bit: bit as u8 }),
                bit => Err(out_of_range(
                    format!("{text}: a byte has bits 0 to 7"),
                    (byte < last && (8..=9).contains(&bit)).then(|| format!("{name}{}.{}", byte + 1, bit - 8)),
                )),
            }
        }
        (Size::Bit, None) => Err(out_of_range(
            format!("{text}: a bit address has a byte and a bit number, such as {name}{}.0", byte.min(last)),
            None,
        )),
        (_, Some(_)) => Err(out_of_range(
            format!("{text}: only a bit address has a bit number"),
            Some(format!("{name}{}.{}", byte.min(last), bit_digits.unwrap_or("0"))),
        )),
        (Size::Byte, None) if byte <= last => Ok(Address::Byte { area, byte: byte as u16 }),
        (Size::Word, None) if byte < last => Ok(Address::Word { area, byte: byte as u16 }),
        (Size::Byte, None) => {
            Err(out_of_range(format!("{text}: {name} has the bytes {name}B0 to {name}B{last}"), None))
        }
        (Size::Word, None) => {
            Err(out_of_range(format!("{text}: {name} has the words {name}W0 to {name}W{}", last - 1), None))
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Address::Bit { area, byte, bit } => write!(f, "{}{byte}.{bit}", area.name()),
            Address::Byte { area, byte } => write!(f, "{}B{byte}", area.name()),
            Address::Word { area, byte } => write!(f, "{}W{byte}", area.name()),
            Address::Timer(number) => write!(f, "T{number}"),
            Address::Counter(number) => write!(f, "C{number}"),
            Address::Analog(AnalogInput::Scaled(channel)) => write!(f, "AIW{}", 2 * channel),
            Address::Analog(AnalogInput::Raw(channel)) => write!(f, "Ain{channel}"),
        }
    }
}
