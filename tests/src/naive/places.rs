//! Where the operands of boxes lie, pointers followed: reading and writing of bytes, words, double
//! words and blocks.

use std::ops::Range;

use awl_asm::Address;
use awl_asm::ast::{Operand, Value};
use plc_isa::{AnalogInput, Area};

use super::Naive;

/// What went wrong in a box: it is not executed, its ENO is 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Trouble {
    /// An operand that is impossible: SM4.3 says so.
    Operand,
    /// A result that is impossible: a bit of SMB1 says so.
    Result,
}

/// What there is of memory that pointers lead to.
#[derive(Debug, Clone)]
pub struct Extents {
    /// V memory.
    pub v: Vec<Range<u16>>,
    /// Special memory from SMB32 on.
    pub sm: Vec<Range<u16>>,
    /// Timers with a current value.
    pub timers: Vec<u8>,
    /// Counters with a current value.
    pub counters: Vec<u8>,
}

impl Extents {
    /// Everything that can be named.
    pub(super) fn all() -> Extents {
        let numbers: Vec<u8> = (0..=255).collect();
        let one = |range: Range<u16>| vec![range];
        Extents {
            v: one(0..Area::V.size()),
            sm: one(32..Area::Sm.size()),
            timers: numbers.clone(),
            counters: numbers,
        }
    }
}

/// Where a value lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ValuePlace {
    Bytes(Area, u16),
    Timer(u8),
    Counter(u8),
    Analog(AnalogInput),
    /// An analog output, written only.
    Output,
    Accumulator(u8),
    /// A high-speed counter: 0 here.
    HighSpeed,
}

/// What a box wants of an operand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Want {
    /// Bytes of a value: 1, 2 or 4.
    pub(super) width: u8,
    /// How many values.
    pub(super) count: u16,
    pub(super) is_written: bool,
}

impl Want {
    pub(super) fn read(width: u8) -> Want {
        Want { width, count: 1, is_written: false }
    }

    pub(super) fn written(width: u8) -> Want {
        Want { width, count: 1, is_written: true }
    }

    pub(super) fn of(self, count: u16) -> Want {
        Want { count: count.max(1), ..self }
    }

    fn len(self) -> u32 {
        u32::from(self.width) * u32::from(self.count)
    }
}

/// Places.
impl Naive {
    /// Where an operand lies, if as much is there as is wanted.
    pub(super) fn place(&self, operand: &Operand, want: Want) -> Result<ValuePlace, Trouble> {
        let place = match &operand.value {
            Value::Address(address) => direct(*address),
            Value::Indirect(holder) => {
                self.pointed(self.pointer(*holder)).ok_or(Trouble::Operand)?
            }
            other => panic!("{other:?} is no place"),
        };
        if self.is_there(place, want) { Ok(place) } else { Err(Trouble::Operand) }
    }

    fn pointer(&self, holder: Address) -> u32 {
        self.value_at(direct(holder), 4)
    }

    /// What a pointer leads to, whatever is there.
    fn pointed(&self, pointer: u32) -> Option<ValuePlace> {
        let offset = u16::try_from(pointer & 0x00FF_FFFF).ok()?;
        let numbered = || (offset % 2 == 0).then_some(offset / 2);
        let area = match pointer >> 24 {
            0x00 => Area::I,
            0x01 => Area::Q,
            0x05 => Area::M,
            0x06 => Area::Sm,
            0x07 => Area::S,
            0x08 => Area::V,
            0x02 => {
                return Some(ValuePlace::Analog(AnalogInput::Scaled(
                    u8::try_from(numbered()?).ok()?,
                )));
            }
            0x03 => return numbered().filter(|&number| number < 2).map(|_| ValuePlace::Output),
            0x09 => return u8::try_from(numbered()?).ok().map(ValuePlace::Timer),
            0x0A => return u8::try_from(numbered()?).ok().map(ValuePlace::Counter),
            _ => return None,
        };
        Some(ValuePlace::Bytes(area, offset))
    }

    fn is_there(&self, place: ValuePlace, want: Want) -> bool {
        let is_word = want.width == 2 && want.count == 1;
        match place {
            ValuePlace::Bytes(area, first) => {
                let end = u32::from(first) + want.len();
                let holds =
                    |range: &Range<u16>| range.contains(&first) && end <= u32::from(range.end);
                let is_whole = match area {
                    Area::V => self.extents.v.iter().any(holds),
                    Area::Sm => holds(&(0..32)) || self.extents.sm.iter().any(holds),
                    _ => holds(&(0..area.size())),
                };
                is_whole && !(want.is_written && first < area.first_writable())
            }
            ValuePlace::Timer(number) => is_word && self.extents.timers.contains(&number),
            ValuePlace::Counter(number) => is_word && self.extents.counters.contains(&number),
            ValuePlace::Analog(AnalogInput::Scaled(channel) | AnalogInput::Raw(channel)) => {
                want.width == 2 && !want.is_written && u16::from(channel) + want.count <= 6
            }
            ValuePlace::Output => is_word && want.is_written,
            ValuePlace::Accumulator(_) => want.count == 1,
            ValuePlace::HighSpeed => want.width == 4 && want.count == 1 && !want.is_written,
        }
    }

    /// The value at a place, zeros above it.
    pub(super) fn value_at(&self, place: ValuePlace, width: u8) -> u32 {
        match place {
            ValuePlace::Bytes(area, first) => (first..first + u16::from(width))
                .fold(0, |value, byte| value << 8 | u32::from(self.byte(area, byte))),
            ValuePlace::Timer(number) => u32::from(self.timer(number).current as u16),
            ValuePlace::Counter(number) => u32::from(self.counter(number).current as u16),
            ValuePlace::Analog(AnalogInput::Scaled(channel)) => {
                u32::from(self.inputs.aiw[usize::from(channel)])
            }
            ValuePlace::Analog(AnalogInput::Raw(channel)) => {
                u32::from(self.inputs.ain[usize::from(channel)])
            }
            ValuePlace::Output | ValuePlace::HighSpeed => 0,
            ValuePlace::Accumulator(number) => self.accumulators[usize::from(number)] & mask(width),
        }
    }

    pub(super) fn set_value_at(&mut self, place: ValuePlace, width: u8, value: u32) {
        match place {
            ValuePlace::Bytes(area, first) => {
                let bytes = &value.to_be_bytes()[usize::from(4 - width)..];
                self.area(area)[usize::from(first)..][..bytes.len()].copy_from_slice(bytes);
            }
            ValuePlace::Timer(number) => self.timers[usize::from(number)].current = value as i16,
            ValuePlace::Counter(number) => {
                self.counters[usize::from(number)].current = value as i16
            }
            ValuePlace::Accumulator(number) => {
                let accumulator = &mut self.accumulators[usize::from(number)];
                *accumulator = *accumulator & !mask(width) | value & mask(width);
            }
            ValuePlace::Analog(_) | ValuePlace::Output | ValuePlace::HighSpeed => {}
        }
    }

    /// The place `number` values after another.
    pub(super) fn behind(place: ValuePlace, width: u8, number: u16) -> ValuePlace {
        match place {
            ValuePlace::Bytes(area, first) => {
                ValuePlace::Bytes(area, first + u16::from(width) * number)
            }
            ValuePlace::Analog(AnalogInput::Scaled(channel)) => {
                ValuePlace::Analog(AnalogInput::Scaled(channel + number as u8))
            }
            ValuePlace::Analog(AnalogInput::Raw(channel)) => {
                ValuePlace::Analog(AnalogInput::Raw(channel + number as u8))
            }
            other => other,
        }
    }

    /// The value of an operand: a constant, a pointer, or what lies there; zeros above it.
    pub(super) fn read(&self, operand: &Operand, width: u8) -> Result<u32, Trouble> {
        match &operand.value {
            Value::Constant(constant) => Ok(constant.value as u32 & mask(width)),
            Value::Real(bits) => Ok(*bits),
            Value::AddressOf(address) => Ok(pointer_to(*address)),
            _ => Ok(self.value_at(self.place(operand, Want::read(width))?, width)),
        }
    }

    /// The same with the sign of a word or double word.
    pub(super) fn read_signed(&self, operand: &Operand, width: u8) -> Result<i64, Trouble> {
        let value = self.read(operand, width)?;
        Ok(match width {
            2 => i64::from(value as i16),
            4 => i64::from(value as i32),
            _ => i64::from(value),
        })
    }

    pub(super) fn write(
        &mut self,
        operand: &Operand,
        width: u8,
        value: u32,
    ) -> Result<(), Trouble> {
        let place = self.place(operand, Want::written(width))?;
        self.set_value_at(place, width, value);
        Ok(())
    }
}

fn direct(address: Address) -> ValuePlace {
    match address {
        Address::Bit { area, byte, .. }
        | Address::Byte { area, byte }
        | Address::Word { area, byte }
        | Address::Double { area, byte } => ValuePlace::Bytes(area, byte),
        Address::Timer(number) => ValuePlace::Timer(number),
        Address::Counter(number) => ValuePlace::Counter(number),
        Address::Analog(input) => ValuePlace::Analog(input),
        Address::AnalogOutput(_) => ValuePlace::Output,
        Address::Accumulator(number) => ValuePlace::Accumulator(number),
        Address::HighSpeedCounter(_) => ValuePlace::HighSpeed,
    }
}

fn pointer_to(address: Address) -> u32 {
    let (code, offset) = match direct(address) {
        ValuePlace::Bytes(Area::I, byte) => (0x00, byte),
        ValuePlace::Bytes(Area::Q, byte) => (0x01, byte),
        ValuePlace::Bytes(Area::M, byte) => (0x05, byte),
        ValuePlace::Bytes(Area::Sm, byte) => (0x06, byte),
        ValuePlace::Bytes(Area::S, byte) => (0x07, byte),
        ValuePlace::Bytes(Area::V, byte) => (0x08, byte),
        ValuePlace::Analog(AnalogInput::Scaled(channel)) => (0x02, 2 * u16::from(channel)),
        ValuePlace::Timer(number) => (0x09, 2 * u16::from(number)),
        ValuePlace::Counter(number) => (0x0A, 2 * u16::from(number)),
        other => panic!("no pointer leads to {other:?}"),
    };
    code << 24 | u32::from(offset)
}

fn mask(width: u8) -> u32 {
    u32::MAX >> (8 * (4 - u32::from(width)))
}
