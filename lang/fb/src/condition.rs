//! What the condition of a transition says: which event, and which guard. Files write `CU`,
//! `CU[CV < 65535]`, `[guard]`, `1`, and as expressions `CU AND guard`, `START AND CU` with the
//! name of the state that is left. What a guard means is Structured Text's business.

use diagnostics::Span;
use st::parser::parse_expression;
use st::tree::{BinaryOperator, Expression, ExpressionKind};
use st::visit;

use crate::check::is_name;
use crate::model::{Block, Transition};

/// When a transition clears: the event is there, and all guards hold.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Condition {
    /// The number of the event among the block's; `None`: none is needed.
    pub event: Option<usize>,
    /// Where in the text the guards are.
    pub guards: Vec<Span>,
}

impl Condition {
    /// Whether it holds whatever happens.
    pub fn is_always(&self) -> bool {
        self.event.is_none() && self.guards.is_empty()
    }

    /// The guards as one expression.
    pub fn guard(&self, text: &str) -> Option<String> {
        match self.guards.as_slice() {
            [] => None,
            [only] => Some(only.text(text).trim().to_owned()),
            all => {
                let all: Vec<String> =
                    all.iter().map(|one| format!("({})", one.text(text).trim())).collect();
                Some(all.join(" AND "))
            }
        }
    }
}

/// What is wrong with a condition.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wrong {
    /// There is nothing.
    Empty,
    /// `[` without `]` at the end.
    Open,
    /// A name that is no event, at a place in the text.
    NoEvent(Span),
    /// A second event.
    Second(Span),
    /// An event in an expression that is more than a sequence of AND.
    Inside(Span),
}

/// Reads the condition of a transition. Guards that are no expressions are found when they are
/// parsed.
pub(crate) fn condition(block: &Block, transition: &Transition) -> Result<Condition, Wrong> {
    let text = transition.condition.text.as_str();
    if text.trim().is_empty() {
        return Err(Wrong::Empty);
    }
    if let Some(found) = in_brackets(block, text) {
        return found;
    }
    let whole = Span::new(0, text.len());
    let (expression, wrong) = parse_expression(text, whole);
    let Some(expression) = expression.filter(|_| wrong.is_empty()) else {
        return Ok(Condition { event: None, guards: vec![whole] });
    };
    let mut parts = Vec::new();
    conjuncts(&expression, &mut parts);
    let mut condition = Condition::default();
    for part in parts {
        match (event_of(block, part), &condition.event) {
            (Some(event), None) => condition.event = Some(event),
            (Some(_), Some(_)) => return Err(Wrong::Second(part.span)),
            (None, _) if is_state(block, transition, part) || is_true(part) => {}
            (None, _) => {
                if let Some(name) = unknown(block, part) {
                    return Err(Wrong::NoEvent(name));
                }
                if let Some(span) = event_inside(block, part) {
                    return Err(Wrong::Inside(span));
                }
                condition.guards.push(part.span);
            }
        }
    }
    Ok(condition)
}

/// `CU[CV < 65535]`, `[guard]`. An element of an array is none of them.
fn in_brackets(block: &Block, text: &str) -> Option<Result<Condition, Wrong>> {
    let open = text.find('[')?;
    let name = text.get(..open)?.trim();
    let is_variable = block.variables().any(|one| one.name.names(name));
    if !name.is_empty() && !is_name(name) || is_variable {
        return None;
    }
    if !text.ends_with(']') {
        return Some(Err(Wrong::Open));
    }
    let event = block.event_inputs.iter().position(|event| event.name.names(name));
    if event.is_none() && !name.is_empty() {
        return Some(Err(Wrong::NoEvent(Span::new(0, name.len()))));
    }
    let inside = Span::new(open + 1, text.len() - 1);
    let is_true = ["", "1", "TRUE"].contains(&inside.text(text).trim().to_uppercase().as_str());
    Some(Ok(Condition { event, guards: if is_true { Vec::new() } else { vec![inside] } }))
}

fn conjuncts<'e>(expression: &'e Expression, parts: &mut Vec<&'e Expression>) {
    match &expression.kind {
        ExpressionKind::Binary(BinaryOperator::And, left, right) => {
            conjuncts(left, parts);
            conjuncts(right, parts);
        }
        _ => parts.push(expression),
    }
}

fn name(expression: &Expression) -> Option<&st::tree::Name> {
    match &expression.kind {
        ExpressionKind::Variable(name, selectors) if selectors.is_empty() => Some(name),
        _ => None,
    }
}

fn event_of(block: &Block, expression: &Expression) -> Option<usize> {
    let name = name(expression)?;
    block.event_inputs.iter().position(|event| event.name.names(&name.text))
}

fn is_state(block: &Block, transition: &Transition, expression: &Expression) -> bool {
    name(expression).is_some_and(|name| {
        transition.source.names(&name.text)
            && !block.variables().any(|one| one.name.names(&name.text))
    })
}

fn is_true(expression: &Expression) -> bool {
    matches!(expression.kind, ExpressionKind::Bool(true) | ExpressionKind::Integer(1))
}

/// A name alone that nothing has.
fn unknown(block: &Block, expression: &Expression) -> Option<Span> {
    let name = name(expression)?;
    let is_there = block.variables().any(|one| one.name.names(&name.text));
    (!is_there).then_some(name.span)
}

/// An event somewhere in an expression.
fn event_inside(block: &Block, expression: &Expression) -> Option<Span> {
    let mut copy = expression.clone();
    let mut found = None;
    visit::expressions(&mut copy, &mut |one| {
        if event_of(block, one).is_some() {
            found = found.or(Some(one.span));
        }
        found.is_none()
    });
    found
}
