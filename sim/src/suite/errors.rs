//! What is wrong with programs and scenarios, and errors that end a command or the test of a
//! scenario, as people and programs read them.

use crate::open::{Findings, OpenError};
use crate::plant::file::PlantErrors;
use crate::problem::Problems;
use anyhow::Error;
use awl_asm::report::{Messages, Report, human};
use awl_asm::source::Source;

/// Exit code for usage, file and program errors.
pub const CANNOT_RUN: u8 = 2;

/// What the assembler has found, as `awl-asm` shows it, with terminal colours.
pub fn shown(findings: &[Findings]) -> String {
    let all = findings.iter().map(|one| human(&one.source, one.diagnostics.iter(), true));
    all.collect()
}

/// Shows what the assembler has found.
pub fn show(findings: &[Findings], messages: Messages) {
    let mut report = Report::new(messages, false);
    for Findings { source, diagnostics } in findings {
        report.show(source, diagnostics);
    }
    if let Some(last) = findings.last().filter(|_| !report.is_good()) {
        report.finish(&last.source);
    }
}

/// Shows the error that ends a command.
pub fn show_error(error: &Error, messages: Messages) {
    if let Some(OpenError::Errors(findings)) = error.downcast_ref() {
        return show(findings, messages);
    }
    if let Some(errors) = error.downcast_ref::<PlantErrors>()
        && let Ok(source) = Source::new(&errors.name, &errors.text)
    {
        return Report::new(messages, false).show(&source, &errors.diagnostics);
    }
    let problems = error.downcast_ref::<Problems>();
    let problems = problems.and_then(|all| Some((all, Source::new(&all.origin, &all.text).ok()?)));
    match problems {
        Some((all, source)) => Report::new(messages, false).show(&source, &all.diagnostics()),
        None => anstream::eprint!("{}", told(error)),
    }
}

/// An error as people read it, with terminal colours. Ends with a line feed.
pub fn told(error: &Error) -> String {
    if let Some(errors) = error.downcast_ref::<PlantErrors>() {
        errors.render(true)
    } else if let Some(problems) = error.downcast_ref::<Problems>() {
        problems.render(true)
    } else if let Some(OpenError::Errors(findings)) = error.downcast_ref() {
        shown(findings)
    } else {
        format!("error: {error:#}\n")
    }
}
