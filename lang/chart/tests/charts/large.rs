//! Charts with as many steps as can be drawn are drawn whole. Nothing here says how long it takes.

use std::fmt::Write;

use chart::Chart;
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

/// A chart of a form, with the text that it is from. With places: those that it has without.
fn chart(form: Form, count: usize, is_placed: bool) -> (Source, Chart) {
    let source = Source::new("large.sfc", text(form, count)).expect("a text");
    let reading = chart::text::read(&source);
    assert!(reading.diagnostics.is_empty());
    let mut chart = reading.document.charts().next().expect("a chart").clone();
    if is_placed {
        let places = chart::drawing::places(&chart).steps;
        chart.steps.iter_mut().for_each(|(id, step)| step.at = places.get(id).copied());
    }
    (source, chart)
}

fn is_drawn(form: Form, count: usize, is_placed: bool) {
    let (source, chart) = chart(form, count, is_placed);
    let drawing = draw([&chart], &source).expect("a chart");
    assert_eq!(drawing.sheets[0].is_placed, is_placed);
    assert_eq!(drawing.sheets[0].steps.len(), count);
    assert_eq!(drawing.sheets[0].transitions.len(), ends(form, count).len());
}

#[test]
fn large_charts_of_every_form_are_drawn_whole() {
    // Alternatives have three transitions for two steps.
    for (form, count) in
        [(Form::Sequence, 2_000), (Form::Alternatives, 1_600), (Form::Parallel, 2_000)]
    {
        is_drawn(form, count, false);
        is_drawn(form, count, true);
    }
}

#[test]
fn the_largest_chart_is_drawn() {
    is_drawn(Form::Sequence, ELEMENTS_MAX, false);
}
