//! Segments of a sequence that nothing switches on, and steps that no segment stands for.

use std::collections::HashSet;

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::{short, told};
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Bits of the area S.
const BITS: u32 = 256;

/// Warns of LSCR whose bit nothing sets, and of SCRT to a bit without LSCR.
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
    let set = Set::of(code);
    for selected in code {
        let (Some(number), Argument::Bit(address)) = (bit_of(selected), selected.arguments[0])
        else {
            continue;
        };
        let span = operand_span(program, selected, 0);
        let name = told(program, span, address);
        match selected.op {
            Op::Lscr if !set.has(number) => {
                let message = format!("{name} is never set: this segment is never executed");
                let first = short(program, span, address);
                diagnostics.push(Diagnostic::new(Code::NeverActive, span, message).help(format!(
                    "a sequence begins in the first scan: `LD SM0.1`, `S {first}, 1`; other steps \
                     are reached by `SCRT {first}`"
                )));
            }
            Op::Scrt if !segments.contains(&number) => {
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

/// Which bits of S something may set.
struct Set {
    bits: HashSet<u32>,
    /// Something may set any of them.
    any: bool,
}

impl Set {
    fn of(code: &[Selected]) -> Set {
        let mut set = Set { bits: HashSet::new(), any: false };
        for selected in code {
            for (argument, written) in selected.arguments() {
                match (argument, selected.op) {
                    (_, Op::Reset | Op::Lscr) => {}
                    (Argument::Bit(Address::Bit { area: Area::S, byte, bit }), op)
                        if written || op == Op::Scrt =>
                    {
                        let first = u32::from(byte) * 8 + u32::from(bit);
                        let count = match (op, selected.arguments[1]) {
                            (Op::Set, Argument::Constant(count)) => u32::from(count),
                            (Op::Assign | Op::Scrt, _) => 1,
                            _ => BITS,
                        };
                        set.bits.extend(first..(first + count).min(BITS));
                    }
                    (Argument::Memory(address), _) if written => {
                        set.any |= address.area() == Some(Area::S);
                    }
                    (Argument::Pointer(address), _) => set.any |= address.area() == Some(Area::S),
                    _ => {}
                }
            }
        }
        set
    }

    fn has(&self, bit: u32) -> bool {
        self.any || self.bits.contains(&bit)
    }
}
