//! What is run side by side: cases and examples with their scenarios and plants, random programs.
//! How often is for the environment to say, see [`effort`].

use std::collections::BTreeSet;
use std::ops::Range;

use awl_asm::Address;
use awl_asm::modules;
use awl_asm::native::TranslateError;
use awl_sim::machine::uno::{Code, Uno};
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{AnalogInput, Area, FREEPORT_MODULE, PULSES_MODULE};

use super::{Pair, board};
use crate::case::{Case, Prepared};
use crate::effort::effort;
use crate::forms::{Row, places};
use crate::image::image;
use crate::naive::Inputs;
use crate::random::{Offer, random_inputs, random_program_of, random_step_ms};

/// Of so many random programs one is long, and how long: in instructions.
const LONG_RARITY: u32 = 10;
const LONG: Range<usize> = 220..600;
/// Of so many random programs no more than one may be too large when it is translated.
const TOO_LARGE_RARITY: u64 = 10;

/// What random programs consist of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Programs {
    /// Instructions of the core, in one unit.
    Core,
    /// Everything that a board has.
    Everything,
    /// The same in programs that are short enough to be translated.
    Short,
}

/// How long these are.
const SHORT: Range<usize> = 5..100;

/// What the board does not have of an image's instructions, by their rows. And pulses and the
/// freeport, which have a time of their own there.
fn missing(image: &[u8]) -> BTreeSet<String> {
    const OWN_TIME: [u8; 2] = [PULSES_MODULE, FREEPORT_MODULE];
    let is_missing = |row: &Row| {
        let lacks = |module| {
            OWN_TIME.contains(&module) || modules::routines(module) <= row.form.first_token
        };
        row.instruction.module().is_some_and(lacks)
    };
    let rows = places(image).into_iter().map(|place| place.row);
    rows.filter(is_missing).map(|row| row.name()).collect()
}

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
    let prepared =
        cases.into_iter().map(|case| case.prepare().unwrap_or_else(|errors| panic!("{errors}")));
    let (mut left_out, mut found) = (BTreeSet::new(), Vec::new());
    for case in prepared {
        let mut missing = missing(&case.image);
        if case.has_actions() {
            missing.insert("pulses and the clock of scenarios".to_string());
        }
        if missing.is_empty() {
            found.extend(failures(&mut uno, &case));
        }
        left_out.extend(missing);
    }
    println!("not compared: {left_out:?}");
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

/// A random program, its text, and the generator for what happens to it.
pub fn random_image(seed: u64, programs: Programs) -> (Vec<u8>, String, Rng) {
    let mut rng = Rng::with_seed(seed);
    // Now and then so long that jumps are far and machine code may be too large.
    let size = match programs {
        Programs::Short => rng.usize(SHORT),
        _ if rng.u32(..LONG_RARITY) == 0 => rng.usize(LONG),
        _ => rng.usize(5..LONG.start),
    };
    let offer = match programs {
        Programs::Core => Offer::core(),
        Programs::Everything | Programs::Short => Offer::board(&mut rng),
    };
    let text = random_program_of(&mut rng, size, offer);
    (image(&text), text, rng)
}

/// Runs random programs on the host and on a board that has them in this form: `RANDOM_PROGRAMS`
/// many, from `RANDOM_SEED` on.
///
/// # Panics
/// At the first difference, with seed and program; or if the test itself is worth nothing, because
/// hardly any program fits or runs.
pub fn assert_random_programs_are_the_same(code: Code, programs: Programs) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 1_000));
    let (mut uno, mut scans, mut too_large) = (board(code), 0, 0);
    for seed in first..first + count {
        let (image, text, mut rng) = random_image(seed, programs);
        // Near the wrap of the clock as often as not.
        let clock_ms = if rng.bool() { u32::MAX - rng.u32(..2_000) } else { rng.u32(..) };
        match Pair::new(&mut uno, &image, clock_ms) {
            Ok(mut pair) => {
                let place = |scan| format!("seed {seed}, scan {scan}\n{text}");
                scans += random_scans(&mut pair, &mut rng, Pair::difference, place);
            }
            Err(TranslateError::TooLarge { .. }) => too_large += 1,
            Err(error) => panic!("seed {seed}: {error}\n{text}"),
        }
    }
    println!("{count} programs, {too_large} of them too large, {scans} scans, all equal");
    assert!(too_large * TOO_LARGE_RARITY <= count, "{too_large} of {count} programs are too large");
    assert!(scans >= 2 * (count - too_large), "the programs hardly ran");
}

/// Runs a program with random inputs and times. Returns the number of scans; a difference is a
/// panic.
pub fn random_scans<M: Machine>(
    pair: &mut M,
    rng: &mut Rng,
    difference: impl Fn(&M) -> Option<&str>,
    place: impl Fn(u32) -> String,
) -> u64 {
    let (mut inputs, mut now_ms) = (Inputs::default(), 0);
    let count = rng.u32(3..40);
    for scan in 1..=count {
        inputs = random_inputs(rng, &inputs);
        set_inputs(pair, &inputs);
        pair.scan(now_ms);
        assert_eq!(difference(pair), None, "{}", place(scan));
        now_ms += u64::from(random_step_ms(rng));
        if pair.mode() == Mode::Stop {
            return scan.into();
        }
    }
    count.into()
}

fn set_inputs(machine: &mut impl Machine, inputs: &Inputs) {
    let bytes = (0..)
        .zip(&inputs.digital)
        .map(|(byte, &value)| (Address::Byte { area: Area::I, byte }, value.into()));
    let analog = (0..).zip(&inputs.ain);
    let analog = analog
        .map(|(channel, &counts)| (Address::Analog(AnalogInput::Raw(channel)), counts.into()));
    for (address, value) in bytes.chain(analog) {
        let written = machine.write(Operand::At(address), value);
        assert_eq!(written, Ok(()), "inputs can be set");
    }
}
