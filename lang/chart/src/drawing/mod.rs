//! Charts as drawings: steps with their actions, transitions with their bars, and lines between
//! them, as plain data. Drawn for reading; nothing is known here of colours, fonts and files.
//!
//! `places` and `layout` say where steps are: where the text says, or automatically. [`standard`]
//! has the rules by which lines are drawn, `wiring` leads them around what is in the way.

mod boxes;
mod layout;
pub mod measures;
mod order;
mod places;
mod room;
pub mod shapes;
mod sites;
pub mod standard;
mod wiring;

use std::collections::BTreeMap;
use std::fmt;

use diagnostics::Source;

use crate::model::{Chart, Origin, Position, Step, StepKind, Transition, TransitionId};
use boxes::{block, label, label_room, label_start, note};
use measures::{BLOCK_GAP, Measures, TITLE_HEIGHT, short, text_width};
use shapes::{ActionShape, Look, StepShape, TransitionShape};
use standard::Route;

pub use crate::model::StepId;
pub use measures::DOUBLE;
pub use picture::{PLACE_MAX, Point, Rect};
pub use shapes::{Drawing, Sheet};

/// Most steps, and most transitions, of a chart that is drawn.
pub const ELEMENTS_MAX: usize = 2_500;
/// Half the width of an arrow.
const ARROW: i32 = 5;

/// A chart with more elements than can be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TooLarge {
    /// The chart.
    pub chart: String,
    /// How many steps or transitions it has.
    pub count: usize,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { chart, count } = self;
        write!(f, "{chart}: {count} steps or transitions; up to {ELEMENTS_MAX} of each are drawn")
    }
}

/// Draws the charts of a text; those in actions, too.
pub fn draw<'c>(
    charts: impl IntoIterator<Item = &'c Chart>,
    source: &Source,
) -> Result<Drawing, TooLarge> {
    let charts = charts.into_iter().flat_map(Chart::named_with_inner);
    let sheets = charts.map(|(name, chart)| {
        let count = chart.steps.len().max(chart.transitions.len());
        if count > ELEMENTS_MAX {
            return Err(TooLarge { chart: name, count });
        }
        Ok(sheet(chart, &name, source))
    });
    Ok(packed(sheets.collect::<Result<_, _>>()?))
}

/// Where the steps of a chart are drawn, as places in its text would say it.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// The middles of steps.
    pub steps: BTreeMap<StepId, Position>,
    /// The middles of bars that have a place in the text and are drawn there.
    pub bars: BTreeMap<TransitionId, Position>,
    /// Whether they follow from places in the text.
    pub is_given: bool,
}

/// Where the steps of a chart are drawn.
pub fn places(chart: &Chart) -> Places {
    let (placement, is_given) = placement(chart, &room::room(chart));
    let position = |at: Point| Position { x: at.x, y: at.y };
    let bars = placement.bars.into_iter().filter(|_| is_given);
    Places {
        steps: placement.steps.into_iter().map(|(id, at)| (id, position(at))).collect(),
        bars: bars.map(|(id, at)| (id, position(at))).collect(),
        is_given,
    }
}

/// Places by the text, or automatic ones; and whether they are by the text.
fn placement(chart: &Chart, room: &room::Room) -> (layout::Placement, bool) {
    match places::given(chart, room) {
        Some(placement) => (placement, true),
        None => (layout::automatic(chart, room), false),
    }
}

/// One chart, from its upper left corner on.
fn sheet(chart: &Chart, name: &str, source: &Source) -> Sheet {
    let room = room::room(chart);
    let m = room.measures;
    let (placement, is_placed) = placement(chart, &room);
    let line = |origin: Origin| source.position(origin.0.start as usize).0;
    let steps = chart.steps.iter().filter_map(|(id, step)| {
        let mut shape = step_shape(chart, step, *placement.steps.get(id)?, &m);
        shape.id = *id;
        shape.variable = format!("{name}.{}", step.name);
        shape.line = line(step.origin);
        let lines = step.block.iter().map(|one| one.origin);
        let lines = lines.chain(step.forcings.iter().map(|one| one.origin));
        for (action, origin) in shape.actions.iter_mut().zip(lines) {
            action.line = line(origin);
        }
        Some(shape)
    });
    let steps: Vec<StepShape> = steps.collect();
    let walls = steps.iter().flat_map(|step| [Some(step.frame), block_room(step)]).flatten();
    let routes = wiring::wire(chart, &room, &placement, walls.collect());
    let transitions = routes.into_iter().filter_map(|(id, route)| {
        let transition = chart.transitions.get(&id)?;
        let mut shape = transition_shape(transition, route);
        shape.id = id;
        shape.line = line(transition.origin);
        shape.title = chart.transition_title(transition);
        Some(shape)
    });
    let transitions = transitions.collect();
    framed(Sheet { name: name.to_owned(), is_placed, steps, transitions, ..Sheet::default() })
}

/// The block of a step with the line to it.
fn block_room(step: &StepShape) -> Option<Rect> {
    let all = step.actions.iter().map(|action| action.frame).reduce(Rect::union)?;
    Some(Rect { x: all.x - BLOCK_GAP, width: all.width + BLOCK_GAP, ..all })
}

fn step_shape(chart: &Chart, step: &Step, centre: Point, m: &Measures) -> StepShape {
    let frame = Rect::around(centre, m.step_width, m.step_height);
    let look = match step.kind {
        StepKind::Plain => Look::Plain,
        StepKind::Macro(_) => Look::Macro,
        StepKind::Enclosing(_) => Look::Enclosing,
    };
    StepShape {
        name: short(&step.name),
        note: note(step),
        frame,
        is_initial: step.is_initial,
        is_linked: step.is_linked,
        look,
        actions: block(chart, step, frame),
        ..StepShape::default()
    }
}

fn transition_shape(transition: &Transition, route: Route) -> TransitionShape {
    let text = label(transition);
    let sides = route.before.into_iter().chain(route.after).map(|(_, points)| points);
    let between = Some(route.between).filter(|points| !points.is_empty());
    let lines: Vec<Vec<Point>> = sides.chain(between).map(picture::search::simplified).collect();
    TransitionShape {
        from: transition.from.iter().copied().collect(),
        to: transition.to.iter().copied().collect(),
        bar: route.bar,
        label: label_start(&text, route.bar),
        arrows: lines.iter().filter_map(|points| arrow(points)).collect(),
        text,
        lines,
        doubles: route.doubles,
        ..TransitionShape::default()
    }
}

/// Where a line that leads up has an arrow: above the middle of the longest way up.
fn arrow(points: &[Point]) -> Option<Point> {
    let ways = points.windows(2).filter_map(|pair| match pair {
        [a, b] if a.x == b.x && a.y - b.y > 4 * ARROW => Some((a.y - b.y, *a, *b)),
        _ => None,
    });
    let (_, a, b) = ways.max_by_key(|(length, ..)| *length)?;
    Some(Point::new(a.x, (a.y + b.y) / 2 - ARROW))
}

/// What a sheet takes, without its title.
fn taken(sheet: &Sheet) -> Rect {
    let steps = sheet.steps.iter().flat_map(|step| {
        let linked = step.is_linked.then(|| step.frame.grown(measures::CHARACTER * 2));
        [Some(step.frame), linked, block_room(step)]
    });
    let transitions = sheet.transitions.iter().flat_map(|one| {
        let lines = one.lines.iter().flatten().chain(&one.arrows);
        let doubles = one.doubles.iter().flat_map(|(a, b)| [a, b]);
        let points = lines.chain(doubles).map(|at| Rect::around(*at, 2 * ARROW, 2 * ARROW));
        points.chain([Rect::between(one.bar.0, one.bar.1), label_room(&one.text, one.bar)])
    });
    steps.flatten().chain(transitions).reduce(Rect::union).unwrap_or_default()
}

/// A sheet whose frame begins in the corner, with its title above everything.
fn framed(mut sheet: Sheet) -> Sheet {
    let taken = taken(&sheet);
    let by = Point::new(-taken.x, TITLE_HEIGHT - taken.y);
    sheet.move_by(by);
    sheet.title = Point::new(0, TITLE_HEIGHT / 2 - 4);
    let width = taken.width.max(text_width(&sheet.name));
    sheet.frame = Rect { x: 0, y: 0, width, height: taken.height + TITLE_HEIGHT };
    sheet
}

/// The sheets in rows.
fn packed(mut sheets: Vec<Sheet>) -> Drawing {
    let (corners, size) = picture::packed(sheets.iter().map(|sheet| sheet.frame));
    sheets.iter_mut().zip(corners).for_each(|(sheet, corner)| sheet.move_by(corner));
    Drawing { width: size.x, height: size.y, sheets }
}

impl Drawing {
    /// The drawing without the charts that are hidden. They keep their places in the list of
    /// sheets, but have nothing on them.
    pub fn without(mut self, is_hidden: impl Fn(&Sheet) -> bool) -> Drawing {
        if !self.sheets.iter().any(&is_hidden) {
            return self;
        }
        for sheet in &mut self.sheets {
            sheet.move_by(Point::new(-sheet.frame.x, -sheet.frame.y));
        }
        let (hidden, shown) = self
            .sheets
            .into_iter()
            .enumerate()
            .partition::<Vec<_>, _>(|(_, sheet)| is_hidden(sheet));
        let (numbers, shown): (Vec<usize>, Vec<Sheet>) = shown.into_iter().unzip();
        let Drawing { width, height, sheets } = packed(shown);
        let empty = |(number, sheet): (usize, Sheet)| {
            (number, Sheet { name: sheet.name, is_placed: sheet.is_placed, ..Sheet::default() })
        };
        let mut all: Vec<(usize, Sheet)> = hidden.into_iter().map(empty).collect();
        all.extend(numbers.into_iter().zip(sheets));
        all.sort_by_key(|(number, _)| *number);
        Drawing { width, height, sheets: all.into_iter().map(|(_, sheet)| sheet).collect() }
    }
}

impl Sheet {
    fn move_by(&mut self, by: Point) {
        self.title = self.title.moved(by);
        self.origin = self.origin.moved(by);
        self.frame = self.frame.moved(by);
        self.steps.iter_mut().for_each(|step| step.move_by(by));
        self.transitions.iter_mut().for_each(|one| one.move_by(by));
    }
}

impl StepShape {
    fn move_by(&mut self, by: Point) {
        self.frame = self.frame.moved(by);
        for ActionShape { frame, divider, .. } in &mut self.actions {
            *frame = frame.moved(by);
            *divider = divider.map(|x| x + by.x);
        }
    }
}

impl TransitionShape {
    fn move_by(&mut self, by: Point) {
        let doubles = self.doubles.iter_mut().flat_map(|(a, b)| [a, b]);
        let points = self.lines.iter_mut().flatten().chain(&mut self.arrows).chain(doubles);
        let own = [&mut self.bar.0, &mut self.bar.1, &mut self.label];
        points.chain(own).for_each(|point| *point = point.moved(by));
    }
}
