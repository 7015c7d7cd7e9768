//! The exercises: every solution does what its hidden scenarios want, no start program does, and
//! each has its texts.

mod scenario_file;

use std::fs;
use std::path::{Path, PathBuf};

use awl_sim::open::{Target, open_machine};
use awl_sim::run::{Length, Outcome};
use awl_sim::scenario::Scenario;
use scenario_file::run_file;

/// The files of a folder, by name.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    entries
}

fn exercises() -> Vec<PathBuf> {
    entries(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/exercises"))
}

fn scenarios(exercise: &Path) -> Vec<PathBuf> {
    let is_scenario = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "scn");
    entries(exercise).into_iter().filter(is_scenario).collect()
}

fn outcome(exercise: &Path, program: &str, scenario: &Path) -> (Scenario, Outcome) {
    // In AWL or as a chart.
    let file = ["awl", "sfc"].map(|ending| exercise.join(program).with_extension(ending));
    let file = file.iter().find(|file| file.is_file()).expect("a program");
    let opened = open_machine(file, &[], Target::Host);
    let opened = opened.unwrap_or_else(|error| panic!("{}/{program}: {error}", exercise.display()));
    // What a start program does not yet use is warned of.
    let is_whole = program == "solution";
    let warnings = &opened.warnings;
    assert!(!is_whole || warnings.is_empty(), "{}: {warnings:?}", exercise.display());
    run_file(scenario, opened, None, |_| Length::Scenario)
}

/// Programs that docs/benchmarks.md compares with the charts that solve exercises.
#[test]
fn programs_by_hand_do_what_the_scenarios_expect() {
    let by_hand = entries(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/by_hand"));
    let by_hand: Vec<_> = by_hand.into_iter().filter(|path| path.is_file()).collect();
    assert!(!by_hand.is_empty());
    for program in by_hand {
        let name = program.file_stem().unwrap();
        let exercise =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/exercises").join(name);
        let program = format!("../../../tests/by_hand/{}", name.display());
        for scenario in scenarios(&exercise) {
            let (_, outcome) = outcome(&exercise, &program, &scenario);
            assert!(outcome.failures.is_empty(), "{}: {:?}", scenario.display(), outcome.failures);
        }
    }
}

#[test]
fn solutions_solve_and_start_programs_do_not() {
    let exercises = exercises();
    assert_eq!(exercises.len(), 11);
    for exercise in &exercises {
        let name = exercise.display();
        let scenarios = scenarios(exercise);
        assert!(scenarios.len() >= 2, "{name}: one behaviour is no exercise");
        let mut missing = 0;
        for path in &scenarios {
            let (scenario, solved) = outcome(exercise, "solution", path);
            assert_eq!(solved.exit_code(), 0, "{}: {:#?}", path.display(), solved.failures);
            assert_eq!((solved.unreached_expectations, solved.unreached_settings), (0, 0));
            let goal = scenario.goal.unwrap_or_else(|| panic!("{}: no goal", path.display()));
            assert!(goal.de.is_some() && goal.es.is_some(), "{}", path.display());
            let (_, begun) = outcome(exercise, "start", path);
            assert!(begun.fault.is_none(), "{name}");
            missing += usize::from(begun.exit_code() == 1);
        }
        assert!(missing > 0, "{name}: the start program does everything already");
    }
}

#[test]
fn every_exercise_has_its_text_in_three_languages() {
    for exercise in exercises() {
        for text in ["exercise.md", "exercise.de.md", "exercise.es.md"] {
            let path = exercise.join(text);
            let text = fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("# ") && text.lines().count() > 5, "{}", path.display());
        }
    }
}
