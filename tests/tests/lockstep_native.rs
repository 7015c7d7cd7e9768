//! The board with translated programs against the host, scan by scan: all cases, the examples with
//! their plants, random programs, bad images. `lockstep.rs` says how to run more of it.
#![cfg(feature = "uno")]

use awl_asm::native::translate;
use awl_sim::machine::Machine;
use awl_sim::machine::uno::Code;
use plc_isa::{ENTRY_LEN, Header, ImageError, ImageFault, NATIVE_INTERFACE, verify};
use plc_vm::Fault;
use tests::case::Case;
use tests::effort::effort;
use tests::image::{OnBoard, damaged, image, signed};
use tests::lockstep::{
    Programs, assert_cases_are_the_same, assert_random_programs_are_the_same, board, random_image,
};

#[test]
fn all_cases_are_the_same_translated() {
    assert_cases_are_the_same(Code::Native, Case::all());
}

#[test]
fn all_examples_are_the_same_translated() {
    assert_cases_are_the_same(Code::Native, Case::examples());
}

#[test]
fn random_programs_are_the_same_translated() {
    assert_random_programs_are_the_same(Code::Native, Programs::Core);
}

/// Comparisons and boxes of modules, immediate contacts, AENO, subroutines, sequences.
#[test]
fn random_modules_and_units_are_the_same_translated() {
    assert_random_programs_are_the_same(Code::Native, Programs::Short);
}

/// Translated images with a few bytes changed and the checksum right again, in what the loader can
/// check: header, tables, entry. The board says what the loader's check says on the host to a
/// memory that takes machine code.
#[test]
fn damaged_machine_code_is_refused_with_the_same_words() {
    // To this board images are given as they are.
    let mut uno = board(Code::Bytecode);
    let (mut refused, mut tried) = (0, 0);
    for seed in 1..=effort("RANDOM_PROGRAMS", 300) {
        let (image, _, mut rng) = random_image(seed, Programs::Core);
        let Ok(translated) = translate(&image) else { continue };
        let code_at = Header::read(&OnBoard(&translated.image)).unwrap().code_at();
        let image = damaged(&translated.image, &mut rng, 0..usize::from(code_at + ENTRY_LEN));
        tried += 1;
        // With other settings the program would run, with a wrong plan or entry do anything.
        let Err(error) = verify(OnBoard(&image)) else { continue };
        refused += 1;
        uno.load(image).unwrap();
        uno.scan(0);
        assert_eq!(
            (uno.fault_kind(), uno.broken()),
            (Some(Fault::BadImage(error)), None),
            "seed {seed}"
        );
    }
    println!("{refused} of {tried} images refused");
    assert!(refused > tried / 2, "only {refused} of {tried} images were bad");
}

#[test]
fn machine_code_for_another_interface_and_without_an_entry_is_refused() {
    let translated = translate(&image("LD I0.0\n= Q0.0\n")).unwrap().image;
    let code_at = Header::read(&OnBoard(&translated)).unwrap().code_at();
    let mut uno = board(Code::Bytecode);
    let mut fault_with = |at: u16, byte: u8| {
        let mut image = translated.clone();
        image[usize::from(at)] = byte;
        uno.load(signed(image)).unwrap();
        uno.scan(0);
        uno.fault_kind()
    };
    let fault_at = |at| Some(Fault::BadImage(ImageError { fault: ImageFault::Interface, at }));
    assert_eq!(fault_with(5, NATIVE_INTERFACE), None, "as it is");
    assert_eq!(fault_with(5, NATIVE_INTERFACE + 1), fault_at(5));
    assert_eq!(
        fault_with(code_at, translated[usize::from(code_at)] + 1),
        fault_at(code_at),
        "an odd entry"
    );
    assert_eq!(fault_with(code_at, 0), fault_at(code_at), "an entry in the header");
    assert_eq!(fault_with(code_at + 1, 0x1E), fault_at(code_at), "an entry after the slot");
}
