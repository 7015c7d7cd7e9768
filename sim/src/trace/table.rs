//! The trace as a table for people: aligned columns, a row where something changed, first and last
//! scan always.

use std::io::{self, Write};

use super::{Steps, Trace};
use crate::operand::Width;

/// Writes the trace. Time is in seconds, that of the start of the scan; scans count from 1.
pub fn write(trace: &Trace, out: &mut dyn Write) -> io::Result<()> {
    let widths = widths(trace);
    let titles =
        ["time/s", "scan"].into_iter().chain(trace.signals().iter().map(|signal| &*signal.name));
    write_row(out, titles, &widths)?;
    let mut steps = trace.steps();
    let mut last_row = None;
    while let Some(scan) = steps.advance() {
        write_scan(out, trace, &steps, scan, &widths)?;
        last_row = Some(scan);
    }
    match trace.scans().checked_sub(1) {
        Some(last) if last_row != Some(last) => write_scan(out, trace, &steps, last, &widths),
        _ => Ok(()),
    }
}

fn seconds(ms: u64) -> String {
    format!("{}.{:03}", ms / 1000, ms % 1000)
}

fn widths(trace: &Trace) -> Vec<usize> {
    let last = trace.scans().saturating_sub(1);
    let mut widths =
        vec![seconds(last * trace.scan_ms()).len().max(6), trace.scans().to_string().len().max(4)];
    for (index, signal) in trace.signals().iter().enumerate() {
        let values = trace.changes(index).iter().map(|change| change.value);
        let longest = match signal.operand.width() {
            Width::Real => values.map(|value| signal.operand.text(value).len()).max(),
            // The longest number is the largest or the smallest.
            _ => [values.clone().min(), values.max()]
                .into_iter()
                .flatten()
                .map(|value| value.to_string().len())
                .max(),
        };
        let longest = longest.unwrap_or(0);
        widths.push(longest.max(signal.name.chars().count()));
    }
    widths
}

fn write_scan(
    out: &mut dyn Write,
    trace: &Trace,
    steps: &Steps<'_>,
    scan: u64,
    widths: &[usize],
) -> io::Result<()> {
    let mut cells = vec![seconds(scan * trace.scan_ms()), (scan + 1).to_string()];
    cells.extend(steps.texts());
    write_row(out, cells.iter().map(String::as_str), widths)
}

fn write_row<'a>(
    out: &mut dyn Write,
    cells: impl Iterator<Item = &'a str>,
    widths: &[usize],
) -> io::Result<()> {
    for (index, (cell, &width)) in cells.zip(widths).enumerate() {
        let gap = if index == 0 { "" } else { "  " };
        write!(out, "{gap}{cell:>width$}")?;
    }
    writeln!(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::test_traces::trace;

    fn text(trace: &Trace) -> String {
        let mut out = Vec::new();
        write(trace, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn changes_first_and_last() {
        let trace =
            trace(100, &[("Q0.1", &[0, 0, 1, 1, 1]), ("MW3", &[5, 5, -1200, -1200, -1200])]);
        let expected = "\
time/s  scan  Q0.1    MW3
 0.000     1     0      5
 0.200     3     1  -1200
 0.400     5     1  -1200
";
        assert_eq!(text(&trace), expected);
    }

    #[test]
    fn last_change_in_the_last_scan_is_one_row() {
        assert_eq!(
            text(&trace(1, &[("Q0.1", &[0, 1])])),
            "time/s  scan  Q0.1\n 0.000     1     0\n 0.001     2     1\n"
        );
        assert_eq!(text(&trace(1, &[("Q0.1", &[1])])), "time/s  scan  Q0.1\n 0.000     1     1\n");
    }
}
