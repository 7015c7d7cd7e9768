//! Programs whose units are charts: what editors ask about one. What is around the charts, and the
//! code in them, is Structured Text.

use std::collections::HashSet;

use chart::model::Body;
use chart::text::{read, write};
use diagnostics::Severity;
use st::names::{Named, is_same};

use crate::answer::{Completion, Outline, OutlineKind, Problem, Refusal, Signature};
use crate::language::{Text, View};
use crate::structured::StructuredText;
use crate::subject::{Mention, Subject};

/// Charts as their reader reads them.
pub(crate) struct Charts;

impl Text for Charts {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        StructuredText.problems(view)
    }

    /// Those of variables: steps become others, which have no place here.
    fn mentions(&self, view: View<'_>) -> Vec<Mention> {
        let mut mentions = StructuredText.mentions(view);
        let mut known = HashSet::new();
        mentions.retain(|one| is_written(one, view.text()) && known.insert(one.span));
        mentions
    }

    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention> {
        StructuredText.word_at(view, offset)
    }

    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion> {
        StructuredText.completions(view, offset)
    }

    fn signature(&self, view: View<'_>, offset: usize) -> Option<Signature> {
        StructuredText.signature(view, offset)
    }

    fn outline(&self, view: View<'_>) -> Vec<Outline> {
        let reading = read(view.source);
        let charts = reading.document.charts().zip(&reading.regions);
        let charts = charts.map(|(chart, region)| {
            let steps = chart
                .steps
                .values()
                .map(|step| Outline::declared(&step.name, "STEP", step.origin.0));
            // Others are variables.
            let actions = chart.actions.values().filter(|one| one.body != Body::Variable);
            let actions =
                actions.map(|action| Outline::declared(&action.name, "ACTION", action.origin.0));
            Outline {
                name: chart.name.clone(),
                detail: "chart".to_owned(),
                kind: OutlineKind::Unit,
                span: region.span,
                name_span: region.first(),
                children: steps.chain(actions).collect(),
            }
        });
        charts.collect()
    }

    fn formatted(&self, view: View<'_>) -> Result<String, Refusal> {
        let reading = read(view.source);
        let mut errors = reading.diagnostics.iter();
        match errors.find(|one| one.severity() == Severity::Error) {
            Some(first) => Err(Refusal(format!("the text has errors of form: {}", first.message))),
            None => Ok(write(&reading.document)),
        }
    }

    fn written(&self, name: &str) -> String {
        name.to_owned()
    }
}

/// Whether a name is there as it is written: what becomes of a step has another one.
fn is_written(mention: &Mention, text: &str) -> bool {
    let name = match &mention.subject {
        Subject::Symbol(name) => name,
        Subject::Structured(
            Named::Global(name)
            | Named::Variable(_, name)
            | Named::Unit(name)
            | Named::Type(name)
            | Named::Member(_, name)
            | Named::Value(_, name)
            | Named::Routine(name)
            | Named::Address(name),
        ) => name,
        _ => return !mention.span.text(text).is_empty(),
    };
    is_same(mention.span.text(text), name)
}
