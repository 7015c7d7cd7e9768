//! Status windows (service function 69) on the board: what its engine writes down of the
//! instructions of one scan is what plc-vm saw. How a window is asked for, the answer made of it,
//! and what that costs is for others.
#![cfg(feature = "uno")]

use std::collections::BTreeMap;

use awl_asm::Address;
use awl_asm::disassemble::instructions;
use awl_sim::machine::Machine;
use awl_sim::machine::uno::{Code, Uno};
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{
    AQW_START, ARENA_START, AnalogInput, Area, DATA_START, LogicStack, Op, Program, SLOT_START,
    WINDOW_LEN, verify,
};
use plc_vm::{Environment, Memory, Mode, Plc};
use tests::bench_board::firmware;
use tests::effort::effort;
use tests::image::image;
use tests::lockstep::{Programs, board, random_image};
use tests::naive::Inputs;
use tests::random::{random_inputs, random_interrupts, random_step_ms};

/// An entry: the address in flash two bytes after the instruction's first, place, logic stack,
/// four bytes from the place on.
const ENTRY_LEN: u16 = 10;
const ENTRIES_MAX: usize = 24;
const ADDRESS: u16 = SLOT_START + 2;
/// Bytes of the frame before the first entry, with the address of the last one in them, and after
/// the last.
const FIRST: u16 = 3;
const LAST: u16 = 1;
const END: [u8; 2] = [0xFF; 2];
/// The bit of a stack that says that the instruction was executed.
const EXECUTED: u16 = 0x8000;
/// The size of a byte, in a place.
const BYTE: u16 = 8 << 12;

/// In the firmware's LINE: the frame, the bytes it may have, and how far a request is.
const ROOM: usize = 2;
const PHASE: usize = 205;
const ARMED: u8 = 2;
const NOTED: u8 = 3;

/// More than any loop of random programs that ends.
const LOOPED_BYTES_MAX: u64 = 200_000;

/// By the offset of an instruction: the place, what the stack was, and what was there.
type Window = BTreeMap<u16, (u16, u16, [u8; 4])>;

/// The host's side of a scan. Time stands still.
struct Seen {
    now_ms: u32,
    looped_bytes: u64,
    window: Window,
}

impl Environment for Seen {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped_bytes += u64::from(bytes);
        self.looped_bytes > LOOPED_BYTES_MAX
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, at: u16, stack: LogicStack, memory: &mut Memory) {
        if let Some((place, bits, value)) = self.window.get_mut(&at) {
            *bits =
                (0..9).fold(EXECUTED, |bits, level| bits | u16::from(stack.level(level)) << level);
            *value = [0, 1, 2, 3].map(|offset| memory.byte(*place + offset));
        }
    }
}

/// The board, and where its firmware has LINE.
struct Stepped {
    uno: Uno,
    line: usize,
}

impl Stepped {
    fn new() -> Stepped {
        let line = firmware().elf.data_symbol("LINE").expect("the firmware has a line");
        Stepped { uno: board(Code::Bytecode), line: line.into() }
    }

    fn load(&mut self, image: &[u8]) {
        self.uno.load(image.to_vec()).expect("bytecode is not translated");
        self.uno.hold_clock_for(10 * 60 * 16_000_000);
    }

    fn frame(&self) -> u16 {
        let line = &self.uno.avr().data()[self.line..];
        u16::from_le_bytes([line[0], line[1]])
    }

    /// How many entries there is room for.
    fn entries_max(&self) -> usize {
        let room = u16::from(self.uno.avr().data()[self.line + ROOM]);
        usize::from((room - FIRST - END.len() as u16) / ENTRY_LEN).min(ENTRIES_MAX)
    }

    /// The next scan fills this window in.
    fn arm(&mut self, window: &Window) {
        let entries = window.iter().flat_map(|(at, (place, ..))| {
            let mut entry = [(ADDRESS + at).to_le_bytes(), (place | BYTE).to_le_bytes()].concat();
            entry.resize(ENTRY_LEN.into(), 0);
            entry
        });
        let bytes: Vec<u8> = entries.chain(END).collect();
        let last = window.keys().last().map_or(0, |at| ADDRESS + at).to_le_bytes();
        let (frame, phase) = (usize::from(self.frame()), self.line + PHASE);
        let data = self.uno.avr_mut().data_mut();
        data[frame + usize::from(LAST)..][..last.len()].copy_from_slice(&last);
        data[frame + usize::from(FIRST)..][..bytes.len()].copy_from_slice(&bytes);
        data[phase] = ARMED;
    }

    fn filled_in(&mut self, window: &Window) -> Window {
        let at = usize::from(self.frame() + FIRST);
        let data = self.uno.avr_mut().data_mut();
        assert_eq!(data[self.line + PHASE], NOTED);
        data[self.line + PHASE] = 0;
        let entries = data[at..].chunks(ENTRY_LEN.into());
        let filled = window.iter().zip(entries).map(|((&at, &(place, ..)), entry)| {
            let value = [entry[6], entry[7], entry[8], entry[9]];
            // The top of the stack in SREG, and the levels below it.
            let stack = u16::from(entry[5]) << 1 | u16::from(entry[4] >> 6 & 1);
            let executed = if entry[4] & 0x80 == 0 { 0 } else { EXECUTED };
            (at, (place, executed | stack, value))
        });
        filled.collect()
    }
}

fn set_inputs(machine: &mut impl Machine, inputs: &Inputs) {
    let bytes = (0..)
        .zip(&inputs.digital)
        .map(|(byte, &value)| (Address::Byte { area: Area::I, byte }, value.into()));
    let analog = (0..).zip(&inputs.ain);
    let analog = analog
        .map(|(channel, &counts)| (Address::Analog(AnalogInput::Raw(channel)), counts.into()));
    for (address, value) in bytes.chain(analog) {
        assert_eq!(machine.write(Operand::At(address), value), Ok(()), "inputs can be set");
    }
}

/// Some instructions that are near each other, and bytes that a program can see.
fn random_window(rng: &mut Rng, offsets: &[u16], entries_max: usize, plan_end: u16) -> Window {
    let first = rng.usize(..offsets.len());
    let near = offsets[first..].iter().take(rng.usize(1..=entries_max));
    let near = near.take_while(|&at| at - offsets[first] < WINDOW_LEN);
    let is_left_out = if rng.bool() { 4 } else { u8::MAX };
    let mut window = Window::new();
    for &at in near {
        let in_arena = ARENA_START..plan_end.saturating_sub(4).max(ARENA_START + 1);
        let place = if rng.bool() && plan_end >= ARENA_START + 4 {
            rng.u16(in_arena)
        } else {
            rng.u16(DATA_START..AQW_START)
        };
        if window.is_empty() || rng.u8(..is_left_out) != 0 {
            window.insert(at, (place, 0, [0; 4]));
        }
    }
    window
}

/// Every instruction, hidden ones too, but for those that lead back from an interrupt routine: on
/// the board the top of the stack becomes that of the interrupted program a moment later.
fn offsets(program: &Program<Vec<u8>>) -> Vec<u16> {
    let has_events = program.plan().header.events > 0;
    let leads_back = |op: Op| has_events && matches!(op, Op::Creti | Op::Ret);
    instructions(program)
        .iter()
        .filter(|line| !leads_back(line.decoded.op))
        .map(|line| line.at)
        .collect()
}

/// A random program: of the core, of everything that is executed in its place, or with interrupts.
fn random_text(seed: u64) -> (Vec<u8>, String, Rng) {
    match seed % 3 {
        0 => random_image(seed, Programs::Core),
        1 => random_image(seed, Programs::Everything),
        _ => {
            let mut rng = Rng::with_seed(seed);
            let text = random_interrupts(&mut rng);
            (image(&text), text, rng)
        }
    }
}

/// Scans of a random program, each with another window. Returns how many instructions were executed
/// in windows, and not.
fn compare(stepped: &mut Stepped, seed: u64) -> (usize, usize) {
    let (image, text, mut rng) = random_text(seed);
    let program = verify(image.clone()).expect("the assembler makes valid images");
    let (offsets, plan_end) = (offsets(&program), program.plan().end());
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    plc.load(&mut memory, image.clone()).expect("the image is valid");
    plc.run();
    stepped.load(&image);
    let (mut inputs, mut now_ms) = (Inputs::default(), 0u32);
    let (mut executed, mut passed) = (0, 0);
    for scan in 1..=rng.u32(3..30) {
        inputs = random_inputs(&mut rng, &inputs);
        set_inputs(&mut stepped.uno, &inputs);
        // Before the first scan the board has no power.
        let window = match scan {
            1 => Window::new(),
            _ => random_window(&mut rng, &offsets, stepped.entries_max(), plan_end),
        };
        if !window.is_empty() {
            stepped.arm(&window);
        }
        let mut seen = Seen { now_ms, looped_bytes: 0, window: window.clone() };
        plc.see_inputs(&mut memory, inputs.digital[0]);
        let vm_inputs =
            plc_vm::Inputs { digital: inputs.digital, scaled: inputs.aiw, raw: inputs.ain };
        plc.scan(&mut memory, &vm_inputs, &mut seen);
        stepped.uno.scan(now_ms.into());
        assert_eq!(stepped.uno.broken(), None, "seed {seed}, scan {scan}\n{text}");
        now_ms += random_step_ms(&mut rng);
        if plc.mode() == Mode::Stop {
            break;
        }
        if !window.is_empty() {
            let found = stepped.filled_in(&window);
            assert_eq!(found, seen.window, "seed {seed}, scan {scan}\n{text}");
            let of_window = seen.window.values().filter(|&&(_, stack, _)| stack != 0).count();
            (executed, passed) = (executed + of_window, passed + window.len() - of_window);
        }
    }
    (executed, passed)
}

#[test]
fn the_engine_writes_down_what_plc_vm_saw() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 300));
    let mut stepped = Stepped::new();
    let (mut executed, mut passed) = (0, 0);
    for seed in first..first + count {
        let (more_executed, more_passed) = compare(&mut stepped, seed);
        (executed, passed) = (executed + more_executed, passed + more_passed);
    }
    println!(
        "{count} programs, {executed} instructions executed in windows, {passed} not, all equal"
    );
    assert!(
        executed as u64 > 10 * count && passed as u64 > count,
        "the windows saw hardly anything"
    );
}
