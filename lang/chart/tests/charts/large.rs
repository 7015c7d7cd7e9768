//! Charts with as many steps as can be drawn: what they take grows as they do.

use std::fmt::Write;
use std::time::{Duration, Instant};

use chart::drawing::{ELEMENTS_MAX, draw};
use diagnostics::Source;

/// Which way the steps of a chart are connected.
#[derive(Debug, Clone, Copy)]
enum Form {
    /// One after the other, and back.
    Sequence,
    /// Two ways beside each other, again and again, and ways back from the one.
    Alternatives,
    /// Three branches at once, again and again.
    Parallel,
}

/// From which steps to which.
type Ends = (Vec<usize>, Vec<usize>);

fn ends(form: Form, count: usize) -> Vec<Ends> {
    let mut ends: Vec<Ends> = Vec::new();
    let mut at = 0;
    while at + 1 < count {
        match form {
            Form::Alternatives if at + 4 < count => {
                for way in [at + 1, at + 2] {
                    ends.extend([(vec![at], vec![way]), (vec![way], vec![at + 3])]);
                }
                ends.extend([(vec![at + 3], vec![at]), (vec![at + 3], vec![at + 4])]);
                at += 4;
            }
            Form::Parallel if at + 4 < count => {
                let branches = vec![at + 1, at + 2, at + 3];
                ends.extend([(vec![at], branches.clone()), (branches, vec![at + 4])]);
                at += 4;
            }
            _ => {
                ends.push((vec![at], vec![at + 1]));
                at += 1;
            }
        }
    }
    ends.push((vec![at], vec![0]));
    ends
}

fn text(form: Form, count: usize) -> String {
    let mut text = String::new();
    for step in 0..count {
        let word = if step == 0 { "INITIAL_STEP" } else { "STEP" };
        let _ = writeln!(text, "{word} S{step}: Q{}; END_STEP", step % 7);
    }
    for (from, to) in ends(form, count) {
        let side = |side: Vec<usize>| {
            let names: Vec<String> = side.into_iter().map(|step| format!("S{step}")).collect();
            format!("({})", names.join(", "))
        };
        let (from, to) = (side(from), side(to));
        let _ = writeln!(text, "TRANSITION FROM {from} TO {to} := Go AND NOT Stop; END_TRANSITION");
    }
    text
}

/// How long a chart takes to be drawn, the shortest of a few times. With places: those that it has
/// without.
fn time(form: Form, count: usize, is_placed: bool) -> Duration {
    let source = Source::new("large.sfc", text(form, count)).expect("a text");
    let reading = chart::text::read(&source);
    assert!(reading.diagnostics.is_empty());
    let mut chart = reading.document.charts().next().expect("a chart").clone();
    if is_placed {
        let places = chart::drawing::places(&chart).steps;
        chart.steps.iter_mut().for_each(|(id, step)| step.at = places.get(id).copied());
    }
    let all = (0..4).map(|_| {
        let start = Instant::now();
        let drawing = draw([&chart], &source).expect("a chart");
        let took = start.elapsed();
        assert_eq!(drawing.sheets[0].steps.len(), count);
        assert_eq!(drawing.sheets[0].transitions.len(), ends(form, count).len());
        took
    });
    all.min().expect("a time")
}

/// Eight times the steps take some eight times as long, even where others use the machine; what
/// grew with the square would take 64 times as long.
#[test]
fn what_a_chart_takes_grows_as_it_does() {
    let mut slow = Vec::new();
    // Alternatives have three transitions for two steps.
    for (form, count) in
        [(Form::Sequence, 2_000), (Form::Alternatives, 1_600), (Form::Parallel, 2_000)]
    {
        for is_placed in [false, true] {
            let small = time(form, count / 8, is_placed);
            let large = time(form, count, is_placed);
            let how = if is_placed { "with places" } else { "without places" };
            let found = format!("{form:?} {how}: {count} steps {large:?}, an eighth {small:?}");
            println!("{found}");
            slow.extend((large > small * 24).then_some(found));
        }
    }
    assert!(slow.is_empty(), "{slow:?}");
}

#[test]
fn the_largest_chart_is_drawn() {
    time(Form::Sequence, ELEMENTS_MAX, false);
}
