//! Where networks and rungs begin and end. What is in a rung is not known here.

use std::collections::HashSet;

use awl_asm::ast::{Instruction, Statement};
use awl_asm::diagnostic::Code;
use diagnostics::Severity;
use plc_isa::{Op, Rung as Part};

use super::obstacle::Obstacle;
use super::sheet::Sheet;

/// A network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Network {
    /// Its number; without a NETWORK line there is none.
    pub number: Option<u32>,
    /// Its title.
    pub title: String,
    /// Its first and last line, from 1.
    pub lines: (usize, usize),
    /// Its rungs.
    pub rungs: Vec<Rung>,
}

/// A rung: from what loads the first value to the last output. One that can be drawn begins at the
/// rail.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rung {
    /// Its first and last line, from 1; comments after it belong to it.
    pub lines: (usize, usize),
    /// The line of the LSCR whose segment it is in: its bit powers the rail.
    pub segment: Option<usize>,
    /// The statements of the program that it has.
    pub(crate) statements: std::ops::Range<usize>,
}

/// Divides a program.
pub(super) fn networks(sheet: Sheet<'_>) -> Vec<Network> {
    let mut open = Open { end: sheet.source.line_count(), ..Open::default() };
    for (index, statement) in sheet.assembly.program.statements.iter().enumerate() {
        let line = |at: u32| sheet.source.position(at as usize).0;
        match statement {
            Statement::Unit(unit) => {
                open.close(line(unit.span.start));
                open.segment = None;
            }
            Statement::Network(network) => {
                let at = line(network.span.start);
                open.close(at);
                open.begin(Some(network.number), network.title.clone(), at);
            }
            Statement::Instruction(one) => open.add(index, one, line(one.span.start)),
        }
    }
    open.close(open.end + 1);
    open.done
}

/// What is not at its end.
#[derive(Default)]
struct Open {
    done: Vec<Network>,
    network: Option<Network>,
    /// Whether the next instruction begins a rung whatever it is, and whether a load does.
    is_alone: bool,
    is_driven: bool,
    segment: Option<usize>,
    /// The last line.
    end: usize,
}

impl Open {
    fn begin(&mut self, number: Option<u32>, title: String, line: usize) {
        self.network = Some(Network { number, title, lines: (line, line), rungs: Vec::new() });
    }

    /// Ends what is open before a line.
    fn close(&mut self, line: usize) {
        let Some(mut network) = self.network.take() else { return };
        network.lines.1 = (line - 1).max(network.lines.0);
        if let Some(rung) = network.rungs.last_mut() {
            rung.lines.1 = network.lines.1.max(rung.lines.0);
        }
        self.done.push(network);
    }

    fn add(&mut self, index: usize, one: &Instruction, line: usize) {
        if self.network.is_none() {
            self.begin(None, String::new(), line);
        }
        let is_bare = is_bare(one);
        let Some(network) = &mut self.network else { return };
        let begins = is_bare
            || self.is_alone
            || self.is_driven && one.entry.rung == Part::Loads
            || network.rungs.is_empty();
        match network.rungs.last_mut() {
            Some(rung) if !begins => {
                (rung.statements.end, rung.lines.1) = (index + 1, line);
            }
            last => {
                if let Some(rung) = last {
                    rung.lines.1 = (line - 1).max(rung.lines.0);
                }
                let segment = self.segment.filter(|_| one.entry.op != Op::Scre);
                let rung = Rung { lines: (line, line), segment, statements: index..index + 1 };
                network.rungs.push(rung);
            }
        }
        (self.is_alone, self.is_driven) = (is_bare, !one.entry.rung.is_contact());
        match one.entry.op {
            Op::Lscr => self.segment = Some(line),
            Op::Scre => self.segment = None,
            _ => {}
        }
    }
}

/// Whether an instruction asks nothing of the logic stack and leaves nothing for others: it is at
/// the rail alone.
fn is_bare(one: &Instruction) -> bool {
    one.entry.rung == Part::Drives && one.entry.stack.needs == 0
}

/// Whether all lines of a rung were understood: one with an error and without an instruction is
/// not drawn, and what is around it would be wrong.
pub(super) fn check(sheet: Sheet<'_>, rung: &Rung) -> Result<(), (usize, Obstacle)> {
    let line_of = |at: u32| sheet.source.position(at as usize).0;
    let statements = sheet.assembly.program.statements.get(rung.statements.clone());
    let lines: HashSet<usize> = statements
        .into_iter()
        .flatten()
        .filter_map(|statement| match statement {
            Statement::Instruction(one) => Some(line_of(one.span.start)),
            _ => None,
        })
        .collect();
    let errors = sheet.assembly.diagnostics.iter();
    for error in errors.filter(|one| one.severity() == Severity::Error) {
        let line = line_of(error.span.start);
        let is_inside = (rung.lines.0..=rung.lines.1).contains(&line);
        let is_guess = matches!(error.code, Code::UnknownMnemonic | Code::NotSupported);
        if is_inside && (is_guess || !lines.contains(&line)) {
            return Err((line, Obstacle::NotUnderstood(error.message.clone())));
        }
    }
    Ok(())
}
