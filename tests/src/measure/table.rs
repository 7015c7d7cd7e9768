//! Makes the table of `awl-asm/src/output/cost/interpreter.rs` by measuring every form of every
//! instruction, and constants beside. Not used by tests, which hold the table against other
//! programs.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use awl_asm::cost::interpreter::more;
use awl_asm::native::{Options, translate_with};
use fastrand::Rng;
use plc_isa::{Kind, Op, PowerFlow};

use super::forms::situation;
use super::module_rows::MODULE_CHAPTERS;
use super::rows::{CHAPTERS, Row};
use super::{Executable, Execution, Meter, Step, Tier, values};
use crate::case::Case;
use crate::random::{random_interrupts, random_program};

/// Fewest and most cycles.
type Range = Option<(u64, u64)>;

/// A form's ways: to the next instruction without and with power flow, and to elsewhere.
#[derive(Default)]
struct Ways {
    off: Range,
    on: Range,
    away: Range,
}

/// Scans of each program.
const SCANS: usize = 100;
/// Random programs beside those of the rows.
const RANDOM: u64 = 1_500;

/// The table as source text.
pub fn table() -> String {
    let mut found: BTreeMap<(Op, String), Ways> = BTreeMap::new();
    let mut start = 0;
    for row in CHAPTERS.iter().flat_map(|chapter| chapter.rows).chain(analog()) {
        let mut meter = Meter::new(Executable::new(row.awl, &row.program().0, Tier::Interpreter));
        meter.board.stop_clock();
        let mut rng = Rng::with_seed(1);
        for _ in 0..SCANS {
            situation(&mut meter, &mut rng);
            values::write(&mut meter, row.items, 0, &mut rng);
            let execution = meter.execute();
            start = start.max(enter(&meter, &execution, &mut found));
        }
    }
    for seed in 0..RANDOM {
        let mut rng = Rng::with_seed(1_000_000 + seed);
        // Away from those that the tests take.
        let text = random_program(&mut rng, 80);
        any_inputs(&text, 150, &mut rng, &mut found);
    }
    for text in units() {
        // What looks for events takes longer for each millisecond: that is apart.
        any_inputs(&text, 2, &mut Rng::with_seed(1), &mut found);
    }
    native_constants(&found) + &text(start, &found)
}

/// Rows of modules with an instruction that has no row: what hands analog outputs to the timer.
fn analog() -> impl Iterator<Item = &'static Row> {
    let rows = MODULE_CHAPTERS.iter().flat_map(|chapter| chapter.rows);
    rows.filter(|row| row.awl.contains("AQW"))
}

/// What calls between the engine and machine code take: constants of
/// `awl-asm/src/output/cost/mod.rs`, and of `awl-asm/src/output/native/vectors.rs`.
fn native_constants(found: &BTreeMap<(Op, String), Ways>) -> String {
    let executable =
        Executable::new("native", "LD T32\n= Q0.0\nTON T32, 5\n", Tier::Native { pins: false });
    let translated = translate_with(&executable.bytecode, Options { pins: false });
    let translated = translated.unwrap_or_else(|error| panic!("{error}"));
    let end = translated.instructions.last().map_or(0, |end| end.cycles.max);
    let mut meter = Meter::new(executable);
    meter.board.stop_clock();
    let steps = meter.execute().steps;
    let cycles = |step: Option<&Step>| step.map_or(0, |step| step.cycles);
    // The first instruction is the hidden one, which the firmware executes for a call with two
    // words.
    let refresh = found.get(&(Op::Refresh, "[]".to_string())).and_then(|ways| ways.off.or(ways.on));
    let call = 2 + 4;
    format!(
        "pub const NATIVE_START: u32 = {};\npub const NATIVE_END: u32 = {};\n\
            const BYTECODE: u32 = {};\n",
        cycles(steps.first()) - u64::from(translated.start.max),
        cycles(steps.last()) - u64::from(end),
        cycles(steps.get(1)).saturating_sub(refresh.map_or(0, |(least, _)| least) + call),
    )
}

/// Programs that have routines, segments or interrupts.
fn units() -> Vec<String> {
    let has_units =
        |awl: &String| ["_BLOCK", "LSCR", "AENO", "ATCH"].iter().any(|word| awl.contains(word));
    let cases =
        Case::examples().into_iter().chain(Case::all()).filter(|case| case.faults.is_empty());
    let random = (0..RANDOM / 10).map(|seed| random_interrupts(&mut Rng::with_seed(seed)));
    cases.map(|case| case.awl).filter(has_units).chain(random).collect()
}

/// Runs scans with any inputs, and less than so many milliseconds from one to the next.
fn any_inputs(text: &str, ms_end: u32, rng: &mut Rng, found: &mut BTreeMap<(Op, String), Ways>) {
    let mut meter = Meter::new(Executable::new("random", text, Tier::Interpreter));
    meter.board.stop_clock();
    for _ in 0..20 {
        meter.board.drive_inputs(rng.u8(..64));
        meter.pass(rng.u32(..ms_end));
        let execution = meter.execute();
        enter(&meter, &execution, found);
    }
}

/// Enters what was measured; returns the cycles before the first instruction.
fn enter(meter: &Meter, execution: &Execution, found: &mut BTreeMap<(Op, String), Ways>) -> u64 {
    let (code, plan) = (&meter.executable.code, meter.executable.plan());
    let mut jumps_back = 0;
    for (index, step) in execution.steps.iter().enumerate() {
        let Some((number, (_, decoded))) =
            step.instruction.and_then(|number| Some((number, code.get(number)?)))
        else {
            continue;
        };
        let kinds: Vec<Kind> = decoded.operands().map(|(kind, _)| kind).collect();
        let ways = found.entry((decoded.op, format!("{kinds:?}"))).or_default();
        let more = more(decoded, &plan, &meter.executable.bytecode, step.count.map(u32::from));
        let is_off = !step.flow && decoded.op.instruction().power_flow == PowerFlow::Needed;
        // Nothing is added to a box without power flow.
        let cycles = if is_off { step.cycles } else { step.cycles.saturating_sub(more.into()) };
        let next = execution.steps.get(index + 1).and_then(|next| next.instruction);
        // The first in a scan finds that time has passed.
        let is_back = matches!(decoded.op, Op::Jmp | Op::Next);
        jumps_back += usize::from(is_back && next.is_some_and(|next| next <= number));
        if is_back && jumps_back == 1 && next.is_some_and(|next| next <= number) {
            continue;
        }
        let follows = next == Some(number + 1);
        let way = match (follows, step.flow) {
            (true, false) => &mut ways.off,
            (true, true) => &mut ways.on,
            (false, _) => &mut ways.away,
        };
        let (min, max) = way.unwrap_or((cycles, cycles));
        *way = Some((min.min(cycles), max.max(cycles)));
    }
    execution.steps.first().map_or(0, |step| step.cycles)
}

fn text(start: u64, found: &BTreeMap<(Op, String), Ways>) -> String {
    let mut text = format!("pub const START: u32 = {start};\n\nconst TABLE: &[Entry] = &[\n");
    for ((op, kinds), ways) in found {
        let range = |range: Range| {
            range.map_or("[0, 0]".to_string(), |(min, max)| format!("[{min}, {max}]"))
        };
        let _ = writeln!(
            text,
            "    (Op::{op:?}, &{kinds}, {}, {}, {}),",
            range(ways.off),
            range(ways.on),
            range(ways.away)
        );
    }
    text + "];\n"
}
