//! `convert`: from one form of a program to another. What fails leaves no file.

use std::io::Write;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use awl_asm::files::{ending, ensure_distinct, ensure_no_source, read_source, write_whole};
use awl_asm::report::Report;
use chart::Chart;
use chart::set_reset::variables::{self, Table};
use chart::set_reset::{Target, plan, table, write};
use chart::sfcedit;
use chart::summary::summary;
use diagnostics::{Code, Diagnostic, Severity, Source};

use super::args::Convert;

/// Returns whether it is done.
pub(super) fn convert(arguments: &Convert) -> Result<bool> {
    if let Some(output) = &arguments.output {
        let inputs: Vec<&Path> = std::iter::once(&arguments.input)
            .chain(&arguments.variables)
            .map(AsRef::as_ref)
            .collect();
        ensure_distinct(&inputs, &[output.as_path()])?;
        ensure_no_source(output, arguments.overwrite)?;
    }
    match arguments.input.extension().and_then(|one| one.to_str()).map(str::to_lowercase).as_deref()
    {
        Some("xml") => from_chart(arguments),
        _ => bail!("{}: charts of SFCEdit (.xml) are converted", arguments.input.display()),
    }
}

/// How much there is in a chart as text, whatever its names stand for.
fn summary_of_text(arguments: &Convert) -> Result<bool> {
    let source = read_source(&arguments.input)?;
    let reading = chart::text::read(&source);
    let charts: Vec<Chart> = reading.document.charts().cloned().collect();
    let mut report = Report::new(arguments.messages, false);
    Ok(told(&mut report, &source, reading.diagnostics) && counted(&charts)?)
}

/// Prints how many there are of what.
fn counted(charts: &[Chart]) -> Result<bool> {
    let lines = summary(charts).map(|(name, count)| format!("{name}: {count}\n"));
    print(&lines.concat()).map(|()| true)
}

/// A chart of SFCEdit to Structured Text, the set/reset way.
fn from_chart(arguments: &Convert) -> Result<bool> {
    let source = read_source(&arguments.input)?;
    let mut report = Report::new(arguments.messages, false);
    let rows = match &arguments.variables {
        Some(path) => {
            let source = read_source(path)?;
            let (rows, found) = variables::read(&source);
            report.show(&source, &found);
            if has_errors(&found) {
                return Ok(false);
            }
            rows
        }
        None => Table::default(),
    };
    let reading = sfcedit::read(&source);
    let mut found = reading.diagnostics;
    let Some(project) = reading.project else { return Ok(told(&mut report, &source, found)) };
    if arguments.summary {
        let charts = sfcedit::model::charts(&project, &mut found);
        return Ok(told(&mut report, &source, found) && counted(&charts)?);
    }
    let (plan, more) = plan(&project, &rows);
    found.extend(more);
    if !told(&mut report, &source, found) {
        return Ok(false);
    }
    let target = arguments.target.unwrap_or(Target::Uno200);
    let name = arguments.input.file_stem().and_then(|stem| stem.to_str()).unwrap_or("charts");
    let text = write(&plan, target, name);
    match &arguments.output {
        Some(output) => {
            ending(output, &[target.ending(), "txt"])?;
            write_whole(output, text.as_bytes())?;
        }
        None if !arguments.table => print(&text)?,
        None => {}
    }
    if arguments.table {
        print(&table(&plan))?;
    }
    Ok(true)
}

fn has_errors<C: Code>(found: &[Diagnostic<C>]) -> bool {
    found.iter().any(|one| one.severity() == Severity::Error)
}

/// Tells what was found; returns whether there are no errors.
fn told<C: Code>(report: &mut Report, source: &Source, mut found: Vec<Diagnostic<C>>) -> bool {
    found.sort_by_key(|one| one.span);
    report.show(source, &found);
    !has_errors(&found)
}

/// To standard output; nobody is left to read where it is closed.
fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to stdout")
        }
        _ => Ok(()),
    }
}
