//! Examples and cases in Structured Text, and examples as charts, with their scenarios: what these
//! expect is there. An example that exists in AWL, too, has to do what the scenario of that one
//! says. A case in a folder of `cases` carries its scenario itself, in lines that begin with `//$`.

use std::fs;
use std::path::{Path, PathBuf};

use awl_sim::open::{File, open_files};
use awl_sim::run::{Job, Length, run};
use awl_sim::scenario::{Context, Scenario, program_of};
use awl_sim::suite::plant_for;

/// The scenario that a case carries, each statement on its line.
fn scenario_in(case: &str) -> String {
    let lines = case.lines().map(|line| line.strip_prefix("//$ ").unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

/// What is wrong with a program after its scenario.
fn failures(program: &Path, scenario: &Path) -> Vec<String> {
    let text = fs::read_to_string(scenario).expect("a scenario");
    let text = if scenario == program { scenario_in(&text) } else { text };
    let name = program.display().to_string();
    let file = |path: &Path| File {
        name: path.display().to_string(),
        bytes: fs::read(path).expect("a program"),
    };
    let named = program_of(&text).into_iter().map(|name| file(&program.with_file_name(name)));
    let mut files: Vec<File> = named.collect();
    if files.is_empty() {
        files.push(file(program));
    }
    let mut opened = match open_files(&files, &[], None) {
        Ok(opened) => opened,
        Err(error) => return vec![format!("{name}: {error}")],
    };
    let machine = &mut *opened.machine;
    let mut has_operand = |operand| awl_sim::machine::Machine::read(machine, operand).map(|_| ());
    let origin = scenario.display().to_string();
    let plant = match plant_for(scenario, &origin, &text) {
        Ok(plant) => plant,
        Err(problems) => return vec![format!("{name}: {problems}")],
    };
    let plant = plant.as_ref();
    let context = Context { symbols: &opened.symbols, plant, has_operand: &mut has_operand };
    let parsed = match Scenario::parse(&origin, &text, context) {
        Ok(parsed) => parsed,
        Err(problems) => return vec![format!("{name}: {}", problems.render(false))],
    };
    if !parsed.expects_something() {
        return vec![format!("{name}: nothing is expected")];
    }
    let scan_ms = parsed.scan_ms.unwrap_or(1);
    let plant = parsed.plant.as_ref().map(|spec| spec.build().expect("a plant"));
    let job = Job { scan_ms, length: Length::Scenario, signals: Vec::new(), plant, progress: None };
    let outcome = run(&mut *opened.machine, &parsed, job).expect("operands that are there");
    let failed = outcome.failures.iter().map(|failure| format!("{name}: {failure:?}"));
    let fault = outcome.fault.iter().map(|fault| format!("{name}: {fault:?}"));
    failed.chain(fault).collect()
}

fn is_program(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "st" || ending == "sfc")
}

fn programs(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path());
    let mut found: Vec<PathBuf> = entries.filter(|path| is_program(path)).collect();
    found.sort();
    found
}

#[test]
fn programs_do_what_their_scenarios_expect() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for (folder, of_awl) in [
        ("../../examples/st", "../../examples"),
        ("../../examples/st/tutorial", "../../examples/tutorial"),
        ("../../examples/sfc", "../../examples"),
        ("../../examples/sfc/tutorial", "../../examples/tutorial"),
        ("../../examples/grafcet", "../../examples"),
        ("tests/cases", "tests/cases"),
    ] {
        for program in programs(&here.join(folder)) {
            let beside = program.with_extension("scn");
            let of_awl = here.join(of_awl).join(beside.file_name().expect("a name"));
            let scenario = if beside.is_file() { beside } else { of_awl };
            wrong.extend(failures(&program, &scenario));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The cases that carry their scenario.
fn cases() -> Vec<PathBuf> {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let entries = fs::read_dir(cases).expect("a folder").flatten().map(|entry| entry.path());
    entries.filter(|path| path.is_dir()).flat_map(|folder| programs(&folder)).collect()
}

#[test]
fn cases_do_what_they_expect() {
    let all = cases();
    let wrong: Vec<String> = all.iter().flat_map(|case| failures(case, case)).collect();
    assert!(wrong.is_empty(), "{} failures\n{}", wrong.len(), wrong.join("\n"));
    assert!(all.len() >= 300, "{} cases", all.len());
}

#[test]
fn every_case_says_what_it_is_about() {
    for case in cases() {
        let text = fs::read_to_string(&case).expect("a case");
        let first = text.lines().next().unwrap_or_default();
        let is_sentence = first.starts_with("// ") && first.ends_with('.');
        assert!(is_sentence, "{}: the first line is a comment with the rule", case.display());
    }
}
