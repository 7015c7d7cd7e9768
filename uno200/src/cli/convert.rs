//! `convert`: from one form of a program to another. What fails leaves no file.

mod block;
mod diagram;

use std::collections::HashSet;
use std::io::Write;
use std::path::Path;

use anyhow::{Context as _, Result, anyhow, bail};
use awl_asm::files::{ending, ensure_distinct, ensure_no_source, read_source, write_whole};
use awl_asm::report::Report;
use chart::Chart;
use chart::set_reset::variables::{self, Table};
use chart::set_reset::{Target, plan, table, write};
use chart::summary::summary;
use chart::{from_sfcedit, sfcedit};
use diagnostics::traced::Traced;
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
        Some("xml") => {
            let source = read_source(&arguments.input)?;
            match plcopen::is_project(&source) {
                true => from_project(arguments, &source),
                false => from_chart(arguments, &source),
            }
        }
        Some("sfc") => from_text(arguments),
        Some("fbt" | "m") => block::convert(arguments),
        Some("fbd") => diagram::convert(arguments),
        _ => bail!(
            "{}: charts are converted, projects of PLCopen and charts of SFCEdit (.xml), charts \
             as text (.sfc), diagrams of blocks (.fbd), and blocks of IEC 61499 (.fbt, in MATLAB \
             .m)",
            arguments.input.display()
        ),
    }
}

/// A chart as text to a picture or a project of PLCopen, or how much there is in it, whatever its
/// names stand for.
fn from_text(arguments: &Convert) -> Result<bool> {
    let is_st = arguments.target.is_some() || arguments.variables.is_some() || arguments.table;
    let output = arguments.output.as_deref().filter(|_| !arguments.summary);
    let is_project = output.is_some_and(|output| has_ending(output, "xml"));
    if is_st || output.is_some_and(|output| !is_project && !has_ending(output, "svg")) {
        bail!(
            "{}: of a chart as text a picture is made, `-o chart.svg`, or a project of PLCopen, \
             `-o chart.xml`; `uno200 build` makes AWL of it",
            arguments.input.display()
        );
    }
    let source = read_source(&arguments.input)?;
    if let Some(output) = output.filter(|_| is_project) {
        return to_project(arguments, &source, output);
    }
    let reading = chart::text::read(&source);
    let charts: Vec<Chart> = reading.document.charts().cloned().collect();
    let mut report = Report::new(arguments.messages, false);
    if !told(&mut report, &source, reading.diagnostics) {
        return Ok(false);
    }
    if arguments.summary { counted(&charts) } else { draw(arguments, &charts, &source) }
}

/// A text with charts to a project of PLCopen, if nothing is wrong with it.
fn to_project(arguments: &Convert, source: &Source, output: &Path) -> Result<bool> {
    let mut report = Report::new(arguments.messages, false);
    let translation = chart::translate(source, &mut HashSet::new());
    let is_sound = told(&mut report, source, translation.diagnostics);
    if !told(&mut report, source, translation.of_st) || !is_sound {
        return Ok(false);
    }
    let plcopen::Exported { text, diagnostics } = plcopen::write(source);
    if !told(&mut report, source, diagnostics) {
        return Ok(false);
    }
    write_whole(output, text.as_bytes()).map(|()| true)
}

/// Whether a picture is wanted.
fn is_picture(arguments: &Convert) -> bool {
    arguments.output.as_deref().is_some_and(|output| has_ending(output, "svg"))
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Writes charts as a picture.
fn draw(arguments: &Convert, charts: &[Chart], source: &Source) -> Result<bool> {
    let input = arguments.input.display();
    if charts.is_empty() {
        bail!("{input}: there is no chart in it, so there is nothing to draw");
    }
    let drawing = chart::drawing::draw(charts, source).map_err(|one| anyhow!("{input}: {one}"))?;
    let picture = chart::svg::write(&drawing);
    match &arguments.output {
        Some(output) => write_whole(output, picture.as_bytes())?,
        None => print(&picture)?,
    }
    Ok(true)
}

/// Prints how many there are of what.
fn counted(charts: &[Chart]) -> Result<bool> {
    let lines = summary(charts).map(|(name, count)| format!("{name}: {count}\n"));
    print(&lines.concat()).map(|()| true)
}

/// A project of PLCopen to a text, a picture of its charts, or how much there is in them.
fn from_project(arguments: &Convert, source: &Source) -> Result<bool> {
    if arguments.target.is_some() || arguments.variables.is_some() || arguments.table {
        bail!(
            "{}: --target, --variables and --table are for charts of SFCEdit; this is a project of \
             PLCopen",
            arguments.input.display()
        );
    }
    let mut report = Report::new(arguments.messages, false);
    let output = arguments.output.as_deref().filter(|_| !arguments.summary);
    if let Some(output) = output.filter(|output| has_ending(output, "fbd")) {
        return diagram::from_project(source, output, &mut report);
    }
    let plcopen::Imported { text, charts, diagnostics } = plcopen::read(source);
    if !told(&mut report, source, diagnostics) {
        return Ok(false);
    }
    if arguments.summary {
        return counted(&charts);
    }
    if is_picture(arguments) {
        return draw(arguments, &charts, source);
    }
    let reading = chart::text::read(&Source::new(source.name.as_str(), text.text())?);
    let found = reading.diagnostics.into_iter().map(|one| one.moved(|span| text.place(span)));
    if !told(&mut report, source, found.collect()) {
        return Ok(false);
    }
    let Some(output) = &arguments.output else { return print(text.text()).map(|()| true) };
    if ending(output, &["sfc", "st", "fbd"])? == "st" && !charts.is_empty() {
        bail!("{}: there are charts in it: write it as .sfc", arguments.input.display());
    }
    write_whole(output, text.text().as_bytes()).map(|()| true)
}

/// A chart of SFCEdit to a program, to Structured Text the set/reset way, or to a picture.
fn from_chart(arguments: &Convert, source: &Source) -> Result<bool> {
    let mut report = Report::new(arguments.messages, false);
    let rows = match &arguments.variables {
        Some(path) => {
            let table = read_source(path)?;
            let (rows, found) = variables::read(&table);
            report.show(&table, &found);
            if has_errors(&found) {
                return Ok(false);
            }
            rows
        }
        None => Table::default(),
    };
    let reading = sfcedit::read(source);
    let mut found = reading.diagnostics;
    let Some(project) = reading.project else { return Ok(told(&mut report, source, found)) };
    if arguments.summary {
        let charts = sfcedit::model::charts(&project, &mut found);
        return Ok(told(&mut report, source, found) && counted(&charts)?);
    }
    if is_picture(arguments) {
        let charts = sfcedit::model::charts(&project, &mut found);
        return Ok(told(&mut report, source, found) && draw(arguments, &charts, source)?);
    }
    if let Some(output) = arguments.output.as_deref().filter(|one| has_ending(one, "sfc")) {
        return to_program(
            arguments,
            source,
            &from_sfcedit::program(&project, &rows),
            found,
            output,
        );
    }
    let (plan, more) = plan(&project, &rows);
    found.extend(more);
    if !told(&mut report, source, found) {
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

/// A chart of SFCEdit to a program that runs here. What is wrong with that is told at its place in
/// the chart.
fn to_program(
    arguments: &Convert,
    source: &Source,
    program: &from_sfcedit::Program,
    mut found: Vec<chart::Diagnostic>,
    output: &Path,
) -> Result<bool> {
    if arguments.target.is_some() || arguments.table {
        bail!("{}: --target and --table are for Structured Text (.st)", output.display());
    }
    let from_sfcedit::Program { text, diagnostics } = program;
    found.extend(diagnostics.iter().cloned());
    let mut report = Report::new(arguments.messages, false);
    if !told(&mut report, source, found) {
        return Ok(false);
    }
    let written = Source::new(source.name.as_str(), text.text())?;
    let translation = chart::translate(&written, &mut HashSet::new());
    let is_sound = told(&mut report, source, errors_of(translation.diagnostics, text));
    if !told(&mut report, source, errors_of(translation.of_st, text)) || !is_sound {
        return Ok(false);
    }
    write_whole(output, text.text().as_bytes()).map(|()| true)
}

/// Errors about a text, at the places from which it comes.
fn errors_of<C: Code>(found: Vec<Diagnostic<C>>, text: &Traced) -> Vec<Diagnostic<C>> {
    let errors = found.into_iter().filter(|one| one.severity() == Severity::Error);
    errors.map(|one| one.moved(|span| text.place(span))).collect()
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
