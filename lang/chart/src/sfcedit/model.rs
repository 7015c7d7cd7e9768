//! The charts of a file in the model of all charts. Conditions and actions stay as they are
//! written: what they mean is said by those who translate them.

use std::collections::{BTreeSet, HashMap};

use super::document::{ActionKind, Grafcet, Project};
use super::wiring::wire;
use crate::diagnostic::Diagnostic;
use crate::model::{
    Action, ActionId, Body, Chart, Code, Instance, Origin, Qualifier, Standard, Step, StepId,
    Transition,
};

/// The charts; what does not fit together is reported.
pub fn charts(project: &Project, diagnostics: &mut Vec<Diagnostic>) -> Vec<Chart> {
    project.grafcets.iter().map(|grafcet| chart(grafcet, diagnostics)).collect()
}

fn chart(grafcet: &Grafcet, diagnostics: &mut Vec<Diagnostic>) -> Chart {
    let wiring = wire(grafcet, diagnostics);
    let mut chart = Chart::new(&grafcet.name.text);
    chart.standard = Standard::Grafcet;
    let mut actions: HashMap<String, ActionId> = HashMap::new();
    let mut steps: Vec<StepId> = Vec::new();
    for step in &wiring.steps {
        let block = step.actions.iter().map(|action| {
            let name = action.text.text();
            let id = *actions.entry(name.clone()).or_insert_with(|| {
                let origin = Origin(action.text.span);
                let comment = action.comment.clone();
                chart.add_action(Action { name, body: Body::Variable, comment, origin })
            });
            let qualifier = match action.kind {
                ActionKind::Activation => Qualifier::P1,
                ActionKind::Deactivation => Qualifier::P0,
                _ => Qualifier::N,
            };
            let condition = action.condition.as_ref().map(|words| Code::new(words.text()));
            let (condition, event) = match action.kind {
                ActionKind::Event => (None, condition),
                _ => (condition, None),
            };
            let origin = Origin(action.span);
            Instance { qualifier, condition, event, origin, ..Instance::new(id) }
        });
        let block = block.collect();
        steps.push(chart.add_step(Step {
            name: step.name.text.clone(),
            is_initial: step.kind.is_initial(),
            block,
            comment: step.comment.clone(),
            origin: Origin(step.span),
            ..Step::default()
        }));
    }
    let ids = |all: &[usize]| all.iter().map(|at| steps[*at]).collect::<BTreeSet<StepId>>();
    for wired in &wiring.transitions {
        chart.add_transition(Transition {
            from: ids(&wired.from),
            to: ids(&wired.to),
            condition: Code::new(wired.transition.condition.text()),
            comment: wired.transition.comment.text(),
            origin: Origin(wired.transition.span),
            ..Transition::default()
        });
    }
    chart
}
