//! Counters CTU, CTD and CTUD (docs/s7-200.md 2.4).

use plc_isa::{Bit, CounterSlot, LogicStack, counter_bit};

use crate::edge::rose;
use crate::memory::Memory;

const UP: u8 = 0;
const DOWN: u8 = 1;

/// A counter while its instruction executes.
pub(crate) struct Counter<'m> {
    pub memory: &'m mut Memory,
    pub slot: CounterSlot,
    pub first_scan: bool,
}

impl Counter<'_> {
    fn edge(&mut self, input: u8, now: bool) -> bool {
        let place = Bit { address: self.slot.address + 2, bit: input };
        rose(self.memory, place, now, self.first_scan)
    }

    fn write(&mut self, current: i16, bit: bool) {
        self.memory.set_int(self.slot.address, current);
        self.memory.set_bit(counter_bit(self.slot.number), bit);
    }

    fn current(&self) -> i16 {
        self.memory.int(self.slot.address)
    }

    /// CTU: S1 counts up, S0 resets.
    pub fn up(&mut self, stack: LogicStack, preset: i16) {
        let counts = self.edge(UP, stack.level(1));
        if stack.top() {
            return self.write(0, false);
        }
        let current = self.current().saturating_add(i16::from(counts));
        self.write(current, current >= preset);
    }

    /// CTD: S1 counts down, S0 loads the preset.
    pub fn down(&mut self, stack: LogicStack, preset: i16) {
        let counts = self.edge(DOWN, stack.level(1));
        if stack.top() {
            return self.write(preset, false);
        }
        let before = self.current();
        let current = if counts && before > 0 { before - 1 } else { before };
        self.write(current, current <= 0);
    }

    /// CTUD: S2 counts up, S1 counts down, S0 resets. Wraps around at both ends.
    pub fn up_down(&mut self, stack: LogicStack, preset: i16) {
        let up = self.edge(UP, stack.level(2));
        let down = self.edge(DOWN, stack.level(1));
        if stack.top() {
            return self.write(0, false);
        }
        let current = self.current().wrapping_add(i16::from(up)).wrapping_sub(i16::from(down));
        self.write(current, current >= preset);
    }
}

/// R: bit and current value become 0; the edge memories stay.
pub(crate) fn reset(memory: &mut Memory, slot: CounterSlot) {
    memory.set_int(slot.address, 0);
    memory.set_bit(counter_bit(slot.number), false);
}
