//! The texts of a project, which of them make a program, and the questions about them.

use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::rc::Rc;

use awl_asm::symbols::load;
use awl_sim::scenario::plant_file_of;
use chart::text::Document;
use diagnostics::source::SourceError;
use diagnostics::{Source, Span};
use project::ENDINGS;

use crate::answer::{
    Completion, Edit, FileEdit, Hover, Location, Outline, Problem, Refusal, Signature, floor,
};
use crate::awl::Awl;
use crate::block::Block;
use crate::charts::Charts;
use crate::explain::explain;
use crate::ladder::{Drawing, drawing_at};
use crate::language::{Language, Text, View};
use crate::model::Model;
use crate::names::{is_table_of, joined, split};
use crate::plant::Plant;
use crate::programs::{Known, files_of_scenario, programs};
use crate::rename;
use crate::scenario::Scenario;
use crate::structured::{StructuredText, check_free, is_library};
use crate::subject::{Mention, Subject};
use crate::symbols::Symbols;

/// A set of named texts. Names are paths with `/`, from wherever they are counted.
///
/// The files that a scenario names in its line `program A, B` are one program. Every other file in
/// AWL, Structured Text, of charts or with a block is a program by itself; files in Structured Text
/// without a PROGRAM belong to each program in Structured Text or of charts of their folder.
///
/// A scenario belongs to the program that its line `program` names, otherwise to the one of the
/// same folder with the same name (`motor.fast.scn` to `motor.awl`, else `motor.st`, `.sfc` or
/// `.fbt`, as in `awl-sim test`); a symbol table to the one with the same name, a table
/// `symbols.csv` or `symbols.txt` to all programs of its folder.
#[derive(Debug, Default)]
pub struct Project {
    texts: BTreeMap<String, Entry>,
    /// Which texts are programs, once it was asked since a text has changed.
    programs: OnceCell<Vec<Vec<String>>>,
    /// The programs that were asked about since then, by the names of their texts.
    models: RefCell<HashMap<Vec<String>, Option<Rc<Model>>>>,
}

#[derive(Debug)]
struct Entry {
    language: Language,
    source: Source,
    /// Whether it is Structured Text without a PROGRAM.
    is_library: bool,
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
        let is_library = language == Language::StructuredText && is_library(&source);
        self.texts.insert(name.to_owned(), Entry { language, source, is_library });
        self.changed();
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
        self.changed();
    }

    /// What was found out about the texts before is not true any more.
    fn changed(&mut self) {
        self.programs.take();
        self.models.get_mut().clear();
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
            .any(|(other, entry)| entry.language.is_program() && is_table_of(name, other))
    }

    /// The files that a scenario names as its program, whether the project has them or not.
    pub fn named_program(&self, name: &str) -> Vec<String> {
        let entry = self.texts.get(name).filter(|entry| entry.language == Language::Scenario);
        entry.map_or_else(Vec::new, |entry| files_of_scenario(name, &entry.source.text))
    }

    /// The texts of the program that a text is or belongs to, the main one first.
    pub fn program(&self, name: &str) -> Vec<String> {
        self.programs_of(name).into_iter().next().unwrap_or_default()
    }

    /// The names of the texts that belong together with this one, itself included, in order: what
    /// is true of one of them may change with another.
    pub fn related(&self, name: &str) -> Vec<String> {
        let mut programs = self.programs_of(name);
        // A table or file that is shared brings the other programs along.
        let files: Vec<String> = programs.iter().flatten().cloned().collect();
        let tables: Vec<&str> = files.iter().flat_map(|file| self.tables_of(file)).collect();
        programs.extend(tables.into_iter().flat_map(|table| self.programs_of(table)));
        programs.extend(files.iter().flat_map(|file| self.programs_of(file)));
        let is_related =
            |other: &str| self.programs_of(other).iter().any(|program| programs.contains(program));
        self.names()
            .filter(|other| *other == name || is_related(other))
            .map(str::to_owned)
            .collect()
    }

    /// What is wrong with a text, in whichever of its programs. Of a table that belongs to no
    /// program nothing is said: it may be anything.
    pub fn problems(&self, name: &str) -> Vec<Problem> {
        let is_nobodys =
            self.language(name) == Some(Language::Symbols) && self.programs_of(name).is_empty();
        if is_nobodys {
            return Vec::new();
        }
        let Some(Entry { language, source, .. }) = self.texts.get(name) else { return Vec::new() };
        let missing = self.missing(name);
        let mut all: Vec<Problem> = Vec::new();
        let programs = self.programs_of(name);
        for program in programs.iter().map(Some).chain(programs.is_empty().then_some(None)) {
            let model = program.and_then(|program| self.model(program));
            let other = |name: &str| self.source(name).map(|source| source.text.as_str());
            let view = View { source, model: model.as_deref(), other: &other, missing: &missing };
            let found = text_of(*language).problems(view);
            all.extend(found.into_iter().filter(|one| !all.contains(one)).collect::<Vec<_>>());
        }
        all
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
        let mut text = explain(&mention, model.as_deref());
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
        let is_standard = matches!(found.subject, Subject::Structured(_))
            && !self.mentions_of(&found.subject, name).iter().any(|(_, one)| one.declares);
        if is_standard {
            return Err(Refusal("this is a name of the standard".to_owned()));
        }
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
        if let Some(model) = self.model_of(name) {
            check_free(&subject, new_name, &model)?;
        }
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

    /// What the call around an offset takes; `None` where there is none.
    pub fn signature(&self, name: &str, offset: usize) -> Option<Signature> {
        self.ask(name, |language, view| language.signature(view, floor(offset, view.text())))?
    }

    /// The parts of a text.
    pub fn outline(&self, name: &str) -> Vec<Outline> {
        self.ask(name, |language, view| language.outline(view)).unwrap_or_default()
    }

    /// The network at an offset of a program as a ladder; `None` where there is none.
    pub fn ladder(&self, name: &str, offset: usize) -> Option<Drawing> {
        let entry = self.texts.get(name).filter(|entry| entry.language == Language::Awl)?;
        // A drawing has the lines of its file alone.
        let model = match self.program(name).len() {
            1 => self.model_of(name)?,
            _ => Rc::new(self.model_of_files(&[name.to_owned()])?),
        };
        drawing_at(&entry.source, &model.assembly, offset)
    }

    /// A text with charts as it is read; `None` where there is no such text.
    pub fn charts(&self, name: &str) -> Option<Document> {
        let entry = self.texts.get(name).filter(|entry| entry.language == Language::Chart)?;
        Some(chart::text::read(&entry.source).document)
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
        let Entry { language, source, .. } = self.texts.get(name)?;
        let (model, missing) = (self.model_of(name), self.missing(name));
        let other = |name: &str| self.source(name).map(|source| source.text.as_str());
        let view = View { source, model: model.as_deref(), other: &other, missing: &missing };
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

    /// The words for a thing. What belongs to a unit in AWL is in its program alone.
    fn mentions_of(&self, subject: &Subject, name: &str) -> Found {
        let mut found = self.all_mentions(name);
        let is_local = matches!(
            subject,
            Subject::Local(..) | Subject::Label(..) | Subject::Unit(_) | Subject::Instruction(_)
        );
        let program = self.program(name);
        found.retain(|(file, mention)| {
            mention.is_about(subject) && (!is_local || program.contains(file))
        });
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

    /// The programs that a text belongs to.
    fn programs_of(&self, name: &str) -> Vec<Vec<String>> {
        let Some(entry) = self.texts.get(name) else { return Vec::new() };
        let mut all = self.programs().to_vec();
        match entry.language {
            Language::Awl | Language::StructuredText | Language::Chart | Language::Block => {
                all.retain(|program| program.iter().any(|file| file == name));
            }
            Language::Scenario => {
                let wanted = self.program_of_scenario(name, &entry.source.text);
                all.retain(|program| match wanted.as_slice() {
                    [] => false,
                    // A file that is in several programs is meant by itself.
                    [file] => program.contains(file),
                    files => program == files,
                });
                all.sort_by_key(|program| program.first() != wanted.first());
                all.truncate(1);
            }
            Language::Plant => {
                let scenarios = self.names().filter(|scenario| {
                    let source = self.source(scenario);
                    let file = source.and_then(|source| plant_file_of(&source.text));
                    file.is_some_and(|file| joined(scenario, file) == name)
                });
                all = scenarios.flat_map(|scenario| self.programs_of(scenario)).collect();
            }
            Language::Symbols => {
                all.retain(|program| program.iter().any(|file| is_table_of(name, file)));
            }
        }
        all
    }

    /// The programs of the project.
    fn programs(&self) -> &[Vec<String>] {
        self.programs.get_or_init(|| {
            let known = self.texts.iter().map(|(name, entry)| {
                let Entry { language, ref source, is_library } = *entry;
                (name.as_str(), Known { language, text: &source.text, is_library })
            });
            programs(&known.collect())
        })
    }

    /// The files of a scenario's program.
    fn program_of_scenario(&self, name: &str, text: &str) -> Vec<String> {
        let named = files_of_scenario(name, text);
        if !named.is_empty() {
            return named;
        }
        let (folder, file) = split(name);
        let mut stem = file;
        while let Some((shorter, _)) = stem.rsplit_once('.') {
            stem = shorter;
            let programs = ENDINGS.map(|ending| format!("{folder}{stem}.{ending}"));
            let is_there =
                |file: &String| self.language(file).is_some_and(|language| language.is_program());
            if let Some(program) = programs.into_iter().find(is_there) {
                return vec![program];
            }
        }
        Vec::new()
    }

    /// The files that a scenario names and the project lacks.
    fn missing(&self, name: &str) -> Vec<String> {
        let mut named = self.named_program(name);
        named.retain(|file| !self.texts.contains_key(file));
        named
    }

    fn tables_of(&self, program: &str) -> impl Iterator<Item = &str> {
        let tables = self.texts.iter().filter(|(_, entry)| entry.language == Language::Symbols);
        let tables = tables.map(|(name, _)| name.as_str());
        tables.filter(move |table| is_table_of(table, program)).collect::<BTreeSet<_>>().into_iter()
    }

    /// The program that a text is or belongs to; of several the first.
    fn model_of(&self, name: &str) -> Option<Rc<Model>> {
        self.model(self.programs_of(name).first()?)
    }

    /// A program, assembled with its tables.
    fn model(&self, program: &[String]) -> Option<Rc<Model>> {
        if let Some(model) = self.models.borrow().get(program) {
            return model.clone();
        }
        let model = self.model_of_files(program).map(Rc::new);
        self.models.borrow_mut().insert(program.to_vec(), model.clone());
        model
    }

    fn model_of_files(&self, program: &[String]) -> Option<Model> {
        let tables: BTreeSet<&str> = program.iter().flat_map(|file| self.tables_of(file)).collect();
        let tables = tables.into_iter().filter_map(|table| self.source(table));
        let symbols = tables.flat_map(|table| load(table).0).collect();
        let sources: Option<_> = program.iter().map(|file| self.source(file).cloned()).collect();
        Model::of(sources?, symbols)
    }
}

/// What answers for a language.
fn text_of(language: Language) -> &'static dyn Text {
    match language {
        Language::Awl => &Awl,
        Language::StructuredText => &StructuredText,
        Language::Chart => &Charts,
        Language::Block => &Block,
        Language::Scenario => &Scenario,
        Language::Symbols => &Symbols,
        Language::Plant => &Plant,
    }
}

fn locations(found: Found) -> Vec<Location> {
    found.into_iter().map(|(file, mention)| Location { file, span: mention.span }).collect()
}
