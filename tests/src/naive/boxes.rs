//! Boxes: power flow and ENO of all of them, moves, arithmetic with integers, logic, shifts.

use awl_asm::Address;
use awl_asm::ast::{Instruction, Operand};
use plc_isa::Area;

use super::Naive;
use super::memory::address;
use super::places::{Trouble, Want};

/// What SM1.0 to SM1.2 say of a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Signs {
    pub(super) zero: bool,
    pub(super) overflow: bool,
    pub(super) negative: bool,
}

/// Bytes of the values of a mnemonic, by its last letter.
pub(super) fn width(mnemonic: &str) -> u8 {
    match mnemonic.chars().last() {
        Some('B') => 1,
        Some('W' | 'I') => 2,
        _ => 4,
    }
}

/// All boxes.
impl Naive {
    /// A box: nothing without power flow.
    pub(super) fn powered_box(&mut self, instruction: &Instruction) {
        if !self.stack[0] {
            self.eno = false;
            return;
        }
        let done = self.execute_box(instruction);
        self.eno = done.is_ok();
        if self.eno {
            self.succeeded.insert(instruction.mnemonic());
        }
        if done == Err(Trouble::Operand) {
            self.set_bit(Area::Sm, 4, 3, true);
        }
    }

    fn execute_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            name @ ("MOVB" | "MOVW" | "MOVD" | "MOVR") => {
                let width = if name == "MOVR" { 4 } else { width(name) };
                let value = self.read(&operands[0], width)?;
                self.write(&operands[1], width, value)
            }
            "+I" | "-I" | "*I" | "/I" | "+D" | "-D" | "*D" | "/D" => self.calculate(instruction),
            "MUL" => self.multiply_wide(operands),
            "DIV" => self.divide_wide(operands),
            "INCB" | "INCW" | "INCD" => self.step(&operands[0], width(instruction.mnemonic()), 1),
            "DECB" | "DECW" | "DECD" => self.step(&operands[0], width(instruction.mnemonic()), -1),
            "INVB" | "INVW" | "INVD" | "ANDB" | "ANDW" | "ANDD" | "ORB" | "ORW" | "ORD"
            | "XORB" | "XORW" | "XORD" => self.combine(instruction),
            "SLB" | "SLW" | "SLD" | "SRB" | "SRW" | "SRD" | "RLB" | "RLW" | "RLD" | "RRB"
            | "RRW" | "RRD" => self.shift(instruction),
            "SHRB" => self.shift_register(operands),
            "SWAP" => {
                let value = self.read(&operands[0], 2)?;
                self.write(&operands[0], 2, (value as u16).swap_bytes().into())
            }
            "BTI" | "ITB" | "ITD" | "DTI" | "BCDI" | "IBCD" | "DECO" | "ENCO" | "SEG" => {
                self.convert(instruction)
            }
            "+R" | "-R" | "*R" | "/R" | "SQRT" | "SIN" | "COS" | "TAN" | "LN" | "EXP" | "DTR"
            | "ROUND" | "TRUNC" => self.real_box(instruction),
            "SLEN" | "SCPY" | "SCAT" | "SSCPY" | "SFND" | "CFND" => self.text_box(instruction),
            "ATH" | "HTA" | "ITA" | "DTA" | "RTA" | "ITS" | "DTS" | "RTS" | "STI" | "STD"
            | "STR" => self.ascii_box(instruction),
            "ATT" | "FIFO" | "LIFO" | "FND" | "FILL" | "BMB" | "BMW" | "BMD" => {
                self.table_box(instruction)
            }
            "S" | "R" => {
                self.set_or_reset(&operands[0], &operands[1], instruction.mnemonic() == "S")
            }
            "SI" | "RI" | "BIR" | "BIW" | "DLED" | "BITIM" | "CITIM" => self.point_box(instruction),
            other => panic!("{other} is unknown here"),
        }
    }
}

/// Arithmetic.
impl Naive {
    pub(super) fn set_signs(&mut self, signs: Signs) {
        self.set_bit(Area::Sm, 1, 0, signs.zero);
        self.set_bit(Area::Sm, 1, 1, signs.overflow);
        self.set_bit(Area::Sm, 1, 2, signs.negative);
    }

    /// Overflow: nothing is written.
    pub(super) fn overflow(&mut self) -> Result<(), Trouble> {
        self.set_signs(Signs { zero: false, overflow: true, negative: false });
        Err(Trouble::Result)
    }

    /// Writes a result that must fit.
    fn finish(&mut self, out: &Operand, width: u8, result: i64) -> Result<(), Trouble> {
        let limit = 1i64 << (8 * width - 1);
        if !(-limit..limit).contains(&result) {
            return self.overflow();
        }
        self.write(out, width, result as u32)?;
        self.set_signs(Signs { zero: result == 0, overflow: false, negative: result < 0 });
        Ok(())
    }

    pub(super) fn divided_by_zero(&mut self, is_so: bool) -> Result<(), Trouble> {
        self.set_bit(Area::Sm, 1, 3, is_so);
        if is_so { Err(Trouble::Result) } else { Ok(()) }
    }

    fn calculate(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let (in1, out) = (&instruction.operands[0], &instruction.operands[1]);
        let width = width(instruction.mnemonic());
        let b = self.read_signed(in1, width)?;
        self.place(out, Want::written(width))?;
        let a = self.read_signed(out, width)?;
        let result = match instruction.mnemonic().as_bytes()[0] {
            b'+' => a + b,
            b'-' => a - b,
            b'*' => {
                self.divided_by_zero(false)?;
                a * b
            }
            _ => {
                self.divided_by_zero(b == 0)?;
                a / b
            }
        };
        self.finish(out, width, result)
    }

    fn multiply_wide(&mut self, operands: &[Operand]) -> Result<(), Trouble> {
        let b = self.read_signed(&operands[0], 2)?;
        self.place(&operands[1], Want::written(4))?;
        let a = i64::from(self.read(&operands[1], 4)? as i16);
        self.divided_by_zero(false)?;
        self.finish(&operands[1], 4, a * b)
    }

    fn divide_wide(&mut self, operands: &[Operand]) -> Result<(), Trouble> {
        let b = self.read_signed(&operands[0], 2)?;
        self.place(&operands[1], Want::written(4))?;
        let a = i64::from(self.read(&operands[1], 4)? as i16);
        self.divided_by_zero(b == 0)?;
        let (quotient, remainder) = (a / b, a % b);
        if quotient > 32767 {
            return self.overflow();
        }
        let both = (remainder as u32) << 16 | u32::from(quotient as u16);
        self.write(&operands[1], 4, both)?;
        self.set_signs(Signs { zero: quotient == 0, overflow: false, negative: quotient < 0 });
        Ok(())
    }

    fn step(&mut self, out: &Operand, width: u8, by: i64) -> Result<(), Trouble> {
        self.place(out, Want::written(width))?;
        let (bits, is_signed) = (8 * width, width > 1);
        let first = if is_signed { -(1i64 << (bits - 1)) } else { 0 };
        let last = first + (1i64 << bits) - 1;
        let exact = self.read_signed(out, width)? + by;
        let result = if exact > last {
            first
        } else if exact < first {
            last
        } else {
            exact
        };
        self.write(out, width, result as u32)?;
        self.set_bit(Area::Sm, 1, 0, result == 0);
        self.set_bit(Area::Sm, 1, 1, result != exact);
        if is_signed {
            self.set_bit(Area::Sm, 1, 2, result < 0);
        }
        if result == exact { Ok(()) } else { Err(Trouble::Result) }
    }
}

/// Logic and shifts.
impl Naive {
    fn combine(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let (mnemonic, operands) = (instruction.mnemonic(), &instruction.operands);
        let width = width(mnemonic);
        let out = operands.last().expect("OUT is there");
        let in1 =
            if mnemonic.starts_with("INV") { u32::MAX } else { self.read(&operands[0], width)? };
        self.place(out, Want::written(width))?;
        let value = self.read(out, width)?;
        let result = match &mnemonic[..mnemonic.len() - 1] {
            "AND" => value & in1,
            "OR" => value | in1,
            _ => value ^ in1,
        };
        self.write(out, width, result)?;
        let zero = self.read(out, width)? == 0;
        self.set_bit(Area::Sm, 1, 0, zero);
        Ok(())
    }

    /// Bit by bit, as often as the count says.
    fn shift(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let (mnemonic, out) = (instruction.mnemonic(), &instruction.operands[0]);
        let width = width(mnemonic);
        self.place(out, Want::written(width))?;
        let (mut value, top) = (u64::from(self.read(out, width)?), 8 * width - 1);
        let count = self.read(&instruction.operands[1], 1)?;
        let bits = u32::from(top) + 1;
        let (rotates, left) = (mnemonic.starts_with('R'), mnemonic.as_bytes()[1] == b'L');
        let count = if rotates { count % bits } else { count.min(bits) };
        let mut last = None;
        for _ in 0..count {
            let leaving = if left { value >> top & 1 } else { value & 1 };
            let entering = if rotates { leaving } else { 0 };
            value = if left {
                value << 1 & ((1 << bits) - 1) | entering
            } else {
                value >> 1 | entering << top
            };
            last = Some(leaving == 1);
        }
        self.write(out, width, value as u32)?;
        self.set_bit(Area::Sm, 1, 0, value == 0);
        if let Some(last) = last {
            self.set_bit(Area::Sm, 1, 1, last);
        }
        Ok(())
    }

    fn shift_register(&mut self, operands: &[Operand]) -> Result<(), Trouble> {
        let entering = self.bit_operand(&operands[0]);
        let n = i32::from(self.read(&operands[2], 1)? as i8);
        let len = n.unsigned_abs() as usize;
        let Address::Bit { area, byte, bit } = address(&operands[1]) else {
            panic!("S_BIT has bytes")
        };
        let first = usize::from(byte) * 8 + usize::from(bit);
        if len > 64 || !self.has_bits(area, first, len) {
            return Err(Trouble::Operand);
        }
        if len == 0 {
            return Ok(());
        }
        let at = |offset: usize| ((first + offset) / 8, ((first + offset) % 8) as u8);
        let mut values: Vec<bool> =
            (0..len).map(|offset| self.bit(area, at(offset).0 as u16, at(offset).1)).collect();
        let leaving = if n > 0 {
            values.insert(0, entering);
            values.pop()
        } else {
            values.push(entering);
            Some(values.remove(0))
        };
        for (offset, value) in values.into_iter().enumerate() {
            self.set_bit(area, at(offset).0 as u16, at(offset).1, value);
        }
        self.set_bit(Area::Sm, 1, 1, leaving == Some(true));
        Ok(())
    }

    /// Whether so many bits of an area are there.
    pub(super) fn has_bits(&self, area: Area, first: usize, len: usize) -> bool {
        let (first_byte, end) = (first / 8, (first + len).div_ceil(8));
        match area {
            Area::V => self
                .extents
                .v
                .iter()
                .any(|v| usize::from(v.start) <= first_byte && end <= usize::from(v.end)),
            Area::Sm => end <= 32,
            _ => end <= usize::from(area.size()),
        }
    }
}
