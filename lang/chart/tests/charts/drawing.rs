//! Drawings of charts: the rules by which transitions are drawn, and what holds for every drawing
//! of random charts, placed automatically and by their texts.

use chart::drawing::measures::Measures;
use chart::drawing::shapes::{StepShape, TransitionShape};
use chart::drawing::standard::{
    Place, Route, converging, diverging, forking, joining, meeting, simple,
};
use chart::drawing::{DOUBLE, Drawing, ELEMENTS_MAX, Point, Rect, Sheet, draw};
use chart::model::StepId;
use diagnostics::Source;
use fastrand::Rng;

use crate::{random_grafcet, random_text};

/// Four times the sizes of the lists below: LP = 4, AP = 2, LC = 1, LR = SP = 1, SS = 1.
const M: Measures =
    Measures { step_width: 16, step_height: 8, bar: 4, stub: 4, clearance: 4, double: 4 };

/// A step in the coordinates of the lists: y grows upward.
fn at(id: u32, x: i32, y: i32) -> Place {
    (StepId(id), Point::new(4 * x, -4 * y))
}

type Line = (i32, i32, i32, i32);

fn line(a: Point, b: Point) -> Line {
    let (a, b) = if (a.x, -a.y) <= (b.x, -b.y) { (a, b) } else { (b, a) };
    (a.x, -a.y, b.x, -b.y)
}

/// The stretches of routes, those in one line as one; in a quarter of the unit of the lists.
fn lines(routes: &[Route]) -> Vec<Line> {
    let mut all = Vec::new();
    for route in routes {
        let sides = route.before.iter().chain(&route.after).map(|(_, points)| points);
        for points in sides.chain([&route.between]) {
            all.extend(points.windows(2).map(|pair| line(pair[0], pair[1])));
        }
        all.push(line(route.bar.0, route.bar.1));
        for (a, b) in &route.doubles {
            all.push(line(*a, *b));
            let below = |point: &Point| Point::new(point.x, point.y + M.double);
            all.push(line(below(a), below(b)));
        }
    }
    merged(all)
}

/// Joins lines that meet in one line.
fn merged(mut all: Vec<Line>) -> Vec<Line> {
    all.retain(|(x, y, x_end, y_end)| (x, y) != (x_end, y_end));
    'again: loop {
        all.sort_unstable();
        all.dedup();
        for first in 0..all.len() {
            for second in first + 1..all.len() {
                let (a, b) = (all[first], all[second]);
                let is_upright = a.0 == a.2 && b.0 == b.2 && a.0 == b.0;
                let is_level = a.1 == a.3 && b.1 == b.3 && a.1 == b.1;
                let meets = a.0 <= b.2 && b.0 <= a.2 && a.1 <= b.3 && b.1 <= a.3;
                if (is_upright || is_level) && meets {
                    let joined = (a.0.min(b.0), a.1.min(b.1), a.2.max(b.2), a.3.max(b.3));
                    all.remove(second);
                    all[first] = joined;
                    continue 'again;
                }
            }
        }
        return all;
    }
}

/// Lines in the units of a list.
fn wanted(list: &[(f32, f32, f32, f32)]) -> Vec<Line> {
    let four = |v: f32| (4.0 * v) as i32;
    let of = |one: &(f32, f32, f32, f32)| {
        line(Point::new(four(one.0), -four(one.1)), Point::new(four(one.2), -four(one.3)))
    };
    merged(list.iter().map(of).collect())
}

fn check(routes: &[Route], list: &[(f32, f32, f32, f32)]) {
    assert_eq!(lines(routes), wanted(list));
}

#[test]
fn a_simple_transition_straight_down_is_a_line_with_a_bar() {
    let route = simple(&M, at(1, 0, 8), at(2, 0, 0));
    check(&[route], &[(0.0, 7.0, 0.0, 1.0), (-0.5, 4.0, 0.5, 4.0)]);
}

#[test]
fn a_simple_transition_to_a_lower_column_has_an_upright_bar() {
    let route = simple(&M, at(1, 0, 8), at(2, 6, 0));
    check(
        &[route],
        &[(0.0, 7.0, 0.0, 4.0), (6.0, 1.0, 6.0, 4.0), (0.0, 4.0, 6.0, 4.0), (3.0, 4.5, 3.0, 3.5)],
    );
}

#[test]
fn a_simple_transition_upward_goes_around_its_step_or_between_both() {
    let same = simple(&M, at(1, 0, 0), at(2, 0, 8));
    check(
        &[same],
        &[
            (0.0, -1.0, 0.0, -2.0),
            (0.0, -2.0, 3.0, -2.0),
            (3.0, -2.0, 3.0, 10.0),
            (0.0, 10.0, 3.0, 10.0),
            (0.0, 9.0, 0.0, 10.0),
            (2.5, 4.0, 3.5, 4.0),
        ],
    );
    let left = simple(&M, at(1, 1, 0), at(2, 0, 8));
    assert_eq!(left.bar, (Point::new(-14, -16), Point::new(-10, -16)), "to the left of it");
    let between = simple(&M, at(1, 0, 0), at(2, 8, 8));
    check(
        &[between],
        &[
            (0.0, -1.0, 0.0, -2.0),
            (0.0, -2.0, 4.0, -2.0),
            (4.0, -2.0, 4.0, 10.0),
            (4.0, 10.0, 8.0, 10.0),
            (8.0, 10.0, 8.0, 9.0),
            (3.5, 4.0, 4.5, 4.0),
        ],
    );
}

#[test]
fn a_divergence_has_a_line_below_its_step_and_leads_past_those_beside() {
    let from = at(1, 0, 10);
    let routes = [at(2, -4, 0), at(3, 4, 0)].map(|to| diverging(&M, from, to));
    check(
        &routes,
        &[
            (0.0, 9.0, 0.0, 8.0),
            (-4.0, 8.0, 4.0, 8.0),
            (-4.0, 8.0, -4.0, 1.0),
            (4.0, 8.0, 4.0, 1.0),
            (-4.5, 4.5, -3.5, 4.5),
            (3.5, 4.5, 4.5, 4.5),
        ],
    );
    // Beside: the line passes on the side of the step before and comes in from above.
    check(
        &[diverging(&M, from, at(2, -10, 10))],
        &[
            (0.0, 9.0, 0.0, 8.0),
            (0.0, 8.0, -7.0, 8.0),
            (-7.0, 8.0, -7.0, 12.0),
            (-7.0, 12.0, -10.0, 12.0),
            (-10.0, 12.0, -10.0, 11.0),
            (-10.5, 11.5, -9.5, 11.5),
        ],
    );
}

#[test]
fn a_convergence_is_a_divergence_upside_down() {
    let to = at(1, 0, 0);
    let routes = [at(2, -4, 10), at(3, 4, 10)].map(|from| converging(&M, from, to));
    check(
        &routes,
        &[
            (0.0, 1.0, 0.0, 2.0),
            (-4.0, 2.0, 4.0, 2.0),
            (-4.0, 2.0, -4.0, 9.0),
            (4.0, 2.0, 4.0, 9.0),
            (-4.5, 5.5, -3.5, 5.5),
            (3.5, 5.5, 4.5, 5.5),
        ],
    );
}

#[test]
fn simultaneous_transitions_have_double_lines() {
    let forked = forking(&M, at(1, 0, 10), &[at(2, -4, 0), at(3, 4, 0)]);
    check(
        &[forked],
        &[
            (0.0, 9.0, 0.0, 8.0),
            (-0.5, 8.5, 0.5, 8.5),
            (-4.0, 8.0, 4.0, 8.0),
            (-4.0, 7.0, 4.0, 7.0),
            (-4.0, 7.0, -4.0, 1.0),
            (4.0, 7.0, 4.0, 1.0),
        ],
    );
    let joined = joining(&M, &[at(2, -4, 10), at(3, 4, 10)], at(1, 0, 0));
    check(
        &[joined],
        &[
            (0.0, 1.0, 0.0, 2.0),
            (-0.5, 1.5, 0.5, 1.5),
            (-4.0, 2.0, 4.0, 2.0),
            (-4.0, 3.0, 4.0, 3.0),
            (-4.0, 3.0, -4.0, 9.0),
            (4.0, 3.0, 4.0, 9.0),
        ],
    );
}

#[test]
fn a_rendezvous_has_two_double_lines_and_a_bar_between() {
    let (from, to) = ([at(1, -4, 10), at(2, 4, 10)], [at(3, -2, 0), at(4, 2, 0)]);
    check(
        &[meeting(&M, &from, &to)],
        &[
            (-4.0, 9.0, -4.0, 6.5),
            (4.0, 9.0, 4.0, 6.5),
            (-4.0, 6.5, 4.0, 6.5),
            (-4.0, 5.5, 4.0, 5.5),
            (0.0, 5.5, 0.0, 4.5),
            (-0.5, 5.0, 0.5, 5.0),
            (-2.0, 4.5, 2.0, 4.5),
            (-2.0, 3.5, 2.0, 3.5),
            (-2.0, 3.5, -2.0, 1.0),
            (2.0, 3.5, 2.0, 1.0),
        ],
    );
    // Side by side: what joins them has a bend and an upright bar.
    let aside = meeting(&M, &from, &[at(3, 10, 0), at(4, 16, 0)]);
    assert_eq!(aside.bar, (Point::new(26, -22), Point::new(26, -18)));
    assert_eq!(aside.between.len(), 4);
}

fn drawing(text: &str) -> Drawing {
    let source = Source::new("t.sfc", text).expect("a short text");
    let reading = chart::text::read(&source);
    assert!(reading.diagnostics.is_empty(), "{text}");
    draw(reading.document.charts(), &source).expect("a small chart")
}

fn step<'s>(sheet: &'s Sheet, id: &StepId) -> &'s StepShape {
    sheet.steps.iter().find(|step| step.id == *id).expect("a step")
}

/// What is wrong with a transition.
pub(super) fn wrong_line(sheet: &Sheet, one: &TransitionShape) -> Option<String> {
    let name = &one.title;
    let middle = |frame: Rect| frame.x + frame.width / 2;
    let bottoms = one.from.iter().map(|id| step(sheet, id).frame);
    let bottoms = bottoms.map(|frame| Point::new(middle(frame), frame.bottom()));
    let tops = one.to.iter().map(|id| step(sheet, id).frame);
    let tops = tops.map(|frame| Point::new(middle(frame), frame.y));
    for end in bottoms {
        if !one.lines.iter().any(|line| line.first() == Some(&end)) {
            return Some(format!("{name} does not begin at {end:?}"));
        }
    }
    for end in tops {
        if !one.lines.iter().any(|line| line.last() == Some(&end)) {
            return Some(format!("{name} does not end at {end:?}"));
        }
    }
    let pairs = one.lines.iter().flat_map(|line| line.windows(2).map(|pair| (pair[0], pair[1])));
    let lower = |point: Point| Point::new(point.x, point.y + DOUBLE);
    let doubles = one.doubles.iter().flat_map(|(a, b)| [(*a, *b), (lower(*a), lower(*b))]);
    for (a, b) in pairs.chain(doubles) {
        if a.x != b.x && a.y != b.y {
            return Some(format!("{name} is aslant from {a:?} to {b:?}"));
        }
        let (x, y) = (a.x.min(b.x), a.y.min(b.y));
        let line = Rect { x, y, width: (a.x - b.x).abs(), height: (a.y - b.y).abs() };
        if let Some(through) = sheet.steps.iter().find(|step| step.frame.meets(line)) {
            return Some(format!("{name} goes through {} from {a:?} to {b:?}", through.name));
        }
    }
    None
}

fn wrong_sheet(sheet: &Sheet) -> Option<String> {
    for (index, one) in sheet.steps.iter().enumerate() {
        let boxes = |step: &StepShape| -> Vec<Rect> {
            let actions = step.actions.iter().map(|action| action.frame);
            std::iter::once(step.frame).chain(actions).collect()
        };
        for other in &sheet.steps[index + 1..] {
            let mine = boxes(one);
            if boxes(other).iter().any(|frame| mine.iter().any(|own| own.meets(*frame))) {
                return Some(format!("{} and {} lie upon each other", one.name, other.name));
            }
        }
    }
    sheet.transitions.iter().find_map(|one| wrong_line(sheet, one))
}

/// How many charts are drawn for a test; `CHARTS` sets it.
fn count() -> u64 {
    std::env::var("CHARTS").ok().and_then(|text| text.parse().ok()).unwrap_or(100)
}

fn check_drawing(text: &str, counts: &mut (usize, usize)) {
    let drawing = drawing(text);
    for sheet in &drawing.sheets {
        if let Some(wrong) = wrong_sheet(sheet) {
            panic!("{}: {wrong} in\n{text}", sheet.name);
        }
        counts.0 += sheet.steps.len();
        counts.1 += sheet.transitions.len();
        let frame = sheet.frame;
        assert!(frame.right() <= drawing.width && frame.bottom() <= drawing.height, "{text}");
        for step in &sheet.steps {
            let inside = step.frame.x >= frame.x && step.frame.bottom() <= frame.bottom();
            assert!(inside, "{} is outside of\n{text}", step.name);
        }
    }
}

/// The same chart with places for its steps.
fn placed(text: &str, random: &mut Rng) -> String {
    let lines = text.lines().map(|line| {
        let is_step = line.trim_start().starts_with("STEP ") || line.contains("INITIAL_STEP ");
        if is_step && let Some((head, rest)) = line.split_once(':') {
            let (x, y) = (random.i32(0..600), random.i32(0..600));
            return format!("{head} {{at {x} {y}}}:{rest}\n");
        }
        format!("{line}\n")
    });
    lines.collect()
}

#[test]
fn random_charts_are_drawn_without_lines_through_steps() {
    let mut counts = (0, 0);
    for seed in 0..count() {
        check_drawing(&random_text::program(seed), &mut counts);
        check_drawing(&random_grafcet::program(seed), &mut counts);
    }
    let (steps, transitions) = counts;
    assert!(steps as u64 > 10 * count() && transitions as u64 > 10 * count(), "{counts:?}");
}

#[test]
fn charts_with_random_places_are_drawn_without_lines_through_steps() {
    let mut counts = (0, 0);
    for seed in 0..count() {
        let mut random = Rng::with_seed(seed);
        check_drawing(&placed(&random_text::program(seed), &mut random), &mut counts);
        check_drawing(&placed(&random_grafcet::program(seed), &mut random), &mut counts);
    }
    assert!(counts.0 as u64 > 10 * count(), "{counts:?}");
}

const PLACED: &str = "INITIAL_STEP A {at 0 0}: END_STEP STEP B {at 300 0}: Lamp; END_STEP\n\
                      STEP C {at 300 500}: END_STEP\n\
                      TRANSITION FROM A TO B := a; END_TRANSITION\n\
                      TRANSITION FROM B TO C := b; END_TRANSITION\n\
                      TRANSITION FROM C TO A := c; END_TRANSITION\n";

#[test]
fn steps_stand_where_the_text_says_if_all_have_a_place() {
    let sheet = &drawing(PLACED).sheets[0];
    let [a, b, c] = &sheet.steps[..] else { panic!("three steps") };
    assert_eq!((b.frame.x - a.frame.x, b.frame.y - a.frame.y), (300, 0));
    // Distances beyond 400 are shortened.
    assert_eq!((c.frame.x - a.frame.x, c.frame.y - a.frame.y), (300, 400));
    let without = drawing(&PLACED.replace("{at 300 0}", ""));
    let [a, b, ..] = &without.sheets[0].steps[..] else { panic!("steps") };
    assert!(b.frame.x == a.frame.x && b.frame.y > a.frame.bottom(), "below each other");
}

#[test]
fn elements_have_their_lines_and_texts() {
    let drawing = drawing(PLACED);
    let sheet = &drawing.sheets[0];
    assert_eq!(sheet.name, "t");
    let lines = |sheet: &Sheet| sheet.steps.iter().map(|one| one.line).collect::<Vec<_>>();
    assert_eq!(lines(sheet), [1, 1, 2]);
    assert_eq!(sheet.steps[1].variable, "t.B");
    let of_transition = |one: &TransitionShape| (one.line, one.title.clone(), one.text.join(" "));
    let found: Vec<_> = sheet.transitions.iter().map(of_transition).collect();
    assert_eq!(found[1], (4, "B_to_C".to_owned(), "b".to_owned()));
    let lamp = &sheet.steps[1].actions[0];
    assert_eq!((lamp.line, lamp.qualifier.as_str(), lamp.name.as_str()), (1, "N", "Lamp"));
    assert!(sheet.steps[0].is_initial && !sheet.steps[1].is_initial);
}

#[test]
fn alternatives_stand_side_by_side_and_a_join_below_their_middle() {
    let drawing = drawing(
        "INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP STEP D: END_STEP\n\
         TRANSITION FROM A TO B := a; END_TRANSITION TRANSITION FROM A TO C := b; END_TRANSITION\n\
         TRANSITION FROM B TO D := c; END_TRANSITION TRANSITION FROM C TO D := d; END_TRANSITION\n\
         TRANSITION FROM D TO A := e; END_TRANSITION\n",
    );
    let sheet = &drawing.sheets[0];
    let [a, b, c, d] = [0, 1, 2, 3].map(|at| sheet.steps[at].frame);
    assert!(b.y == c.y && b.right() < c.x && a.bottom() < b.y && b.bottom() < d.y);
    assert!((b.x + c.x) / 2 == a.x && a.x == d.x, "{a:?} {b:?} {c:?} {d:?}");
    // The way back goes up beside everything, with an arrow, and no other transition has one.
    let arrows: Vec<usize> = sheet.transitions.iter().map(|one| one.arrows.len()).collect();
    assert_eq!(arrows, [0, 0, 0, 0, 1]);
}

#[test]
fn a_chart_that_is_too_large_is_refused() {
    let mut text = String::from("INITIAL_STEP S0: END_STEP\n");
    for step in 1..=ELEMENTS_MAX {
        text += &format!("STEP S{step}: END_STEP\n");
        text += &format!("TRANSITION FROM S{} TO S{step} := a; END_TRANSITION\n", step - 1);
    }
    let source = Source::new("t.sfc", text).expect("a text");
    let reading = chart::text::read(&source);
    let refused = draw(reading.document.charts(), &source).expect_err("too large");
    let wanted = "t: 2501 steps or transitions; up to 2500 of each are drawn";
    assert_eq!(refused.to_string(), wanted);
}

/// The picture of a chart.
fn picture(text: &str) -> String {
    chart::svg::write(&drawing(text))
}

#[test]
fn every_example_becomes_a_picture_with_its_steps_and_conditions() {
    for text in [
        include_str!("../../../../examples/sfc/mixing.sfc"),
        include_str!("../../../../examples/sfc/station1.sfc"),
        include_str!("../../../../examples/sfc/traffic_light.sfc"),
        include_str!("../../../../examples/grafcet/station1.sfc"),
        include_str!("../../../../examples/grafcet/traffic_light.sfc"),
    ] {
        check_drawing(text, &mut (0, 0));
        let (drawing, svg) = (drawing(text), picture(text));
        assert_eq!(svg, picture(text), "the same again");
        let sheets = || drawing.sheets.iter();
        let names = sheets().flat_map(|sheet| sheet.steps.iter().map(|step| &step.name));
        for name in names {
            assert!(svg.contains(&format!(">{name}</text>")), "{name} in\n{svg}");
        }
        let transitions = sheets().map(|sheet| sheet.transitions.len()).sum::<usize>();
        assert_eq!(svg.matches("class=\"bar\"").count(), transitions);
        assert_eq!(svg.matches("class=\"title\"").count(), drawing.sheets.len());
        // What is written beside bars meets no box.
        for sheet in sheets() {
            for one in &sheet.transitions {
                let width = one.text.iter().map(|line| line.chars().count()).max().unwrap_or(0);
                let Point { x, y } = one.label;
                let label = Rect { x, y: y - 6, width: width as i32 * 8, height: 12 };
                let boxes = sheet.steps.iter().flat_map(|step| {
                    step.actions.iter().map(|action| action.frame).chain([step.frame])
                });
                for frame in boxes {
                    assert!(!frame.meets(label), "{} {frame:?} {label:?}", one.title);
                }
            }
        }
    }
}

#[test]
fn texts_in_a_picture_are_escaped() {
    let svg = picture(
        "INITIAL_STEP A: END_STEP STEP B: END_STEP\n\
         TRANSITION FROM A TO B := x < 5 AND NOT (y > 3); END_TRANSITION\n",
    );
    assert!(svg.contains(">x &lt; 5 AND NOT (y &gt; 3)</text>"), "{svg}");
    assert!(!svg.contains("x < 5"), "{svg}");
}
