//! Cycles of instructions whose time goes with the values that they find: those of modules. They
//! were measured with values as programs have them; nothing says that others do not take longer.

use plc_isa::{Decoded, Group, Kind, Op, Operand, PowerFlow, Referent};

use super::modules::{CONSTANT, POINTER, TABLE};
use super::ways::Ways;
use crate::output::cycles::Cycles;

/// What an instruction takes on the board, with operands in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Typical {
    /// Which.
    pub op: Op,
    /// Without power flow.
    pub off: u32,
    /// With power flow, or of an instruction that needs none: the fewest, as a rule, the most.
    pub on: [u32; 3],
    /// What each of something takes that the instruction handles: cycles, of what, how many there
    /// are in these figures.
    pub each: Option<(u32, &'static str, u32)>,
}

/// A line of the table.
pub(super) const fn of(
    op: Op,
    off: u32,
    on: [u32; 3],
    each: Option<(u32, &'static str, u32)>,
) -> Typical {
    Typical { op, off, on, each }
}

/// What an operand adds that is a pointer: to V memory, and to one of some counters.
pub const fn by_pointer() -> [u32; 2] {
    POINTER
}

/// What an operand adds at most that is a constant.
pub const fn by_constant() -> u32 {
    CONSTANT
}

/// What was measured of an instruction.
pub fn of_op(op: Op) -> Option<Typical> {
    TABLE.iter().find(|typical| typical.op == op).copied()
}

/// Most elements that an instruction can handle: counts and lengths are bytes.
const COUNT_MAX: u32 = 255;

/// What an instruction of a module costs with its operands; unknown for others.
pub(super) fn ways(decoded: &Decoded, image: &[u8]) -> Ways {
    let instruction = decoded.op.instruction();
    let Some(typical) = of_op(decoded.op).filter(|_| instruction.module().is_some()) else {
        return Ways::default();
    };
    let [least, _, most] = typical.on;
    let (fewest, longest) = count(decoded, image).map_or((0, COUNT_MAX), |count| (count, count));
    let with = |cycles: u32, count: u32| match typical.each {
        Some((each, _, usual)) => (cycles + each * count).saturating_sub(each * usual),
        None => cycles,
    };
    let more = operands(decoded);
    let on = Cycles { min: with(least, fewest) + more.min, max: with(most, longest) + more.max };
    let off = (instruction.power_flow == PowerFlow::Needed).then(|| Cycles::exactly(typical.off));
    // A contact takes the same with and without.
    Ways { off: off.or(Some(on)), on: Some(on), away: None }
}

/// The places that the operands name.
fn places(decoded: &Decoded) -> impl Iterator<Item = (Kind, Referent)> + '_ {
    decoded.operands().filter_map(|(kind, operand)| match operand {
        Operand::Reference(reference) => Some((kind, reference.place()?)),
        _ => None,
    })
}

/// What pointers and constants add.
fn operands(decoded: &Decoded) -> Cycles {
    places(decoded).fold(Cycles::default(), |sum, (_, place)| match place {
        Referent::Indirect(_) => sum.then(Cycles { min: POINTER[0], max: POINTER[1] }),
        Referent::Constant(_) | Referent::Pool(_) => sum.then(Cycles { min: 0, max: CONSTANT }),
        Referent::Direct(_) => sum,
    })
}

/// How many elements an instruction handles: its count, the last byte among its operands, or the
/// length of its longest string; `None` where it is read in the scan.
fn count(decoded: &Decoded, image: &[u8]) -> Option<u32> {
    let is_table = decoded.op.instruction().group == Group::Table;
    let byte = places(decoded).filter(|(kind, _)| *kind == Kind::ByteIn).last();
    match byte {
        Some((_, Referent::Constant(count))) => {
            Some(u32::from(count.unsigned_abs()).min(COUNT_MAX))
        }
        Some(_) => None,
        None if is_table => None,
        None => places(decoded)
            .filter(|(kind, _)| matches!(kind, Kind::TextIn | Kind::TextTo))
            .map(|(kind, place)| match place {
                Referent::Pool(offset) => image.get(usize::from(offset)).map(|&len| u32::from(len)),
                // What is written is as long as what is read.
                _ if kind == Kind::TextTo => Some(0),
                _ => None,
            })
            .try_fold(0, |longest, len| Some(longest.max(len?))),
    }
}

#[cfg(test)]
mod tests {
    use plc_isa::{INSTRUCTIONS, verify};

    use super::*;
    use crate::assemble::assemble;
    use crate::source::Source;

    /// The ways on of the last instruction that was written.
    fn ways_of(text: &str) -> Ways {
        let image = assemble(&Source::new("test", text).unwrap(), Vec::new()).image;
        let image = image.unwrap_or_else(|| panic!("{text}"));
        let code: Vec<Decoded> =
            verify(image.as_slice()).unwrap().instructions().map(|(_, decoded)| decoded).collect();
        ways(&code[code.len() - 2], &image)
    }

    fn most(text: &str) -> u32 {
        ways_of(text).on.unwrap().max
    }

    #[test]
    fn every_instruction_of_a_module_that_is_written_has_one_line() {
        for row in
            INSTRUCTIONS.iter().filter(|row| row.module().is_some() && row.group != Group::Hidden)
        {
            assert_eq!(
                TABLE.iter().filter(|typical| typical.op == row.op).count(),
                1,
                "{}",
                row.mnemonic()
            );
        }
    }

    #[test]
    fn a_count_says_how_long_it_takes() {
        let fill = |n: &str| format!("//# memory VB0-VB299\nLD SM0.0\nFILL VW0, VW100, {n}\n");
        let (each, _, _) = of_op(Op::Fill).unwrap().each.unwrap();
        assert!(each > 0);
        assert_eq!(most(&fill("50")) - most(&fill("10")), 40 * each);
        assert_eq!(most(&fill("VB0")) - most(&fill("10")), 245 * each - CONSTANT);
        let copy = |text: &str| format!("//# memory VB0-VB99\nLD SM0.0\nSCPY \"{text}\", VB0\n");
        let (each, _, _) = of_op(Op::Scpy).unwrap().each.unwrap();
        assert_eq!(most(&copy("abcdef")) - most(&copy("ab")), 4 * each);
    }

    #[test]
    fn a_pointer_takes_longer_than_an_address() {
        let direct = most("LD SM0.0\nMOVD VD0, VD4\n");
        assert_eq!(most("LD SM0.0\nMOVD &VB0, AC1\nMOVD *AC1, VD4\n"), direct + POINTER[1]);
        assert_eq!(most("LD SM0.0\nMOVD 100000, VD4\n"), direct + CONSTANT);
    }

    #[test]
    fn what_needs_no_module_is_not_known_here() {
        assert_eq!(ways_of("LD SM0.0\nMOVW VW0, VW4\n"), Ways::default());
    }
}
