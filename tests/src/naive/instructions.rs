//! Contacts, stack operations, comparisons and coils.

use std::cmp::Ordering;

use awl_asm::Address;
use awl_asm::ast::{Instruction, Operand};
use plc_isa::Relation;

use super::boxes::width;
use super::memory::{address, number};
use super::places::Trouble;
use super::{Fault, Naive};

/// The logic stack.
impl Naive {
    pub(super) fn push(&mut self, value: bool) {
        for level in (1..9).rev() {
            self.stack[level] = self.stack[level - 1];
        }
        self.stack[0] = value;
    }

    fn pop(&mut self) -> bool {
        let top = self.stack[0];
        for level in 0..8 {
            self.stack[level] = self.stack[level + 1];
        }
        self.stack[8] = false;
        top
    }
}

/// Contacts, stack, comparisons, coils and boxes.
impl Naive {
    pub(super) fn contact(&mut self, at: usize, instruction: &Instruction) {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            "LD" | "LDI" => self.push(self.powered(self.contact_bit(instruction))),
            "LDN" | "LDNI" => self.push(self.powered(!self.contact_bit(instruction))),
            "A" | "AI" => self.stack[0] = self.stack[0] && self.contact_bit(instruction),
            "AN" | "ANI" => self.stack[0] = self.stack[0] && !self.contact_bit(instruction),
            "O" | "OI" => {
                self.stack[0] = self.stack[0] || self.powered(self.contact_bit(instruction))
            }
            "ON" | "ONI" => {
                self.stack[0] = self.stack[0] || self.powered(!self.contact_bit(instruction))
            }
            // In this model the process image of the outputs is their points.
            "=" | "=I" => self.write_bit_operand(&operands[0], self.stack[0]),
            "NOT" => self.stack[0] = !self.stack[0],
            "AENO" => self.stack[0] = self.stack[0] && self.eno,
            "EU" | "ED" => {
                let before = self.edges.insert((self.unit, at), self.stack[0]).unwrap_or(false);
                let edge = if instruction.mnemonic() == "EU" {
                    !before && self.stack[0]
                } else {
                    before && !self.stack[0]
                };
                self.stack[0] = edge && !self.first_scan;
            }
            _ => {}
        }
    }

    /// The bit that a contact asks for: with an I at the end of its name, the input itself.
    fn contact_bit(&self, instruction: &Instruction) -> bool {
        let operand = &instruction.operands[0];
        match instruction.mnemonic().ends_with('I') {
            true => self.input_point(operand),
            false => self.bit_operand(operand),
        }
    }

    pub(super) fn stack_operation(&mut self, instruction: &Instruction) {
        match instruction.mnemonic() {
            "ALD" => {
                let top = self.pop();
                self.stack[0] = self.stack[0] && top;
            }
            "OLD" => {
                let top = self.pop();
                self.stack[0] = self.stack[0] || top;
            }
            "LPS" => self.push(self.stack[0]),
            "LRD" => self.stack[0] = self.stack[1],
            "LPP" => {
                self.pop();
            }
            _ => {
                let level = number(&instruction.operands[0]) as usize;
                self.push(self.stack[level]);
            }
        }
    }

    /// A comparison. The fault is one of its operands'.
    pub(super) fn compare(&mut self, instruction: &Instruction) -> Result<(), Fault> {
        let [first, second] = &instruction.operands[..] else {
            panic!("a comparison has two operands")
        };
        let mnemonic = instruction.mnemonic();
        let order = match mnemonic.chars().last() {
            Some('R') => self.order_of_reals(first, second)?,
            Some('S') => {
                let texts = self.read_text(first).and_then(|a| Ok((a, self.read_text(second)?)));
                let (a, b) = texts.map_err(|_| Fault::Pointer)?;
                if a == b { Ordering::Equal } else { Ordering::Less }
            }
            _ => {
                let width = width(mnemonic);
                let values = self
                    .read_signed(first, width)
                    .and_then(|a| Ok((a, self.read_signed(second, width)?)));
                let (a, b) = values.map_err(|_| Fault::Pointer)?;
                a.cmp(&b)
            }
        };
        let holds = match instruction.relation {
            Some(Relation::Equal) => order.is_eq(),
            Some(Relation::NotEqual) => order.is_ne(),
            Some(Relation::Less) => order.is_lt(),
            Some(Relation::Greater) => order.is_gt(),
            Some(Relation::LessOrEqual) => order.is_le(),
            Some(Relation::GreaterOrEqual) => order.is_ge(),
            None => panic!("a comparison has a relation"),
        };
        match mnemonic.as_bytes()[0] {
            b'L' => self.push(self.powered(holds)),
            b'A' => self.stack[0] = self.stack[0] && holds,
            _ => self.stack[0] = self.stack[0] || self.powered(holds),
        }
        Ok(())
    }

    fn order_of_reals(&self, first: &Operand, second: &Operand) -> Result<Ordering, Fault> {
        let reals = self.read_real(first).and_then(|a| Ok((a, self.read_real(second)?)));
        let (a, b) = reals.map_err(|_| Fault::Pointer)?;
        a.partial_cmp(&b).ok_or(Fault::Real)
    }

    pub(super) fn set_or_reset(
        &mut self,
        first: &Operand,
        count: &Operand,
        value: bool,
    ) -> Result<(), Trouble> {
        let n = self.read(count, 1)? as usize;
        match address(first) {
            Address::Bit { area, byte, bit } => {
                let first = usize::from(byte) * 8 + usize::from(bit);
                if !self.has_bits(area, first, n) {
                    return Err(Trouble::Operand);
                }
                for place in first..first + n {
                    self.set_bit(area, (place / 8) as u16, (place % 8) as u8, value);
                }
            }
            Address::Timer(first) if usize::from(first) + n <= 256 => {
                for timer in &mut self.timers[usize::from(first)..usize::from(first) + n] {
                    timer.bit = value;
                    if !value {
                        timer.reset();
                    }
                }
            }
            Address::Counter(first) if usize::from(first) + n <= 256 => {
                for counter in &mut self.counters[usize::from(first)..usize::from(first) + n] {
                    counter.bit = value;
                    if !value {
                        counter.current = 0;
                    }
                }
            }
            Address::Timer(_) | Address::Counter(_) if value => return Err(Trouble::Operand),
            Address::Timer(_) | Address::Counter(_) => {}
            other => panic!("{other} is no bit"),
        }
        Ok(())
    }
}
