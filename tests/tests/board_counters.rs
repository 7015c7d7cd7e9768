//! High-speed counters on the board, by its own clock: each pulse that was driven is counted, and
//! nothing else, as on the host. What the modes are, the cases say.
#![cfg(feature = "uno")]

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::machine::uno::Mark;
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::{ARENA_START, HC0, HC3, SM_START};
use tests::bench_board::{BenchBoard, MS, example_text};
use tests::case::{Case, host};
use tests::image::image;
use tests::link;
use tests::own_clock::assert_cases_hold;

/// Cycles in a second.
const S: u64 = 1_000 * MS;

/// HC0 or HC3.
fn count(board: &BenchBoard, address: u16) -> i32 {
    i32::from(board.word(address)) << 16 | i32::from(board.word(address + 2))
}

/// What a program sees: the word VW`byte`, when the V memory of the program begins with VB0.
fn vw(board: &BenchBoard, byte: u16) -> i16 {
    board.word(ARENA_START + byte) as i16
}

/// Runs for so many cycles, over marks.
fn run(board: &mut BenchBoard, cycles: u64) {
    let end = board.avr.cycles() + cycles;
    while board.avr.cycles() < end {
        board.run_on(end - board.avr.cycles());
    }
}

/// So many edges, one each half period: the levels of I0.0 and I0.1 follow each other in this
/// order.
fn edges(board: &mut BenchBoard, levels: &[u8], count: usize, cycles: u64) {
    for level in levels.iter().cycle().take(count) {
        board.drive_inputs(*level);
        run(board, cycles);
    }
}

/// A main program, and three interrupt routines that count how often they are executed in VW0, VW2,
/// VW4.
fn program(main: &str) -> String {
    let routine = |number: u8| {
        format!(
            "INTERRUPT_BLOCK I{number}:INT{number}\nBEGIN\nLD SM0.0\nINCW VW{}\n\
                END_INTERRUPT_BLOCK\n",
            2 * number
        )
    };
    let routines: String = (0..3).map(routine).collect();
    format!(
        "//# memory VB0-VB31\nORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}\nEND_ORGANIZATION_BLOCK\n\
            {routines}"
    )
}

/// HSC0 in a mode from the first scan on; its events and its status are in V memory.
fn counting(mode: u8, control: u8, preset: i32) -> String {
    program(&format!(
        "LD SM0.1\nMOVB {control}, SMB37\nMOVD {preset}, SMD42\nATCH I0, 12\nATCH I1, 27\n\
            ATCH I2, 28\nENI\n\
         HDEF 0, {mode}\nHSC 0\nLD SM0.0\nMOVB SMB36, VB8\nINCW VW10"
    ))
}

/// The host after the same edges: a scan for each.
struct Model {
    host: Host,
    now_ms: u64,
}

impl Model {
    fn new(text: &str) -> Model {
        let mut model = Model { host: host(&image(text)), now_ms: 0 };
        model.see(0);
        model
    }

    fn see(&mut self, levels: u8) {
        self.host.write(operand("IB0"), i32::from(levels)).unwrap();
        self.host.scan(self.now_ms);
        self.now_ms += 1;
    }

    fn get(&mut self, name: &str) -> i32 {
        self.host.read(operand(name)).unwrap()
    }
}

fn operand(name: &str) -> Operand {
    Operand::parse(name, &[]).unwrap()
}

/// Random edges of I0.0 to I0.2, so many cycles apart: board and host have the same value and
/// status afterwards, and when there is time for them, the same interrupts.
fn assert_same(seed: u64, mode: u8, control: u8, inverted: u8, gap: std::ops::Range<u64>) {
    let names = ["", "I0.0", "I0.1", "I0.0, I0.1", "I0.2", "I0.0, I0.2", "I0.1, I0.2", "I0.0-I0.2"];
    let settings = match names[usize::from(inverted)] {
        "" => String::new(),
        names => format!("//# invert {names}\n"),
    };
    let text = format!("{settings}{}", counting(mode, control, 3));
    let (mut model, mut rng) = (Model::new(&text), Rng::with_seed(seed));
    let mut board = BenchBoard::new();
    board.insert(&image(&text));
    board.drive_inputs(inverted);
    board.power_up();
    board.scan();
    assert!(board.runs(), "{:?}", board.fault());
    let (mut levels, has_time) = (0, gap.start >= MS / 2);
    for _ in 0..400 {
        // A counter that is reset all the time counts nothing.
        let input = if rng.u8(..8) == 0 { 2 } else { rng.u8(..2) };
        levels ^= 1 << input;
        model.see(levels);
        board.drive_inputs(levels ^ inverted);
        run(&mut board, rng.u64(gap.clone()));
        let found = count(&board, HC0);
        assert_eq!(
            found,
            model.get("HC0"),
            "mode {mode}, control {control:#x}, seed {seed}, inverted {inverted}"
        );
    }
    board.scans(3);
    model.see(levels);
    assert_eq!(
        i32::from(vw(&board, 8) >> 8 & 0xFF),
        model.get("VB8"),
        "mode {mode}, control {control:#x}, seed {seed}"
    );
    if has_time {
        let events = [0, 2, 4].map(|byte| i32::from(vw(&board, byte)));
        assert_eq!(
            events,
            ["VW0", "VW2", "VW4"].map(|name| model.get(name)),
            "mode {mode}, control {control:#x}"
        );
    }
}

/// All modes, with what the control byte says to them.
const MODES: [(u8, u8); 13] = [
    (0, 0xF8),
    (0, 0xF0),
    (1, 0xF8),
    (1, 0xF1),
    (3, 0xF8),
    (4, 0xF8),
    (6, 0xF8),
    (7, 0xF9),
    (7, 0xF8),
    (9, 0xF8),
    (9, 0xFC),
    (10, 0xF8),
    (10, 0xFD),
];

#[test]
fn every_mode_counts_as_on_the_host() {
    for (seed, (mode, control)) in (1..).zip(MODES) {
        assert_same(seed, mode, control, 0, MS..3 * MS);
    }
}

#[test]
fn quickly_following_edges_count_as_on_the_host() {
    for (seed, (mode, control)) in (1..).zip(MODES) {
        assert_same(seed, mode, control, 0, 600..3_000);
    }
}

#[test]
fn inverted_inputs_are_the_other_way_round() {
    for (seed, (mode, control)) in (1..).zip(MODES) {
        for inverted in [1, 2, 4, 7] {
            assert_same(seed, mode, control, inverted, 600..3_000);
        }
    }
}

/// So many times at a preset, a routine sets the next one. The counter goes on meanwhile.
#[test]
fn routines_are_executed_at_each_preset() {
    let main = "LD SM0.1\nMOVB 16#F8, SMB37\nMOVD 10, SMD42\nATCH I3, 12\nENI\nHDEF 0, 0\nHSC 0\n\
        LD SM0.0\nINCW VW10";
    let routine = "INTERRUPT_BLOCK I3:INT3\nBEGIN\nLD SM0.0\nINCW VW6\n+D 10, SMD42\n\
        MOVB 16#A0, SMB37\nHSC 0\n\
                   END_INTERRUPT_BLOCK\n";
    let mut board = BenchBoard::running(&(program(main) + routine));
    for half_period in [10 * MS, MS, 2_000, 1_000] {
        let (before, times) = (count(&board, HC0), vw(&board, 6));
        edges(&mut board, &[1, 0], 400, half_period);
        board.scans(2);
        assert_eq!(count(&board, HC0) - before, 200, "{half_period} cycles");
        assert_eq!(vw(&board, 6) - times, 20, "{half_period} cycles");
    }
}

#[test]
fn stop_ends_it_and_run_begins_anew() {
    let main = "LD SM0.1\nMOVB 16#80, SMB37\nAN I0.5\nHDEF 0, 3\nLD I0.4\nHSC 0\nAENO\nINCW VW6\n\
        LD SM0.0\nINCW VW10";
    let mut board = BenchBoard::running(&program(main));
    board.drive_inputs(0b1_0000);
    board.scans_for(5);
    edges(&mut board, &[0b1_0001, 0b1_0000], 20, 5_000);
    assert_eq!(count(&board, HC0), -10);
    link::stop(&mut board);
    let registers = |board: &BenchBoard| [0x3D, 0x68].map(|register| board.byte(register));
    assert!(!board.runs());
    assert_eq!(registers(&board), [0, 0], "EIMSK, PCICR");
    edges(&mut board, &[0b1_0001, 0b1_0011, 0b1_0000], 30, 5_000);
    assert_eq!(count(&board, HC0), -10, "in STOP");
    // HDEF only when I0.5 is off.
    board.drive_inputs(0b11_0000);
    link::run(&mut board);
    let (times, before) = (vw(&board, 6), count(&board, HC0));
    edges(&mut board, &[0b11_0001, 0b11_0000], 20, 5_000);
    board.scans(2);
    assert!(board.runs());
    assert_eq!((vw(&board, 6), count(&board, HC0)), (times, before), "HSC without HDEF");
    assert_eq!(board.byte(SM_START + 4) & 8, 8, "SM4.3");
    assert_eq!(registers(&board), [0, 0]);
    link::stop(&mut board);
    board.drive_inputs(0b1_0000);
    link::run(&mut board);
    edges(&mut board, &[0b1_0001, 0b1_0000], 20, 5_000);
    board.scans(2);
    assert_eq!(count(&board, HC0) - before, -10, "HDEF and HSC again");
}

/// What is asked on the line, and answered in one scan or in several, and counters have nothing to
/// do with each other.
#[test]
fn the_line_and_counters_leave_each_other_alone() {
    for (mode, control, levels) in
        [(0, 0xF8, [1, 0, 1, 0]), (0, 0xF0, [1, 0, 1, 0]), (9, 0xF8, [0b01, 0b11, 0b10, 0])]
    {
        let text = counting(mode, control, 30_000);
        let (mut board, mut model) = (BenchBoard::running(&text), Model::new(&text));
        board.scans_for(5);
        let watch: Vec<u8> =
            [67, 32].into_iter().chain((0..32).flat_map(|_| [0x88, 0, 20])).collect();
        let requests: [&[u8]; 6] = [
            &[16, 0, 10, 0, 1, 2, 0x12, 0x34],
            &[23, 0, 10, 0, 1, 0, 11, 0, 1, 2, 0x56, 0x78],
            &watch,
            &[69, 1, 2, 0, 0xFF, 0, 0],
            &[68, 1, 0x89, 0, 24, 0, 0, 0, 1],
            &[68, 3],
        ];
        for request in requests {
            let answer = link::exchange(&mut board, link::UNIT, request).expect("an answer");
            assert_eq!(answer[0], request[0], "mode {mode}: {answer:02X?}");
            edges(&mut board, &levels, 8, 5_000);
            levels.iter().cycle().take(8).for_each(|&level| model.see(level));
            assert_eq!(
                count(&board, HC0),
                model.get("HC0"),
                "mode {mode}, {control:02X}, after {request:02X?}"
            );
        }
        assert_eq!((vw(&board, 20), vw(&board, 22)), (0x1234, 0x5678), "all has been written");
        assert!(board.runs());
    }
}

/// Both tracks have changed before the board could look: they went on, over the preset too, and
/// over a carry.
#[test]
fn tracks_go_on_in_their_direction() {
    let mut board = BenchBoard::running(&counting(9, 0xF8, 301));
    let both = [0b11, 0b00];
    edges(&mut board, &ENCODER, 4, 1_000);
    for step in 1..=200 {
        edges(&mut board, &both[(step + 1) % 2..], 1, 1_000);
        assert_eq!(count(&board, HC0), 4 + 2 * step as i32);
    }
    board.scans(2);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (1, 0), "events 12 and 27");
    edges(&mut board, &[0b10, 0b11, 0b01, 0b00], 4, 1_000);
    for step in 1..=400 {
        edges(&mut board, &both[(step + 1) % 2..], 1, 1_000);
        assert_eq!(count(&board, HC0), 400 - 2 * step as i32);
    }
    board.scans(2);
    assert_eq!((vw(&board, 0), vw(&board, 2)), (2, 1), "events 12 and 27");
}

/// Both counters at once, a routine for each.
#[test]
fn two_counters_count_side_by_side() {
    let main = "LD SM0.1\nMOVB 16#F8, SMB37\nMOVD 300, SMD42\nMOVB 16#F0, SMB137\n\
        MOVD -300, SMD142\n\
                ATCH I0, 12\nATCH I1, 32\nENI\nHDEF 3, 0\nHDEF 0, 0\nHSC 0\nHSC 3\nLD SM0.0\n\
                INCW VW10";
    let mut board = BenchBoard::running(&program(main));
    // Both edges at once, and one after the other.
    edges(&mut board, &[0b11, 0b00, 0b01, 0b11, 0b10, 0b00], 3_000, 300);
    board.scans(2);
    assert_eq!((count(&board, HC0), count(&board, HC3)), (1_000, -1_000));
    assert_eq!((vw(&board, 0), vw(&board, 2)), (1, 1), "events 12 and 32");
}

/// What a program reads was the value at one moment, although its bytes change in the middle of an
/// instruction.
#[test]
fn values_are_read_at_one_moment() {
    let compare = "LDD< HC0, VD12\nINCW VW16\nLD SM0.0\nMOVD HC0, VD12\n".repeat(30);
    let main = format!(
        "LD SM0.1\nMOVB 16#F8, SMB37\nHDEF 0, 0\nHSC 0\nLD SM0.0\nINCW VW10\nMOVD HC0, VD12\n\
            {compare}LD SM0.0\nINCW VW10"
    );
    let mut board = BenchBoard::running(&program(&main));
    let mut rng = Rng::with_seed(1);
    for _ in 0..200_000 {
        edges(&mut board, &[1, 0], 2, rng.u64(90..130));
    }
    board.scans(2);
    assert_eq!(count(&board, HC0), 200_000);
    assert_eq!(vw(&board, 16), 0, "the value went back so often, in {} scans", vw(&board, 10));
}

/// The vectors of INT0, INT1 and PCINT2.
const VECTORS: [u32; 3] = [0x04, 0x08, 0x14];
const RETI: [u8; 2] = [0x18, 0x95];
/// Cycles of the longest interrupt.
const LONGEST_MAX: u64 = 240;

/// The cycles of each interrupt of a counter, from the vector on, while edges come.
fn interrupts(text: &str, levels: &[u8], edges: usize) -> Vec<u64> {
    let mut board = BenchBoard::running(text);
    let (mut found, mut entered) = (Vec::new(), None);
    for level in levels.iter().cycle().take(edges) {
        board.drive_inputs(*level);
        let end = board.avr.cycles() + 1_000;
        while board.avr.cycles() < end {
            let (pc, cycles) = (board.avr.pc(), board.avr.cycles());
            board.step().unwrap();
            if VECTORS.contains(&pc) {
                entered = Some(cycles);
            } else if board.avr.flash()[pc as usize..].starts_with(&RETI) {
                found.extend(entered.take().map(|since| board.avr.cycles() - since));
            }
        }
    }
    assert!(found.len() >= edges / 5, "{} interrupts", found.len());
    found
}

/// What each pulse costs, and how long other interrupts may have to wait. The chip takes 4 cycles
/// more to come to the vector.
#[test]
fn interrupts_are_short() {
    let all = [0b000, 0b001, 0b000, 0b010, 0b011, 0b010, 0b110, 0b010, 0b011, 0b000];
    let runs: [(u8, u8, &[u8], u64); 7] = [
        (0, 0xF8, &CLOCK, 66),
        (0, 0xF0, &CLOCK, 69),
        (4, 0xF8, &CLOCK, 75),
        (7, 0xF8, &CLOCK, 75),
        (9, 0xF8, &ENCODER, 83),
        (9, 0xFC, &ENCODER, 110),
        (10, 0xF8, &ENCODER, 115),
    ];
    for (mode, control, levels, usual_max) in runs {
        let mut cycles = interrupts(&counting(mode, control, 3), levels, 400);
        cycles.sort_unstable();
        let usual = cycles[cycles.len() / 2];
        let others = interrupts(&counting(mode, control, 3), &all, 400);
        let longest = cycles.into_iter().chain(others).max().unwrap_or(0);
        println!("mode {mode}, control {control:#x}: {usual} cycles, at most {longest}");
        assert!(
            usual <= usual_max && longest <= LONGEST_MAX,
            "mode {mode}: {usual} cycles, at most {longest}"
        );
    }
}

/// Many pulses, as a scenario says it.
const PULSES: &str = "LD SM0.1\nMOVB 16#F8, SMB37\nMOVB 16#F8, SMB137\nHDEF 0, 0\nHDEF 3, 0\n\
    HSC 0\nHSC 3\n\
    //$ at 10ms pulse I0.0 30kHz for 300ms\n//$ at 10ms pulse I0.1 12.5kHz for 300ms\n\
    //$ at 390ms expect HC0 = 9000, HC3 = 3750\n\
    //$ at 400ms pulse I0.0 40kHz 4000 times\n//$ at 600ms expect HC0 = 13000\n";

/// Cases with a counter and the pulses above, as far as their inputs have pins.
#[test]
fn cases_hold_on_a_board_with_its_own_clock() {
    let is_possible = |case: &Case| {
        case.awl.contains("HDEF") && !case.awl.contains("I1.") && !case.awl.contains("IB1")
    };
    let pulses = Case::new("pulses".to_string(), PULSES.to_string());
    let cases = Case::all().into_iter().chain(Case::examples()).filter(is_possible).chain([pulses]);
    assert_cases_hold(cases, 7);
}

/// A program that does something else, and counts.
fn station(mode: u8, control: u8) -> String {
    let counter = format!(
        "NETWORK // Counts\nLD SM0.1\nMOVB {control}, SMB37\nMOVD 1000, SMD42\nHDEF 0, {mode}\n\
            HSC 0\n\
         LDD>= HC0, 500\n= Q0.5\n"
    );
    format!("{}\n{counter}", example_text("station1"))
}

/// So many edges at exact cycles. The lengths of the scans meanwhile.
fn drive(board: &mut BenchBoard, levels: &[u8], count: usize, cycles: u64) -> Vec<u64> {
    let (mut scans, mut next) = (Vec::new(), board.avr.cycles());
    for level in levels.iter().cycle().take(count) {
        board.drive_inputs(*level);
        next += cycles;
        loop {
            let left = next.saturating_sub(board.avr.cycles());
            match board.run(left).unwrap() {
                Some(mark) if mark == Mark::ScanEnd as u8 => {
                    scans.push(board.avr.cycles() - board.scan_start())
                }
                Some(_) => {}
                None => break,
            }
        }
    }
    scans
}

/// What came of edges at a board that does something else, too.
#[derive(Debug)]
struct Load {
    counted: i32,
    /// Mean cycles of a scan without and with edges.
    scans: [u64; 2],
}

/// So many edges, an edge every so many cycles.
fn load(mode: u8, levels: &[u8], count_of: usize, cycles: u64) -> Load {
    let mean = |scans: &[u64]| scans.iter().sum::<u64>() / (scans.len().max(1) as u64);
    let mut board = BenchBoard::running(&station(mode, 0xF8));
    let quiet: Vec<u64> = board.scans_for(100).iter().map(|scan| scan.cycles()).collect();
    let busy = drive(&mut board, levels, count_of, cycles);
    board.scans(2);
    Load { counted: count(&board, HC0), scans: [mean(&quiet), mean(&busy)] }
}

const CLOCK: [u8; 2] = [1, 0];
const ENCODER: [u8; 4] = [0b01, 0b11, 0b10, 0b00];

/// 30 kHz is what an S7-200 counts.
#[test]
fn thirty_kilohertz_are_counted_without_loss() {
    let edges = 60_000;
    let load = load(0, &CLOCK, edges, S / 60_000);
    assert_eq!(load.counted, edges as i32 / 2, "{load:?}");
}

/// An encoder with 20 kHz, of which all edges count, is what an S7-200 counts.
#[test]
fn twenty_kilohertz_of_an_encoder_are_counted_without_loss() {
    let edges = 80_000;
    let load = load(9, &ENCODER, edges, S / 80_000);
    assert_eq!(load.counted, edges as i32, "{load:?}");
}

/// The highest frequency at which nothing is lost, with the station's program. `-- --nocapture`
/// shows all.
#[test]
fn the_highest_frequencies() {
    let fastest = |mode: u8, levels: &[u8], edges_counted: usize, kilohertz: &[u64]| {
        let mut fastest = 0;
        for &kilohertz in kilohertz {
            let cycles = S / (1_000 * kilohertz * levels.len() as u64);
            let edges = 10_000 * levels.len();
            let load = load(mode, levels, edges, cycles);
            let wanted = edges * edges_counted / levels.len();
            println!(
                "mode {mode}, {kilohertz} kHz: {} of {wanted}, scans of {:?} cycles",
                load.counted, load.scans
            );
            if load.counted != wanted as i32 {
                break;
            }
            fastest = kilohertz;
        }
        fastest
    };
    let single =
        fastest(0, &CLOCK, 1, &[1, 5, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130]);
    let encoder = fastest(9, &ENCODER, 4, &[1, 5, 10, 15, 20, 25, 30, 35, 40]);
    // As docs/firmware.md says. A little less than what is measured, which depends on how the
    // pulses meet the clock of the board.
    assert!(single >= 80, "{single} kHz");
    assert!(encoder >= 30, "{encoder} kHz");
}
