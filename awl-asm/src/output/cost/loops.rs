//! The loops of a program and how often each is passed at most: by the operands of FOR, or by what
//! the text states. What a pass costs is not known here.

use std::ops::Range;

use plc_isa::{Decoded, Group, Kind, Many, Op, Operand, Program, Referent, Region};

use super::path::Loop;
use super::stated::Stated;

/// From where it is known how often a loop is passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// Constants say so.
    Exactly,
    /// A line `//# bound`.
    Stated,
    /// The values that the operands of FOR can have.
    Values,
}

/// A loop with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundLoop {
    /// Offset of FOR, or of the LBL of a jump back.
    pub at: u16,
    /// Its steps and passes: of one whose passes are not known, 1.
    pub path: Loop,
    /// From where; `None`: nothing is known.
    pub known: Option<Known>,
}

/// Where a loop begins, its steps, and its passes as far as its operands say.
type Raw = (u16, Range<usize>, Option<(u64, Known)>);

/// The loops of a unit. Steps are the instructions of the program by their numbers.
pub fn find(
    program: &Program<&[u8]>,
    code: &[(u16, Decoded)],
    unit: Range<usize>,
    stated: &Stated,
) -> Vec<FoundLoop> {
    let of_for = unit.clone().filter_map(|index| for_loop(program, code, index));
    let mut loops: Vec<Raw> = of_for.collect();
    for label in unit.clone() {
        let last = unit.clone().rfind(|&jump| target(program, code, jump) == Some(label));
        if let (Some((at, _)), Some(last)) = (code.get(label), last.filter(|&last| last >= label)) {
            loops.push((*at, label..last + 1, None));
        }
    }
    // Who jumps into a loop of FOR finds its counter at any value.
    let is_entered = |steps: &Range<usize>| {
        let outside = unit.clone().filter(|jump| !steps.contains(jump));
        let mut targets = outside.filter_map(|jump| target(program, code, jump));
        targets.any(|target| steps.contains(&target))
    };
    let found = loops.into_iter().map(|(at, steps, known)| {
        let known = known.filter(|_| !is_entered(&steps));
        let stated = stated.bound(at).map(|most| (most, Known::Stated));
        let best = match (known, stated) {
            (Some((most, Known::Values)), Some((bound, _))) if bound < most => stated,
            (known, stated) => known.or(stated),
        };
        let passes = best.map_or(1, |(most, _)| most);
        FoundLoop { at, path: Loop { steps, passes }, known: best.map(|(_, known)| known) }
    });
    found.collect()
}

/// Where a jump leads, by the number of the instruction.
pub fn target(program: &Program<&[u8]>, code: &[(u16, Decoded)], jump: usize) -> Option<usize> {
    let (_, decoded) = code.get(jump)?;
    let offset = decoded.operands().find_map(|(kind, operand)| match (decoded.op, operand) {
        (Op::Jmp | Op::Cscre, Operand::Label(label)) => Some(program.plan().label(label)),
        (Op::CallBegin | Op::For, Operand::Offset(end)) if kind != Kind::LoopStart => Some(end),
        _ => None,
    })?;
    Some(code.partition_point(|&(at, _)| at < offset))
}

/// The loop of a FOR: its body with the NEXT, and how often that is passed if the values of its
/// operands say so.
fn for_loop(program: &Program<&[u8]>, code: &[(u16, Decoded)], index: usize) -> Option<Raw> {
    let (at, head) = code.get(index).filter(|(_, decoded)| decoded.op == Op::For)?;
    let operands: Vec<Operand> = head.operands().map(|(_, operand)| operand).collect();
    let &[Operand::Memory(counted), init, last, _] = operands.as_slice() else { return None };
    let body = index + 1..target(program, code, index)?;
    let value = |operand: Operand, other: i16| match operand {
        Operand::Constant(value) => value as i16,
        _ => other,
    };
    let passes = i64::from(value(last, i16::MAX)) - i64::from(value(init, i16::MIN)) + 1;
    let known = match (init, last) {
        (Operand::Constant(_), Operand::Constant(_)) => Known::Exactly,
        _ => Known::Values,
    };
    // The current value of a timer or counter changes by itself.
    let is_memory = matches!(program.plan().region(counted), Some(Region::Byte { .. }));
    let is_counted = is_memory && !may_change(code, body.clone(), counted);
    Some((*at, body, is_counted.then_some((passes.max(0) as u64, known))))
}

/// Whether a word may be written in a loop, or by what is executed from there.
fn may_change(code: &[(u16, Decoded)], body: Range<usize>, word: u16) -> bool {
    let leaves = |(_, decoded): &(u16, Decoded)| matches!(decoded.op, Op::Call | Op::Poll);
    let within = code.get(body).unwrap_or(&[]);
    let main = code.iter().position(|(_, decoded)| decoded.op == Op::MainEnd).unwrap_or(0);
    let routines = code.get(main..).filter(|_| within.iter().any(leaves)).unwrap_or(&[]);
    within.iter().chain(routines).any(|(_, decoded)| may_write(decoded, word))
}

/// Most bits that S and R write.
const RANGE_MAX: u16 = 255;

/// Bytes of the longest value that a module writes to one operand.
const DOUBLE_LEN: u16 = 4;

/// Whether an instruction writes more than one value.
fn writes_block(decoded: &Decoded) -> bool {
    let group = decoded.op.instruction().group;
    matches!(group, Group::Table | Group::Text | Group::Communication) || decoded.op == Op::Pid
}

/// Whether an instruction may write to a word.
fn may_write(decoded: &Decoded, word: u16) -> bool {
    let count = decoded.operands().find_map(|(kind, operand)| match (kind, operand) {
        (Kind::Count, Operand::Constant(count)) => Some(count),
        (Kind::One, _) => Some(1),
        _ => None,
    });
    decoded.operands().any(|(kind, operand)| match operand {
        Operand::Memory(at) if kind.is_output() => {
            let len = if kind == Kind::ByteOut { 1 } else { 2 };
            at < word + 2 && at + len > word
        }
        Operand::Bit(bit) if kind.is_output() => {
            let roles = decoded.op.instruction().roles;
            let is_one = roles.iter().all(|role| role.many == Many::One);
            let bits = if is_one { 1 } else { count.unwrap_or(RANGE_MAX) };
            bit.address <= word + 1 && bit.address + (u16::from(bit.bit) + bits - 1) / 8 >= word
        }
        Operand::Reference(to) if kind.is_output() => match to.place() {
            Some(Referent::Direct(at)) if !writes_block(decoded) => {
                at < word + 2 && at + DOUBLE_LEN > word
            }
            _ => true,
        },
        _ => false,
    })
}
