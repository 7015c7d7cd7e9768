//! Operands as people write them beside a program, in scenarios and on command lines. What can be
//! done with them is not known here.

use std::fmt;

use crate::text::address::{Address, AddressError};
use crate::text::ast::{Symbol, Value};
use crate::text::suggest::{nearby_address, nearest};

/// What is meant of an address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Its value; of a timer or counter the bit.
    Value,
    /// The current value of a timer or counter, written `T37.cv`.
    Current,
    /// The real in a double word or accumulator, written `VD20:real`.
    Real,
}

/// Why a text is no operand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OperandError {
    /// What is wrong: a sentence without full stop.
    pub message: String,
    /// What may have been meant.
    pub suggestion: Option<String>,
}

impl OperandError {
    /// An error that knows what was meant.
    pub fn meant(message: String, suggestion: &str) -> OperandError {
        OperandError { message, suggestion: Some(suggestion.to_string()) }
    }
}

/// Reads an operand: an address or a symbol (quoted or not), with `.cv` after a timer or counter
/// for its current value, with `:real` after a double word that holds a real. Any letter case.
pub fn parse(text: &str, symbols: &[Symbol]) -> Result<(Address, Part), OperandError> {
    let text = text.trim();
    // The counter of another language has a variable of this name.
    let is_symbol = find(text, symbols).is_some();
    if let Some(stem) = strip_ending(text, ".cv").filter(|_| !is_symbol) {
        return match address(stem, symbols)? {
            address @ (Address::Timer(_) | Address::Counter(_)) => Ok((address, Part::Current)),
            _ => Err(OperandError::meant(
                format!("{text}: only timers and counters have a current value (.cv)"),
                stem,
            )),
        };
    }
    if let Some(stem) = strip_ending(text, ":real") {
        return match address(stem, symbols)? {
            address @ (Address::Double { .. } | Address::Accumulator(_)) => {
                Ok((address, Part::Real))
            }
            _ => Err(OperandError::meant(
                format!("{text}: only double words and accumulators hold a real"),
                stem,
            )),
        };
    }
    Ok((address(text, symbols)?, Part::Value))
}

/// What is before an ending such as `.cv`, in any letter case; `None` where it does not end so.
pub fn strip_ending<'a>(text: &'a str, ending: &str) -> Option<&'a str> {
    let (stem, tail) = text.split_at_checked(text.len().checked_sub(ending.len())?)?;
    tail.eq_ignore_ascii_case(ending).then_some(stem)
}

/// Reads an address or a symbol for one.
pub fn address(text: &str, symbols: &[Symbol]) -> Result<Address, OperandError> {
    let name = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
    if let Some(symbol) = find(name, symbols) {
        return match symbol.value {
            Value::Address(address) => Ok(address),
            _ => Err(OperandError {
                message: format!("{text}: this symbol is no address"),
                suggestion: None,
            }),
        };
    }
    Address::parse(text).map_err(|error| match error {
        AddressError::OutOfRange(message, suggestion) => OperandError { message, suggestion },
        AddressError::NotAnAddress => OperandError {
            message: match symbols.is_empty() {
                true => {
                    format!(
                        "{text} is no address, and no symbols are known: they come with AWL \
                        text that declares them, or with --symbols"
                    )
                }
                false => format!("{text} is neither an address nor a symbol of the program"),
            },
            suggestion: near(name, symbols),
        },
    })
}

/// Names are found in any letter case, as in Micro/WIN.
fn find<'s>(name: &str, symbols: &'s [Symbol]) -> Option<&'s Symbol> {
    let exact = symbols.iter().find(|symbol| symbol.name == name);
    let lower = name.to_lowercase();
    exact.or_else(|| symbols.iter().find(|symbol| symbol.name.to_lowercase() == lower))
}

fn near(name: &str, symbols: &[Symbol]) -> Option<String> {
    let symbol = nearest(name, symbols.iter().map(|symbol| &*symbol.name));
    symbol.map(str::to_string).or_else(|| nearby_address(name))
}

impl fmt::Display for OperandError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.suggestion {
            Some(suggestion) => write!(f, " (did you mean {suggestion}?)"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for OperandError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols() -> Vec<Symbol> {
        let symbol =
            |name: &str, value| Symbol { name: name.to_string(), value, comment: String::new() };
        let address = |text| Value::Address(Address::parse(text).unwrap());
        vec![
            symbol("Delay", address("T101")),
            symbol("lift up", address("Q0.1")),
            symbol("Limit", Value::Invalid),
        ]
    }

    fn shown(text: &str) -> String {
        match parse(text, &symbols()) {
            Ok((address, part)) => format!("{address} {part:?}"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn addresses_and_symbols() {
        let cases = [
            ("i0.0", "I0.0 Value"),
            (" e0.1 ", "I0.1 Value"),
            ("t37", "T37 Value"),
            ("Lift Up", "Q0.1 Value"),
            ("\"lift up\"", "Q0.1 Value"),
            ("delay", "T101 Value"),
            ("Delay.cv", "T101 Current"),
            ("\"Delay\".cv", "T101 Current"),
            ("z5.CV", "C5 Current"),
            ("VD8:REAL", "VD8 Real"),
            ("AC1:real", "AC1 Real"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected, "{text}");
        }
    }

    #[test]
    fn what_was_meant() {
        let cases = [
            (
                "lift uo",
                "lift uo is neither an address nor a symbol of the program (did you mean lift up?)",
            ),
            ("IO.0", "IO.0 is neither an address nor a symbol of the program (did you mean I0.0?)"),
            ("I0.9", "I0.9: a byte has bits 0 to 7 (did you mean I1.1?)"),
            (
                "MW3.cv",
                "MW3.cv: only timers and counters have a current value (.cv) (did you mean MW3?)",
            ),
            (
                "VW8:real",
                "VW8:real: only double words and accumulators hold a real (did you mean VW8?)",
            ),
            (
                "HC0:real",
                "HC0:real: only double words and accumulators hold a real (did you mean HC0?)",
            ),
            ("limit", "limit: this symbol is no address"),
            ("ä", "ä is neither an address nor a symbol of the program"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected);
        }
        let error = parse("Motor", &[]).unwrap_err();
        assert!(error.message.contains("--symbols"), "{error}");
    }
}
