//! Whether an element is read as it is written: what a person writes into it, such as a condition,
//! must not become something else in the text.

use diagnostics::{Source, Span};
use st::keywords::is_keyword;
use st::names::is_name;
use st::parser::parse_expression;

use super::refusal::Refusal;
use crate::model::{Action, Chart, Code, Origin, Step, Transition};
use crate::text::{Document, Piece, read, write};

/// A chart for one element.
pub(super) struct Legible<'c> {
    chart: &'c Chart,
}

impl Legible<'_> {
    /// Elements of this chart.
    pub(super) fn of(chart: &Chart) -> Legible<'_> {
        Legible { chart }
    }

    fn alone(&self) -> Chart {
        let mut alone = Chart::new("Alone");
        alone.standard = self.chart.standard;
        alone
    }

    /// Checks a step with its block.
    pub(super) fn step(&self, step: &Step) -> Result<(), Refusal> {
        let mut alone = self.alone();
        let id = alone.add_step(Step::default());
        let mut own = step.clone();
        for instance in &mut own.block {
            let name = self.chart.actions.get(&instance.action).map_or("", |one| &one.name);
            instance.action = alone
                .action_named(name)
                .unwrap_or_else(|| alone.add_action(Action::variable(name, Origin::default())));
        }
        alone.steps.insert(id, own);
        check(alone, &step.name)
    }

    /// Checks a transition, apart from its steps.
    pub(super) fn transition(&self, one: &Transition) -> Result<(), Refusal> {
        let mut alone = self.alone();
        let [a, b] = ["A", "B"]
            .map(|name| alone.add_step(Step { name: name.to_owned(), ..Step::default() }));
        let (from, to) = ([a].into(), [b].into());
        alone.add_transition(Transition { from, to, ..one.clone() });
        check(alone, &self.chart.transition_title(one))
    }
}

fn check(chart: Chart, what: &str) -> Result<(), Refusal> {
    let wanted = Document { pieces: vec![Piece::Chart(chart)] };
    let refused = |message| Err(Refusal::Illegible { what: what.to_owned(), message });
    let Ok(source) = Source::new("Alone.sfc", write(&wanted)) else { return refused(None) };
    let reading = read(&source);
    if let Some(first) = reading.diagnostics.into_iter().next() {
        return refused(Some(first.message));
    }
    if reading.document == wanted { Ok(()) } else { refused(None) }
}

/// A text that a person wrote as an expression; `what` it is for.
pub(super) fn expression(text: &str, what: &str) -> Result<Code, Refusal> {
    let text = text.trim();
    let (_, found) = parse_expression(text, Span::new(0, text.len()));
    match found.into_iter().next() {
        None => Ok(Code::new(text)),
        Some(first) => Err(Refusal::Code { what: what.to_owned(), message: first.message }),
    }
}

/// The words of charts, beside those of Structured Text.
const WORDS: [&str; 9] = [
    "STEP",
    "INITIAL_STEP",
    "END_STEP",
    "TRANSITION",
    "END_TRANSITION",
    "ACTION",
    "END_ACTION",
    "FROM",
    "PRIORITY",
];

/// Whether a text can be a name.
pub(super) fn check_name(name: &str) -> Result<(), Refusal> {
    if !is_name(name) {
        return Err(Refusal::NotAName(name.to_owned()));
    }
    let is_word = is_keyword(name) || WORDS.iter().any(|word| word.eq_ignore_ascii_case(name));
    if is_word { Err(Refusal::Keyword(name.to_owned())) } else { Ok(()) }
}
