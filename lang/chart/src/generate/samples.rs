//! Operators of a GRAFCET as Structured Text: what is looked at once a scan becomes a variable.

use std::collections::HashMap;

use diagnostics::Span;
use st::tree::{Argument, BinaryOperator, Expression, ExpressionKind, Name, Selector, Statement};

use super::build::{
    add_elapsed, all, assign, binary, duration, element, integer, not, set, variable, when,
};
use super::mentions::{Length, Part, Scope, Times, rewrite, short};
use super::names::Variables;
use crate::operators::{self, Operator, RISE};

enum Kind {
    Rise,
    Fall,
    /// The times.
    Time(Expression, Option<Expression>),
}

/// An operator that is looked at at the beginning of a scan.
struct Sample {
    /// The chart that has it.
    chart: usize,
    /// Its variable.
    name: String,
    kind: Kind,
    of: Expression,
}

/// All of them, inner ones before those around.
#[derive(Default)]
pub(super) struct Samples {
    list: Vec<Sample>,
    /// The variables of edges of what is a name alone.
    edges: HashMap<String, String>,
}

/// The variable of an operand that is a name alone.
fn plain(operand: &Expression, scope: &Scope) -> Option<String> {
    match (scope.mention(operand), &operand.kind) {
        (Some((step, Part::X)), _) => Some(step),
        (None, ExpressionKind::Variable(name, selectors)) if selectors.is_empty() => {
            Some(name.text.clone())
        }
        _ => None,
    }
}

/// The event of a stored action as an operator.
pub(super) fn event(code: Expression) -> Expression {
    let (span, name) = (code.span, Name { text: RISE.to_owned(), span: code.span });
    let arguments = vec![Argument { name: None, is_output: false, value: code }];
    Expression { kind: ExpressionKind::Call(name, arguments), span }
}

impl Samples {
    /// Replaces the operators in an expression of type BOOL.
    pub(super) fn replace(
        &mut self,
        chart: usize,
        expression: &mut Expression,
        scope: &Scope,
        variables: &mut Variables,
    ) {
        operators::each(expression, &mut |one| {
            let Some(operator) = Operator::of(one) else { return };
            let step = |of: &Expression| scope.mention(of).filter(|(_, part)| *part == Part::X);
            let (kind, of) = match operator {
                Operator::Time { on, of, off: None } if step(of).is_some() => {
                    one.kind = step_for(of, on).kind;
                    return;
                }
                Operator::Rise(of) => (Kind::Rise, of),
                Operator::Fall(of) => (Kind::Fall, of),
                Operator::Time { on, of, off } => (Kind::Time(on.clone(), off.cloned()), of),
            };
            let text = self.add(chart, kind, of.clone(), scope, variables);
            one.kind = ExpressionKind::Variable(Name { text, span: one.span }, Vec::new());
        });
    }

    /// The variable of an operator.
    fn add(
        &mut self,
        chart: usize,
        kind: Kind,
        of: Expression,
        scope: &Scope,
        variables: &mut Variables,
    ) -> String {
        let ending = match kind {
            Kind::Rise => "rises",
            Kind::Fall => "falls",
            Kind::Time(..) => "timed",
        };
        let plain = plain(&of, scope).map(|name| format!("{name}.{ending}"));
        let edge = plain.clone().filter(|_| !matches!(kind, Kind::Time(..)));
        if let Some(known) = edge.as_ref().and_then(|edge| self.edges.get(edge)) {
            return known.clone();
        }
        let name = plain.unwrap_or_else(|| format!("Chart.{ending}"));
        let name = variables.unused(&name);
        variables.add(&name, "BOOL");
        variables.add(&format!("{name}.was"), "BOOL");
        self.edges.extend(edge.map(|edge| (edge, name.clone())));
        self.list.push(Sample { chart, name: name.clone(), kind, of });
        name
    }

    /// What they are made of, with the charts that have them.
    pub(super) fn operands(&mut self) -> impl Iterator<Item = (usize, &mut Expression)> {
        self.list.iter_mut().flat_map(|one| {
            let times = match &mut one.kind {
                Kind::Time(on, off) => std::iter::once(on).chain(off).collect(),
                _ => Vec::new(),
            };
            let chart = one.chart;
            std::iter::once(&mut one.of).chain(times).map(move |operand| (chart, operand))
        })
    }

    /// At the beginning of a scan.
    pub(super) fn look(
        self,
        scopes: &[Scope],
        times: &Times,
        variables: &mut Variables,
    ) -> Vec<Statement> {
        let mut statements = Vec::new();
        for mut one in self.list {
            let Some(scope) = scopes.get(one.chart) else { continue };
            rewrite(&mut one.of, scope, times, &mut |_, _| "");
            let was = || variable(&format!("{}.was", one.name));
            statements.push(element(&one.name, format!("Looks at {}", one.name)));
            match one.kind {
                Kind::Rise | Kind::Fall => {
                    let (is, was) = match one.kind {
                        Kind::Rise => (one.of.clone(), not(was())),
                        _ => (not(one.of.clone()), was()),
                    };
                    statements.push(assign(variable(&one.name), all([is, was])));
                    statements.push(assign(variable(&format!("{}.was", one.name)), one.of));
                }
                Kind::Time(on, off) => {
                    let off = off.unwrap_or_else(|| duration(0));
                    let is_short = short(&on).is_some() && short(&off).is_some();
                    let length = if is_short { Length::Short } else { Length::Long };
                    let since = format!("{}.T", one.name);
                    variables.add(&since, length.type_name());
                    let is_new = binary(BinaryOperator::Xor, one.of.clone(), was());
                    statements.push(when(not(is_new.clone()), vec![add_elapsed(&since)]));
                    let begins =
                        vec![assign(variable(&since), length.zero()), assign(was(), one.of)];
                    statements.push(when(is_new, begins));
                    for (mut limit, is, value) in [(on, was(), true), (off, not(was()), false)] {
                        if let (true, Some(ms)) = (is_short, short(&limit)) {
                            limit.kind = integer(ms).kind;
                        }
                        rewrite(&mut limit, scope, times, &mut |_, _| "");
                        let is_over =
                            binary(BinaryOperator::GreaterOrEqual, variable(&since), limit);
                        statements.push(when(all([is, is_over]), vec![set(&one.name, value)]));
                    }
                }
            }
        }
        statements
    }

    /// The variables that are edges.
    pub(super) fn edges(&self) -> Vec<String> {
        let edges = self.list.iter().filter(|one| !matches!(one.kind, Kind::Time(..)));
        edges.map(|one| one.name.clone()).collect()
    }
}

/// Whether a step is active for a time: `Fill AND Fill.T >= on`.
fn step_for(step: &Expression, on: &Expression) -> Expression {
    let mut time = step.clone();
    if let ExpressionKind::Variable(_, selectors) = &mut time.kind {
        let field = Name { text: "T".to_owned(), span: Span::default() };
        *selectors = vec![Selector::Field(field)];
    }
    all([step.clone(), binary(BinaryOperator::GreaterOrEqual, time, on.clone())])
}
