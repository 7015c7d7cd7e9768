//! Segments of a sequence that nothing switches on, and steps that no segment stands for and
//! nothing reads.

use std::collections::HashSet;

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::{short, told};
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Bits of the area S.
const BITS: u32 = 256;

/// Warns of LSCR whose bit nothing sets or segments that are never active alone, and of SCRT to a
/// bit without LSCR.
pub fn steps(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let bit_of = |selected: &Selected| match selected.arguments[0] {
        Argument::Bit(Address::Bit { area: Area::S, byte, bit }) => {
            Some(u32::from(byte) * 8 + u32::from(bit))
        }
        _ => None,
    };
    let segments: HashSet<u32> =
        code.iter().filter(|one| one.op == Op::Lscr).filter_map(bit_of).collect();
    if segments.is_empty() {
        return;
    }
    let steps = Steps::of(code);
    let reached = steps.reached();
    // Segments in a ring wait for one another: it is said of the first.
    let mut is_first = true;
    for selected in code {
        let (Some(number), Argument::Bit(address)) = (bit_of(selected), selected.arguments[0])
        else {
            continue;
        };
        let span = operand_span(program, selected, 0);
        let name = told(program, span, address);
        match selected.op {
            Op::Lscr if !steps.is_set(number) => {
                let message = format!("{name} is never set: this segment is never executed");
                let first = short(program, span, address);
                diagnostics.push(Diagnostic::new(Code::NeverActive, span, message).help(format!(
                    "a sequence begins in the first scan: `LD SM0.1`, `S {first}, 1`; other steps \
                     are reached by `SCRT {first}`"
                )));
            }
            Op::Lscr if !reached.contains(&number) && std::mem::take(&mut is_first) => {
                let message = format!(
                    "{name} is set by segments alone that are never active: no step is the first"
                );
                let first = short(program, span, address);
                diagnostics.push(Diagnostic::new(Code::NeverActive, span, message).help(format!(
                    "a sequence begins in the first scan: `LD SM0.1`, `S {first}, 1`"
                )));
            }
            Op::Scrt if !segments.contains(&number) && !steps.is_read(number) => {
                let message = format!("{name} has no segment: the sequence ends here");
                let step = short(program, span, address);
                diagnostics.push(Diagnostic::new(Code::NeverActive, span, message).help(format!(
                    "the segment of the step is between `LSCR {step}` and `SCRE`; a sequence that \
                     shall end is reset by `R`"
                )));
            }
            _ => {}
        }
    }
}

/// Which bits of S something may set, and which a contact reads: what waits for several steps needs
/// no segment of them.
#[derive(Default)]
struct Steps {
    /// Each with the segment that sets it; `None`: outside of all.
    set: HashSet<(Option<u32>, u32)>,
    read: HashSet<u32>,
    /// Something may set, or reads, any of them.
    any_set: bool,
    any_read: bool,
}

impl Steps {
    fn of(code: &[Selected]) -> Steps {
        let mut steps = Steps::default();
        let mut segment = None;
        for selected in code {
            if selected.op == Op::Scre {
                segment = None;
            }
            for (argument, written) in selected.arguments() {
                match argument {
                    Argument::Bit(Address::Bit { area: Area::S, byte, bit }) => {
                        let number = u32::from(byte) * 8 + u32::from(bit);
                        steps.bit(selected, number, written, segment);
                        if selected.op == Op::Lscr {
                            segment = Some(number);
                        }
                    }
                    Argument::Memory(address) | Argument::Pointer(address)
                        if address.area() == Some(Area::S) =>
                    {
                        let is_pointer = matches!(argument, Argument::Pointer(_));
                        steps.any_set |= written || is_pointer;
                        steps.any_read |= !written || is_pointer;
                    }
                    _ => {}
                }
            }
        }
        steps
    }

    fn bit(&mut self, selected: &Selected, first: u32, written: bool, segment: Option<u32>) {
        let count = match (selected.op, selected.arguments[1]) {
            (Op::Reset | Op::Lscr, _) => return,
            (Op::Set, Argument::Constant(count)) => u32::from(count),
            (Op::Assign | Op::Scrt, _) => 1,
            _ if !written => {
                self.read.insert(first);
                return;
            }
            _ => BITS,
        };
        let bits = first..(first + count).min(BITS);
        self.set.extend(bits.map(|bit| (segment, bit)));
    }

    /// The bits that something sets that is executed: outside of segments, or in one that is
    /// active at some time.
    fn reached(&self) -> HashSet<u32> {
        let mut reached: HashSet<u32> = HashSet::new();
        if self.any_set {
            reached.extend(0..BITS);
        }
        loop {
            let is_active =
                |segment: &Option<u32>| segment.is_none_or(|one| reached.contains(&one));
            let next: Vec<u32> = self
                .set
                .iter()
                .filter(|(segment, _)| is_active(segment))
                .map(|(_, bit)| *bit)
                .collect();
            let before = reached.len();
            reached.extend(next);
            if reached.len() == before {
                return reached;
            }
        }
    }

    fn is_set(&self, bit: u32) -> bool {
        self.any_set || self.set.iter().any(|(_, set)| *set == bit)
    }

    fn is_read(&self, bit: u32) -> bool {
        self.any_read || self.read.contains(&bit)
    }
}
