//! Charts that are no sound SFC: those that do not have one initial step, and what belongs to
//! GRAFCET, which is read and written, but not translated yet.

use diagnostics::Span;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Body, Chart, Standard, Step, StepKind};

/// Reports what keeps a chart from being translated.
pub(super) fn check(chart: &Chart, first: Span, found: &mut Vec<Diagnostic>) {
    let is_grafcet = chart.standard == Standard::Grafcet;
    if is_grafcet {
        let message = "charts by the rules of GRAFCET cannot be translated yet";
        let help = "without {grafcet} the rules of SFC apply";
        found.push(Diagnostic::new(Code::NotThere, first, message).help(help));
    }
    let initial: Vec<&Step> = chart.steps.values().filter(|step| step.is_initial).collect();
    match initial[..] {
        [] => {
            let message = format!("{}: the chart has no initial step", chart.name);
            let help = "such as `INITIAL_STEP Start: END_STEP`";
            found.push(Diagnostic::new(Code::Initial, first, message).help(help));
        }
        [_] => {}
        [one, ref others @ ..] => {
            for other in others {
                let message = format!("{}: a second initial step", other.name);
                let twice = Diagnostic::new(Code::Initial, other.origin.0, message);
                found.push(twice.related(one.origin.0, "the first"));
            }
        }
    }
    for step in chart.steps.values() {
        elements_of_grafcet(step, found);
    }
    for transition in chart.transitions.values() {
        if let Some(code) = &transition.crossing {
            not_there(code.origin.0, "actions of transitions", found);
        }
    }
    for action in chart.actions.values() {
        // Of a GRAFCET with charts in it that is said once.
        if let Body::Chart(inner) = &action.body
            && !is_grafcet
        {
            check(inner, action.origin.0, found);
        }
    }
}

fn not_there(span: Span, what: &str, found: &mut Vec<Diagnostic>) {
    let message = format!("{what} belong to GRAFCET and cannot be translated yet");
    found.push(Diagnostic::new(Code::NotThere, span, message));
}

fn elements_of_grafcet(step: &Step, found: &mut Vec<Diagnostic>) {
    let what = match step.kind {
        StepKind::Plain => None,
        StepKind::Macro(_) => Some("macro-steps"),
        StepKind::Enclosing(_) => Some("enclosing steps"),
    };
    let what = what.or(step.is_linked.then_some("activation links"));
    if let Some(what) = what {
        not_there(step.origin.0, what, found);
    }
    for forcing in &step.forcings {
        not_there(forcing.origin.0, "forcing orders", found);
    }
    for instance in &step.block {
        let code = instance.condition.iter().chain(&instance.event).next();
        if let Some(code) = code {
            not_there(code.origin.0, "conditional actions and events", found);
        }
    }
}
