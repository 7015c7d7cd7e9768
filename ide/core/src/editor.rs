//! The texts of the project and the questions of an editor, in the page's offsets. What is known of
//! texts, `analysis` knows.

use std::collections::BTreeMap;

use analysis::ladder::Drawing;
use analysis::{CompletionKind, Language, Location, OutlineKind, Project};
use awl_sim::plant::{PlantSpec, SpecErrors, parse_spec_with};
use awl_sim::scenario::plant_of;
use diagnostics::{Severity, Source, Span};

use crate::offsets::{of_page, to_page};
use crate::protocol::{Completion, Edit, Edits, File, Hover, Item, Place, Problem};

/// The project.
#[derive(Debug, Default)]
pub struct Editor {
    project: Project,
    texts: BTreeMap<String, String>,
    main: Option<String>,
}

impl Editor {
    /// Another project.
    pub fn open(&mut self, files: Vec<File>, main: Option<String>) -> Result<(), String> {
        *self = Editor { main, ..Editor::default() };
        files.into_iter().try_for_each(|File { name, text }| self.set(&name, text))
    }

    /// A file is new or has another text.
    pub fn set(&mut self, name: &str, text: String) -> Result<(), String> {
        self.project.set(name, text.clone()).map_err(|error| error.to_string())?;
        self.texts.insert(name.to_owned(), text);
        Ok(())
    }

    /// A file is gone.
    pub fn remove(&mut self, name: &str) {
        self.project.remove(name);
        self.texts.remove(name);
    }

    /// A file has another name.
    pub fn rename(&mut self, name: &str, to: &str) -> Result<(), String> {
        if self.texts.contains_key(to) {
            return Err(format!("there is a file {to} already"));
        }
        let text =
            self.texts.get(name).cloned().ok_or_else(|| format!("there is no file {name}"))?;
        self.set(to, text)?;
        self.remove(name);
        if self.main.as_deref() == Some(name) {
            self.main = Some(to.to_owned());
        }
        Ok(())
    }

    /// Another program is run.
    pub fn choose(&mut self, main: String) {
        self.main = Some(main);
    }

    /// The program: the one that was chosen, otherwise the first.
    pub fn main(&self) -> Option<&str> {
        let chosen = self.main.as_deref().filter(|name| self.texts.contains_key(*name));
        let programs = self.texts.keys().map(String::as_str).filter(|name| is_program(name));
        // The first that is no part of another's program.
        let is_main = |name: &&str| self.files_of(name).first().is_some_and(|main| main == name);
        chosen.or_else(|| programs.clone().find(is_main)).or_else(|| programs.clone().next())
    }

    /// The files of the program that a file is or belongs to, the main one first.
    pub fn files_of(&self, name: &str) -> Vec<String> {
        self.project.program(name)
    }

    /// The program of a scenario: the one that it belongs to, otherwise the one that is run.
    pub fn program_of(&self, scenario: &str) -> Option<String> {
        let own = self.files_of(scenario).into_iter().next();
        own.or_else(|| self.main().map(str::to_owned))
    }

    /// A file with its text.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.texts.get(name).map(String::as_str)
    }

    /// A plant as `awl-sim --plant` takes it; files are those of the project.
    pub fn plant(&self, spec: &str) -> Result<PlantSpec, String> {
        let mut read = |file: &str| {
            let text = self.text(file).map(str::to_owned);
            text.ok_or_else(|| format!("there is no file {file}"))
        };
        parse_spec_with(spec, &mut read).map_err(|errors| match errors {
            SpecErrors::File(errors) => errors.first(),
            SpecErrors::Spec(problems) => {
                let messages = problems.into_iter().map(|problem| problem.message);
                messages.collect::<Vec<_>>().join("; ")
            }
        })
    }

    /// The plant of the file that a scenario with this text names.
    pub fn plant_of(&self, name: &str, text: &str) -> Result<Option<PlantSpec>, String> {
        let mut read = |file: &str| {
            let source = self.project.beside(name, file);
            let text = source.map(|source| source.text.clone());
            text.ok_or_else(|| format!("{file} is not in the project"))
        };
        plant_of(name, text, &mut read).map_err(|error| error.to_string())
    }

    /// The text of a file.
    pub fn source(&self, name: &str) -> Option<&Source> {
        self.project.source(name)
    }

    /// The symbol tables of a program's files.
    pub fn tables(&self, files: &[String]) -> Vec<Source> {
        let mut tables: Vec<Source> =
            files.iter().flat_map(|file| self.project.tables(file)).cloned().collect();
        tables.sort_by(|one, other| one.name.cmp(&other.name));
        tables.dedup_by(|one, other| one.name == other.name);
        tables
    }

    /// What is wrong in all files.
    pub fn problems(&self) -> Vec<Problem> {
        self.texts.keys().flat_map(|name| self.problems_of(name)).collect()
    }

    fn problems_of(&self, name: &str) -> Vec<Problem> {
        let Some(source) = self.project.source(name) else { return Vec::new() };
        let place = |span: Span| self.place(name, span);
        let of = |problem: analysis::Problem| {
            let (line, column) = source.position(problem.span.start as usize);
            let Place { from, to, .. } = place(problem.span);
            let related = problem.related.into_iter();
            Problem {
                file: name.to_owned(),
                code: problem.code.unwrap_or_default().to_owned(),
                is_error: problem.severity == Severity::Error,
                from,
                to,
                line: line as u32,
                column: column as u32,
                message: problem.message,
                help: problem.help,
                suggestion: problem.fix.map(|fix| fix.edit.text),
                related: related.map(|(span, words)| (place(span), words)).collect(),
            }
        };
        self.project.problems(name).into_iter().map(of).collect()
    }

    /// What could be written.
    pub fn complete(&self, name: &str, at: u32) -> Vec<Completion> {
        let of = |found: analysis::Completion| Completion {
            label: found.label,
            kind: kind(found.kind).to_owned(),
            detail: found.detail,
            info: found.doc,
            holes: found.holes.iter().map(|&at| to_page(&found.edit.text, at)).collect(),
            insert: found.edit.text,
            from: self.place(name, found.edit.span).from,
        };
        self.project.completions(name, self.byte(name, at)).into_iter().map(of).collect()
    }

    /// What is there.
    pub fn hover(&self, name: &str, at: u32) -> Option<Hover> {
        let found = self.project.hover(name, self.byte(name, at))?;
        let Place { from, to, .. } = self.place(name, found.span);
        Some(Hover { text: found.text, from, to })
    }

    /// Where it is declared.
    pub fn definition(&self, name: &str, at: u32) -> Option<Place> {
        let found = self.project.definition(name, self.byte(name, at)).into_iter().next()?;
        Some(self.located(found))
    }

    /// Where it is named.
    pub fn references(&self, name: &str, at: u32) -> Vec<Place> {
        let found = self.project.references(name, self.byte(name, at));
        found.into_iter().map(|location| self.located(location)).collect()
    }

    /// Gives it another name.
    pub fn rename_symbol(&self, name: &str, at: u32, to: &str) -> Result<Edits, String> {
        let edits = self.project.rename(name, self.byte(name, at), to);
        let edits = edits.map_err(|refusal| refusal.to_string())?.into_iter();
        let of = |change: analysis::FileEdit| Edit {
            place: self.place(&change.file, change.edit.span),
            text: change.edit.text,
        };
        Ok(edits.map(of).collect())
    }

    /// Gives a file its layout.
    pub fn format(&self, name: &str) -> Result<Edits, String> {
        let edit = self.project.format(name).map_err(|refusal| refusal.to_string())?;
        let of =
            |edit: analysis::Edit| Edit { place: self.place(name, edit.span), text: edit.text };
        Ok(edit.into_iter().map(of).collect())
    }

    /// The parts of a file, those in others after them.
    pub fn outline(&self, name: &str) -> Vec<Item> {
        let mut items = Vec::new();
        self.add_items(name, self.project.outline(name), &mut items);
        items
    }

    fn add_items(&self, name: &str, parts: Vec<analysis::Outline>, items: &mut Vec<Item>) {
        let Some(source) = self.project.source(name) else { return };
        for part in parts {
            let kind = match part.kind {
                OutlineKind::Unit => "unit",
                OutlineKind::Network => "network",
                OutlineKind::Label => "label",
                OutlineKind::Symbol => "symbol",
            };
            items.push(Item {
                name: format!("{} {}", part.name, part.detail).trim().to_owned(),
                kind: kind.to_owned(),
                line: source.position(part.name_span.start as usize).0 as u32,
                from: self.place(name, part.name_span).from,
            });
            self.add_items(name, part.children, items);
        }
    }

    /// The network there as a ladder.
    pub fn ladder(&self, name: &str, at: u32) -> Option<Drawing> {
        self.project.ladder(name, self.byte(name, at))
    }

    /// A file with charts; `None` where it is of another kind.
    pub fn charts(&self, name: &str) -> Option<analysis::chart::text::Document> {
        self.project.charts(name)
    }

    /// A line of a file as a place.
    pub fn line(&self, name: &str, line: usize) -> Option<Place> {
        let text = self.text(name)?;
        let start = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum();
        let len = text.get(start..)?.lines().next().map_or(0, str::len);
        Some(self.place(name, Span::new(start, start + len)))
    }

    fn located(&self, Location { file, span }: Location) -> Place {
        self.place(&file, span)
    }

    fn place(&self, name: &str, span: Span) -> Place {
        let text = self.text(name).unwrap_or_default();
        let [from, to] = [span.start, span.end].map(|byte| to_page(text, byte as usize));
        Place { file: name.to_owned(), from, to }
    }

    fn byte(&self, name: &str, at: u32) -> usize {
        of_page(self.text(name).unwrap_or_default(), at)
    }
}

/// Whether a file of this name is a program.
fn is_program(name: &str) -> bool {
    Language::of_name(name).is_some_and(Language::is_program)
}

fn kind(kind: CompletionKind) -> &'static str {
    match kind {
        CompletionKind::Instruction => "instruction",
        CompletionKind::Keyword => "keyword",
        CompletionKind::Symbol => "symbol",
        CompletionKind::Variable => "variable",
        CompletionKind::Address => "address",
        CompletionKind::Routine => "routine",
        CompletionKind::Label => "label",
        CompletionKind::Value => "value",
    }
}
