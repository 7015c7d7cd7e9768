//! The frequency response of a path: a sine goes into one operand of a running program, and how
//! large and how late it comes out of another is measured, frequency by frequency. How that is
//! written is for the formats: [`bode`], [`table`].

pub mod bode;
mod correlation;
mod figures;
pub mod table;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::machine::{Machine, MachineError, Mode};
use crate::operand::{Operand, Width, value_of};
use crate::plant::Plant;
use crate::run::{Course, Fault, Outcome};
use crate::scenario::Scenario;
use crate::time::format_time;
use crate::trace::Trace;
use correlation::{Correlation, Phasor};

pub use figures::{Crossing, Figures};

/// At least so many whole periods are measured at once.
const PERIODS_MIN: f64 = 4.0;
/// At least so many scans are: a frequency is never further from the wanted one than half a scan in
/// them.
const SCANS_MIN: f64 = 100.0;
/// What begins is over when two measurements, one after the other, differ by no more than this
/// part.
const SETTLED: f64 = 1e-3;
/// What dies away slowly hardly counts in gain and phase, but in the distortion: that is measured
/// until it differs by no more than this part, or this much.
const DISTORTION_SETTLED: (f64, f64) = (0.1, 1e-3);
/// So often a frequency is measured at most.
const MEASUREMENTS_MAX: usize = 20;
/// Less than this part of the excitation is no sine but what rounding has left.
const NOTHING: f64 = 1e-9;
/// So many periods of the lowest frequency the program has to come to rest before it is excited.
const REST_PERIODS: f64 = 2.0;

/// What is to be measured.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// What is written before each scan: the offset and a sine. No bit.
    pub excite: Operand,
    /// Where the path begins; usually what is excited.
    pub from: Operand,
    /// Where it ends.
    pub to: Operand,
    /// In Hz, ascending, above 0 and less than half of a scan's.
    pub frequencies: Vec<f64>,
    /// The sine's, above 0.
    pub amplitude: f64,
    /// Around which value it swings.
    pub offset: f64,
    /// How long the offset alone is there first, in milliseconds; two periods of the lowest
    /// frequency if nothing is said.
    pub rest_ms: Option<u64>,
    /// Time from scan start to scan start in milliseconds, at least 1.
    pub scan_ms: u64,
}

impl Sweep {
    /// Whether it is possible, as far as that can be said before.
    pub fn check(&self) -> Result<(), SweepError> {
        let is_above = |hertz: &f64| *hertz > 0.0 && hertz.is_finite();
        let is_upwards = self.frequencies.is_sorted_by(|one, next| one < next);
        if !(is_upwards && self.frequencies.iter().all(is_above)) {
            return Err(SweepError::Band);
        }
        let is_real = |number: f64| (number as f32).is_finite();
        if !(self.amplitude > 0.0 && is_real(self.amplitude) && is_real(self.offset)) {
            return Err(SweepError::Sine);
        }
        self.check_range()?;
        let limit = 500.0 / self.scan_ms as f64;
        let is_too_fast =
            |hertz: &&f64| Window::of(**hertz, self.scan_ms).hertz(self.scan_ms) >= limit;
        let too_fast = self.frequencies.iter().rfind(is_too_fast);
        too_fast.map_or(Ok(()), |&hertz| Err(SweepError::Frequency(hertz, limit)))
    }

    /// Whether what is excited can hold the sine.
    fn check_range(&self) -> Result<(), SweepError> {
        match self.excite.width() {
            Width::Bit => return Err(SweepError::Bit(self.excite)),
            Width::Real => return Ok(()),
            Width::Byte | Width::Word | Width::Double => {}
        }
        let range = self.excite.range();
        let range = f64::from(*range.start())..=f64::from(*range.end());
        let ends = [self.offset - self.amplitude, self.offset + self.amplitude];
        match ends.iter().all(|end| range.contains(end)) {
            true => Ok(()),
            false => Err(SweepError::Range(self.excite)),
        }
    }

    /// How many scans it takes at most: where nothing settles.
    pub fn scans_max(&self) -> f64 {
        let windows = self.frequencies.iter().map(|&hertz| Window::of(hertz, self.scan_ms).scans);
        let rest = self.rest_ms() as f64 / self.scan_ms as f64;
        rest + windows.map(|scans| scans as f64 * MEASUREMENTS_MAX as f64).sum::<f64>()
    }

    /// How long the offset alone is there first.
    fn rest_ms(&self) -> u64 {
        let lowest = self.frequencies.first().copied().unwrap_or(f64::INFINITY);
        self.rest_ms.unwrap_or((REST_PERIODS * 1000.0 / lowest) as u64)
    }
}

/// What was measured at a frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// In Hz: the one nearest to the wanted that has whole periods in whole scans.
    pub hertz: f64,
    /// The amplitude at the path's end for that at its beginning.
    pub gain: f64,
    /// How far the end is ahead of the beginning, in degrees, without jumps from one frequency to
    /// the next; nothing where no sine comes out.
    pub phase: Option<f64>,
    /// What comes out besides the sine, for the sine: both as effective values. Of a path that is
    /// linear next to nothing.
    pub distortion: f64,
    /// Whether what begins with the sine was over when this was measured.
    pub is_settled: bool,
}

impl Point {
    /// The gain in decibels; minus infinity where nothing comes out.
    pub fn decibels(&self) -> f64 {
        rounded(20.0 * self.gain.log10(), 9)
    }
}

/// Why there is no frequency response.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepError {
    /// The frequencies do not go upwards from above 0.
    Band,
    /// The amplitude is not above 0, or no REAL can hold it or the offset.
    Sine,
    /// The machine cannot access an operand.
    Machine(MachineError),
    /// A bit is excited: it has no sine.
    Bit(Operand),
    /// The excitation leaves what the operand can hold.
    Range(Operand),
    /// There is no such sine: it needs more than two scans a period. In Hz, and the limit.
    Frequency(f64, f64),
    /// The program writes what is excited.
    Overwritten(Operand),
    /// The path's beginning does not follow the excitation, at so many Hz.
    Still(Operand, f64),
    /// The PLC has a fault.
    Fault(Fault),
    /// The PLC went to STOP at this time in milliseconds.
    Stop(u64),
}

impl From<MachineError> for SweepError {
    fn from(error: MachineError) -> SweepError {
        SweepError::Machine(error)
    }
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SweepError::Band => {
                f.write_str("the lowest frequency is above 0 Hz and below the highest")
            }
            SweepError::Sine => {
                f.write_str("the amplitude is above 0; a REAL can hold it and the offset")
            }
            SweepError::Machine(error) => error.fmt(f),
            SweepError::Bit(operand) => {
                write!(f, "{operand} is a bit, which cannot follow a sine: excite a number")
            }
            SweepError::Range(operand) => {
                let range = operand.range();
                let (low, high) = (range.start(), range.end());
                write!(f, "the sine leaves {low} to {high}, which is what {operand} can be")
            }
            SweepError::Frequency(hertz, limit) => write!(
                f,
                "{} needs more than two scans a period: with this scan time less than {}",
                table::hertz(*hertz),
                table::hertz(*limit)
            ),
            SweepError::Overwritten(operand) => write!(
                f,
                "the program writes {operand} itself, so the sine does not stay: excite what it \
                    only reads, such as a set value"
            ),
            SweepError::Still(operand, hertz) => write!(
                f,
                "{operand} does not follow the sine at {}: the path cannot begin there",
                table::hertz(*hertz)
            ),
            SweepError::Fault(fault) => fault.fmt(f),
            SweepError::Stop(at_ms) => {
                write!(f, "the PLC went to STOP at {}", format_time(*at_ms))
            }
        }
    }
}

impl std::error::Error for SweepError {}

/// So many frequencies from `low` to `high`, both above 0, each the same number of times the one
/// before.
pub fn spread(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high / low).ln() / count.saturating_sub(1).max(1) as f64;
    (0..count).map(|number| low * (step * number as f64).exp()).collect()
}

/// The band that is swept where nobody says which, in Hz: up to ten scans a period.
pub fn usual_band(scan_ms: u64) -> (f64, f64) {
    let scans_a_second = 1000.0 / scan_ms as f64;
    (scans_a_second / 1000.0, scans_a_second / 10.0)
}

/// Measures. `scenario`: what else is set; `plant`: what is wired to the PLC; `progress` is told
/// how many frequencies are done.
pub fn sweep(
    machine: &mut (impl Machine + ?Sized),
    wanted: &Sweep,
    scenario: &Scenario,
    plant: Option<Box<dyn Plant>>,
    progress: &mut dyn FnMut(usize),
) -> Result<Vec<Point>, SweepError> {
    wanted.check()?;
    let mut bench = Bench {
        machine,
        wanted,
        course: Course::new(scenario, plant, wanted.scan_ms),
        outcome: Outcome::new(wanted.scan_ms, Trace::new(Vec::new(), wanted.scan_ms)),
        scans: 0,
    };
    bench.rest()?;
    let mut points: Vec<Point> = Vec::new();
    for &hertz in &wanted.frequencies {
        let before = points.iter().rev().find_map(|point| point.phase);
        points.push(bench.point(Window::of(hertz, wanted.scan_ms), before)?);
        progress(points.len());
    }
    Ok(points)
}

/// What is measured at once: whole periods in whole scans.
#[derive(Debug, Clone, Copy)]
struct Window {
    periods: u64,
    scans: u64,
}

impl Window {
    fn of(hertz: f64, scan_ms: u64) -> Window {
        let periods_a_scan = hertz * scan_ms as f64 / 1000.0;
        let periods = (periods_a_scan * SCANS_MIN).round().max(PERIODS_MIN);
        Window { periods: periods as u64, scans: (periods / periods_a_scan).round() as u64 }
    }

    fn hertz(self, scan_ms: u64) -> f64 {
        self.periods as f64 * 1000.0 / (self.scans * scan_ms) as f64
    }

    /// The sine's angle before a scan. Whole periods are left out, so it is as exact late as early.
    fn angle(self, scan: u64) -> f64 {
        let part = self.periods * scan % self.scans;
        std::f64::consts::TAU * part as f64 / self.scans as f64
    }
}

/// A machine with what is around it.
struct Bench<'a, M: ?Sized> {
    machine: &'a mut M,
    wanted: &'a Sweep,
    course: Course,
    outcome: Outcome,
    scans: u64,
}

impl<M: Machine + ?Sized> Bench<'_, M> {
    fn rest(&mut self) -> Result<(), SweepError> {
        for _ in 0..self.wanted.rest_ms().div_ceil(self.wanted.scan_ms) {
            self.scan(self.wanted.offset)?;
        }
        Ok(())
    }

    /// A scan with this excitation: the values at the beginning and at the end of the path.
    fn scan(&mut self, excitation: f64) -> Result<[f64; 2], SweepError> {
        let Sweep { excite, from, to, scan_ms, .. } = *self.wanted;
        let now_ms = self.scans * scan_ms;
        self.scans += 1;
        self.course.go_on(now_ms, self.machine, &mut self.outcome)?;
        let value = match excite.width() {
            Width::Real => value_of(excitation as f32),
            _ => excitation.round() as i32,
        };
        self.machine.write(excite, value)?;
        self.machine.scan(now_ms);
        if self.machine.mode() == Mode::Stop {
            let fault = self.machine.fault().map(|text| Fault { at_ms: now_ms, text });
            return Err(fault.map_or(SweepError::Stop(now_ms), SweepError::Fault));
        }
        if self.machine.read(excite)? != value {
            return Err(SweepError::Overwritten(excite));
        }
        Ok([from.number(self.machine.read(from)?), to.number(self.machine.read(to)?)])
    }

    fn measure(&mut self, window: Window) -> Result<[Correlation; 2], SweepError> {
        let mut both = [Correlation::default(); 2];
        for scan in 0..window.scans {
            let (sine, cosine) = window.angle(scan).sin_cos();
            let excitation = self.wanted.offset + self.wanted.amplitude * sine;
            let weight = 1.0 - (std::f64::consts::TAU * scan as f64 / window.scans as f64).cos();
            let values = self.scan(excitation)?;
            for (correlation, value) in both.iter_mut().zip(values) {
                correlation.add(weight, (sine, cosine), value);
            }
        }
        Ok(both)
    }

    /// `before`: the phase of the frequency before.
    fn point(&mut self, window: Window, before: Option<f64>) -> Result<Point, SweepError> {
        let hertz = window.hertz(self.wanted.scan_ms);
        let mut last: Option<(Phasor, f64)> = None;
        let mut count = 0;
        loop {
            let [from, to] = self.measure(window)?;
            if from.sine().size() <= NOTHING * self.wanted.amplitude {
                return Err(SweepError::Still(self.wanted.from, hertz));
            }
            let (ratio, distortion) = (to.sine().over(from.sine()), to.distortion());
            let is_settled =
                last.is_some_and(|(last, _)| ratio.minus(last).size() <= SETTLED * ratio.size());
            let (part, least) = DISTORTION_SETTLED;
            let is_pure = last
                .is_some_and(|(_, last)| (distortion - last).abs() <= least.max(part * distortion));
            count += 1;
            if is_settled && is_pure || count == MEASUREMENTS_MAX {
                let gain = digits(ratio.size());
                let phase = (gain > 0.0).then(|| rounded(continued(ratio.degrees(), before), 9));
                // What the sums leave of a pure sine is a hundredth of that.
                let distortion = rounded(distortion, 6);
                return Ok(Point { hertz, gain, phase, distortion, is_settled });
            }
            last = Some((ratio, distortion));
        }
    }
}

/// The same angle, nearest to the one before. The first is -270 to 90 degrees: a loop's phase falls
/// from there.
fn continued(degrees: f64, before: Option<f64>) -> f64 {
    let middle = before.unwrap_or(-90.0);
    middle + (degrees - middle + 180.0).rem_euclid(360.0) - 180.0
}

/// A figure with nine digits. Sines and logarithms differ from computer to computer in the last of
/// sixteen; what is told of a path is the same on all.
fn digits(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

/// The same with so many decimals: of what is small beside what it is the difference of.
fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (value * scale).round() / scale
}
