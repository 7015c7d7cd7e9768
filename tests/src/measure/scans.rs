//! Whole scans of a program: its part, the rest, the period, and how much they vary.

use super::{Executable, Meter};

/// Scans that are looked at from mark to mark, by the board's own clock.
const SCANS: usize = 4_000;
/// Scans of which every instruction is looked at.
const EXECUTIONS: usize = 64;

/// How a number of cycles is spread over many scans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spread {
    /// The fewest.
    pub min: u64,
    /// As many have less as have more.
    pub median: u64,
    /// One in a hundred has more.
    pub p99: u64,
    /// The most.
    pub max: u64,
    /// The average, rounded up.
    pub mean: u64,
}

impl Spread {
    /// How these values are spread.
    ///
    /// # Panics
    /// Without any.
    pub fn of(mut values: Vec<u64>) -> Spread {
        values.sort_unstable();
        let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
        let mean = values.iter().sum::<u64>().div_ceil(values.len() as u64);
        Spread { min: at(0.0), median: at(0.5), p99: at(0.99), max: at(1.0), mean }
    }

    /// Both together, with the middle and the rest of the one that has more.
    pub fn with(self, other: Spread) -> Spread {
        let more = if self.median < other.median { other } else { self };
        Spread { min: self.min.min(other.min), max: self.max.max(other.max), ..more }
    }
}

/// The scans of a program.
#[derive(Debug, Clone, Copy)]
pub struct ScanFigures {
    /// From entering the program to leaving it, without interrupts.
    pub program: Spread,
    /// From before the inputs to after the outputs.
    pub whole: Spread,
    /// From a scan to the next.
    pub period: Spread,
}

impl ScanFigures {
    /// What a scan takes beside the program: a usual one, and on average. Once a millisecond a scan
    /// has more to do.
    pub fn overhead(&self) -> (u64, u64) {
        (self.period.median - self.program.median, self.period.mean - self.program.mean)
    }
}

/// Measures the scans of a program with all inputs off.
pub fn measure(executable: Executable) -> ScanFigures {
    let mut meter = Meter::new(executable);
    // What happens only after a start is over.
    meter.board.scans(EXECUTIONS);
    let scans = meter.board.scans(SCANS);
    let programs = (0..EXECUTIONS).map(|_| meter.execute().program).collect();
    ScanFigures {
        program: Spread::of(programs),
        whole: Spread::of(scans.iter().map(|scan| scan.cycles()).collect()),
        period: Spread::of(scans.windows(2).map(|pair| pair[1].start - pair[0].start).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn a_spread_tells_rare_values_from_usual_ones() {
        let values = (1..=200).rev().collect();
        let spread = Spread { min: 1, median: 101, p99: 198, max: 200, mean: 101 };
        assert_eq!(Spread::of(values), spread);
    }
}
