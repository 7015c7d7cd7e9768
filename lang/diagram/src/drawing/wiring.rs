//! The lines of the links between boxes that have places. Each leaves its output to the right and
//! enters its input from the left; between them it goes around what is in its way. The search knows
//! lines that go down, so the plane is turned for it.

use picture::obstacles::{Lines, Terrain, Walls};
use picture::search::{search, simplified};
use picture::{Point, Rect};

use super::shapes::{ElementShape, End, LinkShape};

/// From a pin to where a line may bend.
const STUB: i32 = 10;

/// Gives links their lines. Those of one output may lie upon each other.
pub(super) fn wire(elements: &[ElementShape], links: Vec<LinkShape>) -> Vec<LinkShape> {
    let (mut boxes, mut texts) = (Walls::default(), Walls::default());
    for element in elements {
        boxes.add(turned_room(element.frame));
        element.texts().for_each(|room| texts.add(turned_room(room)));
    }
    let mut lines: Lines<End> = Lines::default();
    let mut numbered: Vec<(usize, LinkShape)> = links.into_iter().enumerate().collect();
    // Short ones first: they go straight.
    numbered.sort_by_key(|(number, link)| {
        let length = ends(elements, link).map(|[from, to]| {
            u32::from(to.x < from.x) * 1_000_000 + from.x.abs_diff(to.x) + from.y.abs_diff(to.y)
        });
        (length.unwrap_or(0), *number)
    });
    for (_, link) in &mut numbered {
        let Some([from, to]) = ends(elements, link) else { continue };
        link.points = line(from, to, link.from, [&boxes, &texts], &lines);
        for pair in link.points.windows(2) {
            if let [a, b] = pair {
                lines.add((link.from, turned(*a), turned(*b)));
            }
        }
    }
    numbered.sort_by_key(|(number, _)| *number);
    numbered.into_iter().map(|(_, link)| link).collect()
}

fn line(from: Point, to: Point, family: End, walls: [&Walls; 2], lines: &Lines<End>) -> Vec<Point> {
    let begin = Point::new(from.x + STUB, from.y);
    let end = Point::new(to.x - STUB, to.y);
    let way = |walls: &[&Walls]| {
        let terrain = Terrain { family, walls, own_walls: &[], lines, own_lines: &[] };
        search(&terrain, turned(begin), turned(end))
    };
    // Through texts rather than through boxes; where boxes lie upon a pin, straight.
    let found = way(&walls).or_else(|| way(&walls[..1])).map(|(points, _)| points);
    let middle = (begin.x + end.x) / 2;
    let straight = || {
        let bends = [begin, Point::new(middle, begin.y), Point::new(middle, end.y), end];
        bends.map(turned).to_vec()
    };
    let points = found.unwrap_or_else(straight).into_iter().map(turned);
    simplified(std::iter::once(from).chain(points).chain([to]).collect())
}

/// The two pins of a link.
fn ends(elements: &[ElementShape], link: &LinkShape) -> Option<[Point; 2]> {
    let from = elements.get(link.from.element)?.outputs.get(link.from.pin)?;
    let to = elements.get(link.to.element)?.inputs.get(link.to.pin)?;
    Some([from.at, to.at])
}

/// With across and down exchanged.
fn turned(at: Point) -> Point {
    Point::new(at.y, at.x)
}

fn turned_room(room: Rect) -> Rect {
    let Rect { x, y, width, height } = room;
    Rect { x: y, y: x, width: height, height: width }
}
