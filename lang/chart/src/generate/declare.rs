//! Names that nobody declares, in a chart without a head: where their use says plainly that they
//! are BOOL, they become global variables.

use std::collections::HashSet;

use st::tree::{
    BinaryOperator, Expression, ExpressionKind, File, Name, Section, SectionKind, Statement,
    StatementKind, UnaryOperator,
};
use st::visit;

use super::build;
use super::mentions::Scope;
use super::parsed::Parsed;
use crate::hierarchy::Hierarchy;
use crate::model::Standard;
use crate::operators::Operator;

/// The names that a file declares for all, in upper case.
pub fn globals(file: &File) -> Vec<String> {
    let declared = file.globals.iter().flat_map(|section| &section.declarations);
    let variables = declared.flat_map(|one| &one.names).map(|name| name.text.to_uppercase());
    let units = file.units.iter().map(|unit| unit.name.text.to_uppercase());
    let types = file.types.iter().flat_map(|declared| match &declared.of_type.kind {
        st::tree::TypeTextKind::Enumeration(values) => {
            values.iter().map(|(name, _)| name.text.to_uppercase()).collect()
        }
        _ => Vec::new(),
    });
    variables.chain(units).chain(types).collect()
}

/// The section that declares what is used as BOOL and not known; its names are known from then on.
pub(super) fn by_use(parsed: &mut Parsed, known: &mut HashSet<String>) -> Option<Section> {
    let mut found = Vec::new();
    let all = (parsed.chart.standard == Standard::Grafcet)
        .then(|| Scope::seeing(&Hierarchy::of(parsed.chart), 0));
    in_chart(parsed, all.as_ref(), known, &mut found);
    let names: Vec<(Name, &str)> = found.into_iter().map(|name| (name, "BOOL")).collect();
    (!names.is_empty()).then(|| build::section(SectionKind::Global, names))
}

fn in_chart(
    parsed: &mut Parsed,
    outer: Option<&Scope>,
    known: &mut HashSet<String>,
    found: &mut Vec<Name>,
) {
    let scope = Scope::new(parsed, outer, String::new());
    let mut add = |expression: &Expression| {
        if let ExpressionKind::Variable(name, selectors) = &expression.kind
            && selectors.is_empty()
            && scope.mention(expression).is_none()
            && known.insert(name.text.to_uppercase())
        {
            found.push(name.clone());
        }
    };
    parsed.variables.values().for_each(&mut add);
    parsed.truths().for_each(|one| used_as_bool(one, &mut add));
    for body in parsed.code() {
        visit::statements(body, &mut |statement| in_statement(statement, &mut add));
    }
    for inner in parsed.charts.values_mut() {
        in_chart(inner, Some(&scope), known, found);
    }
}

/// An expression of type BOOL: what in it is of that type, too.
fn used_as_bool(expression: &Expression, add: &mut dyn FnMut(&Expression)) {
    match &expression.kind {
        ExpressionKind::Variable(..) => add(expression),
        ExpressionKind::Unary(UnaryOperator::Not, inside) => used_as_bool(inside, add),
        ExpressionKind::Binary(operator, left, right) if is_logic(*operator) => {
            used_as_bool(left, add);
            used_as_bool(right, add);
        }
        _ => match Operator::of(expression) {
            Some(Operator::Rise(of) | Operator::Fall(of) | Operator::Time { of, .. }) => {
                used_as_bool(of, add);
            }
            None => {}
        },
    }
}

fn is_logic(operator: BinaryOperator) -> bool {
    matches!(operator, BinaryOperator::And | BinaryOperator::Or | BinaryOperator::Xor)
}

/// Whether a value is of type BOOL by its form.
fn is_plainly_bool(value: &Expression) -> bool {
    match &value.kind {
        ExpressionKind::Bool(_) | ExpressionKind::Unary(UnaryOperator::Not, _) => true,
        ExpressionKind::Binary(operator, ..) => is_logic(*operator) || operator.is_comparison(),
        _ => false,
    }
}

fn in_statement(statement: &Statement, add: &mut dyn FnMut(&Expression)) {
    match &statement.kind {
        StatementKind::Assign(to, value) if is_plainly_bool(value) => {
            add(to);
            used_as_bool(value, add);
        }
        StatementKind::If(arms, _) => {
            arms.iter().for_each(|(condition, _)| used_as_bool(condition, add));
        }
        StatementKind::While(condition, _) | StatementKind::Repeat(_, condition) => {
            used_as_bool(condition, add);
        }
        _ => {}
    }
}
