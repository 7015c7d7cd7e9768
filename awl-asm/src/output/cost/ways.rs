//! The ways on from an instruction, with their cycles.

use plc_isa::{Decoded, Op, Operand, Plan, ProgramMemory, TimerResolution, timer_resolution};

use crate::output::cycles::{Cycles, either};

/// The ways on from an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Ways {
    /// To the next instruction, without power flow.
    pub off: Option<Cycles>,
    /// To the next instruction, with power flow.
    pub on: Option<Cycles>,
    /// To elsewhere: a jump that is taken, FOR that is skipped, NEXT that goes back, the end of the
    /// program.
    pub away: Option<Cycles>,
}

impl Ways {
    /// To the next instruction, with power flow or without.
    pub fn next(self) -> Option<Cycles> {
        either(self.off, self.on)
    }

    /// Whether there are figures: they are missing for instructions that have not been measured.
    pub fn is_known(self) -> bool {
        self != Ways::default()
    }

    /// The least and the most of all.
    pub fn all(self) -> Cycles {
        either(self.next(), self.away).unwrap_or_default()
    }
}

/// Whether an instruction is that of a timer of 1 ms.
pub(super) fn is_fast<P: ProgramMemory>(plan: &Plan<P>, decoded: &Decoded) -> bool {
    match (decoded.op, decoded.operands().next()) {
        (Op::Ton | Op::Tof | Op::Tonr, Some((_, Operand::Number(slot)))) => {
            timer_resolution(plan.timer(slot).number) == TimerResolution::Ms1
        }
        _ => false,
    }
}
