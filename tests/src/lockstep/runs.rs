//! What is run side by side: cases and examples with their scenarios and plants, random programs. How often is for the
//! environment to say, see [`effort`].

use std::ops::Range;

use awl_asm::Address;
use awl_asm::native::TranslateError;
use awl_sim::machine::uno::{Code, Uno};
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{AnalogInput, Area};

use super::{Pair, board};
use crate::case::{Case, Prepared};
use crate::effort::effort;
use crate::image::image;
use crate::naive::Inputs;
use crate::random::{random_inputs, random_program, random_step_ms};

/// Of so many random programs one is long, and how long: in instructions.
const LONG_RARITY: u32 = 10;
const LONG: Range<usize> = 220..600;
/// Of so many random programs no more than one may be too large when it is translated.
const TOO_LARGE_RARITY: u64 = 10;

/// Everything that is wrong with a case on both machines.
fn failures(uno: &mut Uno, case: &Prepared) -> Vec<String> {
    let failure = |text: String| format!("{}: {text}", case.case.file);
    let mut pair = match Pair::new(uno, &case.image, 0) {
        Ok(pair) => pair,
        Err(error) => return vec![failure(error.to_string())],
    };
    let mut failures = case.failures(&mut pair);
    failures.extend(pair.difference().map(|difference| failure(difference.to_string())));
    failures
}

/// Runs cases on the host and on a board that has the program in this form.
///
/// # Panics
/// If anything differs, or is not as the cases want it: with all of it.
pub fn assert_cases_are_the_same(code: Code, cases: Vec<Case>) {
    assert!(!cases.is_empty(), "there are no cases");
    let mut uno = board(code);
    let prepared = cases.into_iter().map(|case| case.prepare().unwrap_or_else(|errors| panic!("{errors}")));
    let found: Vec<String> = prepared.flat_map(|case| failures(&mut uno, &case)).collect();
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

/// A random program, its text, and the generator for what happens to it.
pub fn random_image(seed: u64) -> (Vec<u8>, String, Rng) {
    let mut rng = Rng::with_seed(seed);
    // Now and then so long that jumps are far and machine code may be too large.
    let size = if rng.u32(..LONG_RARITY) == 0 { rng.usize(LONG) } else { rng.usize(5..LONG.start) };
    let text = random_program(&mut rng, size);
    (image(&text), text, rng)
}

/// Runs random programs on the host and on a board that has them in this form: `RANDOM_PROGRAMS` many, from
/// `RANDOM_SEED` on.
///
/// # Panics
/// At the first difference, with seed and program; or if the test itself is worth nothing, because hardly any program
/// fits or runs.
pub fn assert_random_programs_are_the_same(code: Code) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 1_000));
    let (mut uno, mut scans, mut too_large) = (board(code), 0, 0);
    for seed in first..first + count {
        let (image, text, mut rng) = random_image(seed);
        // Near the wrap of the clock as often as not.
        let clock_ms = if rng.bool() { u32::MAX - rng.u32(..2_000) } else { rng.u32(..) };
        match Pair::new(&mut uno, &image, clock_ms) {
            Ok(pair) => scans += random_scans(pair, &mut rng, |scan| format!("seed {seed}, scan {scan}\n{text}")),
            Err(TranslateError::TooLarge { .. }) => too_large += 1,
            Err(error) => panic!("seed {seed}: {error}\n{text}"),
        }
    }
    println!("{count} programs, {too_large} of them too large, {scans} scans, all equal");
    assert!(too_large * TOO_LARGE_RARITY <= count, "{too_large} of {count} programs are too large");
    assert!(scans >= 2 * (count - too_large), "the programs hardly ran");
}

/// Runs a program with random inputs and times. Returns the number of scans; a difference is a panic.
fn random_scans(mut pair: Pair<'_>, rng: &mut Rng, place: impl Fn(u32) -> String) -> u64 {
    let (mut inputs, mut now_ms) = (Inputs::default(), 0);
    let count = rng.u32(3..40);
    for scan in 1..=count {
        inputs = random_inputs(rng, &inputs);
        set_inputs(&mut pair, &inputs);
        pair.scan(now_ms);
        assert_eq!(pair.difference(), None, "{}", place(scan));
        now_ms += u64::from(random_step_ms(rng));
        if pair.mode() == Mode::Stop {
            return scan.into();
        }
    }
    count.into()
}

fn set_inputs(machine: &mut impl Machine, inputs: &Inputs) {
    let bytes = (0..).zip(&inputs.digital).map(|(byte, &value)| (Address::Byte { area: Area::I, byte }, value.into()));
    let analog = (0..).zip(&inputs.ain);
    let analog = analog.map(|(channel, &counts)| (Address::Analog(AnalogInput::Raw(channel)), counts.into()));
    for (address, value) in bytes.chain(analog) {
        let written = machine.write(Operand::At(address), value);
        assert_eq!(written, Ok(()), "inputs can be set");
    }
}
