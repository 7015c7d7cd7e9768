//! The longest way through a program: every instruction once, those in loops as often as the loops say. How long an
//! instruction takes comes from the caller.

use plc_isa::{Decoded, Kind, Op, Operand, Program, Region, TimerResolution, timer_resolution};

use super::Ways;

/// Cycles of a program's longest scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Longest {
    /// So many, at most.
    Cycles(u64),
    /// It depends on how often the loop is repeated that closes here: offset of a NEXT or of a JMP back.
    Depends(u16),
}

/// A loop: from behind FOR to behind its NEXT, and how often it is passed.
struct Loop {
    start: u16,
    end: u16,
    passes: u64,
}

/// Adds up the most cycles of each instruction. A jump forward skips what is counted here all the same: the sum is never
/// too low. `each_ms` is what jumps back and timers of 1 ms take more whenever a millisecond has passed.
pub fn longest(program: &Program<&[u8]>, code: &[(u16, Decoded)], start: u32, each_ms: u32, ways: &[Ways]) -> Longest {
    let mut loops = Vec::new();
    for (index, (at, decoded)) in code.iter().enumerate() {
        match decoded.op {
            Op::For => match loop_of(program, code, index) {
                Ok(found) => loops.push(found),
                Err(place) => return Longest::Depends(place),
            },
            Op::Jmp if target(program, decoded) <= *at => return Longest::Depends(*at),
            _ => {}
        }
    }
    let mut cycles = u64::from(start);
    for ((at, _), ways) in code.iter().zip(ways) {
        let around = loops.iter().filter(|found| (found.start..found.end).contains(at));
        let times = around.fold(1, |times: u64, found| times.saturating_mul(found.passes));
        cycles = cycles.saturating_add(times.saturating_mul(u64::from(ways.all().max)));
    }
    if code.iter().any(|(_, decoded)| feels_time(program, decoded)) {
        let ms = cycles / CYCLES_A_MS + 1;
        cycles = cycles.saturating_add(ms.saturating_mul(u64::from(each_ms)));
    }
    Longest::Cycles(cycles)
}

const CYCLES_A_MS: u64 = 16_000;

/// Whether an instruction takes longer when a millisecond has passed.
fn feels_time(program: &Program<&[u8]>, decoded: &Decoded) -> bool {
    let is_fast = |slot: u8| timer_resolution(program.plan().timer(slot).number) == TimerResolution::Ms1;
    match (decoded.op, decoded.operands().next()) {
        (Op::Next | Op::Refresh, _) => true,
        (Op::Ton | Op::Tof | Op::Tonr, Some((_, Operand::Number(slot)))) => is_fast(slot),
        _ => false,
    }
}

fn target(program: &Program<&[u8]>, jump: &Decoded) -> u16 {
    let label = jump.operands().find_map(|(_, operand)| match operand {
        Operand::Number(label) => Some(label),
        _ => None,
    });
    label.map_or(0, |label| program.plan().label(label))
}

/// The loop of the FOR with this number; an error names its NEXT.
fn loop_of(program: &Program<&[u8]>, code: &[(u16, Decoded)], index: usize) -> Result<Loop, u16> {
    let Some((at, head)) = code.get(index) else { return Err(0) };
    let operands: Vec<Operand> = head.operands().map(|(_, operand)| operand).collect();
    let &[Operand::Memory(counted), init, last, Operand::Offset(end)] = operands.as_slice() else { return Err(*at) };
    let start = at + head.len;
    let body: Vec<_> = code.iter().filter(|(at, _)| (start..end).contains(at)).collect();
    let next = body.last().map_or(*at, |(at, _)| *at);
    let (Operand::Constant(init), Operand::Constant(last)) = (init, last) else { return Err(next) };
    // The current value of a timer or counter changes by itself.
    let is_memory = matches!(program.plan().region(counted), Some(Region::Byte { .. }));
    if !is_memory || body.iter().any(|(_, decoded)| may_write(decoded, counted)) {
        return Err(next);
    }
    let passes = i64::from(last as i16) - i64::from(init as i16) + 1;
    Ok(Loop { start, end, passes: passes.max(0) as u64 })
}

/// Most bits that S and R write.
const RANGE_MAX: u16 = 255;

/// Whether an instruction may write to a word.
fn may_write(decoded: &Decoded, word: u16) -> bool {
    let count = decoded.operands().find_map(|(kind, operand)| match (kind, operand) {
        (Kind::Count, Operand::Constant(count)) => Some(count),
        (Kind::One, _) => Some(1),
        _ => None,
    });
    decoded.operands().any(|(kind, operand)| match operand {
        Operand::Memory(at) if kind.is_output() => at <= word + 1 && at + 1 >= word,
        Operand::Bit(bit) if kind.is_output() => {
            let bits = match decoded.op {
                Op::Assign => 1,
                _ => count.unwrap_or(RANGE_MAX),
            };
            bit.address <= word + 1 && bit.address + (u16::from(bit.bit) + bits - 1) / 8 >= word
        }
        _ => false,
    })
}
