//! Samples of some signals, taken after a scan of the simulator, or as they come from a PLC on its
//! line: for the oscilloscope, or a recording. What was not measured is not there.

use awl_asm::Address;
use awl_sim::machine::Machine;
use awl_sim::operand::Operand;
use client::value::Form;

use crate::plc::Plc;
use crate::protocol::Event;
use crate::sampler::Sample;

/// Most samples that wait to be told.
const WAITING_MAX: usize = 20_000;

/// Signals, and the samples that the page does not know yet.
#[derive(Debug, Default)]
pub struct Scope {
    signals: Vec<Operand>,
    every_ms: u64,
    next_ms: u64,
    batches: Vec<Batch>,
    /// Whether samples are missing before the next one.
    is_lossy: bool,
}

/// Samples without a gap between them.
#[derive(Debug, Default)]
pub struct Batch {
    /// When each was taken, in milliseconds of the target.
    pub times: Vec<f64>,
    /// The low word of the scans until then.
    pub scans: Vec<u16>,
    /// Values, a column for each signal.
    pub columns: Vec<Vec<f64>>,
    /// Some are missing before them.
    pub is_lossy: bool,
}

impl Batch {
    /// For the page, which has asked for more signals than the known ones; nothing is known of the
    /// others.
    pub fn into_event(self, are_known: &[bool]) -> Event {
        let Batch { times, columns, is_lossy, .. } = self;
        let mut columns = columns.into_iter();
        let all = are_known.iter().map(|&is_known| match is_known {
            true => columns.next().unwrap_or_default(),
            false => vec![f64::NAN; times.len()],
        });
        let columns = all.collect();
        Event::Samples { times, columns, lost: is_lossy }
    }
}

impl Scope {
    /// Other signals, which the simulator gives.
    pub fn choose(&mut self, signals: Vec<Operand>, every_ms: u64) {
        *self = Scope { signals, every_ms, ..Scope::default() };
    }

    /// A scan that started at this time is over; `scan`: the low word of its number.
    pub fn sample(&mut self, now_ms: u64, scan: u16, machine: &mut impl Machine) {
        if self.signals.is_empty() || now_ms < self.next_ms {
            return;
        }
        self.next_ms = now_ms + self.every_ms.max(1);
        let read =
            |&signal: &Operand| machine.read(signal).map_or(f64::NAN, |value| signal.number(value));
        let values = self.signals.iter().map(read).collect();
        self.add(Sample { at_ms: now_ms, scan, values, is_late: false });
    }

    /// A sample has come.
    pub fn add(&mut self, sample: Sample) {
        let Sample { at_ms, scan, values, is_late } = sample;
        self.is_lossy |= is_late;
        if self.batches.iter().map(|batch| batch.times.len()).sum::<usize>() >= WAITING_MAX {
            self.is_lossy = true;
            return;
        }
        let is_lossy = std::mem::take(&mut self.is_lossy);
        if is_lossy || self.batches.is_empty() {
            let columns = vec![Vec::new(); values.len()];
            self.batches.push(Batch { columns, is_lossy, ..Batch::default() });
        }
        let Some(batch) = self.batches.last_mut() else { return };
        batch.times.push(at_ms as f64);
        batch.scans.push(scan);
        for (column, value) in batch.columns.iter_mut().zip(values) {
            column.push(value);
        }
    }

    /// Nothing was measured until now, whatever comes next.
    pub fn missed(&mut self) {
        self.is_lossy = true;
    }

    /// Time begins anew.
    pub fn restart(&mut self) {
        self.next_ms = 0;
    }

    /// The samples since the last time.
    pub fn take(&mut self) -> Vec<Batch> {
        std::mem::take(&mut self.batches)
    }
}

/// A signal of the simulator, by the name that it has for its PLC: a double word that the program
/// computes with as a real is one. What only simulators tell has no other name.
pub fn signal(name: &str, plc: &Plc) -> Result<Operand, String> {
    match plc.operand(name) {
        Ok(operand) => Ok(match (operand.address, operand.form) {
            (address, Form::Real) => Operand::Real(address),
            (Address::Timer(number), Form::Word) => Operand::TimerCurrent(number),
            (Address::Counter(number), Form::Word) => Operand::CounterCurrent(number),
            (address, _) => Operand::At(address),
        }),
        Err(_) => Operand::parse(name, plc.state.program.symbols()).map_err(|e| e.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_told_where_it_is() {
        let mut scope = Scope::default();
        for (at_ms, is_late) in [(0, false), (5, false), (30, true), (35, false)] {
            scope.add(Sample { at_ms, scan: 1, values: vec![1.0], is_late });
        }
        let told = scope.take();
        let told: Vec<_> = told.iter().map(|batch| (&batch.times[..], batch.is_lossy)).collect();
        assert_eq!(told, [(&[0.0, 5.0][..], false), (&[30.0, 35.0], true)]);
        assert!(scope.take().is_empty());
    }
}
