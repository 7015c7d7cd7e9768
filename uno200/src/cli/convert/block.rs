//! Blocks of IEC 61499: as MATLAB text, and back.

use anyhow::{Result, bail};
use awl_asm::files::{ending, read_source, write_whole};
use awl_asm::report::Report;
use diagnostics::Source;
use fb::{matlab, xml};

use super::super::args::Convert;
use super::{has_ending, print, told};

pub(super) fn convert(arguments: &Convert) -> Result<bool> {
    let input = &arguments.input;
    if arguments.target.is_some() || arguments.variables.is_some() || arguments.table {
        bail!("{}: --target, --variables and --table are for charts of SFCEdit", input.display());
    }
    if arguments.summary {
        bail!("{}: --summary counts what is in charts", input.display());
    }
    let source = read_source(input)?;
    let is_matlab = has_ending(input, "m");
    if let Some(output) = &arguments.output {
        ending(output, if is_matlab { &["fbt"] } else { &["m"] })?;
    }
    let mut report = Report::new(arguments.messages, false);
    let text = match is_matlab {
        true => from_matlab(&source, &mut report),
        false => to_matlab(&source, &mut report),
    };
    let Some(text) = text else { return Ok(false) };
    match &arguments.output {
        Some(output) => write_whole(output, text.as_bytes())?,
        None => print(&text)?,
    }
    Ok(true)
}

fn to_matlab(source: &Source, report: &mut Report) -> Option<String> {
    let xml::Read { block, diagnostics } = xml::read(source);
    let is_sound = told(report, source, diagnostics);
    let block = block.filter(|_| is_sound)?;
    let matlab::Written { text, diagnostics, of_st } = matlab::write(&block, source);
    let is_sound = told(report, source, of_st);
    (told(report, source, diagnostics) && is_sound).then_some(text)?
}

fn from_matlab(source: &Source, report: &mut Report) -> Option<String> {
    let matlab::Read { block, diagnostics } = matlab::read(source);
    let is_sound = told(report, source, diagnostics);
    Some(xml::write(&block.filter(|_| is_sound)?))
}
