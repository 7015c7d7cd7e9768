//! Retained values on the board: what comes back after the power was off, when values are lost,
//! when they are saved.
#![cfg(feature = "uno")]

use fastrand::Rng;
use plc_isa::{Area, RETENTION_LEN, RETENTION_OVERHEAD, counter_bit, timer_bit};
use tests::effort::effort;
use tests::link::Command;
use tests::power::{Bench, EEPROM_LEN, ERASED, MS, v};
use tests::retained::{copy, generation_programs, retained_addresses};

/// Some of everything. I0.0 counts, I0.1 runs the timer, a rising I0.2 sets V and M.
const VALUES: &str = "\
//# retain VB0-VB1, MB0-MB3, C0-C9, T5
LD I0.0
LD SM0.2
CTU C3, 3
LD I0.1
TONR T5, 10000
LD I0.2
EU
MOVW 1234, VW0
MOVW 5678, MW2
S M0.0, 1
S V1.0, 1
MOVW 99, VW2
";

#[test]
fn values_come_back_and_bits_do_not() {
    let bench = Bench::new(VALUES);
    let (vw0, vw2, plan) = (v(&bench, 0), v(&bench, 2), bench.plan());
    let (m, c3, t5) = (
        plan.byte_address(Area::M, 0).unwrap(),
        plan.counter_slot(3).unwrap(),
        plan.timer_slot(5).unwrap(),
    );
    let (c3_bit, t5_bit) = (counter_bit(3), timer_bit(5));

    let mut board = bench.start(&ERASED);
    board.scan();
    assert!(board.says_lost(), "a fresh board");
    board.scan();
    assert!(!board.says_lost(), "only the first scan");
    for _ in 0..4 {
        board.inputs(0b001);
        board.scan();
        board.scan();
        board.inputs(0);
        board.scan();
        board.scan();
    }
    board.inputs(0b110);
    board.settle();
    board.pass(12_000);
    board.settle();
    // No more than a minute from scan to scan.
    for _ in 0..20 {
        board.pass(60_000);
        board.scan();
    }
    board.settle();
    assert_eq!(board.byte(c3_bit.address) >> c3_bit.bit & 1, 1);
    let timer = board.word(t5.address);
    assert!(timer > 10_000, "{timer}");
    assert_eq!(board.byte(t5_bit.address) >> t5_bit.bit & 1, 1);
    board.command(Command::Stop);
    let timer = board.word(t5.address);
    let eeprom = board.settle_and_cut();

    let mut board = bench.start(&eeprom);
    assert_eq!([board.word(vw0), board.word(vw2)], [1235, 0], "what is not retained is 0");
    assert_eq!(
        [board.byte(m), board.byte(m + 1), board.byte(m + 2), board.byte(m + 3)],
        [1, 0, 0x16, 0x2E]
    );
    assert_eq!([board.word(c3.address), board.word(t5.address)], [4, timer]);
    assert_eq!(
        [board.byte(c3_bit.address), board.byte(t5_bit.address)],
        [0, 0],
        "bits are not retained"
    );
    board.inputs(0);
    board.scan();
    assert!(!board.says_lost());
    // The S7-200 sets the bit of a counter when it is executed; that of a timer needs power flow.
    assert_eq!(board.byte(c3_bit.address) >> c3_bit.bit & 1, 1);
    assert_eq!(board.word(t5.address), timer);
}

/// A counter of scans from here on.
const SCANS: &str = "//# retain VB0-VB1\nLD SM0.0\nINCW VW0\n";
/// The same values, other instructions, other memory before them.
const SCANS_CHANGED: &str = "\
//# name other
//# retain VB0-VB1
LD SM0.2
MOVW 7, VW100
LD I0.0
TON T37, 5
LD I0.0
LD I0.1
CTU C9, 5
";

/// The EEPROM after the program has run and everything is saved, and the value of VW0 in it.
fn saved(text: &str, eeprom: &[u8]) -> (Vec<u8>, u16) {
    let bench = Bench::new(text);
    let mut board = bench.start(eeprom);
    board.scan();
    board.settle();
    board.command(Command::Stop);
    board.settle();
    let value = board.word(v(&bench, 0));
    (board.settle_and_cut(), value)
}

/// VW0 at the start of the first scan, and whether that scan is told that values were lost.
fn found(text: &str, eeprom: &[u8]) -> (u16, bool) {
    let bench = Bench::new(text);
    let mut board = bench.start(eeprom);
    let value = board.word(v(&bench, 0));
    board.scan();
    (value, board.says_lost())
}

#[test]
fn another_program_with_the_same_ranges_keeps_the_values() {
    let (eeprom, value) = saved(SCANS, &ERASED);
    assert!(value > 100);
    assert_eq!(found(SCANS, &eeprom), (value, false));
    assert_eq!(found(SCANS_CHANGED, &eeprom), (value, false));
    let timers =
        "//# retain VB0-VB1, C0-C9, T0-T3\nLD SM0.0\nINCW VW0\nMOVW VW0, C5\nMOVW VW0, T2\n";
    let (eeprom, value) = saved(timers, &ERASED);
    let others = format!("{timers}MOVW 3, C10\nMOVW 4, T4\nLD I0.0\nTON T37, 5\n");
    assert_eq!(
        found(&others, &eeprom),
        (value, false),
        "timers and counters that are not retained do not matter"
    );
}

/// An EEPROM full of copies of the counter of scans. The last has the value 1000.
fn full_ring() -> Vec<u8> {
    let bench = Bench::new(SCANS);
    let places = RETENTION_LEN / (2 + RETENTION_OVERHEAD);
    let copies = (0..places)
        .flat_map(|place| copy(bench.plan(), place, &(1001 - places + place).to_be_bytes()));
    let mut eeprom: Vec<u8> = copies.collect();
    eeprom.resize(EEPROM_LEN, 0xFF);
    eeprom
}

#[test]
fn other_ranges_lose_the_values_for_good() {
    let (eeprom, value) = (full_ring(), 1000);
    assert_eq!(found(SCANS, &eeprom), (value, false));
    let counters = "//# retain VB0-VB1, C0-C9\nLD SM0.0\nINCW VW0\n";
    let (with_c5, with_c6) =
        (format!("{counters}MOVW VW0, C5\n"), format!("{counters}MOVW VW0, C6\n"));
    for text in [
        "//# retain VB0-VB2\nLD SM0.0\nINCW VW0\n",
        "//# retain VB0-VB1, MB0\nLD SM0.0\nINCW VW0\n",
        &with_c5,
    ] {
        assert_eq!(found(text, &eeprom), (0, true), "{text}");
        let (others, other_value) = saved(text, &eeprom);
        assert_eq!(found(text, &others), (other_value, false), "{text}");
        // It must not find what it saved before the other one.
        assert_eq!(found(SCANS, &others), (0, true), "after {text}");
    }
    let (eeprom_5, _) = saved(&with_c5, &ERASED);
    assert_eq!(found(&with_c6, &eeprom_5), (0, true), "another counter of the range");
    // A program that retains nothing touches nothing.
    let nothing = Bench::new("LD SM0.0\nINCW VW0\n");
    let mut board = nothing.start(&eeprom);
    board.scan();
    assert!(!board.says_lost());
    assert_eq!(found(SCANS, &board.settle_and_cut()), (value, false));
    // Nor does one whose ranges hold nothing that it uses.
    let mut board = Bench::new("//# retain C0-C9\nLD SM0.0\nINCW VW0\n").start(&eeprom);
    board.scan();
    assert!(!board.says_lost());
    assert_eq!(found(SCANS, &board.settle_and_cut()), (value, false));
}

#[test]
fn anything_in_the_eeprom_is_no_copy() {
    let mut rng = Rng::with_seed(1);
    let random = (0..effort("RANDOM_EEPROMS", 30))
        .map(|_| (0..EEPROM_LEN).map(|_| rng.u8(..)).collect::<Vec<u8>>());
    let uniform = [0x00, 0xFF, 0xA5].map(|byte| vec![byte; EEPROM_LEN]);
    let [small, mixed, large] = generation_programs();
    let benches = [small, mixed, large].map(|text| Bench::new(&text));
    for (number, eeprom) in uniform.into_iter().chain(random).enumerate() {
        let bench = &benches[number % benches.len()];
        let retained = retained_addresses(bench.plan());
        let mut board = bench.start(&eeprom);
        assert!(board.bytes(&retained).iter().all(|&byte| byte == 0), "EEPROM {number}");
        board.scan();
        assert!(board.says_lost(), "EEPROM {number}");
    }
}

#[test]
fn the_first_copy_holds_what_the_first_scans_made_of_the_loss() {
    let text = "//# retain VB0-VB1\nLD SM0.2\nMOVW 500, VW0\n";
    let (eeprom, value) = saved(text, &[0x3C; EEPROM_LEN]);
    assert_eq!(value, 500);
    assert_eq!(found(text, &eeprom), (500, false));
    let reserved = usize::from(RETENTION_LEN);
    assert_eq!(
        eeprom[reserved..],
        [0x3C; EEPROM_LEN][reserved..],
        "what is reserved for others stays"
    );
}

/// After a hang the board waits in STOP. What it has lost is told when a scan is executed at last,
/// and saved no sooner.
#[test]
fn a_loss_is_told_before_anything_is_saved() {
    let bench = Bench::new("//# retain VB0-VB1\nLD SM0.2\nS M0.0, 1\nLD SM0.0\nINCW VW0\n");
    let marks = bench.plan().byte_address(Area::M, 0).unwrap();
    let mut board = bench.start(&ERASED);
    // The hardware watchdog resets a board whose clock stands still.
    board.hold_clock();
    board.run_for(450 * MS);
    board.avr_mut().write_eeprom(0, &ERASED).unwrap();
    board.run_for(1_000 * MS);
    board.settle();
    assert_eq!(
        [board.word(v(&bench, 0)), board.byte(marks).into()],
        [0, 0],
        "no scan was executed"
    );
    assert_eq!(board.avr().eeprom(), ERASED);
    board.command(Command::Run);
    assert_eq!(board.byte(marks), 1, "the first scan is told");
    let mut board = bench.start(&board.settle_and_cut());
    assert!(board.word(v(&bench, 0)) > 0);
    board.scan();
    assert!(!board.says_lost());
}

#[test]
fn sequence_numbers_wrap() {
    let bench = Bench::new(SCANS);
    let copy_len = 2 + usize::from(RETENTION_OVERHEAD);
    let mut eeprom = ERASED.to_vec();
    // Three copies up to the last number, in the middle of the ring; values that tell them apart.
    for (slot, sequence) in (40..).zip([0xFFFD, 0xFFFE, 0xFFFF]) {
        let at = slot * copy_len;
        eeprom[at..at + copy_len].copy_from_slice(&copy(
            bench.plan(),
            sequence,
            &sequence.to_be_bytes(),
        ));
    }
    assert_eq!(found(SCANS, &eeprom), (0xFFFF, false));
    for _ in 0..3 {
        let (next, value) = saved(SCANS, &eeprom);
        let copies: Vec<&[u8]> = next[43 * copy_len..].chunks_exact(copy_len).collect();
        let is_there = (0..10)
            .any(|sequence| copies.contains(&&*copy(bench.plan(), sequence, &value.to_be_bytes())));
        assert!(is_there, "no copy of {value} after the wrap");
        assert_eq!(found(SCANS, &next), (value, false));
        eeprom = next;
    }
}

#[test]
fn a_stop_saves_at_once() {
    let (eeprom, _) = saved(SCANS, &ERASED);
    for period in ["", "//# scan 30ms\n", "//# scan 300ms\n"] {
        let bench = Bench::new(&format!("{period}{SCANS}"));
        let vw0 = v(&bench, 0);
        let mut board = bench.start(&eeprom);
        // The first change is saved at once, the next one not for a minute.
        while board.avr().eeprom_writes().iter().sum::<u32>() < 3 {
            board.scan();
        }
        for _ in 0..20 {
            board.scan();
        }
        // With a period the command comes while the board waits for the next scan.
        board.command(Command::Stop);
        let (value, start) = (board.word(vw0), board.avr().cycles());
        while board.avr().cycles() - start < 100 * MS {
            board.scan();
        }
        let eeprom = board.cut(&mut Rng::with_seed(0));
        let mut board = bench.start(&eeprom);
        assert_eq!(board.word(vw0), value, "{period}");
        board.scan();
        assert!(!board.says_lost(), "{period}");
    }
}

#[test]
fn stops_do_not_lift_the_limit() {
    let bench = Bench::new(SCANS);
    let mut board = bench.start(&ERASED);
    board.scan();
    board.settle();
    // RUN again while the copy of STOP is being written.
    board.command(Command::Stop);
    board.command(Command::Run);
    board.settle();
    let before: u32 = board.avr().eeprom_writes().iter().sum();
    for _ in 0..50 {
        board.pass(1_000);
        for _ in 0..20 {
            board.scan();
        }
    }
    board.settle();
    assert_eq!(board.avr().eeprom_writes().iter().sum::<u32>(), before, "saved within the minute");
    board.pass(11_000);
    board.settle();
    assert!(board.avr().eeprom_writes().iter().sum::<u32>() > before, "not saved after the minute");
}
