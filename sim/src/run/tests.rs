//! The meaning of times, to the millisecond.

use super::*;
use crate::machine::fake::{Fake, operand};
use crate::plant::{Inputs, Outputs, Report, Signals};
use crate::scenario::{Context, Tolerance};

fn scenario(text: &str) -> Scenario {
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    Scenario::parse("t.scn", text, context).unwrap()
}

fn job(scan_ms: u64, length: Length) -> Job<'static> {
    Job { scan_ms, length, signals: Vec::new(), plant: None, progress: None }
}

/// A machine that copies I0.0 to Q0.0, counts scans in MW0 and keeps the time of the last scan in
/// MW2.
fn copier() -> Fake {
    Fake::new(|now, memory| {
        let input = memory.get("I0.0");
        memory.set("Q0.0", input);
        let count = memory.get("MW0") + 1;
        memory.set("MW0", count);
        memory.set("MW2", now as i32);
    })
}

fn failures(text: &str, scan_ms: u64) -> Vec<String> {
    let outcome = run(&mut copier(), &scenario(text), job(scan_ms, Length::Scenario)).unwrap();
    outcome.failures.iter().map(|failure| format!("{}: {failure}", failure.line)).collect()
}

#[test]
fn a_scan_sees_what_is_set_until_its_start() {
    // Scans start at 0, 10, 20: what is set at 10 is seen at 10, what is set at 11 is seen at 20.
    let set_at_10 = "at 10ms I0.0 = 1\nat 10ms expect Q0.0 = 0\nat 11ms expect Q0.0 = 1, MW2 = 10";
    assert_eq!(failures(set_at_10, 10), [""; 0]);
    let set_at_11 =
        "at 11ms I0.0 = 1\nat 20ms expect Q0.0 = 0, MW2 = 10\nat 21ms expect Q0.0 = 1, MW2 = 20";
    assert_eq!(failures(set_at_11, 10), [""; 0]);
    assert_eq!(failures("at 0ms I0.0 = 1\nat 1ms expect Q0.0 = 1, MW0 = 1", 10), [""; 0]);
}

#[test]
fn an_expectation_sees_the_last_scan_that_started_before() {
    // At 10 the scan of 10 has not run yet; from 11 on it has.
    assert_eq!(
        failures("at 10ms expect MW0 = 1\nat 11ms expect MW0 = 2\nat 20ms expect MW0 = 2", 10),
        [""; 0]
    );
    assert_eq!(failures("at 0ms expect MW0 = 0", 10), [""; 0]);
    assert_eq!(
        failures("at 11ms expect MW0 = 1", 10),
        ["1: at 11ms expected MW0 = 1, got 2; it was 1 until 10ms"]
    );
}

#[test]
fn an_expectation_does_not_see_what_is_set_after_its_scan() {
    // Set at 12, before the scan of 20: the state after the scan of 10 is still the old one.
    assert_eq!(
        failures("at 12ms I0.0 = 1\nat 15ms expect I0.0 = 0\nat 25ms expect I0.0 = 1", 10),
        [""; 0]
    );
}

#[test]
fn the_file_may_be_unordered_and_the_last_of_the_same_time_wins() {
    let text = "at 30ms I0.0 = 0\nat 31ms expect Q0.0 = 0\nat 10ms I0.0 = 0\nat 10ms I0.0 = 1\n\
        at 20ms expect Q0.0 = 1";
    assert_eq!(failures(text, 10), [""; 0]);
}

#[test]
fn memory_is_written_once() {
    assert_eq!(
        failures("at 5ms MW0 = 100\nat 6ms expect MW0 = 101\nat 7ms expect MW0 = 102", 1),
        [""; 0]
    );
}

#[test]
fn failures_come_in_order_of_time_with_line_and_values() {
    let text = "at 20ms expect MW0 = 7..9\nat 10ms expect mw0 = 0, MW2 = 0";
    assert_eq!(
        failures(text, 10),
        [
            "2: at 10ms expected mw0 = 0, got 1; it never became 0 in the run",
            "1: at 20ms expected MW0 = 7..9, got 2; it never became so in the run"
        ]
    );
}

#[test]
fn a_failure_says_when_it_would_have_been_right() {
    let failed = |text: &str| failures(text, 10);
    // I0.0 is on from 30 to 50 and from 70 on.
    let input = "at 25ms I0.0 = 1\nat 50ms I0.0 = 0\nat 70ms I0.0 = 1\n";
    let cases = [
        ("at 20ms expect Q0.0 = 1", "at 20ms expected Q0.0 = 1, got 0; it became 1 at 30ms"),
        (
            "at 61ms expect Q0.0 = 1",
            "at 61ms expected Q0.0 = 1, got 0; it was 1 until 50ms, and again from 70ms on",
        ),
        ("at 75ms expect Q0.0 = 0", "at 75ms expected Q0.0 = 0, got 1; it was 0 until 70ms"),
        (
            "at 15ms expect MW0 > 3 or Q0.0 = 1",
            "at 15ms expected MW0 > 3 or Q0.0 = 1, got MW0 = 2, Q0.0 = 0; it became so at 30ms",
        ),
        (
            "at 15ms expect MW0 = 900",
            "at 15ms expected MW0 = 900, got 2; it never became 900 in the run",
        ),
    ];
    for (expectation, message) in cases {
        let text = format!("{input}{expectation}\nrun 100ms");
        assert_eq!(failed(&text), [format!("4: {message}")]);
    }
}

#[test]
fn what_has_time_may_become_true_within_it() {
    // The copy is there from the scan of 30 on.
    let input = "at 30ms I0.0 = 1\nat 60ms I0.0 = 0\nrun 100ms\n";
    for good in
        ["at 0ms within 31ms", "at 25ms within 10ms", "at 31ms within 0ms", "at 35ms within 1s"]
    {
        let length = if good.ends_with("1s") { "run 2s" } else { "run 100ms" };
        let text = format!("{input}{good} expect Q0.0 = 1").replace("run 100ms", length);
        assert_eq!(failures(&text, 10), [""; 0], "{good}");
    }
    let text = format!("{input}at 0ms within 30ms expect Q0.0 = 1\n");
    let became = "it became 1 at 30ms";
    assert_eq!(
        failures(&text, 10),
        [format!("4: at 0ms expected Q0.0 = 1 within 30ms, got 0; {became}")]
    );
    let text = format!("{input}at 61ms within 20ms expect Q0.0 = 1 and MW0 > 3\n");
    assert_eq!(
        failures(&text, 10),
        ["4: at 61ms expected Q0.0 = 1 and MW0 > 3 within 20ms, got Q0.0 = 0, MW0 = 9; it was so \
            until 60ms"]
    );
    // Both, but not at the same time; and already so when the time begins.
    assert_eq!(failures("at 0ms within 50ms expect MW0 = 2, MW0 = 4", 10), [""; 0]);
    let outcome = run(
        &mut copier(),
        &scenario("at 0ms within 50ms expect MW0 = 0, MW0 = 9"),
        job(10, Length::Scenario),
    )
    .unwrap();
    assert_eq!((outcome.met, outcome.failures.len(), outcome.scans), (1, 1, 5));
}

#[test]
fn rules_hold_after_every_scan_of_their_time() {
    let input = "at 30ms I0.0 = 1\nat 60ms I0.0 = 0\nrun 100ms\n";
    for good in [
        "never Q0.0 = 1 to 30ms",
        "never Q0.0 = 1 from 60ms to 100ms",
        "always Q0.0 = 1 from 30ms to 60ms",
        "never Q0.0 = 1 and MW0 > 6",
        "always Q0.0 = 0 or I0.0 = 1",
    ] {
        assert_eq!(failures(&format!("{input}{good}"), 10), [""; 0], "{good}");
    }
    for (broken, message) in [
        ("never Q0.0 = 1", "at 30ms expected never Q0.0 = 1, got 1"),
        ("never Q0.0 = 1 to 31ms", "at 30ms expected never Q0.0 = 1, got 1"),
        ("never Q0.0 = 1 from 59ms", ""),
        ("never Q0.0 = 1 from 50ms", "at 50ms expected never Q0.0 = 1, got 1"),
        (
            "always Q0.0 = 1 or MW0 < 5 from 20ms",
            "at 60ms expected always Q0.0 = 1 or MW0 < 5, got Q0.0 = 0, MW0 = 7",
        ),
    ] {
        let expected: Vec<_> =
            Some(format!("4: {message}")).filter(|_| !message.is_empty()).into_iter().collect();
        assert_eq!(failures(&format!("{input}{broken}"), 10), expected, "{broken}");
    }
}

#[test]
fn rules_are_met_or_not_reached() {
    let text = "never MW0 > 100\nnever MW0 > 1\nalways MW0 < 0 from 50ms";
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::For(50))).unwrap();
    let counts = (outcome.met, outcome.failures.len(), outcome.unreached_expectations);
    assert_eq!(counts, (1, 1, 1));
    assert_eq!(scans_run("never MW0 > 100", 10, Length::Scenario).len(), 100);
    assert_eq!(scans_run("never MW0 > 100 to 35ms", 10, Length::Scenario).len(), 4);
}

#[test]
fn values_come_again_and_again() {
    // MW0 counts the scans since it was set.
    let text = "every 30ms MW0 = 0 from 20ms to 80ms\nevery 20ms I0.0 = 1\n\
        every 20ms I0.0 = 0 from 10ms\nat 21ms expect MW0 = 1\nat 50ms expect MW0 = 3\n\
        at 51ms expect MW0 = 1, Q0.0 = 0\nat 61ms expect Q0.0 = 1\nat 100ms expect MW0 = 5";
    assert_eq!(failures(text, 10), [""; 0]);
    // All of them between two scans: the last one counts, in the order of the file.
    let text = "every 1ms MW0 = 50\nevery 2ms MW0 = 70\nat 20ms expect MW0 = 71\n\
        at 31ms expect MW0 = 71";
    assert_eq!(failures(text, 10), [""; 0]);
    assert_eq!(scans_run("every 20ms I0.0 = 1 to 45ms", 10, Length::Scenario).len(), 5);
    let text = "every 20ms I0.0 = 1 from 30ms\nat 10ms I0.1 = 1";
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::For(40))).unwrap();
    assert_eq!(outcome.unreached_settings, 0);
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::For(30))).unwrap();
    assert_eq!(outcome.unreached_settings, 1);
}

#[test]
fn until_ends_the_run_after_the_scan_that_makes_it_true() {
    let text = "at 30ms I0.0 = 1\nuntil Q0.0 = 1 or 1s";
    let mut machine = copier();
    let outcome = run(&mut machine, &scenario(text), job(10, Length::Scenario)).unwrap();
    assert_eq!(machine.scans, [0, 10, 20, 30]);
    assert_eq!((outcome.scans, outcome.met, outcome.exit_code()), (4, 1, 0));
    // The last scan may still do it.
    assert_eq!(failures("at 30ms I0.0 = 1\nuntil Q0.0 = 1 or 31ms", 10), [""; 0]);
    assert_eq!(
        failures("at 30ms I0.0 = 1\nuntil Q0.0 = 1 or 30ms", 10),
        ["2: at 30ms still waiting until Q0.0 = 1, got 0"]
    );
    // A length from outside is in its place.
    assert_eq!(scans_run(text, 10, Length::For(100)).len(), 10);
}

#[test]
fn what_until_left_out_has_failed() {
    let text = "until MW0 = 3 or 1s\nat 20ms expect MW0 = 2\nat 50ms expect MW0 = 5\n\
        at 20ms within 40ms expect MW0 = 9\nnever MW0 > 5 from 40ms";
    let failed = failures(text, 10);
    assert_eq!(
        failed,
        [
            "4: at 20ms not checked: until ended the run at 30ms",
            "3: at 50ms not checked: until ended the run at 30ms",
            "5: at 40ms not checked: until ended the run at 30ms"
        ]
    );
}

fn scans_run(text: &str, scan_ms: u64, length: Length) -> Vec<u64> {
    let mut machine = copier();
    run(&mut machine, &scenario(text), job(scan_ms, length)).unwrap();
    machine.scans
}

#[test]
fn run_runs_the_scans_that_start_before() {
    assert_eq!(scans_run("run 20ms", 10, Length::Scenario), [0, 10]);
    assert_eq!(scans_run("run 21ms", 10, Length::Scenario), [0, 10, 20]);
    assert_eq!(scans_run("run 0ms", 10, Length::Scenario), [0; 0]);
    assert_eq!(scans_run("run 50ms", 10, Length::For(15)), [0, 10]);
    assert_eq!(scans_run("run 50ms", 10, Length::Scans(3)), [0, 10, 20]);
}

#[test]
fn without_run_until_the_last_statement_has_its_effect() {
    assert_eq!(scans_run("at 20ms expect MW0 = 2", 10, Length::Scenario), [0, 10]);
    assert_eq!(scans_run("at 20ms I0.0 = 1", 10, Length::Scenario), [0, 10, 20]);
    assert_eq!(scans_run("", 10, Length::Scenario).len(), 100);
    assert_eq!(scans_run("at 0s I0.0 = 1", 10, Length::Scenario).len(), 100);
}

#[test]
fn what_is_not_reached_is_counted() {
    let text = "at 20ms expect MW0 = 2\nat 21ms expect MW0 = 3\nat 20ms I0.0 = 1\nat 19ms I0.0 = 0";
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::Scans(2))).unwrap();
    assert_eq!(
        (outcome.met, outcome.unreached_expectations, outcome.unreached_settings),
        (1, 1, 2)
    );
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::Scans(3))).unwrap();
    assert_eq!(
        (outcome.met, outcome.unreached_expectations, outcome.unreached_settings),
        (2, 0, 0)
    );
}

#[test]
fn a_fault_does_not_end_the_run() {
    let mut machine = copier();
    machine.fault_at_ms = Some(15);
    let text = "at 0s I0.0 = 1\nat 20ms expect Q0.0 = 1\nat 50ms expect Q0.0 = 0, MW0 = 2\n\
        at 50ms expect MW0 = 3";
    let outcome = run(&mut machine, &scenario(text), job(10, Length::Scenario)).unwrap();
    assert_eq!(machine.scans, [0, 10, 20, 30, 40]);
    assert_eq!((outcome.met, outcome.failures.len()), (3, 1));
    assert_eq!(outcome.fault, Some(Fault { at_ms: 20, text: "watchdog in network 3".to_string() }));
    assert_eq!((outcome.stop_ms, outcome.exit_code()), (Some(20), 3));
}

#[test]
fn exit_codes() {
    let code = |text: &str| {
        run(&mut copier(), &scenario(text), job(1, Length::Scenario)).unwrap().exit_code()
    };
    assert_eq!(code("at 5ms expect MW0 = 5"), 0);
    assert_eq!(code("at 5ms expect MW0 = 6"), 1);
}

#[test]
fn the_trace_holds_the_state_after_each_scan() {
    let signals = vec![Signal::new(operand("Q0.0"), &[]), Signal::new(operand("MW0"), &[])];
    let job = Job { signals, ..job(10, Length::Scans(3)) };
    let outcome = run(&mut copier(), &scenario("at 10ms I0.0 = 1"), job).unwrap();
    let values: Vec<_> =
        outcome.trace.changes(0).iter().map(|change| (change.scan, change.value)).collect();
    assert_eq!(values, [(0, 0), (1, 1)]);
    assert_eq!((outcome.trace.scans(), outcome.trace.changes(1).len()), (3, 3));
}

/// Mirrors Q0.0 to I0.1 and keeps the times it was called at in its report.
#[derive(Default)]
struct Mirror(Report);

impl Plant for Mirror {
    fn signals(&self) -> Signals {
        Signals { digital: 0b10, analog: 0b100 }
    }

    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
        self.0.event(now_ms, format!("{:06b}", outputs.levels));
        inputs.set_digital(0, true);
        inputs.set_digital(1, outputs.is_high(0));
        inputs.set_analog(2, 5000);
    }

    fn report(&self) -> Report {
        self.0.clone()
    }

    fn view(&self) -> Vec<(String, f64)> {
        Vec::new()
    }
}

#[test]
fn a_plant_steps_before_every_scan_and_drives_its_signals_only() {
    let mut machine = copier();
    machine.invert_outputs = 0b10;
    let job = Job { plant: Some(Box::new(Mirror::default())), ..job(10, Length::Scans(4)) };
    let text = "at 10ms I0.0 = 1\nat 20ms expect I0.1 = 0, Q0.0 = 1\nat 21ms expect I0.1 = 1\n\
        at 21ms expect Ain2 = 1023";
    let outcome = run(&mut machine, &scenario(text), job).unwrap();
    assert_eq!(outcome.failures, []);
    let events: Vec<_> = outcome
        .plant
        .unwrap()
        .events
        .into_iter()
        .map(|event| (event.time_ms, event.text))
        .collect();
    let expected = [(0, "000010"), (10, "000010"), (20, "000011"), (30, "000011")];
    assert_eq!(events, expected.map(|(time, text)| (time, text.to_string())));
}

#[test]
fn a_clock_of_its_own_goes_on_before_somebody_looks() {
    let mut machine = copier();
    let text = "at 0ms expect MW0 = 0\nat 3ms expect MW0 = 1\nat 10ms expect MW0 = 1\n\
        at 12ms expect MW0 = 2";
    run(&mut machine, &scenario(text), job(10, Length::Scenario)).unwrap();
    assert_eq!(machine.calls, ["until 0", "scan 0", "until 3", "until 10", "scan 10", "until 12"]);
    let mut machine = copier();
    let job = Job { plant: Some(Box::new(Mirror::default())), ..job(10, Length::Scans(2)) };
    run(&mut machine, &scenario(""), job).unwrap();
    assert_eq!(machine.calls, ["until 0", "scan 0", "until 10", "scan 10"]);
}

#[test]
fn progress_is_told_now_and_then() {
    let mut calls = Vec::new();
    let mut progress = |done, total| calls.push((done, total));
    let job = Job { progress: Some(&mut progress), ..job(1, Length::Scans(2000)) };
    run(&mut copier(), &scenario(""), job).unwrap();
    assert_eq!(calls, [(0, 2000), (1024, 2000)]);
}

/// Failures of a machine whose Q0.0 is on from 100 to 199 ms, with this tolerance.
fn tolerated(text: &str, tolerance: Tolerance) -> (Vec<String>, usize) {
    let scenario = Scenario { tolerance, ..scenario(text) };
    let mut machine = Fake::new(|now, memory| {
        memory.set("Q0.0", i32::from((100..200).contains(&now)));
    });
    let outcome = run(&mut machine, &scenario, job(10, Length::Scenario)).unwrap();
    let failures =
        outcome.failures.iter().map(|failure| format!("{}: {failure}", failure.line)).collect();
    (failures, outcome.met)
}

#[test]
fn with_a_tolerance_things_come_earlier_or_later() {
    let off = Tolerance { ms: 30, exact_to_ms: 0, drift: 0 };
    let good = |text: &str| assert_eq!(tolerated(text, off), (Vec::new(), 1), "{text}");
    good("at 80ms expect Q0.0 = 1");
    good("at 130ms expect Q0.0 = 0");
    good("at 225ms expect Q0.0 = 1");
    good("run 80ms\nat 80ms expect Q0.0 = 1");
    good("at 50ms within 25ms expect Q0.0 = 1");
    good("always Q0.0 = 1 from 70ms to 230ms");
    good("never Q0.0 = 1 from 0ms to 130ms");
    let bad = |text: &str, failure: &str| {
        assert_eq!(tolerated(text, off), (vec![failure.to_string()], 0), "{text}");
    };
    bad(
        "at 70ms expect Q0.0 = 1\nrun 300ms",
        "1: at 70ms expected Q0.0 = 1 (+-30ms), got 0; it became 1 at \
        100ms",
    );
    bad(
        "at 50ms within 10ms expect Q0.0 = 1\nrun 300ms",
        "1: at 50ms expected Q0.0 = 1 within 10ms \
        (+-30ms), got 0; it became 1 at 100ms",
    );
    bad("always Q0.0 = 1 from 60ms to 230ms", "1: at 90ms expected always Q0.0 = 1, got 0");
    bad("never Q0.0 = 1 from 0ms to 140ms", "1: at 100ms expected never Q0.0 = 1, got 1");
    // Shorter than the tolerance: nobody can say.
    assert_eq!(tolerated("always Q0.0 = 1 from 100ms to 150ms", off), (Vec::new(), 0));
}

#[test]
fn a_tolerance_begins_late_and_grows() {
    let off = Tolerance { ms: 30, exact_to_ms: 99, drift: 100 };
    let text = "at 80ms expect Q0.0 = 1\nat 240ms expect Q0.0 = 1\nat 270ms expect Q0.0 = 1";
    let (failures, met) = tolerated(text, off);
    assert_eq!(met, 1, "{failures:?}");
    assert_eq!(
        failures,
        [
            "1: at 80ms expected Q0.0 = 1, got 0; it became 1 at 100ms",
            "3: at 270ms expected Q0.0 = 1 (+-57ms), got 0; it was 1 until 200ms",
        ]
    );
}

#[test]
fn an_event_is_there_for_one_scan() {
    let text = "at 10ms event I0.0\nat 20ms expect Q0.0 = 1, MW2 = 10\nat 30ms expect Q0.0 = 0\n\
                at 40ms event I0.0\nat 50ms event I0.0\nat 50ms expect Q0.0 = 1\n\
                at 60ms expect Q0.0 = 1\nat 70ms expect Q0.0 = 0, I0.0 = 0";
    assert_eq!(failures(text, 10), [""; 0]);
}
