//! Transitions between steps that stand anywhere, with a step in the way that is none of theirs.

use std::fmt::Write;

use chart::drawing::{Sheet, draw};
use diagnostics::Source;
use fastrand::Rng;

use crate::drawing::wrong_line;

/// From which steps to which, for each transition; the last step belongs to none.
const FORMS: [&[(&[usize], &[usize])]; 6] = [
    &[(&[0], &[1])],
    &[(&[0], &[1]), (&[0], &[2])],
    &[(&[0], &[2]), (&[1], &[2])],
    &[(&[0], &[1, 2])],
    &[(&[0, 1], &[2])],
    &[(&[0, 1], &[2, 3])],
];

fn text(form: &[(&[usize], &[usize])], random: &mut Rng) -> String {
    let count = 2 + form.iter().flat_map(|(from, to)| from.iter().chain(*to)).max().unwrap_or(&0);
    // Close together, or far from each other.
    let span = [150, 400, 1_200][random.usize(..3)];
    let places: Vec<(i32, i32)> =
        (1..count).map(|_| (random.i32(-span..span), random.i32(-span..span))).collect();
    // The other step is between two of them, more or less.
    let (a, b) = (places[random.usize(..places.len())], places[random.usize(..places.len())]);
    let mut near = || random.i32(-60..60);
    let other = ((a.0 + b.0) / 2 + near(), (a.1 + b.1) / 2 + near());
    let mut text = String::new();
    for (step, (x, y)) in places.into_iter().chain([other]).enumerate() {
        let word = if step == 0 { "INITIAL_STEP" } else { "STEP" };
        let action = if random.u8(..4) == 0 { "Lamp;" } else { "" };
        let _ = writeln!(text, "{word} S{step} {{at {x} {y}}}: {action} END_STEP");
    }
    for (from, to) in form {
        let side = |side: &[usize]| {
            let names: Vec<String> = side.iter().map(|step| format!("S{step}")).collect();
            format!("({})", names.join(", "))
        };
        let (from, to) = (side(from), side(to));
        let _ = writeln!(text, "TRANSITION FROM {from} TO {to} := a; END_TRANSITION");
    }
    text
}

/// What is wrong with lines of a drawing: at their own steps, and at the other one.
fn wrong(sheet: &Sheet, text: &str) -> (Option<String>, bool) {
    let (other, own) = sheet.steps.split_last().expect("steps");
    let mut without = sheet.clone();
    without.steps = own.to_vec();
    let own = sheet.transitions.iter().find_map(|one| wrong_line(&without, one));
    without.steps.push(other.clone());
    let all = sheet.transitions.iter().find_map(|one| wrong_line(&without, one));
    (own.map(|wrong| format!("{wrong} in\n{text}")), all.is_some())
}

/// How many placements are drawn; `PLACEMENTS` sets it.
fn count() -> u64 {
    std::env::var("PLACEMENTS").ok().and_then(|text| text.parse().ok()).unwrap_or(2_000)
}

#[test]
fn lines_go_around_steps_wherever_they_stand() {
    let (mut drawn, mut alike, mut through) = (0, 0, 0);
    for seed in 0..count() {
        let mut random = Rng::with_seed(seed);
        let text = text(FORMS[random.usize(..FORMS.len())], &mut random);
        let source = Source::new("t.sfc", text.as_str()).expect("a short text");
        let reading = chart::text::read(&source);
        assert!(reading.diagnostics.is_empty(), "{text}");
        let drawing = draw(reading.document.charts(), &source).expect("a small chart");
        let (own, is_through) = wrong(&drawing.sheets[0], &text);
        assert_eq!(own, None, "seed {seed}");
        drawn += 1;
        through += u64::from(is_through);
        // Steps at the same place are laid out anew.
        let is_placed = chart::drawing::places(reading.document.charts().next().expect("a chart"));
        alike += u64::from(!is_placed.is_given);
    }
    println!("{drawn} placements, {through} with a line through another step, {alike} laid out");
    assert!(through * 100 <= drawn, "{through} of {drawn} go through another step");
    assert!(alike * 10 <= drawn, "{alike} of {drawn} have no places");
}
