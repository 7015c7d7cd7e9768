//! The logic stack in a register: which values below its top are needed at all, and in which bit each stands.

use plc_isa::{Decoded, Kind, Op, Operand, STACK_LEVELS};

/// For each instruction whether the value that it pushes down is read later.
pub fn needed(code: &[Decoded]) -> Vec<bool> {
    let mut needed = vec![false; code.len()];
    // The instruction that pushed down each level, the top's neighbour last.
    let mut below: Vec<usize> = Vec::new();
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
            _ => {}
        }
        match decoded.op {
            Op::Lbl | Op::For | Op::Next => below.clear(),
            _ if decoded.stack.adds > 0 => below.push(index),
            _ if decoded.stack.adds < 0 => _ = below.pop(),
            _ => {}
        }
        if below.len() >= usize::from(STACK_LEVELS) {
            below.remove(0);
        }
    }
    needed
}

/// The level that LDS names.
pub fn level(decoded: &Decoded) -> u8 {
    let level = decoded.operands().find_map(|(kind, operand)| match operand {
        Operand::Number(level) if kind == Kind::Level => Some(level),
        _ => None,
    });
    level.unwrap_or(0)
}
