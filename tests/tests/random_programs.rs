//! Random valid programs: the interpreter against the naive evaluator, after every scan; and the
//! way there and back.
//!
//! `RANDOM_PROGRAMS=100000 cargo test --release --package tests --test random_programs` runs
//! longer, `RANDOM_SEED` starts elsewhere. A failure names its seed.

use awl_asm::assemble::assemble;
use awl_asm::diagnostic::Severity;
use awl_asm::disassemble::disassemble;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{
    AC_START, ACCUMULATORS, Area, C_BITS_START, LogicStack, Plan, ProgramMemory, SM_IN_V,
    T_BITS_START,
};
use plc_vm::{Environment, Memory, Mode, Plc};
use tests::effort::effort;
use tests::naive::{self, Extents, Naive};
use tests::random::{Offer, random_inputs, random_program_of, random_step_ms};

/// Time stands still within a scan. A program that loops for longer than this has no end.
struct Time {
    now_ms: u32,
    looped_bytes: u64,
    executed: u64,
}

impl Environment for Time {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped_bytes += u64::from(bytes);
        self.looped_bytes > 10_000_000
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, _at: u16, _stack: LogicStack, _memory: &mut Memory) {
        self.executed += 1;
    }
}

/// What the programs of a test may use.
type Offers = fn(&mut Rng) -> Offer;

const CORE: Offers = |_| Offer::core();
const EVERYTHING: Offers = Offer::everything;

fn text_of(seed: u64, offers: Offers) -> (String, Rng) {
    let mut rng = Rng::with_seed(seed);
    let size = rng.usize(5..220);
    let offer = offers(&mut rng);
    (random_program_of(&mut rng, size, offer), rng)
}

fn assembled(seed: u64, text: &str) -> (Vec<u8>, awl_asm::ast::Program) {
    let source = Source::new(format!("seed {seed}"), text).unwrap();
    let assembly = assemble(&source, Vec::new());
    match assembly.image {
        Some(image) => (image, assembly.program),
        None => {
            let errors =
                assembly.diagnostics.iter().filter(|message| message.severity() == Severity::Error);
            for diagnostic in errors {
                eprintln!("{}", awl_asm::render::human(&source, diagnostic, false));
            }
            panic!("seed {seed} does not assemble\n{text}");
        }
    }
}

#[test]
fn the_interpreter_agrees_with_the_naive_evaluator() {
    agrees(CORE, 3_000);
}

#[test]
fn modules_and_units_agree_with_the_naive_evaluator() {
    agrees(EVERYTHING, 2_000);
}

fn agrees(offers: Offers, programs: u64) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", programs));
    let (mut scans, mut executed) = (0, 0);
    for seed in first..first + count {
        let (text, mut rng) = text_of(seed, offers);
        let (image, program) = assembled(seed, &text);
        let (more_scans, more_executed) = compare(seed, &text, &image, program, &mut rng);
        scans += more_scans;
        executed += more_executed;
    }
    println!("{count} programs, {scans} scans, {executed} instructions executed, all equal");
    assert!(scans >= 2 * count && executed > 10 * count, "the programs hardly ran");
}

/// Runs a program on both for a number of scans. Returns scans and instructions executed.
fn compare(
    seed: u64,
    text: &str,
    image: &[u8],
    program: awl_asm::ast::Program,
    rng: &mut Rng,
) -> (u64, u64) {
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    plc.load(&mut memory, image).unwrap_or_else(|error| panic!("seed {seed}: {error:?}\n{text}"));
    plc.run();
    let mut naive = Naive::new(program);
    naive.set_extents(extents(plc.program().expect("a program is loaded").plan()));
    // Near the wrap of the clock as often as not.
    let start_ms = if rng.bool() { u32::MAX - rng.u32(..2_000) } else { rng.u32(..) };
    let mut time = Time { now_ms: start_ms, looped_bytes: 0, executed: 0 };
    let mut inputs = naive::Inputs::default();
    let scans = rng.u64(3..40);
    for scan in 0..scans {
        inputs = random_inputs(rng, &inputs);
        time.looped_bytes = 0;
        let vm_inputs =
            plc_vm::Inputs { digital: inputs.digital, scaled: inputs.aiw, raw: inputs.ain };
        if plc.mode() == Mode::Stop && rng.bool() {
            plc.run();
            naive.start();
        }
        let ran = plc.mode() == Mode::Run;
        plc.scan(&mut memory, &vm_inputs, &mut time);
        naive.scan(time.now_ms, &inputs);
        let plan = plc.program().expect("a program is loaded").plan();
        let differences = if ran { differences(&plc, &memory, plan, &naive) } else { Vec::new() };
        assert!(
            differences.is_empty(),
            "seed {seed}, scan {scan}: {}\n{text}",
            differences.join(", ")
        );
        time.now_ms = time.now_ms.wrapping_add(random_step_ms(rng));
    }
    (scans, time.executed)
}

/// What there is of memory, by the plan.
fn extents<P: ProgramMemory>(plan: &Plan<P>) -> Extents {
    let ranges: Vec<(u16, u16)> =
        plan.v_ranges().map(|(first, len)| (first, first + len)).collect();
    let (sm, v): (Vec<_>, Vec<_>) = ranges.into_iter().partition(|&(first, _)| first >= SM_IN_V);
    Extents {
        v: v.into_iter().map(|(first, end)| first..end).collect(),
        sm: sm.into_iter().map(|(first, end)| first - SM_IN_V..end - SM_IN_V).collect(),
        timers: plan.timers().map(|slot| slot.number).collect(),
        counters: plan.counters().map(|slot| slot.number).collect(),
    }
}

/// Everything a program can see, and the mode.
fn differences<P: ProgramMemory>(
    plc: &Plc<P>,
    memory: &Memory,
    plan: &Plan<P>,
    naive: &Naive,
) -> Vec<String> {
    let mut found = Vec::new();
    let mut equal = |what: String, vm: i32, naive: i32| {
        if vm != naive {
            found.push(format!("{what} is {vm}, should be {naive}"));
        }
    };
    equal(
        "RUN".into(),
        i32::from(plc.mode() == Mode::Run),
        i32::from(naive.mode() == naive::Mode::Run),
    );
    for area in [Area::I, Area::Q, Area::M, Area::Sm, Area::S] {
        for byte in 0..area.page_len() {
            let address = area.page_start().unwrap_or(0) + byte;
            equal(
                format!("{}B{byte}", area.name()),
                memory.byte(address).into(),
                naive.byte(area, byte).into(),
            );
        }
    }
    for number in 0..ACCUMULATORS {
        let address = AC_START + 4 * u16::from(number);
        let words =
            [memory.int(address), memory.int(address + 2)].map(|word| u32::from(word as u16));
        let value = words[0] << 16 | words[1];
        equal(format!("AC{number}"), value as i32, naive.accumulator(number) as i32);
    }
    let v_ranges = plan.v_ranges().filter(|&(first, _)| first < SM_IN_V);
    for byte in v_ranges.flat_map(|(first, len)| first..first + len) {
        let address = plan.v_address(byte).unwrap_or(0);
        equal(format!("VB{byte}"), memory.byte(address).into(), naive.byte(Area::V, byte).into());
    }
    for number in 0..=255u8 {
        let bit =
            |start: u16| i32::from(memory.byte(start + u16::from(number / 8)) >> (number % 8) & 1);
        equal(format!("T{number}"), bit(T_BITS_START), naive.timer(number).bit.into());
        equal(format!("C{number}"), bit(C_BITS_START), naive.counter(number).bit.into());
    }
    for slot in plan.timers() {
        equal(
            format!("T{}.cv", slot.number),
            memory.int(slot.address).into(),
            naive.timer(slot.number).current.into(),
        );
    }
    for slot in plan.counters() {
        equal(
            format!("C{}.cv", slot.number),
            memory.int(slot.address).into(),
            naive.counter(slot.number).current.into(),
        );
    }
    found
}

#[test]
fn disassembled_programs_assemble_to_the_same_bytes() {
    comes_back(CORE, 3_000);
}

#[test]
fn modules_and_units_come_back_too() {
    comes_back(EVERYTHING, 2_000);
}

fn comes_back(offers: Offers, programs: u64) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", programs));
    for seed in first..first + count {
        let (text, _) = text_of(seed, offers);
        let (image, _) = assembled(seed, &text);
        let again = disassemble(&image).unwrap_or_else(|error| panic!("seed {seed}: {error:?}"));
        let (same, _) = assembled(seed, &again);
        assert!(image == same, "seed {seed}\n{text}\n--- disassembled\n{again}");
    }
}
