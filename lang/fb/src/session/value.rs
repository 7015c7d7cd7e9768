//! Values as lines write them, and what a name with a value stands for.

use std::ops::Range;

use diagnostics::Span;
use st::parser::parse_expression;
use st::tree::{Expression, ExpressionKind};

use super::part::{Outcome, Part};
use crate::interpreter::{Value, range};
use crate::model::Variable;

/// What a name stands for: a variable, of an array all of its elements, or one element.
pub(super) struct Place<'b> {
    pub(super) variable: &'b Variable,
    pub(super) elements: Range<usize>,
    is_list: bool,
}

impl<'b> Place<'b> {
    /// A variable, whole.
    pub(super) fn of(variable: &'b Variable) -> Place<'b> {
        let elements = 0..variable.size.map_or(1, |size| size as usize);
        Place { variable, elements, is_list: variable.size.is_some() }
    }

    /// What a name, perhaps with an index, stands for among some variables; none has this name.
    pub(super) fn find(
        name: Part,
        mut variables: impl Iterator<Item = &'b Variable>,
    ) -> Outcome<Option<Place<'b>>> {
        let (word, index) = name.bracketed().map_or((name, None), |(word, at)| (word, Some(at)));
        let Some(variable) = variables.find(|one| one.name.names(word.text)) else {
            return Ok(None);
        };
        let whole = Place::of(variable);
        let Some(index) = index else { return Ok(Some(whole)) };
        if !whole.is_list {
            return name.wrong(format!("{}: no array", word.text), None);
        }
        match index.text.parse() {
            Ok(at) if whole.elements.contains(&at) => {
                Ok(Some(Place { variable, elements: at..at + 1, is_list: false }))
            }
            _ => {
                let help = format!("they are 0 to {}", whole.elements.end.saturating_sub(1));
                index.wrong(format!("{}: no element {}", word.text, index.text), Some(help))
            }
        }
    }

    /// The values of a text, one for each element.
    pub(super) fn values(&self, part: Part) -> Outcome<Vec<Value>> {
        if !self.is_list {
            return Ok(vec![literal(part, self.variable)?]);
        }
        let (name, count) = (&self.variable.name.text, self.elements.len());
        let list = part.bracketed().filter(|(before, _)| before.text.is_empty());
        let parts = list.map_or(Vec::new(), |(_, inner)| inner.list());
        if parts.len() != count {
            let help = format!("write {count} values in brackets, or {name}[0] = 5 for one");
            return part.wrong(format!("{name} is an array of {count}"), Some(help));
        }
        parts.into_iter().map(|part| literal(part, self.variable)).collect()
    }

    /// Its values as lines write them.
    pub(super) fn written(&self, values: &[Value]) -> String {
        let text = values.iter().map(|one| written(*one)).collect::<Vec<_>>().join(", ");
        if self.is_list { format!("[{text}]") } else { text }
    }
}

/// Whether two values are the same: of REAL as far as six digits.
pub(crate) fn is_same(a: Value, b: Value) -> bool {
    match (a, b) {
        (Value::Real(a), Value::Real(b)) => (a - b).abs() <= 1e-6 * a.abs().max(b.abs()),
        _ => a.whole() == b.whole(),
    }
}

/// A value as ST writes it.
pub(crate) fn written(value: Value) -> String {
    match value {
        Value::Bool(value) => if value { "TRUE" } else { "FALSE" }.to_owned(),
        Value::Real(value) => format!("{value:?}"),
        Value::Whole(crate::DataType::Time, ms) => format!("T#{ms}ms"),
        other => other.whole().to_string(),
    }
}

/// The value of a text for a variable.
pub(crate) fn value_of(text: &str, variable: &Variable) -> Result<Value, String> {
    let of = variable.of_type;
    let (expression, wrong) = parse_expression(text, Span::new(0, text.len()));
    let found = expression.filter(|_| wrong.is_empty()).and_then(|one| constant(&one));
    let Some(found) = found else { return Err(format!("`{text}` is no value")) };
    let is_real = matches!(found, Value::Real(_));
    let (low, high) = match (of, range(of)) {
        (crate::DataType::Real, _) => return Ok(found.to(of)),
        (_, Some(range)) if !is_real => range,
        _ => return Err(format!("{} has no value {text}", of.name())),
    };
    match (low..=high).contains(&found.whole()) {
        true => Ok(found.to(of)),
        false => Err(format!("{text} is no {}: that is {low} to {high}", of.name())),
    }
}

fn literal(part: Part, variable: &Variable) -> Outcome<Value> {
    value_of(part.text, variable).or_else(|message| part.wrong(message, None))
}

fn constant(expression: &Expression) -> Option<Value> {
    Some(match &expression.kind {
        ExpressionKind::Integer(value) | ExpressionKind::Duration(value) => Value::Literal(*value),
        ExpressionKind::Real(value) => Value::Real(*value),
        ExpressionKind::Bool(value) => Value::Bool(*value),
        ExpressionKind::Typed(_, value) => constant(value)?,
        _ => return None,
    })
}
