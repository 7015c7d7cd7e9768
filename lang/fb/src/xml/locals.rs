//! Variables that an algorithm declares itself, `VAR ... END_VAR` before its statements: they
//! become internal variables of the block.

use diagnostics::xml::Places;
use diagnostics::{Source, Span};
use st::lexer::{Kind, cut};
use st::tree::{Declaration, Expression, ExpressionKind, TypeTextKind};

use crate::data_type::DataType;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Text, Variable};

/// What is before the declarations when they are parsed.
const HEAD: &str = "FUNCTION_BLOCK B\n";

/// What an algorithm declares, and what is left of it.
pub(super) struct Locals {
    pub(super) variables: Vec<Variable>,
    pub(super) statements: Text,
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// Takes the declarations from the beginning of a text.
pub(super) fn locals(text: Text, file: &str) -> Locals {
    let end = declared(&text.text);
    let mut locals =
        Locals { variables: Vec::new(), statements: Text::default(), diagnostics: Vec::new() };
    let (head, rest) = text.text.split_at_checked(end).unwrap_or(("", &text.text));
    let places = Places::of(&text.text, text.span, file);
    locals.declarations(head, &places);
    locals.statements = match end {
        0 => text,
        _ => Text { text: rest.trim_start().to_owned(), span: text.span },
    };
    locals
}

/// Where the declarations at the beginning end.
fn declared(text: &str) -> usize {
    let mut end = 0;
    let mut is_open = false;
    for token in cut(text).tokens.iter().filter(|token| token.kind != Kind::End) {
        let word = token.span.text(text);
        let is = |one: &str| word.eq_ignore_ascii_case(one);
        match is_open {
            false if is("VAR") || is("VAR_TEMP") => is_open = true,
            false => break,
            true if is("END_VAR") => {
                is_open = false;
                end = token.span.end as usize;
            }
            true => {}
        }
    }
    end
}

impl Locals {
    fn declarations(&mut self, head: &str, places: &Places) {
        let text = format!("{HEAD}{head}\nEND_FUNCTION_BLOCK\n");
        let Ok(source) = Source::new("algorithm", text) else { return };
        if head.is_empty() {
            return;
        }
        let place = |span: Span| {
            let at = |offset: u32| (offset as usize).saturating_sub(HEAD.len()).min(head.len());
            places.span(Span::new(at(span.start), at(span.end)))
        };
        let (file, wrong) = st::parser::parse(&source);
        for one in wrong {
            self.diagnostics.push(Diagnostic::new(Code::DataType, place(one.span), one.message));
        }
        let sections = file.units.iter().flat_map(|unit| &unit.sections);
        for declaration in sections.flat_map(|section| &section.declarations) {
            let Some((of_type, size)) = elementary(declaration) else {
                let message = "an algorithm declares no variable of this type";
                let help = "elementary types have a form, and arrays of them from 0";
                let span = place(declaration.of_type.span);
                self.diagnostics.push(Diagnostic::new(Code::DataType, span, message).help(help));
                continue;
            };
            let initial = declaration.initial.as_ref().map(|one| Text {
                text: one.span.text(&source.text).to_owned(),
                span: place(one.span),
            });
            let type_span = place(declaration.of_type.span);
            self.variables.extend(declaration.names.iter().map(|name| Variable {
                name: Text { text: name.text.clone(), span: place(name.span) },
                of_type,
                type_span,
                size,
                initial: initial.clone(),
                comment: String::new(),
            }));
        }
    }
}

/// The type, and of an array from 0 how many elements it has.
fn elementary(declaration: &Declaration) -> Option<(DataType, Option<u32>)> {
    let named = |kind: &TypeTextKind| match kind {
        TypeTextKind::Named(name) => DataType::of(name),
        TypeTextKind::Text(None) => Some(DataType::String),
        _ => None,
    };
    let number = |one: &Expression| match one.kind {
        ExpressionKind::Integer(value) => Some(value),
        _ => None,
    };
    match &declaration.of_type.kind {
        TypeTextKind::Array(ranges, of) => {
            let [(first, last)] = ranges.as_slice() else { return None };
            let count = number(last).filter(|_| number(first) == Some(0))?;
            Some((named(&of.kind)?, Some(u32::try_from(count).ok()?.checked_add(1)?)))
        }
        kind => named(kind).map(|of| (of, None)),
    }
}
