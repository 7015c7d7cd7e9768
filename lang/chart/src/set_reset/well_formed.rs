//! What a chart must have: steps and transitions that are joined, an initial step, and for the
//! set/reset way nothing but normal steps.

use diagnostics::Span;

use super::assemble::Style;
use crate::diagnostic::{Code, Diagnostic};
use crate::sfcedit::document::{Grafcet, GrafcetKind, Step, StepKind};
use crate::sfcedit::wiring::Wiring;

fn error(code: Code, span: Span, message: String, help: &str) -> Diagnostic {
    Diagnostic::new(code, span, message).help(help)
}

/// What is no chart or step of a style.
pub(super) fn not_in_style(
    grafcet: &Grafcet,
    wiring: &Wiring,
    style: Style,
    found: &mut Vec<Diagnostic>,
) {
    if style == Style::SetReset && grafcet.kind != GrafcetKind::Normal {
        let message = format!("{}: the chart of another step", grafcet.name.text);
        let help = "not in this style of chart: there are no macro-steps and enclosing steps";
        found.push(error(Code::NotInStyle, grafcet.name.span, message, help));
    }
    found.extend(wiring.steps.iter().filter_map(|step| odd(step, style)));
}

fn odd(step: &Step, style: Style) -> Option<Diagnostic> {
    let what = match step.kind {
        StepKind::Normal | StepKind::Initial => return None,
        StepKind::Task => "a task",
        _ if style == Style::Grafcet => return None,
        StepKind::Final => "a final step",
        StepKind::Macro => "a macro-step",
        StepKind::Enclosing | StepKind::InitialEnclosing => "an enclosing step",
    };
    let message = format!("{}: {what}", step.name.text);
    let help = match style {
        Style::SetReset => "not in this style of chart: steps are normal or initial",
        Style::Grafcet => "GRAFCET has none: a macro-step stands for a chart of its own",
    };
    Some(error(Code::NotInStyle, step.name.span, message, help))
}

/// What is not joined. A chart of the set/reset way goes round.
pub(super) fn well_formed(
    grafcet: &Grafcet,
    wiring: &Wiring,
    style: Style,
    found: &mut Vec<Diagnostic>,
) {
    if style == Style::SetReset {
        goes_round(grafcet, wiring, found);
    }
    for wired in &wiring.transitions {
        let title = format!("transition {}", wired.transition.condition.text());
        for (steps, side) in [(&wired.from, "before"), (&wired.to, "after")] {
            if steps.is_empty() {
                let message = format!("{title}: there is no step {side} it");
                let help = "a sequence, a link or a jump joins it with one";
                found.push(error(Code::XmlStructure, wired.transition.span, message, help));
            }
        }
    }
}

fn goes_round(grafcet: &Grafcet, wiring: &Wiring, found: &mut Vec<Diagnostic>) {
    if wiring.jumps == 0 {
        let message = format!("{}: there is no jump", grafcet.name.text);
        let help = "the last transition jumps back: <jump seqid_from=\"...\" seqid_to=\"...\"/>";
        found.push(error(Code::XmlStructure, grafcet.name.span, message, help));
    }
    if !wiring.steps.iter().any(|step| step.kind.is_initial()) {
        let message = format!("{}: there is no initial step", grafcet.name.text);
        let help = "the step that is active at the beginning has type=\"initial\"";
        found.push(error(Code::XmlStructure, grafcet.name.span, message, help));
    }
    for (at, step) in wiring.steps.iter().enumerate() {
        let enters = wiring.transitions.iter().any(|wired| wired.to.contains(&at));
        let leaves = wiring.transitions.iter().any(|wired| wired.from.contains(&at));
        for (is_there, words) in [(enters, "leads to it"), (leaves, "leaves it")] {
            if !is_there {
                let message = format!("step {}: no transition {words}", step.name.text);
                let help = "a sequence, a link or a jump joins it with one";
                found.push(error(Code::XmlStructure, step.name.span, message, help));
            }
        }
    }
}
