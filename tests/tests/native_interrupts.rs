//! The interrupt of the millisecond clock may come between any two instructions of the board that a
//! program is made of: what the program does stays the same, interpreted and translated.
//!
//! The program's part of one scan is run again and again, each time with the interrupt, which
//! nothing else than the real timer raises, one instruction later.
#![cfg(feature = "uno")]

use std::collections::BTreeSet;
use std::ops::Range;

use awl_asm::native::translate;
use awl_sim::machine::uno::{Code, MS, SRAM};
use plc_isa::{DATA_END, DATA_START, Group, INSTRUCTIONS, Instruction, Op, SLOT_END, SLOT_START};
use simavr::Stopped;
use tests::bench_board::{BenchBoard, example, firmware, image};
use tests::forms::places;

/// Where the interrupt of the millisecond clock begins: TIMER0_COMPA; and all vectors but that of
/// the reset.
const TICK_VECTOR: u32 = 0x38;
const VECTORS: Range<u32> = 0x04..0x68;
/// The registers, and the stack pointer, in data memory.
const REGISTERS: Range<usize> = 0..32;
const STACK_POINTER: usize = 0x5D;
/// Register in which the engine tells why the program was left.
const REASON: usize = 24;
/// A place in the slot, after every program: `nop`, and a jump to itself in two cycles; `set` and
/// `reti`.
const IDLE: u32 = SLOT_END as u32 - 8;
const JUMP: u32 = IDLE + 2;
const LOSE_TOP: u32 = IDLE + 4;
const IDLE_CODE: [u8; 8] = [0x00, 0x00, 0xFF, 0xCF, 0x68, 0x94, 0x18, 0x95];
/// `sei`, and `out SREG, r`, whatever the register. After them simavr executes two more
/// instructions before an interrupt comes, the chip one.
const SEI: u16 = 0x9478;
const OUT_SREG: (u16, u16) = (0xBE0F, 0xFE0F);
const ENABLE_DELAY: usize = 2;
/// Longer than the board talks when it is switched on.
const BANNER_MS: u64 = 50;
/// The clock at the start of a scan, and how it goes on from scan to scan: to where no clock bit
/// differs, no interval ends a millisecond later, and every timer is at its end.
const FIRST_MS: u32 = 1_000;
const PASSED_MS: u32 = 60_000;
const INTO_INTERVAL_MS: u32 = 5;
/// Cycles before an interrupt is due from which on every instruction is watched: more than the
/// longest takes.
const WATCHED: u64 = 10;
/// Longest time that an interrupt takes.
const INTERRUPT_MAX: u64 = 500;
/// Of so many places only one may have interrupts off.
const LATE_RARITY: usize = 20;
/// No program here has more instructions of the board.
const STEPS_MAX: usize = 20_000;

/// A place between two instructions of the board: its address, and the cycles since the program was
/// begun.
type Boundary = (u32, u64);

/// What the program has done.
#[derive(Debug, PartialEq, Eq)]
struct Done {
    memory: Vec<u8>,
    /// Registers that it must keep, and the stack pointer.
    kept: Vec<u8>,
    /// Why it was left.
    reason: u8,
}

/// A board that repeats the program's part of a scan.
struct Repeater {
    board: BenchBoard,
    /// Addresses of the first and the last instruction of this part.
    enter: u32,
    leave: u32,
    /// Data memory when the program begins, registers included.
    before: Vec<u8>,
    /// A cycle in which the interrupt is due.
    due: u64,
}

impl Repeater {
    /// Runs the program for a few scans with different inputs, and is where it begins in the
    /// next.
    fn new(code: Code, image: &[u8]) -> Repeater {
        let (firmware, mut board) = (firmware(), BenchBoard::new());
        let symbol = |name| {
            firmware.elf.flash_symbol(name).unwrap_or_else(|| panic!("the firmware has no {name}"))
        };
        let (enter, leave) = match code {
            Code::Bytecode => (symbol("uno200_run"), symbol("uno200_run_end")),
            Code::Native => (symbol("uno200_run_native"), symbol("uno200_run_native_end")),
        };
        let translated = (code == Code::Native)
            .then(|| translate(image).unwrap_or_else(|error| panic!("{error}")).image);
        board.insert(translated.as_deref().unwrap_or(image));
        board.power_up();
        // After the check of the slot's content.
        let idle = &mut board.slot()[(IDLE - u32::from(SLOT_START)) as usize..];
        assert!(idle.iter().all(|&byte| byte == 0xFF), "the program reaches the end of the slot");
        idle.copy_from_slice(&IDLE_CODE);
        // Until the serial line has said everything.
        board.scans_for(BANNER_MS);
        let mut clock_ms = FIRST_MS;
        board.set_tick(clock_ms);
        board.scan();
        clock_ms += INTO_INTERVAL_MS;
        for inputs in [0b00_0110, 0b00_0111, 0b10_0010, 0b01_0101] {
            board.drive_inputs(inputs);
            board.to_scan_start();
            clock_ms += PASSED_MS;
            board.set_tick(clock_ms);
            if inputs != 0b01_0101 {
                board.scan();
                assert!(board.runs(), "{:?}", board.fault());
            }
        }
        let mut repeater = Repeater { board, enter, leave, before: Vec::new(), due: 0 };
        repeater.step_to(enter);
        repeater.before = repeater.board.avr.data().to_vec();
        repeater.find_tick();
        repeater
    }

    /// Executes instructions until this one is the next. Returns the places on the way, the first
    /// one included.
    fn step_to(&mut self, address: u32) -> Vec<Boundary> {
        let (start, mut places) = (self.board.avr.cycles(), Vec::new());
        while self.board.avr.pc() != address {
            places.push((self.board.avr.pc(), self.board.avr.cycles() - start));
            assert_eq!(self.board.avr.step(), Stopped::Limit);
            assert!(places.len() <= STEPS_MAX, "the board does not come to {address:#06x}");
        }
        places
    }

    /// Finds out when the interrupt comes, to the cycle: jumps end in every second, so it is waited
    /// for twice.
    fn find_tick(&mut self) {
        let first = self.tick_from(JUMP);
        let is_even = (self.board.avr.cycles() - first).is_multiple_of(2);
        let second = self.tick_from(if is_even { IDLE } else { JUMP });
        self.due = first.min(second - MS);
        assert_eq!(first.abs_diff(second - MS), 1);
    }

    /// Waits for the interrupt and until it is over.
    fn tick_from(&mut self, address: u32) -> u64 {
        self.board.avr.set_pc(address);
        self.step_to(TICK_VECTOR);
        let tick = self.board.avr.cycles();
        self.step_to(JUMP);
        tick
    }

    /// Waits until the interrupt is due in so many cycles, then begins the program anew.
    fn begin(&mut self, cycles: u64) {
        let avr = &mut self.board.avr;
        avr.feed_watchdog();
        avr.set_pc(JUMP);
        let earliest = avr.cycles() + cycles + WATCHED;
        let start = self.due + (earliest - self.due).next_multiple_of(MS) - cycles;
        avr.run_to_mark(start - WATCHED - avr.cycles());
        while avr.cycles() < start {
            // A jump takes two cycles.
            if avr.pc() == JUMP && (start - avr.cycles()) % 2 == 1 {
                avr.set_pc(IDLE);
            }
            avr.step();
        }
        assert_eq!((avr.cycles(), avr.pc()), (start, JUMP));
        for part in [REGISTERS, SRAM] {
            avr.data_mut()[part.clone()].copy_from_slice(&self.before[part]);
        }
        avr.set_pc(self.enter);
    }

    /// What the program has done that has just ended.
    fn done(&self) -> Done {
        let data = self.board.avr.data();
        let kept = [&data[2..18], &data[28..30], &data[STACK_POINTER..STACK_POINTER + 2]].concat();
        Done {
            memory: data[DATA_START.into()..DATA_END.into()].to_vec(),
            kept,
            reason: data[REASON],
        }
    }

    /// The program without an interrupt, and all places between its instructions.
    fn undisturbed(&mut self) -> (Done, Vec<Boundary>) {
        self.begin(MS - INTERRUPT_MAX);
        let places = self.step_to(self.leave);
        assert!(
            places.iter().all(|(place, _)| !VECTORS.contains(place)),
            "the program is too long for this test"
        );
        (self.done(), places)
    }

    /// The program with an interrupt that is due after so many cycles, and where it came.
    fn interrupted(&mut self, cycles: u64) -> (Done, Boundary) {
        self.begin(cycles);
        let start = self.board.avr.cycles();
        self.board.avr.run_to_mark(cycles.saturating_sub(WATCHED));
        self.step_to(TICK_VECTOR);
        let place = (self.return_address(), self.board.avr.cycles() - start);
        self.step_to(self.leave);
        (self.done(), place)
    }

    /// Whether this instruction allows interrupts.
    fn enables_interrupts(&self, address: u32) -> bool {
        let flash = &self.board.avr.flash()[address as usize..];
        let word = u16::from_le_bytes([flash[0], flash[1]]);
        word == SEI || word & OUT_SREG.1 == OUT_SREG.0
    }

    fn return_address(&self) -> u32 {
        let data = self.board.avr.data();
        let sp = usize::from(u16::from_le_bytes([data[STACK_POINTER], data[STACK_POINTER + 1]]));
        2 * u32::from(u16::from_be_bytes([data[sp + 1], data[sp + 2]]))
    }
}

/// Every instruction of the table, all executed but STOP and END.
const EVERYTHING: &str = "\
ORGANIZATION_BLOCK MAIN:OB1
BEGIN
LD I0.0
AN I0.1
O M0.0
ON V0.0
NOT
= Q0.0
LDN I0.2
A M1.1
EU
S M2.0, 1
LD I0.0
ED
R M3.0, 1
LD SM0.0
S Q0.1, 2
R M4.0, 9
R T97, 1
R C7, 2
MOVB 3, VB20
S M5.0, VB20
NOP 7
LD I0.0
LD I0.2
ALD
LD M0.3
OLD
LPS
A I0.0
= M0.4
LRD
LDS 1
= M0.5
LPP
LPP
= M0.6
LDW>= VW2, 5
AW< VW2, VW4
OW= VW4, 7
= M0.7
LDB<> VB20, 3
AB= MB1, 2
OB> VB20, MB1
= M1.0
LD SM0.0
MOVB VB20, VB21
MOVW -7, VW2
MOVW AIW0, VW4
+I 3, VW2
-I VW2, VW6
*I VW2, VW6
/I 2, VW6
/I VW30, VW8
INCW VW10
DECW VW12
LD I0.0
TON T37, 20
TOF T38, VW2
LDN I0.0
TONR T5, 30
TON T33, 4
LD SM0.0
TON T32, 5
LD I0.0
TOF T96, 5
LD I0.0
LD I0.3
CTU C1, 3
LD I0.2
LD I0.3
CTD C2, VW2
LD I0.0
LD I0.2
LD I0.3
CTUD C3, 4
LD SM0.0
FOR VW14, 1, 3
INCW VW16
LD I0.0
= M6.0
NEXT
LD I0.0
JMP 1
INCW VW18
LBL 1
MOVW 3, VW22
NETWORK 2
LSCR S0.0
LDN I0.4
A SM0.0
CSCRE
LD I0.1
SCRT S0.1
SCRE
LD SM0.0
LPS
CALL SBR0, I0.0, 3, VW24, M6.1
LPP
+I 32767, VW24
AENO
= M6.2
LBL 2
LD SM0.0
DECW VW22
WDR
LDW> VW22, 0
JMP 2
LD I1.0
STOP
END
END_ORGANIZATION_BLOCK
SUBROUTINE_BLOCK Inner:SBR1
BEGIN
LD I0.0
CRET
INCW VW28
END_SUBROUTINE_BLOCK
SUBROUTINE_BLOCK Outer:SBR0
VAR_INPUT
on:BOOL;
n:INT;
END_VAR
VAR_OUTPUT
sum:INT;
same:BOOL;
END_VAR
BEGIN
LD #on
= #same
LD SM0.0
LPS
MOVW #n, #sum
+I 4, #sum
CALL SBR1
LPP
= M6.3
END_SUBROUTINE_BLOCK
";

#[test]
fn the_program_has_every_instruction() {
    let found: BTreeSet<Op> =
        places(&image(EVERYTHING)).iter().map(|place| place.row.instruction.op).collect();
    // Modules are called like the bytecode of others, and events would come at other times.
    let is_translated = |row: &&Instruction| {
        row.module().is_none() && ![Group::Hidden, Group::Interrupt].contains(&row.group)
    };
    let missing = INSTRUCTIONS.iter().filter(is_translated).filter(|row| !found.contains(&row.op));
    assert_eq!(missing.map(|row| row.mnemonics[0]).collect::<Vec<_>>(), [""; 0]);
}

/// What the interrupt has done to a program.
struct Found {
    /// Where it was due, each once.
    places: usize,
    /// Where it could not come at once, because interrupts were off.
    late: usize,
    /// Where it came when the program has then done something else.
    changed: Vec<u32>,
}

/// Interrupts a program once at every place between its instructions.
fn interrupt_everywhere(repeater: &mut Repeater) -> Found {
    let (wanted, places) = repeater.undisturbed();
    let mut found = Found { places: places.len() - 1, late: 0, changed: Vec::new() };
    // Before the first instruction it would be an interrupt of whoever calls.
    for index in 1..places.len() {
        let (done, place) = repeater.interrupted(places[index].1);
        if place != places[index] {
            let came = places.iter().position(|&other| other == place);
            let came =
                came.unwrap_or_else(|| panic!("it came at {:#06x}, {} cycles", place.0, place.1));
            let is_late =
                came > index && repeater.enables_interrupts(places[came - 1 - ENABLE_DELAY].0);
            assert!(is_late, "due at {:#06x?}, it came at {place:#06x?}", places[index]);
            found.late += 1;
        }
        if done != wanted {
            found.changed.push(place.0);
        }
    }
    println!("{} places, {} of them with interrupts off", found.places, found.late);
    found
}

#[test]
fn an_interrupt_anywhere_changes_nothing() {
    for code in [Code::Bytecode, Code::Native] {
        for (name, image) in [("everything", image(EVERYTHING)), ("station1", example("station1"))]
        {
            println!("{name}, {code:?}");
            let found = interrupt_everywhere(&mut Repeater::new(code, &image));
            assert_eq!(
                found.changed, [0; 0],
                "{name}, {code:?}: changed by an interrupt at these places"
            );
            assert!(
                found.late * LATE_RARITY < found.places,
                "{name}, {code:?}: interrupts are off at too many places"
            );
        }
    }
}

/// The test itself: it must see an interrupt that leaves something after.
#[test]
fn an_interrupt_that_loses_the_t_flag_is_seen() {
    for code in [Code::Bytecode, Code::Native] {
        let mut repeater = Repeater::new(code, &example("station1"));
        let [low, high] = ((LOSE_TOP / 2) as u16).to_le_bytes();
        // An absolute jump.
        repeater.board.avr.write_flash(TICK_VECTOR, &[0x0C, 0x94, low, high]).unwrap();
        let found = interrupt_everywhere(&mut repeater);
        assert!(found.changed.len() > 10, "{code:?}: {:x?}", found.changed);
    }
}
