//! Random programs in Structured Text on the board, interpreted and translated: after every scan all
//! is as on the host, where lang/st holds them against its evaluator. `RANDOM_PROGRAMS` and
//! `RANDOM_SEED` say how many, and from where on.
#![cfg(feature = "uno")]

#[path = "../../lang/st/tests/random_programs/generate.rs"]
mod generate;

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::native::TranslateError;
use awl_asm::source::Source;
use awl_sim::machine::uno::Code;
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;
use fastrand::Rng;
use generate::{Generator, VARIABLES};
use tests::effort::effort;
use tests::lockstep::{Pair, board};

const SCANS: usize = 12;
/// Of so many programs one must be there: others are too large for the board.
const RAN_RARITY: u64 = 4;

/// A program for the board; `None` where it is none.
fn assembled(seed: u64) -> Option<Assembly> {
    let source = Source::new("random.st", Generator::program(seed)).expect("a short text");
    let joined = project::join(vec![source]).unwrap_or_else(|found| panic!("{seed}: {found:?}"));
    let assembly = assemble(&joined.awl, Vec::new());
    // What is too large, or divides by a constant that came out as zero, is refused.
    (assembly.image.is_some() && assembly.misfit.is_empty()).then_some(assembly)
}

fn input(kind: &str, rng: &mut Rng) -> i32 {
    const EDGES: [i32; 8] = [0, 1, -1, 2, 5, 32767, -32768, 100];
    match kind {
        "BOOL" => rng.i32(..2),
        "REAL" => (f32::from(rng.i16(-1000..1000)) / 8.0).to_bits() as i32,
        _ if rng.bool() => rng.i32(-3..8),
        _ => EDGES[rng.usize(..EDGES.len())],
    }
}

/// Runs a program on both; the number of scans.
fn scans(pair: &mut Pair, assembly: &Assembly, seed: u64) -> u64 {
    let mut rng = Rng::with_seed(seed);
    let mut now_ms = 0;
    for scan in 1..=SCANS {
        // Before the first scan the board has no variables yet.
        if scan > 1 {
            for (kind, names) in VARIABLES {
                for name in names.iter().filter(|name| name.starts_with('g')) {
                    let value = input(kind, &mut rng);
                    // What the program does not use is nowhere.
                    if let Ok(operand) = Operand::parse(name, &assembly.program.symbols) {
                        let _ = pair.write(operand, value);
                    }
                }
            }
        }
        pair.scan(now_ms);
        let text = || Generator::program(seed);
        assert_eq!(pair.difference(), None, "seed {seed}, scan {scan}\n{}", text());
        if pair.mode() == Mode::Stop {
            return scan as u64;
        }
        now_ms += rng.u64(1..30);
    }
    SCANS as u64
}

fn assert_the_same(code: Code) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 100));
    let (mut uno, mut ran, mut all_scans) = (board(code), 0, 0);
    for seed in first..first + count {
        let Some(assembly) = assembled(seed) else { continue };
        let image = assembly.image.as_deref().expect("an image");
        match Pair::new(&mut uno, image, u32::MAX - 100) {
            Ok(mut pair) => {
                ran += 1;
                all_scans += scans(&mut pair, &assembly, seed);
            }
            Err(TranslateError::TooLarge { .. }) => {}
            Err(error) => panic!("seed {seed}: {error}\n{}", Generator::program(seed)),
        }
    }
    println!("{ran} of {count} programs fit, {all_scans} scans, all equal");
    assert!(ran * RAN_RARITY >= count, "only {ran} of {count} programs fit");
    assert!(all_scans >= 2 * ran, "the programs hardly ran");
}

#[test]
fn random_programs_are_the_same() {
    assert_the_same(Code::Bytecode);
}

#[test]
fn random_programs_are_the_same_translated() {
    assert_the_same(Code::Native);
}
