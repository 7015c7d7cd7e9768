//! What the operands of module instructions lead to: memory, at once or by a pointer, and
//! constants. Nothing is read or written that the program's memory plan does not hold.

use plc_isa::{
    AIW_START, ANALOG_INPUTS, ANALOG_OUTPUTS, AQW_START, AnalogInput, Area, ProgramMemory,
    Referent, Region, pointer,
};

use crate::environment::Environment;
use crate::modules::execution::{Execution, Failure};

/// How long a value is, and which numbers it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Width {
    /// 8 bits, 0 to 255.
    Byte,
    /// 16 bits with a sign.
    Word,
    /// 32 bits with a sign, or a real.
    Double,
}

impl Width {
    /// Bytes.
    pub const fn len(self) -> u16 {
        match self {
            Width::Byte => 1,
            Width::Word => 2,
            Width::Double => 4,
        }
    }

    /// Bits.
    pub const fn bits(self) -> u32 {
        8 * self.len() as u32
    }

    /// The number in the lowest bits of another.
    pub const fn wrapped(self, value: i64) -> i64 {
        match self {
            Width::Byte => value as u8 as i64,
            Width::Word => value as i16 as i64,
            Width::Double => value as i32 as i64,
        }
    }

    /// Whether a number fits.
    pub const fn holds(self, value: i64) -> bool {
        self.wrapped(value) == value
    }

    /// The bits of a value without its sign.
    pub const fn pattern(self, value: i64) -> u64 {
        value as u64 & ((1 << self.bits()) - 1)
    }
}

/// Most characters of a string.
const TEXT_MAX: usize = 254;

/// A string.
pub(crate) struct Text {
    bytes: [u8; TEXT_MAX],
    len: usize,
}

impl Text {
    pub const EMPTY: Text = Text { bytes: [0; TEXT_MAX], len: 0 };

    /// The characters.
    pub fn characters(&self) -> &[u8] {
        self.bytes.get(..self.len).unwrap_or(&[])
    }

    /// Appends a character; more than a string can have are illegal.
    pub fn push(&mut self, character: u8) -> Result<(), Failure> {
        *self.bytes.get_mut(self.len).ok_or(Failure::Operand)? = character;
        self.len += 1;
        Ok(())
    }

    /// Appends characters; more than a string can have are illegal.
    pub fn append(&mut self, characters: &[u8]) -> Result<(), Failure> {
        let end = self.len + characters.len();
        let place = self.bytes.get_mut(self.len..end).ok_or(Failure::Operand)?;
        place.copy_from_slice(characters);
        self.len = end;
        Ok(())
    }
}

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    /// The value of operand `index`.
    pub fn read(&self, index: usize, width: Width) -> Result<i64, Failure> {
        match self.operands.reference(index).place() {
            Some(Referent::Constant(value)) => Ok(width.wrapped(i64::from(value))),
            Some(Referent::Pool(offset)) => {
                let byte = |at: u16| self.interpreter.program.memory().byte(offset + at);
                Ok(big_endian(width, byte))
            }
            _ => Ok(self.get(self.source(index, width, 1)?, width)),
        }
    }

    /// The value of a real operand.
    pub fn read_real(&self, index: usize) -> Result<f32, Failure> {
        Ok(f32::from_bits(self.read(index, Width::Double)? as u32))
    }

    /// The string of operand `index`.
    pub fn read_text(&self, index: usize) -> Result<Text, Failure> {
        let mut text = Text::EMPTY;
        if let Some(Referent::Pool(offset)) = self.operands.reference(index).place() {
            let image = self.interpreter.program.memory();
            let len = u16::from(image.byte(offset));
            (1..=len).try_for_each(|at| text.push(image.byte(offset + at)))?;
        } else {
            let address = self.source(index, Width::Byte, 1)?;
            let len = u16::from(self.interpreter.memory.byte(address));
            self.source(index, Width::Byte, 1 + len)?;
            let characters = self.interpreter.memory.part(address + 1, len);
            text.append(characters.ok_or(Failure::Operand)?)?;
        }
        Ok(text)
    }

    /// Writes a string to operand `index`.
    pub fn write_text(&mut self, index: usize, characters: &[u8]) -> Result<(), Failure> {
        let len = u8::try_from(characters.len()).ok().filter(|&len| usize::from(len) <= TEXT_MAX);
        let len = len.ok_or(Failure::Operand)?;
        let address = self.target(index, Width::Byte, 1 + u16::from(len))?;
        self.interpreter.memory.set_byte(address, len);
        self.put_bytes(address + 1, characters);
        Ok(())
    }

    /// The address of `count` values that operand `index` lets read; of one when the count is 0.
    pub fn source(&self, index: usize, width: Width, count: u16) -> Result<u16, Failure> {
        self.address(index, width, count, Region::is_readable)
    }

    /// The address of `count` values that operand `index` lets write; of one when the count is 0.
    pub fn target(&self, index: usize, width: Width, count: u16) -> Result<u16, Failure> {
        self.address(index, width, count, Region::is_writable)
    }

    fn address(
        &self,
        index: usize,
        width: Width,
        count: u16,
        may: fn(Region) -> bool,
    ) -> Result<u16, Failure> {
        let address = match self.operands.reference(index).place() {
            Some(Referent::Direct(address)) => Some(address),
            Some(Referent::Indirect(address)) => {
                self.pointed(self.get(address, Width::Double) as u32)
            }
            _ => None,
        };
        let address = address.ok_or(Failure::Operand)?;
        let region = self.interpreter.program.plan().region(address).ok_or(Failure::Operand)?;
        let fits = region.holds_value(width.len()) && width.len() * count.max(1) <= room(region);
        if fits && may(region) { Ok(address) } else { Err(Failure::Operand) }
    }

    /// The data address that a pointer leads to.
    fn pointed(&self, value: u32) -> Option<u16> {
        const INPUTS: u16 = 2 * ANALOG_INPUTS;
        const OUTPUTS: u16 = 2 * ANALOG_OUTPUTS as u16;
        let (code, offset) = ((value >> 24) as u8, u16::try_from(value & 0xFF_FFFF).ok()?);
        let plan = self.interpreter.program.plan();
        match (code, offset) {
            (pointer::ANALOG_INPUT, 0..INPUTS) => Some(AIW_START + offset),
            (pointer::ANALOG_OUTPUT, 0..OUTPUTS) => Some(AQW_START + offset),
            _ => match (pointer::area(code)?, u8::try_from(offset / 2)) {
                (Area::T, Ok(number)) if offset.is_multiple_of(2) => {
                    plan.timer_slot(number).map(|slot| slot.address)
                }
                (Area::C, Ok(number)) if offset.is_multiple_of(2) => {
                    plan.counter_slot(number).map(|slot| slot.address)
                }
                (area, _) => plan.byte_address(area, offset),
            },
        }
    }

    /// The value at a data address.
    pub fn get(&self, address: u16, width: Width) -> i64 {
        big_endian(width, |at| self.interpreter.memory.byte(address + at))
    }

    /// Writes a value to a data address.
    pub fn put(&mut self, address: u16, width: Width, value: i64) {
        let bytes = (value as u32).to_be_bytes();
        self.put_bytes(address, bytes.get(4 - usize::from(width.len())..).unwrap_or(&[]));
    }

    /// Writes bytes to a data address.
    pub fn put_bytes(&mut self, address: u16, bytes: &[u8]) {
        for (address, &byte) in (address..).zip(bytes) {
            self.interpreter.memory.set_byte(address, byte);
        }
    }
}

fn big_endian(width: Width, byte: impl Fn(u16) -> u8) -> i64 {
    width.wrapped((0..width.len()).fold(0, |value, at| value << 8 | i64::from(byte(at))))
}

/// Bytes from the beginning of a region that values can follow one another in.
fn room(region: Region) -> u16 {
    match region {
        Region::Byte { room, .. } | Region::Accumulator { room, .. } => room,
        Region::Analog(AnalogInput::Scaled(channel) | AnalogInput::Raw(channel)) => {
            2 * (ANALOG_INPUTS - u16::from(channel))
        }
        Region::AnalogOutput(channel) => 2 * u16::from(ANALOG_OUTPUTS - channel),
        Region::TimerValue(_) | Region::CounterValue(_) => 2,
        Region::HighSpeedCounter(_) => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::{Text, Width};

    #[test]
    fn widths_hold_their_numbers() {
        for (width, least, most) in [
            (Width::Byte, 0, 255),
            (Width::Word, i64::from(i16::MIN), i64::from(i16::MAX)),
            (Width::Double, i64::from(i32::MIN), i64::from(i32::MAX)),
        ] {
            assert!(
                width.holds(least)
                    && width.holds(most)
                    && !width.holds(least - 1)
                    && !width.holds(most + 1)
            );
            assert_eq!((width.wrapped(most + 1), width.wrapped(least - 1)), (least, most));
        }
        assert_eq!((Width::Word.pattern(-1), Width::Double.pattern(-2)), (0xFFFF, 0xFFFF_FFFE));
    }

    #[test]
    fn a_text_has_at_most_254_characters() {
        let mut text = Text::EMPTY;
        for _ in 0..254 {
            assert!(text.push(b'a').is_ok());
        }
        assert!(text.push(b'a').is_err());
        assert_eq!(text.characters(), [b'a'; 254]);
    }
}
