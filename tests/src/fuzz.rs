//! What may never panic, whatever the bytes: the bodies of the fuzz targets in `fuzz`, and of the
//! tests that run their corpus and random bytes of their own.

use awl_asm::assemble::assemble;
use awl_asm::disassemble::disassemble;
use awl_asm::source::Source;
use awl_asm::{render, symbols};
use awl_sim::machine::Machine;
use awl_sim::scenario::{Context, Scenario};
use plc_isa::{ARENA_START, DATA_START, ENO, SLOT_LEN};
use plc_vm::{Environment, Inputs, Memory, Plc};

use crate::case::host;
use crate::image;

/// The body of a target.
pub type Body = fn(&[u8]);

/// The targets, by the names of their files and folders in `fuzz`.
pub const TARGETS: [(&str, Body); 4] =
    [("image", image), ("text", text), ("frames", frames), ("scenario", scenario)];

/// So many diagnostics of a text are shown.
const SHOWN_MAX: usize = 5;
/// Scans until an answer is there at the latest.
const ANSWER_SCANS_MAX: u64 = 1_000;
/// The program whose line gets frames: one with memory of every kind.
const PROGRAM: &str = "LDN SM0.0\nMOVB VB10, VB20\nMOVW VW100, VW120\nTON T37, VW120\nTONR T5, 10\n\
    LD I0.0\nLD I0.1\nCTU C5, 10\nLD I0.7\n= Q0.0\n";

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

const UNTOUCHED: u8 = 0xA5;

/// Loads and runs an image. Returns whether it was accepted.
///
/// # Panics
/// If it writes outside its plan, or runs though it was refused.
pub fn run_image(image: &[u8], inputs: &Inputs) -> bool {
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

/// An image as it is, and with its checksum made right: the loader must see what else is wrong.
pub fn image(bytes: &[u8]) {
    let mut signed = bytes.to_vec();
    if signed.len() >= 8 {
        image::sign(&mut signed);
    }
    for image in [bytes, &signed] {
        run_image(image, &Inputs::default());
        // What the check accepts, the disassembler must be able to say.
        let _ = disassemble(image);
    }
}

/// A text as a program, as a symbol table and as a scenario. Returns whether it is a good program,
/// and how many diagnostics it gets.
///
/// # Panics
/// If the loader refuses what the assembler made.
pub fn read_text(bytes: &[u8]) -> (bool, usize) {
    // What is no text is read as one all the same.
    let lossy = || Source::new("random", String::from_utf8_lossy(bytes));
    let Ok(source) = Source::from_bytes("random", bytes).or_else(|_| lossy()) else {
        return (false, 0);
    };
    let assembly = assemble(&source, Vec::new());
    if let Some(image) = &assembly.image {
        assert!(image.len() <= usize::from(SLOT_LEN));
        let is_accepted = run_image(image, &Inputs::default());
        assert!(is_accepted, "the loader refuses what the assembler made\n{}", source.text);
    }
    for diagnostic in assembly.diagnostics.iter().take(SHOWN_MAX) {
        let _ = (render::human(&source, diagnostic, false), render::json(&source, diagnostic));
    }
    let _ = symbols::load(&source);
    read_scenario(&source.text);
    (assembly.image.is_some(), assembly.diagnostics.len())
}

/// An AWL text, or what is none.
pub fn text(bytes: &[u8]) {
    read_text(bytes);
}

/// A scenario, and a plant file.
fn read_scenario(text: &str) {
    let mut has_operand = |_| Ok(());
    let context = Context { symbols: &[], plant: None, has_operand: &mut has_operand };
    let _ = Scenario::parse("random", text, context);
    let _ = awl_sim::plant::file::problems(text);
}

/// A scenario, or what is none.
pub fn scenario(bytes: &[u8]) {
    read_scenario(&String::from_utf8_lossy(bytes));
}

/// Requests on the line of a PLC in RUN, one after the other: each a byte with its length, function
/// code and data.
pub fn frames(bytes: &[u8]) {
    let mut host = host(&image::image(PROGRAM));
    let (mut rest, mut now_ms) = (bytes, 0);
    while let Some((&len, after)) = rest.split_first() {
        let (request, next) = after.split_at(after.len().min(usize::from(len)));
        rest = next;
        if !host.take_request(request) {
            continue;
        }
        let last_ms = now_ms + ANSWER_SCANS_MAX;
        while host.answer().is_none() {
            assert!(now_ms < last_ms, "no answer to {request:02x?}");
            host.scan(now_ms);
            now_ms += 1;
        }
        host.carry_out();
        host.scan(now_ms);
        now_ms += 1;
    }
}
