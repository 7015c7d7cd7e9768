//! Traces: the values of chosen operands after every scan. Kept as changes; how they are written is
//! for the formats.

pub mod csv;
pub mod svg;
pub mod table;
pub mod vcd;

use awl_asm::ast::{Symbol, Value};

use crate::machine::{Machine, MachineError};
use crate::operand::{Operand, OperandError};

/// An operand to trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signal {
    /// Which.
    pub operand: Operand,
    /// How the user wrote it: the name in every format.
    pub name: String,
    /// Symbol and comment as far as known, for people; may be empty.
    pub description: String,
}

impl Signal {
    /// A signal under its own name, described by what the program's symbols say.
    pub fn new(operand: Operand, symbols: &[Symbol]) -> Signal {
        Signal::named(operand, operand.to_string(), symbols)
    }

    /// Reads a signal as a user writes it, by address or symbol.
    pub fn parse(text: &str, symbols: &[Symbol]) -> Result<Signal, OperandError> {
        Operand::parse(text, symbols)
            .map(|operand| Signal::named(operand, text.to_string(), symbols))
    }

    fn named(operand: Operand, name: String, symbols: &[Symbol]) -> Signal {
        let meant = operand.address();
        let is_meant =
            |symbol: &&Symbol| matches!(symbol.value, Value::Address(address) if address == meant);
        let description = symbols.iter().find(is_meant).map_or_else(String::new, |symbol| {
            // Whoever asked for the symbol gets the address, and the other way round.
            let other = if symbol.name.eq_ignore_ascii_case(&name) {
                operand.to_string()
            } else {
                symbol.name.clone()
            };
            let separator = if symbol.comment.is_empty() { "" } else { ": " };
            format!("{other}{separator}{}", symbol.comment)
        });
        Signal { operand, name, description }
    }
}

/// A value that an operand has from a scan on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Change {
    /// The scan after which it is so, counted from 0.
    pub scan: u64,
    /// The value, words signed; of a real its bits.
    pub value: i32,
}

/// What was recorded.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    signals: Vec<Signal>,
    changes: Vec<Vec<Change>>,
    scan_ms: u64,
    scans: u64,
}

impl Trace {
    /// An empty trace. `scan_ms` is the time from scan start to scan start.
    pub fn new(signals: Vec<Signal>, scan_ms: u64) -> Trace {
        Trace { changes: vec![Vec::new(); signals.len()], signals, scan_ms, scans: 0 }
    }

    /// Adds the state after a scan; scans come in order.
    pub fn record(&mut self, machine: &mut (impl Machine + ?Sized)) -> Result<(), MachineError> {
        for (signal, changes) in self.signals.iter().zip(&mut self.changes) {
            let value = machine.read(signal.operand)?;
            if changes.last().is_none_or(|last| last.value != value) {
                changes.push(Change { scan: self.scans, value });
            }
        }
        self.scans += 1;
        Ok(())
    }

    /// The signals, in the order they were asked for.
    pub fn signals(&self) -> &[Signal] {
        &self.signals
    }

    /// The changes of a signal, by its place in [`signals`](Trace::signals). The first one is that
    /// of scan 0.
    pub fn changes(&self, signal: usize) -> &[Change] {
        self.changes.get(signal).map_or(&[], Vec::as_slice)
    }

    /// Number of scans.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// Time from scan start to scan start in milliseconds.
    pub fn scan_ms(&self) -> u64 {
        self.scan_ms
    }

    /// Goes through the scans that changed something, the first scan always.
    pub fn steps(&self) -> Steps<'_> {
        Steps {
            trace: self,
            next: vec![0; self.signals.len()],
            values: vec![0; self.signals.len()],
            is_begun: false,
        }
    }
}

/// A walk through the changes of all signals together.
pub struct Steps<'a> {
    trace: &'a Trace,
    next: Vec<usize>,
    values: Vec<i32>,
    is_begun: bool,
}

impl Steps<'_> {
    /// The scan of the next change, counted from 0.
    pub fn next_scan(&self) -> Option<u64> {
        let upcoming = self.trace.changes.iter().zip(&self.next);
        let first_change = upcoming
            .filter_map(|(changes, &next)| changes.get(next))
            .map(|change| change.scan)
            .min();
        // Without signals there is still a first scan.
        first_change.or_else(|| (!self.is_begun && self.trace.scans > 0).then_some(0))
    }

    /// Goes to the next change and tells its scan.
    pub fn advance(&mut self) -> Option<u64> {
        let scan = self.next_scan()?;
        self.is_begun = true;
        for (signal, next) in self.next.iter_mut().enumerate() {
            if let Some(change) =
                self.trace.changes[signal].get(*next).filter(|change| change.scan == scan)
            {
                self.values[signal] = change.value;
                *next += 1;
            }
        }
        Some(scan)
    }

    /// The values from this scan on, in the order of the signals.
    pub fn values(&self) -> &[i32] {
        &self.values
    }

    /// The same as people write them.
    pub fn texts(&self) -> impl Iterator<Item = String> {
        self.trace
            .signals
            .iter()
            .zip(&self.values)
            .map(|(signal, &value)| signal.operand.text(value))
    }
}

#[cfg(test)]
pub(crate) mod test_traces {
    //! Traces made from lists of values.

    use super::*;

    /// A trace with these values, one per scan.
    pub(crate) fn trace(scan_ms: u64, signals: &[(&str, &[i32])]) -> Trace {
        let list = signals.iter().map(|(name, _)| Signal::parse(name, &[]).unwrap()).collect();
        let mut trace = Trace::new(list, scan_ms);
        trace.scans = signals.iter().map(|(_, values)| values.len() as u64).max().unwrap_or(0);
        for (changes, (_, values)) in trace.changes.iter_mut().zip(signals) {
            for (scan, &value) in values.iter().enumerate() {
                if scan == 0 || values[scan - 1] != value {
                    changes.push(Change { scan: scan as u64, value });
                }
            }
        }
        trace
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::fake::Fake;

    #[test]
    fn records_changes_only() {
        let mut machine = Fake::new(|now, memory| memory.set("MW0", (now / 3) as i32));
        let mut trace = Trace::new(vec![Signal::parse("mw0", &[]).unwrap()], 1);
        for now in 0..7 {
            machine.scan(now);
            trace.record(&mut machine).unwrap();
        }
        let expected = [(0, 0), (3, 1), (6, 2)].map(|(scan, value)| Change { scan, value });
        assert_eq!((trace.changes(0), trace.scans()), (&expected[..], 7));
        assert_eq!(trace.signals()[0].name, "mw0");
    }

    #[test]
    fn steps_merge_the_signals() {
        let trace = test_traces::trace(1, &[("Q0.0", &[0, 0, 1, 1, 0]), ("MW0", &[5, 6, 7, 7, 7])]);
        let mut steps = trace.steps();
        let mut seen = Vec::new();
        while let Some(scan) = steps.advance() {
            seen.push((scan, steps.values().to_vec()));
        }
        assert_eq!(seen, [(0, vec![0, 5]), (1, vec![0, 6]), (2, vec![1, 7]), (4, vec![0, 7])]);
    }

    #[test]
    fn description_gives_what_the_name_does_not() {
        let value = Value::Address(awl_asm::Address::parse("Q0.1").unwrap());
        let symbols = [Symbol { name: "Lift".to_string(), value, comment: "up".to_string() }];
        assert_eq!(Signal::parse("Q0.1", &symbols).unwrap().description, "Lift: up");
        assert_eq!(Signal::parse("lift", &symbols).unwrap().description, "Q0.1: up");
        assert_eq!(Signal::parse("Q0.2", &symbols).unwrap().description, "");
    }
}
