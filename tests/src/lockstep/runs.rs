//! What is run side by side: cases and examples with their scenarios and plants, random programs.
//! How often is for the environment to say, see [`effort`].

use std::collections::BTreeSet;

use awl_asm::modules;
use awl_asm::native::TranslateError;
use awl_sim::machine::uno::{Code, Uno};
use plc_isa::{FREEPORT_MODULE, PULSES_MODULE};

use super::{Pair, board};
use crate::case::{Case, Prepared};
use crate::effort::effort;
use crate::forms::{Row, places};
use crate::random_runs::{Programs, random_image, random_scans};

/// Of so many random programs no more than one may be too large when it is translated.
const TOO_LARGE_RARITY: u64 = 10;

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
