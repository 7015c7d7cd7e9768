//! What can be set, expected and traced: an address, the current value of a timer or counter, a
//! real. No access to it.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::RangeInclusive;

use awl_asm::Address;
use awl_asm::ast::Symbol;
use awl_asm::operand::{self, Part, strip_ending};
use plc_isa::{AnalogInput, Area};

pub use awl_asm::operand::OperandError;

/// An operand of a scenario or a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operand {
    /// The value at an address. Of a timer or counter: its bit.
    At(Address),
    /// The current value of a timer, written `T37.cv`.
    TimerCurrent(u8),
    /// The current value of a counter, written `C5.cv`.
    CounterCurrent(u8),
    /// A double word or accumulator that holds a real, written `VD20:real`.
    Real(Address),
    /// The part of the time in thousandths that output Q0.n is on, written `Q0.1.duty`: what PLS,
    /// or the analog output at the same pin, makes of it.
    Duty(u8),
}

/// How wide the value of an operand is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Width {
    /// 0 or 1.
    Bit,
    /// 0..=255.
    Byte,
    /// 16 bits, signed.
    Word,
    /// 32 bits, signed.
    Double,
    /// The 32 bits of an IEEE single.
    Real,
}

/// What can be after an address or a symbol.
const ENDINGS: [&str; 3] = [".cv", ":real", ".duty"];

/// The address or symbol of an operand as it is written, without `.cv` and its like.
pub fn stem(text: &str) -> &str {
    ENDINGS.into_iter().find_map(|ending| strip_ending(text, ending)).unwrap_or(text)
}

impl Operand {
    /// Reads an operand as [`operand::parse`] does, or an output with `.duty` after it.
    pub fn parse(text: &str, symbols: &[Symbol]) -> Result<Operand, OperandError> {
        if let Some(stem) = strip_ending(text, ".duty") {
            return match operand::address(stem, symbols)? {
                Address::Bit { area: Area::Q, byte: 0, bit } => Ok(Operand::Duty(bit)),
                _ => Err(OperandError::meant(
                    format!("{text}: only the outputs Q0.0 to Q0.7 have a duty cycle"),
                    "Q0.1.duty",
                )),
            };
        }
        let (address, part) = operand::parse(text, symbols)?;
        Ok(match (part, address) {
            (Part::Current, Address::Timer(number)) => Operand::TimerCurrent(number),
            (Part::Current, Address::Counter(number)) => Operand::CounterCurrent(number),
            (Part::Real, _) => Operand::Real(address),
            _ => Operand::At(address),
        })
    }

    /// The same bits as a real, where there are 32 of them.
    pub fn as_real(self) -> Option<Operand> {
        match self {
            Operand::At(address @ (Address::Double { .. } | Address::Accumulator(_))) => {
                Some(Operand::Real(address))
            }
            Operand::Real(_) => Some(self),
            _ => None,
        }
    }

    /// As a program uses it: as a real, where its double word is one of these.
    pub fn as_used(self, reals: &BTreeSet<Address>) -> Operand {
        self.as_real().filter(|_| reals.contains(&self.address())).unwrap_or(self)
    }

    /// A value of this operand as people write it.
    pub fn text(self, value: i32) -> String {
        match self.width() {
            // With a point or exponent, as reals are written.
            Width::Real => format!("{:?}", real_of(value)),
            _ => value.to_string(),
        }
    }

    /// A value of this operand as a number.
    pub fn number(self, value: i32) -> f64 {
        match self.width() {
            Width::Real => f64::from(real_of(value)),
            _ => f64::from(value),
        }
    }

    /// The address, for a current value that of its timer or counter.
    pub fn address(self) -> Address {
        match self {
            Operand::At(address) | Operand::Real(address) => address,
            Operand::TimerCurrent(number) => Address::Timer(number),
            Operand::CounterCurrent(number) => Address::Counter(number),
            Operand::Duty(bit) => Address::Bit { area: Area::Q, byte: 0, bit },
        }
    }

    /// How wide its value is.
    pub fn width(self) -> Width {
        match self {
            Operand::At(Address::Bit { .. } | Address::Timer(_) | Address::Counter(_)) => {
                Width::Bit
            }
            Operand::At(Address::Byte { .. }) => Width::Byte,
            Operand::At(
                Address::Double { .. } | Address::Accumulator(_) | Address::HighSpeedCounter(_),
            ) => Width::Double,
            Operand::At(Address::Word { .. } | Address::Analog(_) | Address::AnalogOutput(_)) => {
                Width::Word
            }
            Operand::Real(_) => Width::Real,
            Operand::TimerCurrent(_) | Operand::CounterCurrent(_) | Operand::Duty(_) => Width::Word,
        }
    }

    /// The values it can have, words and double words signed; of a real the bits.
    pub fn range(self) -> RangeInclusive<i32> {
        match (self, self.width()) {
            (Operand::At(Address::Analog(AnalogInput::Raw(_))), _) => {
                0..=i32::from(AnalogInput::RAW_MAX)
            }
            (Operand::At(Address::Analog(AnalogInput::Scaled(_))), _) => {
                0..=i32::from(AnalogInput::SCALED_MAX)
            }
            (Operand::Duty(_), _) => 0..=DUTY_MAX,
            (_, Width::Bit) => 0..=1,
            (_, Width::Byte) => 0..=255,
            (_, Width::Word) => i32::from(i16::MIN)..=i32::from(i16::MAX),
            (_, Width::Double | Width::Real) => i32::MIN..=i32::MAX,
        }
    }
}

/// The duty cycle of an output that is on all the time.
pub const DUTY_MAX: i32 = 1000;

/// The real in a value.
pub fn real_of(value: i32) -> f32 {
    f32::from_bits(value as u32)
}

/// The value that holds a real.
pub fn value_of(real: f32) -> i32 {
    real.to_bits() as i32
}

impl fmt::Display for Operand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Operand::At(address) => address.fmt(f),
            Operand::TimerCurrent(number) => write!(f, "T{number}.cv"),
            Operand::CounterCurrent(number) => write!(f, "C{number}.cv"),
            Operand::Real(address) => write!(f, "{address}:real"),
            Operand::Duty(bit) => write!(f, "Q0.{bit}.duty"),
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

    #[test]
    fn bit_and_current_value_of_timers_and_counters() {
        let symbols = symbols();
        assert_eq!(Operand::parse("t37", &symbols), Ok(Operand::At(Address::Timer(37))));
        assert_eq!(Operand::parse("z5.CV", &symbols), Ok(Operand::CounterCurrent(5)));
        assert_eq!(Operand::parse("Delay.cv", &symbols), Ok(Operand::TimerCurrent(101)));
        assert_eq!(Operand::CounterCurrent(5).to_string(), "C5.cv");
        assert_eq!(["z5.CV", "Delay", "VD8:real"].map(stem), ["z5", "Delay", "VD8"]);
    }

    #[test]
    fn ranges_follow_the_width() {
        let range = |text| Operand::parse(text, &[]).unwrap().range();
        assert_eq!(range("Ain5"), 0..=1023);
        assert_eq!(range("AIW0"), 0..=32000);
        assert_eq!(range("QB0"), 0..=255);
        assert_eq!(range("T37"), 0..=1);
        assert_eq!(range("T37.cv"), -32768..=32767);
        assert_eq!(range("AQW2"), -32768..=32767);
        for double in ["VD8", "AC3", "HC0", "LD4", "SMD38"] {
            assert_eq!(range(double), i32::MIN..=i32::MAX, "{double}");
        }
    }

    #[test]
    fn outputs_have_a_duty_cycle() {
        let symbols = symbols();
        let duty = Operand::parse("lift up.DUTY", &symbols).unwrap();
        assert_eq!((duty.to_string(), duty.range()), ("Q0.1.duty".to_string(), 0..=1000));
        assert!(
            Operand::parse("I0.1.duty", &symbols).is_err()
                && Operand::parse("Q1.0.duty", &symbols).is_err()
        );
    }

    #[test]
    fn double_words_as_reals() {
        let symbols = symbols();
        let real = Operand::parse("vd8:REAL", &symbols).unwrap();
        assert_eq!((real.to_string(), real.width()), ("VD8:real".to_string(), Width::Real));
        assert_eq!(Operand::parse("AC1:real", &symbols).map(Operand::width), Ok(Width::Real));
        assert_eq!(Operand::parse("VD8", &symbols).unwrap().as_real(), Some(real));
        let texts = [1.5, -0.1, 3.0, 1e20, f32::NAN].map(|number| real.text(value_of(number)));
        assert_eq!(texts, ["1.5", "-0.1", "3.0", "1e20", "NaN"]);
    }
}
