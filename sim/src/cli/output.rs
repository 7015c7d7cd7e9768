//! Writes the trace: to standard output, or to a file.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use anyhow::{Context, Result};
use awl_asm::files::write_whole_with;
use awl_sim::trace::{Trace, csv, svg, table, vcd};

use super::args::{Args, Format, On};

/// Writes what `args` ask for, if anything.
pub fn write(args: &Args, trace: &Trace) -> Result<()> {
    let is_wanted = args.trace.is_some() || args.format.is_some() || args.output.is_some();
    if !is_wanted {
        return Ok(());
    }
    let format = args.format.unwrap_or_else(|| format_of(args.output.as_deref()));
    // A board runs more scans than anybody looks at.
    let rows = if args.on == On::Host { csv::Rows::EveryScan } else { csv::Rows::Changes };
    let title = args.program.file_name().unwrap_or_default().to_string_lossy();
    match &args.output {
        Some(path) => write_whole_with(path, |out| write_as(format, rows, trace, &title, out)),
        None => match write_as(format, rows, trace, &title, &mut BufWriter::new(io::stdout().lock())) {
            // Whoever reads has seen enough.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            result => result.context("cannot write the trace"),
        },
    }
}

fn format_of(path: Option<&Path>) -> Format {
    let extension = path.and_then(Path::extension).unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("svg") => Format::Svg,
        Some("vcd") => Format::Vcd,
        _ => Format::Csv,
    }
}

fn write_as(format: Format, rows: csv::Rows, trace: &Trace, title: &str, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(trace, rows, out)?,
        Format::Table => table::write(trace, out)?,
        Format::Vcd => vcd::write(trace, out)?,
        Format::Svg => svg::write(trace, title, out)?,
    }
    out.flush()
}
