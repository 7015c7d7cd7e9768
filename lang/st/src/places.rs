//! The names and places in a syntax tree of Structured Text, to change them.

use crate::tree::{
    Declaration, Expression, ExpressionKind, File, Name, Section, Selector, TypeText, TypeTextKind,
    UnitKind,
};
use crate::visit;
use diagnostics::Span;

/// Calls `found` with each name and the place of everything else in a text.
pub fn in_file(file: &mut File, name: &mut dyn FnMut(&mut Name), place: &mut dyn FnMut(&mut Span)) {
    file.settings.iter_mut().for_each(&mut *place);
    for declared in &mut file.types {
        name(&mut declared.name);
        place(&mut declared.span);
        in_type(&mut declared.of_type, name, place);
        in_initial(&mut declared.initial, name, place);
    }
    file.globals.iter_mut().for_each(|section| in_section(section, name, place));
    for unit in &mut file.units {
        name(&mut unit.name);
        place(&mut unit.span);
        if let UnitKind::Function(of_type) = &mut unit.kind {
            in_type(of_type, name, place);
        }
        unit.sections.iter_mut().for_each(|section| in_section(section, name, place));
        visit::statements(&mut unit.body, &mut |statement| place(&mut statement.span));
        visit::in_statements(&mut unit.body, &mut |one| in_expression(one, name, place));
    }
}

fn in_section(
    section: &mut Section,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    section.declarations.iter_mut().for_each(|declared| in_declaration(declared, name, place));
}

fn in_declaration(
    declared: &mut Declaration,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    declared.names.iter_mut().chain(&mut declared.at).for_each(&mut *name);
    declared.coarse.iter_mut().for_each(&mut *place);
    in_type(&mut declared.of_type, name, place);
    in_initial(&mut declared.initial, name, place);
}

fn in_initial(
    initial: &mut Option<Expression>,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    if let Some(initial) = initial {
        visit::expressions(initial, &mut |one| in_expression(one, name, place));
    }
}

fn in_type(
    of_type: &mut TypeText,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) {
    place(&mut of_type.span);
    let mut expression = |one: &mut Expression, name: &mut dyn FnMut(&mut Name)| {
        visit::expressions(one, &mut |one| in_expression(one, name, place));
    };
    match &mut of_type.kind {
        TypeTextKind::Array(bounds, of) => {
            for (low, high) in bounds {
                expression(low, name);
                expression(high, name);
            }
            in_type(of, name, place);
        }
        TypeTextKind::Text(Some(length)) => expression(length, name),
        TypeTextKind::Range(_, bounds) => {
            expression(&mut bounds.0, name);
            expression(&mut bounds.1, name);
        }
        TypeTextKind::Struct(members) => {
            members.iter_mut().for_each(|one| in_declaration(one, name, place));
        }
        TypeTextKind::Enumeration(values) => {
            for (value, number) in values {
                name(value);
                in_initial(number, name, place);
            }
        }
        TypeTextKind::Named(_) | TypeTextKind::Text(None) | TypeTextKind::Missing => {}
    }
}

/// The place of one expression, and its names; those in it come, too.
fn in_expression(
    expression: &mut Expression,
    name: &mut dyn FnMut(&mut Name),
    place: &mut dyn FnMut(&mut Span),
) -> bool {
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
    true
}
