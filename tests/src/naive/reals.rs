//! Reals: arithmetic, conversions, functions, PID.
//!
//! SIN, COS, TAN, LN and EXP are defined as sequences of operations, and PID is one: those are
//! plc-vm's.

use awl_asm::ast::{Instruction, Operand, Value};
use plc_isa::Area;
use plc_vm::{function, pid};

use super::Naive;
use super::boxes::Signs;
use super::places::{Trouble, Want};

/// The result, if it is a number.
fn number(result: f32) -> Option<f32> {
    result.is_finite().then_some(result)
}

impl Naive {
    pub(super) fn read_real(&self, operand: &Operand) -> Result<f32, Trouble> {
        match &operand.value {
            Value::Constant(constant) => Ok(constant.value as f32),
            _ => self.read(operand, 4).map(f32::from_bits),
        }
    }

    pub(super) fn real_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let (input, out) = (&instruction.operands[0], &instruction.operands[1]);
        if instruction.mnemonic() == "DTR" {
            let value = self.read_signed(input, 4)?;
            return self.write(out, 4, (value as f32).to_bits());
        }
        let x = self.read_real(input)?;
        self.place(out, Want::written(4))?;
        match instruction.mnemonic() {
            "ROUND" => self.write_whole(out, x.round()),
            "TRUNC" => self.write_whole(out, x.trunc()),
            "+R" | "-R" | "*R" | "/R" => {
                let value = self.read_real(out)?;
                self.calculate_real(instruction.mnemonic(), value, x, out)
            }
            name => {
                let result = number(x).and_then(|x| match name {
                    "SQRT" => (x >= 0.0).then(|| x.sqrt()),
                    "SIN" => function::sin(x),
                    "COS" => function::cos(x),
                    "TAN" => function::tan(x),
                    "LN" => function::ln(x),
                    _ => function::exp(x),
                });
                self.finish_real(out, result)
            }
        }
    }

    fn calculate_real(
        &mut self,
        mnemonic: &str,
        a: f32,
        b: f32,
        out: &Operand,
    ) -> Result<(), Trouble> {
        let both = number(a).zip(number(b));
        let divides = mnemonic == "/R";
        // Whatever is divided.
        if divides && b == 0.0 {
            return self.divided_by_zero(true);
        }
        if divides || mnemonic == "*R" {
            self.divided_by_zero(false)?;
        }
        let result = both.map(|(a, b)| match mnemonic {
            "+R" => a + b,
            "-R" => a - b,
            "*R" => a * b,
            _ => a / b,
        });
        self.finish_real(out, result.and_then(number))
    }

    fn finish_real(&mut self, out: &Operand, result: Option<f32>) -> Result<(), Trouble> {
        let Some(result) = result else { return self.overflow() };
        self.write(out, 4, result.to_bits())?;
        self.set_signs(Signs { zero: result == 0.0, overflow: false, negative: result < 0.0 });
        Ok(())
    }

    fn write_whole(&mut self, out: &Operand, whole: f32) -> Result<(), Trouble> {
        let fits = (-2_147_483_648.0..2_147_483_648.0).contains(&whole);
        self.set_bit(Area::Sm, 1, 1, !fits);
        if !fits {
            return Err(Trouble::Result);
        }
        self.write(out, 4, whole as i32 as u32)
    }

    /// PID sees power flow come, so it is executed without as well.
    pub(super) fn pid(&mut self, at: usize, instruction: &Instruction) {
        let before = self.edges.insert((self.unit, at), self.stack[0]);
        if !self.stack[0] {
            self.eno = false;
            return;
        }
        let starts = before == Some(false) && !self.first_scan;
        let done = self.regulate(&instruction.operands[0], starts);
        self.eno = done.is_ok();
        if done == Err(Trouble::Operand) {
            self.set_bit(Area::Sm, 4, 3, true);
        }
    }

    fn regulate(&mut self, table: &Operand, starts: bool) -> Result<(), Trouble> {
        let place = self.place(table, Want { width: 4, count: 9, is_written: true })?;
        let value = |index: u16| f32::from_bits(self.value_at(Naive::behind(place, 4, index), 4));
        let result = pid::execute(&[0, 1, 2, 3, 4, 5, 6, 7, 8].map(value), starts);
        self.set_bit(Area::Sm, 1, 1, result.is_none());
        for (value, index) in result.ok_or(Trouble::Result)?.into_iter().zip(0..) {
            self.set_value_at(Naive::behind(place, 4, index), 4, value.to_bits());
        }
        Ok(())
    }
}
