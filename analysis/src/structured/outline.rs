//! The parts of a text: programs, functions and blocks with their variables, types, global
//! variables.

use diagnostics::{Source, Span};
use st::parser::parse;
use st::tree::{Section, TypeText, TypeTextKind, Unit, UnitKind};

use crate::answer::{Outline, OutlineKind};

/// The parts of a text in their order.
pub(super) fn of(source: &Source) -> Vec<Outline> {
    let (file, _) = parse(source);
    let units = file.units.iter().map(|one| unit(source, one));
    let types = file.types.iter().map(|one| Outline {
        name: one.name.text.clone(),
        detail: "TYPE".to_owned(),
        kind: OutlineKind::Unit,
        span: one.span,
        name_span: one.name.span,
        children: Vec::new(),
    });
    let globals = file.globals.iter().flat_map(|section| variables(source, section));
    let mut all: Vec<Outline> = units.chain(types).chain(globals).collect();
    all.sort_by_key(|part| part.span);
    all
}

fn unit(source: &Source, unit: &Unit) -> Outline {
    let detail = match &unit.kind {
        UnitKind::Program => "PROGRAM".to_owned(),
        UnitKind::Function(result) => format!("FUNCTION : {}", type_words(source, result)),
        UnitKind::Block => "FUNCTION_BLOCK".to_owned(),
    };
    Outline {
        name: unit.name.text.clone(),
        detail,
        kind: OutlineKind::Unit,
        span: around(unit.span, unit.name.span),
        name_span: unit.name.span,
        children: unit.sections.iter().flat_map(|section| variables(source, section)).collect(),
    }
}

fn variables(source: &Source, section: &Section) -> Vec<Outline> {
    let declared = section.declarations.iter().flat_map(|declared| {
        let detail = type_words(source, &declared.of_type);
        declared.names.iter().map(move |name| Outline {
            name: name.text.clone(),
            detail: detail.clone(),
            kind: OutlineKind::Symbol,
            span: around(name.span, name.span),
            name_span: name.span,
            children: Vec::new(),
        })
    });
    declared.collect()
}

/// A type as written; of what takes several lines its first word.
fn type_words(source: &Source, kind: &TypeText) -> String {
    let text = kind.span.text(&source.text);
    match kind.kind {
        TypeTextKind::Missing => String::new(),
        _ if text.contains('\n') => text.split_whitespace().next().unwrap_or_default().to_owned(),
        _ => text.to_owned(),
    }
}

/// A span that has the other one in it.
fn around(span: Span, inside: Span) -> Span {
    Span { start: span.start.min(inside.start), end: span.end.max(inside.end) }
}
