//! Instructions and their operands as text.

use std::collections::BTreeSet;

use plc_isa::{
    ANALOG_INPUTS, ANALOG_OUTPUTS, AnalogInput, Area, Bit, Decoded, Group, Kind, Op, Operand,
    Program, ProgramMemory, Reference, Referent, Region, decode, pointer,
};

use crate::output::disassemble::frames::{Copy, Frames, copy, number, offset};
use crate::output::disassemble::unit_id;
use crate::text::address::Address;
use crate::text::ast::{Section, Type};
use crate::text::escapes;

/// Writes instruction after instruction.
pub(super) struct Writer<'a, P> {
    program: &'a Program<P>,
    frames: &'a Frames,
    /// Whether the program follows pointers: then constants may be some.
    has_pointers: bool,
    /// The copies of the last call with parameters, and the offset after it.
    call: Vec<Copy>,
    call_end: u16,
    /// Those of the calls that follow, the next one last.
    upcoming: Vec<Vec<Copy>>,
    /// The hidden labels.
    segment_ends: BTreeSet<u16>,
}

impl<'a, P: ProgramMemory> Writer<'a, P> {
    pub(super) fn new(
        program: &'a Program<P>,
        frames: &'a Frames,
        code: &[(u16, u8, Decoded)],
    ) -> Self {
        let mut writer = Writer {
            program,
            frames,
            has_pointers: code
                .iter()
                .any(|(_, _, decoded)| decoded.operands().any(|(_, operand)| is_indirect(operand))),
            call: Vec::new(),
            call_end: 0,
            segment_ends: segment_ends(code),
            upcoming: calls(code),
        };
        writer.upcoming.reverse();
        writer
    }

    /// An instruction as AWL; empty for hidden ones and for the copies of a call.
    pub(super) fn instruction(&mut self, unit: u8, at: u16, decoded: &Decoded) -> String {
        if decoded.op == Op::CallBegin {
            self.call = self.upcoming.pop().unwrap_or_default();
            self.call_end = offset(decoded);
            return String::new();
        }
        if at < self.call_end {
            return if decoded.op == Op::Call {
                self.call_text(unit, decoded)
            } else {
                String::new()
            };
        }
        let instruction = decoded.op.instruction();
        if instruction.group == Group::Hidden || self.segment_ends.contains(&at) {
            return String::new();
        }
        let relation = decoded.relation().map_or("", |relation| relation.symbol());
        let mnemonic = format!("{}{relation}", instruction.mnemonic());
        let written = decoded.operands().filter(|(kind, _)| kind.is_written());
        let operands: Vec<String> =
            written.map(|(kind, operand)| self.operand(unit, decoded.op, kind, operand)).collect();
        if operands.is_empty() {
            mnemonic
        } else {
            format!("{mnemonic:<6} {}", operands.join(", "))
        }
    }

    /// A call with its parameters.
    fn call_text(&self, unit: u8, decoded: &Decoded) -> String {
        let callee = number(decoded).unwrap_or(0) + 1;
        let mut operands = vec![unit_id(self.program, callee).to_string()];
        for parameter in self.frames.parameters(callee) {
            let is_back = parameter.section == Section::Out;
            let copy = self
                .call
                .iter()
                .find(|copy| copy.place == parameter.place && copy.is_back == is_back);
            operands.extend(copy.map(|copy| {
                let (kind, operand) = copy.other;
                let is_real = parameter.kind == Type::Real && kind == Kind::DoubleIn;
                let kind = if is_real { Kind::RealIn } else { kind };
                self.operand(unit, Op::Movd, kind, operand)
            }));
        }
        format!("{:<6} {}", "CALL", operands.join(", "))
    }

    fn operand(&self, unit: u8, op: Op, kind: Kind, operand: Operand) -> String {
        let plan = self.program.plan();
        match (kind, operand) {
            (Kind::TimerSlot, Operand::Number(slot)) => format!("T{}", plan.timer(slot).number),
            (Kind::CounterSlot, Operand::Number(slot)) => format!("C{}", plan.counter(slot).number),
            (Kind::TimerNumber, Operand::Number(number)) => format!("T{number}"),
            (Kind::CounterNumber, Operand::Number(number)) => format!("C{number}"),
            (Kind::LabelIndex, Operand::Label(index)) => self.label_at(plan.label(index)),
            (_, Operand::Label(number)) => number.to_string(),
            (Kind::Routine, Operand::Number(index)) => unit_id(self.program, index + 1).to_string(),
            (Kind::Event, Operand::Number(index)) => plan.event(index).to_string(),
            (_, Operand::Number(number)) => number.to_string(),
            (Kind::IntConst | Kind::WordConst | Kind::AnyInt, Operand::Constant(value)) => {
                (value as i16).to_string()
            }
            (_, Operand::Constant(value)) => value.to_string(),
            (_, Operand::Bit(bit)) => self.bit(unit, bit),
            (Kind::Byte | Kind::ByteOut | Kind::AnyByte, Operand::Memory(at)) => {
                self.memory(unit, at, 1)
            }
            (_, Operand::Memory(at)) => self.memory(unit, at, 2),
            (_, Operand::Reference(reference)) => self.reference(unit, op, kind, reference),
            (_, Operand::Relation(_) | Operand::Offset(_)) => String::new(),
        }
    }

    /// The number of the label at an offset.
    fn label_at(&self, at: u16) -> String {
        let decoded = decode(self.program.memory(), at).ok();
        let number = decoded.and_then(|decoded| match decoded.operands().next()? {
            (_, Operand::Label(number)) => Some(number),
            _ => None,
        });
        number.unwrap_or(0).to_string()
    }

    /// The number of a byte in the local memory of its unit.
    fn local_byte(&self, unit: u8, byte: u16) -> u16 {
        byte.saturating_sub(self.frames.base(unit))
    }

    fn bit(&self, unit: u8, Bit { address, bit }: Bit) -> String {
        match self.program.plan().region(address) {
            Some(Region::Byte { area: Area::T, byte, .. }) => {
                Address::Timer((byte * 8) as u8 + bit).to_string()
            }
            Some(Region::Byte { area: Area::C, byte, .. }) => {
                Address::Counter((byte * 8) as u8 + bit).to_string()
            }
            Some(Region::Byte { area: area @ Area::L, byte, .. }) => {
                Address::Bit { area, byte: self.local_byte(unit, byte), bit }.to_string()
            }
            Some(Region::Byte { area, byte, .. }) => Address::Bit { area, byte, bit }.to_string(),
            _ => String::new(),
        }
    }

    /// A value of `len` bytes at a data address.
    fn memory(&self, unit: u8, at: u16, len: u16) -> String {
        let address = match self.program.plan().region(at) {
            Some(Region::Byte { area, byte, .. }) => {
                let byte = if area == Area::L { self.local_byte(unit, byte) } else { byte };
                match len {
                    1 => Address::Byte { area, byte },
                    2 => Address::Word { area, byte },
                    _ => Address::Double { area, byte },
                }
            }
            Some(Region::Analog(input @ (AnalogInput::Scaled(_) | AnalogInput::Raw(_)))) => {
                Address::Analog(input)
            }
            Some(Region::TimerValue(number)) => Address::Timer(number),
            Some(Region::CounterValue(number)) => Address::Counter(number),
            Some(Region::Accumulator { number, .. }) => Address::Accumulator(number),
            Some(Region::HighSpeedCounter(number)) => Address::HighSpeedCounter(number),
            Some(Region::AnalogOutput(channel)) => Address::AnalogOutput(channel),
            None => return String::new(),
        };
        address.to_string()
    }

    fn reference(&self, unit: u8, op: Op, kind: Kind, reference: Reference) -> String {
        let memory = self.program.memory();
        match reference.place() {
            None => String::new(),
            Some(Referent::Direct(at)) => self.memory(unit, at, kind.value_len()),
            Some(Referent::Indirect(at)) => format!("*{}", self.memory(unit, at, 4)),
            Some(Referent::Constant(value)) if kind == Kind::RealIn => real_text(value as u32),
            // The sign is the direction.
            Some(Referent::Constant(value)) if op == Op::Shrb => (value as i8).to_string(),
            Some(Referent::Constant(value)) => value.to_string(),
            Some(Referent::Pool(offset)) => match (kind, kind.value_len()) {
                (Kind::TextIn, _) => {
                    let len = u16::from(memory.byte(offset));
                    let text = (1..=len).map(|index| memory.byte(offset + index));
                    format!("\"{}\"", escapes::write(&text.collect::<Vec<u8>>()))
                }
                (_, 4) => {
                    let bytes = [0, 1, 2, 3].map(|index| memory.byte(offset + index));
                    let value = u32::from_be_bytes(bytes);
                    match (kind, self.pointer(value)) {
                        (Kind::RealIn, _) => real_text(value),
                        (_, Some(pointer)) if op == Op::Movd => pointer,
                        _ => (value as i32).to_string(),
                    }
                }
                (_, 2) => {
                    i16::from_be_bytes([memory.byte(offset), memory.byte(offset + 1)]).to_string()
                }
                _ => memory.byte(offset).to_string(),
            },
        }
    }

    /// A pointer to something in the plan, as a constant.
    fn pointer(&self, value: u32) -> Option<String> {
        let [code, high, ..] = value.to_be_bytes();
        if let Some(address) = analog(value).filter(|_| self.has_pointers) {
            return Some(format!("&{address}"));
        }
        let (area, offset) = (pointer::area(code)?, value as u16);
        // A pointer to what is planned says so; others are more likely numbers in a program that
        // follows none.
        let is_planned = matches!(area, Area::V | Area::T | Area::C)
            || area == Area::Sm && offset >= area.page_len();
        if !self.has_pointers && !is_planned {
            return None;
        }
        let plan = self.program.plan();
        let number = || u8::try_from(offset / 2).ok().filter(|_| offset.is_multiple_of(2));
        let address = match area {
            _ if high != 0 => return None,
            Area::T => Address::Timer(plan.timer_slot(number()?)?.number),
            Area::C => Address::Counter(plan.counter_slot(number()?)?.number),
            _ => {
                plan.byte_address(area, offset)?;
                Address::Byte { area, byte: offset }
            }
        };
        Some(format!("&{address}"))
    }
}

/// The analog input or output that a pointer leads to.
fn analog(value: u32) -> Option<Address> {
    let [code, 0, 0, offset] = value.to_be_bytes() else { return None };
    let channel = offset.is_multiple_of(2).then_some(offset / 2)?;
    match code {
        pointer::ANALOG_INPUT if u16::from(channel) < ANALOG_INPUTS => {
            Some(Address::Analog(AnalogInput::Scaled(channel)))
        }
        pointer::ANALOG_OUTPUT if channel < ANALOG_OUTPUTS => Some(Address::AnalogOutput(channel)),
        _ => None,
    }
}

fn is_indirect(operand: Operand) -> bool {
    let Operand::Reference(reference) = operand else { return false };
    matches!(reference.place(), Some(Referent::Indirect(_)))
}

/// Where the labels are that CSCRE goes to: the last one before the SCRE of such a segment.
fn segment_ends(code: &[(u16, u8, Decoded)]) -> BTreeSet<u16> {
    let (mut is_left, mut last_label) = (false, None);
    let mut ends = BTreeSet::new();
    for (at, _, decoded) in code {
        match decoded.op {
            Op::Lscr => is_left = false,
            Op::Cscre => is_left = true,
            Op::Lbl => last_label = Some(*at),
            Op::Scre if is_left => ends.extend(last_label),
            _ => {}
        }
    }
    ends
}

/// The copies of each call with parameters, in order.
fn calls(code: &[(u16, u8, Decoded)]) -> Vec<Vec<Copy>> {
    let mut calls: Vec<Vec<Copy>> = Vec::new();
    let mut end = 0;
    let mut has_called = false;
    for (at, _, decoded) in code {
        if decoded.op == Op::CallBegin {
            calls.push(Vec::new());
            (end, has_called) = (offset(decoded), false);
        } else if *at < end && decoded.op == Op::Call {
            has_called = true;
        } else if *at < end
            && let (Some(call), Some(copy)) = (calls.last_mut(), copy(decoded, has_called))
        {
            call.push(copy);
        }
    }
    calls
}

/// A real as a constant that reads back as the same bits.
fn real_text(bits: u32) -> String {
    format!("{:?}", f32::from_bits(bits))
}
