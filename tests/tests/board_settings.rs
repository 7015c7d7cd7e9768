//! Settings, analog inputs and the clock's wrap with the shipped firmware on a simulated Uno, at
//! its pins and in cycles.
#![cfg(feature = "uno")]

use fastrand::Rng;
use plc_isa::{AIN_START, AIW_START, ANALOG_INPUTS, AnalogInput, M_START, SM_START};
use plc_vm::Fault;
use tests::bench_board::{BenchBoard, MS, Scan, image};
use tests::link;

/// Each output follows the input of its number.
const FOLLOW: &str = "LD I0.0\n= Q0.0\nLD I0.1\n= Q0.1\nLD I0.2\n= Q0.2\nLD I0.3\n= Q0.3\n\
    LD I0.4\n= Q0.4\nLD I0.5\n= Q0.5\n";

#[test]
fn pull_ups_are_on_exactly_where_the_program_asks() {
    let mut board = BenchBoard::new();
    for (setting, bits) in [
        ("", 0),
        ("//# pullup I0.0-I0.5\n", 0b11_1111),
        ("//# pullup I0.0, I0.2-I0.3, I0.5\n", 0b10_1101),
        ("//# pullup I0.4\n", 0b01_0000),
    ] {
        board.insert(&image(&format!("{setting}{FOLLOW}")));
        board.power_up();
        board.scan();
        assert_eq!((board.runs(), board.pull_ups()), (true, bits), "{setting}");
        link::stop(&mut board);
        assert_eq!((board.runs(), board.pull_ups()), (false, bits), "in STOP too: {setting}");
    }
    board.insert(&[]);
    board.power_up();
    assert_eq!(board.pull_ups(), 0, "without a program");
}

#[test]
fn inputs_and_outputs_are_inverted_exactly_where_the_program_asks() {
    let mut board = BenchBoard::new();
    for (setting, inverted_inputs, inverted_outputs) in [
        ("", 0, 0),
        ("//# invert I0.3, Q0.0-Q0.4\n", 0b00_1000, 0b01_1111),
        ("//# invert I0.0-I0.5, Q0.5\n", 0b11_1111, 0b10_0000),
    ] {
        board.drive_inputs(0);
        board.insert(&image(&format!("{setting}{FOLLOW}")));
        board.power_up();
        for pins in 0..64 {
            board.drive_inputs(pins);
            // The inputs of the scan that has begun may have been read.
            board.scans(2);
            assert_eq!(
                board.outputs(),
                Some(pins ^ inverted_inputs ^ inverted_outputs),
                "{setting}{pins:06b}"
            );
        }
        link::stop(&mut board);
        assert!(board.is_released(), "in STOP nothing is driven, inverted or not: {setting}");
    }
}

/// A fixed period. I0.0 and I0.1 make the scan longer than one period, and than three.
const PERIOD_MS: u64 = 10;
const PERIODIC: &str = "//# scan 10ms\nLD I0.0\nFOR MW0, 1, 2200\nNEXT\nLD I0.1\n\
    FOR MW0, 1, 5500\nNEXT\nLD SM0.0\n= Q0.0\n";

/// Cycles from the start of each scan to that of the next.
fn periods(scans: &[Scan]) -> Vec<u64> {
    scans.windows(2).map(|pair| pair[1].start - pair[0].start).collect()
}

/// The board waits in a loop, of which a pass takes so long when nothing is said: it looks at the
/// clock and the serial line. The millisecond's interrupt and the last pass come to that.
const PERIOD_JITTER_CYCLES: u64 = 1_600;
/// In the wait a line of an answer may be begun, and takes until its end.
const PERIOD_JITTER_TALKING_CYCLES: u64 = 3 * MS;

/// How far the starts of scans are from a grid of the period, from the first of them on.
fn jitter(scans: &[Scan]) -> u64 {
    let due = (0..).map(|index| scans[0].start + index * PERIOD_MS * MS);
    scans.iter().zip(due).map(|(scan, due)| scan.start.abs_diff(due)).max().unwrap_or_default()
}

#[test]
fn a_fixed_period_is_kept() {
    let mut board = BenchBoard::running(PERIODIC);
    let scans = board.scans(300);
    let quiet = jitter(&scans);
    assert_eq!(
        [22, 24, 26].map(|byte| board.word(SM_START + byte)),
        [10, 10, 10],
        "SMW22, SMW24, SMW26"
    );
    let mut rng = Rng::with_seed(1);
    let mut ask_and_scan = || {
        // Some time in the wait.
        board.run_on(rng.u64(..PERIOD_MS * MS * 3 / 4));
        board.say(&link::frame(link::UNIT, &[65]));
        board.scan()
    };
    let talked = jitter(&(0..300).map(|_| ask_and_scan()).collect::<Vec<Scan>>());
    println!("period of 10 ms: {quiet} cycles of jitter, {talked} with answers all the time");
    assert!(quiet <= PERIOD_JITTER_CYCLES, "{quiet} cycles");
    assert!(talked <= PERIOD_JITTER_TALKING_CYCLES, "{talked} cycles");
    assert!((9..=11).contains(&board.word(SM_START + 22)), "SMW22 = {}", board.word(SM_START + 22));
}

/// From the end of a scan to the start of the next one that is due already.
const AT_ONCE_CYCLES: u64 = 1_600;

#[test]
fn a_scan_longer_than_its_period_starts_the_next_at_once() {
    let mut board = BenchBoard::running(PERIODIC);
    for (inputs, periods_min) in [(1, 1), (2, 3), (3, 4)] {
        board.drive_inputs(inputs);
        board.scans(2);
        let long = board.scans(30);
        for pair in long.windows(2) {
            assert!(
                pair[0].cycles() > periods_min * PERIOD_MS * MS,
                "{} cycles are not long",
                pair[0].cycles()
            );
            let pause = pair[1].start - pair[0].end;
            assert!(pause <= AT_ONCE_CYCLES, "{pause} cycles between scans that are late");
        }
        board.drive_inputs(0);
        // One that still is long, perhaps; then what has been late is not made up for but for one
        // scan.
        board.scans(1);
        let after = periods(&board.scans(30));
        let early =
            after.iter().filter(|&&cycles| cycles + PERIOD_JITTER_CYCLES < PERIOD_MS * MS).count();
        println!("scans of {} ms: {early} early scans afterwards", long[1].cycles() / MS);
        assert!(early <= 1, "{after:?}");
        assert!(jitter(&board.scans(30)) <= PERIOD_JITTER_CYCLES);
    }
}

/// Outputs by timers of all resolutions and by the system's clocks.
const CLOCKED: &str = "LD SM0.5\n= Q0.0\nTON T32, 123\nTON T33, 25\nTON T37, 4\nLD T32\n= Q0.1\n\
    LD T33\n= Q0.2\nLD T37\n\
    = Q0.3\nLD SM0.4\n= Q0.4\nLD SM0.5\nTOF T96, 77\nLD T96\n= Q0.5\n";

/// A clock that wraps after so many milliseconds of the program, and one that wraps in 49 days.
const WRAP_AFTER_MS: u32 = 1_620;
const CLOCK_STARTS: [u32; 2] = [0_u32.wrapping_sub(WRAP_AFTER_MS), 1_000_000];

/// A board before its first scan with the clock at this time.
fn board_at(program: &str, clock_ms: u32) -> BenchBoard {
    let mut board = BenchBoard::new();
    board.insert(&image(program));
    board.power_up();
    board.set_tick(clock_ms);
    board
}

/// So long after the start scans are longer because of what the board says.
const BANNER_MS: u64 = 50;

/// The changes of the outputs, with their time in cycles, and the longest time between two scans'
/// ends.
fn edges(clock_ms: u32, milliseconds: u64) -> (Vec<(u64, u8)>, u64) {
    let mut board = board_at(CLOCKED, clock_ms);
    let start = board.avr.cycles();
    let (mut edges, mut last, mut longest) = (Vec::new(), (start, None), 0);
    while last.0 < start + milliseconds * MS {
        let now = board.scan().end;
        let outputs = board.outputs().expect("in RUN");
        if last.1.replace(outputs) != Some(outputs) {
            edges.push((now - start, outputs));
        }
        if now > start + BANNER_MS * MS {
            longest = longest.max(now - last.0);
        }
        last.0 = now;
        assert_eq!((board.runs(), board.fault()), (true, None));
    }
    assert_eq!(
        board.tick() < clock_ms,
        clock_ms == CLOCK_STARTS[0],
        "the clock has wrapped in one case only"
    );
    (edges, longest)
}

#[test]
fn the_wrap_of_the_clock_is_not_seen_in_timers_and_clock_bits() {
    // Longer than half a minute, for SM0.4.
    let [(near, near_longest), (far, far_longest)] =
        CLOCK_STARTS.map(|clock_ms| edges(clock_ms, 31_700));
    let scan = near_longest.max(far_longest);
    assert_eq!(near.len(), far.len());
    // A second: SM0.5 on, three timers on, SM0.5 off and three timers with it, T96 off.
    assert!(near.len() >= 31 * 6, "{} edges", near.len());
    assert!(near.iter().any(|(_, outputs)| outputs >> 4 & 1 == 1), "SM0.4");
    let apart =
        near.iter().zip(&far).map(|(near, far)| near.0.abs_diff(far.0)).max().unwrap_or_default();
    println!("{} edges, at most {apart} cycles apart; the longest scan took {scan}", near.len());
    for (near, far) in near.iter().zip(&far) {
        assert_eq!(near.1, far.1, "at {} ms", near.0 / MS);
        assert!(near.0.abs_diff(far.0) <= scan, "{near:?} and {far:?}");
    }
}

#[test]
fn the_wrap_of_the_clock_is_not_seen_in_the_period() {
    for clock_ms in CLOCK_STARTS {
        let mut board = board_at(PERIODIC, clock_ms);
        // Periods go on from the time that was set.
        board.scans(5);
        let found = jitter(&board.scans(300));
        assert!(found <= PERIOD_JITTER_CYCLES, "{found} cycles");
        // Not SMW24: the first scan came before the clock was set, and has a short period.
        assert_eq!([22, 26].map(|byte| board.word(SM_START + byte)), [10, 10]);
    }
}

#[test]
fn the_wrap_of_the_clock_is_not_seen_by_the_watchdogs() {
    for wrap_after_ms in [1, 200, 499] {
        let mut board = BenchBoard::running("LBL 1\nLD I0.0\nJMP 1\nLD SM0.0\n= Q0.0\n");
        board.to_scan_start();
        board.drive_inputs(1);
        board.set_tick(0_u32.wrapping_sub(wrap_after_ms));
        let cycles = board.run_until(100, 1_000 * MS, |board| board.is_released());
        board.scan();
        assert!(matches!(board.fault(), Some(Fault::Watchdog { .. })), "{:?}", board.fault());
        // The tolerance of a tick, as without the wrap, and the rest of the scan, which switches
        // the outputs off.
        assert!(cycles.abs_diff(500 * MS) <= MS + 2_000, "{} cycles", cycles);
        // The hardware watchdog has nothing to say.
        board.drive_inputs(0);
        link::run(&mut board);
        assert!(board.runs());
        board.scans_for(1_000);
        assert_eq!((board.runs(), board.fault(), board.outputs()), (true, None, Some(1)));
    }
}

/// Raw and scaled values of all analog inputs, as programs read them.
fn analog(board: &BenchBoard) -> Vec<(u16, u16)> {
    (0..ANALOG_INPUTS)
        .map(|channel| 2 * channel)
        .map(|at| (board.word(AIN_START + at), board.word(AIW_START + at)))
        .collect()
}

fn set_analog(board: &mut BenchBoard, counts: &[u16]) -> Vec<(u16, u16)> {
    (0..).zip(counts).for_each(|(channel, &counts)| board.avr.set_counts(channel, counts));
    counts.iter().map(|&counts| (counts, AnalogInput::scale(counts))).collect()
}

/// Each input is converted every 6 ms. A voltage that changes just after that is converted 6 ms
/// later, and the result is taken with the tick after it; then comes the start of a scan.
const ANALOG_REFRESH_MS: u64 = 7;

#[test]
fn analog_inputs_reach_the_program() {
    let mut board = BenchBoard::new();
    board.insert(&image("LD SM0.1\nMOVW Ain0, MW0\nMOVW AIW10, MW2\nLD SM0.0\n= Q0.0\n"));
    let expected = set_analog(&mut board, &[1_023, 1, 2, 3, 4, 500]);
    board.power_up();
    board.scan();
    assert_eq!(analog(&board), expected, "in the first scan");
    assert_eq!([0, 2].map(|byte| board.word(M_START + byte)), [1_023, AnalogInput::scale(500)]);
    let (mut rng, mut longest) = (Rng::with_seed(1), 0);
    let mut values = vec![
        [0; 6],
        [1_023; 6],
        [512; 6],
        [0, 1_023, 0, 1_023, 0, 1_023],
        [0, 1, 511, 512, 1_022, 1_023],
    ];
    // Every count there is.
    values.extend(
        (0..171).map(|first| [0, 171, 342, 513, 684, 855].map(|more| (first + more).min(1_023))),
    );
    for counts in values {
        board.run_on(rng.u64(..2 * MS));
        let expected = set_analog(&mut board, &counts);
        let changed = board.avr.cycles();
        let mut scan = board.scan();
        while analog(&board) != expected {
            assert!(scan.end - changed < 100 * MS, "{:?} instead of {expected:?}", analog(&board));
            scan = board.scan();
        }
        longest = longest.max(scan.end - changed);
        let scans = board.scans_for(20);
        assert_eq!(analog(&board), expected, "a value that stays does not change");
        let scan_max = scans.iter().map(|scan| scan.cycles()).max().unwrap_or_default();
        assert!(
            scan.end - changed <= ANALOG_REFRESH_MS * MS + 2 * scan_max,
            "{} cycles",
            scan.end - changed
        );
    }
    println!("analog inputs: in memory after at most {} us", longest / (MS / 1000));
}

#[test]
fn a_filter_smooths_and_ends_at_the_value_itself() {
    let mut board = BenchBoard::running("//# filter 8\nLD SM0.0\n= Q0.0\n");
    for counts in [1_023, 0, 512, 511] {
        let before = board.word(AIN_START);
        board.avr.set_counts(0, counts);
        let mut values = vec![before];
        for _ in 0..100 {
            board.scans_for(6);
            values.push(board.word(AIN_START));
        }
        let is_monotonic = values.is_sorted() || values.iter().rev().is_sorted();
        assert!(is_monotonic && values.last() == Some(&counts), "{values:?}");
        // After eight samples 1 - (7/8)^8 of the way, or one sample more or less.
        let (way, whole) =
            (f64::from(values[8].abs_diff(before)), f64::from(counts.abs_diff(before)));
        assert!(whole < 100.0 || (0.55..0.75).contains(&(way / whole)), "{values:?}");
    }
}
