//! The lines of the transitions of a chart whose steps have places. Each is drawn by the rules
//! ([`super::standard`]) if nothing is in the way of its lines, its bar and its text; otherwise its
//! bar gets another place, and its lines go around.

use std::collections::{BTreeMap, BTreeSet};

use super::boxes::{label, label_room};
use super::layout::Placement;
use super::measures::{BAR, CLEARANCE, DOUBLE};
use super::room::Room;
use super::sites::{Sites, edges};
use super::standard::{Place, Route, converging, diverging, forking, joining, meeting, simple};
use crate::drawn::Drawn;
use crate::model::{Chart, StepId, Transition, TransitionId};
use picture::obstacles::{self, Lines, Terrain, Walls, rect};
use picture::search::{search, simplified};
use picture::{Point, Rect};

/// From a step to the first bend of a line that shares its way with no other one.
const SHORT_STUB: i32 = 6;
/// From the middle of a bar to a double line.
const TO_DOUBLE: i32 = 10;
/// From the middle of a bar to where lines may bend.
const TO_BEND: i32 = 4;
/// So many places, apart from each other, are tried for a bar that has none by the rules.
const SITES_MAX: usize = 4;
/// What it costs to go through the text of another transition.
const THROUGH_TEXT: u32 = 20_000;

/// Which lines may lie upon each other: they mean the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    From(StepId),
    To(StepId),
    Of(TransitionId),
}

type Segment = obstacles::Segment<Family>;

/// How a transition is drawn, by the rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Simple,
    Simultaneous,
    Divergence,
    Convergence,
}

struct Wiring<'c> {
    chart: &'c Chart,
    room: &'c Room,
    placement: &'c Placement,
    /// Steps and their blocks.
    walls: Walls,
    /// Bars with their texts.
    bars: Walls,
    lines: Lines<Family>,
    /// Where the middle of a bar passes by walls and bars.
    edges: BTreeSet<i32>,
}

/// Draws all transitions that have steps before and after them.
pub(super) fn wire(
    chart: &Chart,
    room: &Room,
    placement: &Placement,
    walls: Vec<Rect>,
) -> BTreeMap<TransitionId, Route> {
    let mut wiring = Wiring::new(chart, room, placement);
    walls.into_iter().for_each(|wall| wiring.wall(wall));
    let mut routes = BTreeMap::new();
    for (_, _, kind, id) in wiring.order() {
        if let Some(route) = wiring.route(kind, id) {
            wiring.keep(id, &route);
            routes.insert(id, route);
        }
    }
    routes
}

fn segments(route: &Route, id: TransitionId) -> impl Iterator<Item = Segment> {
    let of = |family: Family, points: &[Point]| -> Vec<Segment> {
        let pairs = points.windows(2).filter_map(|pair| match pair {
            [a, b] if a != b => Some((family, *a, *b)),
            _ => None,
        });
        pairs.collect()
    };
    let is_alone = route.before.len() == 1;
    let before =
        route.before.iter().flat_map(move |(step, points)| of(Family::From(*step), points));
    let after = route.after.iter().flat_map(move |(step, points)| {
        let is_alone = is_alone && route.after.len() == 1;
        of(if is_alone { Family::To(*step) } else { Family::Of(id) }, points)
    });
    let between = of(Family::Of(id), &route.between);
    let doubles = route.doubles.iter().map(move |(a, b)| (Family::Of(id), *a, *b));
    before.chain(after).chain(between).chain(doubles)
}

impl<'c> Wiring<'c> {
    fn new(chart: &'c Chart, room: &'c Room, placement: &'c Placement) -> Wiring<'c> {
        let (walls, bars) = (Walls::default(), Walls::default());
        let (lines, edges) = (Lines::default(), BTreeSet::new());
        Wiring { chart, room, placement, walls, bars, lines, edges }
    }

    fn wall(&mut self, wall: Rect) {
        self.edges.extend(edges(wall));
        self.walls.add(wall);
    }

    fn bar(&mut self, room: Rect) {
        self.edges.extend(edges(room));
        self.bars.add(room);
    }

    /// The transitions, those first whose way is clear by the rules; of others the shortest.
    fn order(&self) -> Vec<(u8, u32, Kind, TransitionId)> {
        let drawn = Drawn::of(self.chart);
        let of = |kind: Kind, ids: &[TransitionId]| -> Vec<(Kind, TransitionId)> {
            ids.iter().map(|id| (kind, *id)).collect()
        };
        let mut all = of(Kind::Simple, &drawn.simple);
        all.extend(of(Kind::Simultaneous, &drawn.simultaneous));
        drawn.divergences.values().for_each(|ids| all.extend(of(Kind::Divergence, ids)));
        drawn.convergences.values().for_each(|ids| all.extend(of(Kind::Convergence, ids)));
        let rank = |kind: Kind, id: TransitionId| {
            let ends = self.chart.transitions.get(&id).map(|one| self.ends(one));
            let ends = ends.unwrap_or_default();
            let at = |side: &[Place]| side.first().map_or(Point::default(), |(_, at)| *at);
            let (from, to) = (at(&ends.0), at(&ends.1));
            let length = from.y.abs_diff(to.y);
            match kind {
                _ if self.placement.bars.contains_key(&id) => (4, length),
                Kind::Simple if from.x == to.x && from.y < to.y => (0, 0),
                Kind::Simultaneous => (1, 0),
                Kind::Divergence | Kind::Convergence if from.y < to.y => (2, 0),
                _ => (3, length),
            }
        };
        let ranked = all.into_iter().map(|(kind, id)| {
            let (rank, length) = rank(kind, id);
            (rank, length, kind, id)
        });
        let mut all: Vec<_> = ranked.collect();
        all.sort_unstable();
        all
    }

    /// The steps before and after, from left to right.
    fn ends(&self, transition: &Transition) -> (Vec<Place>, Vec<Place>) {
        let side = |steps: &std::collections::BTreeSet<StepId>| {
            let places = steps.iter().filter_map(|id| Some((*id, *self.placement.steps.get(id)?)));
            let mut places: Vec<Place> = places.collect();
            places.sort_by_key(|(id, at)| (at.x, *id));
            places
        };
        (side(&transition.from), side(&transition.to))
    }

    fn keep(&mut self, id: TransitionId, route: &Route) {
        segments(route, id).for_each(|line| self.lines.add(line));
        route.doubles.iter().for_each(|(a, b)| self.lines.add_double(*a, *b));
        self.bar(Rect::between(route.bar.0, route.bar.1).grown(1));
        self.bar(self.label(id, route.bar));
    }

    fn label(&self, id: TransitionId, bar: (Point, Point)) -> Rect {
        let text = self.chart.transitions.get(&id).map(label).unwrap_or_default();
        label_room(&text, bar)
    }

    fn route(&self, kind: Kind, id: TransitionId) -> Option<Route> {
        let transition = self.chart.transitions.get(&id)?;
        let (from, to) = self.ends(transition);
        let m = |steps: &[Place]| self.room.at(steps.iter().map(|(id, _)| *id));
        let by_rule = match (kind, &from[..], &to[..]) {
            (_, [], _) | (_, _, []) => return None,
            (Kind::Divergence, [a], [p]) => diverging(&m(&from), *a, *p),
            (Kind::Convergence, [a], [p]) => converging(&m(&to), *a, *p),
            (_, [a], [p]) => simple(&m(&[*a, *p]), *a, *p),
            (_, [a], _) => forking(&m(&from), *a, &to),
            (_, _, [p]) => joining(&m(&to), &from, *p),
            _ => meeting(&self.room.measures, &from, &to),
        };
        // The bar of a fork is on the line from its step: no other one may leave there.
        let is_shared =
            kind == Kind::Simultaneous && from.len() == 1 && self.room.is_shared(from[0].0);
        let place = self.placement.bars.get(&id);
        if place.is_none() && !is_shared && self.fits(id, &by_rule) {
            return Some(by_rule);
        }
        let ends = Ends { id, from: &from, to: &to };
        let placed = place.and_then(|at| self.at(&ends, *at));
        let placed = placed.or_else(|| self.beside_a_step(&ends)).or_else(|| self.anywhere(&ends));
        Some(placed.map_or(by_rule, |(route, _)| route))
    }

    /// Whether nothing is in the way of a transition.
    fn fits(&self, id: TransitionId, route: &Route) -> bool {
        let (bar, label) = (Rect::between(route.bar.0, route.bar.1), self.label(id, route.bar));
        let all: Vec<Segment> = segments(route, id).collect();
        let own = all.iter().any(|one| label.meets(rect(one)));
        !own && self.is_free(bar) && self.is_free(label) && all.iter().all(|one| self.is_clear(one))
    }

    /// Whether there is nothing at all.
    fn is_free(&self, room: Rect) -> bool {
        let mut all = self.walls.near(room).chain(self.bars.near(room));
        !all.any(|one| one.meets(room)) && !self.lines.near(room).any(|one| room.meets(rect(one)))
    }

    /// Whether a line goes through nothing and lies upon no other one that means something else.
    fn is_clear(&self, line: &Segment) -> bool {
        let mut inner = rect(line);
        if inner.width == 0 && inner.height > 2 * CLEARANCE / 2 {
            // Lines touch their own steps.
            inner = Rect { y: inner.y + CLEARANCE / 2, height: inner.height - CLEARANCE, ..inner };
        }
        let around = rect(line).grown(CLEARANCE);
        let is_wall = self.walls.near(around).any(|one| one.grown(CLEARANCE / 2 - 1).meets(inner));
        let is_bar = self.bars.near(around).any(|bar| bar.meets(rect(line)));
        let is_upon = |other: &Segment| {
            let (a, b) = (rect(line), rect(other));
            let is_near = |a: i32, b: i32| (a - b).abs() < CLEARANCE / 2;
            let shares = |a: i32, a_end: i32, b: i32, b_end: i32| a < b_end && b < a_end;
            other.0 != line.0
                && (a.width == 0
                    && b.width == 0
                    && is_near(a.x, b.x)
                    && shares(a.y, a.bottom(), b.y, b.bottom())
                    || a.height == 0
                        && b.height == 0
                        && is_near(a.y, b.y)
                        && shares(a.x, a.right(), b.x, b.right()))
        };
        !is_wall && !is_bar && !self.lines.near(around).any(is_upon)
    }

    fn bottom(&self, step: Point) -> i32 {
        self.room.measures.bottom(step)
    }

    fn top(&self, step: Point) -> i32 {
        self.room.measures.top(step)
    }

    /// With its bar below the only step before it, or above the only one after it.
    fn beside_a_step(&self, ends: &Ends) -> Option<(Route, u32)> {
        let below = match ends.from {
            [(id, at)] if !self.room.is_shared(*id) => {
                self.at(ends, Point::new(at.x, self.bottom(*at) + self.room.stub(*id) / 2))
            }
            _ => None,
        };
        below.or_else(|| match ends.to {
            [(id, at)] => self.at(ends, Point::new(at.x, self.top(*at) - self.room.stub(*id) / 2)),
            _ => None,
        })
    }

    /// With its bar where it is cheapest of some places; at last outside of everything.
    fn anywhere(&self, ends: &Ends) -> Option<(Route, u32)> {
        let stub = 2 * self.room.measures.stub;
        let below = ends.from.iter().map(|(_, at)| self.bottom(*at) + stub);
        let ys: Vec<i32> =
            below.chain(ends.to.iter().map(|(_, at)| self.top(*at) - stub)).collect();
        let everything = [self.walls.bounds(), self.bars.bounds(), self.lines.bounds()];
        let everything = everything.into_iter().flatten().reduce(Rect::union).unwrap_or_default();
        let (right, bottom) = (everything.right() + stub, everything.bottom() + stub);
        let steps = ends.from.iter().chain(ends.to).map(|(_, at)| *at).collect();
        let sites = Sites::new(steps, &self.edges, right, &ys);
        let free = sites.filter(|site| self.has_room(ends, *site));
        let mut last: Vec<Point> = Vec::new();
        let apart = free.filter(|site| {
            let is_apart = |other: &Point| {
                other.y != site.y || other.x.abs_diff(site.x) >= 2 * CLEARANCE as u32
            };
            let is_new = last.iter().all(is_apart);
            last.extend(is_new.then_some(*site));
            is_new
        });
        let tried = apart.take(SITES_MAX).filter_map(|site| self.at(ends, site));
        let best = tried.min_by_key(|(_, cost)| *cost);
        best.or_else(|| self.at(ends, Point::new(right, bottom)))
    }

    fn has_room(&self, ends: &Ends, centre: Point) -> bool {
        let core = ends.core(centre);
        self.is_free(core.grown(CLEARANCE / 2))
            && self.is_free(self.label(ends.id, ends.bar(centre)))
    }

    /// With its bar there, and lines around what is in the way; with what they cost.
    fn at(&self, ends: &Ends, centre: Point) -> Option<(Route, u32)> {
        if !self.has_room(ends, centre) {
            return None;
        }
        let bar = ends.bar(centre);
        let core = ends.core(centre);
        let mut own: Vec<Segment> = Vec::new();
        let alone = [core, self.label(ends.id, bar)];
        let mut costs = 0;
        let mut line = |family: Family, from: Point, to: Point| {
            let terrain = |walls: &[&Walls], own_walls: &[Rect]| {
                let own_lines = &own[..];
                let terrain = Terrain { family, walls, own_walls, lines: &self.lines, own_lines };
                search(&terrain, from, to)
            };
            let around = terrain(&[&self.walls, &self.bars], &alone);
            let (points, cost) = around.or_else(|| {
                let through = terrain(&[&self.walls], &alone[..1]);
                through.map(|(points, cost)| (points, cost + THROUGH_TEXT))
            })?;
            costs += cost;
            let pairs = points.windows(2).filter_map(|pair| Some((family, pair[0], *pair.last()?)));
            own.extend(pairs);
            Some(points)
        };
        let mut route = Route { bar, ..Route::default() };
        for (index, (id, step)) in ends.from.iter().enumerate() {
            let bottom = Point::new(step.x, self.bottom(*step));
            let stub = if self.room.is_shared(*id) { self.room.stub(*id) } else { SHORT_STUB };
            let slot = Point::new(ends.slot(index, ends.from.len(), centre), core.y);
            let begin = Point::new(bottom.x, bottom.y + stub);
            let end = Point::new(slot.x, slot.y - SHORT_STUB);
            let way = line(Family::From(*id), begin, end)?;
            let all = std::iter::once(bottom).chain(way).chain([slot]);
            route.before.push((*id, simplified(all.collect())));
        }
        let is_alone = ends.from.len() == 1 && ends.to.len() == 1;
        for (index, (id, step)) in ends.to.iter().enumerate() {
            let top = Point::new(step.x, self.top(*step));
            let slot = Point::new(ends.slot(index, ends.to.len(), centre), core.bottom());
            let begin = Point::new(slot.x, slot.y + SHORT_STUB);
            let family = if is_alone { Family::To(*id) } else { Family::Of(ends.id) };
            let way = line(family, begin, Point::new(top.x, top.y - SHORT_STUB))?;
            let all = std::iter::once(slot).chain(way).chain([top]);
            route.after.push((*id, simplified(all.collect())));
        }
        ends.finish(&mut route, centre, core);
        Some((route, costs))
    }
}

/// A transition with its steps, from left to right.
struct Ends<'e> {
    id: TransitionId,
    from: &'e [Place],
    to: &'e [Place],
}

impl Ends<'_> {
    fn bar(&self, centre: Point) -> (Point, Point) {
        let half = self.core(centre).width / 2;
        (Point::new(centre.x - half, centre.y), Point::new(centre.x + half, centre.y))
    }

    /// Bar and double lines together: lines end and begin at its edges.
    fn core(&self, centre: Point) -> Rect {
        let side = |steps: &[Place]| if steps.len() > 1 { TO_DOUBLE + DOUBLE } else { TO_BEND };
        let (above, below) = (side(self.from), side(self.to));
        let slots = self.from.len().max(self.to.len()) as i32;
        let width = BAR.max(slots * 2 * CLEARANCE);
        Rect { x: centre.x - width / 2, y: centre.y - above, width, height: above + below }
    }

    /// Where the line of one of several steps meets the double line.
    fn slot(&self, index: usize, count: usize, centre: Point) -> i32 {
        centre.x + (2 * index as i32 - (count as i32 - 1)) * CLEARANCE
    }

    /// Draws what is in the core.
    fn finish(&self, route: &mut Route, centre: Point, core: Rect) {
        let double = |count: usize, y: i32| {
            let half = count as i32 * CLEARANCE;
            (Point::new(centre.x - half, y), Point::new(centre.x + half, y))
        };
        let mut start = core.y;
        let mut end = core.bottom();
        if self.from.len() > 1 {
            route.doubles.push(double(self.from.len(), core.y));
            start += DOUBLE;
        }
        if self.to.len() > 1 {
            end -= DOUBLE;
            route.doubles.push(double(self.to.len(), end));
        }
        route.between = vec![Point::new(centre.x, start), Point::new(centre.x, end)];
    }
}
