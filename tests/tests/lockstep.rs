//! The interpreting board against the host, scan by scan: all cases, the examples with their
//! plants, random programs, bad images. `lockstep_native.rs` is the same for translated programs.
//!
//! `RANDOM_PROGRAMS=10000 cargo test --release --package tests --features uno --test lockstep` runs
//! longer, `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

use awl_sim::machine::Machine;
use awl_sim::machine::uno::Code;
use plc_isa::{NATIVE_INTERFACE, module_of_token, verify};
use tests::case::Case;
use tests::effort::effort;
use tests::image::{INTERFACE_AT, damaged};
use tests::lockstep::{
    Pair, Programs, assert_cases_are_the_same, assert_random_programs_are_the_same, board,
    random_image,
};

#[test]
fn all_cases_are_the_same_on_the_board() {
    assert_cases_are_the_same(Code::Bytecode, Case::all());
}

#[test]
fn all_examples_are_the_same_on_the_board() {
    assert_cases_are_the_same(Code::Bytecode, Case::examples());
}

#[test]
fn random_programs_are_the_same_on_the_board() {
    assert_random_programs_are_the_same(Code::Bytecode, Programs::Core);
}

#[test]
fn modules_and_units_are_the_same_on_the_board() {
    assert_random_programs_are_the_same(Code::Bytecode, Programs::Everything);
}

/// A few bytes changed and the checksum right again: the loader says the same on both, or the
/// program runs.
#[test]
fn damaged_images_are_refused_with_the_same_words() {
    let (mut uno, mut refused) = (board(Code::Bytecode), 0);
    let count = effort("RANDOM_PROGRAMS", 300);
    for seed in 1..=count {
        let (image, _, mut rng) = random_image(seed, Programs::Core);
        let image = damaged(&image, &mut rng, 0..image.len());
        // The board alone runs machine code: what it says to it is a matter of
        // `lockstep_native.rs`.
        if image[INTERFACE_AT] == NATIVE_INTERFACE {
            continue;
        }
        // A token of a module: the board knows only modules that are in the image.
        let of_module = |at: u16| module_of_token(image[usize::from(at)]).is_some();
        if verify(image.as_slice()).is_err_and(|error| of_module(error.at)) {
            continue;
        }
        let mut pair = Pair::new(&mut uno, &image, 0).unwrap();
        // A changed program may loop for ever; that it does so on both is another test's matter.
        if pair.fault().is_none() {
            continue;
        }
        refused += 1;
        pair.scan(0);
        assert_eq!(pair.difference(), None, "seed {seed}");
    }
    println!("{refused} of {count} images refused");
    assert!(refused > count / 2, "only {refused} of {count} images were bad");
}
