//! What can be read, set and forced: an address or symbol as people write it, with its reference and the form of its
//! values. Nothing is asked of a PLC.

use std::fmt;

use awl_asm::Address;
use awl_asm::address::AddressError;
use awl_asm::ast::{Symbol, Value};
use awl_asm::suggest::nearest;

use crate::reference::Reference;
use crate::value::Form;

/// An operand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Operand {
    /// How the user wrote it.
    pub name: String,
    /// The address; of a current value that of its timer or counter.
    pub address: Address,
    /// How the PLC is asked for it.
    pub reference: Reference,
    /// How its values are written.
    pub form: Form,
}

/// Why a text is no operand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OperandError {
    /// What is wrong.
    pub message: String,
    /// What may have been meant.
    pub suggestion: Option<String>,
}

impl Operand {
    /// Reads an operand: an address or a symbol (quoted or not), with `.cv` behind a timer or counter for its current
    /// value, with `:real` behind a double word that holds a real. Any letter case.
    pub fn parse(text: &str, symbols: &[Symbol]) -> Result<Operand, OperandError> {
        let text = text.trim();
        if let Some(stem) = strip_ending(text, ".cv") {
            let address = address(stem, symbols)?;
            let reference = match address {
                Address::Timer(number) => Reference::to_timer_value(number),
                Address::Counter(number) => Reference::to_counter_value(number),
                _ => return Err(meant(format!("{text}: only timers and counters have a current value (.cv)"), stem)),
            };
            return Ok(Operand { name: text.to_string(), address, reference, form: Form::Word });
        }
        if let Some(stem) = strip_ending(text, ":real") {
            let operand = Operand::at(text, address(stem, symbols)?)?;
            if operand.form != Form::Double || matches!(operand.address, Address::HighSpeedCounter(_)) {
                return Err(meant(format!("{text}: only double words and accumulators hold a real"), stem));
            }
            return Ok(Operand { form: Form::Real, ..operand });
        }
        Operand::at(text, address(text, symbols)?)
    }

    /// The value at an address, under this name.
    pub fn at(name: &str, address: Address) -> Result<Operand, OperandError> {
        let reference = Reference::to(address).ok_or_else(|| match address {
            Address::HighSpeedCounter(_) => {
                meant(format!("{name}: the board has the high-speed counters HC0 and HC3"), "HC0")
            }
            _ => OperandError {
                message: format!("{name}: local memory has another place in every unit of the program"),
                suggestion: None,
            },
        })?;
        Ok(Operand { name: name.to_string(), address, reference, form: Form::of(address) })
    }

    /// The name in its official spelling, such as `T37.cv`.
    pub fn official(&self) -> String {
        match (self.address, self.form) {
            (Address::Timer(_) | Address::Counter(_), Form::Word) => format!("{}.cv", self.address),
            (address, Form::Real) => format!("{address}:real"),
            (address, _) => address.to_string(),
        }
    }
}

fn meant(message: String, suggestion: &str) -> OperandError {
    OperandError { message, suggestion: Some(suggestion.to_string()) }
}

fn strip_ending<'a>(text: &'a str, ending: &str) -> Option<&'a str> {
    let stem_len = text.len().checked_sub(ending.len())?;
    let tail = text.get(stem_len..)?;
    tail.eq_ignore_ascii_case(ending).then(|| &text[..stem_len])
}

fn address(text: &str, symbols: &[Symbol]) -> Result<Address, OperandError> {
    let name = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
    if let Some(symbol) = find(name, symbols) {
        return match symbol.value {
            Value::Address(address) => Ok(address),
            _ => Err(OperandError { message: format!("{text}: this symbol is no address"), suggestion: None }),
        };
    }
    Address::parse(text).map_err(|error| match error {
        AddressError::OutOfRange(message, suggestion) => OperandError { message, suggestion },
        AddressError::NotAnAddress => OperandError {
            message: match symbols.is_empty() {
                true => format!("{text} is no address; symbols are known with --program or --symbols"),
                false => format!("{text} is neither an address nor a symbol of the program"),
            },
            suggestion: near(name, symbols),
        },
    })
}

fn find<'s>(name: &str, symbols: &'s [Symbol]) -> Option<&'s Symbol> {
    let lower = name.to_lowercase();
    let exact = symbols.iter().find(|symbol| symbol.name == name);
    exact.or_else(|| symbols.iter().find(|symbol| symbol.name.to_lowercase() == lower))
}

/// A symbol of a similar name, or the address in which digits and letters were taken for each other.
fn near(name: &str, symbols: &[Symbol]) -> Option<String> {
    let symbol = nearest(name, symbols.iter().map(|symbol| &*symbol.name)).map(str::to_string);
    symbol.or_else(|| {
        let digits = |text: &str| text.replace(['O', 'o'], "0").replace(['l', ','], ".").replace("..", ".");
        let (area, number) = name.split_at(name.char_indices().nth(1)?.0);
        let repaired = format!("{area}{}", digits(number));
        Address::parse(&repaired).ok().map(|address| address.to_string())
    })
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
        let symbol = |name: &str, address: &str| Symbol {
            name: name.to_string(),
            value: Value::Address(Address::parse(address).unwrap()),
            comment: String::new(),
        };
        vec![symbol("Delay", "T101"), symbol("lift up", "Q0.1")]
    }

    fn shown(text: &str) -> String {
        match Operand::parse(text, &symbols()) {
            Ok(operand) => format!("{} {:?} {:?}", operand.official(), operand.reference.0, operand.form),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn addresses_and_symbols() {
        assert_eq!(shown("i0.0"), "I0.0 [0, 0, 0] Bit");
        assert_eq!(shown("e0.1"), "I0.1 [1, 0, 0] Bit");
        assert_eq!(shown("Lift Up"), "Q0.1 [17, 0, 0] Bit");
        assert_eq!(shown("\"lift up\""), "Q0.1 [17, 0, 0] Bit");
        assert_eq!(shown("delay"), "T101 [80, 0, 101] Bit");
        assert_eq!(shown("Delay.cv"), "T101.cv [89, 0, 101] Word");
        assert_eq!(shown("c5.CV"), "C5.cv [105, 0, 5] Word");
        assert_eq!(shown("VD8:REAL"), "VD8:real [138, 0, 8] Real");
        assert_eq!(shown("AC1:real"), "AC1:real [154, 0, 28] Real");
    }

    #[test]
    fn what_was_meant() {
        let cases = [
            ("lift uo", "lift uo is neither an address nor a symbol of the program (did you mean lift up?)"),
            ("IO.0", "IO.0 is neither an address nor a symbol of the program (did you mean I0.0?)"),
            ("I0.9", "I0.9: a byte has bits 0 to 7 (did you mean I1.1?)"),
            ("MW3.cv", "MW3.cv: only timers and counters have a current value (.cv) (did you mean MW3?)"),
            ("VW8:real", "VW8:real: only double words and accumulators hold a real (did you mean VW8?)"),
            ("HC1", "HC1: the board has the high-speed counters HC0 and HC3 (did you mean HC0?)"),
            ("LW0", "LW0: local memory has another place in every unit of the program"),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected);
        }
        let error = Operand::parse("Motor", &[]).unwrap_err();
        assert!(error.message.contains("--program"), "{error}");
        assert!(Operand::parse("ä", &[]).is_err());
    }
}
