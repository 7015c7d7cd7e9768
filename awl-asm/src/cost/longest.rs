//! The longest way through a program: every instruction once, those in loops as often as the loops say. How long an
//! instruction takes comes from the caller.

use plc_isa::{Decoded, Group, Kind, Op, Operand, Place, Program, Region};

use super::{Ways, is_fast};

/// Cycles of a program's longest scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Longest {
    /// So many, at most.
    Cycles(u64),
    /// It depends on how often the loop is repeated that closes here: offset of a NEXT or of a JMP back.
    Depends(u16),
    /// It is not known what the instruction at this offset takes.
    Unknown(u16),
}

/// A loop: from behind FOR to behind its NEXT, and how often it is passed.
struct Loop {
    start: u16,
    end: u16,
    passes: u64,
}

/// Adds up the most cycles of each instruction. A jump forward skips what is counted here all the same: the sum is
/// never too low. `each_ms` is what jumps back and timers of 1 ms take more whenever a millisecond has passed.
pub fn longest(program: &Program<&[u8]>, code: &[(u16, Decoded)], start: u32, each_ms: u32, ways: &[Ways]) -> Longest {
    if let Some(((at, _), _)) = code.iter().zip(ways).find(|(_, ways)| !ways.is_known()) {
        return Longest::Unknown(*at);
    }
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
    matches!(decoded.op, Op::Next | Op::Refresh) || is_fast(program.plan(), decoded)
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
            let bits = match decoded.op {
                Op::Assign => 1,
                _ => count.unwrap_or(RANGE_MAX),
            };
            bit.address <= word + 1 && bit.address + (u16::from(bit.bit) + bits - 1) / 8 >= word
        }
        Operand::Reference(to) if kind.is_output() => match to.place() {
            Some(Place::Direct(at)) if !writes_block(decoded) => at < word + 2 && at + DOUBLE_LEN > word,
            _ => true,
        },
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::Longest;
    use crate::assemble::assemble;
    use crate::cost::{ProgramCost, cost};
    use crate::source::Source;

    fn cost_of(text: &str) -> ProgramCost {
        let image = assemble(&Source::new("test", text).unwrap(), Vec::new()).image;
        cost(&image.unwrap_or_else(|| panic!("{text}"))).unwrap()
    }

    fn cycles(text: &str) -> u64 {
        match cost_of(text).interpreted {
            Longest::Cycles(cycles) => cycles,
            Longest::Depends(at) | Longest::Unknown(at) => panic!("{text} depends on {at}"),
        }
    }

    #[test]
    fn a_loop_counts_as_often_as_it_is_passed() {
        let passes = |count: i32, body: &str| cycles(&format!("LD SM0.0\nFOR MW0, 1, {count}\n{body}NEXT\n"));
        let step = passes(2, "") - passes(1, "");
        assert_eq!(passes(12, "") - passes(2, ""), 10 * step);
        let body = "LD SM0.0\nFOR MW2, 1, 3\nNOT\nNEXT\n";
        let nested = passes(2, body) - passes(1, body);
        let not = cycles("LD SM0.0\nNOT\n") - cycles("LD SM0.0\n");
        let more = "LD SM0.0\nFOR MW2, 1, 3\nNOT\nNOT\nNEXT\n";
        assert_eq!(passes(2, more) - passes(1, more), nested + 3 * not);
        assert_eq!(passes(0, body), passes(-5, ""), "a loop that is skipped");
    }

    #[test]
    fn what_cannot_be_known_is_not_told() {
        for (text, place) in [
            ("LD SM0.0\nFOR MW0, 1, MW2\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW0, MW2, 1\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW0, 1, 5\nINCW MW0\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW0, 1, 5\nMOVB 0, MB1\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW2, 1, 5\nS M0.0, 17\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW0, 1, 5\nMOVD VD0, MD2\nMOVD VD0, MD0\nNEXT\n", "NEXT"),
            ("LD SM0.0\nMOVD &MB0, AC1\nFOR MW0, 1, 5\nMOVD VD0, *AC1\nNEXT\n", "NEXT"),
            ("LD SM0.0\nFOR MW8, 1, 5\nFILL 0, MW0, 4\nNEXT\n", "NEXT"),
            ("LBL 1\nLD I0.0\nJMP 1\n", "JMP"),
        ] {
            let cost = cost_of(text);
            assert!(matches!(cost.interpreted, Longest::Depends(_)), "{text}{place}");
            assert_eq!(Some(cost.interpreted), cost.translated, "{text}");
        }
        // Beside the counted word, or with known counts, nothing changes it.
        cycles("LD SM0.0\nFOR MW2, 1, 5\nMOVB 0, MB1\nMOVW 0, MW4\nS M0.0, 16\nR M4.0, 8\nNEXT\n");
        cycles("LD I0.0\nJMP 1\nLD I0.1\n= Q0.0\nLBL 1\n");
        cycles("LD SM0.0\nFOR MW4, 1, 5\nMOVD VD0, MD0\nMOVD VD0, MD6\nNEXT\n");
    }
}
