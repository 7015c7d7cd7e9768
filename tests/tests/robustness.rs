//! Bad input of every kind: images and texts that nobody meant. Never a panic, a hang or a write
//! outside the plan.
//!
//! `RANDOM_IMAGES`, `RANDOM_TEXTS` and `RANDOM_SEED` in the environment make the runs longer or
//! different.

use std::fs;
use std::path::{Path, PathBuf};

use awl_asm::assemble::assemble_for;
use awl_asm::disassemble::disassemble;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{C_BITS_START, CRC_LEN, FORMAT_AT, HOST, Header, UNO};
use plc_vm::{Inputs, Memory, Plc};
use tests::effort::effort;
use tests::fuzz::{TARGETS, read_text, run_image};
use tests::image::sign;
use tests::mutate::mutate;
use tests::random::random_program;

/// Images of random programs to start from, every other one in the wide format.
fn images(rng: &mut Rng, count: usize) -> Vec<Vec<u8>> {
    let image = |number: usize| {
        let size = rng.usize(3..60);
        let source = Source::new("corpus", random_program(rng, size)).unwrap();
        let profile = if number.is_multiple_of(2) { &UNO } else { &HOST };
        let image = assemble_for(&source, Vec::new(), &[], profile).image?;
        assert_eq!(image[usize::from(FORMAT_AT)], profile.format(), "the image of its profile");
        Some(image)
    };
    (0..count).filter_map(image).collect()
}

fn change_bytes(rng: &mut Rng, image: &mut [u8], from: usize) {
    for _ in 0..rng.usize(1..8) {
        if from < image.len() {
            let at = rng.usize(from..image.len());
            image[at] = match rng.u8(..4) {
                0 => rng.u8(..),
                1 => image[at] ^ 1 << rng.u8(..8),
                2 => image[at].wrapping_add(1),
                _ => image[rng.usize(..image.len())],
            };
        }
    }
}

/// One image that nobody meant.
fn random_image(rng: &mut Rng, corpus: &[Vec<u8>]) -> Vec<u8> {
    let mut image = corpus[rng.usize(..corpus.len())].clone();
    let code_at = Header::read(&image.as_slice()).map_or(0, |header| usize::from(header.code_at()));
    match rng.u8(..8) {
        // Noise.
        0 => return (0..rng.usize(..120)).map(|_| rng.u8(..)).collect(),
        // A stored image that decayed.
        1 => change_bytes(rng, &mut image, 0),
        // Cut off.
        2 => image.truncate(rng.usize(..image.len())),
        // Noise after a sound header.
        3 => {
            let end = image.len() - usize::from(CRC_LEN) - 1;
            image[code_at..end].iter_mut().for_each(|byte| *byte = rng.u8(..));
            sign(&mut image);
        }
        // Header and tables of a liar.
        4 => {
            change_bytes(rng, &mut image[..code_at], 5);
            sign(&mut image);
        }
        // Code of a liar.
        _ => {
            change_bytes(rng, &mut image, code_at);
            sign(&mut image);
        }
    }
    image
}

#[test]
fn random_images_never_do_harm() {
    let (seed, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_IMAGES", 200_000));
    let mut rng = Rng::with_seed(seed);
    let (mut corpus, mut accepted) = (images(&mut rng, 300), 0);
    for number in 0..count {
        if number % 100_000 == 99_999 {
            corpus = images(&mut rng, 300);
        }
        let image = random_image(&mut rng, &corpus);
        let mut inputs = Inputs::default();
        inputs.digital[0] = rng.u8(..);
        inputs.scaled[0] = rng.u16(..);
        accepted += u64::from(run_image(&image, &inputs));
        if rng.u8(..16) == 0 {
            // What the check accepts, the disassembler must be able to say.
            let _ = disassemble(&image);
        }
    }
    println!("{count} images, {accepted} accepted and run");
    assert!(accepted > count / 100 && accepted < count, "the images do not reach the interpreter");
}

#[test]
fn every_single_byte_flipped_is_refused() {
    let mut rng = Rng::with_seed(7);
    for image in images(&mut rng, 5) {
        assert!(run_image(&image, &Inputs::default()));
        for at in 0..image.len() {
            for bit in 0..8 {
                let mut flipped = image.clone();
                flipped[at] ^= 1 << bit;
                assert!(!run_image(&flipped, &Inputs::default()), "byte {at}, bit {bit}");
            }
        }
    }
}

#[test]
fn a_refused_image_leaves_the_program_in_force() {
    let mut rng = Rng::with_seed(3);
    let images = images(&mut rng, 2);
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    plc.load(&mut memory, images[0].as_slice()).unwrap();
    plc.run();
    memory.set_byte(C_BITS_START - 1, 0x5A);
    let before = memory.clone();
    let mut bad = images[1].clone();
    bad[40] ^= 1;
    assert!(plc.load(&mut memory, bad.as_slice()).is_err());
    assert_eq!(memory, before);
    assert_eq!(plc.mode(), plc_vm::Mode::Run);
    assert_eq!(plc.fault(), None);
}

/// Every AWL text of the repository.
fn corpus() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_path_buf();
    let mut folders: Vec<PathBuf> = vec![root.join("examples"), root.join("tests")];
    let mut texts = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else if entry
                .extension()
                .is_some_and(|extension| extension == "awl" || extension == "scn")
            {
                texts.push(String::from_utf8_lossy(&fs::read(entry).unwrap()).into_owned());
            }
        }
    }
    texts
}

#[test]
fn random_texts_never_panic() {
    let (seed, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_TEXTS", 20_000));
    let mut rng = Rng::with_seed(seed);
    let corpus = corpus();
    assert!(corpus.len() > 10);
    let (mut good, mut diagnostics) = (0u64, 0);
    for _ in 0..count {
        let text = match rng.u8(..4) {
            0 => {
                let size = rng.usize(1..30);
                random_program(&mut rng, size)
            }
            _ => corpus[rng.usize(..corpus.len())].clone(),
        };
        let bytes = mutate(&mut rng, &text);
        let (is_good, messages) = read_text(&bytes);
        good += u64::from(is_good);
        diagnostics += messages;
    }
    println!("{count} texts, {good} good ones, {diagnostics} diagnostics");
    assert!(
        good > count / 100 && diagnostics as u64 > count,
        "the texts are not what they should be"
    );
}

/// The corpus that fuzzing is kept in, and a bounded number of mutations of each file.
/// `RANDOM_FUZZ` makes it more.
#[test]
fn the_corpus_of_fuzzing_never_does_harm() {
    let (seed, mutations) = (effort("RANDOM_SEED", 1), effort("RANDOM_FUZZ", 200));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus");
    let mut rng = Rng::with_seed(seed);
    for (name, body) in TARGETS {
        let folder = root.join(name);
        let mut files: Vec<PathBuf> =
            fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        assert!(!files.is_empty(), "{} is empty", folder.display());
        for bytes in files.iter().map(|file| fs::read(file).unwrap()) {
            body(&bytes);
            for _ in 0..mutations {
                let mut mutated = bytes.clone();
                match name {
                    "text" | "scenario" => {
                        mutated = mutate(&mut rng, &String::from_utf8_lossy(&bytes));
                    }
                    _ => change_bytes(&mut rng, &mut mutated, 0),
                }
                body(&mutated);
            }
        }
    }
}
