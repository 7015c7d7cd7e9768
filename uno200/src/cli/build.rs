//! `build`: from the files of a program, in any language, to AWL or an image. Nothing is written
//! where there are errors.

use std::path::{Path, PathBuf};

use anyhow::Result;
use awl_asm::assemble::{Assembly, assemble_with};
use awl_asm::drive::uf2_file;
use awl_asm::files::{ending, ensure_distinct, ensure_no_source, read_program_texts, write_whole};
use awl_asm::for_tools::for_tools;
use awl_asm::hex::intel_hex;
use awl_asm::native::translate;
use awl_asm::report::{Messages, Report};
use awl_asm::source::Source;
use project::{Findings, Joined, from_awl, has_errors, join};

use super::args::Build;
use super::output::print;

/// Returns whether the program is good.
pub(super) fn build(arguments: &Build) -> Result<bool> {
    let files: Vec<&Path> = arguments.files.iter().map(PathBuf::as_path).collect();
    let kind = output_kind(arguments)?;
    if let Some(output) = &arguments.output {
        ensure_distinct(&files, &[output.as_path()])?;
    }
    let joined = match join(read_program_texts(&arguments.files)?) {
        Ok(joined) => joined,
        Err(findings) => return Ok(told(&findings, arguments.messages)),
    };
    let mut assembly = assemble_with(&joined.awl, Vec::new(), &[], arguments.board);
    if arguments.native || kind == Kind::Hex {
        assembly.require_board();
    }
    let image = image(&mut assembly, arguments.native)?;
    let bytecode = assembly.image.as_deref().unwrap_or_default();
    let periods = joined.periods(bytecode, &assembly, arguments.native);
    let Joined { awl, is_generated, mut findings, .. } = joined;
    findings.extend(periods);
    let diagnostics = from_awl(std::mem::take(&mut assembly.diagnostics), is_generated);
    if !diagnostics.is_empty() {
        findings.push(Findings { source: awl.clone(), diagnostics });
    }
    let is_good = told(&findings, arguments.messages);
    let Some(image) = image.filter(|_| is_good) else { return Ok(false) };
    if arguments.check {
        return Ok(true);
    }
    write(arguments, kind, &awl, &assembly, &image).map(|()| true)
}

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Awl,
    Image,
    Hex,
    Uf2,
}

/// By the ending of the output; AWL on standard output without one.
fn output_kind(arguments: &Build) -> Result<Kind> {
    let Some(output) = &arguments.output else { return Ok(Kind::Awl) };
    Ok(match ending(output, &["awl", "bin", "hex", "uf2"])? {
        "awl" => {
            ensure_no_source(output, arguments.overwrite)?;
            Kind::Awl
        }
        "hex" => Kind::Hex,
        "uf2" => Kind::Uf2,
        _ => Kind::Image,
    })
}

/// The image, if the program has no errors. That it cannot be translated is one more.
fn image(assembly: &mut Assembly, is_native: bool) -> Result<Option<Vec<u8>>> {
    let Some(bytecode) = assembly.image.clone() else { return Ok(None) };
    if !is_native {
        return Ok(Some(bytecode));
    }
    match translate(&bytecode) {
        Ok(translated) => Ok(Some(translated.image)),
        Err(error) => {
            let diagnostic = error.diagnostic(assembly).ok_or(error)?;
            assembly.diagnostics.push(diagnostic);
            Ok(None)
        }
    }
}

fn write(
    arguments: &Build,
    kind: Kind,
    awl: &Source,
    assembly: &Assembly,
    image: &[u8],
) -> Result<()> {
    let Some(output) = &arguments.output else {
        return print(awl.text.as_bytes());
    };
    match kind {
        Kind::Awl => write_whole(output, awl.text.as_bytes()),
        Kind::Hex => write_whole(output, intel_hex(image)?.as_bytes()),
        Kind::Uf2 => write_whole(output, &uf2_file(assembly.profile(), image)?),
        Kind::Image => {
            let tools = for_tools(awl, assembly).filter(|_| !arguments.native);
            let tools = tools.map_or_else(Vec::new, |tools| tools.to_bytes());
            write_whole(output, &[image, &tools].concat())
        }
    }
}

/// Tells what was found; returns whether there are no errors.
fn told(findings: &[Findings], messages: Messages) -> bool {
    let mut report = Report::new(messages, false);
    for Findings { source, diagnostics } in findings {
        report.show(source, diagnostics);
    }
    !has_errors(findings)
}
