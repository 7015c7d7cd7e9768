//! The oscilloscope: samples of some signals, taken after a scan of the simulator. What was not
//! measured is not there.

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
    times: Vec<f64>,
    columns: Vec<Vec<f64>>,
    is_lossy: bool,
}

impl Scope {
    /// Other signals.
    pub fn choose(&mut self, signals: Vec<Operand>, every_ms: u64) {
        let columns = vec![Vec::new(); signals.len()];
        *self = Scope { signals, every_ms, columns, ..Scope::default() };
    }

    /// A scan that started at this time is over.
    pub fn sample(&mut self, now_ms: u64, machine: &mut impl Machine) {
        if self.signals.is_empty() || now_ms < self.next_ms {
            return;
        }
        self.next_ms = now_ms + self.every_ms.max(1);
        if self.times.len() >= WAITING_MAX {
            self.is_lossy = true;
            return;
        }
        self.times.push(now_ms as f64);
        for (signal, column) in self.signals.iter().zip(&mut self.columns) {
            column.push(machine.read(*signal).map_or(f64::NAN, |value| number(*signal, value)));
        }
    }

    /// Time begins anew.
    pub fn restart(&mut self) {
        self.next_ms = 0;
    }

    /// The samples since the last time.
    pub fn take(&mut self) -> Option<Event> {
        if self.times.is_empty() {
            return None;
        }
        let columns = self.columns.iter_mut().map(std::mem::take).collect();
        let lost = std::mem::take(&mut self.is_lossy);
        Some(Event::Samples { times: std::mem::take(&mut self.times), columns, lost })
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
