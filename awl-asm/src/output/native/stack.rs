//! The logic stack in a register: which values below its top are needed at all, and across which
//! calls.

use plc_isa::{Decoded, Kind, Op, Operand, STACK_LEVELS};

/// What is done with the values below the top of the stack.
#[derive(Debug, Clone, Default)]
pub struct StackUse {
    /// For each instruction whether the value that it pushes down is read later.
    needed: Vec<bool>,
    /// The calls before which something was pushed down that is read later.
    open: Vec<bool>,
}

impl StackUse {
    /// Of a program.
    pub fn of(code: &[Decoded]) -> StackUse {
        let mut needed = vec![false; code.len()];
        // The instruction that pushed down each level, the top's neighbour last; and those levels
        // at each call.
        let (mut below, mut calls): (Vec<usize>, _) = (Vec::new(), Vec::new());
        let mut mark = |below: &[usize], level: usize| {
            if let Some(&by) = below.len().checked_sub(level).and_then(|index| below.get(index)) {
                needed[by] = true;
            }
        };
        for (index, decoded) in code.iter().enumerate() {
            match decoded.op {
                Op::Ald | Op::Old | Op::Lpp | Op::Lrd | Op::Ctu | Op::Ctd => mark(&below, 1),
                Op::Ctud => (1..=2).for_each(|level| mark(&below, level)),
                Op::Lds => mark(&below, usize::from(level(decoded))),
                Op::Call => calls.push((index, below.clone())),
                _ => {}
            }
            match decoded.op {
                Op::Lbl | Op::For | Op::Next | Op::Ret | Op::MainEnd => below.clear(),
                _ if decoded.stack.adds > 0 => below.push(index),
                _ if decoded.stack.adds < 0 => _ = below.pop(),
                _ => {}
            }
            if below.len() >= usize::from(STACK_LEVELS) {
                below.remove(0);
            }
        }
        let mut open = vec![false; code.len()];
        for (index, below) in calls {
            open[index] = below.iter().any(|&by| needed[by]);
        }
        StackUse { needed, open }
    }

    /// Whether the value that this instruction pushes down is read later.
    pub fn is_needed(&self, index: usize) -> bool {
        self.needed.get(index).copied().unwrap_or(true)
    }

    /// Whether something that was pushed down before this call is read after it.
    pub fn is_read_behind(&self, index: usize) -> bool {
        self.open.get(index).copied().unwrap_or(true)
    }
}

/// The level that LDS names.
pub fn level(decoded: &Decoded) -> u8 {
    let level = decoded.operands().find_map(|(kind, operand)| match operand {
        Operand::Number(level) if kind == Kind::Level => Some(level),
        _ => None,
    });
    level.unwrap_or(0)
}
