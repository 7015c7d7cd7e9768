//! Character strings (docs/s7-200.md 1.10).

use plc_isa::{Op, ProgramMemory};

use super::execution::{Execution, Failure};
use crate::environment::Environment;
use crate::references::Width;

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn text(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Slen => {
                let (len, out) =
                    (self.read_text(0)?.characters().len(), self.target(1, Width::Byte, 1)?);
                self.put(out, Width::Byte, len as i64);
                Ok(())
            }
            Op::Scpy => {
                let text = self.read_text(0)?;
                self.write_text(1, text.characters())
            }
            Op::Scat => {
                let (appended, mut text) = (self.read_text(0)?, self.read_text(1)?);
                text.append(appended.characters())?;
                self.write_text(1, text.characters())
            }
            Op::Sscpy => {
                let text = self.read_text(0)?;
                let (start, count) = (
                    self.read_position(1, text.characters())?,
                    self.read(2, Width::Byte)? as usize,
                );
                let part = text.characters().get(start..start + count).ok_or(Failure::Operand)?;
                self.write_text(3, part)
            }
            Op::Sfnd => {
                self.find_text(|text, sought| !sought.is_empty() && text.starts_with(sought))
            }
            Op::Cfnd => self
                .find_text(|text, sought| text.first().is_some_and(|first| sought.contains(first))),
            _ => self.ascii(op),
        }
    }

    /// The place of a character, counted from 0; in the operand from 1.
    pub(super) fn read_position(&self, index: usize, text: &[u8]) -> Result<usize, Failure> {
        let position = self.read(index, Width::Byte)? as usize;
        if (1..=text.len()).contains(&position) { Ok(position - 1) } else { Err(Failure::Operand) }
    }

    /// OUT := the first position, from OUT on, from which the text in IN1 matches that in IN2; 0 if
    /// there is none.
    fn find_text(&mut self, matches: fn(&[u8], &[u8]) -> bool) -> Result<(), Failure> {
        let (text, sought) = (self.read_text(0)?, self.read_text(1)?);
        let (text, sought) = (text.characters(), sought.characters());
        let (start, out) = (self.read(2, Width::Byte)? as usize, self.target(2, Width::Byte, 1)?);
        // After the end nothing is found; a position 0 there is not.
        let start = start.checked_sub(1).ok_or(Failure::Operand)?;
        let found = (start..text.len()).find(|&at| matches(text.get(at..).unwrap_or(&[]), sought));
        self.put(out, Width::Byte, found.map_or(0, |at| at as i64 + 1));
        Ok(())
    }
}
