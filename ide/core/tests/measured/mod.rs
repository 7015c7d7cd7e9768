//! What is measured in a session: the oscilloscope, and recordings of the target.

use super::*;

#[test]
fn the_oscilloscope_has_every_scan() {
    let mut page = Page::with("count.awl", "LD SM0.0\nINCW MW0\n");
    page.target(TargetWish::Run);
    page.wish(Wish::Look(LookWish::Scope { signals: vec!["MW0".to_owned()], every_ms: 0 }));
    page.pass(1000);
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for event in &page.events {
        if let Event::Samples { times: more, columns, lost } = event {
            assert!(!lost);
            times.extend(more);
            values.extend(&columns[0]);
        }
    }
    assert!(times.len() > 900, "{}", times.len());
    let steps = |column: &[f64]| column.windows(2).all(|pair| pair[1] == pair[0] + 1.0);
    assert!(steps(&times) && steps(&values), "a sample for each scan, none twice");
}

#[test]
fn an_unknown_signal_leaves_the_others() {
    let mut page = Page::with("a.awl", "LD SM0.5\n= Q0.0\n");
    let signals = ["Q0.0", "Height", "SM0.5"].map(str::to_owned).to_vec();
    page.wish(Wish::Look(LookWish::Scope { signals, every_ms: 0 }));
    page.target(TargetWish::Run);
    page.pass(200);
    let columns = page.last(|event| match event {
        Event::Samples { columns, .. } => Some(columns.clone()),
        _ => None,
    });
    let columns = columns.expect("samples have come");
    let known = |column: &Vec<f64>| column.iter().all(|value| !value.is_nan());
    assert_eq!(columns.iter().map(known).collect::<Vec<_>>(), [true, false, true]);
    let told = page.last(|event| match event {
        Event::Notice { message, bad: true } => Some(message.clone()),
        _ => None,
    });
    assert!(told.is_some_and(|message| message.starts_with("Height")));
}

/// What was recorded of the target, and why it ended early.
fn recorded(page: &Page) -> (Recording, Option<String>) {
    let found = page.last(|event| match event {
        Event::Recorded { recording, ended } => Some((recording.clone(), ended.clone())),
        _ => None,
    });
    found.expect("a recording has ended")
}

fn record(signals: &[&str], every_ms: u32, for_ms: u32) -> Wish {
    let signals = signals.iter().map(|&signal| signal.to_owned()).collect();
    Wish::Look(LookWish::Record { signals, every_ms, for_ms })
}

#[test]
fn a_recording_of_the_simulator_has_every_scan() {
    let text = "LD SM0.0\nINCW VW0\n+R 0.5, VD4\nLDW>= VW0, 20\n= Q0.0\n";
    let mut page = Page::with("a.awl", text);
    let wish = record(&["Q0.0"], 1, 10);
    assert_eq!(page.refusal(wish), "not connected: press Run or Connect");
    page.target(TargetWish::Run);
    page.pass(200);
    assert!(page.refusal(record(&["Lamp"], 1, 10)).starts_with("Lamp"));
    assert!(page.refusal(record(&[], 1, 10)).contains("choose the signals"));
    page.wish(record(&["VW0", "VD4", "Q0.0"], 1, 500));
    assert!(page.refusal(record(&["VW0"], 1, 500)).contains("under way"));
    page.pass(300);
    let progress = page.last(|event| match event {
        Event::Recording { done_ms, gaps } => Some((*done_ms, *gaps)),
        _ => None,
    });
    assert!(matches!(progress, Some((200.0..=300.0, 0))), "{progress:?}");
    page.pass(300);
    let (recording, ended) = recorded(&page);
    assert_eq!((recording.times.len(), recording.gaps, ended), (501, 0, None));
    let rows: Vec<&str> = recording.csv.lines().collect();
    assert_eq!((rows[0], rows.len()), ("time_ms,scan,VW0,VD4,Q0.0", 502));
    for (ms, row) in rows[1..].iter().enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        let scan: u32 = cells[1].parse().unwrap();
        let expected = format!("{ms},{scan},{scan},{:?},1", scan as f32 * 0.5);
        assert_eq!(*row, expected, "a real that the program computes with is one");
    }

    // What is there when it ends before its time is kept.
    page.wish(record(&["VW0"], 10, 60_000));
    page.pass(300);
    page.wish(Wish::Look(LookWish::EndRecording));
    assert!((20..=31).contains(&recorded(&page).0.times.len()));
    page.wish(record(&["VW0"], 10, 60_000));
    page.pass(300);
    page.target(TargetWish::Disconnect);
    page.pass(100);
    assert_eq!(recorded(&page).1.as_deref(), Some("the target was left"));
}
