//! What all libraries do together, told in a text: a program assembled, run with its plant, asked
//! over its line, shown, traced, edited, written to a board. The same function natively and as
//! WebAssembly; no file, clock or socket on the way. That both say the same, `cargo xtask wasm`
//! checks.

mod ask;
mod digest;
mod write;

use std::time::Duration;

use analysis::Project;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, Opened, open};
use awl_sim::plant::{Plant, parse_spec};
use awl_sim::run::{Course, Job, Length, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::serve::{Access, Endpoint};
use awl_sim::trace::{Signal, csv, svg, vcd};

use ask::Asking;
use digest::Digest;

const NAME: &str = "station1.awl";
const PROGRAM: &[u8] = include_bytes!("../../../examples/station1.awl");
const PLANT: &str =
    "station1 pieces=normal,small,normal,large,small,normal noise=3 seed=7 button=auto";
/// What every scan is looked at for.
const SIGNALS: [&str; 4] = ["Raise", "Push", "Height", "T101"];
/// Scans that are run before anybody asks.
pub const SCANS: u64 = 10_000;

/// Does it all, and tells what came of it, a line each.
pub fn report() -> Result<String, Box<dyn std::error::Error>> {
    let mut lines = vec![assembled()];
    lines.extend(served()?);
    lines.extend(traced()?);
    lines.push(edited()?);
    lines.push(write::written(&program_of_board()?)?);
    lines.push(refused());
    Ok(lines.join("\n") + "\n")
}

fn program() -> Result<Opened<Host>, Box<dyn std::error::Error>> {
    Ok(open(&File { name: NAME.to_string(), bytes: PROGRAM.to_vec() }, &[])?)
}

fn plant() -> Result<Box<dyn Plant>, Box<dyn std::error::Error>> {
    let spec = parse_spec(PLANT).map_err(|problems| format!("{problems:?}"))?;
    Ok(spec.build().map_err(|error| error.message)?)
}

/// The image, and its translation to machine code.
fn assembled() -> String {
    let Ok(program) = client::Program::of_bytes(NAME, PROGRAM, Vec::new()) else {
        return "the program has errors".to_string();
    };
    let native = program.native_image().unwrap_or_default();
    let (image, native) = (Digest::of(&program.image), Digest::of(&native));
    format!("image: {:08X}, {image}, native {native}", program.crc())
}

/// The program in real time, which is passed in, with somebody at the other end of its line.
fn served() -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let Opened { machine: mut host, .. } = program()?;
    let course = Course::new(&Scenario::default(), Some(plant()?), 1);
    let mut endpoint = Endpoint::new(course, 1, Access::default(), Duration::ZERO);
    let mut levels = Digest::default();
    for scan in 0..SCANS {
        endpoint.go_on(&mut host, Duration::from_millis(scan))?;
        levels.add(&[host.pin_levels()]);
    }
    let memory: Vec<u8> =
        (plc_isa::DATA_START..plc_isa::DATA_END).map(|at| host.memory().byte(at)).collect();
    let mut lines = vec![
        format!("scans: {SCANS}, {:?}, pins {levels}", host.mode()),
        format!("memory: {}", Digest::of(&memory)),
    ];
    let mut asking = Asking::new(*host, endpoint, SCANS);
    lines.extend(asking.modbus()?);
    lines.extend(asking.service()?);
    lines.extend(asking.show(client::Program::of_bytes(NAME, PROGRAM, Vec::new())?)?);
    let report = asking.finish().plant.unwrap_or_default();
    lines.push(format!("plant: {:?}, {} events", report.summary, report.events.len()));
    Ok(lines)
}

/// The program through a scenario, and its trace in every format.
fn traced() -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let Opened { mut machine, symbols, .. } = program()?;
    let text = "at 0ms I0.5 = 1\nat 1s expect Q0.0 = 0..1\nrun 2s\n";
    let mut has_operand = |operand| machine.read(operand).map(drop);
    let context = Context { symbols: &symbols, plant: None, has_operand: &mut has_operand };
    let scenario = Scenario::parse("smoke.scn", text, context)?;
    let signals = SIGNALS.iter().map(|name| Signal::parse(name, &symbols));
    let signals = signals.collect::<Result<_, _>>()?;
    let plant = parse_spec("station1 seed=3").ok().and_then(|spec| spec.build().ok());
    let job = Job { scan_ms: 2, length: Length::Scenario, signals, plant, progress: None };
    let outcome = run(&mut *machine, &scenario, job)?;
    let (mut table, mut dump, mut picture) = (Vec::new(), Vec::new(), Vec::new());
    csv::write(&outcome.trace, csv::Rows::EveryScan, &mut table)?;
    vcd::write(&outcome.trace, &mut dump)?;
    svg::write(&outcome.trace, NAME, &mut picture)?;
    let [table, dump, picture] = [&table, &dump, &picture].map(|bytes| Digest::of(bytes));
    Ok(vec![
        format!("scenario: {} scans, {} met", outcome.scans, outcome.met),
        format!("trace: csv {table}, vcd {dump}, svg {picture}"),
    ])
}

/// The image that a board gets.
fn program_of_board() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let program = client::Program::of_bytes(NAME, PROGRAM, Vec::new());
    Ok(program.map_err(|error| error.to_string())?.image)
}

/// What an editor is told of the program.
fn edited() -> Result<String, Box<dyn std::error::Error>> {
    let text = std::str::from_utf8(PROGRAM)?;
    let mut project = Project::new();
    project.set(NAME, text)?;
    let at = text.rfind("Raise").unwrap_or_default();
    let hover = project.hover(NAME, at).map(|hover| hover.text).unwrap_or_default();
    let renamed = project.rename(NAME, at, "Up")?;
    Ok(format!(
        "editor: {} completions, {} parts, {} places of a name, {} changes, hover {}",
        project.completions(NAME, text.len()).len(),
        project.outline(NAME).len(),
        project.references(NAME, at).len(),
        renamed.len(),
        Digest::of(hover.as_bytes())
    ))
}

/// A program with an error.
fn refused() -> String {
    let program = File { name: "wrong.awl".to_string(), bytes: b"LD I0.0\nJMP 7\n".to_vec() };
    open(&program, &[]).map_or_else(|error| error.to_string(), |_| "no error".to_string())
}

/// What JavaScript calls.
#[cfg(target_arch = "wasm32")]
mod page {
    use wasm_bindgen::prelude::wasm_bindgen;

    /// [`super::report`]; an error as text.
    #[wasm_bindgen]
    pub fn report() -> String {
        super::report().unwrap_or_else(|error| format!("error: {error}\n"))
    }
}

#[cfg(test)]
mod tests {
    /// That a digest is always the same proves nothing of a program that does nothing.
    #[test]
    fn the_station_works_and_answers() {
        let text = super::report().unwrap();
        let value = |name: &str| {
            let line = text.lines().find_map(|line| line.strip_prefix(name));
            line.unwrap_or_else(|| panic!("{name} is missing in:\n{text}")).to_string()
        };
        assert!(value("scans: ").starts_with("10000, Run, "), "{text}");
        assert!(value("identity: ").starts_with("running, "), "{text}");
        // Something is moved, and a view of forty rows has power flow somewhere.
        let count = |line: &str, name: &str| -> usize {
            let before = line.split(name).next().unwrap_or_default().trim_end();
            let digits = before.rsplit(|c: char| !c.is_ascii_digit()).next().unwrap_or_default();
            digits.parse().unwrap_or_else(|_| panic!("no number of {name} in {line}"))
        };
        assert!(count(&value("plant: "), " events") > 0, "{text}");
        assert!(count(&value("rows: "), " with power flow") > 0, "{text}");
        assert!(value("forced: ").starts_with("1, then 0"), "{text}");
        assert!(value("message: ").contains("is forced to "), "{text}");
        assert!(value("forced in the view: ").contains("Reference([0, 0, 0]): "), "{text}");
        assert!(value("scenario: ").starts_with("1000 scans, 1 met"), "{text}");
        assert!(count(&value("editor: "), " changes") > 2, "{text}");
        assert!(count(&value("editor: "), " places of a name") > 2, "{text}");
        assert!(value("board: ").starts_with("written, "), "{text}");
        assert!(value("wrong.awl:2:5: ").len() > 5, "{text}");
        assert_eq!(text, super::report().unwrap(), "it does not depend on anything else");
    }
}
