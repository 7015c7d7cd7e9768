//! A bit as a wave: high parts filled.

use svg::node::element::{Group, Path as Shape};

use super::layout::{Layout, Row};
use super::path::{Path, Stretch, stretches};
use crate::trace::{Change, Trace};

/// Distance of the two levels from the edges of the row.
const PADDING: f64 = 10.0;
/// Width of a column in which more than two changes become a band.
const COLUMN: f64 = 3.0;
/// Width of a line.
pub(super) const LINE: f64 = 1.6;

pub(super) fn draw(
    changes: &[Change],
    trace: &Trace,
    row: &Row,
    layout: &Layout,
    ink: &str,
) -> Group {
    let (high, low) = (row.top + PADDING, row.top + row.height - PADDING);
    let right = layout.scan_x(trace.scans());
    let (mut line, mut fill, mut band) = (Path::default(), Path::default(), Path::default());
    let mut level: Option<f64> = None;
    for stretch in stretches(changes, |scan| layout.scan_x(scan), right, COLUMN) {
        match stretch {
            Stretch::Steady { left, right, value } => {
                let y = if value != 0 { high } else { low };
                match level {
                    Some(before) if before == y => &mut line,
                    Some(_) => line.down(y),
                    None => line.start(left, y),
                };
                line.across(right);
                level = Some(y);
                if value != 0 {
                    fill.block(left, right, high, low);
                }
            }
            Stretch::Busy { left, right, .. } => {
                band.block(left, right, high, low);
                level = None;
            }
        }
    }
    let mut group = Group::new();
    for (path, opacity) in [(fill, 0.22), (band, 0.5)] {
        if !path.is_empty() {
            group = group.add(
                Shape::new().set("d", path.finish()).set("fill", ink).set("fill-opacity", opacity),
            );
        }
    }
    group.add(outline(line, ink))
}

/// The line of a wave or curve.
pub(super) fn outline(line: Path, ink: &str) -> Shape {
    Shape::new()
        .set("d", line.finish())
        .set("fill", "none")
        .set("stroke", ink)
        .set("stroke-width", LINE)
}
