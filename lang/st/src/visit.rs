//! Every expression and statement in a part of a syntax tree, to look at or to change, the outer
//! ones first.

use crate::tree::{Argument, Expression, ExpressionKind, Selector, Statement, StatementKind};

/// The walk through an expression, to look or to change.
macro_rules! expressions {
    ($(#[$doc:meta])* $name:ident $(, $mutable:tt)?) => {
        $(#[$doc])*
        pub fn $name(
            expression: &$($mutable)? Expression,
            found: &mut dyn FnMut(&$($mutable)? Expression) -> bool,
        ) {
            if !found(expression) {
                return;
            }
            match &$($mutable)? expression.kind {
                ExpressionKind::Variable(_, selectors) => {
                    for selector in selectors {
                        if let Selector::Index(indexes) = selector {
                            for index in indexes {
                                $name(index, found);
                            }
                        }
                    }
                }
                ExpressionKind::Call(_, arguments) => {
                    for argument in arguments {
                        $name(&$($mutable)? argument.value, found);
                    }
                }
                ExpressionKind::Typed(_, inside) | ExpressionKind::Unary(_, inside) => {
                    $name(inside, found);
                }
                ExpressionKind::Binary(_, left, right) => {
                    $name(left, found);
                    $name(right, found);
                }
                ExpressionKind::List(list) => {
                    for (_, one) in list {
                        $name(one, found);
                    }
                }
                ExpressionKind::Members(list) => {
                    for (_, one) in list {
                        $name(one, found);
                    }
                }
                ExpressionKind::Integer(_)
                | ExpressionKind::Real(_)
                | ExpressionKind::Bool(_)
                | ExpressionKind::Duration(_)
                | ExpressionKind::Member(..)
                | ExpressionKind::Text(_)
                | ExpressionKind::Address(_)
                | ExpressionKind::Missing => {}
            }
        }
    };
}

expressions! {
    /// Calls `found` with an expression and those in it. Where it says false, those in it are left
    /// out.
    expressions, mut
}
expressions! {
    /// As [`expressions`], to look at alone.
    each
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
