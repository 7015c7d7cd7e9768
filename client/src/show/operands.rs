//! The operands of an instruction that have a value in the PLC: how each is asked for, and how its
//! value is written.

use awl_asm::Address;
use awl_asm::assemble::Assembly;
use awl_asm::ast::Statement;
use awl_asm::selected::{Argument, Selected};
use awl_asm::source::Source;
use awl_asm::units::Part;
use plc_isa::{Area, Kind, Type};

use crate::operand::Operand;
use crate::reference::Reference;
use crate::value::{Base, Form};

/// An operand whose value is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Watched {
    /// The operand, with its name as it stands in the source.
    pub operand: Operand,
    /// What its value means.
    pub meaning: Meaning,
    /// The comment of its symbol.
    pub comment: String,
    /// Whether it is local memory, which other units use as well: its value at the end of the scan
    /// means nothing.
    pub is_local: bool,
}

/// What the value of an operand means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meaning {
    /// It is the value.
    Value,
    /// It is a pointer to it.
    Pointer,
    /// It is how long the text is that begins there.
    TextLen,
}

impl Watched {
    /// Its value as a text.
    pub fn text(&self, raw: u32, base: Base) -> String {
        match (self.meaning, base) {
            (Meaning::Pointer, Base::Decimal) => pointer(raw),
            (Meaning::TextLen, _) => {
                format!("length {}", self.operand.form.text(raw, Base::Decimal))
            }
            _ => self.operand.form.text(raw, base),
        }
    }
}

/// `&VB10`
fn pointer(value: u32) -> String {
    let (code, offset) = ((value >> 24) as u8, value & 0x00FF_FFFF);
    match plc_isa::pointer::area(code) {
        Some(area @ (Area::T | Area::C)) => format!("&{}{}", area.name(), offset / 2),
        Some(area) => format!("&{}B{offset}", area.name()),
        None if code == plc_isa::pointer::ANALOG_INPUT => format!("&AIW{offset}"),
        None if code == plc_isa::pointer::ANALOG_OUTPUT => format!("&AQW{offset}"),
        None => format!("16#{value:08X}"),
    }
}

/// The operands of the instructions of a line, in the order of the text, and which of them has its
/// value taken right after the instruction.
pub fn operands(
    source: &Source,
    assembly: &Assembly,
    unit: Option<&Part>,
    code: &[Selected],
) -> (Vec<Watched>, usize) {
    let mut found: Vec<Watched> = Vec::new();
    let mut ranks = Vec::new();
    for selected in code {
        for (index, ((argument, is_written), kind)) in
            selected.arguments().zip(selected.written_kinds()).enumerate()
        {
            let wanted = Wanted { source, assembly, unit, selected, index, kind };
            for watched in wanted.values(argument) {
                if found.iter().all(|other| other.operand.reference != watched.operand.reference) {
                    let is_result = is_written && watched.meaning == Meaning::Value;
                    // What is local cannot be seen at another time; then a result, then what comes
                    // first.
                    ranks.push((watched.is_local, is_result, usize::MAX - found.len()));
                    found.push(watched);
                }
            }
        }
    }
    let best = ranks.iter().enumerate().max_by_key(|(_, rank)| **rank);
    (found, best.map_or(0, |(index, _)| index))
}

/// An operand that is looked at.
struct Wanted<'a> {
    source: &'a Source,
    assembly: &'a Assembly,
    unit: Option<&'a Part>,
    selected: &'a Selected,
    index: usize,
    kind: Kind,
}

impl Wanted<'_> {
    /// Its values: a timer or counter has a bit, and where the program has a place for it, a
    /// current value.
    fn values(&self, argument: Argument) -> Vec<Watched> {
        let demand = &self.assembly.demand;
        let timer = |number: u8| {
            demand.timers.contains_key(&number).then(|| Reference::to_timer_value(number))
        };
        let counter = |number: u8| {
            demand.counters.contains(&number).then(|| Reference::to_counter_value(number))
        };
        let (address, bit, value) = match argument {
            Argument::Bit(Address::Timer(number)) | Argument::Timer(number) => {
                (Address::Timer(number), true, timer(number))
            }
            Argument::Bit(Address::Counter(number)) | Argument::Counter(number) => {
                (Address::Counter(number), true, counter(number))
            }
            Argument::Memory(address @ Address::Timer(number)) => (address, false, timer(number)),
            Argument::Memory(address @ Address::Counter(number)) => {
                (address, false, counter(number))
            }
            Argument::Bit(address) => return self.memory(address, Form::Bit),
            Argument::Memory(address) => return self.memory(address, self.form()),
            Argument::Indirect(address) => {
                let pointer = |watched| Watched { meaning: Meaning::Pointer, ..watched };
                return self.memory(address, Form::Double).into_iter().map(pointer).collect();
            }
            _ => return Vec::new(),
        };
        let bit = bit
            .then(|| Reference::to(address))
            .flatten()
            .map(|bit| self.watched(address, bit, Form::Bit));
        let value = value.map(|value| self.watched(address, value, Form::Word));
        bit.into_iter().chain(value).collect()
    }

    fn memory(&self, address: Address, form: Form) -> Vec<Watched> {
        let local = |byte: u16| self.unit.and_then(|unit| unit.local(byte));
        let reference = Reference::in_unit(address, local);
        reference.map(|reference| self.watched(address, reference, form)).into_iter().collect()
    }

    fn watched(&self, address: Address, reference: Reference, form: Form) -> Watched {
        let program = &self.assembly.program;
        let index = self.selected.parameter.map_or(self.index, usize::from);
        let written = match program.statements.get(self.selected.statement as usize) {
            Some(Statement::Instruction(instruction)) => instruction.operands.get(index),
            _ => None,
        };
        let name = written.map_or("", |operand| operand.span.text(&self.source.text)).to_owned();
        let bare = name.trim_matches('"');
        let symbol = program.symbols.iter().find(|symbol| symbol.name.eq_ignore_ascii_case(bare));
        let comment = symbol.map_or(String::new(), |symbol| symbol.comment.clone());
        let operand = Operand { name, address, reference, form, base: None };
        let is_text = self.kind.value_type() == Some(Type::Text);
        let meaning = if is_text { Meaning::TextLen } else { Meaning::Value };
        Watched { operand, meaning, comment, is_local: is_local(address) }
    }

    fn form(&self) -> Form {
        match self.kind.value_type() {
            Some(Type::Byte | Type::Text) => Form::Byte,
            Some(Type::Double) => Form::Double,
            Some(Type::Real) => Form::Real,
            Some(Type::Bit | Type::Word) | None => Form::Word,
        }
    }
}

fn is_local(address: Address) -> bool {
    match address {
        Address::Bit { area, .. }
        | Address::Byte { area, .. }
        | Address::Word { area, .. }
        | Address::Double { area, .. } => area == Area::L,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::assemble::assemble;

    /// Name, reference, form.
    type Found = (String, [u8; 3], Form);
    type Expected = (&'static str, [u8; 3], Form);

    /// The operands of the last instruction, and which has its value taken right after it.
    fn of(text: &str) -> (Vec<Found>, usize) {
        let source = Source::new("t.awl", text).unwrap();
        let assembly = assemble(&source, Vec::new());
        assert!(!assembly.has_errors(), "{:?}", assembly.diagnostics);
        let last = assembly.code.last().unwrap().statement;
        let first = assembly.code.iter().position(|selected| selected.statement == last).unwrap();
        let (found, result) =
            operands(&source, &assembly, assembly.units.of(first), &assembly.code[first..]);
        (
            found
                .into_iter()
                .map(|one| (one.operand.name, one.operand.reference.0, one.operand.form))
                .collect(),
            result,
        )
    }

    #[test]
    fn operands_in_the_order_of_the_text() {
        use Form::{Bit, Double, Real, Word};
        let cases: [(&str, &[Expected], usize); 9] = [
            ("LD I0.3", &[("I0.3", [0x03, 0, 0], Bit)], 0),
            ("LDW> VW2, MW4", &[("VW2", [0x89, 0, 2], Word), ("MW4", [0x29, 0, 4], Word)], 0),
            (
                "LD I0.0\nMOVW AIW2, VW0",
                &[("AIW2", [0x99, 0, 2], Word), ("VW0", [0x89, 0, 0], Word)],
                1,
            ),
            (
                "LD I0.0\nTON T37, VW0",
                &[
                    ("T37", [0x50, 0, 37], Bit),
                    ("T37", [0x59, 0, 37], Word),
                    ("VW0", [0x89, 0, 0], Word),
                ],
                0,
            ),
            ("LD T37", &[("T37", [0x50, 0, 37], Bit)], 0),
            (
                "LD I0.0\nMOVD VD0, AC1",
                &[("VD0", [0x8A, 0, 0], Double), ("AC1", [0x9A, 0, 28], Double)],
                1,
            ),
            ("LD I0.0\n+R 1.5, VD8", &[("VD8", [0x8A, 0, 8], Real)], 0),
            (
                "LD I0.0\nMOVD *AC1, VD0",
                &[("*AC1", [0x9A, 0, 28], Double), ("VD0", [0x8A, 0, 0], Double)],
                1,
            ),
            ("LD I0.0\nEU", &[], 0),
        ];
        for (text, expected, result) in cases {
            let expected: Vec<_> = expected
                .iter()
                .map(|&(name, bytes, kind)| (name.to_owned(), bytes, kind))
                .collect();
            assert_eq!(of(text), (expected, result), "{text}");
        }
    }

    #[test]
    fn symbols_stand_as_in_the_source() {
        let source =
            Source::new("t.awl", "//# symbol Lamp Q0.1 the green one\nLD I0.0\n= lamp\n").unwrap();
        let assembly = assemble(&source, Vec::new());
        let (found, _) = operands(&source, &assembly, assembly.units.of(1), &assembly.code[1..]);
        assert_eq!(
            (found[0].operand.name.as_str(), found[0].comment.as_str()),
            ("lamp", "the green one")
        );
    }

    #[test]
    fn of_a_text_the_length_is_told() {
        let source = Source::new("t.awl", "LD SM0.0\nSCPY VB0, VB20\n").unwrap();
        let assembly = assemble(&source, Vec::new());
        let (found, _) = operands(&source, &assembly, assembly.units.of(1), &assembly.code[1..]);
        assert_eq!(found[1].text(13, Base::Hexadecimal), "length 13");
    }

    #[test]
    fn pointers_are_addresses() {
        let texts = [0x0800_000A, 0x0A00_0004, 0x0200_0002, 0x0500_0003, 5].map(pointer);
        assert_eq!(texts, ["&VB10", "&C2", "&AIW2", "&MB3", "&IB5"]);
    }
}
