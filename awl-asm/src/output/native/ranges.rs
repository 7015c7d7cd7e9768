//! S and R: bits, ranges of bits, timers and counters, all with power flow only.

use plc_isa::{Bit, Decoded, counter_bit, timer_bit};

use super::avr::{Constant, OfBit, Reg, Two};
use super::emitter::{Emitter, TEMP, ZERO};
use super::translate::Translator;

/// Longer ranges are left to the firmware.
const INLINE_BYTES_MAX: usize = 8;
/// The same for timers and counters that are reset.
const INLINE_SLOTS_MAX: usize = 4;

/// The bytes of a range of bits, each with the mask of its bits.
fn masks(first: Bit, count: u16) -> Vec<(u16, u8)> {
    let mut masks: Vec<(u16, u8)> = Vec::new();
    for number in u16::from(first.bit)..u16::from(first.bit) + count {
        let (address, bit) = (first.address + number / 8, 1 << (number % 8));
        match masks.last_mut() {
            Some((last, mask)) if *last == address => *mask |= bit,
            _ => masks.push((address, bit)),
        }
    }
    masks
}

impl Translator<'_> {
    /// S and R with a constant count.
    pub(super) fn bits(&mut self, decoded: &Decoded, first: Bit, count: u16, value: bool) {
        let masks = masks(first, count);
        if masks.len() > INLINE_BYTES_MAX {
            return self.by_bytecode(decoded);
        }
        match self.emitter.registers.pin(first.address) {
            // A bit that is 0 becomes the power flow: shorter than to ask for that.
            Some(pin) if value && count == 1 && self.emitter.power_flow.is_none() => {
                self.emitter.bit(OfBit::Sbrs, pin, first.bit);
                self.emitter.bit(OfBit::Bld, pin, first.bit);
                self.emitter.registers.changed(first.address);
            }
            _ => self.emitter.with_power_flow(|emitter| {
                for &(address, mask) in &masks {
                    emitter.write_bits(address, mask, value);
                }
            }),
        }
    }

    /// R of timers: value and state.
    pub(super) fn reset_timers(&mut self, decoded: &Decoded, first: u8, count: u16) {
        let slots = self.emitter.plan.timers().map(|slot| (slot.number, slot.address));
        let slots = slots_in(slots, first, count);
        self.reset_slots(decoded, masks(timer_bit(first), count), &slots, &[0, 1, 4]);
    }

    /// R of counters: the value; the state remembers edges.
    pub(super) fn reset_counters(&mut self, decoded: &Decoded, first: u8, count: u16) {
        let slots = self.emitter.plan.counters().map(|slot| (slot.number, slot.address));
        let slots = slots_in(slots, first, count);
        self.reset_slots(decoded, masks(counter_bit(first), count), &slots, &[0, 1]);
    }

    /// Resets bits, and these bytes of slots.
    fn reset_slots(
        &mut self,
        decoded: &Decoded,
        masks: Vec<(u16, u8)>,
        slots: &[u16],
        bytes: &[u16],
    ) {
        if masks.len() > INLINE_BYTES_MAX || slots.len() > INLINE_SLOTS_MAX {
            return self.by_bytecode(decoded);
        }
        self.emitter.with_power_flow(|emitter| {
            for &(address, mask) in &masks {
                emitter.write_bits(address, mask, false);
            }
            for slot in slots {
                bytes.iter().for_each(|byte| emitter.write(slot + byte, ZERO));
            }
        });
    }
}

/// Addresses of the slots with these numbers.
fn slots_in(slots: impl Iterator<Item = (u8, u16)>, first: u8, count: u16) -> Vec<u16> {
    let numbers = u16::from(first)..u16::from(first) + count;
    slots
        .filter(|(number, _)| numbers.contains(&u16::from(*number)))
        .map(|(_, address)| address)
        .collect()
}

impl Emitter<'_> {
    /// Sets the bits of a mask, where T is 1, or resets them.
    pub(super) fn write_bits(&mut self, address: u16, mask: u8, value: bool) {
        if mask == u8::MAX {
            let filler = self.value_in(if value { u8::MAX } else { 0 }, TEMP);
            return self.write(address, filler);
        }
        let register = self.byte_for(address, true);
        self.mask_register(register, mask, value);
        self.changed(address, register);
    }

    fn mask_register(&mut self, register: Reg, mask: u8, value: bool) {
        let (with_constant, with_register, operand) = match value {
            true => (Constant::Ori, Two::Or, mask),
            false => (Constant::Andi, Two::And, !mask),
        };
        if value && mask.is_power_of_two() {
            self.bit(OfBit::Bld, register, mask.trailing_zeros() as u8);
        } else if register.takes_constants() {
            self.constant(with_constant, register, operand);
        } else {
            self.constant(Constant::Ldi, TEMP, operand);
            self.two(with_register, register, TEMP);
        }
    }
}
