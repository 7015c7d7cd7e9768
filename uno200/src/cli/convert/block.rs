//! Blocks of IEC 61499: as MATLAB text, and back; their charts as pictures, their service sequences
//! as scenarios.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use awl_asm::files::{ending, ensure_no_source, read_source, write_whole};
use awl_asm::report::Report;
use diagnostics::Source;
use fb::{Block, matlab, service, xml};

use super::super::args::Convert;
use super::{print, told};

pub(super) fn convert(arguments: &Convert) -> Result<bool> {
    let input = &arguments.input;
    if arguments.target.is_some() || arguments.variables.is_some() || arguments.table {
        bail!("{}: --target, --variables and --table are for charts of SFCEdit", input.display());
    }
    if arguments.summary {
        bail!("{}: --summary counts what is in charts", input.display());
    }
    let source = read_source(input)?;
    let is_matlab = fb::is_matlab(input);
    let mut report = Report::new(arguments.messages, false);
    let kinds: &[&str] = if is_matlab { &["fbt", "svg"] } else { &["m", "scn", "svg"] };
    let kind = arguments.output.as_deref().map(|output| ending(output, kinds)).transpose()?;
    if let Some(output) = arguments.output.as_deref().filter(|_| kind == Some("scn")) {
        return scenarios(arguments, &source, output);
    }
    let text = match (kind, is_matlab) {
        (Some("svg"), _) => picture(&source, &mut report)?,
        (_, true) => from_matlab(&source, &mut report),
        (_, false) => to_matlab(&source, &mut report),
    };
    let Some(text) = text else { return Ok(false) };
    match &arguments.output {
        Some(output) => write_whole(output, text.as_bytes())?,
        None => print(&text)?,
    }
    Ok(true)
}

/// The block of a file, if nothing is wrong with it.
fn block_of(source: &Source, report: &mut Report) -> Option<Block> {
    let fb::Read { block, diagnostics } = fb::read(source);
    let is_sound = told(report, source, diagnostics);
    block.filter(|_| is_sound)
}

fn to_matlab(source: &Source, report: &mut Report) -> Option<String> {
    let block = block_of(source, report)?;
    let matlab::Written { text, diagnostics, of_st } = matlab::write(&block, source);
    let is_sound = told(report, source, of_st);
    (told(report, source, diagnostics) && is_sound).then_some(text)?
}

fn from_matlab(source: &Source, report: &mut Report) -> Option<String> {
    Some(xml::write(&block_of(source, report)?))
}

/// The chart of the block as a picture.
fn picture(source: &Source, report: &mut Report) -> Result<Option<String>> {
    let Some(block) = block_of(source, report) else { return Ok(None) };
    let drawing = fb::drawing::draw(&block).map_err(|one| anyhow!("{}: {one}", source.name))?;
    Ok(Some(fb::svg::write(&drawing)))
}

/// Writes each service sequence as a scenario: `tank.scn`, or `tank.NAME.scn` where there are
/// several.
fn scenarios(arguments: &Convert, source: &Source, output: &Path) -> Result<bool> {
    let mut report = Report::new(arguments.messages, false);
    let Some(block) = block_of(source, &mut report) else { return Ok(false) };
    let sequences = block.service.as_ref().map_or(&[][..], |one| &one.sequences);
    if sequences.is_empty() {
        bail!("{}: the block has no service sequences", arguments.input.display());
    }
    let mut files = Vec::new();
    for sequence in sequences {
        let text = match service::scenario(&block, sequence) {
            Ok(text) => text,
            Err(broken) => {
                let (line, column) = source.position(broken.span.start as usize);
                bail!("{}:{line}:{column}: {}", source.name, broken.message);
            }
        };
        let file = match sequences {
            [_] => output.to_path_buf(),
            _ => output.with_extension(format!("{}.scn", file_name(&sequence.name.text))),
        };
        ensure_no_source(&file, arguments.overwrite)?;
        if files.iter().any(|(other, _)| *other == file) {
            bail!("{}: two sequences have this name", sequence.name.text);
        }
        files.push((file, text));
    }
    for (file, text) in files {
        write_whole(&file, text.as_bytes())?;
    }
    Ok(true)
}

/// A name as part of one of a file.
fn file_name(name: &str) -> String {
    name.chars().map(|one| if one.is_ascii_alphanumeric() { one } else { '_' }).collect()
}
