//! Every expression and statement in a part of a syntax tree, to look at or to change, the outer
//! ones first.

use crate::tree::{Argument, Expression, ExpressionKind, Selector, Statement, StatementKind};

/// Calls `found` with an expression and those in it. Where it says false, those in it are left out.
pub fn expressions(expression: &mut Expression, found: &mut dyn FnMut(&mut Expression) -> bool) {
    if !found(expression) {
        return;
    }
    match &mut expression.kind {
        ExpressionKind::Variable(_, selectors) => {
            for selector in selectors {
                if let Selector::Index(indexes) = selector {
                    indexes.iter_mut().for_each(|index| expressions(index, found));
                }
            }
        }
        ExpressionKind::Call(_, arguments) => in_arguments(arguments, found),
        ExpressionKind::Typed(_, inside) | ExpressionKind::Unary(_, inside) => {
            expressions(inside, found);
        }
        ExpressionKind::Binary(_, left, right) => {
            expressions(left, found);
            expressions(right, found);
        }
        ExpressionKind::List(list) => {
            list.iter_mut().for_each(|(_, one)| expressions(one, found));
        }
        ExpressionKind::Members(list) => {
            list.iter_mut().for_each(|(_, one)| expressions(one, found));
        }
        ExpressionKind::Integer(_)
        | ExpressionKind::Real(_)
        | ExpressionKind::Bool(_)
        | ExpressionKind::Duration(_)
        | ExpressionKind::Member(..)
        | ExpressionKind::Text
        | ExpressionKind::Address(_)
        | ExpressionKind::Missing => {}
    }
}

fn in_arguments(arguments: &mut [Argument], found: &mut dyn FnMut(&mut Expression) -> bool) {
    arguments.iter_mut().for_each(|argument| expressions(&mut argument.value, found));
}

/// Calls `found` with each statement, those in others too.
pub fn statements(list: &mut [Statement], found: &mut dyn FnMut(&mut Statement)) {
    for statement in list {
        found(statement);
        match &mut statement.kind {
            StatementKind::If(arms, otherwise) => {
                arms.iter_mut().for_each(|(_, body)| statements(body, found));
                statements(otherwise, found);
            }
            StatementKind::Case(_, arms, otherwise) => {
                arms.iter_mut().for_each(|arm| statements(&mut arm.body, found));
                statements(otherwise, found);
            }
            StatementKind::For(one) => statements(&mut one.body, found),
            StatementKind::While(_, body) | StatementKind::Repeat(body, _) => {
                statements(body, found);
            }
            StatementKind::Assign(..)
            | StatementKind::Call(..)
            | StatementKind::Exit
            | StatementKind::Continue
            | StatementKind::Return
            | StatementKind::Element(_)
            | StatementKind::AddElapsed(_) => {}
        }
    }
}

/// Calls `found` with each expression of a statement itself, not of those in it.
pub fn in_statement(statement: &mut Statement, found: &mut dyn FnMut(&mut Expression) -> bool) {
    match &mut statement.kind {
        StatementKind::Assign(to, value) => {
            expressions(to, found);
            expressions(value, found);
        }
        StatementKind::Call(target, arguments) => {
            expressions(target, found);
            in_arguments(arguments, found);
        }
        StatementKind::If(arms, _) => {
            arms.iter_mut().for_each(|(condition, _)| expressions(condition, found));
        }
        StatementKind::Case(selector, arms, _) => {
            expressions(selector, found);
            for (low, high) in arms.iter_mut().flat_map(|arm| &mut arm.labels) {
                [low].into_iter().chain(high).for_each(|label| expressions(label, found));
            }
        }
        StatementKind::For(one) => {
            for part in
                [&mut one.variable, &mut one.from, &mut one.to].into_iter().chain(&mut one.by)
            {
                expressions(part, found);
            }
        }
        StatementKind::While(condition, _) | StatementKind::Repeat(_, condition) => {
            expressions(condition, found);
        }
        StatementKind::AddElapsed(target) => expressions(target, found),
        StatementKind::Exit
        | StatementKind::Continue
        | StatementKind::Return
        | StatementKind::Element(_) => {}
    }
}

/// Calls `found` with every expression in statements.
pub fn in_statements(list: &mut [Statement], found: &mut dyn FnMut(&mut Expression) -> bool) {
    statements(list, &mut |statement| in_statement(statement, found));
}
