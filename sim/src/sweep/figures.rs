//! The figures of a frequency response: bandwidth and the margins of a loop. Between two measured
//! frequencies both curves are taken as straight, over the logarithm of the frequency.

use super::{Point, digits, rounded};

/// A gain of so many decibels less is a power of half.
const HALF_POWER: f64 = 3.010_299_956_639_812;

/// A curve comes by a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Where, in Hz.
    pub hertz: f64,
    /// The margin there: degrees to -180 at a gain of 0 dB, decibels to 0 dB at a phase of -180
    /// degrees. Of a loop that is cut open and would be stable closed both are above 0.
    pub margin: f64,
}

/// What is read off a frequency response; nothing where no measured frequency is beyond it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Figures {
    /// Where the gain has first fallen by 3 dB below that of the lowest frequency, in Hz.
    pub bandwidth: Option<f64>,
    /// Where the gain first falls below 0 dB, and the phase margin.
    pub gain_crossover: Option<Crossing>,
    /// Where the phase first falls below -180 degrees, and the gain margin in dB.
    pub phase_crossover: Option<Crossing>,
}

impl Figures {
    /// Of points with ascending frequencies.
    pub fn of(points: &[Point]) -> Figures {
        let gains: Vec<_> =
            points.iter().map(|point| (point.hertz.ln(), point.decibels())).collect();
        let phases: Vec<_> =
            points.iter().filter_map(|point| Some((point.hertz.ln(), point.phase?))).collect();
        let margin = |at: f64, other: &[(f64, f64)], from: f64, sign: f64| {
            let margin = rounded(sign * (value(other, at)? - from), 9);
            Some(Crossing { hertz: digits(at.exp()), margin })
        };
        let first = gains.first().map_or(0.0, |(_, gain)| *gain);
        let gain_crossover = falls_below(&gains, 0.0);
        let phase_crossover = falls_below(&phases, -180.0);
        Figures {
            bandwidth: falls_below(&gains, first - HALF_POWER).map(|at| digits(at.exp())),
            gain_crossover: gain_crossover.and_then(|at| margin(at, &phases, -180.0, 1.0)),
            phase_crossover: phase_crossover.and_then(|at| margin(at, &gains, 0.0, -1.0)),
        }
    }
}

/// Where a curve first comes from a limit or above it to below it.
fn falls_below(curve: &[(f64, f64)], limit: f64) -> Option<f64> {
    curve.windows(2).find_map(|pair| {
        let [(left, high), (right, low)] = [pair[0], pair[1]];
        if !(high >= limit && low < limit) {
            return None;
        }
        // A curve that falls to nothing does so at once.
        let part = if low.is_finite() { (high - limit) / (high - low) } else { 0.0 };
        Some(left + part * (right - left))
    })
}

/// The value of a curve; nothing outside of it.
fn value(curve: &[(f64, f64)], at: f64) -> Option<f64> {
    curve.windows(2).find_map(|pair| {
        let [(left, before), (right, after)] = [pair[0], pair[1]];
        let is_here = (left..=right).contains(&at);
        is_here.then(|| match (at - left) / (right - left) {
            0.0 => before,
            part => before + part * (after - before),
        })
    })
}
