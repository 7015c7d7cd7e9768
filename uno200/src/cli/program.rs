//! `read-program`, `compare`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use awl_asm::disassemble::disassemble;
use awl_asm::files::{ending, ensure_no_source, write_whole};
use client::compare::{compare as compared, size};
use client::image::Image;

use super::context::Context;

/// Endings of files with a program.
const ENDINGS: [&str; 2] = ["awl", "bin"];

pub(super) fn read(context: &mut Context, output: Option<&Path>) -> Result<bool> {
    let image = context.client.read_program()?;
    if image.is_empty() {
        eprintln!("the PLC holds no program");
        return Ok(false);
    }
    let Some(path) = output else {
        io::stdout().write_all(text(&image)?.as_bytes())?;
        return Ok(true);
    };
    match ending(path, &ENDINGS)? {
        "awl" => write_whole(path, text(&image)?.as_bytes())?,
        _ => write_whole(path, &image)?,
    }
    eprintln!("{}: {}", path.display(), size(&image));
    Ok(true)
}

/// Whether the program can be written to a file of this name.
pub(super) fn check_output(output: Option<&Path>, overwrite: bool) -> Result<()> {
    let Some(path) = output else { return Ok(()) };
    ending(path, &ENDINGS)?;
    ensure_no_source(path, overwrite)
}

fn text(image: &[u8]) -> Result<String> {
    if Image(image).is_native() {
        bail!("the program is machine code, which has no text: -o F.bin saves it");
    }
    disassemble(image)
        .map_err(|error| anyhow::anyhow!("{} (offset {:#06x})", error.fault.message(), error.at))
        .context("the program in the PLC cannot be shown as text: -o F.bin saves it")
}

pub(super) fn compare(context: &mut Context, files: &[PathBuf]) -> Result<bool> {
    let program = context.files.open(files)?;
    let image = context.client.read_program()?;
    let comparison = compared(&program, &image)?;
    for line in &comparison.lines {
        println!("{line}");
    }
    Ok(comparison.is_same)
}
