//! The meaning of times, to the millisecond.

use super::*;
use crate::machine::fake::{Fake, operand};
use crate::plant::Signals;
use crate::scenario::Context;

fn scenario(text: &str) -> Scenario {
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    Scenario::parse("t.scn", text, context).unwrap()
}

fn job(scan_ms: u64, length: Length) -> Job<'static> {
    Job { scan_ms, length, signals: Vec::new(), plant: None, progress: None }
}

/// A machine that copies I0.0 to Q0.0, counts scans in MW0 and keeps the time of the last scan in MW2.
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
    let set_at_11 = "at 11ms I0.0 = 1\nat 20ms expect Q0.0 = 0, MW2 = 10\nat 21ms expect Q0.0 = 1, MW2 = 20";
    assert_eq!(failures(set_at_11, 10), [""; 0]);
    assert_eq!(failures("at 0ms I0.0 = 1\nat 1ms expect Q0.0 = 1, MW0 = 1", 10), [""; 0]);
}

#[test]
fn an_expectation_sees_the_last_scan_that_started_before() {
    // At 10 the scan of 10 has not run yet; from 11 on it has.
    assert_eq!(failures("at 10ms expect MW0 = 1\nat 11ms expect MW0 = 2\nat 20ms expect MW0 = 2", 10), [""; 0]);
    assert_eq!(failures("at 0ms expect MW0 = 0", 10), [""; 0]);
    assert_eq!(failures("at 11ms expect MW0 = 1", 10), ["1: at 11ms expected MW0 = 1, got 2"]);
}

#[test]
fn an_expectation_does_not_see_what_is_set_after_its_scan() {
    // Set at 12, before the scan of 20: the state after the scan of 10 is still the old one.
    assert_eq!(failures("at 12ms I0.0 = 1\nat 15ms expect I0.0 = 0\nat 25ms expect I0.0 = 1", 10), [""; 0]);
}

#[test]
fn the_file_may_be_unordered_and_the_last_of_the_same_time_wins() {
    let text = "at 30ms I0.0 = 0\nat 31ms expect Q0.0 = 0\nat 10ms I0.0 = 0\nat 10ms I0.0 = 1\nat 20ms expect Q0.0 = 1";
    assert_eq!(failures(text, 10), [""; 0]);
}

#[test]
fn memory_is_written_once() {
    assert_eq!(failures("at 5ms MW0 = 100\nat 6ms expect MW0 = 101\nat 7ms expect MW0 = 102", 1), [""; 0]);
}

#[test]
fn failures_come_in_order_of_time_with_line_and_values() {
    let text = "at 20ms expect MW0 = 7..9\nat 10ms expect mw0 = 0, MW2 = 0";
    assert_eq!(failures(text, 10), ["2: at 10ms expected mw0 = 0, got 1", "1: at 20ms expected MW0 = 7..9, got 2"]);
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
    assert_eq!((outcome.met, outcome.unreached_expectations, outcome.unreached_settings), (1, 1, 2));
    let outcome = run(&mut copier(), &scenario(text), job(10, Length::Scans(3))).unwrap();
    assert_eq!((outcome.met, outcome.unreached_expectations, outcome.unreached_settings), (2, 0, 0));
}

#[test]
fn a_fault_does_not_end_the_run() {
    let mut machine = copier();
    machine.fault_at_ms = Some(15);
    let text = "at 0s I0.0 = 1\nat 20ms expect Q0.0 = 1\nat 50ms expect Q0.0 = 0, MW0 = 2\nat 50ms expect MW0 = 3";
    let outcome = run(&mut machine, &scenario(text), job(10, Length::Scenario)).unwrap();
    assert_eq!(machine.scans, [0, 10, 20, 30, 40]);
    assert_eq!((outcome.met, outcome.failures.len()), (3, 1));
    assert_eq!(outcome.fault, Some(Fault { at_ms: 20, text: "watchdog in network 3".to_string() }));
    assert_eq!((outcome.stop_ms, outcome.exit_code()), (Some(20), 3));
}

#[test]
fn exit_codes() {
    let code = |text: &str| run(&mut copier(), &scenario(text), job(1, Length::Scenario)).unwrap().exit_code();
    assert_eq!(code("at 5ms expect MW0 = 5"), 0);
    assert_eq!(code("at 5ms expect MW0 = 6"), 1);
}

#[test]
fn the_trace_holds_the_state_after_each_scan() {
    let signals = vec![Signal::new(operand("Q0.0"), &[]), Signal::new(operand("MW0"), &[])];
    let job = Job { signals, ..job(10, Length::Scans(3)) };
    let outcome = run(&mut copier(), &scenario("at 10ms I0.0 = 1"), job).unwrap();
    let values: Vec<_> = outcome.trace.changes(0).iter().map(|change| (change.scan, change.value)).collect();
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

    fn step(&mut self, now_ms: u64, outputs: u8, inputs: &mut Inputs) {
        self.0.event(now_ms, format!("{outputs:06b}"));
        inputs.set_digital(0, true);
        inputs.set_digital(1, outputs & 1 == 1);
        inputs.set_analog(2, 5000);
    }

    fn report(&self) -> Report {
        self.0.clone()
    }
}

#[test]
fn a_plant_steps_before_every_scan_and_drives_its_signals_only() {
    let mut machine = copier();
    machine.invert_outputs = 0b10;
    let job = Job { plant: Some(Box::new(Mirror::default())), ..job(10, Length::Scans(4)) };
    let text =
        "at 10ms I0.0 = 1\nat 20ms expect I0.1 = 0, Q0.0 = 1\nat 21ms expect I0.1 = 1\nat 21ms expect Ain2 = 1023";
    let outcome = run(&mut machine, &scenario(text), job).unwrap();
    assert_eq!(outcome.failures, []);
    let events: Vec<_> = outcome.plant.unwrap().events.into_iter().map(|event| (event.time_ms, event.text)).collect();
    let expected = [(0, "000010"), (10, "000010"), (20, "000011"), (30, "000011")];
    assert_eq!(events, expected.map(|(time, text)| (time, text.to_string())));
}

#[test]
fn a_clock_of_its_own_goes_on_before_somebody_looks() {
    let mut machine = copier();
    let text = "at 0ms expect MW0 = 0\nat 3ms expect MW0 = 1\nat 10ms expect MW0 = 1\nat 12ms expect MW0 = 2";
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
