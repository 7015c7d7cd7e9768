//! Transitions between steps that stand anywhere, with a step in the way that is none of theirs.

use std::fmt::Write;

use chart::drawing::shapes::StepShape;
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

/// The drawing of a text with one chart, and whether its steps are where the text puts them.
fn drawn(text: &str) -> (Sheet, bool) {
    let source = Source::new("t.sfc", text).expect("a short text");
    let reading = chart::text::read(&source);
    assert!(reading.diagnostics.is_empty(), "{text}");
    // Steps at the same place are laid out anew.
    let places = chart::drawing::places(reading.document.charts().next().expect("a chart"));
    let mut drawing = draw(reading.document.charts(), &source).expect("a small chart");
    (drawing.sheets.swap_remove(0), places.is_given)
}

/// What is wrong with a line of a drawing.
fn wrong(sheet: &Sheet) -> Option<String> {
    sheet.transitions.iter().find_map(|one| wrong_line(sheet, one))
}

/// The text without its last step, which belongs to no transition.
fn without_the_other(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let last = lines.iter().rposition(|line| line.starts_with("STEP")).expect("steps");
    let kept = lines.iter().enumerate().filter(|(line, _)| *line != last);
    kept.map(|(_, line)| format!("{line}\n")).collect()
}

/// How many placements are drawn; `PLACEMENTS` sets it.
fn count() -> u64 {
    std::env::var("PLACEMENTS").ok().and_then(|text| text.parse().ok()).unwrap_or(2_000)
}

/// A step of one sheet in another, whose corner may be elsewhere.
fn moved(mut step: StepShape, of: &Sheet, to: &Sheet) -> StepShape {
    let (old, new) = (of.steps[0].frame, to.steps[0].frame);
    step.frame.x += new.x - old.x;
    step.frame.y += new.y - old.y;
    step
}

#[test]
fn lines_go_around_steps_wherever_they_are() {
    let (mut in_the_way, mut through, mut alike) = (0, 0, 0);
    for seed in 0..count() {
        let mut random = Rng::with_seed(seed);
        let text = text(FORMS[random.usize(..FORMS.len())], &mut random);
        let (sheet, is_placed) = drawn(&text);
        alike += u64::from(!is_placed);
        let mut own = sheet.clone();
        let other = own.steps.pop().expect("steps");
        assert_eq!(wrong(&own), None, "seed {seed}: at its own steps in\n{text}");
        through += u64::from(wrong(&sheet).is_some());
        if is_placed {
            let (mut alone, _) = drawn(&without_the_other(&text));
            alone.steps.push(moved(other, &own, &alone));
            in_the_way += u64::from(wrong(&alone).is_some());
        }
    }
    let count = count();
    println!(
        "{count} placements, {alike} laid out; another step in the way: {in_the_way}, \
         not gone around: {through}"
    );
    assert!(in_the_way * 10 >= count, "{in_the_way} of {count} have a step in the way");
    assert!(through * 100 <= in_the_way, "{through} of {in_the_way} go through another step");
    assert!(alike * 10 <= count, "{alike} of {count} have no places");
}
