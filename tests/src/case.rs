//! Cases: files in AWL or Structured Text that carry their scenario and its expectations in `//$`
//! lines. Reads, assembles and runs them.
//!
//! `README.md` says how a case is written. The examples are cases too, with their scenario in a
//! file of its own. What runs a case is any [`Machine`].

use std::fs;
use std::path::{Path, PathBuf};

use awl_asm::assemble::{Assembly, assemble_with};
use awl_asm::diagnostic::Severity;
use awl_asm::render::human;
use awl_asm::source::Source;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::plant::PlantSpec;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario, plant_of};
use plc_isa::Profile;

/// What a line of the scenario begins with.
const MARK: &str = "//$ ";
/// The statement that is not one of scenarios: it names a fault that must come.
const FAULT: &str = "fault ";

/// A case as its file has it.
#[derive(Debug, Clone)]
pub struct Case {
    /// The program's file, from the root of the repository.
    pub file: String,
    /// The whole file; of a case the scenario is comments in it.
    pub awl: String,
    /// The scenario's file, the same for a case.
    pub scenario_file: String,
    /// The scenario, each statement on its line of the file.
    pub scenario: String,
    /// Parts of the faults that must come, in words.
    pub faults: Vec<String>,
}

impl Case {
    /// All cases, by name.
    pub fn all() -> Vec<Case> {
        let root = folder("cases");
        files(&root)
            .iter()
            .map(|path| Case::new(format!("tests/cases/{}", name_of(&root, path)), read(path)))
            .collect()
    }

    /// The examples with their scenarios.
    pub fn examples() -> Vec<Case> {
        let root = folder("../examples");
        let example = |path: &PathBuf| {
            let file = format!("examples/{}", name_of(&root, path));
            let scenario_path = path.with_extension("scn");
            let scenario_file = format!("examples/{}", name_of(&root, &scenario_path));
            Case {
                file,
                awl: read(path),
                scenario_file,
                scenario: read(&scenario_path),
                faults: Vec::new(),
            }
        };
        // An exercise has more than one scenario, and a program that is to become one.
        let has_scenario = |path: &&PathBuf| path.with_extension("scn").is_file();
        files(&root).iter().filter(has_scenario).map(example).collect()
    }

    /// The cases in Structured Text.
    pub fn structured() -> Vec<Case> {
        let root = folder("../lang/st/tests/cases");
        let case = |path: &PathBuf| {
            Case::new(format!("lang/st/tests/cases/{}", name_of(&root, path)), read(path))
        };
        let cases = files_of(&root, "st");
        // Those with a scenario in a file of its own are left out.
        cases.iter().map(case).filter(|case| !case.scenario.trim().is_empty()).collect()
    }

    /// A case from its text.
    pub fn new(file: String, awl: String) -> Case {
        let (mut scenario, mut faults) = (String::new(), Vec::new());
        for line in awl.lines() {
            if let Some(statement) = line.trim_start().strip_prefix(MARK) {
                match statement.trim().strip_prefix(FAULT) {
                    Some(fault) => faults.push(fault.trim().to_string()),
                    // As many blanks as were taken away, so that columns stay right.
                    None => scenario += &line.replacen(MARK, "    ", 1),
                }
            }
            scenario.push('\n');
        }
        Case { scenario_file: file.clone(), file, awl, scenario, faults }
    }

    /// Assembles the case. Errors come as the assembler shows them; warnings are none of ours.
    pub fn prepare(self) -> Result<Prepared, String> {
        self.prepare_for(None)
    }

    /// The same for a board that is asked for, which binds.
    pub fn prepare_for(self, board: Option<&'static Profile>) -> Result<Prepared, String> {
        let source = Source::new(&*self.file, &*self.awl).map_err(|e| e.to_string())?;
        let joined = project::join(vec![source]);
        let source = joined.map_err(|findings| format!("{}: {findings:?}", self.file))?.awl;
        let assembly = assemble_with(&source, Vec::new(), &[], board);
        let errors = assembly
            .diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.severity() == Severity::Error);
        let text: String = errors.map(|diagnostic| human(&source, diagnostic, false)).collect();
        match assembly.image {
            Some(ref image) if text.is_empty() => {
                Ok(Prepared { image: image.clone(), case: self, assembly })
            }
            _ => Err(text),
        }
    }
}

/// A case with its program.
pub struct Prepared {
    /// The case.
    pub case: Case,
    /// The program.
    pub image: Vec<u8>,
    /// What the assembler knows about it.
    pub assembly: Assembly,
}

impl Prepared {
    /// All cases that can be assembled.
    ///
    /// # Panics
    /// Where one cannot.
    pub fn all() -> Vec<Prepared> {
        let prepare = |case: Case| case.prepare().unwrap_or_else(|errors| panic!("{errors}"));
        Case::all().into_iter().map(prepare).collect()
    }

    /// Whether something happens to the PLC from outside in it that is no value: pulses, a clock
    /// that is set.
    pub fn has_actions(&self) -> bool {
        let statements = self.case.scenario.lines().filter_map(|line| line.split('#').next());
        let words = statements.map(|statement| statement.split_whitespace().collect::<Vec<_>>());
        words.into_iter().any(|words| matches!(words[..], ["at", _, "pulse" | "clock", ..]))
    }

    /// Runs a machine that has the case's program, or one to be judged by it, and returns
    /// everything that is not as the case wants it.
    pub fn failures(&self, machine: &mut dyn Machine) -> Vec<String> {
        let scenario = match self.scenario(machine) {
            Ok(scenario) => scenario,
            Err(problems) => return vec![problems],
        };
        if !scenario.expects_something() && self.case.faults.is_empty() {
            return vec![format!("{}: nothing is expected", self.place(1))];
        }
        let scan_ms = scenario.scan_ms.unwrap_or(match self.assembly.program.settings.scan_ms {
            0 => 1,
            ms => u64::from(ms),
        });
        let plant = match scenario.plant.as_ref().map(PlantSpec::build).transpose() {
            Ok(plant) => plant,
            Err(error) => return vec![format!("{}: {}", self.place(1), error.message)],
        };
        let job =
            Job { scan_ms, length: Length::Scenario, signals: Vec::new(), plant, progress: None };
        match run(machine, &scenario, job) {
            Ok(outcome) => self.judge(&outcome),
            Err(error) => vec![format!("{}: {error}", self.place(1))],
        }
    }

    fn scenario(&self, machine: &mut dyn Machine) -> Result<Scenario, String> {
        let mut has_operand = |operand| machine.read(operand).map(|_| ());
        let symbols = &self.assembly.program.symbols;
        let beside = folder("..").join(&self.case.scenario_file);
        let mut read = |file: &str| {
            fs::read_to_string(beside.with_file_name(file)).map_err(|error| error.to_string())
        };
        let plant = plant_of(&self.case.scenario_file, &self.case.scenario, &mut read)
            .map_err(|error| error.to_string())?;
        let context = Context { symbols, plant: plant.as_ref(), has_operand: &mut has_operand };
        Scenario::parse(&self.case.scenario_file, &self.case.scenario, context)
            .map_err(|problems| problems.to_string())
    }

    fn judge(&self, outcome: &Outcome) -> Vec<String> {
        let mut failures: Vec<String> = outcome
            .failures
            .iter()
            .map(|failure| format!("{}: {failure}", self.place(failure.line)))
            .collect();
        let fault = outcome.fault.as_ref().map_or("", |fault| &fault.text);
        if !fault.is_empty() && self.case.faults.is_empty() {
            failures.push(format!("{}: fault: {fault}", self.place(1)));
        }
        let missing = self.case.faults.iter().filter(|wanted| !fault.contains(wanted.as_str()));
        failures.extend(
            missing.map(|wanted| {
                format!("{}: expected fault {wanted}, got \"{fault}\"", self.place(1))
            }),
        );
        failures
    }

    fn place(&self, line: usize) -> String {
        format!("{}:{line}", self.case.scenario_file)
    }
}

/// The host machine with this image, in RUN.
pub fn host(image: &[u8]) -> Host {
    Host::new(image.to_vec(), Box::new(|_| String::new()))
}

/// A folder of this crate.
pub fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The text of a file.
///
/// # Panics
/// If it cannot be read: a test has no use for less.
pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The AWL files in a folder and the folders in it, by name.
///
/// # Panics
/// If the folder cannot be read.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    files_of(folder, "awl")
}

/// The files with an ending in a folder and the folders in it, by name.
fn files_of(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut found = Vec::new();
    for path in entries.map_while(Result::ok).map(|entry| entry.path()) {
        if path.is_dir() {
            found.extend(files_of(&path, ending));
        } else if path.extension().is_some_and(|extension| extension == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn name_of(root: &Path, path: &Path) -> String {
    let name = path.strip_prefix(root).unwrap_or(path);
    name.to_string_lossy().replace('\\', "/")
}
