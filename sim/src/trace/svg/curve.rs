//! A word or real as a step curve: the limits of its scale at the left, values where they are
//! long enough to be read.

use svg::node::element::{Group, Path as Shape};

use super::colour;
use super::layout::{Layout, Row, VALUE_SIZE};
use super::path::{Path, Stretch, stretches};
use super::text::{Anchor, label, width};
use super::wave::{LINE, outline};
use crate::operand::{Operand, Width, real_of};
use crate::trace::{Change, Trace};

/// Above the curve there is place for a value.
const PADDING_TOP: f64 = 22.0;
const PADDING_BOTTOM: f64 = 9.0;
/// Width of a column in which more than two changes become a band.
const COLUMN: f64 = 2.0;
/// A value needs this much more width than its digits.
const VALUE_ROOM: f64 = 10.0;
/// A band no higher than this is a steep slope, drawn like the line.
const SLOPE: f64 = 12.0;

/// The vertical scale of a word. Values of reals are here by their rank.
struct Scale {
    operand: Operand,
    lowest: i32,
    highest: i32,
    top: f64,
    bottom: f64,
}

impl Scale {
    fn y(&self, value: i32) -> f64 {
        let [number, lowest, highest] =
            [value, self.lowest, self.highest].map(|value| self.number(value));
        // What never changes runs along the bottom.
        let span = if highest > lowest { highest - lowest } else { 1.0 };
        self.bottom - (self.bottom - self.top) * (number - lowest) / span
    }

    fn number(&self, value: i32) -> f64 {
        match self.operand.width() {
            // The curve has no place for infinity.
            Width::Real => {
                Some(real_of(rank(value))).filter(|real| real.is_finite()).map_or(0.0, f64::from)
            }
            _ => f64::from(value),
        }
    }

    fn text(&self, value: i32) -> String {
        match self.operand.width() {
            Width::Real => self.operand.text(rank(value)),
            _ => self.operand.text(value),
        }
    }
}

/// The bits of reals as numbers in the order of the reals; applied twice, the bits again.
fn rank(bits: i32) -> i32 {
    if bits < 0 { bits ^ i32::MAX } else { bits }
}

pub(super) fn draw(
    operand: Operand,
    changes: &[Change],
    trace: &Trace,
    row: &Row,
    layout: &Layout,
) -> Group {
    if operand.width() != Width::Real {
        return draw_ranked(operand, changes, trace, row, layout);
    }
    let ranked: Vec<_> =
        changes.iter().map(|change| Change { value: rank(change.value), ..*change }).collect();
    draw_ranked(operand, &ranked, trace, row, layout)
}

fn draw_ranked(
    operand: Operand,
    changes: &[Change],
    trace: &Trace,
    row: &Row,
    layout: &Layout,
) -> Group {
    let ink = colour::of(operand);
    let values = changes.iter().map(|change| change.value);
    let (Some(lowest), Some(highest)) = (values.clone().min(), values.max()) else {
        return Group::new();
    };
    let (top, bottom) = (row.top + PADDING_TOP, row.top + row.height - PADDING_BOTTOM);
    let scale = Scale { operand, lowest, highest, top, bottom };
    let list = stretches(changes, |scan| layout.scan_x(scan), layout.scan_x(trace.scans()), COLUMN);
    let mut group = limits(&scale, layout);
    for shape in shapes(&list, &scale, ink) {
        group = group.add(shape);
    }
    for (x, stretch_width, value) in plateaus(&list) {
        let text = scale.text(value);
        if width(&text, VALUE_SIZE) + VALUE_ROOM <= stretch_width {
            group = group.add(label(
                &text,
                x + 5.0,
                scale.y(value) - 5.0,
                VALUE_SIZE,
                ink,
                Anchor::Start,
            ));
        }
    }
    group
}

fn limits(scale: &Scale, layout: &Layout) -> Group {
    let x = layout.left - 6.0;
    let mut group = Group::new();
    let limits = if scale.lowest == scale.highest {
        vec![scale.lowest]
    } else {
        vec![scale.lowest, scale.highest]
    };
    for value in limits {
        let y = scale.y(value) + 4.0;
        group =
            group.add(label(&scale.text(value), x, y, VALUE_SIZE, colour::FAINT_INK, Anchor::End));
    }
    group
}

fn shapes(list: &[Stretch], scale: &Scale, ink: &str) -> Vec<Shape> {
    let (mut line, mut fill) = (Path::default(), Path::default());
    let (mut slope, mut band) = (Path::default(), Path::default());
    let mut is_joined = false;
    for stretch in list {
        match *stretch {
            Stretch::Steady { left, right, value } => {
                let y = scale.y(value);
                if is_joined { line.down(y) } else { line.start(left, y) }.across(right);
                fill.block(left, right, y, scale.bottom);
                is_joined = true;
            }
            Stretch::Busy { left, right, low, high } => {
                // At least a line's width, where it is busy within one pixel.
                let (top, bottom) = (scale.y(high) - LINE / 2.0, scale.y(low) + LINE / 2.0);
                let path = if bottom - top > SLOPE { &mut band } else { &mut slope };
                path.block(left, right, top, bottom);
                fill.block(left, right, scale.y(low), scale.bottom);
                is_joined = false;
            }
        }
    }
    let mut shapes = Vec::new();
    for (path, opacity) in [(fill, 0.08), (band, 0.5), (slope, 1.0)] {
        if !path.is_empty() {
            shapes.push(
                Shape::new().set("d", path.finish()).set("fill", ink).set("fill-opacity", opacity),
            );
        }
    }
    shapes.push(outline(line, ink));
    shapes
}

/// Stretches with one value: left edge, width, value. Neighbours with the same value are one.
fn plateaus(list: &[Stretch]) -> Vec<(f64, f64, i32)> {
    let mut plateaus: Vec<(f64, f64, i32)> = Vec::new();
    let mut end = f64::NEG_INFINITY;
    for stretch in list {
        if let Stretch::Steady { left, right, value } = *stretch {
            match plateaus.last_mut() {
                Some(last) if last.2 == value && end == left => last.1 = right - last.0,
                _ => plateaus.push((left, right - left, value)),
            }
            end = right;
        }
    }
    plateaus
}
