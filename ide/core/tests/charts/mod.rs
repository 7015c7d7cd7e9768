//! Charts that run: their steps, the situations of every scan, steps that are set by hand.

use ide_core::protocol::{Chart, Event, Moment, TargetWish, TextWish, Wish};

use super::{PLANT, Page};

#[test]
fn steps_of_charts_are_told() {
    let text = include_str!("../../../../examples/grafcet/station1.sfc");
    let mut page = Page::with("station1.sfc", text);
    let file = || "station1.sfc".to_owned();
    let wish = |file| Wish::Text(TextWish::Chart { file, values: Vec::new() });
    let chart: Option<Chart> = page.answer(wish(file()));
    let chart = chart.unwrap();
    assert_eq!(chart.file, file());
    page.target(TargetWish::Plant { spec: Some(PLANT.to_owned()) });
    page.target(TargetWish::Run);
    // Which steps of the first two charts were active at any time, and which were not.
    let mut seen = [[false; 2]; 6];
    for _ in 0..400 {
        page.pass(100);
        let situation = page.last(|event| match event {
            Event::Situation { id, now, .. } => Some((*id, now.steps.clone())),
            _ => None,
        });
        let (id, steps) = situation.unwrap();
        assert_eq!((id, steps[0].len(), steps[1].len()), (chart.id, 6, 3));
        for (seen, active) in seen.iter_mut().zip(&steps[0]) {
            if let Some(active) = active {
                seen[usize::from(*active)] = true;
            }
        }
        // A macro-step is active with its expansion.
        let is_measuring = steps[1].contains(&Some(true));
        assert_eq!(steps[0][3].unwrap_or_default(), is_measuring);
    }
    assert_eq!(seen, [[true; 2]; 6], "every step of the station");
    let none: Option<Chart> = page.answer(wish("none.sfc".to_owned()));
    assert_eq!(none, None);
}

/// Two steps that take turns in every scan, and one that waits.
const TURNS: &str = "INITIAL_STEP A: END_STEP
STEP B: END_STEP
STEP C: END_STEP
TRANSITION FROM A TO B := NOT Hold; END_TRANSITION
TRANSITION FROM B TO A := NOT Hold; END_TRANSITION
TRANSITION FROM C TO A := C.T >= T#1h; END_TRANSITION
";

/// A page with that, whose charts are shown.
fn turns() -> Page {
    let mut page = Page::with("turns.sfc", TURNS);
    let values = vec!["turns.C.T".to_owned(), "Hold".to_owned(), "None".to_owned()];
    let file = "turns.sfc".to_owned();
    let _: Option<Chart> = page.answer(Wish::Text(TextWish::Chart { file, values }));
    page.target(TargetWish::Run);
    page
}

/// The situations that were told, and the last one.
fn moments(events: &[Event]) -> (Vec<Moment>, Moment) {
    let told = events.iter().filter_map(|event| match event {
        Event::Situation { now, before, .. } => Some((before.clone(), now.clone())),
        _ => None,
    });
    let (before, now): (Vec<_>, Vec<_>) = told.unzip();
    (before.concat(), now.last().unwrap().clone())
}

#[test]
fn each_situation_of_the_simulator_is_told() {
    let mut page = turns();
    page.pass(1000);
    let (before, now) = moments(&page.events);
    assert!(before.len() > 900, "{} of 1000 scans", before.len());
    let turns = before.windows(2).filter(|pair| pair[0].steps[0][0] == pair[1].steps[0][0]);
    assert_eq!(turns.count(), 0, "each differs from the one before");
    assert!(before.is_sorted_by_key(|moment| moment.scan));
    assert_eq!(now.values, [Some(0.0), Some(0.0), None]);
    // Paused, a single scan is one more.
    page.target(TargetWish::Pause { on: true });
    page.pass(100);
    page.events.clear();
    page.target(TargetWish::SingleScan);
    page.pass(100);
    assert_eq!(moments(&page.events).0.len(), 1);
}

#[test]
fn situations_that_are_too_many_are_missing_and_that_is_told() {
    let mut page = turns();
    page.pass(200);
    let lost = |page: &Page| {
        page.events.iter().any(|event| matches!(event, Event::Situation { lost: true, .. }))
    };
    assert!(!lost(&page));
    page.target(TargetWish::Speed { factor: 0.0 });
    page.pass(500);
    assert!(lost(&page));
    let most = page.events.iter().map(|event| match event {
        Event::Situation { before, .. } => before.len(),
        _ => 0,
    });
    assert!(most.max().unwrap() <= 1000);
}

#[test]
fn a_step_is_set_by_hand() {
    let mut page = turns();
    page.target(TargetWish::Set { operand: "Hold".to_owned(), value: "1".to_owned() });
    page.pass(200);
    let activate = |on| TargetWish::Activate { step: "turns.C".to_owned(), on };
    page.target(activate(true));
    page.pass(500);
    let (_, now) = moments(&page.events);
    assert_eq!(now.steps[0][2], Some(true));
    assert!(now.values[0].is_some_and(|time| time > 400.0), "its time goes on: {now:?}");
    // Paused, too; the time begins anew.
    page.target(TargetWish::Pause { on: true });
    page.target(activate(false));
    page.pass(100);
    assert_eq!(moments(&page.events).1.steps[0][2], Some(false));
    page.target(activate(true));
    page.pass(100);
    let (_, now) = moments(&page.events);
    assert_eq!((now.steps[0][2], now.values[0]), (Some(true), Some(0.0)));
    let refused = |page: &mut Page, step: &str| {
        let step = step.to_owned();
        let events = page.wish(Wish::Target(TargetWish::Activate { step, on: true }));
        events.iter().find_map(|event| match event {
            Event::Refused { message, .. } => Some(message.clone()),
            _ => None,
        })
    };
    assert!(refused(&mut page, "turns.None").is_some_and(|why| why.contains("macro-step")));
    page.target(TargetWish::Disconnect);
    assert!(refused(&mut page, "turns.C").is_some_and(|why| why.contains("press Run")));
}
