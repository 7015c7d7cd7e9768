//! Conditions of transitions with values: whether each is TRUE, and what it waits for. The values
//! come with the question; edges, calls and what else needs more than values stay unknown.

use chart::model::Chart;
use diagnostics::Span;
use st::parser::parse_expression;
use st::tree::{BinaryOperator, Expression, ExpressionKind, Name, Selector, UnaryOperator};

use crate::protocol::{Judgement, Operand, OperandKind};

/// A condition that can be judged.
pub struct Condition<'t> {
    text: &'t str,
    expression: Option<Expression>,
    operands: Vec<Operand>,
}

/// Where the names in conditions of a chart are looked for: what comes before them, in this order.
pub fn scopes(sheet: &str, all: &[String]) -> Vec<String> {
    let ends = sheet.match_indices('.').map(|(at, _)| at).rev();
    let around = std::iter::once(sheet.len()).chain(ends).filter_map(|end| sheet.get(..end));
    let around: Vec<String> = around.map(|name| format!("{name}.")).collect();
    let others = all.iter().map(|name| format!("{name}."));
    let others = others.filter(|other| !around.contains(other));
    around.iter().cloned().chain([String::new()]).chain(others).collect()
}

/// The names of charts with those of the charts around them.
pub fn names<'c>(charts: impl Iterator<Item = &'c Chart>) -> Vec<String> {
    charts.flat_map(|chart| chart.named_with_inner()).map(|(name, _)| name).collect()
}

impl<'t> Condition<'t> {
    /// Reads a condition of a chart with these [`scopes`].
    pub fn of(text: &'t str, scopes: &[String]) -> Condition<'t> {
        let (expression, _) = parse_expression(text, Span::new(0, text.len()));
        let mut condition = Condition { text, expression: None, operands: Vec::new() };
        if let Some(expression) = &expression {
            condition.find(expression, OperandKind::Truth, scopes);
        }
        condition.expression = expression;
        condition
    }

    /// What has a value in it.
    pub fn into_operands(self) -> Vec<Operand> {
        self.operands
    }

    /// Whether it is TRUE with a value for each operand, and what is missing.
    pub fn judge(&self, values: &[Option<f64>]) -> Judgement {
        let Some(expression) = &self.expression else { return Judgement::default() };
        let judge = Judge { condition: self, values };
        let is_true = judge.truth(expression);
        let waits_for = match is_true {
            Some(false) => judge.missing(expression, true).map(|missing| missing.text),
            _ => None,
        };
        Judgement { is_true, waits_for: waits_for.unwrap_or_default() }
    }

    fn written(&self, expression: &Expression) -> String {
        let words = expression.span.text(self.text).split_whitespace();
        words.collect::<Vec<_>>().join(" ")
    }

    fn find(&mut self, expression: &Expression, kind: OperandKind, scopes: &[String]) {
        match &expression.kind {
            ExpressionKind::Unary(UnaryOperator::Not, inside) => self.find(inside, kind, scopes),
            ExpressionKind::Unary(UnaryOperator::Minus, inside) => self.find(inside, kind, scopes),
            ExpressionKind::Typed(_, inside) => self.find(inside, kind, scopes),
            ExpressionKind::Binary(operator, left, right) => {
                let is_time = is_duration(left) || is_duration(right);
                let kind = match operator.is_comparison() {
                    true if is_time => OperandKind::Time,
                    true => OperandKind::Number,
                    false => kind,
                };
                self.find(left, kind, scopes);
                self.find(right, kind, scopes);
            }
            ExpressionKind::Call(_, arguments) => {
                for argument in arguments.iter().filter(|one| !one.is_output) {
                    self.find(&argument.value, kind, scopes);
                }
            }
            ExpressionKind::Variable(name, selectors) => {
                let names = candidates(name, selectors, scopes);
                self.add(self.written(expression), names, kind);
            }
            ExpressionKind::Address(address) => {
                // `MX0.0` is M0.0; no area has an X.
                let name = address.to_uppercase().replacen('X', "", 1);
                self.add(self.written(expression), vec![name], kind);
            }
            _ => {}
        }
    }

    fn add(&mut self, written: String, names: Vec<String>, kind: OperandKind) {
        if !self.operands.iter().any(|known| known.written.eq_ignore_ascii_case(&written)) {
            self.operands.push(Operand { written, names, kind });
        }
    }
}

fn is_duration(expression: &Expression) -> bool {
    matches!(&expression.kind, ExpressionKind::Duration(_))
}

/// What a variable may be called in the program, the nearest one first: `Fill.X` is the variable of
/// the step. What an index says cannot be named.
fn candidates(name: &Name, selectors: &[Selector], scopes: &[String]) -> Vec<String> {
    let mut path = name.text.clone();
    let mut step = None;
    for selector in selectors {
        let Selector::Field(field) = selector else { return Vec::new() };
        step = field.text.eq_ignore_ascii_case("X").then(|| path.clone());
        path = format!("{path}.{}", field.text);
    }
    let of_scope = |scope: &String| {
        let names = [Some(&path), step.as_ref()].into_iter().flatten();
        names.map(|name| format!("{scope}{name}")).collect::<Vec<_>>()
    };
    scopes.iter().flat_map(of_scope).collect()
}

/// A condition with its values.
struct Judge<'c> {
    condition: &'c Condition<'c>,
    values: &'c [Option<f64>],
}

/// What has to become so.
struct Missing {
    text: String,
    /// What stands between its parts, if there are several.
    between: Option<&'static str>,
}

impl Judge<'_> {
    fn value(&self, expression: &Expression) -> Option<f64> {
        let written = self.condition.written(expression);
        let operands = &self.condition.operands;
        let at = operands.iter().position(|one| one.written.eq_ignore_ascii_case(&written))?;
        self.values.get(at).copied().flatten()
    }

    fn truth(&self, expression: &Expression) -> Option<bool> {
        use BinaryOperator::{And, Or, Xor};
        match &expression.kind {
            ExpressionKind::Bool(value) => Some(*value),
            ExpressionKind::Unary(UnaryOperator::Not, inside) => Some(!self.truth(inside)?),
            ExpressionKind::Binary(operator @ (And | Or), left, right) => {
                let deciding = *operator == Or;
                match (self.truth(left), self.truth(right)) {
                    (Some(one), _) | (_, Some(one)) if one == deciding => Some(deciding),
                    (Some(_), Some(_)) => Some(!deciding),
                    _ => None,
                }
            }
            ExpressionKind::Binary(Xor, left, right) => {
                Some(self.truth(left)? != self.truth(right)?)
            }
            ExpressionKind::Binary(relation, left, right) if relation.is_comparison() => {
                relation.compare(self.number(left)?, self.number(right)?)
            }
            ExpressionKind::Variable(..) | ExpressionKind::Address(_) => {
                self.value(expression).map(|value| value != 0.0)
            }
            _ => None,
        }
    }

    fn number(&self, expression: &Expression) -> Option<f64> {
        use BinaryOperator::{Add, Multiply, Subtract};
        match &expression.kind {
            ExpressionKind::Integer(value) | ExpressionKind::Duration(value) => Some(*value as f64),
            ExpressionKind::Real(value) => Some(f64::from(*value)),
            ExpressionKind::Typed(_, inside) => self.number(inside),
            ExpressionKind::Unary(UnaryOperator::Minus, inside) => Some(-self.number(inside)?),
            ExpressionKind::Binary(operator @ (Add | Subtract | Multiply), left, right) => {
                let (left, right) = (self.number(left)?, self.number(right)?);
                held(match operator {
                    Add => left + right,
                    Subtract => left - right,
                    _ => left * right,
                })
            }
            ExpressionKind::Variable(..) | ExpressionKind::Address(_) => self.value(expression),
            ExpressionKind::Bool(value) => Some(f64::from(u8::from(*value))),
            ExpressionKind::Binary(relation, ..) if relation.is_comparison() => {
                self.truth(expression).map(|value| f64::from(u8::from(value)))
            }
            // Of words AND and its like are words, which values do not tell.
            _ => None,
        }
    }

    /// What is missing for an expression to be what is wanted: of what it takes all together those
    /// that are not so yet, of what one of is enough all.
    fn missing(&self, expression: &Expression, wanted: bool) -> Option<Missing> {
        use BinaryOperator::{And, Or};
        if self.truth(expression) == Some(wanted) {
            return None;
        }
        match &expression.kind {
            ExpressionKind::Unary(UnaryOperator::Not, inside) => self.missing(inside, !wanted),
            ExpressionKind::Binary(operator @ (And | Or), left, right) => {
                let takes_all = (*operator == And) == wanted;
                let between = if takes_all { " AND " } else { " OR " };
                let parts = [left, right].into_iter().filter_map(|one| self.missing(one, wanted));
                joined(parts.collect(), between)
            }
            _ => Some(self.leaf(expression, wanted)),
        }
    }

    fn leaf(&self, expression: &Expression, wanted: bool) -> Missing {
        let written = self.condition.written(expression);
        let is_compound = matches!(expression.kind, ExpressionKind::Binary(..));
        let text = match (wanted, is_compound) {
            (true, _) => written,
            (false, true) => format!("NOT ({written})"),
            (false, false) => format!("NOT {written}"),
        };
        Missing { text, between: None }
    }
}

/// A result that INT and UINT hold both: another one may have wrapped around.
fn held(result: f64) -> Option<f64> {
    (0.0..=f64::from(i16::MAX)).contains(&result).then_some(result)
}

fn joined(mut parts: Vec<Missing>, between: &'static str) -> Option<Missing> {
    if parts.len() < 2 {
        return parts.pop();
    }
    let within = |part: &Missing| match part.between {
        Some(other) if other != between => format!("({})", part.text),
        _ => part.text.clone(),
    };
    let text = parts.iter().map(within).collect::<Vec<_>>().join(between);
    Some(Missing { text, between: Some(between) })
}
