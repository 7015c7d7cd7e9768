//! A decoded instruction: what the checker, the disassembler and the listing look at. Executing is elsewhere.

use crate::image::ProgramMemory;
use crate::operand::{Kind, Operand, OperandReader, Relation};
use crate::table::{Looked, OPERANDS_MAX, Op, StackEffect, WIDE_PREFIX, look_up, look_up_wide};

/// Why bytes are no instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DecodeError {
    /// The token is not in the instruction table.
    UndefinedToken,
    /// The code ends within the instruction.
    Truncated,
    /// The same instruction has another, canonical encoding: an operand's mode byte is unknown.
    Malformed,
}

/// One instruction with its operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decoded {
    /// Which instruction.
    pub op: Op,
    /// Its effect on the logic stack, `LDS` with its level counted in.
    pub stack: StackEffect,
    /// Its length in bytes.
    pub len: u16,
    operands: [(Kind, Operand); OPERANDS_MAX],
    count: u8,
}

/// Decodes the instruction at offset `pc` without executing it.
pub fn decode<P: ProgramMemory>(code: &P, pc: u16) -> Result<Decoded, DecodeError> {
    let token = code.byte(pc);
    let (looked, operands_at) = match token {
        WIDE_PREFIX => (look_up_wide(code.byte(pc.wrapping_add(1))), pc.wrapping_add(2)),
        token => (look_up(token), pc.wrapping_add(1)),
    };
    let looked = looked.ok_or(DecodeError::UndefinedToken)?;
    let mut reader = OperandReader::new(code, pc, operands_at, looked.in_token);
    let mut decoded = Decoded::new(&looked);
    let mut kinds = looked.kinds;
    while let Some(kind) = Kind::unpacked(kinds as u8) {
        decoded.push(kind, kind.read(&mut reader));
        kinds >>= 8;
    }
    decoded.finish(code, pc, reader.position())
}

impl Decoded {
    fn new(looked: &Looked) -> Self {
        let operands = [(Kind::Here, Operand::Offset(0)); OPERANDS_MAX];
        Decoded { op: looked.op, stack: looked.stack, len: 0, operands, count: 0 }
    }

    fn push(&mut self, kind: Kind, operand: Operand) {
        if let Some(place) = self.operands.get_mut(usize::from(self.count)) {
            *place = (kind, operand);
            self.count += 1;
        }
        if let (Kind::Level, Operand::Number(level)) = (kind, operand) {
            self.stack.needs = self.stack.needs.saturating_add(level);
        }
    }

    fn finish<P: ProgramMemory>(mut self, code: &P, pc: u16, next: u16) -> Result<Decoded, DecodeError> {
        if next > code.len() || next <= pc {
            return Err(DecodeError::Truncated);
        }
        self.len = next - pc;
        if !self.is_canonical(code, pc) {
            return Err(DecodeError::Malformed);
        }
        Ok(self)
    }

    /// Modes of general operands are 0 or 1, byte constants in them have no high byte.
    fn is_canonical<P: ProgramMemory>(&self, code: &P, pc: u16) -> bool {
        let stored: u16 = self.operands().map(|(kind, _)| u16::from(kind.stored_len())).sum();
        let mut at = pc + self.len - stored;
        self.operands().all(|(kind, _)| {
            let (mode, high) = (code.byte(at), code.byte(at.wrapping_add(2)));
            at += u16::from(kind.stored_len());
            match kind {
                Kind::AnyInt => mode <= 1,
                Kind::AnyByte => mode == 1 || (mode == 0 && high == 0),
                _ => true,
            }
        })
    }

    /// The operands with their kinds, in order.
    pub fn operands(&self) -> impl Iterator<Item = (Kind, Operand)> + '_ {
        self.operands.iter().take(usize::from(self.count)).copied()
    }

    /// The comparison, if the instruction is one.
    pub fn relation(&self) -> Option<Relation> {
        self.operands().find_map(|(_, operand)| match operand {
            Operand::Relation(relation) => Some(relation),
            _ => None,
        })
    }
}
