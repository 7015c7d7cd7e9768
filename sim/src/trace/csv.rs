//! The trace as comma separated values: `time_ms,scan,<operands>`. For programs and spreadsheets.

use std::io::{self, Write};

use super::Trace;

/// Which scans get a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// Every scan.
    EveryScan,
    /// The first scan, and those after which a value is different.
    Changes,
}

/// Writes the trace. `time_ms` is the start of the scan, scans count from 1, words are signed,
/// reals have a point or exponent.
pub fn write(trace: &Trace, rows: Rows, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "time_ms,scan")?;
    for signal in trace.signals() {
        // A symbol can hold the separator.
        match signal.name.contains([',', '"']) {
            true => write!(out, ",\"{}\"", signal.name.replace('"', "\"\""))?,
            false => write!(out, ",{}", signal.name)?,
        }
    }
    writeln!(out)?;
    let mut steps = trace.steps();
    let mut values = Vec::new();
    while let Some(scan) = steps.advance() {
        values.clear();
        for text in steps.texts() {
            write!(values, ",{text}")?;
        }
        values.push(b'\n');
        let until = match rows {
            Rows::EveryScan => steps.next_scan().unwrap_or(trace.scans()),
            Rows::Changes => scan + 1,
        };
        for scan in scan..until {
            write!(out, "{},{}", scan * trace.scan_ms(), scan + 1)?;
            out.write_all(&values)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::test_traces::trace;

    fn text(trace: &Trace, rows: Rows) -> String {
        let mut out = Vec::new();
        write(trace, rows, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn a_row_per_scan() {
        let trace = trace(10, &[("Q0.1", &[0, 1, 1, 1]), ("MW3", &[-5, -5, -5, 7])]);
        let expected = "time_ms,scan,Q0.1,MW3\n0,1,0,-5\n10,2,1,-5\n20,3,1,-5\n30,4,1,7\n";
        assert_eq!(text(&trace, Rows::EveryScan), expected);
        assert_eq!(
            text(&trace, Rows::Changes),
            "time_ms,scan,Q0.1,MW3\n0,1,0,-5\n10,2,1,-5\n30,4,1,7\n"
        );
    }

    #[test]
    fn no_scan_no_row() {
        assert_eq!(text(&trace(1, &[("T37.cv", &[])]), Rows::EveryScan), "time_ms,scan,T37.cv\n");
    }
}
