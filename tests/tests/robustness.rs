//! Bad input of every kind: images and texts that nobody meant. Never a panic, a hang or a write outside the plan.
//!
//! `RANDOM_IMAGES`, `RANDOM_TEXTS` and `RANDOM_SEED` in the environment make the runs longer or different.

use std::fs;
use std::path::{Path, PathBuf};

use awl_asm::assemble::assemble;
use awl_asm::disassemble::disassemble;
use awl_asm::source::Source;
use awl_asm::{render, symbols};
use fastrand::Rng;
use plc_isa::{ARENA_START, C_BITS_START, CRC_LEN, DATA_START, ENO, Header, SLOT_LEN};
use plc_vm::{Environment, Inputs, Memory, Plc};
use tests::effort::effort;
use tests::image::sign;
use tests::mutate::mutate;
use tests::random::random_program;

/// Loops end soon: a hang would be a loop that never asks.
struct Impatient {
    now_ms: u32,
    looped_bytes: u32,
}

impl Environment for Impatient {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped_bytes += u32::from(bytes) + 1;
        self.looped_bytes > 5_000
    }
    fn retrigger_watchdog(&mut self) {}
}

/// Images of random programs to start from.
fn images(rng: &mut Rng, count: usize) -> Vec<Vec<u8>> {
    let text = |rng: &mut Rng| {
        let size = rng.usize(3..60);
        random_program(rng, size)
    };
    let image = |rng: &mut Rng| assemble(&Source::new("corpus", text(rng)).unwrap(), Vec::new()).image;
    (0..count).filter_map(|_| image(rng)).collect()
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
        // Noise behind a sound header.
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

const UNTOUCHED: u8 = 0xA5;

/// Loads and runs an image. Returns whether it was accepted.
fn run_image(image: &[u8], inputs: &Inputs) -> bool {
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    if plc.load(&mut memory, image).is_err() {
        assert!(plc.program().is_none() && !plc.run(), "a refused image must not run");
        return false;
    }
    let plan_end = plc.program().map_or(0, |program| program.plan().end());
    let outside = (0..memory.bytes().len() as u16)
        .map(|offset| DATA_START + offset)
        .filter(|&address| (ENO + 1..ARENA_START).contains(&address) || address >= plan_end);
    for address in outside.clone() {
        memory.set_byte(address, UNTOUCHED);
    }
    plc.run();
    let mut environment = Impatient { now_ms: u32::MAX - 20, looped_bytes: 0 };
    for _ in 0..3 {
        environment.looped_bytes = 0;
        plc.scan(&mut memory, inputs, &mut environment);
        environment.now_ms = environment.now_ms.wrapping_add(17);
    }
    for address in outside {
        assert_eq!(memory.byte(address), UNTOUCHED, "{address:#06x} was written");
    }
    true
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
            } else if entry.extension().is_some_and(|extension| extension == "awl" || extension == "scn") {
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
        let source = Source::from_bytes("random", &bytes).unwrap();
        let assembly = assemble(&source, Vec::new());
        if let Some(image) = &assembly.image {
            good += 1;
            assert!(image.len() <= usize::from(SLOT_LEN));
            assert!(
                run_image(image, &Inputs::default()),
                "the loader refuses what the assembler made\n{}",
                source.text
            );
        }
        diagnostics += assembly.diagnostics.len();
        for diagnostic in assembly.diagnostics.iter().take(5) {
            let _ = (render::human(&source, diagnostic, false), render::json(&source, diagnostic));
        }
        let _ = symbols::load(&source);
        let mut has_operand = |_| Ok(());
        let context = awl_sim::scenario::Context { symbols: &[], plant: None, has_operand: &mut has_operand };
        let _ = awl_sim::scenario::Scenario::parse("random", &source.text, context);
    }
    println!("{count} texts, {good} good ones, {diagnostics} diagnostics");
    assert!(good > count / 100 && diagnostics as u64 > count, "the texts are not what they should be");
}
