//! Which operands of the text a kind of the instruction table takes. Which form is taken, and whether the address makes
//! sense in the program, is decided elsewhere.

use plc_isa::{Area, DIGITAL_INPUTS, DIGITAL_OUTPUTS, Group, Instruction, Kind, Op};

use crate::address::Address;
use crate::ast::{self, Constant, Value};
use crate::select::{ARGUMENTS_MAX, Argument};

/// The operands of a form that stand in the text.
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

/// The operands before the first that does not fit: they say at least which timer or counter is meant.
pub(crate) fn fit_beginning(
    instruction: &Instruction,
    kinds: &'static [Kind],
    operands: &[ast::Operand],
) -> [Argument; ARGUMENTS_MAX] {
    let mut arguments = [Argument::None; ARGUMENTS_MAX];
    let pairs = written_kinds(kinds).zip(operands).enumerate();
    let fitting = pairs.map_while(|(index, (kind, operand))| fit(instruction, kind, index, &operand.value));
    for (place, argument) in arguments.iter_mut().zip(fitting) {
        *place = argument;
    }
    arguments
}

/// The operand as an argument of this kind, if it is one. `index` is its number among the operands.
pub(crate) fn fit(instruction: &Instruction, kind: Kind, index: usize, value: &Value) -> Option<Argument> {
    match *value {
        Value::Address(address) => {
            let fits = match (class_of(instruction, kind), address) {
                (Class::Bit, Address::Bit { .. }) => return Some(Argument::Bit(address)),
                (Class::Bit, Address::Timer(_) | Address::Counter(_)) => {
                    let resets = matches!(kind, Kind::PageBitReset | Kind::FarBitReset);
                    return (!resets).then_some(Argument::Bit(address));
                }
                (Class::Input, Address::Bit { area: Area::I, byte: 0, bit }) if bit < DIGITAL_INPUTS => {
                    return Some(Argument::Bit(address));
                }
                (Class::Output, Address::Bit { area: Area::Q, byte: 0, bit }) if bit < DIGITAL_OUTPUTS => {
                    return Some(Argument::Bit(address));
                }
                (Class::Timer, Address::Timer(number)) => return Some(Argument::Timer(number)),
                (Class::Counter, Address::Counter(number)) => return Some(Argument::Counter(number)),
                (Class::Byte | Class::AnyByte | Class::Shift, _) => is_byte(address),
                (Class::Word | Class::AnyInt | Class::AnyWord, Address::AnalogOutput(_)) => kind.is_output(),
                (Class::Word | Class::AnyInt | Class::AnyWord, _) => is_word(address),
                (Class::Double | Class::AnyDint | Class::AnyDouble, Address::HighSpeedCounter(_)) => !kind.is_output(),
                (Class::Double | Class::AnyDint | Class::AnyDouble | Class::Real | Class::AnyReal, _) => {
                    is_double(address)
                }
                (Class::Text | Class::AnyText, Address::Byte { .. }) => true,
                _ => false,
            };
            fits.then_some(Argument::Memory(address))
        }
        Value::Constant(constant) => fit_constant(instruction, kind, constant),
        Value::Real(bits) => (kind == Kind::RealIn).then_some(Argument::Real(bits)),
        Value::Text(_) => (kind == Kind::TextIn).then_some(Argument::Text(index as u8)),
        Value::Indirect(address) => kind.is_reference().then_some(Argument::Indirect(address)),
        Value::AddressOf(address) => (kind == Kind::DoubleIn).then_some(Argument::Pointer(address)),
        Value::Unit(unit) => (kind == Kind::Routine).then_some(Argument::Routine(unit)),
        Value::Invalid => None,
    }
}

fn fit_constant(instruction: &Instruction, kind: Kind, constant: Constant) -> Option<Argument> {
    let Constant { value, is_pattern } = constant;
    let class = class_of(instruction, kind);
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
        Address::Word { .. } | Address::Analog(_) | Address::Timer(_) | Address::Counter(_) | Address::Accumulator(_)
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
    Routine,
    Event,
    NotWritten,
}

impl Class {
    /// Whether it is memory or a constant.
    pub(crate) fn is_general(self) -> bool {
        matches!(
            self,
            Class::AnyByte | Class::Shift | Class::AnyInt | Class::AnyWord | Class::AnyDint | Class::AnyDouble
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
            Class::Event => Some((0, 255)),
            _ => None,
        }
    }

    pub(crate) fn words(self) -> String {
        match self {
            Class::Bit => "a bit".into(),
            Class::Input => format!("an input I0.0 to I0.{}", DIGITAL_INPUTS - 1),
            Class::Output => format!("an output Q0.0 to Q0.{}", DIGITAL_OUTPUTS - 1),
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
            Class::Routine => "a routine".into(),
            Class::Event => "the number of an event".into(),
            Class::NotWritten => String::new(),
        }
    }
}

/// Whether constants of an instruction are numbers with a sign. Otherwise they may be patterns too.
fn is_signed(instruction: &Instruction) -> bool {
    matches!(instruction.group, Group::Math | Group::Compare | Group::Conversion | Group::Text)
}

pub(crate) fn class_of(instruction: &Instruction, kind: Kind) -> Class {
    if !kind.is_written() {
        return Class::NotWritten;
    }
    let (least, most) = kind.range().map_or((0, 0), |(least, most)| (i64::from(least), i64::from(most)));
    match kind {
        Kind::PageBit | Kind::PageBitOut | Kind::PageBitReset | Kind::FarBit | Kind::FarBitOut | Kind::FarBitReset => {
            Class::Bit
        }
        Kind::InputPoint => Class::Input,
        Kind::OutputPoint => Class::Output,
        Kind::Byte | Kind::ByteOut | Kind::BytesAt | Kind::ByteTo => Class::Byte,
        Kind::Word | Kind::WordOut | Kind::WordsAt | Kind::WordTo => Class::Word,
        Kind::DoublesAt | Kind::DoubleTo => Class::Double,
        Kind::RealTo => Class::Real,
        Kind::TextTo => Class::Text,
        // Other counts are constants of core instructions.
        Kind::ByteIn if matches!(instruction.op, Op::SetAny | Op::ResetAny) => Class::Byte,
        Kind::ByteIn if instruction.op == Op::Shrb => Class::Shift,
        Kind::AnyByte | Kind::ByteIn => Class::AnyByte,
        Kind::AnyInt => Class::AnyInt,
        Kind::WordIn if is_signed(instruction) => Class::AnyInt,
        Kind::WordIn => Class::AnyWord,
        Kind::DoubleIn if is_signed(instruction) => Class::AnyDint,
        Kind::DoubleIn => Class::AnyDouble,
        Kind::RealIn => Class::AnyReal,
        Kind::TextIn => Class::AnyText,
        Kind::ByteConst | Kind::WordConst | Kind::IntConst | Kind::One | Kind::Count => Class::Constant(least, most),
        Kind::TimerSlot | Kind::TimerNumber => Class::Timer,
        Kind::CounterSlot | Kind::CounterNumber => Class::Counter,
        Kind::Level | Kind::Number | Kind::Loop | Kind::LabelIndex | Kind::LabelNumber => Class::Number(most),
        Kind::Routine => Class::Routine,
        Kind::Event => Class::Event,
        _ => {
            debug_assert!(false, "{kind:?} is written, and has no class");
            Class::NotWritten
        }
    }
}
