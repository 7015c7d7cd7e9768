//! Writes the trace: to standard output, or to a file that is either written whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use awl_sim::trace::{Trace, csv, svg, table, vcd};

use super::args::{Args, Format};

/// Writes what `args` ask for, if anything.
pub fn write(args: &Args, trace: &Trace) -> Result<()> {
    let is_wanted = args.trace.is_some() || args.format.is_some() || args.output.is_some();
    if !is_wanted {
        return Ok(());
    }
    let format = args.format.unwrap_or_else(|| format_of(args.output.as_deref()));
    let title = args.program.file_name().unwrap_or_default().to_string_lossy();
    match &args.output {
        Some(path) => write_file(path, |out| write_as(format, trace, &title, out))
            .with_context(|| format!("cannot write {}", path.display())),
        None => match write_as(format, trace, &title, &mut BufWriter::new(io::stdout().lock())) {
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
        Some("txt") => Format::Table,
        _ => Format::Csv,
    }
}

fn write_as(format: Format, trace: &Trace, title: &str, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Csv => csv::write(trace, csv::Rows::EveryScan, out)?,
        Format::Table => table::write(trace, out)?,
        Format::Vcd => vcd::write(trace, out)?,
        Format::Svg => svg::write(trace, title, out)?,
    }
    out.flush()
}

fn write_file(path: &Path, write: impl Fn(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    // A device or pipe cannot be replaced by a file.
    if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
        return write(&mut BufWriter::new(File::options().write(true).open(path)?));
    }
    let beside = beside(path);
    let result = File::create(&beside)
        .and_then(|file| write(&mut BufWriter::new(file)))
        .and_then(|()| fs::rename(&beside, path));
    if result.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&beside);
    }
    result
}

fn beside(path: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.part", std::process::id()));
    path.with_file_name(name)
}
