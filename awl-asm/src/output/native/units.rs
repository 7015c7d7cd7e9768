//! The units of a program: which of them become machine code, which stay bytecode because
//! interrupts execute them, and what changes in bytecode that is elsewhere.

use plc_isa::{Decoded, Kind, LABEL_LEN, Op, Operand, Program, Reference, Referent};

use super::error::TranslateError;
use crate::meaning::units::{DEPTH_MAX, INTERRUPT_DEPTH_MAX};

/// The main program or a routine.
#[derive(Debug, Clone)]
pub struct Unit {
    /// The index of a routine; `None` for the main program.
    pub routine: Option<u8>,
    /// Its instructions with their offsets, the hidden ones and its end included.
    pub code: Vec<(u16, Decoded)>,
}

/// The units of a program. Both lists are in the order of the image; a routine that nobody executes
/// is in none of them.
#[derive(Debug, Default)]
pub struct Units {
    /// The main program, and what it calls.
    pub translated: Vec<Unit>,
    /// Interrupt routines, and what they call.
    pub bytecode: Vec<Unit>,
}

impl Units {
    /// The units of a bytecode image. Calls that are nested deeper than the assembler allows are an
    /// error.
    pub fn of(program: &Program<&[u8]>) -> Result<Units, TranslateError> {
        let all = all(program);
        let is_interrupt = |unit: &Unit| {
            unit.routine.is_some_and(|routine| program.plan().routine_name(routine).0)
        };
        Ok(Units {
            translated: reached(&all, |unit| unit.routine.is_none(), DEPTH_MAX)?,
            bytecode: reached(&all, is_interrupt, INTERRUPT_DEPTH_MAX)?,
        })
    }
}

/// All units of a bytecode image.
fn all(program: &Program<&[u8]>) -> Vec<Unit> {
    let (mut units, mut code) = (Vec::new(), Vec::new());
    for (at, decoded) in program.all_instructions() {
        code.push((at, decoded));
        if matches!(decoded.op, Op::MainEnd | Op::Ret) {
            let routine = units.len().checked_sub(1).map(|index| index as u8);
            units.push(Unit { routine, code: std::mem::take(&mut code) });
        }
    }
    units
}

/// The units that are executed by these, and they themselves. A routine calls only routines after
/// it.
fn reached(
    all: &[Unit],
    begins: impl Fn(&Unit) -> bool,
    depth_max: usize,
) -> Result<Vec<Unit>, TranslateError> {
    let mut depths: Vec<Option<usize>> = all.iter().map(|unit| begins(unit).then_some(0)).collect();
    for (index, unit) in all.iter().enumerate() {
        let Some(depth) = depths.get(index).copied().flatten() else { continue };
        for &(at, ref decoded) in &unit.code {
            let Some(callee) =
                called(decoded).and_then(|routine| depths.get_mut(usize::from(routine) + 1))
            else {
                continue;
            };
            if depth == depth_max {
                return Err(TranslateError::Missing { at, what: "calls that are nested so deep" });
            }
            *callee = (*callee).max(Some(depth + 1));
        }
    }
    Ok(all
        .iter()
        .zip(&depths)
        .filter(|(_, depth)| depth.is_some())
        .map(|(unit, _)| unit.clone())
        .collect())
}

/// The routine that an instruction calls.
pub fn called(decoded: &Decoded) -> Option<u8> {
    match (decoded.op, decoded.operands().next()) {
        (Op::Call, Some((_, Operand::Number(routine)))) => Some(routine),
        _ => None,
    }
}

/// How far bytecode and what it refers to are from where they was.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Moved {
    /// By how much constants begin earlier.
    constants: u16,
    /// What is added to offsets in the code; it wraps.
    code: u16,
}

impl Moved {
    /// An instruction alone, in an image that has lost so many labels: its constants begin earlier.
    pub fn piece(labels: u16) -> Moved {
        Moved { constants: LABEL_LEN * labels, code: 0 }
    }

    /// The bytes of an instruction there; `bytes` are those that it has.
    fn bytes_of(self, decoded: &Decoded, bytes: &[u8]) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        let operands_len: usize =
            decoded.operands().map(|(kind, _)| usize::from(kind.stored_len())).sum();
        let mut at = bytes.len().saturating_sub(operands_len);
        for (kind, operand) in decoded.operands() {
            let len = usize::from(kind.stored_len());
            if let (Some(moved), Some(place)) =
                (self.operand(kind, operand), bytes.get_mut(at..at + len))
            {
                place.copy_from_slice(&moved.to_le_bytes());
            }
            at += len;
        }
        bytes
    }

    /// What is stored for an operand there, if that is something else.
    fn operand(self, kind: Kind, operand: Operand) -> Option<u16> {
        match (kind, operand) {
            (Kind::LoopEnd | Kind::LoopStart | Kind::CallEnd, Operand::Offset(offset)) => {
                Some(offset.wrapping_add(self.code))
            }
            (_, Operand::Reference(reference)) => match reference.place()? {
                Referent::Pool(offset) => {
                    Some(Reference::to(Referent::Pool(offset - self.constants)).0)
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// The bytes of this instruction of an image there.
    pub fn instruction(self, image: &[u8], at: u16, decoded: &Decoded) -> Vec<u8> {
        let bytes = image.get(usize::from(at)..usize::from(at + decoded.len));
        self.bytes_of(decoded, bytes.unwrap_or(&[]))
    }
}

impl Unit {
    /// Offset of its first instruction.
    pub fn at(&self) -> u16 {
        self.code.first().map_or(0, |&(at, _)| at)
    }

    /// Whether an instruction of it is at this offset.
    pub fn has(&self, offset: u16) -> bool {
        self.code.iter().any(|&(at, _)| at == offset)
    }

    /// Whether there are jumps to labels in it.
    pub fn has_labels(&self) -> bool {
        self.code.iter().any(|(_, decoded)| decoded.op == Op::Lbl)
    }

    /// Whether it asks for ENO anywhere.
    pub fn reads_eno(&self) -> bool {
        self.code.iter().any(|(_, decoded)| decoded.op == Op::Aeno)
    }

    /// Its bytes at another offset.
    pub fn bytes_at(&self, image: &[u8], at: u16, labels: u16) -> Vec<u8> {
        let moved = Moved { code: at.wrapping_sub(self.at()), ..Moved::piece(labels) };
        self.code.iter().flat_map(|(at, decoded)| moved.instruction(image, *at, decoded)).collect()
    }
}
