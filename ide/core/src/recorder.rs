//! A recording of what the target does: samples of some signals, as they come, for some time. What
//! was not measured is not in it.

use client::operand::Operand;
use client::trace::{Dump, counted_scans, write_csv_header, write_csv_row};
use client::value::{Base, Form};

use crate::protocol::{Event, Recording};
use crate::scope::Batch;

/// Most values of a recording: a page has no room for more.
const VALUES_MAX: usize = 4_000_000;

/// Values of a signal; `None`: nothing is known of it from that time on.
pub type Column = Vec<Option<f64>>;

/// How far a recording is.
#[derive(Debug)]
enum State {
    Going,
    Complete,
    /// Why it has ended before its time.
    Ended(String),
}

/// A recording that is under way.
#[derive(Debug)]
pub struct Recorder {
    operands: Vec<Operand>,
    every_ms: u32,
    for_ms: f64,
    /// The time of the first sample, on the clock of the target.
    begin: Option<f64>,
    times: Vec<f64>,
    /// Scans since RUN, as they are counted from the low word of the first.
    scans: Vec<u64>,
    columns: Vec<Column>,
    gaps: u32,
    state: State,
}

impl Recorder {
    /// Of these operands, for so long.
    pub fn new(operands: Vec<Operand>, every_ms: u32, for_ms: u32) -> Recorder {
        Recorder {
            columns: vec![Vec::new(); operands.len()],
            operands,
            every_ms,
            for_ms: for_ms.into(),
            begin: None,
            times: Vec::new(),
            scans: Vec::new(),
            gaps: 0,
            state: State::Going,
        }
    }

    /// Whether no more is to come.
    pub fn has_ended(&self) -> bool {
        !matches!(self.state, State::Going)
    }

    /// Ends it with what it has.
    pub fn end(&mut self, why: &str) {
        if !self.has_ended() {
            self.state = State::Ended(why.to_owned());
        }
    }

    /// Takes samples in, until it ends.
    pub fn take(&mut self, batch: &Batch) {
        if batch.is_lossy
            && let (Some(&next), Some(&last)) = (batch.times.first(), self.times.last())
            && !self.has_ended()
        {
            self.gap(last, next);
        }
        for (index, (&at, &scan)) in batch.times.iter().zip(&batch.scans).enumerate() {
            if self.has_ended() {
                return;
            }
            let values = batch.columns.iter().map(|column| column.get(index).copied());
            self.sample(at, scan, values.map(Option::unwrap_or_default));
        }
    }

    /// Nothing is known from when the next sample should have come until it came.
    fn gap(&mut self, last: f64, next: f64) {
        let missing = last + f64::from(self.every_ms.max(1));
        let next = next - self.begin.unwrap_or_default();
        self.gaps += 1;
        if missing >= next {
            return;
        }
        self.times.push(missing);
        self.scans.extend(self.scans.last().copied());
        for column in &mut self.columns {
            column.push(None);
        }
    }

    fn sample(&mut self, at: f64, scan: u16, values: impl Iterator<Item = f64>) {
        let time = at - *self.begin.get_or_insert(at);
        if self.times.last().is_some_and(|&last| time < last) {
            return self.end("the target began anew");
        }
        if self.columns.len() * (self.times.len() + 1) > VALUES_MAX {
            return self.end("the recording is full");
        }
        if time <= self.for_ms {
            self.times.push(time);
            self.scans.push(counted_scans(self.scans.last().copied(), scan));
            for (column, value) in self.columns.iter_mut().zip(values) {
                column.push(Some(value));
            }
        }
        if time >= self.for_ms {
            self.state = State::Complete;
        }
    }

    /// How far it is.
    pub fn progress(&self) -> Event {
        Event::Recording { done_ms: self.times.last().copied().unwrap_or(0.0), gaps: self.gaps }
    }

    /// What it has.
    pub fn recorded(self) -> Event {
        let recording = Recording {
            names: self.operands.iter().map(|operand| operand.name.clone()).collect(),
            figures: self.columns.iter().map(|column| figures(&self.times, column)).collect(),
            csv: self.text(|recorder, out| recorder.write_csv(out)),
            vcd: self.text(|recorder, out| recorder.write_vcd(out)),
            times: self.times,
            columns: self.columns,
            plant: None,
            gaps: self.gaps,
        };
        let ended = match self.state {
            State::Going | State::Complete => None,
            State::Ended(why) => Some(why),
        };
        Event::Recorded { recording, ended }
    }

    fn text(&self, write: impl Fn(&Self, &mut Vec<u8>) -> std::io::Result<()>) -> String {
        let mut out = Vec::new();
        // Writing to memory does not fail.
        let _ = write(self, &mut out);
        String::from_utf8_lossy(&out).into_owned()
    }

    /// The raw values of a row; `None`: nothing is known.
    fn row(&self, index: usize) -> Option<Vec<u32>> {
        let values = self.operands.iter().zip(&self.columns);
        values.map(|(operand, column)| Some(raw(operand.form, (*column.get(index)?)?))).collect()
    }

    fn write_csv(&self, out: &mut Vec<u8>) -> std::io::Result<()> {
        write_csv_header(&self.operands, out)?;
        for (index, (&time, &scan)) in self.times.iter().zip(&self.scans).enumerate() {
            let Some(values) = self.row(index) else { continue };
            write_csv_row(time, scan, &self.operands, &values, Base::Decimal, out)?;
        }
        Ok(())
    }

    fn write_vcd(&self, out: &mut Vec<u8>) -> std::io::Result<()> {
        let us = |ms: f64| (ms * 1000.0).round() as u64;
        let mut dump = Dump::begin(&self.operands, false, out)?;
        for (index, &time) in self.times.iter().enumerate() {
            dump.row(us(time), self.row(index).as_deref(), false)?;
        }
        dump.end(us(self.times.last().copied().unwrap_or(0.0)))
    }
}

/// The raw value of a number.
fn raw(form: Form, value: f64) -> u32 {
    match form {
        Form::Real => (value as f32).to_bits(),
        Form::Bit | Form::Byte => value as u32 & 0xFF,
        Form::Word => value as i32 as u32 & 0xFFFF,
        Form::Double => value as i64 as u32,
    }
}

/// Least, greatest and mean value over the time in which something is known.
pub fn figures(times: &[f64], column: &[Option<f64>]) -> (f64, f64, f64) {
    let known = || column.iter().copied().flatten();
    let least = known().fold(f64::INFINITY, f64::min);
    let greatest = known().fold(f64::NEG_INFINITY, f64::max);
    let spans = times.windows(2).zip(column.windows(2));
    let (mut area, mut whole) = (0.0, 0.0);
    for (time, values) in spans {
        if let [Some(value), Some(_)] = values {
            area += (time[1] - time[0]) * value;
            whole += time[1] - time[0];
        }
    }
    (least, greatest, if whole > 0.0 { area / whole } else { least })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn batch(samples: &[(f64, u16, f64)], is_lossy: bool) -> Batch {
        Batch {
            times: samples.iter().map(|sample| sample.0).collect(),
            scans: samples.iter().map(|sample| sample.1).collect(),
            columns: vec![samples.iter().map(|sample| sample.2).collect()],
            is_lossy,
        }
    }

    fn recorded(name: &str, for_ms: u32, batches: &[Batch]) -> (Recording, Option<String>) {
        let operand = Operand::parse(name, &[]).unwrap();
        let mut recorder = Recorder::new(vec![operand], 10, for_ms);
        batches.iter().for_each(|batch| recorder.take(batch));
        match recorder.recorded() {
            Event::Recorded { recording, ended } => (recording, ended),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_gap_is_a_gap() {
        let batches = [
            batch(&[(500.0, 65_535, 4.0), (510.0, 0, -2.0)], false),
            batch(&[(550.0, 4, 7.0), (560.0, 5, 7.0), (570.0, 6, 9.0)], true),
        ];
        let (recording, ended) = recorded("MW0", 60, &batches);
        assert_eq!(recording.times, [0.0, 10.0, 20.0, 50.0, 60.0]);
        let values = [Some(4.0), Some(-2.0), None, Some(7.0), Some(7.0)];
        assert_eq!(recording.columns, [values]);
        assert_eq!(recording.figures, [(-2.0, 7.0, 5.5)]);
        let rows = "0,65535,4\n10,65536,-2\n50,65540,7\n60,65541,7\n";
        assert_eq!(recording.csv, format!("time_ms,scan,MW0\n{rows}"));
        assert!(recording.vcd.contains("#20000\nbxxxxxxxxxxxxxxxx !\n#50000\n"));
        assert_eq!((recording.gaps, ended), (1, None));
    }

    #[test]
    fn it_ends_where_the_target_begins_anew() {
        let batches = [batch(&[(500.0, 1, 1.5), (0.0, 1, 2.5), (10.0, 2, 2.5)], false)];
        let (recording, ended) = recorded("VD0:real", 1000, &batches);
        assert_eq!(recording.csv, "time_ms,scan,VD0:real\n0,1,1.5\n");
        assert_eq!(ended.as_deref(), Some("the target began anew"));
    }
}
