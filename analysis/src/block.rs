//! Function blocks of IEC 61499: what editors ask about a file with one. Its XML is read by the
//! language itself.

use diagnostics::Severity;
use fb::xml::{read, write};

use crate::answer::{Completion, Outline, OutlineKind, Problem, Refusal};
use crate::language::{Text, View};
use crate::structured::StructuredText;
use crate::subject::Mention;

/// A block as its reader reads it.
pub(crate) struct Block;

impl Text for Block {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        StructuredText.problems(view)
    }

    fn mentions(&self, _: View<'_>) -> Vec<Mention> {
        Vec::new()
    }

    fn word_at(&self, _: View<'_>, _: usize) -> Option<Mention> {
        None
    }

    fn completions(&self, _: View<'_>, _: usize) -> Vec<Completion> {
        Vec::new()
    }

    fn outline(&self, view: View<'_>) -> Vec<Outline> {
        let Some(block) = read(view.source).block else { return Vec::new() };
        let events = block.event_inputs.iter().chain(&block.event_outputs);
        let events = events.map(|event| part(&event.name, "event"));
        let variables = block.variables().map(|variable| part(&variable.name, "variable"));
        let states = block.states.iter().map(|state| part(&state.name, "state"));
        let algorithms = block.algorithms.iter();
        let algorithms = algorithms.map(|algorithm| part(&algorithm.name, "algorithm"));
        let children = events.chain(variables).chain(states).chain(algorithms).collect();
        let whole = part(&block.name, "FUNCTION_BLOCK");
        vec![Outline { kind: OutlineKind::Unit, children, ..whole }]
    }

    fn formatted(&self, view: View<'_>) -> Result<String, Refusal> {
        let read = read(view.source);
        let mut errors = read.diagnostics.iter();
        let first = errors.find(|one| one.severity() == Severity::Error);
        let why = first.map(|one| one.message.as_str()).unwrap_or_default();
        let block = read.block.ok_or_else(|| Refusal(format!("the file has errors: {why}")))?;
        Ok(write(&block))
    }

    fn written(&self, name: &str) -> String {
        name.to_owned()
    }
}

fn part(name: &fb::model::Text, detail: &str) -> Outline {
    Outline::declared(&name.text, detail, name.span)
}
