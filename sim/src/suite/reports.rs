//! How the results of scenarios are asked for and told: on the terminal, as JSON, JUnit and TAP.
//! What runs the scenarios is not known here.

use std::collections::HashSet;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use awl_asm::files::{ensure_distinct, is_source, write_whole};
use clap::{Args, ValueEnum};

use super::result::TestResult;
use super::{junit, report, tap};

/// Endings of programs that are made of sources.
const PROGRAM_ENDINGS: [&str; 2] = ["bin", "hex"];

/// What is to be told, and where.
#[derive(Debug, Clone, Args)]
pub struct Reports {
    /// What is written to standard output
    #[arg(long, value_enum, default_value_t = Format::Human)]
    pub format: Format,

    /// File for the results as JUnit XML; - is standard output
    #[arg(long, value_name = "F")]
    pub junit: Option<PathBuf>,

    /// File for the results as TAP; - is standard output
    #[arg(long, value_name = "F")]
    pub tap: Option<PathBuf>,

    /// Writes neither warnings nor scenarios that are good, and no summary
    #[arg(short, long)]
    pub quiet: bool,
}

/// How results are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A line a scenario, and what failed
    Human,
    /// A JSON object a line for each scenario
    Json,
}

impl Reports {
    /// Refuses what goes wrong in any case before something is run. `inputs`: what is read.
    pub fn check<'a>(&self, inputs: impl Iterator<Item = &'a Path>) -> Result<()> {
        let files = || [&self.junit, &self.tap].into_iter().flatten();
        let on_stdout = files().filter(|path| is_stdout(path)).count();
        if on_stdout + usize::from(self.format == Format::Json) > 1 {
            bail!("only one of --junit, --tap and --format json can be on standard output");
        }
        let outputs: Vec<&Path> =
            files().filter(|path| !is_stdout(path)).map(PathBuf::as_path).collect();
        for output in &outputs {
            // A report in XML is what JUnit is.
            if !output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xml")) {
                ensure_no_source(output)?;
            }
        }
        ensure_distinct(&inputs.collect::<Vec<_>>(), &outputs)
    }

    /// Begins to tell. `tool`: what runs the scenarios.
    pub fn begin(&self, tool: &'static str) -> Telling<'_> {
        Telling { reports: self, tool, results: Vec::new(), warnings: HashSet::new() }
    }
}

/// Results, as they come in.
pub struct Telling<'a> {
    reports: &'a Reports,
    tool: &'static str,
    results: Vec<TestResult>,
    warnings: HashSet<String>,
}

impl Telling<'_> {
    /// A text for people: on standard output, unless that is taken.
    pub fn tell(&self, text: &str) -> Result<()> {
        let Reports { format, junit, tap, .. } = self.reports;
        let is_taken = *format == Format::Json
            || [junit, tap].into_iter().flatten().any(|path| is_stdout(path));
        match is_taken {
            true => print(&mut anstream::stderr(), text),
            false => print(&mut anstream::stdout(), text),
        }
    }

    /// The result of a scenario.
    pub fn take(&mut self, mut result: TestResult) -> Result<()> {
        if !self.warnings.insert(result.warnings.clone()) {
            // Of a program they are told once.
            result.warnings.clear();
        }
        let is_quiet = self.reports.quiet;
        if is_quiet {
            result.warnings.clear();
            result.notes.clear();
        }
        if !is_quiet || result.status != 0 {
            self.tell(&report::human(&result))?;
        }
        if self.reports.format == Format::Json {
            print(&mut anstream::stdout(), &report::json(&result))?;
        }
        self.results.push(result);
        Ok(())
    }

    /// The end: writes the files. Gives the worst of all exit codes.
    pub fn end(self) -> Result<u8> {
        if !self.reports.quiet {
            self.tell(&report::summary(&self.results))?;
        }
        write(self.reports.junit.as_deref(), &junit::text(self.tool, &self.results))?;
        write(self.reports.tap.as_deref(), &tap::text(&self.results))?;
        Ok(self.results.iter().map(|result| result.status).max().unwrap_or(0))
    }
}

fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

fn write(path: Option<&Path>, text: &str) -> Result<()> {
    match path {
        None => Ok(()),
        Some(path) if is_stdout(path) => print(&mut std::io::stdout(), text),
        Some(path) => write_whole(path, text.as_bytes()),
    }
}

fn print(out: &mut impl Write, text: &str) -> Result<()> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Whoever reads has seen enough.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.context("cannot write the results"),
    }
}

/// Refuses outputs with the ending of a source or of a program.
pub fn ensure_no_source(path: &Path) -> Result<()> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    if is_source(path) || PROGRAM_ENDINGS.contains(&ending.as_str()) {
        bail!("{}: this is the name of a source, which is never written here", path.display());
    }
    Ok(())
}
