//! `read-program`, `compare`.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use awl_asm::disassemble::disassemble;
use awl_asm::files::write_whole;
use uno200::compare::{compare as compared, size};
use uno200::image::Image;

use super::Context;

pub(super) fn read(context: &mut Context, output: Option<&Path>) -> Result<bool> {
    let image = context.client.read_program()?;
    if image.is_empty() {
        eprintln!("the PLC holds no program");
        return Ok(false);
    }
    if let Some(path) = output {
        write_whole(path, &image)?;
        eprintln!("{}: {}", path.display(), size(&image));
        return Ok(true);
    }
    if Image(&image).is_native() {
        bail!("the program is machine code, which has no text: -o F.bin saves it");
    }
    let text = disassemble(&image)
        .map_err(|error| anyhow::anyhow!("{} (offset {:#06x})", error.fault.message(), error.at))
        .context("the program in the PLC cannot be shown as text: -o F.bin saves it")?;
    io::stdout().write_all(text.as_bytes())?;
    Ok(true)
}

pub(super) fn compare(context: &mut Context) -> Result<bool> {
    let Some(program) = &context.program else { return Ok(false) };
    let image = context.client.read_program()?;
    let comparison = compared(program, &image)?;
    for line in &comparison.lines {
        println!("{line}");
    }
    Ok(comparison.is_same)
}
