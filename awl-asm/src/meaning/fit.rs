//! Which operands of the text a kind of the instruction table takes. Which form is taken, and
//! whether the address makes sense in the program, is decided elsewhere.

use plc_isa::{Area, Instruction, Kind, Profile, Takes, Type, Written};

use crate::meaning::selected::{ARGUMENTS_MAX, Argument};
use crate::text::address::Address;
use crate::text::ast::{self, Constant, Value};

/// The operands of a form that are in the text.
pub(crate) fn written_kinds(kinds: &'static [Kind]) -> impl Iterator<Item = Kind> + Clone {
    kinds.iter().copied().filter(|kind| kind.is_written())
}

/// The operands as arguments of a form, with a bit for each that is written through.
pub(crate) fn fit_all(
    instruction: &Instruction,
    kinds: &'static [Kind],
    operands: &[ast::Operand],
) -> Option<([Argument; ARGUMENTS_MAX], u8)> {
    let mut arguments = [Argument::None; ARGUMENTS_MAX];
    let mut written = 0;
    let mut operands = operands.iter();
    for (index, kind) in written_kinds(kinds).enumerate() {
        *arguments.get_mut(index)? = fit(instruction, kind, index, &operands.next()?.value)?;
        written |= u8::from(kind.is_output()) << index;
    }
    operands.next().is_none().then_some((arguments, written))
}

/// The operands before the first that does not fit: they say at least which timer or counter is
/// meant.
pub(crate) fn fit_beginning(
    instruction: &Instruction,
    kinds: &'static [Kind],
    operands: &[ast::Operand],
) -> [Argument; ARGUMENTS_MAX] {
    let mut arguments = [Argument::None; ARGUMENTS_MAX];
    let pairs = written_kinds(kinds).zip(operands).enumerate();
    let fitting =
        pairs.map_while(|(index, (kind, operand))| fit(instruction, kind, index, &operand.value));
    for (place, argument) in arguments.iter_mut().zip(fitting) {
        *place = argument;
    }
    arguments
}

/// The operand as an argument of this kind, if it is one. `index` is its number among the operands.
pub(crate) fn fit(
    instruction: &Instruction,
    kind: Kind,
    index: usize,
    value: &Value,
) -> Option<Argument> {
    let class = class_of(instruction, kind, index);
    match *value {
        Value::Address(address) => {
            let fits = match (class, address) {
                (Class::Bit, Address::Bit { .. }) => return Some(Argument::Bit(address)),
                (Class::Bit, Address::Timer(_) | Address::Counter(_)) => {
                    let resets = matches!(kind, Kind::PageBitReset | Kind::FarBitReset);
                    return (!resets).then_some(Argument::Bit(address));
                }
                // Whether it has a pin, the board's profile says.
                (Class::Input, Address::Bit { area: Area::I, .. })
                | (Class::Output, Address::Bit { area: Area::Q, .. }) => {
                    return Some(Argument::Bit(address));
                }
                (Class::Timer, Address::Timer(number)) => return Some(Argument::Timer(number)),
                (Class::Counter, Address::Counter(number)) => {
                    return Some(Argument::Counter(number));
                }
                (Class::Byte | Class::AnyByte | Class::Shift, _) => is_byte(address),
                (Class::Word | Class::AnyInt | Class::AnyWord, Address::AnalogOutput(_)) => {
                    kind.is_output()
                }
                (Class::Word | Class::AnyInt | Class::AnyWord, _) => is_word(address),
                (
                    Class::Double | Class::AnyDint | Class::AnyDouble,
                    Address::HighSpeedCounter(_),
                ) => !kind.is_output(),
                (
                    Class::Double
                    | Class::AnyDint
                    | Class::AnyDouble
                    | Class::Real
                    | Class::AnyReal,
                    _,
                ) => is_double(address),
                (Class::Text | Class::AnyText, Address::Byte { .. }) => true,
                _ => false,
            };
            fits.then_some(Argument::Memory(address))
        }
        Value::Constant(constant) => fit_constant(class, kind, constant),
        Value::Real(bits) => (class == Class::AnyReal).then_some(Argument::Real(bits)),
        Value::Text(_) => (class == Class::AnyText).then_some(Argument::Text(index as u8)),
        Value::Indirect(address) => kind.is_reference().then_some(Argument::Indirect(address)),
        Value::AddressOf(address) => (kind == Kind::DoubleIn).then_some(Argument::Pointer(address)),
        Value::Unit(unit) => (class == Class::Routine).then_some(Argument::Routine(unit)),
        Value::Invalid => None,
    }
}

fn fit_constant(class: Class, kind: Kind, constant: Constant) -> Option<Argument> {
    let Constant { value, is_pattern } = constant;
    // A number without a point is a real too, but a pattern is none.
    if class == Class::AnyReal {
        return (!is_pattern).then(|| Argument::Real((value as f32).to_bits()));
    }
    let (least, most) = class.constants()?;
    // The sign bit of a pattern is a digit.
    let most = match most {
        _ if !is_pattern => most,
        MAX_INT => i64::from(u16::MAX),
        MAX_DINT => i64::from(u32::MAX),
        most => most,
    };
    if !(least..=most).contains(&value) {
        return None;
    }
    Some(match class {
        Class::Number(_) => Argument::Number(value as u8),
        Class::Label => Argument::Label(value as u16),
        Class::Event => Argument::Event(value as u8),
        _ if !kind.is_reference() => Argument::Constant(value as u16),
        Class::AnyByte | Class::Shift => Argument::Literal(i32::from(value as u8)),
        Class::AnyInt | Class::AnyWord => Argument::Literal(i32::from(value as i16)),
        _ => Argument::Literal(value as i32),
    })
}

fn is_byte(address: Address) -> bool {
    matches!(address, Address::Byte { .. } | Address::Accumulator(_))
}

fn is_word(address: Address) -> bool {
    matches!(
        address,
        Address::Word { .. }
            | Address::Analog(_)
            | Address::Timer(_)
            | Address::Counter(_)
            | Address::Accumulator(_)
    )
}

fn is_double(address: Address) -> bool {
    matches!(address, Address::Double { .. } | Address::Accumulator(_))
}

const MAX_INT: i64 = i16::MAX as i64;
const MAX_DINT: i64 = i32::MAX as i64;

/// What kinds have in common as far as the text goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    Bit,
    Input,
    Output,
    Byte,
    Word,
    Double,
    Real,
    Text,
    AnyByte,
    /// A byte or a constant of SHRB, whose sign is the direction.
    Shift,
    /// A word or a signed constant.
    AnyInt,
    /// A word or a constant, signed or not.
    AnyWord,
    /// A double word or a signed constant.
    AnyDint,
    /// A double word or a constant, signed or not.
    AnyDouble,
    AnyReal,
    AnyText,
    Constant(i64, i64),
    Timer,
    Counter,
    Number(i64),
    /// The number of a label.
    Label,
    Routine,
    Event,
    NotWritten,
}

impl Class {
    /// Whether it is memory or a constant.
    pub(crate) fn is_general(self) -> bool {
        matches!(
            self,
            Class::AnyByte
                | Class::Shift
                | Class::AnyInt
                | Class::AnyWord
                | Class::AnyDint
                | Class::AnyDouble
        )
    }

    /// The least and the greatest constant, where there are constants.
    pub(crate) fn constants(self) -> Option<(i64, i64)> {
        match self {
            Class::Constant(least, most) => Some((least, most)),
            Class::AnyByte => Some((0, 255)),
            Class::Shift => Some((-64, 64)),
            Class::AnyInt => Some((i64::from(i16::MIN), MAX_INT)),
            Class::AnyWord => Some((i64::from(i16::MIN), i64::from(u16::MAX))),
            Class::AnyDint => Some((i64::from(i32::MIN), MAX_DINT)),
            Class::AnyDouble => Some((i64::from(i32::MIN), i64::from(u32::MAX))),
            Class::Number(most) => Some((0, most)),
            Class::Label => Some((0, i64::from(u16::MAX))),
            Class::Event => Some((0, 255)),
            _ => None,
        }
    }

    pub(crate) fn words(self, profile: &Profile) -> String {
        match self {
            Class::Bit => "a bit".into(),
            Class::Input => format!("an input I0.0 to I0.{}", profile.digital_inputs() - 1),
            Class::Output => format!("an output Q0.0 to Q0.{}", profile.digital_outputs() - 1),
            Class::Byte => "a byte".into(),
            Class::Word => "a word".into(),
            Class::Double => "a double word".into(),
            Class::Real => "a double word for a real".into(),
            Class::Text => "the first byte of a text".into(),
            Class::AnyByte => "a byte or a constant 0 to 255".into(),
            Class::Shift => "a byte or a constant -64 to 64".into(),
            Class::AnyInt => "a word or a constant -32768 to 32767".into(),
            Class::AnyWord => "a word or a constant -32768 to 65535".into(),
            Class::AnyDint => "a double word or a constant -2147483648 to 2147483647".into(),
            Class::AnyDouble => "a double word or a constant -2147483648 to 4294967295".into(),
            Class::AnyReal => "a double word or a real constant".into(),
            Class::AnyText => "the first byte of a text, or a text in double quotes".into(),
            Class::Constant(least, most) => format!("a constant {least} to {most}"),
            Class::Timer => "a timer T0 to T255".into(),
            Class::Counter => "a counter C0 to C255".into(),
            Class::Number(most) => format!("a number 0 to {most}"),
            Class::Label => format!("a number 0 to {}", u16::MAX),
            Class::Routine => "a routine".into(),
            Class::Event => "the number of an event".into(),
            Class::NotWritten => String::new(),
        }
    }
}

/// The class of a kind that is operand `index` of an instruction.
pub(crate) fn class_of(instruction: &Instruction, kind: Kind, index: usize) -> Class {
    let takes = instruction.written_roles().nth(index).map_or(Takes::Any, |role| role.takes);
    match kind.written() {
        Written::Hidden => Class::NotWritten,
        Written::Constant(least, most) => Class::Constant(least.into(), most.into()),
        Written::Number(most) => Class::Number(most.into()),
        Written::Label => Class::Label,
        Written::Timer => Class::Timer,
        Written::Counter => Class::Counter,
        Written::Input => Class::Input,
        Written::Output => Class::Output,
        Written::Routine => Class::Routine,
        Written::Event => Class::Event,
        Written::Address => memory(kind),
        // Other counts are constants of core instructions.
        Written::Value if takes == Takes::Memory => memory(kind),
        Written::Value => value(kind, takes),
    }
}

/// A place in memory.
fn memory(kind: Kind) -> Class {
    match kind.value_type() {
        Some(Type::Bit) => Class::Bit,
        Some(Type::Byte) => Class::Byte,
        Some(Type::Word) => Class::Word,
        Some(Type::Double) => Class::Double,
        Some(Type::Real) => Class::Real,
        Some(Type::Text) => Class::Text,
        None => Class::NotWritten,
    }
}

/// A place in memory or a constant.
fn value(kind: Kind, takes: Takes) -> Class {
    // Constants are numbers with a sign, or may be patterns too.
    let is_signed = takes == Takes::Signed || !kind.is_reference();
    match kind.value_type() {
        Some(Type::Byte) if takes == Takes::Shift => Class::Shift,
        Some(Type::Byte) => Class::AnyByte,
        Some(Type::Word) if is_signed => Class::AnyInt,
        Some(Type::Word) => Class::AnyWord,
        Some(Type::Double) if is_signed => Class::AnyDint,
        Some(Type::Double) => Class::AnyDouble,
        Some(Type::Real) => Class::AnyReal,
        Some(Type::Text) => Class::AnyText,
        Some(Type::Bit) => Class::Bit,
        None => Class::NotWritten,
    }
}
