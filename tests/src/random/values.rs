//! Operands of the instructions of modules: bytes, words, double words, reals, strings and blocks,
//! from memory, through pointers and constant.
//!
//! V memory: up to VB95 everything, VB100 to VB127 reals that are numbers, VB128 to VB163 a table
//! of PID, VB164 a pointer, VB168 to VB195 a table, VB200 to VB711 two strings. The data block puts
//! something sensible there.

use awl_asm::ast::Type;
use plc_isa::{Area, Form, Group, Instruction, Kind, Op};

use super::Generator;
use super::operand_text::{Count, OperandText};
use super::operands::last_byte;

/// The two strings.
const TEXTS: [&str; 2] = ["VB200", "VB456"];
/// Formats of integers and of reals as characters. Illegal ones come from memory alone: the
/// assembler refuses them.
const FORMATS: [&str; 6] = ["0", "1", "3", "16#0A", "16#0D", "5"];
const REAL_FORMATS: [&str; 6] = ["16#8A", "16#F5", "16#61", "16#40", "16#30", "16#31"];

/// The data block of a program with modules.
pub(super) const DATA: &str = "DATA_BLOCK\n\
    VD100 1.5, -2.25, 3.0E10, 0.1, -7.0E-5, 100.0, 0.0\n\
    VD128 0.5, 0.75, 0.25, 2.0, 1.0, 0.5, 0.1, 0.25, 0.5\n\
    VW168 8, 2, 17, -5, 3, 0, 0, 0, 0, 0\n\
    VB200 \"Motor 12.5 A\"\n\
    VB456 \"-42\"\n\
    END_DATA_BLOCK\n";

/// How many values a block has, as text and at most.
struct Block {
    text: String,
    at_most: u32,
    /// Whether the text is a constant.
    is_certain: bool,
}

impl Generator<'_> {
    /// The written operands of a module's instruction, or `None` where the dice fell badly.
    pub(super) fn values(&mut self, row: &Instruction, form: &Form) -> Option<Vec<String>> {
        let kinds: Vec<Kind> =
            form.kinds.iter().copied().filter(|kind| kind.is_written()).collect();
        let block = self.block_len(row.op);
        let mut texts = Vec::new();
        for (index, &kind) in kinds.iter().enumerate() {
            texts.push(self.value(row, index, kind, &block)?.text);
        }
        let is_constant = |text: &str| text.starts_with('"');
        if matches!(row.op, Op::Sti | Op::Std | Op::Str | Op::Sscpy) && is_constant(&texts[0]) {
            // The assembler refuses what lies after the end.
            texts[1] = "MB0".to_string();
            texts[2] = if row.op == Op::Sscpy { "MB1".to_string() } else { texts[2].clone() };
        }
        Some(texts)
    }

    fn value(
        &mut self,
        row: &Instruction,
        index: usize,
        kind: Kind,
        block: &Block,
    ) -> Option<OperandText> {
        if let Some(place) = self.special_value(row.op, index, block) {
            return place;
        }
        let compares = row.group == Group::Compare;
        match kind {
            Kind::FarBit => self.bit(None, true),
            Kind::FarBitOut if row.op == Op::Shrb => self
                .bit(Some(&Count { at_most: block.at_most, is_certain: block.is_certain }), false),
            Kind::FarBitOut => self.bit(Some(&Count { at_most: 255, is_certain: false }), true),
            Kind::FarBitReset => self.bit(Some(&Count { at_most: 255, is_certain: false }), false),
            Kind::ByteIn if self.one_in(3) => Some(OperandText::constant(self.byte_constant())),
            Kind::WordIn if self.one_in(4) => {
                Some(OperandText::constant(self.word_constant_of(row)))
            }
            Kind::DoubleIn if self.one_in(4) => Some(OperandText::constant(self.double_constant())),
            Kind::RealIn => self.real_in(compares || row.op == Op::Movr),
            Kind::TextIn => self.text_in(!compares || index == 0),
            Kind::ByteIn | Kind::WordIn | Kind::DoubleIn => {
                self.anywhere(kind.value_len(), false, compares)
            }
            Kind::ByteTo | Kind::WordTo | Kind::DoubleTo => {
                self.anywhere(kind.value_len(), true, false)
            }
            Kind::RealTo if self.one_in(4) => self.double(true),
            Kind::RealTo => Some(self.real()),
            Kind::TextTo => Some(OperandText::constant(self.any_text().to_string())),
            Kind::BytesAt | Kind::WordsAt | Kind::DoublesAt => {
                self.block_at(kind.value_len(), false, block)
            }
            Kind::InputPoint => {
                let text = format!("I0.{}", self.rng.u32(..6));
                Some(OperandText::constant(self.localized(&text)))
            }
            Kind::OutputPoint => self.output_points(row.op, block),
            Kind::Loop => Some(OperandText::constant(self.rng.u8(..8).to_string())),
            _ => None,
        }
    }

    /// Operands that an instruction needs to be more than any value.
    fn special_value(
        &mut self,
        op: Op,
        index: usize,
        block: &Block,
    ) -> Option<Option<OperandText>> {
        let fixed = |text: &str| Some(Some(OperandText::constant(text.to_string())));
        let input = if self.rng.bool() { "IB0" } else { "IB1" };
        match (op, index) {
            (Op::Pid, 0) => fixed("VB128"),
            (Op::Bir, 0) => fixed(&self.localized(input)),
            (Op::Biw, 1) => {
                let text = format!("{}B0", self.area_name(Area::Q));
                Some(self.place(text, Area::Q, 0..8, true))
            }
            (Op::Att, 1) | (Op::Fifo | Op::Lifo, 0) => fixed("VW168"),
            (Op::Fnd, 0) => fixed("VW170"),
            (Op::Fill | Op::Bmw, 1) => Some(self.block_at(2, true, block)),
            (Op::Bmb | Op::Ath | Op::Hta | Op::Ita | Op::Dta | Op::Rta, 1) => {
                Some(self.block_at(1, true, block))
            }
            (Op::Bmd, 1) => Some(self.block_at(4, true, block)),
            (Op::Fill | Op::Bmb | Op::Bmw | Op::Bmd | Op::Ath | Op::Hta, 2) => fixed(&block.text),
            (Op::SetImmediate | Op::ResetImmediate, 1) => fixed(&block.text),
            (Op::Ita | Op::Dta, 2) | (Op::Its | Op::Dts, 1) if self.one_in(2) => {
                fixed(self.rng.choice(FORMATS)?)
            }
            (Op::Rta, 2) | (Op::Rts, 1) if self.one_in(2) => fixed(self.rng.choice(REAL_FORMATS)?),
            (Op::Ita | Op::Dta | Op::Rta, 2) | (Op::Its | Op::Dts | Op::Rts, 1) => {
                Some(self.anywhere(1, false, false))
            }
            (Op::Sti | Op::Std | Op::Str | Op::Sscpy, 1) | (Op::Sscpy, 2) if self.one_in(3) => {
                let number = self.rng.u8(1..8).to_string();
                fixed(&number)
            }
            (Op::Sti | Op::Std | Op::Str | Op::Sscpy, 1) | (Op::Sscpy, 2) => {
                Some(self.anywhere(1, false, false))
            }
            (Op::Todr, 0) => Some(self.block_at(1, true, block)),
            (Op::SetAny | Op::ResetAny, 1) => Some(self.anywhere(1, false, false)),
            (Op::Shrb, 2) => fixed(&block.text),
            _ => None,
        }
    }

    fn block_len(&mut self, op: Op) -> Block {
        if matches!(op, Op::Ita | Op::Dta | Op::Rta) {
            return Block { text: String::new(), at_most: 15, is_certain: true };
        }
        if matches!(op, Op::Todr | Op::Todw) {
            return Block { text: String::new(), at_most: 8, is_certain: true };
        }
        if op == Op::Shrb {
            let counts = [
                ("1", 1),
                ("8", 8),
                ("-8", 8),
                ("64", 64),
                ("-64", 64),
                ("3", 3),
                ("-1", 1),
                ("MB0", 64),
            ];
            let (text, at_most) = counts[self.rng.usize(..counts.len())];
            return Block { text: text.to_string(), at_most, is_certain: text != "MB0" };
        }
        if matches!(op, Op::SetImmediate | Op::ResetImmediate) || !self.one_in(4) {
            let count = self
                .rng
                .u32(1..=if op == Op::SetImmediate || op == Op::ResetImmediate { 3 } else { 8 });
            return Block { text: count.to_string(), at_most: count, is_certain: true };
        }
        Block { text: format!("MB{}", self.rng.u32(..5)), at_most: 255, is_certain: false }
    }

    /// The first value of a block. One whose length only the running program knows is not in V
    /// memory, where it would reach too far.
    fn block_at(&mut self, width: u16, is_written: bool, block: &Block) -> Option<OperandText> {
        if block.is_certain && self.one_in(5) {
            return self.pointed(is_written, false);
        }
        let area = self.area(is_written, false);
        if area == Area::V && !block.is_certain {
            return None;
        }
        let byte = self.byte_number(area, is_written)?;
        let (first, len) = (u32::from(byte), u32::from(width) * block.at_most);
        let end = u32::from(last_byte(area)) + 1;
        if block.is_certain && first + len > end {
            return None;
        }
        let letter = match width {
            1 => "B",
            2 => "W",
            _ => "D",
        };
        if first + u32::from(width) > end {
            return None;
        }
        let text = format!("{}{letter}{byte}", self.area_name(area));
        self.place(text, area, first * 8..(first + len).min(end) * 8, is_written)
    }

    /// A byte, word or double word.
    fn anywhere(&mut self, width: u16, is_written: bool, is_certain: bool) -> Option<OperandText> {
        match self.rng.u32(..8) {
            0 => Some(OperandText::constant("AC0".to_string())),
            1 | 2 => self.pointed(is_written, is_certain),
            _ => match width {
                1 => self.byte(is_written),
                2 => self.word(is_written),
                _ => self.double(is_written),
            },
        }
    }

    pub(super) fn double(&mut self, is_written: bool) -> Option<OperandText> {
        if self.one_in(3)
            && let Some(local) = self.local(Type::Dint, is_written)
        {
            return Some(local);
        }
        let area = self.area(is_written, false);
        let byte = self.byte_number(area, is_written)?;
        if byte + 3 > last_byte(area) {
            return None;
        }
        let first = u32::from(byte) * 8;
        let text = format!("{}D{byte}", self.area_name(area));
        self.place(text, area, first..first + 32, is_written)
    }

    /// Moves and logic take patterns, all others integers.
    fn word_constant_of(&mut self, row: &Instruction) -> String {
        if matches!(row.group, Group::Move | Group::Logic) {
            self.word_constant()
        } else {
            self.integer_constant(row)
        }
    }

    fn double_constant(&mut self) -> String {
        let value = match self.rng.u32(..6) {
            0 => self.rng.i32(..),
            1 => [i32::MAX, i32::MIN, -1, 0, 65_536, 4_095, 4_096, -4_096, -4_097]
                [self.rng.usize(..9)],
            _ => self.rng.i32(-300..=300),
        };
        if self.one_in(4) { format!("16#{value:X}") } else { value.to_string() }
    }

    /// A double word with a number.
    fn real(&mut self) -> OperandText {
        OperandText::constant(format!("VD{}", 100 + 4 * self.rng.u32(..7)))
    }

    fn real_in(&mut self, is_certain: bool) -> Option<OperandText> {
        match self.rng.u32(..6) {
            0 => Some(OperandText::constant(self.real_constant())),
            1 if !is_certain => self.double(false),
            _ => Some(self.real()),
        }
    }

    fn real_constant(&mut self) -> String {
        let some = [
            "1.0",
            "-1.5",
            "0.0",
            "3.402823e38",
            "1.175494e-38",
            "-0.1",
            "1e10",
            "2.5",
            "89.0",
            "16777216.0",
        ];
        match self.rng.u32(..3) {
            0 => format!("{:?}", f64::from(self.rng.i32(-10_000..=10_000)) / 64.0),
            _ => some[self.rng.usize(..some.len())].to_string(),
        }
    }

    fn any_text(&mut self) -> &'static str {
        if self.one_in(6) && self.offer.has_pointers() && !self.is_any_protected() {
            "*AC3"
        } else {
            TEXTS[self.rng.usize(..2)]
        }
    }

    fn text_in(&mut self, takes_constants: bool) -> Option<OperandText> {
        let constants =
            ["\"\"", "\"A\"", "\"12.5\"", "\"-42\"", "\"Motor\"", "\"0123456789\"", "\" +7x\""];
        let text = match self.rng.u32(..4) {
            0 if takes_constants => constants[self.rng.usize(..constants.len())],
            _ => self.any_text(),
        };
        Some(OperandText::constant(text.to_string()))
    }

    fn output_points(&mut self, op: Op, block: &Block) -> Option<OperandText> {
        let count = if op == Op::AssignImmediate { 1 } else { block.at_most };
        let first = self.rng.u32(..=6 - count);
        let text = format!("{}0.{first}", self.area_name(Area::Q));
        self.place(text, Area::Q, first..first + count, true)
    }
}
