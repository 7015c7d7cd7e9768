//! Pointers where an instruction of the core takes a word or byte: what they lead to is copied to
//! hidden local memory first, each time the instruction is executed. Only inputs; instructions of
//! modules follow pointers themselves.

use plc_isa::{Area, Op, PowerFlow};

use crate::meaning::pick::{hidden, pick};
use crate::meaning::selected::Selected;
use crate::text::address::Address;
use crate::text::ast::{Instruction, Operand, Value};

/// Where hidden local memory begins, after the bytes that a program can name.
const FIRST: u16 = Area::L.size();
/// Loops that can be open.
const LOOPS_MAX: u16 = 8;
/// Bytes of local memory with the hidden ones: a word for what is used up at once, and one for
/// FINAL of each open loop.
pub(crate) const LOCAL_LEN: u16 = FIRST + 2 + 2 * LOOPS_MAX;

/// The instructions for one with pointers; `open_loops` are around it. `None` if it takes no memory
/// in their places.
pub(crate) fn expand(
    source: &Instruction,
    statement: u32,
    open_loops: u16,
) -> Option<Vec<Selected>> {
    let is_pointer = |operand: &Operand| matches!(operand.value, Value::Indirect(_));
    if !source.operands.iter().any(is_pointer) {
        return None;
    }
    let place = |index: usize| match (source.entry.op, index) {
        // Every NEXT reads it.
        (Op::For, 2) => FIRST + 2 + 2 * open_loops.min(LOOPS_MAX - 1),
        _ => FIRST,
    };
    let word = |index: usize| Address::Word { area: Area::L, byte: place(index) };
    let byte = |index: usize| Address::Byte { area: Area::L, byte: place(index) };
    let with = |copy: &dyn Fn(usize) -> Address| {
        let operands =
            source.operands.iter().enumerate().map(|(index, operand)| match is_pointer(operand) {
                true => Operand { value: Value::Address(copy(index)), ..operand.clone() },
                false => operand.clone(),
            });
        let operands: Vec<Operand> = operands.collect();
        let selected = pick(source.entry, source.relation, &operands, statement)?;
        let is_written = |index: usize| selected.written >> index & 1 != 0;
        let pointers =
            || source.operands.iter().enumerate().filter(|(_, operand)| is_pointer(operand));
        if pointers().any(|(index, _)| is_written(index)) {
            return None;
        }
        let copies: Option<Vec<Selected>> = pointers()
            .map(|(index, pointer)| move_of(pointer, &operands[index], index, statement))
            .collect();
        Some(in_front(copies?, selected))
    };
    with(&word).or_else(|| with(&byte))
}

fn move_of(from: &Operand, to: &Operand, index: usize, statement: u32) -> Option<Selected> {
    let is_word = matches!(to.value, Value::Address(Address::Word { .. }));
    let op = if is_word { Op::Movw } else { Op::Movb };
    let selected = pick(op.instruction(), None, &[from.clone(), to.clone()], statement)?;
    Some(Selected { parameter: Some(index as u8), ..selected })
}

/// The copies before the instruction. They are boxes: where it is executed without power flow too,
/// they are there once for each state of the top of the stack. The last ones leave ENO as if the
/// instruction were a box.
fn in_front(copies: Vec<Selected>, selected: Selected) -> Vec<Selected> {
    let mut all = Vec::new();
    if selected.op.instruction().power_flow == PowerFlow::Always {
        let not = hidden(Op::Not, &[], selected.statement, Some(0));
        all.push(not);
        all.extend(copies.iter().copied());
        all.push(not);
    }
    all.extend(copies);
    all.push(selected);
    all
}
