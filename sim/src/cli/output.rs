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
    to(args.output.as_deref(), "the trace", |out| write_as(format, rows, trace, &title, out))
}

/// Writes to a file, as a whole, or to standard output. `what` is written is for the error.
pub fn to(
    path: Option<&Path>,
    what: &str,
    write: impl Fn(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    let Some(path) = path else {
        let mut out = BufWriter::new(io::stdout().lock());
        return match write(&mut out).and_then(|()| out.flush()) {
            // Whoever reads has seen enough.
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            result => result.with_context(|| format!("cannot write {what}")),
        };
    };
    write_whole_with(path, write)
}

/// The format that `args` ask for; without one that of the file. Fails if the file has an ending
/// that says neither, or is a source: one wrong name must not cost a program.
pub fn format(args: &Args) -> Result<Format> {
    let formats =
        [("csv", Format::Csv), ("vcd", Format::Vcd), ("svg", Format::Svg), ("txt", Format::Table)];
    Ok(format_of(args.output.as_deref(), args.format, &formats)?.unwrap_or(Format::Csv))
}

/// The format that is asked for; without one that of the file, by its ending; without a file none.
/// Fails as [`format`] does. `formats`: endings, in small letters, and what they say.
pub fn format_of<F: Copy>(
    path: Option<&Path>,
    asked: Option<F>,
    formats: &[(&str, F)],
) -> Result<Option<F>> {
    let Some(path) = path else { return Ok(asked) };
    ensure_no_source(path)?;
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let by_ending = formats.iter().find(|(known, _)| *known == ending).map(|(_, format)| *format);
    if let Some(format) = asked.or(by_ending) {
        return Ok(Some(format));
    }
    let names: Vec<String> = formats.iter().map(|(known, _)| format!(".{known}")).collect();
    let (last, others) = names.split_last().map_or(("", &[][..]), |(last, rest)| (last, rest));
    bail!(
        "-o {}: the ending says no format: name it {} or {last}, or choose one by --format",
        path.display(),
        others.join(", ")
    )
}

fn write_as(
    format: Format,
    rows: csv::Rows,
    trace: &Trace,
    title: &str,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(trace, rows, out),
        Format::Table => table::write(trace, out),
        Format::Vcd => vcd::write(trace, out),
        Format::Svg => svg::write(trace, title, out),
    }
}
