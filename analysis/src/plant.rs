//! Plant files: what editors ask about one. All of it comes from the simulator's parser.

use awl_sim::plant::file::model::Colour;
use awl_sim::plant::file::{SHAPES, STATEMENTS, names, problems};
use diagnostics::Span;

use crate::answer::{Completion, CompletionKind, Edit, Outline, Problem, Refusal};
use crate::language::{Text, View, word_around};
use crate::subject::Mention;

/// Plants that files describe.
pub(crate) struct Plant;

impl Text for Plant {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        let problems = problems(view.text()).into_iter();
        problems.map(|problem| Problem::of(problem, view.text())).collect()
    }

    fn mentions(&self, _: View<'_>) -> Vec<Mention> {
        Vec::new()
    }

    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention> {
        let word = word_around(view.text(), offset);
        let written = word.text(view.text());
        let found = STATEMENTS.iter().find(|row| row.word.eq_ignore_ascii_case(written))?;
        Some(Mention::word(word, format!("**{}**: {}\n\n`{}`", found.word, found.doc, found.form)))
    }

    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion> {
        let word = word_around(view.text(), offset);
        let span = Span { end: word.end.min(offset as u32), ..word };
        let Some(before) = view.text().get(..span.start as usize) else { return Vec::new() };
        let line = before.rsplit('\n').next().unwrap_or("");
        if line.contains('#') || line.matches('"').count() % 2 == 1 {
            return Vec::new();
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [] => STATEMENTS.iter().map(|row| word_of(row.word, row.form, row.doc, span)).collect(),
            ["draw"] => SHAPES.iter().map(|(word, form)| word_of(word, form, "", span)).collect(),
            ["draw", ..] => [names_of(view, span), colours(span)].concat(),
            _ => names_of(view, span),
        }
    }

    fn outline(&self, _: View<'_>) -> Vec<Outline> {
        Vec::new()
    }

    fn formatted(&self, _: View<'_>) -> Result<String, Refusal> {
        Err(Refusal("a plant file has no canonical layout".to_owned()))
    }

    fn written(&self, name: &str) -> String {
        name.to_owned()
    }
}

fn names_of(view: View<'_>, span: Span) -> Vec<Completion> {
    let names = names(view.text()).into_iter();
    let of =
        |name: String| Completion { kind: CompletionKind::Symbol, ..word_of(&name, "", "", span) };
    names.map(of).collect()
}

fn colours(span: Span) -> Vec<Completion> {
    let of = |(word, _): &(&str, Colour)| Completion {
        kind: CompletionKind::Value,
        ..word_of(word, "", "", span)
    };
    Colour::ALL.iter().map(of).collect()
}

fn word_of(word: &str, form: &str, doc: &str, span: Span) -> Completion {
    Completion {
        label: word.to_owned(),
        kind: CompletionKind::Keyword,
        detail: form.to_owned(),
        doc: doc.to_owned(),
        edit: Edit { span, text: word.to_owned() },
        holes: Vec::new(),
    }
}
