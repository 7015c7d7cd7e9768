//! Files of any language as one AWL program with its places, and what is wrong with them. It reads
//! no files: texts are given to it.

mod findings;
mod join;
mod read;

use std::path::Path;

use awl_asm::diagnostic::Code as AwlCode;
use awl_asm::source::Source;
use diagnostics::Severity;

pub use findings::{Code, Diagnostic, Findings};

/// The language of a file, by the ending of its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// AWL, also where the ending says nothing.
    Awl,
    /// Structured Text.
    StructuredText,
    /// Charts, as text.
    Chart,
}

impl Language {
    /// That of a file.
    pub fn of(name: &str) -> Language {
        let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
        match ending.map(str::to_lowercase).as_deref() {
            Some("st") => Language::StructuredText,
            Some("sfc") => Language::Chart,
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
}

/// Makes one AWL text of the texts of a program. What is wrong with them comes all at once.
pub fn join(sources: Vec<Source>) -> Result<Joined, Vec<Findings>> {
    let is_awl = |source: &Source| Language::of(&source.name) == Language::Awl;
    if sources.iter().all(is_awl) {
        // It fails above four gigabytes alone.
        let awl = Source::joined(sources).map_err(|_| Vec::new())?;
        return Ok(Joined { awl, is_generated: false, findings: Vec::new() });
    }
    let (awl, texts): (Vec<Source>, Vec<Source>) = sources.into_iter().partition(is_awl);
    let around = join::around(&awl);
    let read::Read { files, of_st, mut others } = read::read(&texts);
    let compiled = st::translate(&texts, &files, of_st, &around);
    let name = awl.iter().chain(&texts).next().map_or("program", |source| source.name.as_str());
    let name = name.to_owned();
    let mut findings: Vec<Findings> =
        texts.into_iter().map(|source| Findings { source, diagnostics: Vec::new() }).collect();
    others.extend(compiled.diagnostics.into_iter().map(|(at, one)| (at, findings::from_st(one))));
    others.sort_by_key(|(_, one)| one.span);
    for (file, one) in others {
        if let Some(findings) = findings.get_mut(file) {
            findings.diagnostics.push(one);
        }
    }
    findings.retain(|one| !one.diagnostics.is_empty());
    let is_bad = has_errors(&findings);
    let Some(generated) = compiled.awl.filter(|_| !is_bad) else { return Err(findings) };
    let text = join::text(&awl, &generated);
    match Source::new(name, text) {
        Ok(awl) => Ok(Joined { awl, is_generated: true, findings }),
        Err(_) => Err(findings),
    }
}

/// Whether there are errors.
pub fn has_errors(findings: &[Findings]) -> bool {
    let mut all = findings.iter().flat_map(|findings| &findings.diagnostics);
    all.any(|one| one.severity() == Severity::Error)
}

/// What the assembler says about a joined text. Of one that was made from others its author hears
/// what he can mend: errors, and that the program is too large.
pub fn from_awl(
    diagnostics: Vec<awl_asm::diagnostic::Diagnostic>,
    is_generated: bool,
) -> Vec<Diagnostic> {
    let all = diagnostics.into_iter().filter(|one| {
        !is_generated || one.severity() == Severity::Error || one.code == AwlCode::NotForBoard
    });
    all.map(findings::from_awl).collect()
}
