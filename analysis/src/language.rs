//! What a language says about its texts: one implementation of [`Text`] each. How texts belong
//! together, and what is made of the answers, is said elsewhere.

use diagnostics::{Source, Span};

use crate::answer::{Completion, Outline, Problem, Refusal, Signature, floor};
use crate::model::Model;
use crate::subject::Mention;

/// The languages of a project.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Language {
    /// A program in AWL.
    Awl,
    /// A program in Structured Text, as text or as a diagram of blocks.
    StructuredText,
    /// A program whose units are charts.
    Chart,
    /// A function block of IEC 61499.
    Block,
    /// A scenario of the simulator.
    Scenario,
    /// A symbol table.
    Symbols,
    /// A plant file of the simulator.
    Plant,
}

impl Language {
    /// The language of a text of this name, by its ending: `.awl`, `.st`, `.fbd`, `.sfc`, `.fbt`,
    /// `.scn`, `.plant`; `.csv` and `.txt` are symbol tables.
    pub fn of_name(name: &str) -> Option<Language> {
        let (_, ending) = name.rsplit_once('.')?;
        match ending.to_ascii_lowercase().as_str() {
            "awl" => Some(Language::Awl),
            "st" | "fbd" => Some(Language::StructuredText),
            "sfc" => Some(Language::Chart),
            "fbt" => Some(Language::Block),
            "scn" => Some(Language::Scenario),
            "plant" => Some(Language::Plant),
            "csv" | "txt" => Some(Language::Symbols),
            _ => None,
        }
    }

    /// Whether its texts are programs, or parts of one.
    pub fn is_program(self) -> bool {
        use Language::{Awl, Block, Chart, StructuredText};
        matches!(self, Awl | StructuredText | Chart | Block)
    }
}

/// A text that is asked about.
#[derive(Clone, Copy)]
pub(crate) struct View<'p> {
    /// The text.
    pub source: &'p Source,
    /// The program that it is, or belongs to.
    pub model: Option<&'p Model>,
    /// The text of another file of the project.
    pub other: &'p dyn Fn(&str) -> Option<&'p str>,
    /// The files that it names as its program and that the project lacks.
    pub missing: &'p [String],
}

impl<'p> View<'p> {
    /// All of the text.
    pub(crate) fn text(self) -> &'p str {
        &self.source.text
    }

    /// The number of its file in the program.
    pub(crate) fn file(self) -> Option<usize> {
        self.model?.file(&self.source.name)
    }

    /// The stretch of it that a stretch of the program's AWL text is.
    pub(crate) fn span_here(self, span: Span) -> Option<Span> {
        let (file, span) = self.model?.in_file(span)?;
        (Some(file) == self.file()).then_some(span)
    }
}

/// What a language says about a text of it.
pub(crate) trait Text {
    /// What is wrong with it.
    fn problems(&self, view: View<'_>) -> Vec<Problem>;

    /// The names, addresses and instructions in it, in their order.
    fn mentions(&self, view: View<'_>) -> Vec<Mention>;

    /// The word at an offset that means something by itself.
    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention>;

    /// What can be written at an offset. Not all of it fits what is typed: that is the editor's
    /// business.
    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion>;

    /// What the call around an offset takes.
    fn signature(&self, _: View<'_>, _: usize) -> Option<Signature> {
        None
    }

    /// Its parts.
    fn outline(&self, view: View<'_>) -> Vec<Outline>;

    /// The text in canonical layout.
    fn formatted(&self, view: View<'_>) -> Result<String, Refusal>;

    /// A symbol's name as it is written in this language.
    fn written(&self, name: &str) -> String;
}

/// The word of letters, digits and `_` around an offset.
pub(crate) fn word_around(text: &str, offset: usize) -> Span {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (before, after) = text.split_at_checked(floor(offset, text)).unwrap_or((text, ""));
    let start = before.trim_end_matches(is_word).len();
    let end = text.len() - after.trim_start_matches(is_word).len();
    Span::new(start, end)
}
