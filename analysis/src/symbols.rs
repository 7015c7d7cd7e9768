//! Symbol tables: what editors ask about one.

use awl_asm::ast::{Named, Value};
use awl_asm::symbols::load_placed;

use crate::answer::{Completion, Outline, OutlineKind, Problem, Refusal};
use crate::language::{Text, View};
use crate::subject::{Mention, Subject};

/// Symbol tables, as `awl-asm --symbols` reads them.
pub(crate) struct Symbols;

impl Text for Symbols {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        let (_, _, diagnostics) = load_placed(view.source);
        let problems = diagnostics.into_iter();
        problems.map(|diagnostic| Problem::of(diagnostic, view.text())).collect()
    }

    fn mentions(&self, view: View<'_>) -> Vec<Mention> {
        let (symbols, names, _) = load_placed(view.source);
        let mentions = names.iter().filter_map(|name| {
            let Named::Symbol(index) = name.of else { return None };
            let symbol = symbols.get(index as usize)?;
            let address = match symbol.value {
                Value::Address(address) => Some(address),
                _ => None,
            };
            let subject = Subject::Symbol(symbol.name.to_lowercase());
            Some(Mention { address, declares: true, ..Mention::of(name.span, subject) })
        });
        mentions.collect()
    }

    fn word_at(&self, _: View<'_>, _: usize) -> Option<Mention> {
        None
    }

    fn completions(&self, _: View<'_>, _: usize) -> Vec<Completion> {
        Vec::new()
    }

    fn outline(&self, view: View<'_>) -> Vec<Outline> {
        let (symbols, names, _) = load_placed(view.source);
        let parts = names.iter().filter_map(|name| {
            let Named::Symbol(index) = name.of else { return None };
            let symbol = symbols.get(index as usize)?;
            let (line, _) = view.source.position(name.span.start as usize);
            Some(Outline {
                name: symbol.name.clone(),
                detail: symbol.comment.clone(),
                kind: OutlineKind::Symbol,
                span: view.source.line_span(line),
                name_span: name.span,
                children: Vec::new(),
            })
        });
        parts.collect()
    }

    fn formatted(&self, _: View<'_>) -> Result<String, Refusal> {
        Err(Refusal("a symbol table has no canonical layout".to_owned()))
    }

    fn written(&self, name: &str) -> String {
        match name.contains(['\t', ',', ';']) || name.trim() != name {
            true => format!("\"{name}\""),
            false => name.to_owned(),
        }
    }
}
