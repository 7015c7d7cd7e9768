//! Diagrams of blocks as pictures.

use anyhow::{Result, anyhow, bail};
use awl_asm::files::{read_source, write_whole};
use awl_asm::report::Report;
use diagram::interfaces::Interfaces;

use super::super::args::Convert;
use super::{is_picture, print, told};

pub(super) fn convert(arguments: &Convert) -> Result<bool> {
    let input = arguments.input.display();
    if arguments.target.is_some() || arguments.variables.is_some() || arguments.table {
        bail!("{input}: --target, --variables and --table are for charts of SFCEdit");
    }
    if arguments.summary {
        bail!("{input}: --summary counts what is in charts");
    }
    if arguments.output.is_some() && !is_picture(arguments) {
        bail!(
            "{input}: of a diagram a picture is made, `-o diagram.svg`; `uno200 build` makes AWL \
             of it"
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
    let drawing = diagram::drawing::draw(&source, &file, &Interfaces::default());
    let picture = diagram::svg::write(&drawing.map_err(|one| anyhow!("{input}: {one}"))?);
    match &arguments.output {
        Some(output) => write_whole(output, picture.as_bytes())?,
        None => print(&picture)?,
    }
    Ok(true)
}
