//! A drawing of diagrams as a picture, SVG.

use picture::svg::Svg;
use picture::{Point, Rect};

use crate::drawing::shapes::{ElementShape, GroupShape, LinkShape, Pin};
use crate::drawing::{Drawing, Sheet};

const STYLE: &str = "\
.feedback { stroke-dasharray: 6 4; }
.group { stroke-dasharray: 2 4; }
.given { fill: var(--soft); }
.left { fill: var(--soft); text-anchor: end; }
.output { text-anchor: end; }
.assigned { text-anchor: middle; fill: var(--soft); }
.order { font-size: 10px; text-anchor: end; }
";

/// From the edge of a box to a text in it.
const INSET: i32 = 8;

/// The picture of a drawing.
pub fn write(drawing: &Drawing) -> String {
    let names: Vec<&str> = drawing.sheets.iter().map(|sheet| sheet.name.as_str()).collect();
    let mut svg = Svg::new(drawing.width, drawing.height, &names.join(", "), STYLE);
    drawing.sheets.iter().for_each(|one| sheet(&mut svg, one));
    svg.end()
}

fn sheet(svg: &mut Svg, sheet: &Sheet) {
    svg.line("<g>");
    svg.text("title", sheet.title, &sheet.name);
    sheet.groups.iter().for_each(|one| group(svg, one));
    sheet.links.iter().for_each(|one| link(svg, one));
    sheet.junctions.iter().for_each(|at| svg.path("arrow", &around(Rect::around(*at, 6, 6))));
    sheet.elements.iter().for_each(|one| element(svg, one));
    svg.line("</g>");
}

fn group(svg: &mut Svg, group: &GroupShape) {
    let Rect { x, y, width, .. } = group.frame;
    svg.path("group", &around(group.frame));
    svg.text("note left", Point::new(x + width - INSET, y + 12), &group.name);
}

fn link(svg: &mut Svg, link: &LinkShape) {
    svg.path(if link.is_feedback { "feedback" } else { "link" }, &link.points);
    if let Some(Point { x, y }) = link.points.last() {
        let corners = [(*x, *y), (x - 8, y - 4), (x - 8, y + 4)];
        svg.path("arrow", &corners.map(|(x, y)| Point::new(x, y)));
    }
}

fn around(Rect { x, y, width, height }: Rect) -> [Point; 5] {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)];
    corners.map(|(x, y)| Point::new(x, y))
}

fn element(svg: &mut Svg, element: &ElementShape) {
    let frame = element.frame;
    let (left, right) = (frame.x, frame.right());
    let middle = left + frame.width / 2;
    svg.rect(frame);
    svg.text("order", Point::new(right - 2, frame.y - 7), &element.order.to_string());
    let Some(block) = &element.block else {
        let text = element.inputs.first().map(|pin| pin.text.as_str()).unwrap_or_default();
        let name = frame.y + if text.is_empty() { frame.height / 2 } else { 13 };
        svg.text("name", Point::new(middle, name), &element.name);
        svg.text("assigned", Point::new(middle, frame.bottom() - 11), text);
        return;
    };
    svg.text("name", Point::new(middle, frame.y + 13), &element.name);
    svg.text("note", Point::new(middle, frame.y + 29), block);
    for pin in &element.inputs {
        svg.text("input", Point::new(left + INSET, pin.at.y), &pin.name);
        beside(svg, pin, Point::new(left, pin.at.y), -1);
    }
    for pin in &element.outputs {
        svg.text("output", Point::new(right - INSET, pin.at.y), &pin.name);
        beside(svg, pin, Point::new(right, pin.at.y), 1);
    }
}

/// The text of a pin beside its box, with a line to it.
fn beside(svg: &mut Svg, pin: &Pin, edge: Point, outward: i32) {
    if pin.text.is_empty() {
        return;
    }
    svg.path("link", &[edge, Point::new(edge.x + outward * INSET, edge.y)]);
    let class = if outward < 0 { "left" } else { "given" };
    svg.text(class, Point::new(edge.x + outward * (INSET + 4), edge.y), &pin.text);
}
