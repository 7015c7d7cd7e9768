//! Traces that the PLC has recorded: from the bytes of its ring to tables and waveforms. The
//! recording is asked for in [`service`](crate::service).

mod dump;
mod svg;

use std::io::{self, Write};

pub use dump::Dump;

use crate::error::Error;
use crate::operand::Operand;
use crate::service::TraceState;
use crate::value::{Base, raw};

/// A recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// What was recorded.
    pub operands: Vec<Operand>,
    /// Raw values of each sample, in the order of the operands.
    pub samples: Vec<Vec<u32>>,
    /// The scan of the first sample, counted since RUN as far as 16 bits go.
    pub first_scan: u16,
    /// Scans from sample to sample.
    pub every: u16,
    /// The sample of the trigger.
    pub trigger: Option<usize>,
    /// Average length of a scan in microseconds: the board records scans, not times.
    pub scan_us: f64,
}

impl Recording {
    /// Puts the samples of a ring in order.
    pub fn of_ring(
        operands: Vec<Operand>,
        ring: &[u8],
        state: &TraceState,
        every: u16,
        scan_us: f64,
    ) -> Result<Recording, Error> {
        let sample_len: usize = operands.iter().map(|operand| operand.form.bytes()).sum();
        let count = usize::from(state.samples);
        let capacity = usize::from(state.capacity).max(1);
        let last_place = usize::from(state.end) / sample_len.max(1);
        let is_other =
            sample_len != usize::from(state.sample_len) || ring.len() < capacity * sample_len;
        if is_other || count > capacity || last_place >= capacity {
            return Err(Error::BadAnswer(
                "the trace has other operands than were asked for".into(),
            ));
        }
        // After the last place of the ring comes the first.
        let sample = |index: usize| {
            let at = (last_place + capacity - count + index) % capacity * sample_len;
            let mut rest = ring.get(at..).unwrap_or(&[]);
            let values = operands.iter().map(|operand| {
                let (value, behind) =
                    rest.split_at_checked(operand.form.bytes()).unwrap_or((&[], &[]));
                rest = behind;
                raw(value)
            });
            values.collect()
        };
        let samples: Vec<Vec<u32>> = (0..count).map(sample).collect();
        let first_scan =
            state.last_scan.wrapping_sub(state.samples.saturating_sub(1).wrapping_mul(every));
        let trigger = Some(usize::from(state.trigger)).filter(|&trigger| trigger < count);
        Ok(Recording { samples, operands, first_scan, every, trigger, scan_us })
    }

    /// Microseconds from the first sample to this one.
    fn time_us(&self, sample: usize) -> f64 {
        sample as f64 * f64::from(self.every) * self.scan_us
    }

    /// Writes `time_ms,scan,...`, a row for every sample.
    pub fn write_csv(&self, base: Base, out: &mut dyn Write) -> io::Result<()> {
        write_csv_header(&self.operands, out)?;
        for (index, values) in self.samples.iter().enumerate() {
            let scan = u64::from(self.first_scan) + index as u64 * u64::from(self.every);
            write_csv_row(self.time_us(index) / 1000.0, scan, &self.operands, values, base, out)?;
        }
        Ok(())
    }

    /// Writes a value change dump for GTKWave and other viewers.
    pub fn write_vcd(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut dump = Dump::begin(&self.operands, self.trigger.is_some(), out)?;
        for (index, values) in self.samples.iter().enumerate() {
            let at_us = self.time_us(index).round() as u64;
            dump.row(at_us, Some(values), self.trigger == Some(index))?;
        }
        dump.end(self.time_us(self.samples.len()).round() as u64)
    }
}

/// A number of scans, of which a PLC tells the low word: that after `before`, which was told last.
pub fn counted_scans(before: Option<u64>, low: u16) -> u64 {
    before.map_or(low.into(), |before| before + u64::from(low.wrapping_sub(before as u16)))
}

/// The header of a table for programs and spreadsheets.
pub fn write_csv_header(operands: &[Operand], out: &mut dyn Write) -> io::Result<()> {
    write!(out, "time_ms,scan")?;
    for operand in operands {
        // A symbol can hold the separator.
        match operand.name.contains([',', '"']) {
            true => write!(out, ",\"{}\"", operand.name.replace('"', "\"\""))?,
            false => write!(out, ",{}", operand.name)?,
        }
    }
    writeln!(out)
}

/// A row of it.
pub fn write_csv_row(
    time_ms: f64,
    scan: u64,
    operands: &[Operand],
    values: &[u32],
    base: Base,
    out: &mut dyn Write,
) -> io::Result<()> {
    // Whole milliseconds without decimals.
    let thousandths = (time_ms * 1000.0).round() as u64;
    match thousandths % 1000 {
        0 => write!(out, "{},{scan}", thousandths / 1000)?,
        fraction => write!(out, "{}.{fraction:03},{scan}", thousandths / 1000)?,
    }
    for (operand, &value) in operands.iter().zip(values) {
        write!(out, ",{}", operand.text(value, base))?;
    }
    writeln!(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> Recording {
        let operands = ["I0.0", "MW3"].map(|name| Operand::parse(name, &[]).unwrap()).to_vec();
        // A ring of four samples that has gone round: the first one is the third.
        let ring = [1, 0, 7, 1, 0xFF, 0xFF, 0, 0, 5, 0, 0, 6];
        let state = TraceState {
            sample_len: 3,
            capacity: 4,
            samples: 4,
            end: 6,
            trigger: 2,
            last_scan: 106,
            ring_at: 29,
        };
        Recording::of_ring(operands, &ring, &state, 2, 250.0).unwrap()
    }

    fn text(write: impl Fn(&mut dyn Write) -> io::Result<()>) -> String {
        let mut out = Vec::new();
        write(&mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn a_ring_is_put_in_order() {
        let csv = text(|out| recording().write_csv(Base::Decimal, out));
        assert_eq!(
            csv,
            "time_ms,scan,I0.0,MW3\n0,100,0,5\n0.500,102,0,6\n1,104,1,7\n1.500,106,1,-1\n"
        );
        assert_eq!(recording().trigger, Some(2));
    }

    #[test]
    fn waveforms() {
        let vcd = text(|out| recording().write_vcd(out));
        let changes = vcd.split("$enddefinitions $end\n").nth(1).unwrap();
        let expected = "#0\n0!\nb0000000000000101 \"\n0#\n#500\nb0000000000000110 \"\n\
                        #1000\n1!\nb0000000000000111 \"\n1#\n#1500\nb1111111111111111 \"\n0#\n\
                        #2000\n";
        assert_eq!(changes, expected);
    }

    #[test]
    fn a_ring_of_other_operands_is_refused() {
        let operands = vec![Operand::parse("MW3", &[]).unwrap()];
        let state = TraceState {
            sample_len: 3,
            capacity: 1,
            samples: 1,
            end: 0,
            trigger: 0,
            last_scan: 0,
            ring_at: 27,
        };
        assert!(Recording::of_ring(operands, &[0; 3], &state, 1, 1.0).is_err());
    }
}
