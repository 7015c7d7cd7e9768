//! Constants of a random program, in all their spellings.

use plc_isa::{Group, Instruction};

use super::Generator;

impl Generator<'_> {
    pub(super) fn integer_constant(&mut self, row: &Instruction) -> String {
        let is_preset = matches!(row.group, Group::Timer | Group::Counter);
        let value = match self.rng.u32(..20) {
            0 => 32767,
            1 => -32768,
            2 => self.rng.i16(..),
            3 => -1,
            4..=12 if is_preset => self.rng.i16(1..=12),
            4..=6 => self.rng.i16(-300..=300),
            7 => 0,
            _ => self.rng.i16(-4..=10),
        };
        self.integer_text(value)
    }

    pub(super) fn integer_text(&mut self, value: i16) -> String {
        match self.rng.u32(..8) {
            0 => format!("16#{value:04X}"),
            1 => format!("16#{value:x}"),
            2 if self.one_in(2) => format!("2#{value:b}"),
            _ => value.to_string(),
        }
    }

    pub(super) fn word_constant(&mut self) -> String {
        match self.rng.u32(..6) {
            0 => self.rng.u16(..).to_string(),
            1 => "65535".to_string(),
            _ => {
                let value = [0, 1, -1, 255, 256, 32767, -32768, 100][self.rng.usize(..8)];
                let value = if self.one_in(2) { value } else { self.rng.i16(-20..=20) };
                self.integer_text(value)
            }
        }
    }

    pub(super) fn byte_constant(&mut self) -> String {
        let value = match self.rng.u32(..4) {
            0 => self.rng.u8(..),
            1 => [0, 1, 127, 128, 255][self.rng.usize(..5)],
            _ => self.rng.u8(..8),
        };
        match self.rng.u32(..6) {
            0 => format!("16#{value:02X}"),
            1 => format!("2#{value:b}"),
            _ => value.to_string(),
        }
    }
}
