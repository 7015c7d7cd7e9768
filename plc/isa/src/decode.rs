//! A decoded instruction: what the checker, the disassembler and the listing look at. Executing is
//! elsewhere.

use crate::fetch::Fetched;
use crate::kind::Kind;
use crate::memory::ProgramMemory;
use crate::operand::{OPERANDS_MAX, Operand, Raw, Relation};
use crate::table::{Op, StackEffect};
use crate::token_table::unpacked;

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
    raw: [Raw; OPERANDS_MAX],
}

/// Decodes the instruction at offset `pc` without executing it.
pub fn decode<P: ProgramMemory>(code: &P, pc: u16) -> Result<Decoded, DecodeError> {
    let mut fetched = Fetched::NOTHING;
    if !fetched.fetch(code, pc) {
        return Err(DecodeError::UndefinedToken);
    }
    let (next, raw) = (fetched.next, fetched.operands);
    if next > code.len() || next <= pc {
        return Err(DecodeError::Truncated);
    }
    let mut decoded =
        Decoded { op: fetched.op, stack: unpacked(fetched.stack), len: next - pc, raw };
    for raw in raw {
        match raw.kind() {
            Some(kind) if !kind.shape().is_canonical(raw) => return Err(DecodeError::Malformed),
            Some(Kind::Level) => {
                decoded.stack.needs = decoded.stack.needs.saturating_add(raw.value as u8)
            }
            _ => {}
        }
    }
    Ok(decoded)
}

impl Decoded {
    /// The operands with their kinds, in order.
    pub fn operands(&self) -> impl Iterator<Item = (Kind, Operand)> + '_ {
        self.raw.iter().map_while(|&raw| raw.kind().map(|kind| (kind, kind.operand(raw))))
    }

    /// The comparison, if the instruction is one.
    pub fn relation(&self) -> Option<Relation> {
        self.operands().find_map(|(_, operand)| match operand {
            Operand::Relation(relation) => Some(relation),
            _ => None,
        })
    }
}
