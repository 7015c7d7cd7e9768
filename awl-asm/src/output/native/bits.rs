//! Contacts, coils, edges and the logic stack.

use plc_isa::{Bit, SM_START};

use super::avr::{Avr, OfBit, Two};
use super::emitter::{SCRATCH, TEMP};
use super::translate::{STACK, Translator};

/// SM0.0, which is always on.
pub const ALWAYS_ON: Bit = Bit { address: SM_START, bit: 0 };
/// SM0.1, on in the first scan.
const FIRST_SCAN: Bit = Bit { address: SM_START, bit: 1 };

/// What becomes of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combine {
    /// It is pushed onto the stack.
    Load,
    /// It is combined with the top by AND.
    And,
    /// It is combined with the top by OR.
    Or,
}

impl Translator<'_> {
    /// A contact: closed when the bit is `wanted`.
    pub(super) fn contact(&mut self, combine: Combine, bit: Bit, wanted: bool) {
        if bit == ALWAYS_ON {
            return self.constant_value(combine, wanted);
        }
        if combine == Combine::Load {
            self.push();
        }
        let register = self.emitter.byte(bit.address);
        self.register_bit(combine, (register, bit.bit), wanted);
    }

    /// The same for a bit in a register, when the stack is ready for it.
    pub(super) fn register_bit(
        &mut self,
        combine: Combine,
        (register, bit): (super::avr::Reg, u8),
        wanted: bool,
    ) {
        let emitter = &mut self.emitter;
        match combine {
            Combine::Load if wanted => emitter.bit(OfBit::Bst, register, bit),
            Combine::Load => {
                emitter.set_top(true);
                emitter.set_top_if(register, bit, true, false);
            }
            Combine::And => emitter.set_top_if(register, bit, !wanted, false),
            Combine::Or => emitter.set_top_if(register, bit, wanted, true),
        }
    }

    /// A value that is known.
    pub(super) fn constant_value(&mut self, combine: Combine, value: bool) {
        match combine {
            Combine::Load => {
                self.push();
                self.emitter.set_top(value);
            }
            Combine::And if !value => self.emitter.set_top(false),
            Combine::Or if value => self.emitter.set_top(true),
            _ => {}
        }
    }

    /// A coil.
    pub(super) fn assign(&mut self, bit: Bit) {
        let register = self.emitter.byte(bit.address);
        self.emitter.bit(OfBit::Bld, register, bit.bit);
        self.emitter.changed(bit.address, register);
    }

    pub(super) fn not(&mut self) {
        self.emitter.bit(OfBit::Bld, SCRATCH, 0);
        self.emitter.code.op(Avr::Com(SCRATCH));
        self.emitter.bit(OfBit::Bst, SCRATCH, 0);
    }

    /// EU and ED: the memory is written in any case; in the first scan there is no edge.
    pub(super) fn edge(&mut self, edge: u8, rising: bool) {
        let emitter = &mut self.emitter;
        let place = emitter.plan.edge(edge);
        let register = emitter.byte(place.address);
        emitter.two(Two::Mov, SCRATCH, register);
        emitter.bit(OfBit::Bld, register, place.bit);
        emitter.changed(place.address, register);
        if rising {
            emitter.set_top_if(SCRATCH, place.bit, true, false);
        } else {
            emitter.bit(OfBit::Bst, SCRATCH, place.bit);
            emitter.set_top_if(register, place.bit, true, false);
        }
        let system = emitter.byte(FIRST_SCAN.address);
        emitter.set_top_if(system, FIRST_SCAN.bit, true, false);
    }

    pub(super) fn and_load(&mut self) {
        let bit = self.pop();
        self.emitter.set_top_if(STACK, bit, false, false);
    }

    pub(super) fn or_load(&mut self) {
        let bit = self.pop();
        self.emitter.set_top_if(STACK, bit, true, true);
    }

    pub(super) fn logic_read(&mut self) {
        let bit = self.level(1);
        self.emitter.bit(OfBit::Bst, STACK, bit);
    }

    pub(super) fn logic_pop(&mut self) {
        let bit = self.pop();
        self.emitter.bit(OfBit::Bst, STACK, bit);
    }

    /// LDS: level 8 is in the bit that the value on top is pushed to.
    pub(super) fn load_stack(&mut self, level: u8) {
        if level == 0 {
            return self.push();
        }
        let from = self.level(level);
        if level < 8 || !self.is_needed() {
            self.push();
            return self.emitter.bit(OfBit::Bst, STACK, from);
        }
        self.emitter.two(Two::Mov, TEMP, STACK);
        self.push();
        self.emitter.bit(OfBit::Bst, TEMP, from);
    }
}
