//! The trace as a timing diagram (SVG): bits as waves, words as curves with their values, over a
//! time axis.
//!
//! Nothing here depends on the machine it runs on: the same trace gives the same text. However long
//! the trace is, the drawing stays small: what changes faster than the eye can follow is drawn as a
//! shaded band.

pub(crate) mod axis;
pub(crate) mod colour;
mod curve;
mod layout;
mod path;
pub(crate) mod text;
mod wave;

use std::io::{self, Write};

use svg::Document;
use svg::node::element::{Group, Line, Rectangle, Title};

use super::{Signal, Trace};
use crate::operand::Width;
use crate::time::format_time;
use layout::{Layout, Row};
use text::{Anchor, label};

/// An empty drawing, with its font and its paper.
pub(crate) fn sheet(width: f64, height: f64) -> Document {
    Document::new()
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("width", width)
        .set("height", height)
        .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif")
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", colour::PAPER))
}

/// Writes the trace. `title` is above the diagram, usually the name of the program.
pub fn write(trace: &Trace, title: &str, out: &mut dyn Write) -> io::Result<()> {
    let layout = Layout::new(trace);
    let mut document = sheet(layout.width, layout.height)
        .add(heading(trace, title, &layout))
        .add(stripes(&layout))
        .add(axis::draw(&layout));
    for (index, (signal, row)) in trace.signals().iter().zip(&layout.rows).enumerate() {
        document = document.add(signal_row(trace, index, signal, row, &layout));
    }
    document = document.add(frame(&layout));
    writeln!(out, "{document}")
}

fn heading(trace: &Trace, title: &str, layout: &Layout) -> Group {
    let facts = format!(
        "{} scans of {}, {} in all",
        trace.scans(),
        format_time(trace.scan_ms()),
        format_time(trace.scans() * trace.scan_ms())
    );
    Group::new()
        .add(
            label(title, layout::MARGIN, 27.0, 16.0, colour::INK, Anchor::Start)
                .set("font-weight", "bold"),
        )
        .add(label(
            &facts,
            layout.width - layout::MARGIN,
            27.0,
            12.0,
            colour::FAINT_INK,
            Anchor::End,
        ))
}

/// Every second row is shaded, so that the eye finds from the wave to its name.
fn stripes(layout: &Layout) -> Group {
    layout.rows.iter().skip(1).step_by(2).fold(Group::new(), |group, row| {
        let stripe = Rectangle::new()
            .set("x", layout::MARGIN / 2.0)
            .set("y", row.top)
            .set("width", layout.width - layout::MARGIN)
            .set("height", row.height)
            .set("fill", colour::STRIPE);
        group.add(stripe)
    })
}

fn frame(layout: &Layout) -> Line {
    Line::new()
        .set("x1", layout.left)
        .set("x2", layout.left)
        .set("y1", layout.top)
        .set("y2", layout.bottom)
        .set("stroke", colour::AXIS)
}

fn signal_row(trace: &Trace, index: usize, signal: &Signal, row: &Row, layout: &Layout) -> Group {
    let middle = row.top + row.height / 2.0;
    let has_description = !signal.description.is_empty();
    let baseline = if has_description { middle - 3.0 } else { middle + 4.5 };
    let ink = colour::of(signal.operand);
    let name = text::shorten(&signal.name, layout.names_width, layout::NAME_SIZE);
    let mut group = Group::new().add(
        label(&name, layout::MARGIN, baseline, layout::NAME_SIZE, colour::INK, Anchor::Start)
            .set("font-weight", "bold"),
    );
    if has_description {
        let shown =
            text::shorten(&signal.description, layout.names_width, layout::DESCRIPTION_SIZE);
        group = group.add(label(
            &shown,
            layout::MARGIN,
            middle + 11.0,
            layout::DESCRIPTION_SIZE,
            colour::FAINT_INK,
            Anchor::Start,
        ));
        group = group.add(Title::new(format!("{}: {}", signal.name, signal.description)));
    }
    let changes = trace.changes(index);
    match signal.operand.width() {
        Width::Bit => group.add(wave::draw(changes, trace, row, layout, ink)),
        _ => group.add(curve::draw(signal.operand, changes, trace, row, layout)),
    }
}

#[cfg(test)]
mod tests;
