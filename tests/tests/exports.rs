//! Programs as STEP 7-Micro/WIN exports them: they assemble, do what their scenarios expect, and
//! keep their layout. On the host; with the feature `uno` those that fit the board's pins run there
//! too.

use std::fs;
use std::path::{Path, PathBuf};

use awl_asm::format::{first_difference, format};
use awl_asm::source::Source;
use awl_sim::open::{Opened, Target, open_machine};
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};

/// The least that the collection has, so that none gets lost.
const PROGRAMS_MIN: usize = 15;
/// Instructions of a program.
const INSTRUCTIONS: std::ops::RangeInclusive<usize> = 50..=400;
/// The least that a scenario expects.
const EXPECTATIONS_MIN: usize = 30;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("exports")
}

/// The names of the programs, without their endings.
fn names() -> Vec<String> {
    let entries = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let programs =
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "awl"));
    let mut names: Vec<String> =
        programs.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    names.sort();
    assert!(names.len() >= PROGRAMS_MIN, "{names:?}");
    names
}

fn bytes(name: &str) -> Vec<u8> {
    fs::read(folder().join(name).with_extension("awl")).unwrap()
}

fn source(name: &str) -> Source {
    Source::from_bytes(format!("{name}.awl"), &bytes(name)).unwrap()
}

/// The program with its table of symbols, if it has one.
fn open(name: &str, target: Target) -> Opened {
    let table = folder().join(name).with_extension("txt");
    let tables = if table.exists() { vec![table] } else { Vec::new() };
    let path = folder().join(name).with_extension("awl");
    open_machine(&path, &tables, target).unwrap_or_else(|error| panic!("{name}:\n{error}"))
}

fn run_scenario(name: &str, target: Target) -> Outcome {
    let Opened { mut machine, symbols, scan_ms: period_ms, .. } = open(name, target);
    let text = fs::read_to_string(folder().join(name).with_extension("scn")).unwrap();
    let mut has_operand = |operand| machine.read(operand).map(|_| ());
    let context = Context { symbols: &symbols, plant: None, has_operand: &mut has_operand };
    let scenario = Scenario::parse(&format!("{name}.scn"), &text, context)
        .unwrap_or_else(|problems| panic!("{problems}"));
    let plant = scenario.plant.as_ref().map(|spec| spec.build().unwrap());
    let scan_ms = scenario.scan_ms.or(period_ms).unwrap_or(1);
    let job = Job { scan_ms, length: Length::Scenario, signals: Vec::new(), plant, progress: None };
    run(&mut *machine, &scenario, job).unwrap()
}

/// What is wrong with a run; empty if nothing is.
fn complaints(name: &str, target: Target) -> Vec<String> {
    let outcome = run_scenario(name, target);
    let mut complaints: Vec<String> = outcome
        .failures
        .iter()
        .map(|failure| format!("{name}.scn:{}: {failure}", failure.line))
        .collect();
    complaints.extend(outcome.fault.map(|fault| format!("{name}: {}", fault.text)));
    let unreached = outcome.unreached_expectations + outcome.unreached_settings;
    complaints.extend(
        (unreached > 0).then(|| format!("{name}: {unreached} statements after the end of the run")),
    );
    let met = outcome.met;
    complaints
        .extend((met < EXPECTATIONS_MIN).then(|| format!("{name}: only {met} expectations met")));
    complaints
}

/// Whether a line of an export is an instruction, by its layout alone.
fn is_instruction(line: &str) -> bool {
    const OTHERS: [&str; 9] =
        ["//", "TITLE=", "VAR", "END_", "BEGIN", "Network ", "DATA_BLOCK", "VB", "VW"];
    let is_other = OTHERS.iter().any(|other| line.starts_with(other));
    !is_other && !line.starts_with(' ') && !line.is_empty() && !line.contains([':', ';'])
}

#[test]
fn they_look_as_micro_win_exports_them() {
    for name in names() {
        let bytes = bytes(&name);
        assert!(
            bytes.windows(2).all(|pair| pair[1] != b'\n' || pair[0] == b'\r'),
            "{name}: a line end without CR"
        );
        assert!(
            bytes.starts_with(b"ORGANIZATION_BLOCK ") && bytes.ends_with(b"_BLOCK\r\n"),
            "{name}"
        );
        let source = source(&name);
        let titles = source.text.lines().filter(|line| line.starts_with("TITLE=")).count();
        let blocks = source.text.lines().filter(|line| line.contains("_BLOCK ")).count();
        assert_eq!(titles, blocks, "{name}: each block has its title");
        let instructions = source.text.lines().filter(|line| is_instruction(line)).count();
        assert!(INSTRUCTIONS.contains(&instructions), "{name}: {instructions} instructions");
    }
    let not_ascii = names().into_iter().filter(|name| !bytes(name).is_ascii()).collect::<Vec<_>>();
    assert!(not_ascii.len() >= 5, "umlauts and accents only in {not_ascii:?}");
    for name in not_ascii {
        assert!(
            std::str::from_utf8(&bytes(&name)).is_err(),
            "{name} is UTF-8, and not of a Windows code page"
        );
    }
}

#[test]
fn they_do_what_their_scenarios_expect() {
    let complaints: Vec<String> =
        names().iter().flat_map(|name| complaints(name, Target::Host)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[cfg(feature = "uno")]
#[test]
fn the_board_does_the_same() {
    // The scenario of `messung` expects analog values to the unit; the board's converter has steps
    // of 31.
    let on_board: Vec<String> = names().into_iter().filter(|name| name != "messung").collect();
    let complaints: Vec<String> =
        on_board.iter().flat_map(|name| complaints(name, Target::Uno)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn their_layout_is_the_canonical_one() {
    for name in names() {
        let source = source(&name);
        let text = format(&source).unwrap_or_else(|errors| panic!("{name}: {errors:?}"));
        if let Some(line) = first_difference(&source.text, &text) {
            let [is, becomes] =
                [&source.text, &text].map(|text| text.split('\n').nth(line - 1).unwrap_or(""));
            panic!("{name}.awl:{line}: {is:?} becomes {becomes:?}");
        }
        assert!(
            source.encoding.encode(&text).is_some_and(|again| again == bytes(&name)),
            "{name}: other bytes"
        );
    }
}
