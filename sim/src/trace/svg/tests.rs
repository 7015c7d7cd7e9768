//! The diagram as a text: what must be in it, and that it stays small and the same.

use super::*;
use crate::trace::test_traces::trace;

fn text(trace: &Trace) -> String {
    let mut out = Vec::new();
    write(trace, "a <test>", &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn names_values_and_title_are_in_it() {
    let text = text(&trace(100, &[("Q0.1", &[0, 1, 1, 0]), ("MW3", &[7, 7, -450, -450])]));
    for part in [
        "Q0.1",
        "MW3",
        "\n-450\n",
        "\n7\n",
        "a &lt;test&gt;",
        "4 scans of 100ms, 400ms in all",
        "time in ms",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn a_wave_goes_up_and_down_at_its_times() {
    // 4 scans over 1000 pixels: up at 250, down at 750 right of the plot's edge.
    let text = text(&trace(100, &[("Q0.1", &[0, 1, 1, 0])]));
    let left = 18.0 + 60.0 + 12.0;
    let (up, down, right) = (left + 250.0, left + 750.0, left + 1000.0);
    let wave = format!("M{left} 98H{up}V80H{down}V98H{right}");
    assert!(text.contains(&wave), "{wave} is not in\n{text}");
}

#[test]
fn same_trace_same_text() {
    let make = || text(&trace(10, &[("Q0.1", &[0, 1]), ("T37.cv", &[0, 1]), ("AIW0", &[5, 5])]));
    assert_eq!(make(), make());
}

#[test]
fn long_and_busy_traces_stay_small() {
    let values: Vec<i32> = (0..200_000).map(|scan| scan % 2).collect();
    let words: Vec<i32> = (0..200_000).map(|scan| scan * 7919 % 1000).collect();
    let text = text(&trace(1, &[("SM0.5", &values), ("MW0", &words)]));
    assert!(text.len() < 150_000, "{}", text.len());
}

#[test]
fn an_empty_trace_is_a_diagram_too() {
    assert!(text(&trace(1, &[("Q0.0", &[])])).contains("0 scans"));
    assert!(text(&Trace::default()).contains("</svg>"));
}
