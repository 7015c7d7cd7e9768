//! Memory by address, and operands: what a program reads and writes.

use awl_asm::Address;
use awl_asm::ast::{Constant, Operand, Value};
use plc_isa::Area;

use super::Naive;

/// Memory by address.
impl Naive {
    pub(super) fn area(&mut self, area: Area) -> &mut Vec<u8> {
        self.memory.get_mut(&area).unwrap_or_else(|| panic!("{} has no bytes", area.name()))
    }

    pub(super) fn set_bit(&mut self, area: Area, byte: u16, bit: u8, value: bool) {
        let byte = &mut self.area(area)[usize::from(byte)];
        if value {
            *byte |= 1 << bit;
        } else {
            *byte &= !(1 << bit);
        }
    }

    pub(super) fn set_word(&mut self, area: Area, byte: u16, value: i16) {
        let [high, low] = value.to_be_bytes();
        self.set_byte(area, byte, high);
        self.set_byte(area, byte + 1, low);
    }

    pub(super) fn bit_operand(&self, operand: &Operand) -> bool {
        match address(operand) {
            Address::Bit { area, byte, bit } => self.bit(area, byte, bit),
            Address::Timer(number) => self.timer(number).bit,
            Address::Counter(number) => self.counter(number).bit,
            other => panic!("{other} is no bit"),
        }
    }

    pub(super) fn write_bit_operand(&mut self, operand: &Operand, value: bool) {
        match address(operand) {
            Address::Bit { area, byte, bit } => self.set_bit(area, byte, bit, value),
            Address::Timer(number) => self.timers[usize::from(number)].bit = value,
            Address::Counter(number) => self.counters[usize::from(number)].bit = value,
            other => panic!("{other} is no bit"),
        }
    }

    /// A word whose place is certain.
    pub(super) fn word_operand(&self, operand: &Operand) -> i16 {
        match self.read(operand, 2) {
            Ok(value) => value as i16,
            Err(_) => panic!("{:?} is no word", operand.value),
        }
    }

    pub(super) fn write_word_operand(&mut self, operand: &Operand, value: i16) {
        if self.write(operand, 2, u32::from(value as u16)).is_err() {
            panic!("{:?} is no word that can be written", operand.value);
        }
    }
}

pub(super) fn address(operand: &Operand) -> Address {
    match operand.value {
        Value::Address(address) => address,
        _ => panic!("an address is needed, found {:?}", operand.value),
    }
}

pub(super) fn number(operand: &Operand) -> i64 {
    match operand.value {
        Value::Constant(Constant { value, .. }) => value,
        _ => panic!("a number is needed, found {:?}", operand.value),
    }
}

pub(super) fn timer_number(operand: &Operand) -> u8 {
    match address(operand) {
        Address::Timer(number) => number,
        other => panic!("{other} is no timer"),
    }
}

pub(super) fn counter_number(operand: &Operand) -> u8 {
    match address(operand) {
        Address::Counter(number) => number,
        other => panic!("{other} is no counter"),
    }
}
