//! Charts as drawings: where states and transitions are, that lines begin and end at their states,
//! that what is placed automatically does not overlap, and pictures.

#[path = "random_blocks/generate.rs"]
mod generate;

use diagnostics::Source;
use fb::drawing::shapes::{Drawing, StateShape};
use fb::drawing::{ELEMENTS_MAX, draw};
use fb::model::{Place, State, Text};
use fb::{Block, svg, xml};
use generate::Generator;
use picture::{Point, Rect};

const RAMP: &str = include_str!("../../../examples/fbt/ramp.fbt");

fn block(text: &str) -> Block {
    let source = Source::new("block.fbt", text).expect("a short text");
    xml::read(&source).block.expect("a right block")
}

fn drawn(block: &Block) -> Drawing {
    draw(block).expect("a small chart")
}

fn corner(state: &StateShape) -> Point {
    Point::new(state.frame.x, state.frame.y)
}

fn whole(drawing: &Drawing) -> Rect {
    Rect { x: 0, y: 0, width: drawing.width, height: drawing.height }
}

#[test]
fn places_are_those_of_the_file() {
    let drawing = drawn(&block(RAMP));
    let [start, e2, e3] = &drawing.states[..] else { panic!("{drawing:?}") };
    assert!(start.is_initial && !e2.is_initial);
    // 100 of the file are 40 here.
    let from_start =
        |one: &StateShape| (corner(one).x - corner(start).x, corner(one).y - corner(start).y);
    assert_eq!((from_start(e2), from_start(e3)), ((-120, 160), (120, 160)));
    let middle = drawing.transitions[0].middle;
    assert_eq!((middle.x - corner(start).x, middle.y - corner(start).y), (-80, 80));
    let named: Vec<_> = drawing.transitions.iter().map(|one| (&one.text[..], one.states)).collect();
    assert_eq!(named, [("1: INIT", (0, 1)), ("2: REQ", (0, 2)), ("1", (1, 0)), ("1", (2, 0))]);
    // Where one alone leaves a state there is no order.
    let orders: Vec<_> = drawing.transitions.iter().map(|one| one.order).collect();
    assert_eq!(orders, [Some(1), Some(2), None, None]);
    let [action] = &e2.actions[..] else { panic!("{e2:?}") };
    let (algorithm, output) = (action.algorithm.as_ref().unwrap(), action.output.as_ref().unwrap());
    assert!(e2.frame.right() < algorithm.1.x && algorithm.1.right() == output.1.x);
}

/// A chart with this transition twice, back, and to itself, without places.
#[test]
fn transitions_of_the_same_states_are_apart() {
    let mut block = block(RAMP);
    block.states.iter_mut().for_each(|one| one.place = None);
    block.transitions.iter_mut().for_each(|one| one.place = None);
    let mut again = block.transitions[0].clone();
    block.transitions.push(again.clone());
    again.destination = again.source.clone();
    block.transitions.extend([again.clone(), again]);
    let drawing = drawn(&block);
    let middles: Vec<_> = drawing.transitions.iter().map(|one| one.middle).collect();
    for (at, one) in middles.iter().enumerate() {
        for other in &middles[at + 1..] {
            let far = (one.x - other.x).pow(2) + (one.y - other.y).pow(2);
            assert!(far > 15 * 15, "{middles:?}");
        }
    }
    let orders = drawing.transitions.iter().filter_map(|one| one.order);
    assert_eq!(orders.collect::<Vec<_>>(), [1, 2, 3, 4, 5]);
    assert!(middles.iter().rev().take(2).all(|one| one.x < drawing.states[0].frame.x));
}

/// Whether a point is on the edge of a box, to a unit.
fn is_on_edge(at: Point, frame: Rect) -> bool {
    let is_near = frame.grown(1).meets(Rect::around(at, 2, 2));
    let inside = frame.grown(-2);
    let is_inside =
        inside.x < at.x && at.x < inside.right() && inside.y < at.y && at.y < inside.bottom();
    is_near && !is_inside
}

#[test]
fn lines_lead_from_state_to_state() {
    for seed in 0..300 {
        let mut block = Generator::block(seed, false);
        let is_placed = seed % 2 == 0;
        if !is_placed {
            block.states.iter_mut().for_each(|one| one.place = None);
            block.transitions.iter_mut().for_each(|one| one.place = None);
        }
        let drawing = drawn(&block);
        assert_eq!(drawing.transitions.len(), block.transitions.len());
        for one in &drawing.transitions {
            let frame = |at: usize| drawing.states[at].frame;
            assert!(is_on_edge(one.curve[0], frame(one.states.0)), "{seed}: {one:?}");
            assert!(is_on_edge(one.curve[3], frame(one.states.1)), "{seed}: {one:?}");
            assert_eq!(whole(&drawing).union(one.room()), whole(&drawing), "{seed}: {one:?}");
        }
        for (at, state) in drawing.states.iter().enumerate() {
            assert_eq!(whole(&drawing).union(state.room()), whole(&drawing), "{seed}");
            let others = &drawing.states[at + 1..];
            let is_apart = others.iter().all(|other| !other.room().meets(state.room()));
            assert!(is_placed || is_apart, "{seed}: {state:?}");
        }
        let picture = svg::write(&drawing);
        let lines = picture.matches("class=\"transition\"").count();
        assert_eq!(lines, block.transitions.len(), "{seed}");
        let tree = diagnostics::xml::parse(&picture).expect("SVG is XML");
        let boxes =
            tree.descendants().filter(|one| one.has_tag_name(("http://www.w3.org/2000/svg", "g")));
        assert_eq!(boxes.count(), block.states.len(), "{seed}");
    }
}

#[test]
fn places_that_are_no_places() {
    let mut block = block(RAMP);
    for place in [f64::NAN, f64::INFINITY, -1e300, 1e300] {
        block.states[0].place = Some(Place { x: place, y: place });
        block.transitions[0].place = Some(Place { x: -place, y: place });
        let drawing = drawn(&block);
        assert!(drawing.width > 0 && drawing.height > 0);
    }
    block.states.clear();
    assert!(drawn(&block).transitions.is_empty());
    assert_eq!(drawn(&Block::default()).states, []);
    let state = State { name: Text::new("S"), ..State::default() };
    block.states = vec![state; ELEMENTS_MAX + 1];
    let said = draw(&block).expect_err("too many").to_string();
    assert!(said.contains("1001"), "{said}");
}
