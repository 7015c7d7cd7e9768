//! Outputs that are on while their segment is off: after NOT. Which segments there are, and what
//! may be in them, is checked elsewhere.

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::segments::is_or;
use crate::meaning::selected::{Argument, Selected, is_contact, is_load, span_of};
use crate::meaning::units::Units;
use crate::text::ast::Program;

/// What a level of the logic stack can be while the segment is off.
#[derive(Debug, Clone, Copy)]
struct Level {
    /// It can be 1; the NOT that made it so.
    on: Option<usize>,
    /// It can be 0.
    off: bool,
}

/// A load gives 0 in a segment that is off.
const OFF: Level = Level { on: None, off: true };

/// Warns of them.
pub(super) fn inactive_outputs(
    program: &Program,
    code: &[Selected],
    units: &Units,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for part in &units.parts {
        let mut segment: Option<Segment> = None;
        for index in part.code.clone() {
            let selected = &code[index];
            match selected.op {
                Op::Lscr => {
                    segment = Some(Segment { bit: selected.arguments[0], levels: vec![OFF] });
                }
                Op::Scre => segment = None,
                _ => {
                    let not = segment.as_mut().and_then(|segment| segment.follow(index, selected));
                    diagnostics.extend(not.map(|not| warning(program, selected, &code[not])));
                }
            }
        }
    }
}

fn warning(program: &Program, output: &Selected, not: &Selected) -> Diagnostic {
    let name = output.op.instruction().mnemonic();
    let message = format!("{name} has power flow here while its segment is off, because of NOT");
    Diagnostic::new(Code::InactiveOutput, span_of(program, output), message)
        .related(span_of(program, not), "0 becomes 1 here")
        .help("in a segment that is off a load gives 0, whatever it loads: invert it by LDN or AN")
}

/// A segment that is off, instruction by instruction.
struct Segment {
    /// Its S bit.
    bit: Argument,
    /// The logic stack, the top last.
    levels: Vec<Level>,
}

impl Segment {
    /// Follows an instruction. An output that can be on: the NOT that makes it so.
    fn follow(&mut self, index: usize, selected: &Selected) -> Option<usize> {
        let top = self.level(0);
        match selected.op {
            op if is_load(op) => self.levels.push(OFF),
            // What lies parallel gives 0 and takes nothing away.
            op if is_or(op) => {}
            Op::Not => self.set_top(Level { on: top.off.then_some(index), off: top.on.is_some() }),
            Op::A if selected.arguments[0] == self.bit => self.set_top(OFF),
            Op::Ald | Op::Old => self.combine(selected.op),
            Op::Lps => self.levels.push(top),
            Op::Lrd => self.set_top(self.level(1)),
            Op::Lpp => _ = self.levels.pop(),
            Op::Lds => {
                let Argument::Number(level) = selected.arguments[0] else { return None };
                self.levels.push(self.level(level.into()));
            }
            Op::Nop | Op::Lbl | Op::Cscre | Op::CallBegin => {}
            op if is_contact(op) => self.set_top(Level { off: true, ..top }),
            // What is hidden before an instruction is said of that.
            _ if selected.parameter.is_some() => {}
            _ => {
                // Once for what follows one another.
                self.set_top(OFF);
                return top.on;
            }
        }
        None
    }

    /// Level `number`, 0 for the top.
    fn level(&self, number: usize) -> Level {
        self.levels.iter().rev().nth(number).copied().unwrap_or(OFF)
    }

    fn set_top(&mut self, level: Level) {
        self.levels.pop();
        self.levels.push(level);
    }

    fn combine(&mut self, op: Op) {
        let (a, b) = (self.level(0), self.level(1));
        self.levels.pop();
        self.set_top(match op {
            Op::Ald => Level { on: a.on.and(b.on), off: a.off || b.off },
            _ => Level { on: a.on.or(b.on), off: a.off && b.off },
        });
    }
}
