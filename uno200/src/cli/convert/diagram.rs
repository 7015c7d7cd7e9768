//! Diagrams of blocks as pictures, and as projects of PLCopen, and back.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use awl_asm::files::{read_source, write_whole};
use awl_asm::report::Report;
use diagnostics::{Severity, Source};
use diagram::interfaces::Interfaces;

use super::super::args::Convert;
use super::{has_ending, is_picture, print, told};

pub(super) fn convert(arguments: &Convert) -> Result<bool> {
    let input = arguments.input.display();
    if arguments.target.is_some() || arguments.variables.is_some() || arguments.table {
        bail!("{input}: --target, --variables and --table are for charts of SFCEdit");
    }
    if arguments.summary {
        bail!("{input}: --summary counts what is in charts");
    }
    let output = arguments.output.as_deref().filter(|_| !is_picture(arguments));
    if output.is_some_and(|output| !has_ending(output, "xml")) {
        bail!(
            "{input}: of a diagram a picture is made, `-o diagram.svg`, or a project of PLCopen, \
             `-o diagram.xml`; `uno200 build` makes AWL of it"
        );
    }
    let source = read_source(&arguments.input)?;
    let mut report = Report::new(arguments.messages, false);
    let diagram::Read { file, of_st, diagnostics } = diagram::read(&source);
    if !told(&mut report, &source, of_st) || !told(&mut report, &source, diagnostics) {
        return Ok(false);
    }
    if file.units.is_empty() {
        bail!("{input}: there is no diagram in it, so there is nothing to draw");
    }
    if let Some(output) = output {
        let exported = plcopen::write_diagrams(&source).map_err(|one| anyhow!("{input}: {one}"))?;
        if !told(&mut report, &source, exported.diagnostics) {
            return Ok(false);
        }
        return write_whole(output, exported.text.as_bytes()).map(|()| true);
    }
    let drawing = diagram::drawing::draw(&source, &file, &Interfaces::default());
    let picture = diagram::svg::write(&drawing.map_err(|one| anyhow!("{input}: {one}"))?);
    match &arguments.output {
        Some(output) => write_whole(output, picture.as_bytes())?,
        None => print(&picture)?,
    }
    Ok(true)
}

/// A project of PLCopen whose bodies are in FBD as a text with diagrams.
pub(super) fn from_project(source: &Source, output: &Path, report: &mut Report) -> Result<bool> {
    let plcopen::Imported { text, charts, diagnostics } = plcopen::read_diagrams(source);
    if !told(report, source, diagnostics) {
        return Ok(false);
    }
    if !charts.is_empty() {
        bail!("{}: there are charts in it: write it as .sfc", source.name);
    }
    let read = Source::new(source.name.as_str(), text.text())?;
    let diagram::Read { of_st, .. } = diagram::read(&read);
    let of_st = of_st.into_iter().map(|one| one.moved(|span| text.place(span)));
    if !told(report, source, of_st.collect()) {
        return Ok(false);
    }
    let written = Source::new(source.name.as_str(), diagram::marked(&read))?;
    let mut found = diagram::read(&written).diagnostics.into_iter();
    let is_error = |one: &diagram::Diagnostic| one.severity() == Severity::Error;
    if let Some(first) = found.find(is_error) {
        let (line, _) = written.position(first.span.start as usize);
        bail!(
            "{}: this is no diagram of blocks: {} (`{}`); `-o {}` makes Structured Text of it",
            source.name,
            first.message,
            written.line_text(line).trim(),
            output.with_extension("st").display()
        );
    }
    write_whole(output, written.text.as_bytes()).map(|()| true)
}
