//! Writes the trace: to standard output, or to a file.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};
use awl_asm::files::write_whole_with;
use awl_sim::suite::ensure_no_source;
use awl_sim::trace::{Trace, csv, svg, table, vcd};

use awl_sim::args::{Args, Format, On};

/// Writes what `args` ask for, if anything.
pub fn write(args: &Args, trace: &Trace) -> Result<()> {
    let is_wanted = args.trace.is_some() || args.format.is_some() || args.output.is_some();
    if !is_wanted {
        return Ok(());
    }
    let format = format(args)?;
    // A board runs more scans than anybody looks at.
    let rows = if args.on == On::Host { csv::Rows::EveryScan } else { csv::Rows::Changes };
    let title = args.program.first().and_then(|path| path.file_name()).unwrap_or_default();
    let title = title.to_string_lossy();
    match &args.output {
        Some(path) => write_whole_with(path, |out| write_as(format, rows, trace, &title, out)),
        None => {
            match write_as(format, rows, trace, &title, &mut BufWriter::new(io::stdout().lock())) {
                // Whoever reads has seen enough.
                Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
                result => result.context("cannot write the trace"),
            }
        }
    }
}

/// The format that `args` ask for; without one that of the file. Fails if the file has an ending
/// that says neither, or is a source: one wrong name must not cost a program.
pub fn format(args: &Args) -> Result<Format> {
    let Some(path) = &args.output else { return Ok(args.format.unwrap_or(Format::Csv)) };
    ensure_no_source(path)?;
    if let Some(format) = args.format {
        return Ok(format);
    }
    match ending(path).as_str() {
        "csv" => Ok(Format::Csv),
        "txt" => Ok(Format::Table),
        "vcd" => Ok(Format::Vcd),
        "svg" => Ok(Format::Svg),
        _ => bail!(
            "-o {}: the ending says no format: name it .csv, .vcd, .svg or .txt, or choose one by \
                --format",
            path.display()
        ),
    }
}

/// The ending of a file, in small letters.
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

fn write_as(
    format: Format,
    rows: csv::Rows,
    trace: &Trace,
    title: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(trace, rows, out)?,
        Format::Table => table::write(trace, out)?,
        Format::Vcd => vcd::write(trace, out)?,
        Format::Svg => svg::write(trace, title, out)?,
    }
    out.flush()
}
