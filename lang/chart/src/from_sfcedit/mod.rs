//! Charts of SFCEdit as a program that runs here: a GRAFCET as text, with its variables. What is
//! the same the set/reset way, such as the kinds of variables, comes from [`crate::set_reset`].

mod actions;
mod charts;
mod devices;
mod names;
mod orders;

use diagnostics::traced::Traced;
use diagnostics::xml::Places;
use diagnostics::{Severity, Span};

use crate::diagnostic::{Code, Diagnostic};
use crate::set_reset::targets::{declared, distinct, plain_groups};
use crate::set_reset::variables::Table;
use crate::set_reset::{Style, assembled};
use crate::sfcedit::Project;
use crate::sfcedit::document::{Grafcet, GrafcetKind};
use crate::text::write_chart;

use charts::Writer;
use names::Names;

/// A program.
#[derive(Debug, Default)]
pub struct Program {
    /// As `.sfc` has it; empty where there are errors.
    pub text: Traced,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// The program of the charts of a file.
pub fn program(project: &Project, table: &Table) -> Program {
    let (plan, mut diagnostics) = assembled(project, table, Style::Grafcet);
    let is_first = |one: &&Grafcet| one.kind == GrafcetKind::Normal;
    let Some(first) = project.grafcets.iter().find(is_first) else {
        let span = project.grafcets.first().map_or(Span::default(), |one| one.name.span);
        let none = Diagnostic::new(Code::XmlStructure, span, "there is no chart by itself");
        diagnostics.push(none.help("one <grafcet> is neither of a macro-step nor enclosed"));
        return Program { text: Traced::default(), diagnostics };
    };
    let mut names = Names::of(&plan);
    names.check_signals(first.name.span, &mut diagnostics);
    if has_errors(&diagnostics) {
        return Program { text: Traced::default(), diagnostics };
    }
    let mut writer = Writer { project, plan: &plan, names: &mut names, diagnostics };
    let (chart, calls) = writer.program(first);
    let diagnostics = writer.diagnostics;
    if has_errors(&diagnostics) {
        return Program { text: Traced::default(), diagnostics };
    }
    let whole = first.name.span;
    let mut text = Traced::default();
    text.push(&format!("PROGRAM {}\n", chart.name), whole);
    let written = write_chart(&chart);
    let start = text.text().len();
    text.push(&written.text, whole);
    for part in written.parts {
        let (from, to) = (part.written.start as usize, part.written.end as usize);
        text.trace(Span::new(start + from, start + to), &Places::whole(part.origin));
    }
    text.push("END_PROGRAM\n", whole);
    if !calls.is_empty() {
        let name = names.fresh(&format!("{}_devices", chart.name));
        text.push(&format!("\nPROGRAM {name}\n{calls}END_PROGRAM\n"), whole);
    }
    let mut plan = distinct(&plan);
    plan.variables.retain(|one| !names.is_replaced(&one.name));
    let mut groups = plain_groups(&plan);
    groups.extend(names.added());
    if !groups.is_empty() {
        text.push(&format!("\n{}", declared(groups)), whole);
    }
    Program { text, diagnostics }
}

fn has_errors(found: &[Diagnostic]) -> bool {
    found.iter().any(|one| one.severity() == Severity::Error)
}
