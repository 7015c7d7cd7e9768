//! ENO: what each AENO looks at, and which boxes of the core must leave ENO for it. Boxes of
//! modules always leave it.

use std::collections::{HashMap, HashSet};

use plc_isa::{DIVISION, Group, OVERFLOW, Op};

use crate::meaning::selected::Selected;
use crate::meaning::units::Units;

/// The ENO that the last box left.
const LEFT: u8 = 1 << 7;

/// What a program's AENO instructions ask of it.
#[derive(Debug, Default)]
pub struct Enos {
    /// For each AENO its mask.
    masks: HashMap<usize, u8>,
    /// The boxes that must leave ENO.
    noted: HashSet<usize>,
    /// All must: which box an AENO looks at, only the running program knows.
    all: bool,
}

/// The box that an AENO looks at.
enum Last {
    /// The one with this index. Power flows at the AENO only if it was executed.
    InLine(usize),
    /// The one with this index.
    Apart(usize),
    /// The program has come on different ways, or the scan has just begun.
    Unknown,
}

impl Enos {
    /// Of the units that are in the image.
    pub fn of(code: &[Selected], units: &Units) -> Enos {
        let mut enos = Enos::default();
        for part in units.in_image() {
            for index in part.code.clone().filter(|&index| code[index].op == Op::Aeno) {
                let mask = enos.look(code, last_box(code, part.code.start, index));
                enos.masks.insert(index, mask);
            }
        }
        enos
    }

    /// Returns the mask of an AENO that looks at this box.
    fn look(&mut self, code: &[Selected], last: Last) -> u8 {
        match last {
            Last::InLine(index) if code[index].op.instruction().module().is_none() => {
                return errors(code[index].op);
            }
            Last::InLine(index) | Last::Apart(index) => _ = self.noted.insert(index),
            Last::Unknown => self.all = true,
        }
        LEFT
    }

    /// What the AENO with this index looks at.
    pub fn mask(&self, index: usize) -> u8 {
        self.masks.get(&index).copied().unwrap_or(LEFT)
    }

    /// The errors of this instruction, if it is a box that must be told to leave ENO.
    pub fn noted(&self, index: usize, op: Op) -> Option<u8> {
        let leaves = op.instruction().module().is_some();
        (op.has_eno() && !leaves && (self.all || self.noted.contains(&index))).then(|| errors(op))
    }
}

/// Looks from an AENO back to the begin of its unit.
fn last_box(code: &[Selected], start: usize, aeno: usize) -> Last {
    let mut in_line = true;
    for index in (start..aeno).rev() {
        let op = code[index].op;
        let has_ways = matches!(op, Op::Lbl | Op::For | Op::Next | Op::Call);
        if has_ways || is_of_call(&code[..=index]) {
            break;
        }
        if op.has_eno() {
            return if in_line { Last::InLine(index) } else { Last::Apart(index) };
        }
        in_line &= adds_no_power(op);
    }
    Last::Unknown
}

/// Whether the last of these instructions is hidden in a call, which is executed with power flow
/// alone.
fn is_of_call(code: &[Selected]) -> bool {
    let statement = code.last().map(|last| last.statement);
    let mut same = code.iter().rev().take_while(|of| Some(of.statement) == statement);
    same.any(|of| of.op == Op::CallBegin)
}

/// Whether power flows after an instruction only if it did before.
fn adds_no_power(op: Op) -> bool {
    use Op::{
        A, Ab, Aeno, Ai, An, AndByteAny, AndDouble, AndReal, AndText, AndWordAny, Ani,
        AssignImmediate, Aw, Eu, Nop, Wdr,
    };
    let combines = matches!(
        op,
        A | An | Ai | Ani | Aw | Ab | AndByteAny | AndWordAny | AndDouble | AndReal | AndText
    );
    let keeps = matches!(op, Aeno | AssignImmediate | Eu | Nop | Wdr)
        || matches!(op.instruction().group, Group::Coil | Group::Timer | Group::Counter);
    combines || keeps
}

/// The errors that a box of the core can have, as bits of SMB1.
fn errors(op: Op) -> u8 {
    op.instruction().flags & (OVERFLOW | DIVISION)
}
