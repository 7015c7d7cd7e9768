//! The texts of a project, which of them make a program, and the questions about them.

use std::collections::{BTreeMap, BTreeSet};

use awl_asm::assemble::assemble;
use awl_asm::symbols::load;
use awl_sim::scenario::{plant_file_of, program_of};
use diagnostics::source::SourceError;
use diagnostics::{Source, Span};

use crate::answer::{
    Completion, Edit, FileEdit, Hover, Location, Outline, Problem, Refusal, floor,
};
use crate::awl::Awl;
use crate::explain::explain;
use crate::ladder::{Drawing, drawing_at};
use crate::language::{Language, Model, Text, View};
use crate::names::{is_table_of, joined, split};
use crate::plant::Plant;
use crate::rename;
use crate::scenario::Scenario;
use crate::subject::{Mention, Subject};
use crate::symbols::Symbols;

/// A set of named texts. Names are paths with `/`, from wherever they are counted.
///
/// A scenario belongs to the program that its line `program FILE` names, otherwise to the one of
/// the same folder with the same name (`motor.fast.scn` to `motor.awl`, as in `awl-sim test`); a
/// symbol table to the one with the same name, a table `symbols.csv` or `symbols.txt` to all
/// programs of its folder.
#[derive(Debug, Default)]
pub struct Project {
    texts: BTreeMap<String, Entry>,
}

#[derive(Debug)]
struct Entry {
    language: Language,
    source: Source,
}

/// The words of a text for one thing.
type Found = Vec<(String, Mention)>;

impl Project {
    /// A project without texts.
    pub fn new() -> Project {
        Project::default()
    }

    /// Adds a text or replaces it. One of no known language is not taken.
    pub fn set(&mut self, name: &str, text: impl Into<String>) -> Result<(), SourceError> {
        match Language::of_name(name) {
            Some(language) => self.set_as(name, language, text),
            None => Ok(()),
        }
    }

    /// The same where the name does not tell the language.
    pub fn set_as(
        &mut self,
        name: &str,
        language: Language,
        text: impl Into<String>,
    ) -> Result<(), SourceError> {
        let source = Source::new(name, text)?;
        self.texts.insert(name.to_owned(), Entry { language, source });
        Ok(())
    }

    /// Replaces a text whose language stays; one that is not there is not taken.
    pub fn change(&mut self, name: &str, text: impl Into<String>) -> Result<(), SourceError> {
        match self.language(name) {
            Some(language) => self.set_as(name, language, text),
            None => Ok(()),
        }
    }

    /// Takes a text away.
    pub fn remove(&mut self, name: &str) {
        self.texts.remove(name);
    }

    /// The text of this name.
    pub fn source(&self, name: &str) -> Option<&Source> {
        self.texts.get(name).map(|entry| &entry.source)
    }

    /// The text that another one names by its path, which counts from the folder of that one.
    pub fn beside(&self, name: &str, path: &str) -> Option<&Source> {
        self.source(&joined(name, path))
    }

    /// The symbol tables that belong to a program.
    pub fn tables(&self, program: &str) -> impl Iterator<Item = &Source> {
        self.tables_of(program).filter_map(|table| self.source(table))
    }

    /// Whether a symbol table of this name would belong to a program of the project.
    pub fn is_table(&self, name: &str) -> bool {
        self.texts
            .iter()
            .any(|(other, entry)| entry.language == Language::Awl && is_table_of(name, other))
    }

    /// The program that a scenario names, whether the project has it or not.
    pub fn named_program(&self, name: &str) -> Option<String> {
        let entry = self.texts.get(name).filter(|entry| entry.language == Language::Scenario)?;
        program_of(&entry.source.text).first().map(|file| joined(name, file))
    }

    /// The names of the texts that belong together with this one, itself included, in order: what
    /// is true of one of them may change with another.
    pub fn related(&self, name: &str) -> Vec<String> {
        let mut programs = self.programs_of(name);
        // A table that is shared brings the other programs along.
        let tables: Vec<&str> =
            programs.iter().flat_map(|program| self.tables_of(program)).collect();
        programs.extend(tables.into_iter().flat_map(|table| self.programs_of(table)));
        let is_related =
            |other: &str| self.programs_of(other).iter().any(|program| programs.contains(program));
        self.names()
            .filter(|other| *other == name || is_related(other))
            .map(str::to_owned)
            .collect()
    }

    /// What is wrong with a text. Of a table that belongs to no program nothing is said: it may be
    /// anything.
    pub fn problems(&self, name: &str) -> Vec<Problem> {
        let is_nobodys =
            self.language(name) == Some(Language::Symbols) && self.programs_of(name).is_empty();
        if is_nobodys {
            return Vec::new();
        }
        self.ask(name, |language, view| language.problems(view)).unwrap_or_default()
    }

    /// What can be written at an offset.
    pub fn completions(&self, name: &str, offset: usize) -> Vec<Completion> {
        let at = |view: View<'_>| floor(offset, view.text());
        self.ask(name, |language, view| language.completions(view, at(view))).unwrap_or_default()
    }

    /// What is known of the thing at an offset.
    pub fn hover(&self, name: &str, offset: usize) -> Option<Hover> {
        let mention = self.mention_at(name, offset)?;
        let model = self.model_of(name);
        let mut text = explain(&mention, model.as_ref());
        text += &self.uses(&mention.subject, name);
        (!text.is_empty()).then_some(Hover { span: mention.span, text })
    }

    /// Where the thing at an offset is declared, or comes to be.
    pub fn definition(&self, name: &str, offset: usize) -> Vec<Location> {
        let Some(mention) = self.mention_at(name, offset) else { return Vec::new() };
        if let Subject::File(file) = mention.subject {
            let location = Location { file, span: Span::default() };
            return self.texts.get(&location.file).map(|_| location).into_iter().collect();
        }
        let mut found = self.mentions_of(&mention.subject, name);
        found.retain(|(_, mention)| mention.declares);
        locations(found)
    }

    /// Where it is named, its declaration included.
    pub fn references(&self, name: &str, offset: usize) -> Vec<Location> {
        match self.mention_at(name, offset) {
            Some(mention) => locations(self.mentions_of(&mention.subject, name)),
            None => Vec::new(),
        }
    }

    /// The name at an offset, if it can be changed.
    pub fn renamable(&self, name: &str, offset: usize) -> Result<Span, Refusal> {
        let mention = self.mention_at(name, offset);
        let found = mention.ok_or_else(|| Refusal("there is no name here".to_owned()))?;
        rename::check_subject(&found.subject)?;
        Ok(found.span)
    }

    /// Changes the name at an offset wherever it is written.
    pub fn rename(
        &self,
        name: &str,
        offset: usize,
        new_name: &str,
    ) -> Result<Vec<FileEdit>, Refusal> {
        self.renamable(name, offset)?;
        let mention = self.mention_at(name, offset);
        let Some(Mention { subject, span, .. }) = mention else { return Ok(Vec::new()) };
        rename::check_name(&subject, new_name)?;
        let others = self.all_mentions(name);
        rename::check_free(&subject, new_name, others.iter().map(|(_, mention)| mention))?;
        let old = self.source(name).map_or("", |source| span.text(&source.text));
        let mut edits = Vec::new();
        for (file, mention) in self.mentions_of(&subject, name) {
            let (Some(entry), Some(language)) = (self.texts.get(&file), self.language(&file))
            else {
                continue;
            };
            let text = &entry.source.text;
            if !rename::is_written_so(&subject, mention.span.text(text), old) {
                continue;
            }
            let text = rename::written(text_of(language), &subject, mention.span, text, new_name);
            edits.push(FileEdit { file, edit: Edit { span: mention.span, text } });
        }
        Ok(edits)
    }

    /// The parts of a text.
    pub fn outline(&self, name: &str) -> Vec<Outline> {
        self.ask(name, |language, view| language.outline(view)).unwrap_or_default()
    }

    /// The network at an offset of a program as a ladder; `None` where there is none.
    pub fn ladder(&self, name: &str, offset: usize) -> Option<Drawing> {
        let entry = self.texts.get(name).filter(|entry| entry.language == Language::Awl)?;
        let model = self.model_of(name)?;
        drawing_at(&entry.source, &model.assembly, offset)
    }

    /// The change that gives a text its canonical layout; `None` if it has that.
    pub fn format(&self, name: &str) -> Result<Option<Edit>, Refusal> {
        let text = self
            .ask(name, |language, view| language.formatted(view))
            .unwrap_or_else(|| Err(Refusal(format!("{name}: there is no such text"))))?;
        let old = self.source(name).map_or("", |source| &source.text);
        let span = Span::new(0, old.len());
        Ok((text != old).then_some(Edit { span, text }))
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.texts.keys().map(String::as_str)
    }

    fn language(&self, name: &str) -> Option<Language> {
        self.texts.get(name).map(|entry| entry.language)
    }

    /// Asks a text's language about it.
    fn ask<T>(&self, name: &str, question: impl FnOnce(&dyn Text, View<'_>) -> T) -> Option<T> {
        let Entry { language, source } = self.texts.get(name)?;
        let model = self.model_of(name);
        let other = |name: &str| self.source(name).map(|source| source.text.as_str());
        let view = View { source, model: model.as_ref(), other: &other };
        Some(question(text_of(*language), view))
    }

    /// The word at an offset; of two that touch there the one after it.
    fn mention_at(&self, name: &str, offset: usize) -> Option<Mention> {
        self.ask(name, |language, view| {
            let offset = floor(offset, view.text());
            let at = |mention: &&Mention| {
                let Span { start, end } = mention.span;
                (start as usize..=end as usize).contains(&offset)
            };
            let mentions = language.mentions(view);
            let found = mentions.iter().filter(at).max_by_key(|mention| mention.span.start);
            found.cloned().or_else(|| language.word_at(view, offset))
        })?
    }

    /// Every word of the texts that belong together with this one.
    fn all_mentions(&self, name: &str) -> Found {
        let mentions = |file: String| {
            let found = self.ask(&file, |language, view| language.mentions(view));
            found.unwrap_or_default().into_iter().map(move |mention| (file.clone(), mention))
        };
        self.related(name).into_iter().flat_map(mentions).collect()
    }

    /// The words for a thing. What belongs to a unit is in one text alone.
    fn mentions_of(&self, subject: &Subject, name: &str) -> Found {
        let mut found = self.all_mentions(name);
        let is_local = matches!(
            subject,
            Subject::Local(..) | Subject::Label(..) | Subject::Unit(_) | Subject::Instruction(_)
        );
        found.retain(|(file, mention)| mention.is_about(subject) && (!is_local || file == name));
        found
    }

    /// Where a thing is used, in Markdown.
    fn uses(&self, subject: &Subject, name: &str) -> String {
        const SHOWN: usize = 12;
        if matches!(subject, Subject::Instruction(_) | Subject::Word(_) | Subject::File(_)) {
            return String::new();
        }
        let found = self.mentions_of(subject, name);
        let lines = found.iter().filter_map(|(file, mention)| {
            let (line, _) = self.source(file)?.position(mention.span.start as usize);
            let by = match mention.by.as_str() {
                "" if mention.declares => "declared".to_owned(),
                "" => "set or expected".to_owned(),
                by => format!("`{by}`"),
            };
            Some(format!("* {}:{line} {by}", file.rsplit('/').next()?))
        });
        let mut lines: Vec<String> = lines.collect();
        let count = lines.len();
        lines.truncate(SHOWN);
        if count > SHOWN {
            lines.push(format!("* and {} more", count - SHOWN));
        }
        if lines.is_empty() { String::new() } else { format!("\n\nUsed:\n\n{}", lines.join("\n")) }
    }

    /// The programs that a text belongs to; a program to itself.
    fn programs_of(&self, name: &str) -> Vec<&str> {
        let Some(entry) = self.texts.get(name) else { return Vec::new() };
        let programs = || {
            self.texts.iter().filter(|(_, entry)| entry.language == Language::Awl).map(|(n, _)| n)
        };
        match entry.language {
            Language::Awl => {
                programs().filter(|other| *other == name).map(String::as_str).collect()
            }
            Language::Scenario => {
                let wanted = program_of_scenario(name, &entry.source.text, &|other| {
                    self.language(other) == Some(Language::Awl)
                });
                let is_wanted = |other: &&String| wanted.as_deref() == Some(other.as_str());
                programs().filter(is_wanted).map(String::as_str).collect()
            }
            Language::Plant => {
                let scenarios = self.names().filter(|scenario| {
                    let source = self.source(scenario);
                    let file = source.and_then(|source| plant_file_of(&source.text));
                    file.is_some_and(|file| joined(scenario, file) == name)
                });
                scenarios.flat_map(|scenario| self.programs_of(scenario)).collect()
            }
            Language::Symbols => {
                let is_its = |program: &&String| is_table_of(name, program);
                programs().filter(is_its).map(String::as_str).collect()
            }
        }
    }

    fn tables_of(&self, program: &str) -> impl Iterator<Item = &str> {
        let tables = self.texts.iter().filter(|(_, entry)| entry.language == Language::Symbols);
        let tables = tables.map(|(name, _)| name.as_str());
        tables.filter(move |table| is_table_of(table, program)).collect::<BTreeSet<_>>().into_iter()
    }

    /// The program that a text is or belongs to, assembled with its tables.
    fn model_of(&self, name: &str) -> Option<Model> {
        let program = *self.programs_of(name).first()?;
        let symbols = self.tables(program).flat_map(|table| load(table).0).collect();
        let assembly = assemble(self.source(program)?, symbols);
        Some(Model { assembly })
    }
}

/// What answers for a language.
fn text_of(language: Language) -> &'static dyn Text {
    match language {
        Language::Awl => &Awl,
        Language::Scenario => &Scenario,
        Language::Symbols => &Symbols,
        Language::Plant => &Plant,
    }
}

fn locations(found: Found) -> Vec<Location> {
    found.into_iter().map(|(file, mention)| Location { file, span: mention.span }).collect()
}

/// The program of a scenario with this text.
fn program_of_scenario(
    name: &str,
    text: &str,
    is_program: &dyn Fn(&str) -> bool,
) -> Option<String> {
    if let Some(file) = program_of(text).first() {
        return Some(joined(name, file));
    }
    let (folder, file) = split(name);
    let mut stem = file;
    while let Some((shorter, _)) = stem.rsplit_once('.') {
        stem = shorter;
        let program = format!("{folder}{stem}.awl");
        if is_program(&program) {
            return Some(program);
        }
    }
    None
}
