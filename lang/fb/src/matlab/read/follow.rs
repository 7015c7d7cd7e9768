//! Lines that follow from others: they are compared with those that would be written.

use diagnostics::Span;

use super::lines::{Line, lines, sections};
use crate::diagnostic::{Code, Diagnostic};
use crate::matlab::vocabulary::BEFORE;
use crate::matlab::write::again;
use crate::model::Block;

/// Lines that follow from what was read and say something else.
pub(super) fn what_follows(block: &Block, text: &str) -> Vec<Diagnostic> {
    let written = again(block, text);
    let (Ok(found), Ok(wanted)) = (sections(text), sections(&written)) else { return Vec::new() };
    let mut different = Vec::new();
    for number in [3, 4, 5, 6, 8, 9, 10] {
        let part = |all: &[Span]| all.get(number).copied().unwrap_or_default();
        let (part, should) = (part(&found), part(&wanted));
        let lines_of = |text, part| -> Vec<Line> {
            let all = lines(text, part).into_iter().filter(|line| !line.code.is_empty());
            let end = all.collect::<Vec<_>>();
            // What is after the block's function are functions of ST.
            let count = if number == 10 { 1 } else { end.len() };
            end.into_iter().take(count).collect()
        };
        let (there, should) = (lines_of(text, part), lines_of(&written, should));
        let count = there.len().max(should.len());
        let differs = (0..count).find(|at| !is_same(there.get(*at), should.get(*at)));
        let Some(at) = differs else { continue };
        let place = there.get(at).map_or(Span { start: part.end, end: part.end }, |line| line.span);
        let message = match (there.get(at), should.get(at)) {
            (Some(_), Some(_)) => "this does not follow from the sections before",
            (Some(_), None) => "this is more than the sections before say",
            _ => "something is missing here that the sections before say",
        };
        let mut error = Diagnostic::new(Code::BrokenMatlab, place, message);
        error.help.extend(should.get(at).map(|line| format!("`{}` is what they say", line.code)));
        different.push(error);
    }
    different
}

/// Whether two lines say the same. Guards can be written in more than one way.
fn is_same(there: Option<&Line>, should: Option<&Line>) -> bool {
    let (Some(there), Some(should)) = (there, should) else { return false };
    let state = format!("if {BEFORE}(");
    if !there.code.starts_with(&state) {
        return there.code == should.code;
    }
    let others = |code: &str| code.split(" && ").filter(|one| one.starts_with("~E(")).count();
    should.code.starts_with(&state) && others(there.code) == others(should.code)
}
