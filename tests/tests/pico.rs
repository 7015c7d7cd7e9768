//! The firmware of the Pico, in an emulator, and the host side by side: every case, and random
//! programs, equal after every scan.
//!
//! By default so many scans of a case and so many random programs are compared that it takes a few
//! minutes. `CASE_SCANS=100000 RANDOM_PROGRAMS=5000 cargo test --package tests --features pico
//! --test pico` runs longer.
#![cfg(feature = "pico")]

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use awl_asm::drive::uf2_file;
use awl_sim::machine::Machine;
use awl_sim::machine::pico::{Pico, find_firmware};
use plc_isa::{PICO, PICO_DRIVE, verify};
use plc_vm::Inputs;
use tests::beside::Pair;
use tests::case::{Case, Prepared, folder, host};
use tests::commands;
use tests::effort::effort;
use tests::image::image_for;
use tests::pico::{Line, OnPico, Plugged};
use tests::programs;
use tests::random_runs::{Programs, random_image_for, random_scans};

/// A second of a Pico takes the emulator many.
const WATCHDOG_MAX_MS: u16 = 5_000;
/// By how much the starts of scans may differ from their period, in microseconds.
const JITTER_MAX_US: f64 = 10.0;

/// One emulator for all tests: each of them takes a processor.
fn pico() -> MutexGuard<'static, Option<Pico>> {
    static PICO: Mutex<Option<Pico>> = Mutex::new(None);
    let mut place = PICO.lock().unwrap_or_else(PoisonError::into_inner);
    place.get_or_insert_with(tests::pico::pico);
    place
}

fn watchdog_ms(image: &[u8]) -> u16 {
    verify(image).map_or(0, |program| program.plan().header.settings.watchdog_ms)
}

/// The cases that this board has everything for, and the names of the others with what they need.
fn comparable() -> (Vec<Prepared>, Vec<String>) {
    let cases = [Case::all(), Case::examples(), Case::structured()].concat();
    let (mut comparable, mut left_out) = (Vec::new(), Vec::new());
    for case in cases {
        let file = case.file.clone();
        match case.prepare_for(Some(&PICO)) {
            Ok(case) if case.has_actions() => left_out.push(format!("{file}: pulses or a clock")),
            Ok(case) if watchdog_ms(&case.image) > WATCHDOG_MAX_MS => {
                left_out.push(format!("{file}: scans of many seconds"));
            }
            // Such as one about the end of the Uno's memory.
            Ok(case) if !case.failures(&mut host(&case.image)).is_empty() => {
                left_out.push(format!("{file}: it is about another board"));
            }
            Ok(case) => comparable.push(case),
            Err(errors) => {
                left_out.push(format!("{file}: {}", errors.lines().next().unwrap_or("")))
            }
        }
    }
    (comparable, left_out)
}

#[test]
fn cases_are_the_same() {
    let scans_max = effort("CASE_SCANS", 10);
    let (cases, left_out) = comparable();
    assert!(cases.len() > 4 * left_out.len(), "{} left out", left_out.join("\n"));
    let mut place = pico();
    let Some(pico) = place.as_mut() else { return };
    let (start, mut scans, mut found) = (Instant::now(), 0, Vec::new());
    for case in &cases {
        let mut pair = Pair::new(OnPico::with(pico, &case.image), &case.image).at_most(scans_max);
        found.extend(pair.failures(case));
        scans += pair.scans();
    }
    println!("left out:\n{}", left_out.join("\n"));
    println!(
        "{} cases compared for up to {scans_max} scans, {} left out, {scans} scans, {} s",
        cases.len(),
        left_out.len(),
        start.elapsed().as_secs()
    );
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

#[test]
fn random_programs_are_the_same() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 200));
    let mut place = pico();
    let Some(pico) = place.as_mut() else { return };
    let (start, mut scans) = (Instant::now(), 0);
    for seed in first..first + count {
        let (image, text, mut rng) = random_image_for(seed, Programs::Everything, &PICO);
        let place = |scan| format!("seed {seed}, scan {scan}\n{text}");
        let mut pair = Pair::new(OnPico::with(pico, &image), &image);
        scans += random_scans(&mut pair, &mut rng, Pair::difference, place);
    }
    println!("{count} programs, {scans} scans, all equal, {} s", start.elapsed().as_secs());
    assert!(scans >= 2 * count, "the programs hardly ran");
}

/// As many instructions as the slot has room for: more than ten times what is translated, so that
/// the interpreter goes on where the code ends.
#[test]
fn a_program_of_20_000_instructions_is_the_same() {
    let text = programs::eighty_twenty().repeat(20_000_usize.div_ceil(programs::STEPS));
    assert_large_is_the_same(&text, 20_000);
}

/// A program of at least 20,000 instructions is the same, with inputs from this seed.
fn assert_large_is_the_same(text: &str, seed: u64) {
    let image = image_for(text, &PICO);
    let instructions = verify(image.clone()).unwrap().instructions().count();
    let mut place = pico();
    let Some(pico) = place.as_mut() else { return };
    let mut pair = Pair::new(OnPico::with(pico, &image), &image);
    let mut rng = fastrand::Rng::with_seed(seed);
    let scans = random_scans(&mut pair, &mut rng, Pair::difference, |scan| format!("scan {scan}"));
    println!("{instructions} instructions, {} bytes, {scans} scans, all equal", image.len());
    assert!(scans >= 3 && instructions >= 20_000);
}

/// Reals, strings, double words, tables and PID: what needs modules on the Uno, where so much has
/// no room. Each number has a place of its own in V memory, or shares it with another.
fn everything(number: u16) -> String {
    let v = 200 + number % 60 * 160;
    let [a, b, c, d, e, f] = [v, v + 4, v + 8, v + 12, v + 16, v + 18];
    let [word, part, len, first, found, table] = [v + 24, v + 32, v + 48, v + 52, v + 54, v + 60];
    let (i, j, k) = (number % 8, (number + 3) % 8, (number + 5) % 8);
    let pid = if number < 4 { format!("PID VB{}, {number}\n", 40 * number) } else { String::new() };
    format!(
        "LD SM0.1\nMOVW 5, VW{table}\n\
         LD I0.{i}\nMOVR {number}.25, VD{a}\n\
         LD SM0.0\n+R VD{a}, VD{b}\n*R 0.75, VD{b}\nSQRT VD{b}, VD{c}\nSIN VD{c}, VD{d}\n\
         ROUND VD{b}, VD{e}\n*D 3, VD{e}\nSWAP VW{f}\n\
         SCPY \"block\", VB{word}\nSSCPY VB{word}, 2, 3, VB{part}\nSCAT VB{part}, VB{word}\n\
         SLEN VB{word}, VB{len}\n\
         LD I0.{j}\nEU\nATT VW{e}, VW{table}\nLD I0.{k}\nEU\nFIFO VW{table}, VW{first}\n\
         LD SM0.0\nFND> VW{table}, 7, VW{found}\n{pid}"
    )
}

#[test]
fn a_large_program_of_everything_is_the_same() {
    let blocks: String = (0..100).map(everything).collect();
    assert_large_is_the_same(&(blocks + &programs::eighty_twenty().repeat(18)), 100);
}

/// Where speed is counted: in cycles by the table of the Cortex-M0+.
#[test]
fn cycles_are_those_of_the_processor() {
    let told = node("check-cycles.mjs", &[]);
    assert!(told.ends_with(" compared, 0 different"), "{told}");
}

/// What a script beside the emulator prints.
fn node(script: &str, arguments: &[&Path]) -> String {
    let script = folder("../sim/pico").join(script);
    let output = Command::new("node").arg(script).args(arguments).output().expect("node starts");
    let told = String::from_utf8_lossy(&output.stdout).trim_end().to_owned();
    assert!(output.status.success(), "{told}\n{}", String::from_utf8_lossy(&output.stderr));
    println!("{told}");
    told
}

/// By a clock that is not held, while a master asks for the longest answers that there are.
#[test]
fn scans_begin_on_time_whatever_is_asked() {
    let image = image_for("//# scan 2ms\nLD SM0.5\n= Q0.0\n", &PICO);
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(&image).unwrap();
    let (elf, period, scans) = (find_firmware().unwrap(), Path::new("2"), Path::new("400"));
    for line in ["uart", "usb"] {
        let told = node("jitter.mjs", &[Path::new(line), &elf, file.path(), period, scans]);
        let words: Vec<&str> = told.split([' ', ',']).collect();
        let [scans, .., answers, _, _, us, _, _] = words[..] else { panic!("{told}") };
        let [scans, answers, us] = [scans, answers, us].map(|word| word.parse::<f64>().unwrap());
        assert!(scans == 400.0 && answers > 50.0 && us <= JITTER_MAX_US, "{line}: {told}");
    }
}

/// Power is cut while a program comes, at bytes of flash: the shipped firmware, with the flash of
/// the emulator.
#[test]
fn the_old_program_or_the_new_one_runs_after_a_power_cut() {
    let cuts = effort("DOWNLOAD_CUTS", 100).to_string();
    let files = [1, 2].map(|number| {
        let moves = "LD SM0.0\nMOVW 7, VW2\n".repeat(200);
        let text = format!("LD SM0.0\nMOVW {number}, VW0\n{moves}");
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(&image_for(&text, &PICO)).unwrap();
        file
    });
    let elf = find_firmware().unwrap();
    let told = node("cuts.mjs", &[&elf, files[0].path(), files[1].path(), Path::new(&cuts)]);
    let words: Vec<&str> = told.split(' ').collect();
    let [all, _, old, _, new, _] = words[..] else { panic!("{told}") };
    let [all, old, new] = [all, old, new].map(|word| word.parse::<u32>().unwrap());
    assert!(old + new == all && old > all / 4 && new > all / 8, "{told}");
}

/// As somebody does it who has a Pico at a serial adapter.
#[test]
fn a_program_is_written_over_the_line() {
    write_programs_by(Line::Uart);
}

/// As somebody does it who has a Pico and a cable.
#[test]
fn a_program_is_written_by_usb() {
    write_programs_by(Line::Usb);
}

fn write_programs_by(line: Line) {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let first = file("first.bin", &image_for("//# name first\nLD SM0.0\n= Q0.0\n", &PICO));
    let pico = Plugged::by(line, &first);
    let uno200 = commands::built("uno200");
    let run = |arguments: &[&str]| {
        let output = Command::new(&uno200)
            .current_dir(folder.path())
            .args(arguments)
            .args(["--port", pico.line()])
            .output()
            .unwrap();
        let told = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(told).unwrap())
    };
    file("second.awl", b"//# board pico\n//# name second\nLD SM0.0\n= Q0.1\n");
    let (code, told) = run(&["flash", "second.awl"]);
    assert_eq!(code, Some(0), "{told}");
    assert!(told.ends_with("written and checked\nthe program runs\n"), "{told}");
    let (code, told) = run(&["compare", "second.awl"]);
    assert_eq!(code, Some(0), "{told}");
    // Scenarios write their own program, and a Pico that is slower than a real one has time.
    file("third.awl", b"//# board pico\n//# name third\nLDN I0.0\nA I0.7\n= Q0.7\n");
    file(
        "third.scn",
        b"at 0ms I0.7 = 1\nat 3s expect Q0.7 = 1\nat 4s I0.0 = 1\nat 8s expect Q0.7 = 0\n",
    );
    let (code, told) = run(&["test", "third.scn", "--flash", "--tolerance", "2s"]);
    assert_eq!(code, Some(0), "{told}");
    let (code, told) = run(&["status"]);
    assert!(code == Some(0) && told.contains("third"), "{told}");
    // An image that is not whole is not sent at all.
    let mut other = image_for("//# name other\nLD SM0.0\n= Q0.2\n", &PICO);
    other[20] ^= 1;
    file("other.bin", &other);
    assert_eq!(run(&["flash", "other.bin"]).0, Some(2));
    // A program that waits for its firmware is told the way.
    let (code, told) = run(&["flash", "second.awl", "--with-firmware"]);
    assert!(code == Some(2) && told.contains("BOOTSEL"), "{told}");
}

/// What the blocks of a UF2 file bring to an address, up to where they have nothing more.
fn brought_to(file: &[u8], start: u32) -> Vec<u8> {
    let word = |block: &[u8], at: usize| {
        block[at..].first_chunk().copied().map(u32::from_le_bytes).unwrap_or_default()
    };
    let mut bytes = Vec::new();
    for block in file.chunks(512) {
        if word(block, 12) == start + bytes.len() as u32 {
            bytes.extend_from_slice(&block[32..32 + word(block, 16) as usize]);
        }
    }
    bytes
}

/// Neither firmware nor program comes from anywhere else than the file that a user drags onto the
/// drive. Blocks of firmware are read by the emulator's side, with a library of its own.
#[test]
fn a_uf2_file_brings_firmware_and_program() {
    let image = image_for("LD I0.0\nAN I0.7\n= Q0.3\n", &PICO);
    let uf2 = uf2_file(&PICO, &image).unwrap();
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(&uf2).unwrap();

    let slot = brought_to(&uf2, PICO_DRIVE.slot_start);
    assert_eq!(slot[..image.len()], image);
    assert!(slot[image.len()..].iter().all(|&byte| byte == 0xFF));
    // It is in force whatever has come over the line.
    for record in PICO_DRIVE.records {
        assert_eq!(brought_to(&uf2, *record), [0xFF; 4096]);
    }
    let mut pico = Pico::new(file.path(), Box::new(|_| String::new())).unwrap();
    pico.load(slot);
    for (scan, (levels, output)) in
        [(0x01, 0x08), (0x81, 0), (0, 0), (1, 8)].into_iter().enumerate()
    {
        let mut inputs = Inputs::default();
        inputs.digital[0] = levels;
        pico.set_inputs(&inputs);
        pico.scan(scan as u64);
        assert_eq!((pico.outputs(), pico.broken()), (Some(output), None), "scan {scan}");
    }
}
