//! Pulse and analog outputs on the board, as waves at pins D9 and D10: PLS with modulation and
//! trains, AQW0 and AQW2. The edges are those that timer 1 makes of its registers by the data
//! sheet, in cycles. simavr's own timer misses some of that, so the simulated chip has them from a
//! model beside it (`sim/simavr`); no real chip has been measured.
#![cfg(feature = "uno")]

use plc_isa::{AQW_START, M_START, SM_START};
use simavr::Pin;
use tests::bench_board::{BenchBoard, MS};
use tests::link;

/// Cycles in a microsecond.
const US: u64 = 16;

const PULSES: u8 = 9;
const ANALOG_2: u8 = 10;

/// Data addresses: the direction and the level of the pins, timer 1.
const DIRECTIONS_B: usize = 0x24;
const TIMER_1_INTERRUPTS: usize = 0x6F;
const TIMER_1_CONTROL: usize = 0x80;

const MICROSECONDS: u8 = 0;
const MILLISECONDS: u8 = 8;
const MODULATION: u8 = 0xC3;
const TRAIN: u8 = 0x85;

/// A level, and the cycles that it lasts.
type Part = (bool, u64);

/// PLS 1 in the first scan, and again with other values when I0.0, I0.1 come on; SMB76 in MB0.
fn program(settings: &[(u8, u16, u16, u32)]) -> String {
    let pulses = |(index, &(control, cycle, width, count)): (usize, &(u8, u16, u16, u32))| {
        let condition =
            if index == 0 { "LD SM0.1".to_owned() } else { format!("LD I0.{}\nEU", index - 1) };
        format!(
            "{condition}\nMOVB {control}, SMB77\nMOVW 16#{cycle:X}, SMW78\n\
                MOVW 16#{width:X}, SMW80\nMOVD {count}, SMD82\n\
             PLS 1\nAENO\nS M1.{index}, 1\n"
        )
    };
    let all: String = settings.iter().enumerate().map(pulses).collect();
    format!("{all}LD I0.5\n= Q0.1\nLD SM0.0\nMOVB SMB76, MB0\n")
}

/// A board before the first scan of a program, whose waves are noted.
fn watched(text: &str) -> BenchBoard {
    let mut board = BenchBoard::new();
    board.insert(&tests::bench_board::image(text));
    board.power_up();
    board.avr.watch_waves();
    board
}

/// Runs for so many cycles, over marks.
fn run(board: &mut BenchBoard, cycles: u64) {
    let end = board.avr.cycles() + cycles;
    while board.avr.cycles() < end {
        board.run_on(end - board.avr.cycles());
    }
}

/// What has been at a pin, from edge to edge.
fn parts(board: &mut BenchBoard, pin: u8) -> Vec<Part> {
    let edges: Vec<_> =
        board.avr.take_waves().into_iter().filter(|edge| edge.pin == Pin::of_uno(pin)).collect();
    edges.windows(2).map(|pair| (pair[0].high, pair[1].cycle - pair[0].cycle)).collect()
}

/// The level that the timer or the process image gives the pin of an output.
fn level(board: &BenchBoard, pin: u8) -> bool {
    board.avr.is_output(Pin::of_uno(pin)) && board.avr.level(Pin::of_uno(pin))
}

/// Whether every part has the length for its level, but those of the first period: the pin can be
/// switched over within it.
#[track_caller]
fn assert_wave(parts: &[Part], on: u64, off: u64, count_min: usize) {
    assert!(parts.len() >= count_min, "only {} parts", parts.len());
    let parts = &parts[2..];
    let wrong = parts.iter().position(|&(high, cycles)| cycles != if high { on } else { off });
    assert_eq!(
        wrong.map(|index| (index, parts[index])),
        None,
        "on for {on} and off for {off} cycles"
    );
}

#[test]
fn modulation_in_microseconds() {
    // Exact up to 32767 us; above that to 2 us.
    let exact =
        [(2, 1), (50, 25), (50, 49), (1_000, 1), (1_000, 300), (20_000, 1_500), (32_767, 32_766)];
    let rounded = [(32_768, 16_384, 0), (40_001, 20_002, 2), (65_535, 4, 1)];
    for (cycle, width, tolerance) in
        exact.map(|(cycle, width)| (cycle, width, 0)).into_iter().chain(rounded)
    {
        let mut board = watched(&program(&[(MODULATION, cycle, width, 0)]));
        run(&mut board, 12 * u64::from(cycle) * US + 2 * MS);
        let parts = parts(&mut board, PULSES);
        let [on, off] = [u64::from(width) * US, u64::from(cycle - width) * US];
        assert!(parts.len() > 20, "{cycle}, {width}: {} parts", parts.len());
        for &(high, cycles) in &parts {
            let due = if high { on } else { off };
            assert!(
                cycles.abs_diff(due) <= 2 * tolerance * US,
                "{cycle}, {width}: {high} for {cycles} cycles"
            );
        }
        let period = (parts[2].1 + parts[3].1).abs_diff(on + off);
        assert!(period <= tolerance * US, "{cycle}: {period} cycles off");
        assert_eq!(board.byte(M_START), 0x80, "idle as to trains");
        assert_eq!(board.avr.data()[TIMER_1_INTERRUPTS], 0, "without an interrupt");
    }
}

#[test]
fn modulation_in_milliseconds() {
    for (cycle, width) in [(2, 1), (3, 2), (20, 19), (100, 30), (4_500, 4_499)] {
        let mut board = watched(&program(&[(MODULATION | MILLISECONDS, cycle, width, 0)]));
        run(&mut board, 3 * u64::from(cycle) * MS + 4 * MS);
        let [on, off] = [u64::from(width) * MS, u64::from(cycle - width) * MS];
        assert_wave(&parts(&mut board, PULSES), on, off, 4);
    }
}

#[test]
fn never_on_and_always_on_are_constant() {
    for unit in [MICROSECONDS, MILLISECONDS] {
        for (cycle, width, high) in [
            (20, 0, false),
            (20, 20, true),
            (20, 21, true),
            (40_001, 40_001, true),
            (50, 0xFFFF, true),
        ] {
            let mut board = watched(&program(&[(MODULATION | unit, cycle, width, 0)]));
            // The process image says the contrary.
            board.drive_inputs(u8::from(!high) << 5);
            board.scans(3);
            board.avr.take_waves();
            for _ in 0..500 {
                run(&mut board, 997);
                assert_eq!(level(&board, PULSES), high, "{cycle}, {width}");
            }
            assert_eq!(board.avr.take_waves(), [], "{cycle}, {width}");
        }
    }
}

/// A board on which a width of 1000 or 100 units of time has been followed by another one: what was
/// from shortly before on.
fn after_change(unit: u8, old: u64, new: u64) -> (BenchBoard, Vec<Part>) {
    let (cycle, control) = (cycle_of(unit), MODULATION | unit);
    let mut board = watched(&program(&[
        (control, cycle as u16, old as u16, 0),
        (control, cycle as u16, new as u16, 0),
    ]));
    run(&mut board, 3 * cycle * cycles_of(unit) + 2 * MS);
    board.drive_inputs(1);
    run(&mut board, 4 * cycle * cycles_of(unit) + 2 * MS);
    let parts = parts(&mut board, PULSES);
    (board, parts)
}

fn cycle_of(unit: u8) -> u64 {
    if unit == MICROSECONDS { 1_000 } else { 100 }
}

fn cycles_of(unit: u8) -> u64 {
    if unit == MICROSECONDS { US } else { MS }
}

#[test]
fn a_new_width_comes_with_a_new_cycle() {
    for unit in [MICROSECONDS, MILLISECONDS] {
        let cycle = cycle_of(unit);
        for (old, new) in [(30, 70), (70, 1), (1, 99), (99, 50)]
            .map(|(old, new)| (old * cycle / 100, new * cycle / 100))
        {
            let (_, parts) = after_change(unit, old, new);
            // Each part is as the old width has it or as the new one; and once new, always new.
            let is_of = |&(high, cycles): &Part, width: u64| {
                cycles == cycles_of(unit) * if high { width } else { cycle - width }
            };
            let changed = parts.iter().position(|part| is_of(part, new)).unwrap_or(parts.len());
            assert!(changed >= 4 && parts.len() >= changed + 4, "{old} to {new}: {parts:?}");
            assert!(
                parts[..changed].iter().all(|part| is_of(part, old)),
                "{old} to {new}: {parts:?}"
            );
            assert!(
                parts[changed..].iter().all(|part| is_of(part, new)),
                "{old} to {new}: {parts:?}"
            );
        }
    }
}

#[test]
fn a_width_can_become_never_or_always() {
    for unit in [MICROSECONDS, MILLISECONDS] {
        let cycle = cycle_of(unit);
        for (constant, width) in [(0, 0), (cycle, cycle), (cycle + 1, cycle)] {
            let old = cycle / 4;
            let (mut board, parts) = after_change(unit, old, constant);
            let (last, before) = parts.split_last().unwrap();
            assert_wave(before, old * cycles_of(unit), (cycle - old) * cycles_of(unit), 4);
            assert!(last.1 <= (cycle + 1) * cycles_of(unit), "{constant}: {last:?}");
            assert_eq!(level(&board, PULSES), width != 0);
            run(&mut board, 3 * cycle * cycles_of(unit));
            assert_eq!(board.avr.take_waves(), []);
            let (_, parts) = after_change(unit, constant, old);
            assert_wave(&parts[1..], old * cycles_of(unit), (cycle - old) * cycles_of(unit), 5);
        }
    }
}

/// The pulses among parts, and whether each is on and off for half its cycle, except for the last.
#[track_caller]
fn assert_train(edges: &[(u64, bool)], half: u64, count: usize) {
    assert_eq!(edges.len(), 2 * count, "edges");
    for (index, pair) in edges.windows(2).enumerate() {
        let cycles = pair[1].0 - pair[0].0;
        assert_eq!(cycles, half, "part {index} has {cycles} cycles, not {half}");
    }
    assert!(edges[0].1 && !edges[2 * count - 1].1);
}

fn edges(board: &mut BenchBoard) -> Vec<(u64, bool)> {
    board.avr.take_waves().into_iter().map(|edge| (edge.cycle, edge.high)).collect()
}

#[test]
fn trains_have_their_pulses() {
    for (unit, cycle, count, ms) in [
        (MICROSECONDS, 50, 1, 3),
        (MICROSECONDS, 50, 10_000, 520),
        (MICROSECONDS, 333, 1_000, 340),
        (MICROSECONDS, 65_535, 3, 200),
        (MILLISECONDS, 2, 5, 13),
        (MILLISECONDS, 7, 70_000 / 1_000, 495),
    ] {
        let mut board = watched(&program(&[(TRAIN | unit, cycle, 0, count)]));
        // The process image switches the output on after the train.
        board.drive_inputs(1 << 5);
        run(&mut board, MS);
        assert_eq!(
            board.byte(M_START) & 0x80,
            if cycle == 50 && count == 1 { 0x80 } else { 0 },
            "{cycle}: idle"
        );
        run(&mut board, ms * MS);
        board.scans(2);
        let half = u64::from(cycle) * cycles_of(unit) / 2;
        assert_train(&edges(&mut board), half, count as usize);
        assert_eq!(board.byte(M_START), 0x80, "{cycle}: idle");
        assert_eq!(board.avr.data()[TIMER_1_CONTROL], 0);
        assert!(level(&board, PULSES), "the process image's again");
        board.drive_inputs(0);
        board.scans(3);
        assert!(!level(&board, PULSES));
    }
}

/// At most so many cycles later than it should be, a train that waits begins.
const NEXT_TRAIN: u64 = 40 * US;

#[test]
fn one_train_can_wait_for_another() {
    let settings = [(TRAIN, 500, 0, 40), (TRAIN | MILLISECONDS, 3, 0, 4), (TRAIN, 100, 0, 9)];
    let mut board = watched(&program(&settings));
    run(&mut board, 2 * MS);
    assert_eq!(board.byte(M_START), 0);
    board.drive_inputs(1);
    run(&mut board, 2 * MS);
    assert_eq!(board.byte(M_START), 0);
    // A third one has no room.
    board.drive_inputs(3);
    run(&mut board, 2 * MS);
    assert_eq!(board.byte(M_START), 0x40);
    run(&mut board, 60 * MS);
    assert_eq!(board.byte(M_START), 0xC0);
    let edges = edges(&mut board);
    assert_train(&edges[..80], 250 * US, 40);
    assert_train(&edges[80..], 3 * MS / 2, 4);
    let pause = edges[80].0 - edges[79].0;
    println!(
        "from one train to the next {} cycles more than half a cycle",
        pause as i64 - 250 * 16
    );
    assert!(
        (250 * US..250 * US + NEXT_TRAIN).contains(&pause),
        "{pause} cycles between two trains"
    );
}

#[test]
fn the_end_of_a_train_is_an_event() {
    let pulses = "MOVB 16#8D, SMB77\nMOVW 5, SMW78\nMOVD 4, SMD82\nPLS 1\n";
    let main = format!("LD SM0.1\nATCH I0, 20\nENI\n{pulses}{pulses}LD SM0.0\nMOVB SMB76, MB0\n");
    let mut board = watched(&format!(
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}END_ORGANIZATION_BLOCK\n\
            INTERRUPT_BLOCK I0:INT0\nBEGIN\nLD SM0.0\n\
         INCB MB1\nMOVB SMB76, MB2\nEND_INTERRUPT_BLOCK\n"
    ));
    let start = board.avr.cycles();
    let mut ends = Vec::new();
    while board.avr.cycles() < start + 60 * MS {
        let before = board.byte(M_START + 1);
        board.scan();
        if board.byte(M_START + 1) != before {
            ends.push(((board.avr.cycles() - start) / MS, board.byte(M_START + 2)));
        }
    }
    // The first train goes on with the second one.
    assert!(matches!(ends[..], [(20 | 21, 0), (40..=42, 0x80)]), "{ends:?}");
}

#[test]
fn what_is_under_way_can_be_broken_off() {
    let settings =
        [(TRAIN, 500, 0, 4_000), (0, 0, 0, 0), (MODULATION, 100, 50, 0), (TRAIN, 100, 0, 20)];
    let mut board = watched(&program(&settings));
    run(&mut board, 5 * MS);
    board.drive_inputs(1);
    run(&mut board, 5 * MS);
    assert_eq!((board.byte(M_START), board.avr.data()[TIMER_1_CONTROL]), (0xA0, 0));
    assert!(!level(&board, PULSES));
    board.avr.take_waves();
    board.drive_inputs(3);
    run(&mut board, 5 * MS);
    assert_wave(&parts(&mut board, PULSES), 50 * US, 50 * US, 40);
    board.drive_inputs(7);
    run(&mut board, 5 * MS);
    assert_eq!(board.byte(M_START), 0x80);
    let edges = edges(&mut board);
    assert_train(&edges[edges.len() - 40..], 50 * US, 20);
}

#[test]
fn what_cannot_be_done_is_an_error() {
    for (control, cycle, is_done) in
        [(TRAIN, 49, false), (TRAIN, 50, true), (0xA5, 500, false), (0xE3, 500, true)]
    {
        let mut board = watched(&program(&[(control, cycle, 20, 2)]));
        run(&mut board, 3 * MS);
        assert_eq!(board.byte(M_START + 1) & 1, u8::from(is_done), "{control:02X}: ENO");
        assert_eq!(board.byte(SM_START + 4) >> 3 & 1, u8::from(!is_done), "{control:02X}: SM4.3");
        assert_eq!(edges(&mut board).is_empty(), !is_done, "{control:02X}");
    }
}

#[test]
fn an_inverted_output_is_inverted() {
    let mut board =
        watched(&format!("//# invert Q0.1\n{}", program(&[(MODULATION, 1_000, 300, 0)])));
    run(&mut board, 20 * MS);
    assert_wave(&parts(&mut board, PULSES)[1..], 700 * US, 300 * US, 30);
    let mut board = watched(&format!("//# invert Q0.1\n{}", program(&[(TRAIN, 1_000, 0, 3)])));
    run(&mut board, 10 * MS);
    let edges = edges(&mut board);
    assert_eq!(edges.iter().filter(|edge| !edge.1).count(), 3);
    assert!(level(&board, PULSES), "off");
}

#[test]
fn nothing_pulses_in_stop() {
    for (control, count) in [(MODULATION, 0), (MODULATION | MILLISECONDS, 0), (TRAIN, 4_000_000)] {
        // PLS is executed when I0.0 comes, not in the first scan.
        let mut board = watched(&program(&[(0, 0, 0, 0), (control, 100, 50, count)]));
        board.scan();
        board.drive_inputs(1);
        run(&mut board, 300 * MS);
        assert!(edges(&mut board).len() > 2);
        link::stop(&mut board);
        assert!(!board.runs() && board.is_released());
        assert_eq!(
            (board.avr.data()[TIMER_1_CONTROL], board.avr.data()[TIMER_1_INTERRUPTS]),
            (0, 0)
        );
        edges(&mut board);
        board.drive_inputs(0);
        link::run(&mut board);
        run(&mut board, 300 * MS);
        assert!(board.runs() && edges(&mut board).is_empty());
        assert_eq!(board.avr.data()[TIMER_1_CONTROL], 0);
        board.drive_inputs(1);
        run(&mut board, 300 * MS);
        assert!(edges(&mut board).len() > 2, "{control:02X} after RUN");
    }
}

#[test]
fn the_first_pulses_come_in_the_first_scan() {
    let text = format!("{}LD SM0.1\nFOR MW2, 1, 2000\nNEXT\n", program(&[(TRAIN, 100, 0, 20)]));
    let mut board = watched(&text);
    run(&mut board, 2 * MS);
    assert_eq!(
        board.avr.data()[DIRECTIONS_B],
        2,
        "in the first scan only the pin of PLS is driven"
    );
    assert!(edges(&mut board).len() >= 20);
}

#[test]
fn a_fast_train_leaves_time_for_the_program() {
    let text = |control: u8| {
        format!("{}LD SM0.0\nFOR MW2, 1, 200\nNEXT\n", program(&[(control, 50, 0, 4_000_000)]))
    };
    let [without, with] = [0, TRAIN].map(|control| {
        let mut board = BenchBoard::running(&text(control));
        board.scans(5);
        board.scans(20).iter().map(|scan| scan.cycles()).sum::<u64>()
    });
    println!(
        "a scan takes {:.2} times as long with a train of 50 us",
        with as f64 / without as f64
    );
    assert!(with < 2 * without);
}

/// Cycles of an analog output's wave: 8 kHz.
const ANALOG_CYCLE: u64 = 2_000;

#[test]
fn analog_outputs() {
    let mut board = watched(
        "LD SM0.0\nMOVW MW2, AQW0\nMOVW MW4, AQW2\nLD I0.5\nMOVB 2#110, QB0\nLDN I0.5\n\
            MOVB 0, QB0\n",
    );
    for (value, on) in [
        (0_i16, 0),
        (-1, 0),
        (-32_768, 0),
        (15, 0),
        (16, 1),
        (8_000, 500),
        (16_000, 1_000),
        (31_983, 1_998),
        (31_984, 1_999),
        (31_999, 1_999),
        (32_000, 2_000),
        (32_767, 2_000),
    ] {
        for (pin, address, other) in
            [(PULSES, M_START + 2, M_START + 4), (ANALOG_2, M_START + 4, M_START + 2)]
        {
            board.write(address, &value.to_be_bytes());
            board.write(other, &12_800_i16.to_be_bytes());
            // The process image has no say.
            board.drive_inputs(if on == 0 { 1 << 5 } else { 0 });
            board.scans(4);
            board.avr.take_waves();
            run(&mut board, 20 * MS);
            let waves = board.avr.take_waves();
            let of = |pin: u8| {
                let edges: Vec<_> =
                    waves.iter().filter(|edge| edge.pin == Pin::of_uno(pin)).collect();
                edges
                    .windows(2)
                    .map(|pair| (pair[0].high, pair[1].cycle - pair[0].cycle))
                    .collect::<Vec<Part>>()
            };
            if on == 0 || on == ANALOG_CYCLE {
                assert_eq!((of(pin).len(), level(&board, pin)), (0, on != 0), "{value} at D{pin}");
            } else {
                assert_wave(&of(pin), on, ANALOG_CYCLE - on, 300);
            }
            assert_wave(&of(if pin == PULSES { ANALOG_2 } else { PULSES }), 800, 1_200, 300);
        }
    }
    assert_eq!(board.word(AQW_START), 12_800);
}

#[test]
fn an_analog_output_leaves_the_others_digital() {
    for (analog, pin, other) in [("AQW0", PULSES, ANALOG_2), ("AQW2", ANALOG_2, PULSES)] {
        let mut board = watched(&format!(
            "LD SM0.0\nMOVW 3200, {analog}\nLD I0.5\nMOVB 2#110, QB0\nLDN I0.5\nMOVB 0, QB0\n"
        ));
        for high in [true, false, true] {
            board.drive_inputs(u8::from(high) << 5);
            board.scans(3);
            assert_eq!(level(&board, other), high, "{analog}");
        }
        board.avr.take_waves();
        run(&mut board, 5 * MS);
        assert_wave(&parts(&mut board, pin), 200, 1_800, 70);
        assert!(board.avr.take_waves().iter().all(|edge| edge.pin == Pin::of_uno(pin)));
    }
}

#[test]
fn analog_outputs_are_off_in_stop() {
    let mut board = watched("LD I0.0\nMOVW 3200, AQW0\n");
    board.drive_inputs(1);
    run(&mut board, 5 * MS);
    assert!(edges(&mut board).len() > 70);
    link::stop(&mut board);
    edges(&mut board);
    assert!(board.is_released());
    board.drive_inputs(0);
    link::run(&mut board);
    run(&mut board, 5 * MS);
    assert_eq!((edges(&mut board).len(), level(&board, PULSES)), (0, false));
    board.drive_inputs(1);
    run(&mut board, 5 * MS);
    assert_wave(&parts(&mut board, PULSES), 200, 1_800, 60);
}
