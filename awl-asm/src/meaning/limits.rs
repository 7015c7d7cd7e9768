//! Constants and places with which an instruction fails whenever it is executed: at run time that
//! would be SM4.3 only. What depends on memory is left to the running program.

use plc_isa::{ANALOG_INPUTS, AnalogInput, Area, Kind, Many, Role, Takes};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::extent::{elements, known};
use crate::meaning::misfit::value_words;
use crate::meaning::selected::{Argument, Selected};
use crate::text::address::Address;
use crate::text::ast::{Instruction, Program, Span, Value};

/// Most characters of a string.
const TEXT_MAX: i32 = 254;
/// Bits of the longest shift register.
const REGISTER_MAX: i32 = 64;
/// Most digits after the point that FMT can ask for.
const DECIMALS_MAX: i32 = 5;
/// Least characters of a real.
const REAL_LEN_MIN: i32 = 3;
/// Words of the smallest table: TL, EC, an entry.
const TABLE_WORDS: u16 = 3;
/// Words from EC on to the first entry.
const FOUND_WORDS: u16 = 2;

/// Least and most of what a constant may be, in ascending order, where it is less than the kind of
/// the operand takes.
fn constants(takes: Takes) -> Option<Vec<(i32, i32)>> {
    match takes {
        Takes::Count(most) => Some(vec![(1, most)]),
        Takes::Position => Some(vec![(1, TEXT_MAX)]),
        Takes::Shift => Some(vec![(-REGISTER_MAX, -1), (1, REGISTER_MAX)]),
        Takes::Any | Takes::Signed | Takes::Memory | Takes::Length => None,
        Takes::Equality | Takes::Searched => None,
        // They have checks of their own.
        Takes::Format | Takes::RealFormat | Takes::InputByte | Takes::OutputByte => None,
        Takes::HighSpeedCounter | Takes::CounterMode | Takes::PulseOutput => None,
        Takes::Port | Takes::ReceivingPort => None,
    }
}

/// What may be at a place whose constants are fewer than its kind takes.
pub(crate) fn constant_words(instruction: &plc_isa::Instruction, index: usize) -> Option<String> {
    let ranges = constants(instruction.written_roles().nth(index)?.takes)?;
    let ranges: Vec<_> = ranges.iter().map(|(least, most)| format!("{least} to {most}")).collect();
    Some(format!("a byte or a constant {}", ranges.join(" or ")))
}

/// What is wrong with an instruction whose operands are of the right kinds.
pub(crate) fn check(
    program: &Program,
    source: &Instruction,
    selected: &Selected,
) -> Option<Diagnostic> {
    let operands = Operands { program, source, selected };
    operands
        .relation()
        .or_else(|| operands.constant())
        .or_else(|| operands.position())
        .or_else(|| operands.points())
        .or_else(|| operands.past_the_end())
        .or_else(|| operands.too_short())
}

struct Operands<'a> {
    program: &'a Program,
    source: &'a Instruction,
    selected: &'a Selected,
}

impl Operands<'_> {
    fn span(&self, index: usize) -> Span {
        self.source.operands.get(index).map(|operand| operand.span).unwrap_or_default()
    }

    fn name(&self) -> &'static str {
        self.source.mnemonic()
    }

    fn literal(&self, index: usize) -> Option<i32> {
        match self.selected.arguments.get(index) {
            Some(&Argument::Literal(value)) => Some(value),
            _ => None,
        }
    }

    /// What an operand takes.
    fn takes(&self, index: usize) -> Takes {
        self.selected.role(index).map_or(Takes::Any, |role| role.takes)
    }

    /// The first operand that takes this.
    fn place(&self, takes: Takes) -> Option<usize> {
        self.roles().position(|role| role.takes == takes)
    }

    fn roles(&self) -> impl Iterator<Item = Role> {
        self.selected.op.instruction().written_roles()
    }

    /// A comparison that the instruction does not know.
    fn relation(&self) -> Option<Diagnostic> {
        let relation = self.selected.relation?;
        let instruction = self.selected.op.instruction();
        if instruction.relations().contains(&relation) {
            return None;
        }
        let is_search = instruction.roles.iter().any(|role| role.takes == Takes::Searched);
        let (what, possible) = if is_search {
            ("an S7-200 searches tables", "=, <>, < or >")
        } else {
            ("an S7-200 compares texts", "= or <>")
        };
        let name = self.name();
        let message = format!("{name}{}: {what} with {possible} only", relation.symbol());
        let diagnostic = Diagnostic::new(Code::UnknownMnemonic, self.source.mnemonic_span, message);
        Some(if is_search {
            diagnostic
                .help("`FND>` with a PTN that is less by one finds the same as greater or equal")
        } else {
            diagnostic
                .help(format!("`{name}=` and `{name}<>` compare the lengths and all characters"))
        })
    }

    /// A constant that the instruction refuses.
    fn constant(&self) -> Option<Diagnostic> {
        if let Some(index) = self.place(Takes::Format) {
            return self.format(index, false);
        }
        if let Some(index) = self.place(Takes::RealFormat) {
            return self.format(index, true);
        }
        let (index, value, takes) = self.roles().enumerate().find_map(|(index, role)| {
            let (value, ranges) = (self.literal(index)?, constants(role.takes)?);
            // The sign is the direction.
            let value = if role.takes == Takes::Shift { i32::from(value as i8) } else { value };
            let is_outside = !ranges.iter().any(|&(least, most)| (least..=most).contains(&value));
            is_outside.then_some((index, value, role.takes))
        })?;
        let words = constant_words(self.selected.op.instruction(), index)?;
        let message = format!("{value}: {} takes {words} here", self.name());
        let diagnostic =
            Diagnostic::new(Code::ConstantRange, self.span(index), message).label("out of range");
        Some(diagnostic.help(match takes {
            Takes::Shift => "its sign is the direction, and a shift by no bit is no shift",
            Takes::Position => "the first character of a text is number 1",
            _ => "it is how many are copied, converted or written",
        }))
    }

    /// FMT: ssss cnnn, with the characters of a real, a comma instead of the point, and the digits
    /// after it.
    fn format(&self, index: usize, is_real: bool) -> Option<Diagnostic> {
        let value = self.literal(index)?;
        let (len, decimals) = (value >> 4, value & 7);
        let name = self.name();
        let why = if decimals > DECIMALS_MAX {
            format!("{name} writes 0 to {DECIMALS_MAX} digits after the point, not {decimals}")
        } else if !is_real && len != 0 {
            format!("the upper half of FMT is 0 for {name}, not {len}")
        } else if is_real && len < REAL_LEN_MIN {
            format!("{name} writes {REAL_LEN_MIN} to 15 characters, not {len}")
        } else if is_real && decimals > 0 && len < decimals + 2 {
            format!("{decimals} digits after the point never fit {len} characters")
        } else {
            return None;
        };
        let help = match is_real {
            true => {
                "FMT is 2#ssss_cnnn: ssss characters, c = 1 for a comma, nnn digits after the point"
            }
            false => {
                "FMT is 2#0000_cnnn: c = 1 for a comma instead of a point, nnn digits after it"
            }
        };
        let message = format!("FMT 16#{value:02X}: {why}");
        Some(
            Diagnostic::new(Code::ConstantRange, self.span(index), message)
                .label("out of range")
                .help(help),
        )
    }

    /// A position or a count that lies after the end of a constant text.
    fn position(&self) -> Option<Diagnostic> {
        let (position, length) = (self.place(Takes::Position)?, self.place(Takes::Length));
        let len = match &self.source.operands.first()?.value {
            Value::Text(characters) => characters.len() as i32,
            _ if length.is_some() => TEXT_MAX,
            _ => return None,
        };
        let characters = |len: i32| {
            if len == 1 { "one character".to_owned() } else { format!("{len} characters") }
        };
        let error = |index: usize, message: String| {
            Some(
                Diagnostic::new(Code::ConstantRange, self.span(index), message)
                    .label("out of range"),
            )
        };
        let index = self.literal(position);
        if let Some(index) = index.filter(|&index| index > len) {
            return error(position, format!("position {index}: the text has {}", characters(len)));
        }
        let length = length?;
        let count = self.literal(length)?;
        let rest = len - index.unwrap_or(1) + 1;
        (count > rest)
            .then(|| error(length, format!("{count}: {} are left of a text", characters(rest))))?
    }

    /// Immediate reads and writes of a byte need one of points.
    fn points(&self) -> Option<Diagnostic> {
        let (index, area, what, byte) = if let Some(index) = self.place(Takes::InputByte) {
            (index, Area::I, "a byte of inputs", "IB0")
        } else {
            (self.place(Takes::OutputByte)?, Area::Q, "a byte of outputs", "QB0")
        };
        let Argument::Memory(address) = self.selected.arguments[index] else { return None };
        if matches!(address, Address::Byte { area: found, .. } if found == area) {
            return None;
        }
        let found = value_words(self.program, self.source.operands.get(index)?);
        let message = format!("{} takes {what} here, found {found}", self.name());
        let diagnostic = Diagnostic::new(Code::OperandKind, self.span(index), message)
            .label("wrong kind of operand");
        Some(diagnostic.help(format!("the Uno's points of it are in {byte}")))
    }

    /// A constant count of bits that leads out of the area.
    fn past_the_end(&self) -> Option<Diagnostic> {
        let (first, index) =
            self.roles().enumerate().find_map(|(first, role)| match role.many {
                Many::Counted(place) | Many::Register(place) => Some((first, usize::from(place))),
                _ => None,
            })?;
        let first = self.selected.arguments[first];
        let count = match self.selected.arguments[index] {
            Argument::Constant(count) => u32::from(count),
            Argument::Literal(count) if self.takes(index) == Takes::Shift => {
                u32::from((count as i8).unsigned_abs())
            }
            Argument::Literal(count) => count.unsigned_abs(),
            _ => return None,
        };
        let (place, size, last) = match first {
            Argument::Bit(Address::Bit { area, byte, bit }) => (
                u32::from(byte) * 8 + u32::from(bit),
                u32::from(area.size()) * 8,
                format!("{}{}.7", area.name(), area.size() - 1),
            ),
            Argument::Bit(Address::Timer(number)) | Argument::Timer(number) => {
                (u32::from(number), 256, "T255".into())
            }
            Argument::Bit(Address::Counter(number)) | Argument::Counter(number) => {
                (u32::from(number), 256, "C255".into())
            }
            _ => return None,
        };
        // Local memory can begin after its end where there are too many variables.
        let most = size.saturating_sub(place);
        (count > most).then(|| {
            let message = format!("{count}: the range ends after {last}");
            Diagnostic::new(Code::ConstantRange, self.span(index), message)
                .help(format!("at most {most} fit here"))
        })
    }

    /// An address after which there is not room enough for what the instruction reads or writes
    /// there.
    fn too_short(&self) -> Option<Diagnostic> {
        self.selected.op.instruction().module()?;
        let mut pairs = self.selected.written_kinds().zip(self.selected.arguments()).enumerate();
        pairs.find_map(|(index, (kind, (argument, _)))| match argument {
            Argument::Memory(address) if kind.is_reference() => self.room_for(index, kind, address),
            _ => None,
        })
    }

    fn room_for(&self, index: usize, kind: Kind, address: Address) -> Option<Diagnostic> {
        let width = kind.value_len();
        let many = self.selected.role(index).map_or(Many::One, |role| role.many);
        let count = match many {
            Many::Table => TABLE_WORDS,
            Many::Entries => FOUND_WORDS,
            Many::Characters(place) => 1 + known(self.selected, place).unwrap_or(0) as u16,
            // What FMT in memory asks for is left to the running program.
            Many::Formatted(place, _) if known(self.selected, place).is_none() => 1,
            _ => elements(self.program, self.selected, index),
        };
        let room = room_at(address, width);
        // A single value that does not fit is torn, which is said elsewhere.
        if width * count <= room || width > room {
            return None;
        }
        let message = format!(
            "{} needs {} bytes here: {}",
            self.name(),
            width * count,
            end_words(address, width)
        );
        // What can be changed is the count, where there is one.
        let counted = match many {
            Many::Counted(place) | Many::Halved(place) => Some(usize::from(place)),
            _ => None,
        };
        Some(match counted.filter(|&place| self.literal(place).is_some()) {
            Some(place) => Diagnostic::new(Code::ConstantRange, self.span(place), message)
                .related(self.span(index), "from here on"),
            None => Diagnostic::new(Code::AddressRange, self.span(index), message),
        })
    }
}

/// How much there is from an address on.
fn end_words(address: Address, width: u16) -> String {
    match address {
        Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => {
            let (room, end) = (room_at(address, width), area_end(area, byte) - 1);
            format!("from {address} to {}B{end} there are {room}", area.name())
        }
        Address::Timer(_) | Address::Counter(_) => {
            format!("on the Uno no other value lies beside {address}")
        }
        _ => format!("{address} has {}", room_at(address, width)),
    }
}

/// One past the last byte of an area that follows another without a gap: special memory lies in two
/// pieces.
fn area_end(area: Area, byte: u16) -> u16 {
    if area == Area::Sm && byte < area.page_len() { area.page_len() } else { area.size() }
}

/// Bytes from an address on that values can follow one another in.
fn room_at(address: Address, width: u16) -> u16 {
    match address {
        Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => area_end(area, byte).saturating_sub(byte),
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
