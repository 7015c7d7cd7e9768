//! Files of any language as one AWL program with its places, and what is wrong with them. It reads
//! no files: texts are given to it.

mod findings;
mod join;
mod periods;
mod read;

use std::path::Path;

use awl_asm::assemble::Assembly;
use awl_asm::diagnostic::Code as AwlCode;
use awl_asm::source::{Source, SourceError};
use diagnostics::{Severity, Span};

pub use findings::{Code, Diagnostic, Findings};
pub use join::Part;

/// The language of a file, by the ending of its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// AWL, also where the ending says nothing.
    Awl,
    /// Structured Text.
    StructuredText,
    /// Charts, as text.
    Chart,
    /// Diagrams of blocks: Structured Text of calls.
    Diagram,
    /// A function block of IEC 61499, as XML.
    Block,
    /// A project of PLCopen.
    Xml,
}

/// Endings of files in these languages; where a program is looked for, the first one that is there
/// counts.
pub const ENDINGS: [&str; 6] = ["awl", "st", "sfc", "fbd", "fbt", "xml"];

impl Language {
    /// That of a file.
    pub fn of(name: &str) -> Language {
        let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
        match ending.map(str::to_lowercase).as_deref() {
            Some("st") => Language::StructuredText,
            Some("sfc") => Language::Chart,
            Some("fbd") => Language::Diagram,
            Some("fbt") => Language::Block,
            Some("xml") => Language::Xml,
            _ => Language::Awl,
        }
    }
}

/// The texts of a program as one AWL text.
#[derive(Debug)]
pub struct Joined {
    /// The AWL text.
    pub awl: Source,
    /// Whether it was made from others.
    pub is_generated: bool,
    /// Warnings.
    pub findings: Vec<Findings>,
    /// The texts that are not AWL, and what they mean.
    compiled: Option<(Vec<Source>, st::Compiled)>,
}

impl Joined {
    /// What is wrong with its periods, which is known when it is assembled to this bytecode.
    /// `is_native`: it is to be executed as machine code.
    pub fn periods(&self, image: &[u8], assembly: &Assembly, is_native: bool) -> Vec<Findings> {
        let Some((texts, compiled)) = &self.compiled else { return Vec::new() };
        by_text(texts, periods::check(compiled, (image, assembly), is_native))
    }
}

/// The texts of a program together, with errors or without: for those who look at texts that are
/// being written.
#[derive(Debug)]
pub struct Together {
    /// The AWL text. With errors in Structured Text that of the files in AWL alone.
    pub awl: Source,
    /// The stretches of the files that it has as they are, in its order.
    pub parts: Vec<Part>,
    /// What Structured Text there is, if there is any.
    pub st: Option<StructuredText>,
}

/// The Structured Text of a program.
#[derive(Debug)]
pub struct StructuredText {
    /// The numbers of its files among all, by the numbers that it has for them.
    pub files: Vec<usize>,
    /// The subroutines in AWL that it can call.
    pub routines: Vec<st::Routine>,
    /// What is wrong with texts of other languages that become Structured Text, by their numbers
    /// among the files.
    pub others: Vec<(usize, Diagnostic)>,
    /// What the compiler found out.
    pub compiled: st::Compiled,
}

impl StructuredText {
    /// What is wrong with its periods, by the numbers of its files, when it is executed as
    /// bytecode.
    pub fn periods(&self, assembly: &Assembly) -> Vec<(usize, Diagnostic)> {
        let image = assembly.image.as_deref().unwrap_or_default();
        periods::check(&self.compiled, (image, assembly), false)
    }
}

/// Puts the texts of a program together. It fails above four gigabytes alone.
pub fn together(sources: &[Source]) -> Result<Together, SourceError> {
    let is_awl = |source: &Source| Language::of(&source.name) == Language::Awl;
    if sources.iter().all(is_awl) {
        let awl = Source::joined(sources.to_vec())?;
        let files = (0..).zip(awl.files());
        let part = |(file, (_, at)): (usize, (&str, Span))| {
            let len = sources.get(file).map_or(0, |source| source.text.len());
            Part { file, span: Span::new(0, len), at: at.start }
        };
        let parts = files.map(part).collect();
        return Ok(Together { awl, parts, st: None });
    }
    let numbered = sources.iter().cloned().enumerate();
    let (awl, texts): (Vec<_>, Vec<_>) = numbered.partition(|(_, source)| is_awl(source));
    let around = join::around(&awl);
    let (files, texts): (Vec<usize>, Vec<Source>) = texts.into_iter().unzip();
    let read::Read { files: trees, of_st, others } = read::read(&texts, awl.is_empty());
    let compiled = st::translate(&texts, &trees, of_st, &around);
    let generated = compiled.awl.as_deref().unwrap_or_default();
    let first = awl.first().map(|(_, source)| source).or(texts.first());
    let name = first.map_or_else(String::new, |source| source.name.clone());
    let (text, parts) = join::text(&awl, generated);
    let st = Some(StructuredText { files, routines: around.routines, others, compiled });
    Ok(Together { awl: Source::new(name, text)?, parts, st })
}

/// Makes one AWL text of the texts of a program. What is wrong with them comes all at once.
pub fn join(sources: Vec<Source>) -> Result<Joined, Vec<Findings>> {
    let Together { awl, st, .. } = together(&sources).map_err(|_| Vec::new())?;
    let Some(StructuredText { files, mut compiled, mut others, .. }) = st else {
        return Ok(Joined { awl, is_generated: false, findings: Vec::new(), compiled: None });
    };
    let texts: Vec<Source> = files.iter().filter_map(|&file| sources.get(file).cloned()).collect();
    let of_st = std::mem::take(&mut compiled.diagnostics).into_iter();
    others.extend(of_st.map(|(at, one)| (at, findings::from_st(one))));
    others.sort_by_key(|(_, one)| one.span);
    let findings = by_text(&texts, others);
    match compiled.awl.is_some() && !has_errors(&findings) {
        true => {
            let compiled = Some((texts, compiled));
            Ok(Joined { awl, is_generated: true, findings, compiled })
        }
        false => Err(findings),
    }
}

/// What was found, text by text; those without anything are left out.
fn by_text(texts: &[Source], found: Vec<(usize, Diagnostic)>) -> Vec<Findings> {
    let mut of_files: Vec<Vec<Diagnostic>> = texts.iter().map(|_| Vec::new()).collect();
    for (file, one) in found {
        if let Some(list) = of_files.get_mut(file) {
            list.push(one);
        }
    }
    let all = texts.iter().zip(of_files).filter(|(_, diagnostics)| !diagnostics.is_empty());
    all.map(|(source, diagnostics)| Findings { source: source.clone(), diagnostics }).collect()
}

/// A text in the canonical layout of its language; or its errors of form.
pub fn format(source: &Source) -> Result<String, Vec<Diagnostic>> {
    match Language::of(&source.name) {
        Language::Awl => awl_asm::format::format(source)
            .map_err(|errors| errors.into_iter().map(findings::from_awl).collect()),
        Language::StructuredText | Language::Diagram => st::format::format(source)
            .map_err(|errors| errors.into_iter().map(findings::from_st).collect()),
        Language::Chart => {
            let chart::text::Reading { document, diagnostics, .. } = chart::text::read(source);
            let errors = errors_of(diagnostics, findings::from_chart);
            if errors.is_empty() { Ok(chart::text::write(&document)) } else { Err(errors) }
        }
        Language::Block => {
            let fb::Read { block, diagnostics } = fb::xml::read(source);
            let errors = errors_of(diagnostics, findings::from_block);
            block.map(|block| fb::xml::write(&block)).ok_or(errors)
        }
        // Other tools write it, in their own way.
        Language::Xml => {
            let plcopen::Imported { diagnostics, .. } = plcopen::read(source);
            let errors = errors_of(diagnostics, findings::from_plcopen);
            if errors.is_empty() { Ok(source.text.clone()) } else { Err(errors) }
        }
    }
}

/// The errors among what was found, without the warnings.
fn errors_of<C: diagnostics::Code>(
    found: Vec<diagnostics::Diagnostic<C>>,
    of_all: fn(diagnostics::Diagnostic<C>) -> Diagnostic,
) -> Vec<Diagnostic> {
    let errors = found.into_iter().filter(|one| one.severity() == Severity::Error);
    errors.map(of_all).collect()
}

/// Whether there are errors.
pub fn has_errors(findings: &[Findings]) -> bool {
    let mut all = findings.iter().flat_map(|findings| &findings.diagnostics);
    all.any(|one| one.severity() == Severity::Error)
}

/// What the assembler says about AWL that was made from another language, as far as the author of
/// that can mend it: errors, that the program is too large, and points that he has chosen. A help
/// with AWL in it is not for him.
pub fn of_generated(
    one: awl_asm::diagnostic::Diagnostic,
) -> Option<awl_asm::diagnostic::Diagnostic> {
    let is_his = one.severity() == Severity::Error
        || matches!(one.code, AwlCode::NotForBoard | AwlCode::NoSuchPin | AwlCode::InputWritten);
    let help =
        one.help.iter().filter(|help| one.severity() == Severity::Error || !help.contains('`'));
    let help = help.cloned().collect();
    is_his.then_some(awl_asm::diagnostic::Diagnostic { help, ..one })
}

/// What the assembler says about a joined text. `is_generated`: it was made from others.
pub fn from_awl(
    diagnostics: Vec<awl_asm::diagnostic::Diagnostic>,
    is_generated: bool,
) -> Vec<Diagnostic> {
    let all = diagnostics.into_iter().filter_map(|one| match is_generated {
        true => of_generated(one),
        false => Some(one),
    });
    all.map(findings::from_awl).collect()
}
