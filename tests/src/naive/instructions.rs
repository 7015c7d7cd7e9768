//! Contacts, stack operations, comparisons, coils, moves and arithmetic.

use awl_asm::Address;
use awl_asm::ast::{Instruction, Operand};
use plc_isa::{Area, Relation};

use super::Naive;
use super::memory::{address, number};

/// The logic stack.
impl Naive {
    fn push(&mut self, value: bool) {
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
        match instruction.mnemonic {
            "LD" => self.push(self.bit_operand(&operands[0])),
            "LDN" => self.push(!self.bit_operand(&operands[0])),
            "A" => self.stack[0] = self.stack[0] && self.bit_operand(&operands[0]),
            "AN" => self.stack[0] = self.stack[0] && !self.bit_operand(&operands[0]),
            "O" => self.stack[0] = self.stack[0] || self.bit_operand(&operands[0]),
            "ON" => self.stack[0] = self.stack[0] || !self.bit_operand(&operands[0]),
            "NOT" => self.stack[0] = !self.stack[0],
            "EU" | "ED" => {
                let before = self.edges.insert(at, self.stack[0]).unwrap_or(false);
                let edge =
                    if instruction.mnemonic == "EU" { !before && self.stack[0] } else { before && !self.stack[0] };
                self.stack[0] = edge && !self.first_scan;
            }
            _ => {}
        }
    }

    pub(super) fn stack_operation(&mut self, instruction: &Instruction) {
        match instruction.mnemonic {
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

    pub(super) fn compare(&mut self, instruction: &Instruction) {
        let [first, second] = &instruction.operands[..] else { panic!("a comparison has two operands") };
        let (a, b) = match instruction.mnemonic {
            "LDB" | "AB" | "OB" => (i32::from(self.byte_operand(first)), i32::from(self.byte_operand(second))),
            _ => (i32::from(self.word_operand(first)), i32::from(self.word_operand(second))),
        };
        let holds = match instruction.relation {
            Some(Relation::Equal) => a == b,
            Some(Relation::NotEqual) => a != b,
            Some(Relation::Less) => a < b,
            Some(Relation::Greater) => a > b,
            Some(Relation::LessOrEqual) => a <= b,
            Some(Relation::GreaterOrEqual) => a >= b,
            None => panic!("a comparison has a relation"),
        };
        match instruction.mnemonic {
            "LDW" | "LDB" => self.push(holds),
            "AW" | "AB" => self.stack[0] = self.stack[0] && holds,
            _ => self.stack[0] = self.stack[0] || holds,
        }
    }

    pub(super) fn coil(&mut self, instruction: &Instruction) {
        let operands = &instruction.operands;
        match instruction.mnemonic {
            "=" => self.write_bit_operand(&operands[0], self.stack[0]),
            "S" if self.stack[0] => self.set_or_reset(&operands[0], self.byte_operand(&operands[1]), true),
            "R" if self.stack[0] => self.set_or_reset(&operands[0], self.byte_operand(&operands[1]), false),
            _ => {}
        }
    }

    fn set_or_reset(&mut self, first: &Operand, n: u8, value: bool) {
        let n = usize::from(n);
        match address(first) {
            Address::Bit { area, byte, bit } => {
                let first = usize::from(byte) * 8 + usize::from(bit);
                if first + n > self.area(area).len() * 8 {
                    return;
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
            Address::Timer(_) | Address::Counter(_) => {}
            other => panic!("{other} is no bit"),
        }
    }

    pub(super) fn word_box(&mut self, instruction: &Instruction) {
        if !self.stack[0] {
            return;
        }
        let operands = &instruction.operands;
        match instruction.mnemonic {
            "MOVB" => self.write_byte_operand(&operands[1], self.byte_operand(&operands[0])),
            "MOVW" => self.write_word_operand(&operands[1], self.word_operand(&operands[0])),
            "INCW" => self.step(&operands[0], 1),
            "DECW" => self.step(&operands[0], -1),
            _ => self.calculate(instruction),
        }
    }

    fn step(&mut self, out: &Operand, by: i16) {
        let (result, wrapped) = self.word_operand(out).overflowing_add(by);
        self.write_word_operand(out, result);
        self.set_math_bits(result == 0, wrapped, result < 0);
    }

    fn calculate(&mut self, instruction: &Instruction) {
        let (in1, out) = (&instruction.operands[0], &instruction.operands[1]);
        let (a, b) = (i32::from(self.word_operand(out)), i32::from(self.word_operand(in1)));
        let result = match instruction.mnemonic {
            "+I" => a + b,
            "-I" => a - b,
            "*I" => a * b,
            _ if b == 0 => return self.set_bit(Area::Sm, 1, 3, true),
            _ => a / b,
        };
        if matches!(instruction.mnemonic, "*I" | "/I") {
            self.set_bit(Area::Sm, 1, 3, false);
        }
        if (-32768..=32767).contains(&result) {
            self.write_word_operand(out, result as i16);
            self.set_math_bits(result == 0, false, result < 0);
        } else {
            self.set_math_bits(false, true, false);
        }
    }

    fn set_math_bits(&mut self, zero: bool, overflow: bool, negative: bool) {
        self.set_bit(Area::Sm, 1, 0, zero);
        self.set_bit(Area::Sm, 1, 1, overflow);
        self.set_bit(Area::Sm, 1, 2, negative);
    }
}
