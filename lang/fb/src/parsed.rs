//! The texts of a block as syntax trees: what its transitions ask for, what its algorithms do. It
//! knows no types.

use diagnostics::xml::Places;
use diagnostics::{Source, Span};
use st::parser::{parse_expression, parse_statements};
use st::tree::{Expression, Statement, StatementKind};
use st::visit;

use crate::condition::condition;
use crate::model::{Block, Text};

/// A transition, with numbers in place of names.
#[derive(Debug, Clone)]
pub struct Transition {
    /// The state that it leaves.
    pub source: usize,
    /// The state that it enters.
    pub destination: usize,
    /// The event that it needs.
    pub event: Option<usize>,
    /// The guard as written; `None`: there is none.
    pub guard_text: Option<String>,
    /// The guard.
    pub guard: Option<Expression>,
}

/// A block whose texts are read.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// Its transitions, in their order.
    pub transitions: Vec<Transition>,
    /// The statements of its algorithms, in their order. Places are those in their text.
    pub algorithms: Vec<Vec<Statement>>,
    /// What is wrong in texts, at its place in the file.
    pub diagnostics: Vec<st::Diagnostic>,
}

/// Reads the texts of a block without errors that was read from a file.
pub fn parse(block: &Block, file: &Source) -> Parsed {
    let mut parsed =
        Parsed { transitions: Vec::new(), algorithms: Vec::new(), diagnostics: Vec::new() };
    for transition in &block.transitions {
        let ends = block.state(&transition.source.text);
        let Some((source, destination)) = ends.zip(block.state(&transition.destination.text))
        else {
            continue;
        };
        let Ok(found) = condition(block, transition) else { continue };
        for span in &found.guards {
            let (_, wrong) = parse_expression(&transition.condition.text, *span);
            parsed.report(wrong, &transition.condition, file);
        }
        let guard_text = found.guard(&transition.condition.text);
        let guard = guard_text.as_deref().and_then(|text| {
            let whole = Span::new(0, text.len());
            parse_expression(text, whole).0
        });
        let event = found.event;
        parsed.transitions.push(Transition { source, destination, event, guard_text, guard });
    }
    for algorithm in &block.algorithms {
        let text = &algorithm.text;
        let (mut body, wrong) = parse_statements(&text.text, Span::new(0, text.text.len()));
        parsed.report(wrong, text, file);
        visit::statements(&mut body, &mut |statement| {
            if matches!(statement.kind, StatementKind::Return) {
                let message = "RETURN: an algorithm ends at its end";
                let help = "put what is to be left out into IF ... END_IF";
                let error = st::Diagnostic::new(st::Code::NotThere, statement.span, message);
                parsed.report(vec![error.help(help)], text, file);
            }
        });
        parsed.algorithms.push(body);
    }
    parsed
}

impl Parsed {
    fn report(&mut self, wrong: Vec<st::Diagnostic>, text: &Text, file: &Source) {
        let places = Places::of(&text.text, text.span, &file.text);
        for mut one in wrong {
            one.span = places.span(one.span);
            one.related.iter_mut().for_each(|(span, _)| *span = places.span(*span));
            self.diagnostics.push(one);
        }
    }
}
