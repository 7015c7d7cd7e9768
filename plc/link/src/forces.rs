//! Forced operands: the table, and what it does to data memory.

use plc_isa::{Bit, I_START, Q_START, SM_START};
use plc_vm::Memory;

use crate::place::{BYTE, SizedAddress};
use crate::protocol::{FORCE_LEN, FORCES_MAX};

/// SM4.7: something is forced.
const SOMETHING_FORCED: Bit = Bit { address: SM_START + 4, bit: 7 };

/// An operand and its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Force {
    /// Reference (3) and value (4), as on the line.
    pub entry: [u8; FORCE_LEN as usize],
    pub place: SizedAddress,
}

impl Force {
    /// Writes the value to where the operand is.
    fn apply(&self, memory: &mut Memory) {
        let (address, size) = (self.place.address(), self.place.size());
        let [_, _, _, value @ ..] = self.entry;
        if size < BYTE {
            return memory.set_bit(Bit { address, bit: size }, value[3] & 1 != 0);
        }
        let unused = value.len() - usize::from(self.place.width());
        for (address, &byte) in (address..).zip(value.iter().skip(unused)) {
            memory.set_byte(address, byte);
        }
    }
}

/// What is forced.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Forces {
    count: u8,
    entries: [Force; FORCES_MAX as usize],
}

impl Forces {
    /// Nothing is forced.
    pub const NONE: Forces = Forces {
        count: 0,
        entries: [Force { entry: [0; FORCE_LEN as usize], place: SizedAddress::NONE };
            FORCES_MAX as usize],
    };

    /// Whether nothing is forced.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Gives forced operands their values. After the inputs were read, and again before outputs are
    /// written.
    pub fn apply(&self, memory: &mut Memory) {
        for force in self.entries() {
            force.apply(memory);
        }
    }

    /// Ends all forces. When RUN ends.
    pub fn clear(&mut self, memory: &mut Memory) {
        if self.is_empty() {
            return;
        }
        self.count = 0;
        memory.set_bit(SOMETHING_FORCED, false);
        release_inputs(memory);
    }

    /// The entries of the table.
    pub(crate) fn entries(&self) -> &[Force] {
        self.entries.get(..usize::from(self.count)).unwrap_or(&[])
    }

    /// The number of the entry for a place; the number of entries if there is none.
    fn position(&self, place: SizedAddress) -> usize {
        self.entries().iter().take_while(|force| force.place != place).count()
    }

    /// Forces an operand. Returns whether there is room for it.
    pub(crate) fn set(
        &mut self,
        entry: [u8; FORCE_LEN as usize],
        place: SizedAddress,
        memory: &mut Memory,
    ) -> bool {
        let at = self.position(place);
        let Some(force) = self.entries.get_mut(at) else { return false };
        *force = Force { entry, place };
        if at == usize::from(self.count) {
            self.count += 1;
        }
        memory.set_bit(SOMETHING_FORCED, true);
        true
    }

    /// Ends the force on an operand, if there is one. The last entry takes its place.
    pub(crate) fn unset(&mut self, place: SizedAddress, memory: &mut Memory) {
        let at = self.position(place);
        let Some(last) = self.entries().last().copied().filter(|_| at < self.entries().len())
        else {
            return;
        };
        if let Some(force) = self.entries.get_mut(at) {
            *force = last;
        }
        self.count -= 1;
        if self.count == 0 {
            self.clear(memory);
        } else {
            release_inputs(memory);
        }
    }
}

/// IB1 to IB15 are 0 again: nothing but a force and the program writes inputs that the board does
/// not have.
fn release_inputs(memory: &mut Memory) {
    for address in I_START + 1..Q_START {
        memory.set_byte(address, 0);
    }
}
