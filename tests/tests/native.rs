//! Translated programs on the bare chip: machine code of the translator in simavr, the firmware's
//! routines played by the interpreter, and after every scan the memory that the interpreter alone
//! comes to.
//!
//! `RANDOM_PROGRAMS=100000 cargo test --release -p tests --features uno --test native` runs longer,
//! `RANDOM_SEED` starts elsewhere.
#![cfg(feature = "uno")]

use std::ops::Range;

use awl_asm::assemble::assemble;
use awl_asm::native::{Cycles, Options, TranslateError, Translated, Vector, translate_with};
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{
    ARENA_START, AnalogInput, Bit, DATA_END, DATA_START, Execute, Group, I_START, NATIVE_VECTORS,
    Op, Program, ProgramMemory, SLOT_START, SM_START, TimerResolution, WordSource, counter_bit,
    decode, execute, timer_bit, timer_resolution, verify,
};
use plc_vm::{Environment, Exit, Fault, Inputs, Interpreter, Memory, Mode, Plc};
use simavr::{Avr, Elf, Reset, Stopped};
use tests::effort::effort;
use tests::image::OnBoard;
use tests::naive;
use tests::programs;
use tests::random::{Offer, random_inputs, random_program, random_program_of, random_step_ms};

/// Time stands still within a scan. A program that loops for longer than this has no end.
#[derive(Default)]
struct Time {
    now_ms: u32,
    looped: u32,
}

/// Jumps back in a scan of a program that ends.
const LOOPED_MAX: u32 = 20_000;

impl Environment for Time {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        self.looped += 1;
        self.looped > LOOPED_MAX
    }
    fn retrigger_watchdog(&mut self) {}
}

/// Data memory of the controller in that of the chip.
const DATA: Range<usize> = DATA_START as usize..DATA_END as usize;
const ALWAYS_ON: Bit = Bit { address: SM_START, bit: 0 };

/// Calls the code at Z as the firmware does, marks the end, and stands still.
const DRIVER: [u16; 7] = [0x94E8, 0xE0C0, 0xE0D1, 0x2411, 0x9509, 0xBA1E, 0xCFFF];
/// The call, and the mark after it.
const CALL_CYCLES: u32 = 3 + 1;
/// A routine: T in bit 0 of r0, marked; then T is 0 for those that lose it.
const ROUTINE_AT: u32 = 0x100;
const ROUTINE_LEN: u32 = 16;
const LOOP: usize = 2;

/// A chip with the driver and stubs for the firmware's routines.
struct Board {
    avr: Avr,
    rng: Rng,
    /// Jumps back in this scan, and calls of any routine.
    looped: u32,
    calls: u32,
}

impl Board {
    fn new() -> Board {
        let mut avr = Avr::new();
        let bytes =
            |words: &[u16]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<_>>();
        avr.write_flash(0, &bytes(&DRIVER)).unwrap();
        for number in 0..10u32 {
            let at = u32::from(NATIVE_VECTORS) + 2 * number;
            let routine = ROUTINE_AT + ROUTINE_LEN * number;
            let words = (routine as i32 - at as i32) / 2 - 1;
            avr.write_flash(at, &bytes(&[0xC000 | words as u16 & 0xFFF])).unwrap();
            let lose_top = if number == LOOP as u32 { 0x94E8 } else { 0 };
            avr.write_flash(routine, &bytes(&[0xF800, 0xBA0E, lose_top, 0x9508])).unwrap();
        }
        Board { avr, rng: Rng::with_seed(1), looped: 0, calls: 0 }
    }

    fn load(&mut self, image: &[u8]) {
        self.avr.write_flash(SLOT_START.into(), image).unwrap();
    }

    fn word(&self, low: usize, high: usize) -> u16 {
        u16::from_le_bytes([self.avr.data()[low], self.avr.data()[high]])
    }

    /// What a call may lose is lost.
    fn lose(&mut self, registers: impl Iterator<Item = usize>) {
        for register in registers {
            self.avr.data_mut()[register] = self.rng.u8(..);
        }
    }

    /// Executes the program. Returns why it was left, where, and the cycles from the call to after
    /// the return.
    fn run<P: ProgramMemory, E: Environment>(
        &mut self,
        entry: u16,
        engine: &mut Interpreter<'_, P, E>,
        program: &Program<&[u8]>,
    ) -> Result<(Exit, u16, u32), String> {
        self.avr.reset(Reset::PowerOn);
        self.lose(0..32);
        let [low, high] = ((SLOT_START + entry) / 2).to_le_bytes();
        (self.avr.data_mut()[30], self.avr.data_mut()[31]) = (low, high);
        self.take_memory(engine);
        // After the first four instructions of the driver comes the call.
        (0..4).for_each(|_| _ = self.avr.step());
        let start = self.avr.cycles();
        loop {
            match self.avr.run_to_mark(1_000_000_000) {
                Stopped::Mark(_) => {}
                stopped => return Err(format!("{stopped:?} at {:#06x}", self.avr.pc())),
            }
            let pc = self.avr.pc();
            if pc < u32::from(NATIVE_VECTORS) {
                assert_eq!(
                    (self.avr.data()[1], self.word(28, 29)),
                    (0, DATA_START),
                    "r1 and Y are kept"
                );
                assert_eq!(self.word(0x5D, 0x5E), 0x08FF, "the hardware stack is balanced");
                self.give_memory(engine);
                return Ok((Exit::End, 0, (self.avr.cycles() - start) as u32 - CALL_CYCLES));
            }
            self.calls += 1;
            let vector = ((pc - ROUTINE_AT) / ROUTINE_LEN) as usize;
            self.give_memory(engine);
            match vector {
                1 => return Ok((Exit::Stop, 0, 0)),
                3 => return Ok((Exit::Watchdog, self.word(24, 25), 0)),
                _ => self.routine(vector, engine, program),
            }
            self.take_memory(engine);
        }
    }

    /// The chip's data memory becomes the interpreter's.
    fn take_memory<P: ProgramMemory, E: Environment>(
        &mut self,
        engine: &mut Interpreter<'_, P, E>,
    ) {
        self.avr.data_mut()[DATA].copy_from_slice(&engine.memory().bytes()[..DATA.len()]);
    }

    /// The other way.
    fn give_memory<P: ProgramMemory, E: Environment>(&self, engine: &mut Interpreter<'_, P, E>) {
        engine.memory().bytes_mut()[..DATA.len()].copy_from_slice(&self.avr.data()[DATA]);
    }

    /// What the firmware's routine does, done by the interpreter.
    fn routine<P: ProgramMemory, E: Environment>(
        &mut self,
        vector: usize,
        engine: &mut Interpreter<'_, P, E>,
        program: &Program<&[u8]>,
    ) {
        let data = self.avr.data();
        let (top, x, z, detail) =
            (data[0] & 1 != 0, self.word(26, 27), self.word(30, 31), data[19]);
        let (preset, mask) = (WordSource::Constant(self.word(24, 25)), data[18]);
        let plan = program.plan();
        for level in [detail & 4 != 0, detail & 2 != 0, top] {
            let _ = if level { engine.load(ALWAYS_ON) } else { engine.load_not(ALWAYS_ON) };
        }
        let bit = match vector {
            0 => {
                let _ = execute(engine, &self.avr.flash(), z);
                None
            }
            LOOP => None,
            4..=6 => {
                let slot =
                    plan.timers().position(|slot| slot.address == x).expect("X is a timer's slot")
                        as u8;
                let _ = match vector {
                    4 => engine.on_delay(slot, preset),
                    5 => engine.off_delay(slot, preset),
                    _ => engine.retentive_on_delay(slot, preset),
                };
                let number = plan.timer(slot).number;
                assert_eq!(detail & 1 != 0, timer_resolution(number) == TimerResolution::Ms100);
                Some(timer_bit(number))
            }
            _ => {
                let slot = plan
                    .counters()
                    .position(|slot| slot.address == x)
                    .expect("X is a counter's slot") as u8;
                let _ = match vector {
                    7 => engine.count_up(slot, preset),
                    8 => engine.count_down(slot, preset),
                    _ => engine.count_up_down(slot, preset),
                };
                Some(counter_bit(plan.counter(slot).number))
            }
        };
        if let Some(bit) = bit {
            assert_eq!((z, mask), (bit.address, 1 << bit.bit), "the place of the bit");
        }
        self.lose([0].into_iter().chain(18..28).chain(30..32));
        if vector == LOOP {
            self.looped += 1;
            self.avr.data_mut()[24] = u8::from(self.looped > LOOPED_MAX);
        }
    }
}

fn image_of(name: &str, text: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new(name, text).unwrap(), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{name}: {:?}", assembly.diagnostics))
}

/// The interpreter alone and the machine code, side by side.
struct Pair<'a> {
    board: &'a mut Board,
    image: &'a [u8],
    entry: u16,
    host: (Plc<&'a [u8]>, Memory),
    native: (Plc<&'a [u8]>, Memory),
    /// Cycles of the last scan's machine code, and how often it called the firmware.
    cycles: u32,
    calls: u32,
}

impl<'a> Pair<'a> {
    fn new(board: &'a mut Board, image: &'a [u8], translated: &Translated) -> Pair<'a> {
        let native_image = OnBoard(&translated.image);
        let program = verify(native_image).unwrap_or_else(|error| panic!("{error:?}"));
        board.load(&translated.image);
        let plc = || {
            let (mut plc, mut memory) = (Plc::new(), Memory::new());
            plc.load(&mut memory, image).unwrap();
            plc.run();
            (plc, memory)
        };
        Pair {
            board,
            image,
            entry: program.entry().unwrap(),
            host: plc(),
            native: plc(),
            cycles: 0,
            calls: 0,
        }
    }

    fn is_running(&self) -> bool {
        self.host.0.mode() == Mode::Run
    }

    /// A scan on both. Says what is different afterwards.
    fn scan(&mut self, inputs: &Inputs, now_ms: u32) -> Option<String> {
        let (plc, memory) = &mut self.host;
        plc.scan(memory, inputs, &mut Time { now_ms, looped: 0 });
        let (plc, memory) = &mut self.native;
        (I_START..).zip(inputs.digital).for_each(|(address, byte)| memory.set_byte(address, byte));
        for (channel, (scaled, raw)) in (0..).zip(inputs.scaled.into_iter().zip(inputs.raw)) {
            memory.set_word(AnalogInput::Scaled(channel).address(), scaled);
            memory.set_word(AnalogInput::Raw(channel).address(), raw);
        }
        let program = verify(self.image).unwrap();
        let mut time = Time { now_ms, looped: 0 };
        if now_ms != plc.time() {
            plc.set_time(now_ms);
        }
        let mut engine = Interpreter::new(plc.begin(memory, &mut time)?);
        (self.board.looped, self.board.calls) = (0, 0);
        let (exit, at, cycles) = match self.board.run(self.entry, &mut engine, &program) {
            Ok(ran) => ran,
            Err(crash) => return Some(crash),
        };
        plc.finish(exit, at);
        (self.cycles, self.calls) = (cycles, self.board.calls);
        self.difference()
    }

    fn difference(&self) -> Option<String> {
        let (host, native) = (&self.host, &self.native);
        let states = [host, native].map(|(plc, _)| (plc.mode(), plc.fault()));
        if states[0] != states[1] {
            return Some(format!("{:?} should be {:?}", states[1], states[0]));
        }
        let bytes = (DATA_START..).zip(host.1.bytes().iter().zip(native.1.bytes()));
        let different = bytes.into_iter().find(|(_, (host, native))| host != native);
        different.map(|(address, (host, native))| {
            format!("{address:#06x} is {native:#04x}, should be {host:#04x}")
        })
    }
}

fn inputs_of(inputs: &naive::Inputs) -> Inputs {
    Inputs { digital: inputs.digital, scaled: inputs.aiw, raw: inputs.ain }
}

#[test]
fn random_programs_do_the_same_translated() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 500));
    let mut board = Board::new();
    let (mut scans, mut too_large) = (0, 0);
    for seed in first..first + count {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(5..220);
        // Every third with subroutines and sequences.
        let offer = if seed % 3 == 0 { Offer::units() } else { Offer::core() };
        let text = random_program_of(&mut rng, size, offer);
        let image = image_of(&format!("seed {seed}"), &text);
        let options = Options { pins: seed % 4 != 0 };
        let translated = match translate_with(&image, options) {
            Ok(translated) => translated,
            Err(TranslateError::TooLarge { .. }) => {
                too_large += 1;
                continue;
            }
            Err(error) => panic!("seed {seed}: {error}\n{text}"),
        };
        let mut pair = Pair::new(&mut board, &image, &translated);
        let (mut inputs, mut now_ms) = (naive::Inputs::default(), rng.u32(..));
        for scan in 0..rng.u32(3..20) {
            inputs = random_inputs(&mut rng, &inputs);
            if let Some(difference) = pair.scan(&inputs_of(&inputs), now_ms) {
                panic!("seed {seed}, scan {scan}: {difference}\n{text}");
            }
            now_ms = now_ms.wrapping_add(random_step_ms(&mut rng));
            scans += 1;
            if !pair.is_running() {
                break;
            }
        }
    }
    println!("{count} programs, {scans} scans, all equal; {too_large} too large");
    assert!(too_large * 10 < count, "{too_large} of {count} programs do not fit");
}

/// Instructions that call the firmware or leave the straight line.
fn is_straight(op: Op) -> bool {
    let group = op.instruction().group;
    !matches!(group, Group::Timer | Group::Counter | Group::Hidden | Group::Control)
        && !matches!(op, Op::MulInt | Op::DivInt | Op::ResetTimers | Op::ResetCounters)
}

/// The instructions of a bytecode image, without the end.
fn ops(image: &[u8], translated: &Translated) -> Vec<Op> {
    let ops = translated
        .instructions
        .iter()
        .map(|instruction| decode(&image, instruction.at).unwrap().op);
    ops.filter(|&op| op != Op::MainEnd).collect()
}

/// What a scan takes at least and at most, if no instruction leads away.
fn predicted(translated: &Translated) -> Cycles {
    let each = translated.instructions.iter().map(|instruction| instruction.cycles);
    each.fold(translated.start, Cycles::then)
}

#[test]
fn predicted_cycles_are_never_left() {
    let mut board = Board::new();
    let (mut programs, mut scans) = (0, 0);
    for seed in 1..=effort("RANDOM_PROGRAMS", 1_000) {
        let mut rng = Rng::with_seed(seed);
        let size = rng.usize(5..40);
        let image = image_of(&format!("seed {seed}"), &random_program(&mut rng, size));
        let translated = translate_with(&image, Options { pins: seed % 2 == 0 }).unwrap();
        if !ops(&image, &translated).iter().all(|&op| is_straight(op)) {
            continue;
        }
        programs += 1;
        let cycles = predicted(&translated);
        let mut pair = Pair::new(&mut board, &image, &translated);
        let mut inputs = naive::Inputs::default();
        for scan in 0..20 {
            inputs = random_inputs(&mut rng, &inputs);
            assert_eq!(pair.scan(&inputs_of(&inputs), scan), None, "seed {seed}");
            if pair.calls == 0 {
                assert!(
                    (cycles.min..=cycles.max).contains(&pair.cycles),
                    "seed {seed}: {} {cycles:?}",
                    pair.cycles
                );
                scans += 1;
            }
        }
    }
    println!("{programs} programs, {scans} scans");
    assert!(programs >= 10 && scans > 10 * programs);
}

/// Steady cycles of a scan of one of the benchmark programs, measured and predicted; and its
/// instructions.
fn speed(board: &mut Board, name: &str, text: &str, pins: bool) -> (u32, usize) {
    let image = image_of(name, text);
    let translated =
        translate_with(&image, Options { pins }).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut pair = Pair::new(board, &image, &translated);
    for scan in 0..4 {
        assert_eq!(pair.scan(&Inputs::default(), scan), None, "{name}");
    }
    let instructions = translated.instructions.len() - 1;
    println!(
        "{name}, pins {pins}: {} cycles, {:?} predicted, {:.2} an instruction; {} bytes, {:.2} an \
            instruction",
        pair.cycles,
        predicted(&translated),
        f64::from(pair.cycles) / instructions as f64,
        translated.image.len(),
        translated.image.len() as f64 / instructions as f64,
    );
    (pair.cycles, instructions)
}

#[test]
fn the_benchmark_programs_are_as_fast_as_they_must_be() {
    let mut board = Board::new();
    let boolean = programs::boolean();
    for (pins, tenths_max) in [(false, 36), (true, 20)] {
        let (cycles, instructions) = speed(&mut board, "boolean", &boolean, pins);
        assert!(
            10 * cycles as usize <= tenths_max * instructions,
            "cycles of a bit instruction, pins {pins}"
        );
        speed(&mut board, "mix", &programs::mix(), pins);
        let (cycles, _) = speed(&mut board, "80/20", &programs::eighty_twenty(), pins);
        assert!(cycles <= 4_800, "0.30 ms");
    }
}

/// A program so long that its jumps do not reach with two bytes: over all of it, out of it, and
/// back.
#[test]
fn far_jumps_arrive() {
    let lines: String =
        (0..760).map(|line| format!("LD I0.{}\nAN M1.0\n= V0.0\n", line % 6)).collect();
    let text = format!(
        "LD I1.0\nJMP 1\nLD I1.1\nEND\nLD I1.2\nSTOP\nLBL 2\nLD I0.7\nFOR MW4, 1, VW10\n\
            {lines}NEXT\nLD SM0.0\n\
         INCW MW6\nLDW< MW6, 3\nJMP 2\nLBL 1\nLD I0.0\nINCW MW8\n"
    );
    let image = image_of("far jumps", &text);
    let translated = translate_with(&image, Options::default()).unwrap();
    assert!(translated.image.len() > 6_000, "{} bytes", translated.image.len());
    let mut board = Board::new();
    let mut pair = Pair::new(&mut board, &image, &translated);
    for (scan, (first, second)) in
        [(0x81, 0), (0x80, 1), (0x05, 2), (0, 0), (1, 3), (0x81, 4)].into_iter().enumerate()
    {
        let mut inputs = Inputs::default();
        (inputs.digital[0], inputs.digital[1]) = (first, second);
        assert_eq!(pair.scan(&inputs, scan as u32), None, "scan {scan}");
    }
    assert!(!pair.is_running(), "STOP at last");
}

/// A loop without end: the watchdog leaves it at the jump that goes back, and what was written
/// is in memory.
#[test]
fn the_watchdog_leaves_at_the_jump_of_the_bytecode() {
    let programs = [
        "LD I0.0\n= M0.0\nLBL 1\nLD SM0.0\nS M0.1, 1\nINCW MW2\nJMP 1\n",
        "LBL 1\nLD SM0.0\nLPS\nFOR MW4, 1, MW4\nINCW MW2\nLDN M0.0\n= M0.0\nNEXT\nLD SM0.0\n\
            JMP 1\n",
    ];
    let mut board = Board::new();
    for (text, pins) in programs.into_iter().flat_map(|text| [(text, false), (text, true)]) {
        let image = image_of("endless", text);
        let translated = translate_with(&image, Options { pins }).unwrap();
        let mut pair = Pair::new(&mut board, &image, &translated);
        assert_eq!(pair.scan(&Inputs::default(), 0), None, "{text}");
        assert!(matches!(pair.host.0.fault(), Some(Fault::Watchdog { .. })), "{text}");
    }
}

/// Where a routine is called from: in the slot.
const CALLER: u32 = 0x7D00;

/// Cycles of a routine of the firmware, from the vector to after the return, with these registers
/// and all else random.
fn routine_cycles(avr: &mut Avr, rng: &mut Rng, vector: Vector, top: bool) -> u32 {
    let set_top = if top { 0x9468 } else { 0x94E8 };
    let caller = [set_top, 0x940E, vector.address() / 2, 0xBA1E, 0xCFFF];
    avr.write_flash(
        CALLER,
        &caller.iter().flat_map(|word: &u16| word.to_le_bytes()).collect::<Vec<_>>(),
    )
    .unwrap();
    avr.reset(Reset::PowerOn);
    avr.data_mut()[usize::from(DATA_START)..0x08E0].iter_mut().for_each(|byte| *byte = rng.u8(..));
    // A slot, and what decides in it, as often as not: small values, and each state.
    let slot = usize::from(ARENA_START);
    if rng.bool() {
        avr.data_mut()[slot] = rng.u8(0..2) * 0x7F;
    }
    avr.data_mut()[slot + 2] = rng.u8(..4);
    avr.data_mut()[slot + 4] = rng.u8(..4);
    for (register, value) in [(1, 0), (18, 1 << rng.u8(..8)), (19, rng.u8(..8)), (24, rng.u8(..))] {
        avr.data_mut()[register] = value;
    }
    avr.data_mut()[25] = [0, 0x7F, 0x80, rng.u8(..)][rng.usize(..4)];
    for (low, word) in [(26, ARENA_START), (28, DATA_START), (30, 0x0180)] {
        avr.data_mut()[low..low + 2].copy_from_slice(&word.to_le_bytes());
    }
    avr.set_pc(CALLER);
    let start = avr.cycles();
    assert_eq!(avr.run_to_mark(10_000), Stopped::Mark(0));
    // Without T, the call and the mark.
    (avr.cycles() - start) as u32 - 1 - 4 - 1
}

#[test]
fn the_routines_of_the_firmware_take_what_the_translator_says() {
    let elf =
        std::fs::read(awl_asm::firmware::find_elf().unwrap_or_else(|error| panic!("{error:#}")))
            .unwrap();
    let (mut avr, mut rng) = (Avr::new(), Rng::with_seed(1));
    avr.load_elf(&Elf::parse(&elf).unwrap()).unwrap();
    // Timers whose input says at once what becomes of them are not left to the firmware.
    let routines = [
        (Vector::Ton, Some(true)),
        (Vector::Tof, Some(false)),
        (Vector::Tonr, Some(true)),
        (Vector::Ctu, None),
        (Vector::Ctd, None),
        (Vector::Ctud, None),
    ];
    for (vector, top) in routines {
        let measured = (0..20_000).map(|_| {
            let top = top.unwrap_or_else(|| rng.bool());
            Cycles::exactly(routine_cycles(&mut avr, &mut rng, vector, top))
        });
        let measured = measured.reduce(Cycles::or).unwrap_or_default();
        println!("{vector:?}: {measured:?}, said {:?}", vector.cycles());
        assert!(
            vector.cycles().min <= measured.min && measured.max <= vector.cycles().max,
            "{vector:?}: {measured:?}"
        );
    }
}
