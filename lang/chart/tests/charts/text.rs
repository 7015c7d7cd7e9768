//! Texts of charts: written and read they are the same; broken ones end with diagnostics.

use crate::compiled::compile;
use chart::model::{
    Action, Body, Chart, Code, Instance, Position, Qualifier, Standard, Step, Transition,
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
fn everything_compiles_as_soon_as_it_can_be_translated() {
    assert_eq!(compile(ALL).codes(), Vec::<&str>::new());
    let codes = compile(GRAFCET).codes();
    assert_eq!(codes, ["E0306"; 10]);
}

/// A name, a comment, code: something short.
fn word(random: &mut Rng, words: &[&str]) -> String {
    format!("{}{}", words[random.usize(..words.len())], random.u8(..4))
}

fn random_chart(random: &mut Rng, name: &str, standard: Standard, depth: u32) -> Chart {
    let mut chart = Chart::new(name);
    chart.standard = standard;
    let place = |random: &mut Rng| {
        let at = Position { x: random.i32(-99..99), y: random.i32(..) };
        random.bool().then_some(at)
    };
    let comments = ["", "", "once upon\na time", "(* as it is *)", "x"];
    let conditions = ["a", "NOT b AND (c OR d)", "x > 5 (* why *) AND y", "S1.T >= T#5s"];
    let mut actions = Vec::new();
    for n in 0..random.usize(..4) {
        let body = match random.u8(..4) {
            0 if depth < 2 => {
                let inner = random_chart(random, &format!("A{n}"), standard, depth + 1);
                Body::Chart(Box::new(inner))
            }
            1 => Body::Code(Code::default()),
            _ => Body::Code(Code::new("x := 5;\nIF a THEN // so\n    b := TRUE;\nEND_IF;\n// end")),
        };
        let comment = comments[random.usize(..5)].to_owned();
        let origin = Default::default();
        actions.push(Action { name: format!("A{n}"), body, comment, origin });
    }
    let mut steps = Vec::new();
    let variable = Action {
        name: "Lamp".to_owned(),
        body: Body::Variable,
        comment: String::new(),
        origin: Default::default(),
    };
    for n in 0..random.usize(1..6) {
        steps.push(chart.add_step(Step {
            name: format!("S{n}"),
            is_initial: random.bool(),
            comment: comments[random.usize(..5)].to_owned(),
            at: place(random),
            ..Step::default()
        }));
    }
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
            condition: Code::new(conditions[random.usize(..4)]),
            priority: random.bool().then(|| random.u32(..9)),
            comment: comments[random.usize(..5)].to_owned(),
            at: place(random),
            ..Transition::default()
        });
    }
    let mut ids: Vec<_> = actions.into_iter().map(|action| chart.add_action(action)).collect();
    // Variables come last in a text, and only where a step uses them.
    let lamp = chart.add_action(variable);
    ids.push(lamp);
    for step in &steps {
        for at in 0..random.usize(..3) {
            let id = if at == 0 { lamp } else { ids[random.usize(..ids.len())] };
            let mut instance = Instance::new(id);
            instance.qualifier = Qualifier::ALL[random.usize(..11)];
            if instance.qualifier.has_time() {
                instance.time = Some(Code::new(word(random, &["T#5s", "Limit"])));
            }
            chart.steps.get_mut(step).expect("a step").block.push(instance);
        }
    }
    if chart.instances_of(lamp).next().is_none() {
        chart.actions.remove(&lamp);
    }
    chart
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
        let names = |chart: &Chart| -> Vec<String> {
            chart
                .steps
                .values()
                .map(|step| format!("{step:?}").split("block").next().unwrap_or("").to_owned())
                .collect()
        };
        assert_eq!(names(found), names(&chart), "\n{text}");
        assert_eq!(found.transitions.len(), chart.transitions.len());
        assert_eq!(found.actions.len(), chart.actions.len(), "\n{text}");
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
