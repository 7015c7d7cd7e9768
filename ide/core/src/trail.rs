//! The situations that charts are in, as the simulator executes them: each that differs from the
//! one before is kept until it is told. Of other targets only what they are asked is known.

use awl_sim::machine::Machine;
use awl_sim::operand::Operand;

/// Most situations that wait to be told, and most values in all of them.
const WAITING_MAX: usize = 1000;
const VALUES_MAX: usize = 50_000;

/// The values of the operands at the end of a scan.
#[derive(Debug, Clone, Default)]
pub struct Seen {
    /// When the scan began.
    pub time_ms: u64,
    /// Its number.
    pub scan: u32,
    /// A value for each operand; `None`: there is no such operand.
    pub values: Vec<Option<f64>>,
}

/// Operands, and the situations that the page does not know yet.
#[derive(Debug, Default)]
pub struct Trail {
    operands: Vec<Option<Operand>>,
    /// So many of them are steps, which make a situation another one.
    steps: usize,
    last: Vec<Option<f64>>,
    waiting: Vec<Seen>,
    is_lossy: bool,
}

impl Trail {
    /// Follows other charts: their operands, of which the first ones are steps.
    pub fn follow(&mut self, operands: Vec<Option<Operand>>, steps: usize) {
        *self = Trail { operands, steps, ..Trail::default() };
    }

    /// A scan is over, or something was set by hand.
    pub fn look(&mut self, time_ms: u64, scan: u32, machine: &mut impl Machine) {
        let steps = self.operands.iter().take(self.steps);
        let steps: Vec<_> = steps.map(|operand| read(*operand, machine)).collect();
        if steps == self.last {
            return;
        }
        self.last = steps;
        let most = WAITING_MAX.min(VALUES_MAX / self.operands.len().max(1));
        if self.waiting.len() >= most {
            self.waiting.clear();
            self.is_lossy = true;
        }
        let seen = self.now(time_ms, scan, machine);
        self.waiting.push(seen);
    }

    /// How it is now.
    pub fn now(&self, time_ms: u64, scan: u32, machine: &mut impl Machine) -> Seen {
        let values = self.operands.iter().map(|operand| read(*operand, machine)).collect();
        Seen { time_ms, scan, values }
    }

    /// The situations since the last time, and whether some are missing before them.
    pub fn take(&mut self) -> (Vec<Seen>, bool) {
        (std::mem::take(&mut self.waiting), std::mem::take(&mut self.is_lossy))
    }
}

fn read(operand: Option<Operand>, machine: &mut impl Machine) -> Option<f64> {
    let operand = operand?;
    machine.read(operand).ok().map(|value| operand.number(value))
}
