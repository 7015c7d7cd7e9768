//! A frequency response as a Bode plot (SVG): the gain in decibels and the phase in degrees over
//! the logarithm of the frequency. The same points give the same text.

use std::io::{self, Write};

use svg::node::element::{Circle, Group, Polyline};

use super::{Point, table};
use crate::trace::svg::axis::line;
use crate::trace::svg::colour::{AXIS, FAINT_INK, GRID, INK, PAPER};
use crate::trace::svg::sheet;
use crate::trace::svg::text::{Anchor, label, round};

const WIDTH: f64 = 760.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = WIDTH - 24.0;
const TOP: f64 = 62.0;
/// Height of each of the two plots, and what is between them.
const HEIGHT: f64 = 210.0;
const BETWEEN: f64 = 26.0;
const SIZE: f64 = 12.0;
const LINE_HEIGHT: f64 = 18.0;
/// Most lines of a scale.
const LINES_MAX: f64 = 8.0;
/// Steps from line to line.
const DECIBELS: &[f64] = &[0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 6.0, 10.0, 20.0, 40.0, 60.0];
const DEGREES: &[f64] = &[1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0];
const GAIN: &str = "#1f5fb4";
const PHASE: &str = "#c2410c";

/// Writes the plot. `title` is above it.
pub fn write(points: &[Point], title: &str, out: &mut dyn Write) -> io::Result<()> {
    let figures = table::figures(points);
    let bottom = TOP + 2.0 * HEIGHT + BETWEEN;
    let height = bottom + 40.0 + LINE_HEIGHT * figures.len() as f64;
    let band = Band::of(points);
    let gains = points.iter().map(|point| (point, Some(point.decibels())));
    let phases = points.iter().map(|point| (point, point.phase));
    let mut document = sheet(WIDTH, height)
        .add(label(title, 18.0, 27.0, 16.0, INK, Anchor::Start).set("font-weight", "bold"))
        .add(label("gain in dB", 18.0, TOP - 12.0, SIZE, GAIN, Anchor::Start))
        .add(plot(&band, TOP, gains, DECIBELS, GAIN))
        .add(label("phase in degrees", 18.0, TOP + HEIGHT + 17.0, SIZE, PHASE, Anchor::Start))
        .add(plot(&band, TOP + HEIGHT + BETWEEN, phases, DEGREES, PHASE))
        .add(band.labels(bottom + 17.0));
    for (number, line) in figures.iter().enumerate() {
        let y = bottom + 40.0 + LINE_HEIGHT * number as f64;
        document = document.add(label(line, LEFT, y, SIZE, INK, Anchor::Start));
    }
    writeln!(out, "{document}")
}

/// The frequencies from left to right.
struct Band {
    low: f64,
    high: f64,
}

impl Band {
    fn of(points: &[Point]) -> Band {
        let low = points.first().map_or(1.0, |point| point.hertz);
        let high = points.last().map_or(1.0, |point| point.hertz);
        // A single frequency is in the middle.
        if high > low { Band { low, high } } else { Band { low: low / 2.0, high: low * 2.0 } }
    }

    fn x(&self, hertz: f64) -> f64 {
        LEFT + (RIGHT - LEFT) * (hertz / self.low).ln() / (self.high / self.low).ln()
    }

    /// One to nine times every power of ten that are in it.
    fn lines(&self) -> impl Iterator<Item = (u8, f64)> {
        let powers = self.low.log10().floor() as i32..=self.high.log10().floor() as i32;
        let lines = powers.flat_map(|power| {
            (1..=9_u8).map(move |digit| (digit, f64::from(digit) * 10.0_f64.powi(power)))
        });
        // The ends are there in spite of rounding.
        lines.filter(|(_, hertz)| (self.low * 0.999..=self.high * 1.001).contains(hertz))
    }

    /// With few powers of ten also what is between them.
    fn labels(&self, y: f64) -> Group {
        let is_wide = self.high / self.low >= 30.0;
        let shown: &[u8] = if is_wide { &[1] } else { &[1, 2, 5] };
        self.lines().filter(|(digit, _)| shown.contains(digit)).fold(
            Group::new(),
            |group, (_, hertz)| {
                let (number, unit) = table::in_unit(hertz);
                // Powers of ten are not exact.
                let text = format!("{} {unit}", (number * 1e6).round() / 1e6);
                group.add(label(&text, self.x(hertz), y, SIZE, FAINT_INK, Anchor::Middle))
            },
        )
    }
}

/// A curve with its grid. What is not finite is left out; what is not settled is a hollow point.
fn plot<'p>(
    band: &Band,
    top: f64,
    curve: impl Iterator<Item = (&'p Point, Option<f64>)>,
    steps: &[f64],
    ink: &str,
) -> Group {
    let curve: Vec<(&Point, f64)> = curve
        .filter_map(|(point, value)| Some((point, value.filter(|value| value.is_finite())?)))
        .collect();
    let scale = Scale::of(curve.iter().map(|(_, value)| *value), steps, top);
    let mut group = Group::new();
    for (digit, hertz) in band.lines() {
        let (x, colour) = (band.x(hertz), if digit == 1 { AXIS } else { GRID });
        group = group.add(line(x, x, top, top + HEIGHT, colour));
    }
    for value in scale.lines() {
        let y = scale.y(value);
        // The lines that margins are counted from.
        let is_limit = value == 0.0 || value == -180.0;
        group = group.add(line(LEFT, RIGHT, y, y, if is_limit { AXIS } else { GRID })).add(label(
            &scale.text(value),
            LEFT - 8.0,
            y + 4.0,
            SIZE,
            FAINT_INK,
            Anchor::End,
        ));
    }
    let place =
        |(point, value): &(&Point, f64)| (round(band.x(point.hertz)), round(scale.y(*value)));
    let corners: Vec<String> = curve.iter().map(place).map(|(x, y)| format!("{x},{y}")).collect();
    let path = Polyline::new()
        .set("points", corners.join(" "))
        .set("fill", "none")
        .set("stroke", ink)
        .set("stroke-width", 1.6);
    curve.iter().fold(group.add(path), |group, one| {
        let (x, y) = place(one);
        let fill = if one.0.is_settled { ink } else { PAPER };
        let dot = Circle::new().set("cx", x).set("cy", y).set("r", 2.6).set("stroke", ink);
        group.add(dot.set("fill", fill))
    })
}

/// A vertical scale with round numbers.
struct Scale {
    low: f64,
    high: f64,
    step: f64,
    top: f64,
}

impl Scale {
    fn of(values: impl Iterator<Item = f64> + Clone, steps: &[f64], top: f64) -> Scale {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let fits = |step: &&f64| (high / **step).ceil() - (low / **step).floor() <= LINES_MAX;
        let largest = steps.last().copied().unwrap_or(1.0);
        let doubled = || {
            let mut step = largest;
            while !fits(&&step) {
                step *= 2.0;
            }
            step
        };
        let step = steps.iter().find(fits).copied().unwrap_or_else(doubled);
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        // A level curve has a scale, too.
        let high = if high > low { high } else { low + step };
        Scale { low, high, step, top }
    }

    fn y(&self, value: f64) -> f64 {
        self.top + HEIGHT * (self.high - value) / (self.high - self.low)
    }

    fn lines(&self) -> impl Iterator<Item = f64> {
        let count = ((self.high - self.low) / self.step).round() as u32;
        (0..=count).map(|number| {
            let value = self.low + self.step * f64::from(number);
            // Sums of tenths are not exact.
            (value / self.step).round() * self.step
        })
    }

    fn text(&self, value: f64) -> String {
        if self.step < 1.0 { format!("{value:.1}") } else { format!("{value:.0}") }
    }
}
