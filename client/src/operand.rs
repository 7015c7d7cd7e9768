//! What can be read, set and forced: an address or symbol as people write it, with its reference
//! and the form of its values. Nothing is asked of a PLC.

use std::collections::BTreeSet;

use awl_asm::Address;
use awl_asm::ast::Symbol;
use awl_asm::operand::{self, Part, strip_ending};

pub use awl_asm::operand::OperandError;

use crate::reference::Reference;
use crate::value::{Base, Form};

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
    /// In which numbers, if the user has said it.
    pub base: Option<Base>,
}

impl Operand {
    /// Reads an operand as [`operand::parse`] does. `:hex` and `:dint` after it say how its values
    /// are written.
    pub fn parse(text: &str, symbols: &[Symbol]) -> Result<Operand, OperandError> {
        if let Some(stem) = strip_ending(text.trim(), ":hex") {
            let operand = Operand::parse(stem, symbols)?;
            return Ok(Operand { base: Some(Base::Hexadecimal), ..operand }.named(text));
        }
        if let Some(stem) = strip_ending(text.trim(), ":dint") {
            let operand = Operand::parse(stem, symbols)?;
            return match operand.form {
                Form::Double => Ok(Operand { base: Some(Base::Decimal), ..operand }.named(text)),
                _ => Err(OperandError::meant(format!("{text}: this is no double word"), stem)),
            };
        }
        let (address, part) = operand::parse(text, symbols)?;
        let operand = Operand::at(text.trim(), address)?;
        Ok(match (part, address) {
            (Part::Current, Address::Timer(number)) => {
                operand.current(Reference::to_timer_value(number))
            }
            (Part::Current, Address::Counter(number)) => {
                operand.current(Reference::to_counter_value(number))
            }
            (Part::Real, _) => Operand { form: Form::Real, ..operand },
            _ => operand,
        })
    }

    fn named(self, text: &str) -> Operand {
        Operand { name: text.trim().to_owned(), ..self }
    }

    /// As a real, if the program uses it as one and the user has not said otherwise.
    pub fn in_program(self, reals: &BTreeSet<Address>) -> Operand {
        let is_real =
            self.form == Form::Double && self.base.is_none() && reals.contains(&self.address);
        if is_real { Operand { form: Form::Real, ..self } } else { self }
    }

    /// A value of it as people write it, in these numbers if the user has not said which.
    pub fn text(&self, raw: u32, base: Base) -> String {
        self.form.text(raw, self.base.unwrap_or(base))
    }

    fn current(self, reference: Reference) -> Operand {
        Operand { reference, form: Form::Word, ..self }
    }

    /// The value at an address, under this name.
    pub fn at(name: &str, address: Address) -> Result<Operand, OperandError> {
        let reference = Reference::to(address).ok_or_else(|| match address {
            Address::HighSpeedCounter(_) => OperandError::meant(
                format!("{name}: the board has the high-speed counters HC0 and HC3"),
                "HC0",
            ),
            _ => OperandError {
                message: format!(
                    "{name}: local memory has another place in every unit of the program"
                ),
                suggestion: None,
            },
        })?;
        Ok(Operand {
            name: name.to_string(),
            address,
            reference,
            form: Form::of(address),
            base: None,
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;
    use awl_asm::symbols::load;

    fn symbols() -> Vec<Symbol> {
        load(&Source::new("symbols", "Delay\tT101\nlift up\tQ0.1\n").unwrap()).0
    }

    fn shown(text: &str) -> String {
        match Operand::parse(text, &symbols()) {
            Ok(operand) => {
                format!("{} {:?} {:?}", operand.official(), operand.reference.0, operand.form)
            }
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn how_values_are_written() {
        let text = |text: &str, reals: &[Address]| {
            let operand = Operand::parse(text, &symbols()).unwrap();
            let operand = operand.in_program(&reals.iter().copied().collect());
            format!("{} {}", operand.name, operand.text(0x3FC0_0000, Base::Decimal))
        };
        let reals = [Address::Double { area: plc_isa::Area::V, byte: 8 }];
        assert_eq!(text("VD8", &[]), "VD8 1069547520");
        assert_eq!(text("VD8", &reals), "VD8 1.5");
        assert_eq!(text("VD8:dint", &reals), "VD8:dint 1069547520");
        assert_eq!(text("VD8:hex", &reals), "VD8:hex 16#3FC00000");
        assert_eq!(text("VD12", &reals), "VD12 1069547520");
        assert!(Operand::parse("MW3:dint", &[]).is_err());
    }

    #[test]
    fn references_and_forms() {
        assert_eq!(shown("i0.0"), "I0.0 [0, 0, 0] Bit");
        assert_eq!(shown("Lift Up"), "Q0.1 [17, 0, 0] Bit");
        assert_eq!(shown("delay"), "T101 [80, 0, 101] Bit");
        assert_eq!(shown("Delay.cv"), "T101.cv [89, 0, 101] Word");
        assert_eq!(shown("c5.CV"), "C5.cv [105, 0, 5] Word");
        assert_eq!(shown("VD8:REAL"), "VD8:real [138, 0, 8] Real");
        assert_eq!(shown("AC1:real"), "AC1:real [154, 0, 28] Real");
    }

    #[test]
    fn what_the_plc_cannot_be_asked_for() {
        let cases = [
            ("HC1", "HC1: the board has the high-speed counters HC0 and HC3 (did you mean HC0?)"),
            ("LW0", "LW0: local memory has another place in every unit of the program"),
            ("LD0:real", "LD0:real: local memory has another place in every unit of the program"),
            (
                "lift uo",
                "lift uo is neither an address nor a symbol of the program (did you mean lift up?)",
            ),
        ];
        for (text, expected) in cases {
            assert_eq!(shown(text), expected);
        }
    }
}
