//! Speed of the host interpreter and of the assembler, compared with their budgets. The board is
//! measured elsewhere. A package of its own: an optimised build of what is measured, and of nothing
//! else, is enough.
//!
//! Each figure is the best of several rounds, as on a machine of usual speed (yardstick.rs). What
//! is counted is checked in the same run: a benchmark that did not execute its instructions fails.

mod yardstick;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result, anyhow, bail, ensure};
use awl_asm::assemble::{Assembly, assemble};
use awl_asm::diagnostic::{Code, Severity};
use awl_asm::files::read_source;
use awl_asm::source::Source;
use plc_isa::{Header, LogicStack, M_START, Op};
use plc_vm::{Environment, Inputs, Memory, Mode, Plc};

use yardstick::{Measured, measure};

/// Bit instructions a second on the host, on one core. An hour of plant time at 1 ms scan and 1,000
/// instructions is 3.6 billion of them: it should take seconds.
pub const HOST_BITS_PER_SECOND_MIN: f64 = 200e6;

/// Lines a second through the whole assembler: parse, check, plan, encode. An editor can then
/// assemble at every keystroke.
pub const ASSEMBLER_LINES_PER_SECOND_MIN: f64 = 1e6;

/// A file of 100,000 lines, in seconds: nobody's program is longer, and nothing may be quadratic.
pub const LARGE_FILE_SECONDS_MAX: f64 = 0.5;

/// Bytes of code an instruction on average, in the examples: 7,680 bytes of slot must hold about
/// 3,000.
pub const CODE_BYTES_PER_INSTRUCTION_MAX: f64 = 2.6;

/// Measures, prints and compares. Only an optimised build has figures that mean anything.
///
/// # Errors
/// If a budget is missed, or something measured does not do what it should.
pub fn run() -> Result<()> {
    ensure!(!cfg!(debug_assertions), "only an optimised build is measured: --release");
    let figures = [host_interpreter()?, assembler()?, large_file()?, file_of_errors()?, density()?];
    let mut missed = 0;
    for figure in &figures {
        let good = if figure.lower_is_better {
            figure.value <= figure.budget
        } else {
            figure.value >= figure.budget
        };
        missed += usize::from(!good);
        let sign = if figure.lower_is_better { "<=" } else { ">=" };
        let verdict = if good { "good" } else { "MISSED" };
        println!(
            "{:<44} {:>10.2} {:<22} budget {sign} {:<8} {verdict}",
            figure.name, figure.value, figure.unit, figure.budget
        );
        println!("    {}", figure.evidence);
    }
    ensure!(missed == 0, "{missed} budgets missed");
    Ok(())
}

/// What the density of programs is measured with.
const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

struct Figure {
    name: &'static str,
    value: f64,
    unit: &'static str,
    budget: f64,
    lower_is_better: bool,
    evidence: String,
}

/// Time stands still, loops do not occur, instructions are counted when asked to.
struct Counting {
    executed: u64,
}

impl Environment for Counting {
    fn now_ms(&mut self) -> u32 {
        0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        true
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, _at: u16, _stack: LogicStack, _memory: &mut Memory) {
        self.executed += 1;
    }
}

/// The same without counting: what is measured.
struct Silent;

impl Environment for Silent {
    fn now_ms(&mut self) -> u32 {
        0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        true
    }
    fn retrigger_watchdog(&mut self) {}
}

const RUNG: &str = "LD I0.0\nO M0.1\nAN I0.2\nLPS\nA M1.3\n= Q0.1\nLPP\nON M2.4\n= M0.1\n\
    LDN I0.3\nA M3.0\nLD M0.5\nAN Q0.1\nOLD\nS M4.1, 1\nLD M4.1\nA I0.4\nR M4.1, 1\nNOT\n= M2.4\n";
const RUNGS: u64 = 150;
const RUNG_INSTRUCTIONS: u64 = 20;

fn host_interpreter() -> Result<Figure> {
    let text = format!("{}LD SM0.0\nINCW MW20\n", RUNG.repeat(RUNGS as usize));
    let image = assembled(&text)?.image.context("the benchmark program has errors")?;
    let per_scan = RUNGS * RUNG_INSTRUCTIONS;

    // The instructions executed in a scan, counted one by one: all that are in the image. Those
    // that the assembler puts in are not in the figure.
    let mut counting = Counting { executed: 0 };
    let (mut plc, mut memory) = loaded(&image)?;
    let all = plc.program().context("no program is loaded")?.instructions().count() as u64;
    plc.scan(&mut memory, &Inputs::default(), &mut counting);
    ensure!(
        counting.executed == all && all > per_scan,
        "executed {} instructions, not {all}",
        counting.executed
    );

    let scans_per_round: u16 = 20_000;
    let measured = measure(|| {
        let (mut plc, mut memory) = loaded(&image)?;
        let mut inputs = Inputs::default();
        let start = Instant::now();
        for scan in 0..scans_per_round {
            inputs.digital[0] = scan as u8;
            plc.scan(&mut memory, &inputs, &mut Silent);
        }
        let seconds = start.elapsed().as_secs_f64();
        // The program counts its own scans.
        ensure!(
            plc.mode() == Mode::Run && memory.word(M_START + 20) == scans_per_round,
            "the program did not run"
        );
        Ok(seconds)
    })?;
    let executed = per_scan * u64::from(scans_per_round);
    Ok(Figure {
        name: "host interpreter",
        value: executed as f64 / measured.usual_seconds() / 1e6,
        unit: "million bits/s",
        budget: HOST_BITS_PER_SECOND_MIN / 1e6,
        lower_is_better: false,
        evidence: format!(
            "{executed} bit instructions executed and counted {}",
            measured.evidence()
        ),
    })
}

fn loaded(image: &[u8]) -> Result<(Plc<&[u8]>, Memory)> {
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    if let Err(error) = plc.load(&mut memory, image) {
        bail!("the benchmark image is refused: {}", error.fault.message());
    }
    plc.run();
    Ok((plc, memory))
}

fn assembled(text: &str) -> Result<Assembly> {
    Ok(assemble(&Source::new("bench.awl", text)?, Vec::new()))
}

/// A program text of so many lines, with what real ones have: networks, comments, words, timers.
fn program_text(lines: usize) -> (String, usize) {
    let mut text = String::new();
    let (mut written, mut instructions, mut network) = (0, 0, 0);
    while written < lines {
        network += 1;
        let (byte, bit, timer) = (network % 31, network % 8, 37 + network % 27);
        let _ = write!(
            text,
            "NETWORK {network} // station {network}\n// what it does, in a line of comment\n\
             LD     I0.{}\nO      M{byte}.{bit}\nAN     \"Stop {}\"\n=      M{byte}.{bit}\n\
             LDW>=  MW{byte}, {network}\nA      T{timer}\nMOVW   +{network}, VW{} // note\n\
             TON    T{timer}, 10\n",
            network % 6,
            network % 4,
            2 * (network % 200),
        );
        written += 10;
        instructions += 8;
    }
    (text, instructions)
}

const SYMBOLS: &str = "//# board uno\n//# symbol \"Stop 0\" I0.0\n//# symbol \"Stop 1\" I0.1\n\
    //# symbol \"Stop 2\" I0.2\n//# symbol \"Stop 3\" I0.3\n";

/// Best time for a text of so many lines, and what was assembled. The text is larger than the
/// board: that one error is expected, and nothing else.
fn assembling_time(lines: usize) -> Result<(Measured, usize)> {
    let (text, instructions) = program_text(lines);
    let text = format!("{SYMBOLS}{text}");
    let measured = assembling(&text, |assembly| {
        let errors: Vec<Code> = assembly
            .diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.severity() == Severity::Error)
            .map(|diagnostic| diagnostic.code)
            .collect();
        ensure!(errors == [Code::ProgramTooLarge], "unexpected errors: {errors:?}");
        ensure!(
            assembly.lines.len() == instructions,
            "encoded {} of {instructions}",
            assembly.lines.len()
        );
        Ok(())
    })?;
    Ok((measured, instructions))
}

/// Best time of assembling a text; the result of every round is checked.
fn assembling(text: &str, mut check: impl FnMut(&Assembly) -> Result<()>) -> Result<Measured> {
    measure(|| {
        let start = Instant::now();
        let assembly = assembled(text)?;
        let seconds = start.elapsed().as_secs_f64();
        check(&assembly)?;
        Ok(seconds)
    })
}

fn assembler() -> Result<Figure> {
    let lines = 20_000;
    let (measured, instructions) = assembling_time(lines)?;
    Ok(Figure {
        name: "assembler",
        value: lines as f64 / measured.usual_seconds() / 1e6,
        unit: "million lines/s",
        budget: ASSEMBLER_LINES_PER_SECOND_MIN / 1e6,
        lower_is_better: false,
        evidence: format!(
            "{lines} lines, {instructions} instructions encoded, {}",
            measured.evidence()
        ),
    })
}

fn large_file() -> Result<Figure> {
    let lines = 100_000;
    let (measured, instructions) = assembling_time(lines)?;
    Ok(Figure {
        name: "assembler, 100,000 lines",
        value: measured.usual_seconds(),
        unit: "s",
        budget: LARGE_FILE_SECONDS_MAX,
        lower_is_better: true,
        evidence: format!("{instructions} instructions encoded {}", measured.evidence()),
    })
}

/// Mistakes must not cost more than what is right: every line has one, of several kinds.
fn file_of_errors() -> Result<Figure> {
    let wrong =
        ["LD Q0.9", "MOWW 5, MW0", "= Stopp", "TON T5, 5s", "LDW> MW0 5, 6, 7", "JMP 999", "ALD"];
    let lines = 100_000;
    let text: String =
        (0..lines).map(|line| format!("{} // {line}\n", wrong[line % wrong.len()])).collect();
    let text = format!("{SYMBOLS}{text}");
    let mut found = 0;
    let measured = assembling(&text, |assembly| {
        found = assembly.diagnostics.len();
        ensure!(
            found >= lines && assembly.image.is_none(),
            "{found} messages for {lines} wrong lines"
        );
        Ok(())
    })?;
    Ok(Figure {
        name: "assembler, 100,000 wrong lines",
        value: measured.usual_seconds(),
        unit: "s",
        budget: LARGE_FILE_SECONDS_MAX,
        lower_is_better: true,
        evidence: format!("{found} errors and warnings found {}", measured.evidence()),
    })
}

/// Bytes of code an instruction over the examples in one unit, without modules and segments: what
/// the encoding was made for. An instruction of a module takes two bytes and two for each operand;
/// in a segment each load takes three more.
fn density() -> Result<Figure> {
    let (mut bytes, mut instructions) = (0, 0);
    for entry in fs::read_dir(Path::new(EXAMPLES))? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "awl") {
            let assembly = assemble(&read_source(&path)?, Vec::new());
            let Some(image) = &assembly.image else { bail!("{} has errors", path.display()) };
            let header =
                Header::read(image).map_err(|error| anyhow!("{}: {error:?}", path.display()))?;
            let has_segments = || assembly.code.iter().any(|selected| selected.op == Op::Lscr);
            if header.modules_len > 0 || has_segments() {
                continue;
            }
            bytes += assembly.lines.iter().map(|line| u32::from(line.len)).sum::<u32>();
            instructions += assembly.lines.len();
        }
    }
    ensure!(instructions > 0, "no examples");
    Ok(Figure {
        name: "program density, plain examples",
        value: f64::from(bytes) / instructions as f64,
        unit: "bytes/instruction",
        budget: CODE_BYTES_PER_INSTRUCTION_MAX,
        lower_is_better: true,
        evidence: format!("{bytes} bytes of code for {instructions} instructions"),
    })
}
