//! The time axis: round times at a readable distance, above and below the waves, with grid lines.

use svg::node::element::{Group, Line};

use super::colour;
use super::layout::{Layout, MARGIN};
use super::text::{Anchor, label, round};

/// Least distance of two labels in pixels.
const DISTANCE: f64 = 76.0;
const SIZE: f64 = 12.0;

const SECOND: u64 = 1000;
const MINUTE: u64 = 60 * SECOND;
const HOUR: u64 = 60 * MINUTE;
const DAY: u64 = 24 * HOUR;

/// Steps from label to label, in milliseconds: what people count in.
const STEPS: &[u64] = &[
    1,
    2,
    5,
    10,
    20,
    50,
    100,
    200,
    500,
    SECOND,
    2 * SECOND,
    5 * SECOND,
    10 * SECOND,
    20 * SECOND,
    30 * SECOND,
    MINUTE,
    2 * MINUTE,
    5 * MINUTE,
    10 * MINUTE,
    15 * MINUTE,
    30 * MINUTE,
    HOUR,
    2 * HOUR,
    3 * HOUR,
    6 * HOUR,
    12 * HOUR,
    DAY,
    2 * DAY,
    5 * DAY,
    10 * DAY,
    20 * DAY,
    50 * DAY,
    100 * DAY,
];

/// How times are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    Milliseconds,
    Seconds,
    Minutes,
    Hours,
}

impl Unit {
    fn of(total_ms: u64) -> Unit {
        match total_ms {
            ..=1999 => Unit::Milliseconds,
            2000..=179_999 => Unit::Seconds,
            180_000..=10_799_999 => Unit::Minutes,
            _ => Unit::Hours,
        }
    }

    fn caption(self) -> &'static str {
        match self {
            Unit::Milliseconds => "time in ms",
            Unit::Seconds => "time in s",
            Unit::Minutes => "time in min:s",
            Unit::Hours => "time in h:min",
        }
    }

    pub(super) fn format(self, ms: u64, step_ms: u64) -> String {
        match self {
            Unit::Milliseconds => ms.to_string(),
            Unit::Seconds if step_ms.is_multiple_of(SECOND) => (ms / SECOND).to_string(),
            Unit::Seconds => {
                let decimals = if step_ms.is_multiple_of(100) { 1 } else { 2 };
                format!("{:.decimals$}", ms as f64 / SECOND as f64)
            }
            Unit::Minutes => format!("{}:{:02}", ms / MINUTE, ms % MINUTE / SECOND),
            Unit::Hours => format!("{}:{:02}", ms / HOUR, ms % HOUR / MINUTE),
        }
    }
}

/// The shortest step whose labels are far enough apart.
fn step(total_ms: u64, plot_width: f64) -> u64 {
    let fits = |step: &&u64| **step as f64 / total_ms as f64 * plot_width >= DISTANCE;
    STEPS.iter().find(fits).copied().unwrap_or(total_ms)
}

/// Labels and grid lines.
pub(super) fn draw(layout: &Layout) -> Group {
    let step_ms = step(layout.total_ms, layout.right - layout.left);
    let unit = Unit::of(layout.total_ms);
    let (above, below) = (layout.top - 10.0, layout.bottom + 19.0);
    let mut group = Group::new();
    for y in [above, below] {
        group = group.add(label(unit.caption(), MARGIN, y, SIZE, colour::FAINT_INK, Anchor::Start));
    }
    for y in [layout.top, layout.bottom] {
        group = group.add(line(layout.left, layout.right, y, y, colour::AXIS));
    }
    for ms in (0..=layout.total_ms).step_by(step_ms as usize) {
        let x = round(layout.x(ms));
        group = group.add(line(x, x, layout.top - 5.0, layout.bottom + 5.0, colour::GRID));
        for y in [above, below] {
            group = group.add(label(
                &unit.format(ms, step_ms),
                x,
                y,
                SIZE,
                colour::FAINT_INK,
                Anchor::Middle,
            ));
        }
    }
    group
}

pub(crate) fn line(x1: f64, x2: f64, y1: f64, y2: f64, colour: &str) -> Line {
    let [x1, x2, y1, y2] = [x1, x2, y1, y2].map(round);
    Line::new().set("x1", x1).set("x2", x2).set("y1", y1).set("y2", y2).set("stroke", colour)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_far_apart() {
        for (total_ms, expected) in [
            (1, 1),
            (20, 2),
            (1000, 100),
            (12_000, SECOND),
            (60_000, 5 * SECOND),
            (HOUR, 5 * MINUTE),
            (DAY, 2 * HOUR),
        ] {
            assert_eq!(step(total_ms, 1000.0), expected, "{total_ms}");
        }
        assert!(step(1000 * DAY, 1000.0) >= 76 * DAY);
    }

    #[test]
    fn times_are_written_in_fitting_units() {
        assert_eq!(Unit::of(1999).format(200, 200), "200");
        assert_eq!(Unit::of(2000).format(1200, 200), "1.2");
        assert_eq!(Unit::of(60_000).format(5000, 5000), "5");
        assert_eq!(Unit::of(HOUR).format(65_000, 5000), "1:05");
        assert_eq!(Unit::of(DAY).format(DAY, HOUR), "24:00");
    }
}
