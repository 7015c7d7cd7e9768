//! What contacts are in a segment of a sequence: which of them take their power from its bit. Where
//! segments begin and end is checked elsewhere.

use plc_isa::{Op, STACK_LEVELS};

use crate::meaning::selected::{Argument, Selected};

/// Whether an instruction combines by OR: a contact that lies parallel to what comes before.
pub fn is_or(op: Op) -> bool {
    load_of(op).is_some()
}

/// Whether power can flow after an instruction in a segment that has none: made here, or from a
/// deeper level of the stack.
pub fn may_bring_power(op: Op) -> bool {
    matches!(op, Op::Not | Op::Ed | Op::Lbl | Op::Lpp | Op::Lrd | Op::Lds)
}

/// The load of the same value, of an instruction that combines by OR.
pub fn load_of(op: Op) -> Option<Op> {
    Some(match op {
        Op::O => Op::Ld,
        Op::On => Op::Ldn,
        Op::Oi => Op::Ldi,
        Op::Oni => Op::Ldni,
        Op::Ob => Op::Ldb,
        Op::Ow => Op::Ldw,
        Op::OrByteAny => Op::LoadByteAny,
        Op::OrWordAny => Op::LoadWordAny,
        Op::OrDouble => Op::LoadDouble,
        Op::OrReal => Op::LoadReal,
        Op::OrText => Op::LoadText,
        _ => return None,
    })
}

/// Whether these instructions work with eight values on the stack.
pub fn eight_are_enough(code: &[Selected]) -> bool {
    let mut depth = STACK_LEVELS - 1;
    for selected in code {
        let stack = selected.op.instruction().stack;
        let level = match selected.arguments[0] {
            Argument::Number(level) if selected.op == Op::Lds => level,
            _ => 0,
        };
        if matches!(selected.op, Op::Lbl | Op::For | Op::Next) || depth >= STACK_LEVELS {
            return true;
        }
        if stack.needs + level > depth {
            return false;
        }
        depth = depth.saturating_add_signed(stack.adds);
    }
    true
}
