//! Programs in AWL: what editors ask about one. All of it comes from the assembler's parser and
//! passes.

mod completions;
mod mentions;
mod outline;

use awl_asm::cursor::{self, Cursor};
use awl_asm::directive_table::DIRECTIVES;
use awl_asm::format::format;
use awl_asm::mnemonics::keywords;
use awl_asm::symbols;

use crate::answer::{Completion, Outline, Problem, Refusal};
use crate::language::{Text, View, word_around};
use crate::structured;
use crate::subject::Mention;

/// AWL as the assembler reads it.
pub(crate) struct Awl;

impl Text for Awl {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        view.model.map_or_else(Vec::new, |model| model.problems(&view.source.name))
    }

    fn mentions(&self, view: View<'_>) -> Vec<Mention> {
        let Some(model) = view.model else { return Vec::new() };
        let all = mentions::of(&model.awl().text, &model.assembly).into_iter();
        let here = all.filter_map(|one| Some(Mention { span: view.span_here(one.span)?, ..one }));
        here.flat_map(|one| structured::of_awl(view.text(), one, model)).collect()
    }

    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention> {
        let word = word_around(view.text(), offset);
        let written = word.text(view.text());
        match cursor::at(view.text(), word.end as usize) {
            Cursor::Directive(span) => {
                let is = |word: &str| span.text(view.text()).eq_ignore_ascii_case(word);
                let row = DIRECTIVES.iter().find(|row| is(row.word))?;
                let text = format!("**//# {}**: {}\n\n`//# {}`", row.word, row.doc, row.example);
                Some(Mention::word(span, text))
            }
            Cursor::First(_) => {
                let keyword = keywords().find(|word| word.eq_ignore_ascii_case(written))?;
                Some(Mention::word(word, format!("**{keyword}**: {}", keyword_words(keyword))))
            }
            _ => None,
        }
    }

    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion> {
        completions::at(view, offset)
    }

    fn outline(&self, view: View<'_>) -> Vec<Outline> {
        let Some(model) = view.model else { return Vec::new() };
        outline::here(view, outline::of(&model.awl().text, &model.assembly.program))
    }

    fn formatted(&self, view: View<'_>) -> Result<String, Refusal> {
        format(view.source).map_err(|errors| {
            let first = errors.first().map(|error| error.message.as_str()).unwrap_or_default();
            Refusal(format!("the text has errors of form: {first}"))
        })
    }

    fn written(&self, name: &str) -> String {
        symbols::written(name)
    }
}

/// What a keyword is for.
fn keyword_words(keyword: &str) -> &'static str {
    match keyword {
        "NETWORK" => "begins a part of the program that starts with an empty logic stack",
        "TITLE" => "the title of a block",
        "BEGIN" => "after it come the instructions of a block",
        "VAR" | "VAR_TEMP" => "begins the local variables of a block that are no parameters",
        "VAR_INPUT" => "begins the parameters that are copied in at the call",
        "VAR_IN_OUT" => "begins the parameters that are copied in at the call and back after it",
        "VAR_OUTPUT" => "begins the parameters that are copied back after the call",
        "ORGANIZATION_BLOCK" => "begins the main program, OB1",
        "SUBROUTINE_BLOCK" => "begins a subroutine, as in `SUBROUTINE_BLOCK Fill:SBR0`",
        "INTERRUPT_BLOCK" => "begins an interrupt routine, as in `INTERRUPT_BLOCK Tick:INT0`",
        "DATA_BLOCK" => "begins what V memory holds before the first scan",
        _ => "ends what the word without END_ begins",
    }
}
