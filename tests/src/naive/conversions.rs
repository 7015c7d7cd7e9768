//! Conversions between bytes, words and double words, BCD, bits and segments.

use awl_asm::ast::Instruction;
use plc_isa::Area;

use super::Naive;
use super::places::{Trouble, Want};

/// Segments a to g of the digits 0 to F, a in bit 0 (docs/s7-200.md 1.6).
const SEGMENTS: [u8; 16] = [
    0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07, 0x7F, 0x67, 0x77, 0x7C, 0x39, 0x5E, 0x79, 0x71,
];

impl Naive {
    pub(super) fn convert(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        let (input, out) = (&operands[0], &operands[operands.len() - 1]);
        match instruction.mnemonic() {
            "BTI" => {
                let value = self.read(input, 1)?;
                self.write(out, 2, value)
            }
            "ITD" => {
                let value = self.read_signed(input, 2)?;
                self.write(out, 4, value as u32)
            }
            name @ ("ITB" | "DTI") => {
                let (from, to, range) =
                    if name == "ITB" { (2, 1, 0..=255) } else { (4, 2, -32_768..=32_767) };
                let value = self.read_signed(input, from)?;
                self.place(out, Want::written(to))?;
                let fits = range.contains(&value);
                self.set_bit(Area::Sm, 1, 1, !fits);
                if !fits {
                    return Err(Trouble::Result);
                }
                self.write(out, to, value as u32)
            }
            name @ ("BCDI" | "IBCD") => {
                self.place(out, Want::written(2))?;
                let value = self.read(out, 2)?;
                let result = if name == "BCDI" { from_bcd(value) } else { to_bcd(value) };
                self.set_bit(Area::Sm, 1, 6, result.is_none());
                self.write(out, 2, result.ok_or(Trouble::Result)?)
            }
            "DECO" => {
                let bit = self.read(input, 1)? % 16;
                self.write(out, 2, 1 << bit)
            }
            "ENCO" => {
                let value = self.read(input, 2)?;
                let lowest = (0..16).find(|bit| value >> bit & 1 == 1).unwrap_or(0);
                self.write(out, 1, lowest)
            }
            _ => {
                let digit = self.read(input, 1)? % 16;
                self.write(out, 1, SEGMENTS[digit as usize].into())
            }
        }
    }
}

fn from_bcd(word: u32) -> Option<u32> {
    format!("{word:04X}").parse().ok()
}

fn to_bcd(word: u32) -> Option<u32> {
    (word <= 9999)
        .then(|| format!("{word:04}"))
        .and_then(|digits| u32::from_str_radix(&digits, 16).ok())
}
