//! Constants and places with which an instruction fails whenever it is executed: at run time that would be SM4.3 only.
//! What depends on memory is left to the running program.

use plc_isa::{ANALOG_INPUTS, AnalogInput, Area, Kind, Op, Relation};

use crate::address::Address;
use crate::ast::{Instruction, Program, Span, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::extent::elements;
use crate::misfit::value_words;
use crate::select::{Argument, Selected};

/// Most characters of a string.
const TEXT_MAX: i32 = 254;
/// Most digits behind the point that FMT can ask for.
const DECIMALS_MAX: i32 = 5;
/// Least characters of a real.
const REAL_LEN_MIN: i32 = 3;
/// Words of the smallest table: TL, EC, an entry.
const TABLE_WORDS: u16 = 3;
/// Words from EC on to the first entry.
const FOUND_WORDS: u16 = 2;

/// The comparisons that an instruction with one knows: texts are equal or not, and tables are searched by four.
pub(crate) fn relations(op: Op) -> &'static [Relation] {
    use Relation::{Equal, Greater, Less, NotEqual};
    match op {
        Op::LoadText | Op::AndText | Op::OrText => &[Equal, NotEqual],
        Op::Fnd => &[Equal, NotEqual, Less, Greater],
        _ => &Relation::ALL,
    }
}

/// Least and most of what a constant may be, in ascending order, where it is less than the kind of the operand takes.
fn constants(op: Op, index: usize) -> Option<&'static [(i32, i32)]> {
    Some(match (op, index) {
        (Op::Fill | Op::Bmb | Op::Bmw | Op::Bmd | Op::Ath | Op::Hta, 2) => &[(1, 255)],
        (Op::SetImmediate | Op::ResetImmediate, 1) => &[(1, 128)],
        (Op::Sti | Op::Std | Op::Str | Op::Sscpy, 1) => &[(1, TEXT_MAX)],
        (Op::Shrb, 2) => &[(-64, -1), (1, 64)],
        _ => return None,
    })
}

/// What may stand at a place whose constants are fewer than its kind takes.
pub(crate) fn constant_words(op: Op, index: usize) -> Option<String> {
    let ranges = constants(op, index)?.iter().map(|(least, most)| format!("{least} to {most}"));
    Some(format!("a byte or a constant {}", ranges.collect::<Vec<_>>().join(" or ")))
}

/// What is wrong with an instruction whose operands are of the right kinds.
pub(crate) fn check(program: &Program, source: &Instruction, selected: &Selected) -> Option<Diagnostic> {
    let operands = Operands { source, selected };
    operands
        .relation()
        .or_else(|| operands.constant())
        .or_else(|| operands.position())
        .or_else(|| operands.points())
        .or_else(|| operands.past_the_end())
        .or_else(|| operands.too_short(program))
}

struct Operands<'a> {
    source: &'a Instruction,
    selected: &'a Selected,
}

impl Operands<'_> {
    fn span(&self, index: usize) -> Span {
        self.source.operands.get(index).map(|operand| operand.span).unwrap_or_default()
    }

    fn name(&self) -> &'static str {
        self.source.mnemonic
    }

    fn literal(&self, index: usize) -> Option<i32> {
        match self.selected.arguments.get(index) {
            Some(&Argument::Literal(value)) => Some(value),
            _ => None,
        }
    }

    /// A comparison that the instruction does not know.
    fn relation(&self) -> Option<Diagnostic> {
        let relation = self.selected.relation?;
        if relations(self.selected.op).contains(&relation) {
            return None;
        }
        let (what, possible) = match self.selected.op {
            Op::Fnd => ("an S7-200 searches tables", "=, <>, < or >"),
            _ => ("an S7-200 compares texts", "= or <>"),
        };
        let name = self.name();
        let message = format!("{name}{}: {what} with {possible} only", relation.symbol());
        let diagnostic = Diagnostic::new(Code::UnknownMnemonic, self.source.mnemonic_span, message);
        Some(match self.selected.op {
            Op::Fnd => diagnostic.help("`FND>` with a PTN that is less by one finds the same as greater or equal"),
            _ => diagnostic.help(format!("`{name}=` and `{name}<>` compare the lengths and all characters")),
        })
    }

    /// A constant that the instruction refuses.
    fn constant(&self) -> Option<Diagnostic> {
        let op = self.selected.op;
        match op {
            Op::Ita | Op::Dta | Op::Rta => return self.format(2),
            Op::Its | Op::Dts | Op::Rts => return self.format(1),
            _ => {}
        }
        let (index, value) = (0..self.selected.arguments.len()).find_map(|index| {
            let value = self.literal(index)?;
            // The sign is the direction.
            let value = if op == Op::Shrb { i32::from(value as i8) } else { value };
            let is_outside =
                |ranges: &[(i32, i32)]| !ranges.iter().any(|&(least, most)| (least..=most).contains(&value));
            constants(op, index).is_some_and(is_outside).then_some((index, value))
        })?;
        let message = format!("{value}: {} takes {} here", self.name(), constant_words(op, index)?);
        let diagnostic = Diagnostic::new(Code::ConstantRange, self.span(index), message).label("out of range");
        Some(match op {
            Op::Shrb => diagnostic.help("its sign is the direction, and a shift by no bit is no shift"),
            Op::Sti | Op::Std | Op::Str | Op::Sscpy => diagnostic.help("the first character of a text is number 1"),
            _ => diagnostic.help("it is how many are copied, converted or written"),
        })
    }

    /// FMT: ssss cnnn, with the characters of a real, a comma instead of the point, and the digits behind it.
    fn format(&self, index: usize) -> Option<Diagnostic> {
        let value = self.literal(index)?;
        let (len, decimals) = (value >> 4, value & 7);
        let is_real = matches!(self.selected.op, Op::Rta | Op::Rts);
        let name = self.name();
        let why = if decimals > DECIMALS_MAX {
            format!("{name} writes 0 to {DECIMALS_MAX} digits behind the point, not {decimals}")
        } else if !is_real && len != 0 {
            format!("the upper half of FMT is 0 for {name}, not {len}")
        } else if is_real && len < REAL_LEN_MIN {
            format!("{name} writes {REAL_LEN_MIN} to 15 characters, not {len}")
        } else if is_real && decimals > 0 && len < decimals + 2 {
            format!("{decimals} digits behind the point never fit {len} characters")
        } else {
            return None;
        };
        let help = match is_real {
            true => "FMT is 2#ssss_cnnn: ssss characters, c = 1 for a comma, nnn digits behind the point",
            false => "FMT is 2#0000_cnnn: c = 1 for a comma instead of a point, nnn digits behind it",
        };
        let message = format!("FMT 16#{value:02X}: {why}");
        Some(Diagnostic::new(Code::ConstantRange, self.span(index), message).label("out of range").help(help))
    }

    /// A position or a count that lies behind the end of a constant text.
    fn position(&self) -> Option<Diagnostic> {
        if !matches!(self.selected.op, Op::Sti | Op::Std | Op::Str | Op::Sscpy) {
            return None;
        }
        let len = match &self.source.operands.first()?.value {
            Value::Text(characters) => characters.len() as i32,
            _ if self.selected.op == Op::Sscpy => TEXT_MAX,
            _ => return None,
        };
        let characters = |len: i32| if len == 1 { "one character".to_owned() } else { format!("{len} characters") };
        let error = |index: usize, message: String| {
            Some(Diagnostic::new(Code::ConstantRange, self.span(index), message).label("out of range"))
        };
        let index = self.literal(1);
        if let Some(index) = index.filter(|&index| index > len) {
            return error(1, format!("position {index}: the text has {}", characters(len)));
        }
        let count = self.literal(2).filter(|_| self.selected.op == Op::Sscpy)?;
        let rest = len - index.unwrap_or(1) + 1;
        (count > rest).then(|| error(2, format!("{count}: {} are left of a text", characters(rest))))?
    }

    /// Immediate reads and writes of a byte need one of points.
    fn points(&self) -> Option<Diagnostic> {
        let (index, area, what, byte) = match self.selected.op {
            Op::Bir => (0, Area::I, "a byte of inputs", "IB0"),
            Op::Biw => (1, Area::Q, "a byte of outputs", "QB0"),
            _ => return None,
        };
        let Argument::Memory(address) = self.selected.arguments[index] else { return None };
        if matches!(address, Address::Byte { area: found, .. } if found == area) {
            return None;
        }
        let found = value_words(&self.source.operands.get(index)?.value);
        let message = format!("{} takes {what} here, found {found}", self.name());
        let diagnostic = Diagnostic::new(Code::OperandKind, self.span(index), message).label("wrong kind of operand");
        Some(diagnostic.help(format!("the Uno's points of it are in {byte}")))
    }

    /// A constant count of bits that leads out of the area.
    fn past_the_end(&self) -> Option<Diagnostic> {
        let (first, index) = match (self.selected.op, self.selected.arguments) {
            (Op::Set | Op::Reset | Op::ResetTimers | Op::ResetCounters, [first, Argument::Constant(_), ..]) => {
                (first, 1)
            }
            (Op::SetImmediate | Op::ResetImmediate, [first, ..]) => (first, 1),
            (Op::Shrb, [_, first, ..]) => (first, 2),
            _ => return None,
        };
        let count = match self.selected.arguments[index] {
            Argument::Constant(count) => u32::from(count),
            Argument::Literal(count) if self.selected.op == Op::Shrb => u32::from((count as i8).unsigned_abs()),
            Argument::Literal(count) => count.unsigned_abs(),
            _ => return None,
        };
        let (place, size, last) = match first {
            Argument::Bit(Address::Bit { area, byte, bit }) => (
                u32::from(byte) * 8 + u32::from(bit),
                u32::from(area.size()) * 8,
                format!("{}{}.7", area.name(), area.size() - 1),
            ),
            Argument::Bit(Address::Timer(number)) | Argument::Timer(number) => (u32::from(number), 256, "T255".into()),
            Argument::Bit(Address::Counter(number)) | Argument::Counter(number) => {
                (u32::from(number), 256, "C255".into())
            }
            _ => return None,
        };
        (count > size - place).then(|| {
            let message = format!("{count}: the range ends behind {last}");
            let most = size - place;
            Diagnostic::new(Code::ConstantRange, self.span(index), message).help(format!("at most {most} fit here"))
        })
    }

    /// An address behind which there is not room enough for what the instruction reads or writes there.
    fn too_short(&self, program: &Program) -> Option<Diagnostic> {
        self.selected.op.instruction().module()?;
        let mut pairs = self.selected.written_kinds().zip(self.selected.arguments()).enumerate();
        pairs.find_map(|(index, (kind, (argument, _)))| match argument {
            Argument::Memory(address) if kind.is_reference() => self.room_for(program, index, kind, address),
            _ => None,
        })
    }

    fn room_for(&self, program: &Program, index: usize, kind: Kind, address: Address) -> Option<Diagnostic> {
        let width = kind.value_len();
        let count = match (self.selected.op, index) {
            (Op::Att, 1) | (Op::Fifo | Op::Lifo, 0) => TABLE_WORDS,
            (Op::Fnd, 0) => FOUND_WORDS,
            (Op::Sscpy, 3) => 1 + self.literal(2).unwrap_or(0).unsigned_abs() as u16,
            // What FMT in memory asks for is left to the running program.
            (Op::Rta, 1) if self.literal(2).is_none() => 1,
            (Op::Rts, 2) if self.literal(1).is_none() => 1,
            _ => elements(program, self.selected, index),
        };
        let room = room_at(address, width);
        // A single value that does not fit is torn, which is said elsewhere.
        if width * count <= room || width > room {
            return None;
        }
        let message = format!("{} needs {} bytes here: {}", self.name(), width * count, end_words(address, width));
        // What can be changed is the count, where there is one.
        let is_counted = is_counted(self.selected.op) && self.literal(2).is_some();
        Some(match is_counted {
            true => {
                Diagnostic::new(Code::ConstantRange, self.span(2), message).related(self.span(index), "from here on")
            }
            false => Diagnostic::new(Code::AddressRange, self.span(index), message),
        })
    }
}

/// How much there is from an address on.
fn end_words(address: Address, width: u16) -> String {
    match address {
        Address::Byte { area, byte } | Address::Word { area, byte } | Address::Double { area, byte } => {
            let (room, end) = (room_at(address, width), area_end(area, byte) - 1);
            format!("from {address} to {}B{end} there are {room}", area.name())
        }
        Address::Timer(_) | Address::Counter(_) => format!("on the Uno no other value lies beside {address}"),
        _ => format!("{address} has {}", room_at(address, width)),
    }
}

/// Whether the third operand is the count of the others.
fn is_counted(op: Op) -> bool {
    matches!(op, Op::Fill | Op::Bmb | Op::Bmw | Op::Bmd | Op::Ath | Op::Hta)
}

/// One past the last byte of an area that follows another without a gap: special memory lies in two pieces.
fn area_end(area: Area, byte: u16) -> u16 {
    if area == Area::Sm && byte < area.page_len() { area.page_len() } else { area.size() }
}

/// Bytes from an address on that values can follow one another in.
fn room_at(address: Address, width: u16) -> u16 {
    match address {
        Address::Byte { area, byte } | Address::Word { area, byte } | Address::Double { area, byte } => {
            area_end(area, byte).saturating_sub(byte)
        }
        Address::Analog(AnalogInput::Scaled(channel) | AnalogInput::Raw(channel)) => {
            2 * (ANALOG_INPUTS - u16::from(channel))
        }
        Address::AnalogOutput(channel) => 2 * (2 - u16::from(channel)),
        Address::Bit { .. }
        | Address::Timer(_)
        | Address::Counter(_)
        | Address::Accumulator(_)
        | Address::HighSpeedCounter(_) => width,
    }
}
