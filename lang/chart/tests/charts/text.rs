//! Texts of charts: written and read they are the same; broken ones end with diagnostics.

use crate::compiled::compile;
use chart::model::{
    Action, ActionId, Body, Chart, Code, Instance, Origin, Position, Qualifier, Standard, Step,
    StepId, Transition,
};
use chart::text::{Document, Piece, read, write};
use diagnostics::Source;
use fastrand::Rng;

const ALL: &str = include_str!("all.sfc");
const GRAFCET: &str = include_str!("grafcet.sfc");

fn document(text: &str) -> Document {
    let reading = read(&Source::new("t.sfc", text).expect("a short text"));
    let codes: Vec<&str> = reading.diagnostics.iter().map(|one| one.code.text()).collect();
    assert!(codes.is_empty(), "{codes:?} in\n{text}");
    reading.document
}

#[test]
fn what_is_read_and_written_is_the_same() {
    for text in [ALL, GRAFCET] {
        let first = document(text);
        let written = write(&first);
        assert_eq!(document(&written), first, "\n{written}");
        assert_eq!(write(&document(&written)), written);
    }
}

#[test]
fn everything_of_a_text_is_in_the_model() {
    let document = document(ALL);
    let chart = document.charts().next().expect("a chart");
    assert_eq!(chart.name, "Plant");
    let step = &chart.steps[&chart.step_named("fill").expect("a step")];
    assert_eq!(step.at, Some(Position { x: 120, y: 160 }));
    assert_eq!(step.comment, "Fills; and\nstirs, too.");
    let horn = &step.block[2];
    assert_eq!((horn.qualifier, &horn.time), (Qualifier::L, &Some(Code::new("T#1s500ms"))));
    let first = chart.transitions.values().next().expect("a transition");
    assert_eq!((first.name.as_deref(), first.priority), (Some("Go"), Some(2)));
    assert_eq!((first.from.len(), first.to.len()), (1, 2));
    assert_eq!(first.condition.text, "Start AND NOT Fill.X");
    assert_eq!(first.comment, "both begin");
    let order: Vec<_> = chart.by_priority();
    assert_eq!(chart.transitions[&order[0]].priority, Some(1));
    let turn = &chart.actions[&chart.action_named("Turn").expect("an action")];
    assert_eq!(turn.body, Body::Code(Code::new("Turns := Turns + 1; (* once *)")));
    let Body::Chart(stir) = &chart.actions[&chart.action_named("Stir").expect("one")].body else {
        panic!("a chart")
    };
    assert_eq!((stir.name.as_str(), stir.steps.len(), stir.transitions.len()), ("Stir", 2, 2));
    let Some(Piece::Text(end)) = document.pieces.last() else { panic!("a text") };
    assert!(end.starts_with("END_PROGRAM\n\nFUNCTION Twice : INT\n"), "{end}");
}

#[test]
fn everything_compiles() {
    for text in [ALL, GRAFCET] {
        let compiled = compile(text);
        // Outputs have no address there.
        assert!(compiled.codes().iter().all(|code| *code == "W0305"), "{:?}", compiled.codes());
        assert!(compiled.awl.is_some());
    }
}

const COMMENTS: [&str; 5] = ["", "", "once upon\na time", "(* as it is *)", "x"];
const CONDITIONS: [&str; 4] = ["a", "NOT b AND (c OR d)", "x > 5 (* why *) AND y", "S1.T >= T#5s"];

fn place(random: &mut Rng) -> Option<Position> {
    let at = Position { x: random.i32(-99..99), y: random.i32(..) };
    random.bool().then_some(at)
}

fn comment(random: &mut Rng) -> String {
    COMMENTS[random.usize(..COMMENTS.len())].to_owned()
}

fn random_chart(random: &mut Rng, name: &str, standard: Standard, depth: u32) -> Chart {
    let mut chart = Chart::new(name);
    chart.standard = standard;
    let mut steps = Vec::new();
    for n in 0..random.usize(1..6) {
        steps.push(chart.add_step(Step {
            name: format!("S{n}"),
            is_initial: random.bool(),
            comment: comment(random),
            at: place(random),
            ..Step::default()
        }));
    }
    add_transitions(random, &mut chart, &steps);
    let mut actions: Vec<ActionId> = Vec::new();
    for n in 0..random.usize(..4) {
        let name = format!("A{n}");
        let body = match random.u8(..4) {
            0 if depth < 2 => {
                Body::Chart(Box::new(random_chart(random, &name, standard, depth + 1)))
            }
            1 => Body::Code(Code::default()),
            _ => Body::Code(Code::new("x := 5;\nIF a THEN // so\n    b := TRUE;\nEND_IF;\n// end")),
        };
        let (comment, origin) = (comment(random), Origin::default());
        actions.push(chart.add_action(Action { name, body, comment, origin }));
    }
    add_instances(random, &mut chart, &steps, actions);
    chart
}

fn add_transitions(random: &mut Rng, chart: &mut Chart, steps: &[StepId]) {
    for n in 0..random.usize(..6) {
        let mut side = || {
            let count = random.usize(1..3);
            (0..count).map(|_| steps[random.usize(..steps.len())]).collect()
        };
        let (from, to) = (side(), side());
        if chart.transitions.values().any(|one| one.from == from && one.to == to) {
            continue;
        }
        chart.add_transition(Transition {
            name: random.bool().then(|| format!("T{n}")),
            from,
            to,
            condition: Code::new(CONDITIONS[random.usize(..CONDITIONS.len())]),
            priority: random.bool().then(|| random.u32(..9)),
            comment: comment(random),
            at: place(random),
            ..Transition::default()
        });
    }
}

/// Instances of actions and of a variable, which comes last in a text.
fn add_instances(
    random: &mut Rng,
    chart: &mut Chart,
    steps: &[StepId],
    mut actions: Vec<ActionId>,
) {
    let (name, body, comment) = ("Lamp".to_owned(), Body::Variable, String::new());
    let lamp = Action { name, body, comment, origin: Origin::default() };
    let lamp = chart.add_action(lamp);
    actions.push(lamp);
    for (number, step) in steps.iter().enumerate() {
        // The first step has the variable in any case.
        let count = random.usize(..3).max(usize::from(number == 0));
        for at in 0..count {
            let id = if at == 0 { lamp } else { actions[random.usize(..actions.len())] };
            let mut instance = Instance::new(id);
            instance.qualifier = Qualifier::ALL[random.usize(..Qualifier::ALL.len())];
            if instance.qualifier.has_time() {
                let time = ["T#5s", "Limit"][random.usize(..2)];
                instance.time = Some(Code::new(time));
            }
            let block = &mut chart.steps.get_mut(step).expect("a step").block;
            if !block.iter().any(|one| one.action == id && one.qualifier == instance.qualifier) {
                block.push(instance);
            }
        }
    }
}

/// All of a chart in the order of its text.
fn content(chart: &Chart) -> (Vec<&Step>, Vec<&Transition>, Vec<&Action>) {
    let (steps, transitions) = (chart.steps.values(), chart.transitions.values());
    (steps.collect(), transitions.collect(), chart.actions.values().collect())
}

#[test]
fn random_charts_are_read_as_they_were_written() {
    let mut random = Rng::with_seed(11);
    for _ in 0..2_000 {
        let standard = if random.bool() { Standard::Sfc } else { Standard::Grafcet };
        let chart = random_chart(&mut random, "t", standard, 0);
        let text = write(&Document { pieces: vec![Piece::Chart(chart.clone())] });
        let read = document(&text);
        let again = write(&read);
        assert_eq!(again, text);
        let found = read.charts().next().expect("a chart");
        // Ids are given anew, in the order of the text: that of a chart made by hand is the same.
        assert_eq!(content(found), content(&chart), "\n{text}");
    }
}

fn tried(text: &str) {
    let compiled = compile(text);
    assert!(compiled.awl.is_some() || !compiled.codes().is_empty(), "{text}");
    let Ok(source) = Source::new("t.sfc", text) else { return };
    let _ = write(&read(&source).document);
}

#[test]
fn prefixes() {
    for text in [ALL, GRAFCET] {
        for (at, _) in text.char_indices().step_by(3) {
            tried(&text[..at]);
        }
    }
}

#[test]
fn mutations() {
    let mut random = Rng::with_seed(7);
    let pages = chart::Code::ALL.iter().map(|code| code.page());
    let texts: Vec<&str> = pages.chain([ALL, GRAFCET]).collect();
    let words: Vec<&str> = texts.iter().flat_map(|text| text.split_whitespace()).collect();
    let count = std::env::var("CHART_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(5_000);
    for _ in 0..count {
        let text = texts[random.usize(..texts.len())];
        let mut pieces: Vec<&str> = text.split_inclusive([' ', '\n', ';', '(', ')', '{']).collect();
        for _ in 0..random.usize(1..4) {
            if pieces.is_empty() {
                continue;
            }
            let at = random.usize(..pieces.len());
            match random.u8(..4) {
                0 => drop(pieces.remove(at)),
                1 => pieces.insert(at, words[random.usize(..words.len())]),
                2 => {
                    let other = random.usize(..pieces.len());
                    pieces.swap(at, other);
                }
                _ => pieces[at] = words[random.usize(..words.len())],
            }
        }
        tried(&pieces.concat());
    }
}
