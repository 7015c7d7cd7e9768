//! Diagnostics on standard error, for people and for programs. What they say is known already.

use std::collections::HashMap;
use std::fmt;
use std::io::{IsTerminal, Write};

use clap::{Args, ValueEnum};
use diagnostics::{Code, Diagnostic, Severity};

use crate::render;
use crate::source::Source;

/// How diagnostics are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// With source lines and carets.
    Human,
    /// One line each, for editors: `file:line:column: error[E0012]: message`.
    Short,
    /// One JSON object a line.
    Json,
}

/// What command lines say about messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Args)]
pub struct Messages {
    /// How diagnostics are written
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = MessageFormat::Human)]
    pub message_format: MessageFormat,

    /// Writes neither warnings nor summaries; errors stay
    #[arg(short, long)]
    pub quiet: bool,
}

/// Errors in a program with terminal colours, ready to be shown as they are: an error of whoever
/// opens programs.
#[derive(Debug)]
pub struct ProgramErrors(pub String);

impl fmt::Display for ProgramErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.trim_end())
    }
}

impl std::error::Error for ProgramErrors {}

/// Warnings with the same code that people are shown; more would hide the others.
const SHOWN_MAX: usize = 5;

/// Shows diagnostics and counts them.
#[derive(Debug)]
pub struct Report {
    messages: Messages,
    denies_warnings: bool,
    errors: usize,
    warnings: usize,
}

impl Report {
    /// One that has shown nothing yet.
    pub fn new(messages: Messages, denies_warnings: bool) -> Report {
        Report { messages, denies_warnings, errors: 0, warnings: 0 }
    }

    /// Whether nothing was shown that a program must not have.
    pub fn is_good(&self) -> bool {
        self.errors == 0 && !(self.denies_warnings && self.warnings > 0)
    }

    /// Whether people want to know what was done besides.
    pub fn has_summary(&self) -> bool {
        self.messages.message_format == MessageFormat::Human && !self.messages.quiet
    }

    /// Shows the diagnostics of a text: to people errors last, where they are seen, and of many
    /// equal warnings the first. Warnings that are denied are shown even if they are not wanted:
    /// nothing fails without a word.
    pub fn show<C: Code>(&mut self, source: &Source, diagnostics: &[Diagnostic<C>]) {
        let is_error = |diagnostic: &&Diagnostic<C>| diagnostic.severity() == Severity::Error;
        let errors = diagnostics.iter().filter(is_error).count();
        self.errors += errors;
        self.warnings += diagnostics.len() - errors;
        let hides_warnings = self.messages.quiet && !self.denies_warnings;
        let shown = diagnostics.iter().filter(|one| !hides_warnings || is_error(one));
        let text = match self.messages.message_format {
            MessageFormat::Human => human(source, shown, std::io::stderr().is_terminal()),
            MessageFormat::Short => shown.map(|one| render::short(source, one) + "\n").collect(),
            MessageFormat::Json => shown.map(|one| render::json(source, one) + "\n").collect(),
        };
        // Nobody is left to tell when stderr is closed.
        let _ = anstream::stderr().write_all(text.as_bytes());
    }

    /// The last line, as of a compiler.
    pub fn finish(&self, source: &Source) {
        if !self.has_summary() || self.errors + self.warnings == 0 {
            return;
        }
        let count = |count: usize, what: &str| match count {
            0 => None,
            1 => Some(format!("1 {what}")),
            count => Some(format!("{count} {what}s")),
        };
        let counts: Vec<String> = [count(self.errors, "error"), count(self.warnings, "warning")]
            .into_iter()
            .flatten()
            .collect();
        let files: Vec<&str> = source.files().map(|(name, _)| name).collect();
        eprintln!("{}: {}", files.join(", "), counts.join(", "));
        if self.errors > 0 {
            eprintln!("`awl-asm --explain CODE` tells more about a code");
        } else if !self.is_good() {
            eprintln!("--deny-warnings: a program with warnings is not assembled");
        }
    }
}

/// Diagnostics for people, with terminal colours if asked for: warnings before errors; of a warning
/// that is there many times the first places.
pub fn human<'d, C: Code + 'd>(
    source: &Source,
    diagnostics: impl Iterator<Item = &'d Diagnostic<C>> + Clone,
    styled: bool,
) -> String {
    let mut counts: HashMap<Option<&str>, usize> = HashMap::new();
    for diagnostic in diagnostics.clone() {
        *counts.entry(diagnostic.code.text()).or_default() += 1;
    }
    let mut shown: HashMap<Option<&str>, usize> = HashMap::new();
    let (mut warnings, mut errors) = (String::new(), String::new());
    for diagnostic in diagnostics {
        let text = || render::human(source, diagnostic, styled) + "\n";
        let code = diagnostic.code.text();
        if diagnostic.severity() == Severity::Error {
            errors += &text();
            continue;
        }
        let number = shown.entry(code).or_default();
        *number += 1;
        let more = counts.get(&code).map_or(0, |count| count.saturating_sub(SHOWN_MAX));
        match *number {
            ..=SHOWN_MAX => warnings += &text(),
            // One more is shown rather than counted.
            number if more == 1 && number == SHOWN_MAX + 1 => warnings += &text(),
            number if number == SHOWN_MAX + 1 => {
                let (line, _) = source.position(diagnostic.span.start as usize);
                let line = match source.line_in_file(line) {
                    (file, line) if source.has_files() => format!("{file}:{line}"),
                    (_, line) => format!("line {line}"),
                };
                let code = code.map_or_else(String::new, |code| format!("[{code}]"));
                warnings += &format!("warning{code}: and {more} more, from {line} on\n\n");
            }
            _ => {}
        }
    }
    warnings + &errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assemble::assemble;

    fn shown(text: &str) -> String {
        let source = Source::new("t.awl", text).unwrap();
        human(&source, assemble(&source, Vec::new()).diagnostics.iter(), false)
    }

    #[test]
    fn many_equal_warnings_are_counted_and_errors_are_last() {
        let many = "LD I0.0\n= Q9.9\n".to_owned() + &"= Q0.0\n".repeat(21);
        let shown = shown(&many);
        assert_eq!(shown.matches("warning[W0002]: Q0.0").count(), 5, "{shown}");
        assert!(shown.contains("warning[W0002]: and 15 more, from line 9 on\n"), "{shown}");
        assert!(shown.rfind("warning[") < shown.find("error[E0005]"), "{shown}");
    }

    #[test]
    fn one_more_than_five_is_shown() {
        let shown = shown(&("LD I0.0\n".to_owned() + &"= Q0.0\n".repeat(7)));
        assert_eq!(shown.matches("warning[W0002]: Q0.0").count(), 6, "{shown}");
        assert!(!shown.contains("more"), "{shown}");
    }

    #[test]
    fn warnings_can_be_denied() {
        let source = Source::new("t.awl", "LD I0.0\n= Q0.0\n= Q0.0\n").unwrap();
        let diagnostics = assemble(&source, Vec::new()).diagnostics;
        let messages = Messages { message_format: MessageFormat::Json, quiet: false };
        for denies in [false, true] {
            let mut report = Report::new(messages, denies);
            report.show(&source, &diagnostics);
            assert_eq!(report.is_good(), !denies);
        }
    }
}
