//! Cases and random programs in Structured Text, random charts, and random blocks of IEC 61499,
//! host and board side by side: interpreted and translated. What they mean is for the tests of
//! their languages to say.
//!
//! `RANDOM_PROGRAMS=5000 cargo test --package tests --features uno --test lockstep_languages` runs
//! longer, `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

#[path = "../../lang/fb/tests/random_blocks/generate.rs"]
mod block;
#[path = "../../lang/chart/tests/charts/random_grafcet.rs"]
mod random_grafcet;
#[path = "../../lang/chart/tests/charts/random_text.rs"]
mod random_text;
#[path = "../../lang/st/tests/random_programs/generate/mod.rs"]
mod structured;

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::diagnostic::Severity;
use awl_asm::native::TranslateError;
use awl_asm::source::Source;
use awl_sim::machine::Machine;
use awl_sim::machine::uno::Code;
use awl_sim::operand::Operand;
use fastrand::Rng;
use tests::case::Case;
use tests::effort::effort;
use tests::lockstep::{Pair, assert_cases_are_the_same, board};

/// Programs of an ordinary run; a scan of one takes the board up to 50 ms.
const PROGRAMS: u64 = 20;
const SCANS: u32 = 12;

/// What is written before a scan: types and names.
type Inputs = Vec<(&'static str, String)>;

/// The inputs of the program of a seed.
type InputsOf<'i> = &'i dyn Fn(u64) -> Inputs;

/// The image with its symbols; `None`: there are errors, or the board has no room for it.
fn compiled(file: &str, text: &str) -> Option<(Vec<u8>, Assembly)> {
    let source = Source::new(file, text).expect("a short text");
    let joined = project::join(vec![source]).ok()?;
    let mut assembly = assemble(&joined.awl, Vec::new());
    assembly.require_board();
    let is_wrong = assembly.diagnostics.iter().any(|one| one.severity() == Severity::Error);
    let image = assembly.image.take().filter(|_| !is_wrong)?;
    Some((image, assembly))
}

fn value(kind: &str, rng: &mut Rng) -> i32 {
    let edges = [0, 1, -1, 2, 5, 100, 32767, -32768];
    let small = edges[rng.usize(..edges.len())];
    match kind {
        "BOOL" => rng.bool().into(),
        "REAL" => (f32::from(rng.i16(-1000..1000)) / 8.0).to_bits() as i32,
        "SINT" | "USINT" => rng.u8(..).into(),
        "DINT" | "UDINT" if rng.bool() => small * 65_535,
        _ if rng.bool() => rng.i32(-3..8),
        _ => small,
    }
}

/// # Panics
/// At the first difference, with seed and program; or if hardly any program fits.
fn assert_same(code: Code, file: &str, program: fn(u64) -> String, inputs: InputsOf) {
    let (first, count) = (effort("RANDOM_SEED", 0), effort("RANDOM_PROGRAMS", PROGRAMS));
    let (mut uno, mut compared) = (board(code), 0);
    for seed in first..first + count {
        let text = program(seed);
        let Some((image, assembly)) = compiled(file, &text) else { continue };
        let mut rng = Rng::with_seed(seed);
        let mut pair = match Pair::new(&mut uno, &image, rng.u32(..)) {
            Ok(pair) => pair,
            Err(TranslateError::TooLarge { .. }) => continue,
            Err(error) => panic!("seed {seed}: {error}\n{text}"),
        };
        let (mut now_ms, inputs) = (0, inputs(seed));
        for scan in 1..=SCANS {
            for (kind, name) in &inputs {
                // What the program does not use is nowhere.
                if let Ok(operand) = Operand::parse(name, &assembly.program.symbols) {
                    let _ = pair.write(operand, value(kind, &mut rng));
                }
            }
            pair.scan(now_ms);
            assert_eq!(pair.difference(), None, "seed {seed}, scan {scan}\n{text}");
            // A random block need not come to rest: both say so.
            if pair.fault().is_some() && file.ends_with(".fbt") {
                break;
            }
            assert_eq!(pair.fault(), None, "seed {seed}, scan {scan}\n{text}");
            now_ms += rng.u64(1..30);
        }
        compared += 1;
    }
    println!("{count} programs, {compared} of them fit and are equal");
    assert!(compared * 5 >= count, "only {compared} of {count} programs fit");
}

fn assert_structured_text_is_the_same(code: Code) {
    let all = structured::VARIABLES.iter().flat_map(|(kind, names)| {
        let written = names.iter().filter(|name| name.starts_with('g'));
        written.map(|name| (*kind, (*name).to_owned()))
    });
    let small = |seed| structured::Generator::program(structured::SMALL * seed);
    let all: Inputs = all.collect();
    assert_same(code, "r.st", small, &|_| all.clone());
}

fn assert_charts_are_the_same(code: Code, program: fn(u64) -> String) {
    let inputs = random_text::INPUTS.map(|name| ("BOOL", format!("Main.{name}")));
    assert_same(code, "r.sfc", program, &|_| inputs.to_vec());
}

fn assert_blocks_are_the_same(code: Code) {
    let program = |seed| fb::xml::write(&block::Generator::block(seed, false));
    let inputs = |seed| {
        let fb::Block { event_inputs, inputs, .. } = block::Generator::block(seed, false);
        let events = event_inputs.into_iter().map(|one| ("BOOL", one.name.text));
        events.chain(inputs.into_iter().map(|one| (one.of_type.name(), one.name.text))).collect()
    };
    assert_same(code, "r.fbt", program, &inputs);
}

#[test]
fn cases_are_the_same_on_the_board() {
    assert_cases_are_the_same(Code::Bytecode, Case::structured());
}

#[test]
fn cases_are_the_same_translated() {
    assert_cases_are_the_same(Code::Native, Case::structured());
}

#[test]
fn structured_text_is_the_same_on_the_board() {
    assert_structured_text_is_the_same(Code::Bytecode);
}

#[test]
fn structured_text_is_the_same_translated() {
    assert_structured_text_is_the_same(Code::Native);
}

#[test]
fn charts_are_the_same_on_the_board() {
    assert_charts_are_the_same(Code::Bytecode, random_text::program);
}

#[test]
fn charts_are_the_same_translated() {
    assert_charts_are_the_same(Code::Native, random_text::program);
}

#[test]
fn grafcets_are_the_same_on_the_board() {
    assert_charts_are_the_same(Code::Bytecode, random_grafcet::program);
}

#[test]
fn grafcets_are_the_same_translated() {
    assert_charts_are_the_same(Code::Native, random_grafcet::program);
}

#[test]
fn blocks_are_the_same_on_the_board() {
    assert_blocks_are_the_same(Code::Bytecode);
}

#[test]
fn blocks_are_the_same_translated() {
    assert_blocks_are_the_same(Code::Native);
}
