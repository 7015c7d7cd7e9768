//! Every part of a syntax tree of Structured Text, to look at or to change.

use diagnostics::Span;
use st::tree::{
    Argument, Expression, ExpressionKind, File, Name, Section, Selector, Statement, StatementKind,
    TypeText, TypeTextKind,
};

/// Calls `found` with an expression, then with those in it.
pub(crate) fn expressions(expression: &mut Expression, found: &mut dyn FnMut(&mut Expression)) {
    found(expression);
    match &mut expression.kind {
        ExpressionKind::Variable(_, selectors) => in_selectors(selectors, found),
        ExpressionKind::Call(_, arguments) => in_arguments(arguments, found),
        ExpressionKind::Typed(_, inside) | ExpressionKind::Unary(_, inside) => {
            expressions(inside, found);
        }
        ExpressionKind::Binary(_, left, right) => {
            expressions(left, found);
            expressions(right, found);
        }
        ExpressionKind::List(list) => list.iter_mut().for_each(|(_, one)| expressions(one, found)),
        ExpressionKind::Members(list) => {
            list.iter_mut().for_each(|(_, one)| expressions(one, found));
        }
        _ => {}
    }
}

fn in_selectors(selectors: &mut [Selector], found: &mut dyn FnMut(&mut Expression)) {
    for selector in selectors {
        if let Selector::Index(indexes) = selector {
            indexes.iter_mut().for_each(|index| expressions(index, found));
        }
    }
}

fn in_arguments(arguments: &mut [Argument], found: &mut dyn FnMut(&mut Expression)) {
    arguments.iter_mut().for_each(|argument| expressions(&mut argument.value, found));
}

/// Calls `found` with each statement, those in others too.
pub(crate) fn statements(list: &mut [Statement], found: &mut dyn FnMut(&mut Statement)) {
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
            _ => {}
        }
    }
}

/// Calls `found` with each expression in statements, the outer ones first.
pub(crate) fn expressions_of(list: &mut [Statement], found: &mut dyn FnMut(&mut Expression)) {
    statements(list, &mut |statement| match &mut statement.kind {
        StatementKind::Assign(target, value) => {
            expressions(target, found);
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
                expressions(low, found);
                high.iter_mut().for_each(|high| expressions(high, found));
            }
        }
        StatementKind::For(one) => {
            for expression in [&mut one.variable, &mut one.from, &mut one.to] {
                expressions(expression, found);
            }
            one.by.iter_mut().for_each(|by| expressions(by, found));
        }
        StatementKind::While(condition, _) | StatementKind::Repeat(_, condition) => {
            expressions(condition, found);
        }
        _ => {}
    });
}

/// Calls `found` with each name and the place of everything else in a text.
pub(crate) fn places(
    file: &mut File,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    file.globals.iter_mut().for_each(|section| in_section(section, name, place));
    for unit in &mut file.units {
        name(&mut unit.name);
        unit.sections.iter_mut().for_each(|section| in_section(section, name, place));
        statements(&mut unit.body, &mut |statement| place(&mut statement.span));
        expressions_of(&mut unit.body, &mut |one| in_expression(one, name, place));
    }
}

fn in_section(
    section: &mut Section,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    for declared in &mut section.declarations {
        declared.names.iter_mut().for_each(&mut *name);
        in_type(&mut declared.of_type, name, place);
        if let Some(initial) = &mut declared.initial {
            expressions(initial, &mut |one| in_expression(one, name, place));
        }
    }
}

fn in_type(
    of_type: &mut TypeText,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    place(&mut of_type.span);
    if let TypeTextKind::Array(bounds, of) = &mut of_type.kind {
        for (low, high) in bounds {
            expressions(low, &mut |one| in_expression(one, name, place));
            expressions(high, &mut |one| in_expression(one, name, place));
        }
        in_type(of, name, place);
    }
}

/// The place of one expression, and its names.
fn in_expression(
    expression: &mut Expression,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    place(&mut expression.span);
    match &mut expression.kind {
        ExpressionKind::Variable(of, selectors) => {
            name(of);
            for selector in selectors {
                if let Selector::Field(field) = selector {
                    name(field);
                }
            }
        }
        ExpressionKind::Call(of, arguments) => {
            name(of);
            arguments.iter_mut().filter_map(|one| one.name.as_mut()).for_each(name);
        }
        ExpressionKind::Member(_, of) => name(of),
        _ => {}
    }
}
