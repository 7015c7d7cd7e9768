//! Every example with its scenario, and the plants of the examples under other conditions.

mod scenario_file;

use std::fs;
use std::path::{Path, PathBuf};

use awl_sim::open::{Opened, ProgramFiles, Target};
use awl_sim::plant::{Report, parse_spec};
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::program_for;
use scenario_file::run_file;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

fn scenario_of(stem: &str) -> PathBuf {
    examples().join(format!("{stem}.scn"))
}

fn open(stem: &str) -> Opened {
    let path = scenario_of(stem);
    let program = program_for(&path, &fs::read_to_string(&path).unwrap()).unwrap();
    let files = ProgramFiles { program: &program, symbols: &[], data: None, board: None };
    let opened = files.open(Target::Host).unwrap_or_else(|error| panic!("{stem}:\n{error}"));
    assert!(opened.warnings.is_empty(), "{stem}: {:?}", opened.warnings);
    opened
}

fn run_scenario(stem: &str, scan_ms: Option<u64>) -> Outcome {
    run_file(&scenario_of(stem), open(stem), scan_ms, |_| Length::Scenario).1
}

fn run_plant(stem: &str, plant: &str, length_ms: u64, scan_ms: u64) -> Report {
    let mut opened = open(stem);
    let plant = Some(parse_spec(plant).unwrap().build().unwrap());
    let job =
        Job { scan_ms, length: Length::For(length_ms), signals: Vec::new(), plant, progress: None };
    let outcome = run(&mut *opened.machine, &Scenario::default(), job).unwrap();
    assert_eq!(outcome.fault, None);
    outcome.plant.unwrap()
}

#[test]
fn every_example_does_what_its_scenario_expects() {
    let mut count = 0;
    let stems = [in_folder(""), in_folder("fbd"), in_folder("fbt")].concat();
    for stem in stems {
        let outcome = run_scenario(&stem, None);
        assert!(outcome.failures.is_empty(), "{stem}: {:#?}", outcome.failures);
        assert_eq!(outcome.fault, None, "{stem}");
        assert_eq!((outcome.unreached_expectations, outcome.unreached_settings), (0, 0), "{stem}");
        // Further ones are about single things.
        if !stem.contains('.') {
            count += 1;
            assert!(outcome.met >= 20, "{stem} expects only {} values", outcome.met);
        }
    }
    assert_eq!(count, 23);
}

/// What the cost of diagrams is compared with does the same.
#[test]
fn loops_by_hand_settle_like_their_diagrams() {
    let outcome = run_scenario("../tests/by_hand/diagrams/rc_circuit", None);
    assert!(outcome.failures.is_empty(), "{:#?}", outcome.failures);
    assert_eq!((outcome.fault, outcome.met), (None, 4));
}

/// The scenarios in a folder of the examples.
fn in_folder(folder: &str) -> Vec<String> {
    let entries = fs::read_dir(examples().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let scenarios = entries.filter(|path| path.extension().is_some_and(|found| found == "scn"));
    let name =
        |path: PathBuf| Path::new(folder).join(path.file_stem().unwrap()).display().to_string();
    scenarios.map(name).collect()
}

#[test]
fn station1_does_not_depend_on_the_scan_time() {
    // The nearest expectations are 10 ms behind what they look at; longer scans would miss them.
    for scan_ms in [2, 5, 10] {
        let outcome = run_scenario("station1", Some(scan_ms));
        assert!(outcome.failures.is_empty(), "{scan_ms} ms: {:#?}", outcome.failures);
    }
}

#[test]
fn station1_sorts_every_piece_onto_its_ramp() {
    for seed in 1..=20 {
        let plant = format!(
            "station1 pieces=small,normal,large,200,209,normal,199,211 noise=3 seed={seed} \
                start=top"
        );
        let report = run_plant("station1", &plant, 110_000, 1);
        let counts = ["pieces", "good", "rejected", "collisions", "conflicts", "left"]
            .map(|name| report.count(name));
        assert_eq!(counts, [8, 6, 2, 0, 0, 0].map(Some), "seed {seed}: {:#?}", report.events);
        for event in &report.events {
            let is_outside = ["(190)", "(228)"].iter().any(|height| event.text.contains(height));
            assert!(!event.text.ends_with("rejected") || is_outside, "seed {seed}: {}", event.text);
        }
    }
}

#[test]
fn station1_waits_for_the_next_station() {
    let report =
        run_plant("station1", "station1 pieces=normal,normal,small button=manual", 120_000, 1);
    // Nobody presses the button: the second piece stays at the top, and the third never comes.
    let counts = ["good", "rejected", "collisions", "left"].map(|name| report.count(name));
    assert_eq!(counts, [1, 0, 0, 2].map(Some), "{:#?}", report.events);
}

#[test]
fn tank_stays_within_its_limits_whatever_the_demand() {
    for seed in 1..=20 {
        let plant = format!("tank level=5 inflow=6 outflow=3 variation=90 noise=2 seed={seed}");
        let report = run_plant("tank", &plant, 1_200_000, 20);
        // 2 counts of noise and a scan of flow beyond the limits of 30 and 70 %.
        assert!(
            report.count("level_min_permille").is_some_and(|level| level >= 295),
            "seed {seed}: {report:?}"
        );
        assert!(
            report.count("level_max_permille").is_some_and(|level| level <= 705),
            "seed {seed}: {report:?}"
        );
        assert_eq!(report.count("overflows"), Some(0));
        assert!(
            report.count("pump_starts").is_some_and(|starts| starts >= 10),
            "seed {seed}: {report:?}"
        );
    }
}

#[test]
fn pid_holds_the_level_whatever_the_demand() {
    for seed in 1..=20 {
        let mut opened = open("pid");
        let mut has_operand = |operand| opened.machine.read(operand).map(|_| ());
        let context =
            Context { symbols: &opened.symbols, plant: None, has_operand: &mut has_operand };
        let scenario = Scenario::parse("pid", "at 1s Automatic = 1", context)
            .unwrap_or_else(|error| panic!("{error}"));
        let plant = format!(
            "tank level=50 inflow=6 outflow=2 variation=20 noise=2 seed={seed} outlet=valve"
        );
        let plant = Some(parse_spec(&plant).unwrap().build().unwrap());
        let job = Job {
            scan_ms: 10,
            length: Length::For(600_000),
            signals: Vec::new(),
            plant,
            progress: None,
        };
        let outcome = run(&mut *opened.machine, &scenario, job).unwrap();
        assert_eq!(outcome.fault, None);
        // It starts at the setpoint, by hand; the model counts the levels from the first stop of
        // the pump on.
        let report = outcome.plant.unwrap();
        let [low, high, overflows] = ["level_min_permille", "level_max_permille", "overflows"]
            .map(|name| report.count(name).unwrap());
        assert!(
            low >= 475 && high <= 525 && overflows == 0,
            "seed {seed}: {low} to {high} permille"
        );
    }
}

#[test]
fn same_run_same_trace() {
    let trace = || {
        let Opened { mut machine, symbols, default_signals, .. } = open("station1");
        let signals = default_signals
            .iter()
            .map(|&signal| awl_sim::trace::Signal::new(signal, &symbols))
            .collect();
        let plant = Some(parse_spec("station1 noise=5").unwrap().build().unwrap());
        let job = Job { scan_ms: 1, length: Length::For(20_000), signals, plant, progress: None };
        let outcome = run(&mut *machine, &Scenario::default(), job).unwrap();
        let mut text = Vec::new();
        awl_sim::trace::csv::write(&outcome.trace, awl_sim::trace::csv::Rows::EveryScan, &mut text)
            .unwrap();
        text
    };
    assert!(trace() == trace());
}
