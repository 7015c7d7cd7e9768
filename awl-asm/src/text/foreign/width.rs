//! How wide operands are, as far as their addresses tell, and which mnemonic is for it.

use crate::text::address::Address;
use crate::text::ast::Value;
use crate::text::literal;

/// The size of an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Width {
    Bit,
    Byte,
    Word,
    Double,
    Real,
}

/// Mnemonics that are there for several sizes: byte, word, double word, real; empty where not.
const FAMILIES: [[&str; 4]; 20] = [
    ["MOVB", "MOVW", "MOVD", "MOVR"],
    ["INCB", "INCW", "INCD", ""],
    ["DECB", "DECW", "DECD", ""],
    ["INVB", "INVW", "INVD", ""],
    ["ANDB", "ANDW", "ANDD", ""],
    ["ORB", "ORW", "ORD", ""],
    ["XORB", "XORW", "XORD", ""],
    ["SLB", "SLW", "SLD", ""],
    ["SRB", "SRW", "SRD", ""],
    ["RLB", "RLW", "RLD", ""],
    ["RRB", "RRW", "RRD", ""],
    ["BMB", "BMW", "BMD", ""],
    ["", "+I", "+D", "+R"],
    ["", "-I", "-D", "-R"],
    ["", "*I", "*D", "*R"],
    ["", "/I", "/D", "/R"],
    ["LDB", "LDW", "LDD", "LDR"],
    ["AB", "AW", "AD", "AR"],
    ["OB", "OW", "OD", "OR"],
    ["UB", "UW", "UD", "UR"],
];

impl Width {
    pub(crate) fn of_address(address: Address) -> Option<Width> {
        Some(match address {
            Address::Bit { .. } => Width::Bit,
            Address::Byte { .. } => Width::Byte,
            Address::Word { .. }
            | Address::Timer(_)
            | Address::Counter(_)
            | Address::Analog(_)
            | Address::AnalogOutput(_) => Width::Word,
            Address::Double { .. } | Address::HighSpeedCounter(_) => Width::Double,
            Address::Accumulator(_) => return None,
        })
    }

    /// Of an operand as it is written.
    pub(super) fn of_operand(text: &str) -> Option<Width> {
        Width::of_address(Address::parse(text.trim_start_matches('%')).ok()?)
    }

    /// The one of a bit, byte, word, double word and real.
    pub(super) fn of_all(self, names: [&'static str; 5]) -> &'static str {
        names[self as usize]
    }

    /// The mnemonic of this width that belongs to the same family; `None` if there is none.
    pub(crate) fn sibling(self, mnemonic: &str) -> Option<&'static str> {
        let family = FAMILIES.iter().find(|family| family.contains(&mnemonic))?;
        let index = (self as usize).checked_sub(Width::Byte as usize)?;
        family.get(index).copied().filter(|name| !name.is_empty())
    }

    /// One of them in words.
    pub(crate) fn singular(self) -> &'static str {
        self.of_all(["bit", "byte", "word", "double word", "real number"])
    }

    /// Several of them in words.
    pub(crate) fn plural(self) -> &'static str {
        self.of_all(["bits", "bytes", "words", "double words", "real numbers"])
    }

    /// The letter in comparisons and moves; of a bit there is none.
    pub(crate) fn letter(self) -> &'static str {
        self.of_all(["", "B", "W", "D", "R"])
    }
}

/// The width that operands tell: of the first address that has one. A real number among double
/// words makes them reals.
pub(super) fn of(operands: &str) -> Option<Width> {
    let words = || operands.split([',', ' ', '\t', '(', ')', ';']).filter(|word| !word.is_empty());
    let is_real = |word: &str| {
        literal::looks_like_literal(word) && matches!(literal::parse(word), Ok(Value::Real(_)))
    };
    let width = words().find_map(Width::of_operand)?;
    // A timer or counter in bit logic is a bit: where it is the only operand.
    let is_alone = words().nth(1).is_none();
    let names_bit =
        words().next().is_some_and(|word| word.starts_with(['T', 't', 'C', 'c', 'Z', 'z']));
    Some(match width {
        Width::Double if words().any(is_real) => Width::Real,
        Width::Word if is_alone && names_bit => Width::Bit,
        width => width,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_and_numbers_tell() {
        assert_eq!(of(" I0.0"), Some(Width::Bit));
        assert_eq!(of(" T37"), Some(Width::Bit));
        assert_eq!(of(" T37, 5"), Some(Width::Word));
        assert_eq!(of(" 5, AC0, EB3"), Some(Width::Byte));
        assert_eq!(of(" 1.5, VD0"), Some(Width::Real));
        assert_eq!(of(" 15, VD0"), Some(Width::Double));
        assert_eq!(of(" Level, 5"), None);
        assert_eq!(of(""), None);
    }
}
