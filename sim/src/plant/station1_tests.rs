//! Physics of the measuring station, at the pins and without a PLC.

use crate::plant::{Inputs, Outputs, Plant, PlantSpec, Report, parse_spec};

const LOWER: u8 = 1 << 0;
const RAISE: u8 = 1 << 1;
const PUSH: u8 = 1 << 2;
const SENSOR: u8 = 1 << 3;
const HOLD: u8 = 1 << 4;

/// A station whose relays a test energises, with steps of `step_ms`.
struct Bench {
    plant: Box<dyn Plant>,
    inputs: Inputs,
    now_ms: u64,
    step_ms: u64,
}

impl Bench {
    fn new(options: &str) -> Bench {
        let spec: PlantSpec = parse_spec(&format!("station1 {options}")).unwrap();
        let mut bench = Bench {
            plant: spec.build().unwrap(),
            inputs: Inputs::default(),
            now_ms: 0,
            step_ms: 1,
        };
        bench.plant.step(0, Outputs::from(0xFF), &mut bench.inputs);
        bench
    }

    fn energise(&mut self, relays: u8, for_ms: u64) {
        let end = self.now_ms + for_ms;
        while self.now_ms < end {
            self.now_ms += self.step_ms;
            self.plant.step(self.now_ms, Outputs::from(!relays), &mut self.inputs);
        }
    }

    fn input(&self, n: u8) -> bool {
        self.inputs.digital(n)
    }

    fn report(&self) -> Report {
        self.plant.report()
    }

    fn count(&self, name: &str) -> i64 {
        self.report().count(name).unwrap()
    }
}

#[test]
fn platform_travels_three_seconds_and_stays() {
    let mut bench = Bench::new("");
    assert!(bench.input(1) && !bench.input(2));
    bench.energise(RAISE, 1);
    assert!(!bench.input(1));
    bench.energise(RAISE, 2998);
    assert!(!bench.input(2));
    bench.energise(RAISE, 1);
    assert!(bench.input(2));
    bench.energise(0, 5000);
    assert!(bench.input(2));
    bench.energise(LOWER, 2999);
    assert!(!bench.input(1));
    bench.energise(LOWER, 1);
    assert!(bench.input(1));
}

#[test]
fn times_do_not_depend_on_the_step() {
    let mut bench = Bench::new("");
    bench.step_ms = 100;
    bench.energise(RAISE, 2900);
    assert!(!bench.input(2));
    bench.energise(RAISE, 100);
    assert!(bench.input(2));
}

#[test]
fn unpowered_outputs_move_nothing() {
    let mut bench = Bench::new("start=middle");
    bench.energise(0, 10_000);
    assert!(!bench.input(1) && !bench.input(2) && !bench.input(3) && !bench.input(4));
    assert!(bench.report().events.is_empty());
}

#[test]
fn both_directions_at_once_is_one_conflict_and_no_motion() {
    let mut bench = Bench::new("start=middle");
    bench.energise(LOWER | RAISE, 5000);
    assert!(!bench.input(1) && !bench.input(2));
    assert_eq!(bench.count("conflicts"), 1);
    assert!(bench.report().events[0].text.contains("lowered and raised"));
}

#[test]
fn piece_comes_when_the_platform_was_ready_for_a_second() {
    let mut bench = Bench::new("");
    bench.energise(0, 999);
    assert!(!bench.input(0));
    bench.energise(0, 1);
    assert!(bench.input(0));
    assert_eq!(bench.report().events[0].time_ms, 1000);
    bench.energise(RAISE, 1);
    assert!(!bench.input(0));
}

#[test]
fn sensor_reads_the_piece_only_when_it_is_down() {
    let mut bench = Bench::new("pieces=228 noise=3");
    bench.energise(0, 1000);
    bench.energise(SENSOR, 599);
    assert!(!bench.input(4));
    assert!((9..=15).contains(&bench.inputs.analog(0)));
    bench.energise(SENSOR, 1);
    assert!(bench.input(4));
    let mut seen = Vec::new();
    for _ in 0..200 {
        bench.energise(SENSOR, 1);
        seen.push(bench.inputs.analog(0));
    }
    assert_eq!((seen.iter().min(), seen.iter().max()), (Some(&225), Some(&231)));
    bench.energise(0, 1);
    assert!(!bench.input(4));
}

#[test]
fn pushed_at_the_bottom_is_rejected() {
    let mut bench = Bench::new("pieces=190,228");
    bench.energise(0, 1000);
    bench.energise(PUSH, 699);
    assert_eq!((bench.count("rejected"), bench.input(3)), (0, false));
    bench.energise(PUSH, 1);
    assert_eq!((bench.count("rejected"), bench.input(3)), (1, true));
    // The piston must be in again before the next piece comes.
    bench.energise(PUSH, 2000);
    assert!(!bench.input(0));
    bench.energise(0, 700 + 999);
    assert!(!bench.input(0));
    bench.energise(0, 1);
    assert!(bench.input(0));
    assert_eq!((bench.count("pieces"), bench.count("left")), (2, 1));
}

fn bring_up_and_push(bench: &mut Bench, hold: u8) {
    bench.energise(LOWER | hold, 3000);
    bench.energise(hold, 1001);
    bench.energise(RAISE | hold, 3000);
    bench.energise(PUSH | HOLD, 700);
    bench.energise(HOLD, 700);
}

#[test]
fn pushed_at_the_top_is_held_and_let_go() {
    let mut bench = Bench::new("pieces=207,207 button=manual");
    bring_up_and_push(&mut bench, 0);
    assert_eq!(bench.count("good"), 1);
    bench.energise(HOLD, 10_000);
    assert!(!bench.report().events.iter().any(|event| event.text.contains("slid")));
    bench.energise(0, 300);
    assert!(bench.report().events.last().unwrap().text.contains("piece 1 slid on"));
    bring_up_and_push(&mut bench, 0);
    assert_eq!((bench.count("good"), bench.count("collisions"), bench.count("left")), (2, 0, 0));
}

#[test]
fn occupied_ramp_is_a_collision() {
    let mut bench = Bench::new("pieces=207,207 button=manual");
    bring_up_and_push(&mut bench, 0);
    bring_up_and_push(&mut bench, HOLD);
    assert_eq!((bench.count("good"), bench.count("collisions"), bench.count("left")), (1, 1, 0));
}

#[test]
fn button_is_pressed_some_seconds_after_a_good_piece() {
    let mut bench = Bench::new("pieces=207");
    bring_up_and_push(&mut bench, 0);
    let arrived =
        bench.report().events.iter().find(|event| event.text.contains("good")).unwrap().time_ms;
    while !bench.input(5) {
        bench.energise(HOLD, 1);
        assert!(bench.now_ms < arrived + 10_000);
    }
    assert!((2500..=4500).contains(&(bench.now_ms - arrived)));
    bench.energise(HOLD, 299);
    assert!(bench.input(5));
    bench.energise(HOLD, 1);
    assert!(!bench.input(5));
}

#[test]
fn same_seed_same_run() {
    let run = |options| {
        let mut bench = Bench::new(options);
        let mut seen = Vec::new();
        for _ in 0..100 {
            bench.energise(SENSOR, 1);
            seen.push(bench.inputs.analog(0));
        }
        seen
    };
    assert_eq!(run("seed=5"), run("seed=5"));
    assert_ne!(run("seed=5"), run("seed=6"));
}

#[test]
fn manual_button_is_left_to_the_scenario() {
    assert_eq!(Bench::new("button=manual").plant.signals().digital, 0b01_1111);
    assert_eq!(Bench::new("button=auto").plant.signals().digital, 0b11_1111);
}
