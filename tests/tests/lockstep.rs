//! The board against the host, scan by scan: all cases, the examples with their plants, random programs, bad images.
//!
//! `RANDOM_PROGRAMS=10000 cargo test --release --package tests --features uno --test lockstep` runs longer,
//! `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

use awl_asm::Address;
use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use awl_sim::machine::uno::Uno;
use awl_sim::machine::{Machine, Mode};
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{AnalogInput, Area, CRC_LEN, Crc32, SLOT_LEN};
use tests::case::{Case, Prepared};
use tests::effort::effort;
use tests::lockstep::{Pair, board};
use tests::naive::Inputs;
use tests::random::{random_inputs, random_program, random_step_ms};

/// Everything that is wrong with a case on both machines.
fn failures(uno: &mut Uno, case: &Prepared) -> Vec<String> {
    let mut pair = Pair::new(uno, &case.image, 0);
    let mut failures = case.failures(&mut pair);
    failures.extend(pair.difference().map(|difference| format!("{}: {difference}", case.case.file)));
    failures
}

fn assert_same(cases: Vec<Case>) {
    let mut uno = board();
    let prepared = cases.into_iter().map(|case| case.prepare().unwrap_or_else(|errors| panic!("{errors}")));
    let found: Vec<String> = prepared.flat_map(|case| failures(&mut uno, &case)).collect();
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

#[test]
fn all_cases_are_the_same_on_the_board() {
    assert_same(Case::all());
}

#[test]
fn all_examples_are_the_same_on_the_board() {
    assert_same(Case::examples());
}

fn random_image(seed: u64) -> (Vec<u8>, String, Rng) {
    let mut rng = Rng::with_seed(seed);
    let size = rng.usize(5..220);
    let text = random_program(&mut rng, size);
    let assembly = assemble(&Source::new(format!("seed {seed}"), &*text).unwrap(), Vec::new());
    (assembly.image.unwrap_or_else(|| panic!("seed {seed}\n{text}")), text, rng)
}

fn set_inputs(machine: &mut impl Machine, inputs: &Inputs) {
    let bytes = (0..).zip(&inputs.digital).map(|(byte, &value)| (Address::Byte { area: Area::I, byte }, value.into()));
    let analog = (0..).zip(&inputs.ain);
    let analog = analog.map(|(channel, &counts)| (Address::Analog(AnalogInput::Raw(channel)), counts.into()));
    for (address, value) in bytes.chain(analog) {
        machine.write(Operand::At(address), value).unwrap();
    }
}

#[test]
fn random_programs_are_the_same_on_the_board() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 300));
    let (mut uno, mut scans) = (board(), 0);
    for seed in first..first + count {
        let (image, text, mut rng) = random_image(seed);
        // Near the wrap of the clock as often as not.
        let clock_ms = if rng.bool() { u32::MAX - rng.u32(..2_000) } else { rng.u32(..) };
        let mut pair = Pair::new(&mut uno, &image, clock_ms);
        let (mut inputs, mut now_ms) = (Inputs::default(), 0);
        for _ in 0..rng.u32(3..40) {
            inputs = random_inputs(&mut rng, &inputs);
            set_inputs(&mut pair, &inputs);
            pair.scan(now_ms);
            scans += 1;
            assert_eq!(pair.difference(), None, "seed {seed}\n{text}");
            now_ms += u64::from(random_step_ms(&mut rng));
            if pair.mode() == Mode::Stop {
                break;
            }
        }
    }
    println!("{count} programs, {scans} scans, all equal");
    assert!(scans >= 2 * count, "the programs hardly ran");
}

/// Images with a few bytes changed and the checksum right again: the loader says the same on both, or the program runs.
#[test]
fn damaged_images_are_refused_with_the_same_words() {
    let (mut uno, mut refused) = (board(), 0);
    let count = effort("RANDOM_PROGRAMS", 300);
    for seed in 1..=count {
        let (mut image, _, mut rng) = random_image(seed);
        let end = image.len() - usize::from(CRC_LEN);
        for _ in 0..rng.u32(1..4) {
            let at = rng.usize(..end);
            image[at] = rng.u8(..);
        }
        let crc = Crc32::of(&image[..end]).to_le_bytes();
        image[end..].copy_from_slice(&crc);
        // The board does not know the length of a file.
        image.resize(usize::from(SLOT_LEN), 0xFF);
        let mut pair = Pair::new(&mut uno, &image, 0);
        // A changed program may loop for ever; that it does so on both is another test's matter.
        if pair.fault().is_none() {
            continue;
        }
        refused += 1;
        pair.scan(0);
        assert_eq!(pair.difference(), None, "seed {seed}");
    }
    assert!(refused > count / 2, "only {refused} of {count} images were bad");
}
