//! Immediate inputs and outputs, the millisecond clock. In this model inputs stand still during a
//! scan, and the process image of the outputs is their points; high-speed counters, pulses,
//! interrupts, the calendar and the serial line are not in it.

use awl_asm::Address;
use awl_asm::ast::{Instruction, Operand};
use plc_isa::Area;

use super::Naive;
use super::memory::address;
use super::places::{Trouble, ValuePlace, Want};

impl Naive {
    /// An input as it is outside, whatever the program has written to its image.
    pub(super) fn input_point(&self, operand: &Operand) -> bool {
        match address(operand) {
            Address::Bit { area: Area::I, byte, bit } => {
                self.inputs.digital[usize::from(byte)] >> bit & 1 == 1
            }
            other => panic!("{other} is no input"),
        }
    }

    pub(super) fn point_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            name @ ("SI" | "RI") => {
                let n = self.read(&operands[1], 1)? as usize;
                let Address::Bit { area, byte, bit } = address(&operands[0]) else {
                    panic!("an output is a bit")
                };
                let first = usize::from(byte) * 8 + usize::from(bit);
                if first + n > usize::from(area.size()) * 8 {
                    return Err(Trouble::Operand);
                }
                for place in first..first + n {
                    self.set_bit(area, (place / 8) as u16, (place % 8) as u8, name == "SI");
                }
                Ok(())
            }
            "BIR" => {
                let place = self.place(&operands[0], Want::read(1))?;
                if !matches!(place, ValuePlace::Bytes(Area::I, _)) {
                    return Err(Trouble::Operand);
                }
                let value = match place {
                    ValuePlace::Bytes(_, 0) => u32::from(self.inputs.digital[0]),
                    place => self.value_at(place, 1),
                };
                self.write(&operands[1], 1, value)
            }
            "BIW" => {
                let value = self.read(&operands[0], 1)?;
                let place = self.place(&operands[1], Want::written(1))?;
                if !matches!(place, ValuePlace::Bytes(Area::Q, _)) {
                    return Err(Trouble::Operand);
                }
                self.set_value_at(place, 1, value);
                Ok(())
            }
            // Nothing that a program can see.
            "DLED" => self.read(&operands[0], 1).map(|_| ()),
            "BITIM" => self.write(&operands[0], 4, self.now_ms),
            _ => {
                let since = self.read(&operands[0], 4)?;
                self.write(&operands[1], 4, self.now_ms.wrapping_sub(since))
            }
        }
    }
}
