//! What retention costs: writes of the EEPROM over hours and years, and cycles in each scan.
#![cfg(feature = "uno")]

use plc_isa::{RETENTION_LEN, RETENTION_OVERHEAD};
use tests::power::{Bench, Board, ERASED};
use tests::retained::{generation_programs, retained_addresses};

/// Writes of each byte of the EEPROM while the values of a program change in every scan and hours
/// pass.
fn writes_in(hours: u32, text: &str) -> Vec<u32> {
    const STEP_S: u32 = 20;
    let mut board = Bench::new(text).start(&ERASED);
    board.scan();
    board.settle();
    let before = board.avr().eeprom_writes();
    for _ in 0..hours * 3600 / STEP_S {
        board.pass(STEP_S * 1000);
        for _ in 0..4 {
            board.scan();
        }
        if board.avr().eeprom_writing().is_some() {
            board.settle();
        }
    }
    assert!(!board.avr().eeprom_is_misused());
    board.avr().eeprom_writes().iter().zip(before).map(|(after, before)| after - before).collect()
}

#[test]
fn changes_in_every_scan_wear_all_bytes_alike_and_slowly() {
    let [small, mixed, large] = generation_programs();
    for (text, hours) in [(small, 4), (mixed, 8), (large, 8)] {
        let copy_len =
            retained_addresses(Bench::new(&text).plan()).len() + usize::from(RETENTION_OVERHEAD);
        let copies = usize::from(RETENTION_LEN) / copy_len;
        let writes = writes_in(hours, &text);
        // The low byte of the sequence number is written in every copy, so it counts the saves of
        // its place.
        let saves: Vec<u32> = (0..copies).map(|copy| writes[copy * copy_len]).collect();
        let (least, most) = (saves.iter().min().unwrap(), saves.iter().max().unwrap());
        let sum: u32 = saves.iter().sum();
        // Until each place has been written 100,000 times.
        let years = 100_000.0 * copies as f64 / f64::from(sum) * f64::from(hours) / 8766.0;
        println!("{copies} copies, {sum} saves in {hours} h, {years:.1} years");
        assert!(sum > 10, "hardly anything was saved");
        assert!(most - least <= 1, "places of copies are not used alike: {saves:?}");
        assert_eq!(writes.iter().max(), Some(most), "a byte is written more than once in a copy");
        assert!(writes[usize::from(RETENTION_LEN)..].iter().all(|&writes| writes == 0));
        assert!(years >= 10.0, "{years} years");
    }
}

/// Longest scans in cycles, inputs to outputs, with the clock held.
#[derive(Default)]
struct Longest {
    waiting: u64,
    comparing: u64,
    snapshot: u64,
    writing: u64,
}

impl Longest {
    /// Of a program that changes VW0 in every scan while I0.0 is on.
    fn of(text: &str) -> (usize, Longest) {
        let bench = Bench::new(text);
        let len = retained_addresses(bench.plan()).len();
        let copies: Vec<u16> = (bench.plan().end()..).take(len).collect();
        let mut board = bench.start(&ERASED);
        board.inputs(0);
        board.scan();
        board.settle();
        board.hold_clock();
        // What a jump of the clock costs is another matter.
        board.scan();
        let mut longest = Longest { waiting: longest_scan(&mut board, 500), ..Longest::default() };
        board.pass(2_000_000);
        board.scan();
        longest.comparing = longest_scan(&mut board, 500);
        board.inputs(1);
        let mut snapshot = board.bytes(&copies);
        for _ in 0..3_000 {
            let cycles = longest_scan(&mut board, 1);
            let now = board.bytes(&copies);
            let kind = if now == snapshot { &mut longest.writing } else { &mut longest.snapshot };
            *kind = cycles.max(*kind);
            snapshot = now;
        }
        (len, longest)
    }
}

fn longest_scan(board: &mut Board, scans: u32) -> u64 {
    let scan = |board: &mut Board| {
        board.scan_start();
        let start = board.avr().cycles();
        board.scan();
        board.avr_mut().feed_watchdog();
        board.avr().cycles() - start
    };
    (0..scans).map(|_| scan(board)).max().unwrap_or(0)
}

/// Cycles that a scan may take longer: always, while values are compared, and while the EEPROM is
/// written.
const WAITING_MAX: u64 = 100;
const COMPARING_MAX: u64 = 850;
const WRITING_MAX: u64 = 1_500;
/// The same for each counter of the program, whose numbers are looked through for a range of them.
const COMPARING_COUNTER_MAX: u64 = 30;
/// When a copy is begun: for itself, for each byte and for each counter.
const SNAPSHOT_MAX: u64 = 2_500;
const SNAPSHOT_BYTE_MAX: u64 = 14;
const SNAPSHOT_COUNTER_MAX: u64 = 310;

#[test]
fn no_scan_takes_much_longer() {
    let program = |ranges: &str, uses: &str| format!("{ranges}LD SM0.2\n{uses}LD I0.0\nINCW VW0\n");
    let uses = |counters: u64| -> String {
        (0..counters).map(|number| format!("MOVW 0, C{number}\n")).collect()
    };
    println!("bytes  waiting  comparing  snapshot  writing: more cycles than without retention");
    for (ranges, counters) in [
        ("VB0-VB1", 0),
        ("VB0-VB31", 0),
        ("VB0-VB127", 0),
        ("VB0-VB405, MB0-MB31, VB0-VB51", 0),
        ("VB0-VB1, C0-C31", 32),
        ("VB0-VB1, C0-C255", 178),
    ] {
        let uses = uses(counters);
        let (_, without) = Longest::of(&program("", &uses));
        let (len, longest) = Longest::of(&program(&format!("//# retain {ranges}\n"), &uses));
        let [waiting, comparing, snapshot, writing] =
            [longest.waiting, longest.comparing, longest.snapshot, longest.writing]
                .map(|cycles| cycles.saturating_sub(without.waiting));
        println!("{len:>5}  {waiting:>7}  {comparing:>9}  {snapshot:>8}  {writing:>7}: {ranges}");
        assert!(waiting <= WAITING_MAX && writing <= WRITING_MAX);
        assert!(comparing <= COMPARING_MAX + COMPARING_COUNTER_MAX * counters);
        assert!(snapshot > 0, "no copy was begun");
        assert!(
            snapshot
                <= SNAPSHOT_MAX + SNAPSHOT_BYTE_MAX * len as u64 + SNAPSHOT_COUNTER_MAX * counters
        );
    }
}
