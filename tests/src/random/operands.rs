//! Operands of a random program: addresses from small pools.

use std::ops::Range;

use awl_asm::ast::Type;
use plc_isa::{Area, Form, Group, Instruction, Kind, Op};

use super::operand_text::{Count, Extent, OperandText};
use super::{COUNTERS, Generator, TIMERS};

impl Generator<'_> {
    /// The written operands of a form, or `None` where the dice fell badly.
    pub(super) fn operands(&mut self, row: &Instruction, form: &Form) -> Option<Vec<String>> {
        let kinds: Vec<Kind> =
            form.kinds.iter().copied().filter(|kind| kind.is_written()).collect();
        let count = self.count(&kinds);
        let texts: Vec<String> = kinds
            .iter()
            .map(|&kind| self.operand(row, kind, &count))
            .collect::<Option<Vec<_>>>()?;
        // A timer or counter whose preset is its own current value: when the preset is read is not
        // settled.
        let owns = matches!(row.group, Group::Timer | Group::Counter);
        (!owns || texts[0] != texts[1]).then_some(texts)
    }

    /// How many bits or numbers an instruction with these kinds writes, as text, and at most.
    fn count(&mut self, kinds: &[Kind]) -> Count {
        if kinds.contains(&Kind::Count) {
            let count = match self.rng.u32(..10) {
                0 => 255,
                1 => self.rng.u32(1..=255),
                _ => self.rng.u32(1..=20),
            };
            return Count { at_most: count, is_certain: true };
        }
        if kinds.contains(&Kind::Byte) {
            return Count { at_most: 255, is_certain: false };
        }
        Count { at_most: 1, is_certain: true }
    }

    fn operand(&mut self, row: &Instruction, kind: Kind, count: &Count) -> Option<String> {
        let place = match kind {
            Kind::PageBit | Kind::FarBit => self.bit(None, true)?,
            Kind::PageBitOut | Kind::FarBitOut => self.bit(Some(count), true)?,
            Kind::PageBitReset | Kind::FarBitReset => self.bit(Some(count), false)?,
            Kind::Byte => self.byte(false)?,
            Kind::ByteOut => self.byte(true)?,
            Kind::ByteConst => OperandText::constant(self.byte_constant()),
            Kind::AnyByte if self.one_in(2) => OperandText::constant(self.byte_constant()),
            Kind::AnyByte => self.byte(false)?,
            Kind::Word => self.word(false)?,
            Kind::WordOut => self.word(true)?,
            Kind::WordConst => OperandText::constant(self.word_constant()),
            Kind::IntConst => OperandText::constant(self.integer_constant(row)),
            Kind::AnyInt if self.one_in(2) => OperandText::constant(self.integer_constant(row)),
            Kind::AnyInt => self.word(false)?,
            Kind::One => OperandText::constant("1".to_string()),
            Kind::Count => OperandText::constant(count.at_most.to_string()),
            Kind::TimerSlot => self.owned(&self.timers.clone(), row.op, Area::T)?,
            Kind::CounterSlot => self.owned(&self.counters.clone(), row.op, Area::C)?,
            Kind::TimerNumber => self.numbered(Area::T, Some(count))?,
            Kind::CounterNumber => self.numbered(Area::C, Some(count))?,
            Kind::Level => OperandText::constant(self.rng.u8(..self.depth.max(1)).to_string()),
            Kind::Number => OperandText::constant(self.rng.u8(..).to_string()),
            // Labels are placed by the functions above, the others are not written.
            Kind::LabelIndex | Kind::LabelNumber => return None,
            _ => return None,
        };
        Some(place.text)
    }

    pub(super) fn is_protected(&self, extent: &Extent) -> bool {
        self.protected.iter().any(|other| other.overlaps(extent))
    }

    /// The place, unless it would be written and must not be.
    pub(super) fn place(
        &self,
        text: String,
        area: Area,
        range: Range<u32>,
        is_written: bool,
    ) -> Option<OperandText> {
        let extent = Extent { area, range };
        let forbidden = is_written && self.is_protected(&extent);
        (!forbidden).then_some(OperandText { text, extent: Some(extent) })
    }

    /// A bit; `written` says how many from it on are written.
    pub(super) fn bit(
        &mut self,
        written: Option<&Count>,
        timers_and_counters: bool,
    ) -> Option<OperandText> {
        if written.is_none_or(|count| count.at_most == 1)
            && self.one_in(3)
            && let Some(local) = self.local(Type::Bool, written.is_some())
        {
            return Some(local);
        }
        let area = self.area(written.is_some(), timers_and_counters);
        if matches!(area, Area::T | Area::C) {
            return self.numbered(area, written);
        }
        let byte = self.byte_number(area, written.is_some())?;
        let bit = self.rng.u32(..8);
        let first = u32::from(byte) * 8 + bit;
        let size = (u32::from(last_byte(area)) + 1) * 8;
        let end = self.end_of(first, written, size)?;
        let text = format!("{}{byte}.{bit}", self.area_name(area));
        self.place(text, area, first..end, written.is_some())
    }

    /// One past the last bit or number that is written, if that is legal.
    fn end_of(&self, first: u32, written: Option<&Count>, size: u32) -> Option<u32> {
        match written {
            None => Some(first + 1),
            Some(count) if first + count.at_most <= size => Some(first + count.at_most),
            Some(count) if !count.is_certain => Some(size),
            Some(_) => None,
        }
    }

    pub(super) fn byte(&mut self, is_written: bool) -> Option<OperandText> {
        if self.one_in(3)
            && let Some(local) = self.local(Type::Byte, is_written)
        {
            return Some(local);
        }
        let area = self.area(is_written, false);
        let byte = self.byte_number(area, is_written)?;
        let first = u32::from(byte) * 8;
        let text = format!("{}B{byte}", self.area_name(area));
        self.place(text, area, first..first + 8, is_written)
    }

    pub(super) fn word(&mut self, is_written: bool) -> Option<OperandText> {
        if !is_written && self.one_in(10) {
            let channel = self.rng.u8(..6);
            let text = if self.one_in(2) {
                format!("AIW{}", 2 * channel)
            } else {
                format!("Ain{channel}")
            };
            return Some(OperandText::constant(self.localized(&text)));
        }
        if self.one_in(3)
            && let Some(local) = self.local(Type::Int, is_written)
        {
            return Some(local);
        }
        let area = self.area(is_written, true);
        if matches!(area, Area::T | Area::C) {
            return self
                .numbered(area, is_written.then_some(&Count { at_most: 1, is_certain: true }));
        }
        let byte = self.byte_number(area, is_written)?.min(last_byte(area) - 1);
        if is_written && byte < area.first_writable() + 1 && area == Area::Sm {
            return None;
        }
        let first = u32::from(byte) * 8;
        let text = format!("{}W{byte}", self.area_name(area));
        self.place(text, area, first..first + 16, is_written)
    }

    /// A timer or counter, whoever owns it.
    fn numbered(&mut self, area: Area, written: Option<&Count>) -> Option<OperandText> {
        let number =
            if area == Area::T { self.rng.choice(TIMERS)? } else { self.rng.choice(COUNTERS)? };
        let end = self.end_of(u32::from(number), written, 256)?;
        let text = format!("{}{number}", self.area_name(area));
        self.place(text, area, u32::from(number)..end, written.is_some())
    }

    fn owned(&mut self, owners: &[(u8, Op)], op: Op, area: Area) -> Option<OperandText> {
        let own: Vec<u8> =
            owners.iter().filter(|owner| owner.1 == op).map(|owner| owner.0).collect();
        let number = self.rng.choice(own)?;
        let text = format!("{}{number}", self.area_name(area));
        self.place(text, area, u32::from(number)..u32::from(number) + 1, true)
    }

    pub(super) fn area(&mut self, is_written: bool, timers_and_counters: bool) -> Area {
        use Area::{C, I, M, Q, S, Sm, T, V};
        loop {
            let area = [I, I, Q, Q, M, M, M, M, V, V, V, S, Sm, T, C][self.rng.usize(..15)];
            let exists = timers_and_counters || !matches!(area, T | C);
            // Inputs are written now and then.
            if exists && !(is_written && area == I && !self.one_in(4)) {
                return area;
            }
        }
    }

    pub(super) fn byte_number(&mut self, area: Area, is_written: bool) -> Option<u16> {
        let pool: &[u16] = match area {
            Area::I => &[0, 0, 0, 1, 1, 2, 14, 15],
            Area::Q => &[0, 0, 0, 1, 2, 15],
            Area::M => &[0, 0, 1, 1, 2, 3, 4, 30, 31],
            Area::S => &[0, 1, 30, 31],
            // Others that can be written mean something to the hardware.
            Area::Sm if is_written => &[31],
            Area::Sm => &[0, 0, 1, 1, 22, 23, 24, 26, 29, 30, 31],
            Area::V if self.offer.has_modules() => {
                &[0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 30, 31, 40, 62, 63]
            }
            Area::V => &[0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 30, 62, 63, 1000, 1001, 10_238, 10_239],
            Area::T | Area::C | Area::L => &[],
        };
        let byte = self.rng.choice(pool.iter().copied())?;
        (!is_written || byte >= area.first_writable()).then_some(byte)
    }

    pub(super) fn area_name(&self, area: Area) -> &'static str {
        match area {
            Area::I if self.german => "E",
            Area::Q if self.german => "A",
            Area::C if self.german => "Z",
            _ => area.name(),
        }
    }

    /// An operand with the area letters of the program's language.
    pub(super) fn localized(&self, operand: &str) -> String {
        match operand.split_at(1) {
            ("I", rest) if self.german => format!("E{rest}"),
            _ if self.german => operand.replace("AIW", "AEW"),
            _ => operand.to_string(),
        }
    }
}

/// The last byte of an area that programs name here: special memory from SMB32 on means something
/// to the hardware.
pub(super) fn last_byte(area: Area) -> u16 {
    if area == Area::Sm { 31 } else { area.size() - 1 }
}
