//! A program of the project: its texts together, checked and assembled, and which place of the text
//! that all of them became is which place of a file.

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::ast::Symbol;
use awl_asm::diagnostic::Diagnostic;
use diagnostics::{At, Source, Span};
use project::{StructuredText, Together, of_generated, together};
use st::Routine;

use crate::answer::Problem;

/// A program with the tables that belong to it.
#[derive(Debug)]
pub(crate) struct Model {
    /// The texts, by the numbers of their files.
    sources: Vec<Source>,
    together: Together,
    /// What the assembler made of it.
    pub assembly: Assembly,
    /// What is wrong with periods, by the numbers of the files in Structured Text.
    periods: Vec<(usize, project::Diagnostic)>,
}

impl Model {
    /// Checks and assembles texts; `None` where they are too long for that.
    pub(crate) fn of(sources: Vec<Source>, symbols: Vec<Symbol>) -> Option<Model> {
        let together = together(&sources).ok()?;
        let assembly = assemble(&together.awl, symbols);
        let periods = together.st.as_ref().map_or_else(Vec::new, |st| st.periods(&assembly));
        Some(Model { sources, together, assembly, periods })
    }

    /// The AWL text of all files, whose places the assembly has.
    pub(crate) fn awl(&self) -> &Source {
        &self.together.awl
    }

    /// The Structured Text in it.
    pub(crate) fn st(&self) -> Option<&StructuredText> {
        self.together.st.as_ref()
    }

    /// A text by the number of its file.
    pub(crate) fn source(&self, file: usize) -> Option<&Source> {
        self.sources.get(file)
    }

    /// The number of a text's file.
    pub(crate) fn file(&self, name: &str) -> Option<usize> {
        self.sources.iter().position(|source| source.name == name)
    }

    /// The number that a text has among those in Structured Text.
    pub(crate) fn st_file(&self, name: &str) -> Option<usize> {
        let file = self.file(name)?;
        self.st()?.files.iter().position(|&one| one == file)
    }

    /// A text in Structured Text by the number that it has among those.
    pub(crate) fn st_source(&self, number: usize) -> Option<&Source> {
        self.source(*self.st()?.files.get(number)?)
    }

    /// The subroutines in AWL that Structured Text can call.
    pub(crate) fn routines(&self) -> Vec<Routine> {
        self.st().map_or_else(Vec::new, |st| st.routines.clone())
    }

    /// Whether the texts in Structured Text have errors: then there is no AWL of them.
    pub(crate) fn is_without_awl(&self) -> bool {
        self.st().is_some_and(|st| st.compiled.awl.is_none())
    }

    /// A symbol by its name in lower case.
    pub(crate) fn symbol(&self, name: &str) -> Option<&Symbol> {
        self.assembly.program.symbols.iter().find(|symbol| symbol.name.to_lowercase() == name)
    }

    /// Where an offset of a file is in the text of all.
    pub(crate) fn offset_in_all(&self, file: usize, offset: usize) -> Option<usize> {
        let parts = self.together.parts.iter().filter(|part| part.file == file);
        let part = parts.take_while(|part| part.span.start as usize <= offset).last()?;
        let inside = offset.min(part.span.end as usize) - part.span.start as usize;
        Some(part.at as usize + inside)
    }

    /// Which stretch of which file is in the text of all there; `None` where that is made of
    /// others.
    pub(crate) fn in_file(&self, span: Span) -> Option<(usize, Span)> {
        let (file, start) = self.offset_in_file(span.start)?;
        let end = self.offset_in_file(span.end).filter(|(other, _)| *other == file);
        // What goes on in the next file ends with this one.
        let whole = self.sources.get(file).map_or(0, |source| source.text.len() as u32);
        Some((file, Span { start, end: end.map_or(whole, |(_, end)| end).max(start) }))
    }

    fn offset_in_file(&self, offset: u32) -> Option<(usize, u32)> {
        let parts = &self.together.parts;
        let after = parts.partition_point(|part| part.at <= offset);
        let part = parts.get(after.checked_sub(1)?)?;
        let inside = offset - part.at;
        let is_inside = inside <= part.span.end - part.span.start;
        is_inside.then_some((part.file, part.span.start + inside))
    }

    /// What is wrong with a text.
    pub(crate) fn problems(&self, name: &str) -> Vec<Problem> {
        let Some(source) = self.file(name).and_then(|file| self.sources.get(file)) else {
            return Vec::new();
        };
        let text = &source.text;
        let number = self.st_file(name);
        let found = self.st().into_iter().flat_map(|st| &st.compiled.diagnostics);
        let of_st = found.filter(|(file, _)| Some(*file) == number);
        let of_st = of_st.map(|(_, one)| Problem::of(one.clone(), text));
        let others = self.st().into_iter().flat_map(|st| &st.others).chain(&self.periods);
        let others = others.filter(|(file, _)| Some(*file) == number);
        let others = others.map(|(_, one)| Problem::of(one.clone(), text));
        // Calls of what has no AWL yet would be errors.
        let all = match self.is_without_awl() {
            true => &[][..],
            false => &self.assembly.diagnostics,
        };
        let placed = all.iter().filter_map(|one| self.placed(one.clone(), name));
        others.chain(of_st).chain(placed.map(|one| Problem::of(one, text))).collect()
    }

    /// One of the assembler's with its places in a file, if it is about that.
    fn placed(&self, one: Diagnostic, name: &str) -> Option<Diagnostic> {
        let wanted = self.file(name)?;
        if let Some((file, span)) = self.in_file(one.span) {
            let related = one.related.iter().filter_map(|(span, words)| {
                let (file, span) = self.in_file(*span)?;
                (file == wanted).then(|| (span, words.clone()))
            });
            let related = related.collect();
            return (file == wanted).then_some(Diagnostic { span, related, ..one });
        }
        // About what was generated its author hears what he can mend.
        let (file, span) = self.origin(one.span).unwrap_or_default();
        let one = Diagnostic { span, suggestion: None, related: Vec::new(), ..one };
        of_generated(one).filter(|_| file == wanted)
    }

    /// The rest of the line that something generated comes from.
    fn origin(&self, span: Span) -> Option<(usize, Span)> {
        let place = self.awl().origin(span.start as usize)?;
        let At::Line { line, column } = place.at else { return None };
        let file = self.file(&place.file)?;
        let source = self.sources.get(file)?;
        let of_line = source.line_span(line);
        let text = of_line.text(&source.text);
        let before = text.chars().take(column.unwrap_or(1).saturating_sub(1));
        let start = of_line.start + before.map(char::len_utf8).sum::<usize>() as u32;
        Some((file, Span { start, ..of_line }))
    }
}
