//! The names and places in a syntax tree of Structured Text, to change them.

use diagnostics::Span;
use st::tree::{Expression, ExpressionKind, File, Name, Section, Selector, TypeText, TypeTextKind};
use st::visit;

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
        visit::statements(&mut unit.body, &mut |statement| place(&mut statement.span));
        visit::in_statements(&mut unit.body, &mut |one| in_expression(one, name, place));
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
            visit::expressions(initial, &mut |one| in_expression(one, name, place));
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
            visit::expressions(low, &mut |one| in_expression(one, name, place));
            visit::expressions(high, &mut |one| in_expression(one, name, place));
        }
        in_type(of, name, place);
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
