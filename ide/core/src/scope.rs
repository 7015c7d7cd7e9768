//! The oscilloscope: samples of some signals, taken after a scan of the simulator, or as they come
//! from a PLC on its line. What was not measured is not there.

use awl_asm::ast::Symbol;
use awl_sim::machine::Machine;
use awl_sim::operand::{Operand, Width};

use crate::protocol::Event;

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
struct Batch {
    times: Vec<f64>,
    columns: Vec<Vec<f64>>,
    /// Some are missing before them.
    is_lossy: bool,
}

impl Scope {
    /// Other signals, which the simulator gives.
    pub fn choose(&mut self, signals: Vec<Operand>, every_ms: u64) {
        *self = Scope { signals, every_ms, ..Scope::default() };
    }

    /// A scan that started at this time is over.
    pub fn sample(&mut self, now_ms: u64, machine: &mut impl Machine) {
        if self.signals.is_empty() || now_ms < self.next_ms {
            return;
        }
        self.next_ms = now_ms + self.every_ms.max(1);
        let read = |&signal: &Operand| {
            machine.read(signal).map_or(f64::NAN, |value| number(signal, value))
        };
        let values = self.signals.iter().map(read).collect();
        self.add(now_ms, values, false);
    }

    /// A sample has come: a value of each signal. `is_lossy`: others are missing before it.
    pub fn add(&mut self, now_ms: u64, values: Vec<f64>, is_lossy: bool) {
        self.is_lossy |= is_lossy;
        if self.batches.iter().map(|batch| batch.times.len()).sum::<usize>() >= WAITING_MAX {
            self.is_lossy = true;
            return;
        }
        let is_lossy = std::mem::take(&mut self.is_lossy);
        if is_lossy || self.batches.is_empty() {
            let columns = vec![Vec::new(); values.len()];
            self.batches.push(Batch { times: Vec::new(), columns, is_lossy });
        }
        let Some(batch) = self.batches.last_mut() else { return };
        batch.times.push(now_ms as f64);
        for (column, value) in batch.columns.iter_mut().zip(values) {
            column.push(value);
        }
    }

    /// Time begins anew.
    pub fn restart(&mut self) {
        self.next_ms = 0;
    }

    /// The samples since the last time.
    pub fn take(&mut self) -> impl Iterator<Item = Event> + use<> {
        std::mem::take(&mut self.batches).into_iter().map(|batch| Event::Samples {
            times: batch.times,
            columns: batch.columns,
            lost: batch.is_lossy,
        })
    }
}

/// Reads the names of signals.
pub fn signals(names: &[String], symbols: &[Symbol]) -> Result<Vec<Operand>, String> {
    let parse = |name: &String| Operand::parse(name, symbols).map_err(|error| error.to_string());
    names.iter().map(parse).collect()
}

/// A value as a number.
pub fn number(operand: Operand, value: i32) -> f64 {
    match operand.width() {
        Width::Real => f64::from(f32::from_bits(value as u32)),
        Width::Bit | Width::Byte | Width::Word | Width::Double => f64::from(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_told_where_it_is() {
        let mut scope = Scope::default();
        for (now_ms, is_lossy) in [(0, false), (5, false), (30, true), (35, false)] {
            scope.add(now_ms, vec![1.0], is_lossy);
        }
        let told: Vec<_> = scope
            .take()
            .map(|event| match event {
                Event::Samples { times, lost, .. } => (times, lost),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(told, [(vec![0.0, 5.0], false), (vec![30.0, 35.0], true)]);
        assert_eq!(scope.take().count(), 0);
    }
}
