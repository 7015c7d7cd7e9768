//! Pulses at digital inputs: a train of them at one input, or at two as an encoder gives them.
//! Times in nanoseconds.

/// Nanoseconds in a millisecond.
pub const NS_PER_MS: u64 = 1_000_000;
/// Highest frequency of pulses in hertz.
pub const FREQUENCY_MAX_HZ: u64 = 200_000;
/// Nanoseconds in 1,000 seconds: the period of a millihertz.
const MILLIHERTZ_NS: u128 = 1_000_000_000_000;

/// A train of pulses with as long pauses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pulse {
    /// When it begins, in milliseconds, with a rising edge.
    pub at_ms: u64,
    /// The input: bit of IB0.
    pub input: u8,
    /// The input that follows a quarter of the period later, as the second track of an encoder
    /// does.
    pub second: Option<u8>,
    /// Pulses in 1,000 seconds.
    pub millihertz: u64,
    /// How many pulses.
    pub count: u64,
}

/// A change of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// When.
    pub at_ns: u64,
    /// Bit of IB0.
    pub input: u8,
    /// The new value.
    pub level: bool,
}

impl Pulse {
    /// The pulses that fit into so many milliseconds.
    pub fn count_in(millihertz: u64, ms: u64) -> u64 {
        (u128::from(millihertz) * u128::from(ms) / 1_000_000) as u64
    }

    /// When the last pulse and the pause after it are over, in milliseconds, rounded up.
    pub fn end_ms(&self) -> u64 {
        self.at_ms + self.time_of(self.edges()).div_ceil(NS_PER_MS)
    }

    /// Whether it drives this input.
    pub fn drives(&self, input: u8) -> bool {
        self.input == input || self.second == Some(input)
    }

    fn edges_per_pulse(&self) -> u64 {
        if self.second.is_some() { 4 } else { 2 }
    }

    fn edges(&self) -> u64 {
        self.count * self.edges_per_pulse()
    }

    /// Nanoseconds from the beginning to an edge.
    fn time_of(&self, edge: u64) -> u64 {
        let parts = u128::from(self.millihertz) * u128::from(self.edges_per_pulse());
        (u128::from(edge) * MILLIHERTZ_NS / parts.max(1)) as u64
    }

    fn edge(&self, index: u64) -> Option<Edge> {
        if index >= self.edges() {
            return None;
        }
        let step = index % self.edges_per_pulse();
        let (input, level) = match self.second {
            Some(second) => (if step.is_multiple_of(2) { self.input } else { second }, step < 2),
            None => (self.input, step == 0),
        };
        Some(Edge { at_ns: self.at_ms * NS_PER_MS + self.time_of(index), input, level })
    }
}

/// The trains that are under way.
#[derive(Debug, Clone, Default)]
pub struct Pulses {
    trains: Vec<Train>,
}

#[derive(Debug, Clone)]
struct Train {
    pulse: Pulse,
    /// Edges that are over.
    done: u64,
    /// No edge comes from this time on.
    end_ns: u64,
}

impl Train {
    fn next(&self) -> Option<Edge> {
        self.pulse.edge(self.done).filter(|edge| edge.at_ns < self.end_ns)
    }
}

impl Pulses {
    /// A train begins, at its time. One that drives the same input ends then.
    pub fn begin(&mut self, pulse: Pulse) {
        for train in &mut self.trains {
            if (0..8).any(|input| train.pulse.drives(input) && pulse.drives(input)) {
                train.end_ns = train.end_ns.min(pulse.at_ms * NS_PER_MS);
            }
        }
        self.trains.push(Train { pulse, done: 0, end_ns: u64::MAX });
    }

    /// When the next edge is.
    pub fn next_ns(&self) -> Option<u64> {
        self.trains.iter().filter_map(Train::next).map(|edge| edge.at_ns).min()
    }

    /// Takes the next edge up to this time. The sooner first; of the same time that of the train
    /// that began first.
    pub fn take(&mut self, until_ns: u64) -> Option<Edge> {
        let edge = self.trains.iter().filter_map(Train::next).min_by_key(|edge| edge.at_ns)?;
        if edge.at_ns > until_ns {
            return None;
        }
        if let Some(train) = self.trains.iter_mut().find(|train| train.next() == Some(edge)) {
            train.done += 1;
        }
        self.trains.retain(|train| train.next().is_some());
        Some(edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn train(pulse: Pulse) -> Vec<(u64, u8, bool)> {
        let mut pulses = Pulses::default();
        pulses.begin(pulse);
        std::iter::from_fn(|| pulses.take(u64::MAX))
            .map(|edge| (edge.at_ns, edge.input, edge.level))
            .collect()
    }

    const PULSE: Pulse =
        Pulse { at_ms: 2, input: 3, second: None, millihertz: 1_000_000, count: 2 };

    #[test]
    fn half_of_each_period_is_high() {
        let expected = [
            (2_000_000, 3, true),
            (2_500_000, 3, false),
            (3_000_000, 3, true),
            (3_500_000, 3, false),
        ];
        assert_eq!(train(PULSE), expected);
        assert_eq!(PULSE.end_ms(), 4);
    }

    #[test]
    fn the_second_track_follows_by_a_quarter() {
        let encoder = Pulse { at_ms: 0, input: 0, second: Some(1), millihertz: 250_000, count: 1 };
        let expected =
            [(0, 0, true), (1_000_000, 1, true), (2_000_000, 0, false), (3_000_000, 1, false)];
        assert_eq!(train(encoder), expected);
    }

    #[test]
    fn edges_of_an_odd_frequency_do_not_drift() {
        let edges = train(Pulse { at_ms: 0, millihertz: 3_000, count: 3_000_000, ..PULSE });
        assert_eq!(edges.len(), 6_000_000);
        assert_eq!(edges[5_999_994].0, 999_999_000_000_000);
        assert_eq!((Pulse::count_in(3_000, 999), Pulse::count_in(3_000, 1_000)), (2, 3));
    }

    #[test]
    fn trains_run_beside_each_other_and_a_new_one_takes_over() {
        let mut pulses = Pulses::default();
        pulses.begin(PULSE);
        pulses.begin(Pulse { input: 4, at_ms: 3, count: 1, ..PULSE });
        let order: Vec<_> = std::iter::from_fn(|| pulses.take(3_000_000))
            .map(|edge| (edge.at_ns, edge.input))
            .collect();
        assert_eq!(order, [(2_000_000, 3), (2_500_000, 3), (3_000_000, 3), (3_000_000, 4)]);
        assert_eq!(pulses.next_ns(), Some(3_500_000));
        pulses.begin(Pulse { at_ms: 9, count: 9, ..PULSE });
        // It is told of before its time, and ends the one before at its time.
        pulses.begin(Pulse { at_ms: 10, count: 1, ..PULSE });
        let rest: Vec<_> = std::iter::from_fn(|| pulses.take(u64::MAX))
            .map(|edge| (edge.at_ns, edge.input))
            .collect();
        let expected = [
            (3_500_000, 3),
            (3_500_000, 4),
            (9_000_000, 3),
            (9_500_000, 3),
            (10_000_000, 3),
            (10_500_000, 3),
        ];
        assert_eq!(rest, expected);
    }
}
