//! Host and board can run one interpreter: plc-vm with all its instructions, compiled for an AVR,
//! against the same source compiled for the host, after every scan. Cases, examples, random
//! programs, bad images.
//!
//! `RANDOM_PROGRAMS=10000 cargo test --release --package tests --features uno --test vm_on_avr`
//! runs longer, `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

use awl_sim::machine::Machine;
use fastrand::Rng;
use tests::case::Case;
use tests::effort::effort;
use tests::image::{damaged, image};
use tests::lockstep::random_scans;
use tests::random::{Offer, random_program_of};
use tests::vm_on_avr::{Chip, Pair};

/// What needs characters from outside.
const LEFT_OUT: [&str; 3] = ["cases/communication/", "examples/barcode", "examples/clock"];

/// In two halves, on two processors, one of so many cases; `CASES_STEP=2` compares all in a minute.
#[test]
fn cases_are_the_same() {
    cases_from(0);
}

#[test]
fn the_other_cases_are_the_same() {
    cases_from(1);
}

fn cases_from(half: usize) {
    let (mut chip, mut found, mut left_out) = (Chip::start(), Vec::new(), 0);
    let step = usize::try_from(effort("CASES_STEP", 6)).unwrap_or(6).max(2);
    let cases = Case::all().into_iter().chain(Case::examples()).skip(half).step_by(step);
    for case in cases.map(|case| case.prepare().unwrap_or_else(|errors| panic!("{errors}"))) {
        let is_left_out = LEFT_OUT.iter().any(|name| case.case.file.contains(name));
        if case.has_actions() || is_left_out {
            left_out += 1;
            continue;
        }
        let mut pair = Pair::new(&mut chip, &case.image, 0);
        found.extend(case.failures(&mut pair));
        found.extend(
            pair.difference().map(|difference| format!("{}: {difference}", case.case.file)),
        );
    }
    println!("{left_out} cases with pulses, characters or a clock that is set are not compared");
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

#[test]
fn random_programs_of_the_core_are_the_same() {
    random_programs(150, |_| Offer::core());
}

#[test]
fn random_programs_of_everything_are_the_same() {
    random_programs(100, Offer::everything);
}

fn random_programs(usual_count: u64, offer: fn(&mut Rng) -> Offer) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", usual_count));
    let (mut chip, mut scans) = (Chip::start(), 0);
    for seed in first..first + count {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(5..220);
        let offer = offer(&mut rng);
        let text = random_program_of(&mut rng, size, offer);
        let clock_ms = if rng.bool() { u32::MAX - rng.u32(..2_000) } else { rng.u32(..) };
        let mut pair = Pair::new(&mut chip, &image(&text), clock_ms);
        let place = |scan| format!("seed {seed}, scan {scan}\n{text}");
        scans += random_scans(&mut pair, &mut rng, Pair::difference, place);
    }
    println!("{count} programs, {scans} scans, all equal");
    assert!(scans >= 2 * count, "the programs hardly ran");
}

/// The loader says the same on both, or the program runs.
#[test]
fn damaged_images_are_refused_with_the_same_words() {
    let (mut chip, mut refused) = (Chip::start(), 0);
    let count = effort("RANDOM_PROGRAMS", 100);
    for seed in 1..=count {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(5..60);
        let offer = Offer::everything(&mut rng);
        let image = image(&random_program_of(&mut rng, size, offer));
        let image = damaged(&image, &mut rng, 0..image.len());
        let pair = Pair::new(&mut chip, &image, 0);
        assert_eq!(pair.difference(), None, "seed {seed}");
        refused += u64::from(pair.fault().is_some());
    }
    println!("{refused} of {count} images refused");
    assert!(refused > 0, "none of {count} images was bad");
}

/// The comparison must see what is different: here the chip has another program.
#[test]
fn a_difference_is_seen() {
    let mut chip = Chip::start();
    let mut pair = Pair::new(&mut chip, &image("LD SM0.0\n= Q0.0\n"), 0);
    pair.scan(0);
    assert_eq!(pair.difference(), None);
    pair.load_on_chip(&image("LD SM0.0\n= Q0.0\n= M0.7\n"));
    pair.scan(1);
    let found = pair.difference().unwrap_or_default();
    assert!(found.contains("0x0120"), "{found}");
}
