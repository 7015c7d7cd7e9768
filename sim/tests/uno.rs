//! The virtual Uno: pins, its own clock, the held clock, faults, the stack. Needs the firmware.
#![cfg(feature = "simavr")]

mod scenario_file;

use std::fs;
use std::path::{Path, PathBuf};

use awl_asm::assemble::assemble;
use awl_asm::disassemble::instructions;
use awl_asm::source::Source;
use awl_sim::action::Action;
use awl_sim::machine::uno::{Clock, Code, Firmware, Uno};
use awl_sim::machine::{Machine, Mode};
use awl_sim::open::{ProgramFiles, Target};
use awl_sim::operand::Operand;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use awl_sim::suite::program_for;
use plc_isa::{NATIVE_INTERFACE, Op, SLOT_START, verify};
use plc_vm::Fault;
use scenario_file::run_file;
use simavr::Pin;

/// The pin of I0.0 and that of Q0.0.
const FIRST_INPUT: u8 = 2;
const FIRST_OUTPUT: u8 = 8;

fn image(text: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new("test.awl", text).unwrap(), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics))
}

fn board_with(code: Code, image: Vec<u8>, clock: Clock) -> Uno {
    let firmware = Firmware::find().unwrap_or_else(|error| panic!("{error:#}"));
    let mut uno = Uno::new(&firmware, code, clock, Box::new(|at| format!("byte {at}"))).unwrap();
    uno.load(image).unwrap();
    uno
}

fn board(image: Vec<u8>, clock: Clock) -> Uno {
    board_with(Code::Bytecode, image, clock)
}

fn uno(text: &str, clock: Clock) -> Uno {
    board(image(text), clock)
}

fn operand(name: &str) -> Operand {
    Operand::parse(name, &[]).unwrap()
}

fn read(uno: &mut Uno, name: &str) -> i32 {
    uno.read(operand(name)).unwrap()
}

/// Runs a scenario on a board with its own clock, looking at it every millisecond.
fn outcome(uno: &mut Uno, text: &str) -> Outcome {
    let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
    let scenario =
        Scenario::parse("t.scn", text, context).unwrap_or_else(|problems| panic!("{problems}"));
    let job = Job {
        scan_ms: 1,
        length: Length::Scenario,
        signals: Vec::new(),
        plant: None,
        progress: None,
    };
    run(uno, &scenario, job).unwrap()
}

/// The same; everything must be as expected.
fn assert_holds(program: &str, scenario: &str) {
    let outcome = outcome(&mut uno(program, Clock::FreeRunning), scenario);
    assert!(outcome.failures.is_empty() && outcome.fault.is_none(), "{outcome:#?}");
    assert!(outcome.met > 0 && outcome.unreached_expectations == 0);
}

#[test]
fn pins_are_what_the_program_sees_and_sets() {
    let text = "//# invert I0.1, Q0.1\n//# pullup I0.2\nLD I0.0\n= Q0.0\nLD I0.1\n= Q0.1\n\
        LD I0.2\n= Q0.2\n";
    let mut uno = uno(text, Clock::LockStep);
    let pins =
        |uno: &Uno| [0, 1, 2].map(|output| uno.avr().level(Pin::of_uno(FIRST_OUTPUT + output)));
    assert_eq!((uno.mode(), uno.pin_levels()), (Mode::Stop, 0b10), "no power: everything is off");
    uno.scan(0);
    assert_eq!((uno.mode(), uno.pin_levels(), pins(&uno)), (Mode::Run, 0b10, [false, true, false]));
    for input in 0..3 {
        uno.write(operand(&format!("I0.{input}")), 1).unwrap();
    }
    uno.scan(1);
    assert_eq!(
        (read(&mut uno, "QB0"), uno.pin_levels(), pins(&uno)),
        (0b111, 0b101, [true, false, true])
    );
    assert!(!uno.avr().level(Pin::of_uno(FIRST_INPUT + 1)), "the inverted input is low");
    assert!(uno.avr().has_pull_up(Pin::of_uno(FIRST_INPUT + 2)));
    // The same by levels: the pull-up does not win.
    uno.drive_pin(1, true);
    uno.drive_pin(2, false);
    uno.scan(2);
    assert_eq!(
        (read(&mut uno, "QB0"), read(&mut uno, "I0.1"), uno.pin_levels()),
        (0b001, 0, 0b011)
    );
}

#[test]
fn outputs_are_released_outside_of_run() {
    let mut uno =
        uno("//# invert Q0.1\nLD SM0.0\n= Q0.0\n= Q0.1\nLD I0.0\nSTOP\n", Clock::LockStep);
    let is_driven = |uno: &Uno| uno.avr().is_output(Pin::of_uno(FIRST_OUTPUT));
    uno.scan(0);
    assert_eq!((is_driven(&uno), uno.pin_levels(), read(&mut uno, "QB0")), (true, 0b01, 0b11));
    uno.write(operand("I0.0"), 1).unwrap();
    uno.scan(1);
    assert_eq!((uno.mode(), uno.fault()), (Mode::Stop, None));
    assert_eq!((is_driven(&uno), uno.pin_levels(), read(&mut uno, "QB0")), (false, 0b10, 0));
}

#[test]
fn the_board_keeps_time_by_its_own_clock() {
    let program = "LD I0.0\nTON T37, 10\nLD T37\n= Q0.0\nLD SM0.0\nINCW VW0\n";
    // The tick of 100 ms falls anywhere, and a scan is over in less than 2 ms.
    let scenario = "at 50ms I0.0 = 1\nat 949ms expect Q0.0 = 0\n\
        at 1053ms expect Q0.0 = 1, T37.cv = 10, VW0 = 500..30000\n\
                    at 2s I0.0 = 0\nat 2002ms expect Q0.0 = 0";
    assert_holds(program, scenario);
}

#[test]
fn what_is_set_for_time_0_is_there_in_the_first_scan() {
    let program = "LDN SM0.1\nJMP 1\nLD SM0.0\nMOVW Ain0, VW0\nMOVW Ain1, VW2\nMOVW Ain2, VW4\n\
        MOVW Ain3, VW6\n\
                   MOVW Ain4, VW8\nMOVW Ain5, VW10\nLD I0.3\n= Q0.3\nLBL 1\n";
    let scenario = "at 0ms I0.3 = 1, MW4 = 77, Ain0 = 1023, Ain1 = 11, Ain2 = 222, Ain3 = 512, \
        Ain4 = 513, Ain5 = 1022\n\
                    at 3ms expect Q0.3 = 1, MW4 = 77\n\
                    at 3ms expect VW0 = 1023, VW2 = 11, VW4 = 222, VW6 = 512, VW8 = 513, VW10 = \
                    1022";
    assert_holds(program, scenario);
}

#[test]
fn a_fixed_period_is_kept() {
    let program = "//# scan 20ms\nLD SM0.0\nINCW VW0\n";
    assert_holds(
        program,
        "at 1ms expect VW0 = 1\nat 19ms expect VW0 = 1\nat 990ms expect VW0 = 50\n\
            at 1010ms expect VW0 = 51",
    );
    // With a held clock nothing else can start the next scan.
    let mut uno = uno(program, Clock::LockStep);
    uno.scan(0);
    uno.scan(20);
    assert_eq!((read(&mut uno, "VW0"), uno.broken()), (2, None));
    uno.scan(21);
    assert!(uno.broken().is_some_and(|text| text.contains("longer period")), "{:?}", uno.broken());
    assert_eq!((uno.mode(), uno.fault().as_deref()), (Mode::Stop, uno.broken()));
}

#[test]
fn inputs_without_a_pin_are_0_and_cannot_be_set() {
    let mut uno = uno("LD I1.0\n= Q0.0\n", Clock::FreeRunning);
    for (name, value, part) in
        [("I1.0", 1, "I1.0 has no pin"), ("IB0", 0x40, "I0.6 has no pin"), ("IW0", 0x0180, "I1.7")]
    {
        assert_eq!(read(&mut uno, name), 0);
        let error = uno.write(operand(name), value).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
    for (name, value) in [("I1.0", 0), ("IB0", 0x3F), ("IB15", 0)] {
        uno.write(operand(name), value).unwrap();
    }
    assert_eq!(
        uno.write(operand("VW0"), 1).unwrap_err().to_string(),
        "the program does not use VW0"
    );
}

fn assert_ends_an_endless_scan(code: Code) {
    let program = image("LD SM0.0\n= Q0.0\nLD I0.0\nINCW MW0\nLBL 1\nLD I0.0\nJMP 1\n");
    let lines = instructions(&verify(program.as_slice()).unwrap());
    let jump_at = lines.iter().find(|line| line.decoded.op == Op::Jmp).unwrap().at;
    let mut uno = board_with(code, program, Clock::LockStep);
    uno.hold_clock_for(1_000_000);
    uno.scan(0);
    assert_eq!((uno.mode(), uno.pin_levels()), (Mode::Run, 1));
    uno.write(operand("I0.0"), 1).unwrap();
    uno.scan(1);
    assert_eq!(uno.fault_kind(), Some(Fault::Watchdog { at: jump_at }));
    let text = uno.fault().unwrap();
    assert!(
        text.starts_with("watchdog: the scan took longer than 500 ms; the program was at byte "),
        "{text}"
    );
    assert_eq!((uno.mode(), uno.pin_levels(), read(&mut uno, "MW0")), (Mode::Stop, 0, 1));
    uno.write(operand("I0.0"), 0).unwrap();
    uno.scan(2);
    assert_eq!((uno.mode(), read(&mut uno, "I0.0"), uno.broken()), (Mode::Stop, 0, None));
}

#[test]
fn an_endless_scan_ends_with_the_held_clock_too() {
    assert_ends_an_endless_scan(Code::Bytecode);
    assert_ends_an_endless_scan(Code::Native);
}

/// What stops a program on a board with its own clock.
fn fault_of(code: Code, text: &str) -> String {
    let mut uno = board_with(code, image(text), Clock::FreeRunning);
    uno.scan(0);
    uno.catch_up(2_000);
    uno.fault().unwrap_or_else(|| panic!("no fault: {text}"))
}

#[test]
fn what_is_no_place_of_the_bytecode_is_not_named_as_one() {
    let unsound = "LD SM0.0\nMOVD 16#7FC00000, VD8\nINCW VW20\nLD I0.1\nAR> VD8, 5.0\n= Q0.2\n";
    let endless = "LBL 1\nLD SM0.0\nJMP 1\n";
    let interrupted = format!(
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\nMOVB 5, SMB34\nATCH I0, 10\nENI\nLD I0.0\n\
            LBL 0\nLD I0.1\nJMP 0\n\
         LD I0.2\n= Q0.1\nEND_ORGANIZATION_BLOCK\nINTERRUPT_BLOCK I0:INT0\nBEGIN\n\
         {endless}END_INTERRUPT_BLOCK\n"
    );
    // Longer and longer routines: one of them closes its loop at the offset of that of the main
    // program.
    let longer = (8..14).map(|len| {
        interrupted.replace(endless, &format!("LD SM0.0\n{}{endless}", "NOT\n".repeat(len)))
    });
    for text in longer.chain([unsound.to_string(), interrupted.clone()]) {
        let interpreted = fault_of(Code::Bytecode, &text);
        assert!(interpreted.contains(" at byte "), "{interpreted}");
        let translated = fault_of(Code::Native, &text);
        assert!(
            translated.contains(" at offset 0x") && translated.ends_with("of the translated image"),
            "{translated}"
        );
    }
    // Loops of the main program are named by the bytecode, also where there are interrupts.
    let both = interrupted.replacen("LD I0.1", "LDN I0.1", 1);
    for text in [endless, &both.replace(endless, "LD SM0.0\nINCW VW0\nLBL 1\nLD I0.1\nJMP 1\n")] {
        let translated = fault_of(Code::Native, text);
        assert_eq!(translated, fault_of(Code::Bytecode, text));
        assert!(translated.contains(" at byte "), "{translated}");
    }
}

#[test]
fn what_does_not_fit_when_it_is_translated_is_an_error_and_changes_nothing() {
    let mut uno = board_with(Code::Native, image("LD SM0.0\n= Q0.1\n"), Clock::LockStep);
    let too_large = image(&"LD I0.0\nLD I0.1\nCTU C1, VW0\n".repeat(500));
    let error = uno.load(too_large.clone()).unwrap_err().to_string();
    assert!(error.starts_with("translated the program needs "), "{error}");
    uno.scan(0);
    assert_eq!((uno.mode(), uno.pin_levels()), (Mode::Run, 0b10), "what was there before");
    assert_eq!(
        uno.avr().flash()[usize::from(SLOT_START) + 5],
        NATIVE_INTERFACE,
        "and that is machine code"
    );
    let mut uno = board(too_large, Clock::LockStep);
    uno.scan(0);
    assert_eq!(uno.mode(), Mode::Run, "as bytecode it fits");
}

#[test]
fn a_clock_that_stands_still_is_a_fault() {
    let mut uno = uno("LD SM0.0\n= Q0.0\n", Clock::FreeRunning);
    uno.scan(0);
    uno.catch_up(100);
    assert_eq!((uno.mode(), uno.pin_levels()), (Mode::Run, 1));
    // The interrupt of the tick, off.
    uno.avr_mut().data_mut()[0x6E] = 0;
    uno.catch_up(2_000);
    assert_eq!(
        (uno.mode(), uno.pin_levels(), uno.fault_kind()),
        (Mode::Stop, 0, Some(Fault::Hang))
    );
}

#[test]
fn bad_images_and_none() {
    let mut bad = image("LD I0.0\n= Q0.0\n");
    bad[40] ^= 1;
    let of = |code| [(code, Clock::LockStep), (code, Clock::FreeRunning)];
    for (code, clock) in [Code::Bytecode, Code::Native].into_iter().flat_map(of) {
        let mut uno = board_with(code, bad.clone(), clock);
        uno.scan(0);
        assert_eq!((uno.mode(), uno.pin_levels()), (Mode::Stop, 0));
        assert!(uno.fault().is_some_and(|text| text.contains("bad image")), "{:?}", uno.fault());
        uno.load(Vec::new()).unwrap();
        uno.scan(0);
        assert_eq!((uno.mode(), uno.fault()), (Mode::Stop, None), "an erased slot is no fault");
    }
}

#[test]
fn many_programs_in_one_board_leave_nothing_to_the_next() {
    let set_all =
        image("LD SM0.0\nMOVW -1, MW0\nMOVW -1, VW0\nS Q0.0, 6\nS S0.0, 255\n//# retain VB0-VB1\n");
    let nothing = image("LD I0.0\n= V0.0\n");
    let mut uno = board(Vec::new(), Clock::LockStep);
    let mut lengths = Vec::new();
    for _ in 0..20 {
        uno.load(set_all.clone()).unwrap();
        (0..5).for_each(|scan| uno.scan(scan));
        assert_eq!((uno.pin_levels(), read(&mut uno, "MW0")), (0x3F, -1));
        uno.load(nothing.clone()).unwrap();
        assert_eq!(
            (uno.mode(), uno.pin_levels(), read(&mut uno, "MW0")),
            (Mode::Stop, 0, 0),
            "no power"
        );
        uno.scan(0);
        assert_eq!((uno.mode(), uno.pin_levels(), read(&mut uno, "VB0")), (Mode::Run, 0, 0));
        assert_eq!(["MW0", "SB0", "SB31"].map(|name| read(&mut uno, name)), [0; 3]);
        lengths.push(uno.scan_cycles());
    }
    assert!(lengths[0] > 0 && lengths.iter().all(|length| *length == lengths[0]), "{lengths:?}");
}

#[test]
fn the_held_clock_wraps() {
    let mut uno = uno("LD SM0.0\nTON T32, 10000\n", Clock::LockStep);
    uno.start_clock_at(u32::MAX - 10);
    for now_ms in [0, 5, 10, 11, 12, 40] {
        uno.scan(now_ms);
        // It starts in the first scan.
        assert_eq!(i64::from(read(&mut uno, "T32.cv")), now_ms as i64, "{now_ms}");
    }
}

#[test]
fn the_stack_is_measured() {
    let mut uno = uno("LD I0.0\n= Q0.0\n", Clock::LockStep);
    uno.scan(0);
    let unused = uno.unused_stack();
    assert!((1..0x300).contains(&unused), "{unused}");
    uno.avr_mut().data_mut()[0x0600..0x0900].fill(0);
    assert_eq!(uno.unused_stack(), 0);
}

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

/// Runs the examples in AWL.
fn assert_examples_do_what_they_shall(target: Target) {
    let mut count = 0;
    for path in fs::read_dir(examples()).unwrap().map(|entry| entry.unwrap().path()) {
        if path.extension().is_some_and(|extension| extension == "awl") {
            count += 1;
            assert_example_does_what_it_shall(&path.with_extension("scn"), target);
        }
    }
    assert_eq!(count, 15);
}

fn assert_example_does_what_it_shall(path: &Path, target: Target) {
    let origin = path.display().to_string();
    let text = fs::read_to_string(path).unwrap();
    let program = program_for(path, &text).unwrap();
    let files = ProgramFiles { program: &program, symbols: &[], data: None, board: None };
    let opened = files.open(target).unwrap_or_else(|error| panic!("{origin}: {error}"));
    // Of the tank, which runs for ten minutes, only the beginning.
    let length =
        |scenario: &Scenario| Length::For(scenario.run_ms.map_or(10_000, |ms| ms.min(40_000)));
    let (_, outcome) = run_file(path, opened, None, length);
    let Outcome { failures, fault, met, .. } = outcome;
    assert!(failures.is_empty() && fault.is_none(), "{origin}: {failures:#?}");
    assert!(met >= 2, "{origin}: {met}");
}

/// The loops of the diagrams settle at pins that are modulated, with the converter and the counter
/// of the board.
#[test]
fn loops_settle_on_a_board() {
    let of = |name: &str| examples().join("fbd").join(name).with_extension("scn");
    assert_example_does_what_it_shall(&of("rc_circuit"), Target::Uno);
    assert_example_does_what_it_shall(&of("rc_circuit"), Target::UnoNative);
    assert_example_does_what_it_shall(&of("excitation"), Target::Uno);
    // Translated it is too large.
    assert_example_does_what_it_shall(&of("motor_speed"), Target::Uno);
}

#[test]
fn examples_do_what_they_shall_on_a_board_with_its_own_clock() {
    assert_examples_do_what_they_shall(Target::Uno);
}

#[test]
fn examples_do_the_same_translated() {
    assert_examples_do_what_they_shall(Target::UnoNative);
}

#[test]
fn pulses_come_at_the_pins_in_their_time() {
    // As fast as the scans of the board can follow without an interrupt.
    let program = "LD I0.0\nLD I0.5\nCTU C0, 9999\nLD I0.1\nEU\nLD I0.0\nALD\nINCW VW0\nLD SM0.0\n\
        MOVW C0, VW2\n";
    let scenario = "at 10ms pulse I0.0 200Hz for 500ms\nat 261ms expect C0.cv = 50..51\n\
        at 700ms expect C0.cv = 100, I0.0 = 0
        at 700ms I0.5 = 1\nat 710ms I0.5 = 0\nat 800ms pulse I0.0, I0.1 100Hz 30 times\n\
        at 1200ms expect C0.cv = 30, VW0 = 30
        at 1200ms pulse I0.0, I0.1 100Hz 30 times reverse\n\
        at 1600ms expect C0.cv = 60, VW0 = 30, VW2 = 60";
    assert_holds(program, scenario);
    // The program sees it the other way round.
    assert_holds(&format!("//# invert I0.0\n{program}"), scenario);
    let act = |clock| {
        let mut uno = uno(program, clock);
        let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
        let scenario = Scenario::parse("t.scn", "at 0s pulse I0.6 1Hz for 1s", context).unwrap();
        uno.act(&scenario.actions[0]).unwrap_err().to_string()
    };
    assert!(act(Clock::FreeRunning).contains("I0.0 to I0.5"));
    assert!(act(Clock::LockStep).contains("its own clock"));
}

/// The buffer of TODR, and what it is before the clock is set and a second and a half after.
const CLOCK: &str = "//# memory VB0-VB7\nLD SM0.0\nTODR VB0\nAENO\n= M0.0\n";
const CLOCK_IS_SET: &str = "at 1s expect M0.0 = 0, VB0 = 0\nat 1s clock 2026-12-31 23:59:59\n\
    at 1500ms expect M0.0 = 1, VD0 = 16#26123123, VD4 = 16#59590005\n\
    at 2500ms expect VD0 = 16#27010100, VD4 = 16#00000006";

#[test]
fn the_clock_is_set_by_a_scenario() {
    assert_holds(CLOCK, CLOCK_IS_SET);
    let outcome = outcome(&mut uno(CLOCK, Clock::LockStep), CLOCK_IS_SET);
    assert!(outcome.failures.is_empty() && outcome.fault.is_none(), "{outcome:#?}");
    // Set before power comes.
    assert_holds(
        CLOCK,
        "at 0s clock 2000-01-01 00:00:00\nat 1500ms expect VD0 = 16#00010100, VD4 = 16#00010007",
    );
}

#[test]
fn characters_come_and_go_by_the_line() {
    let program = "//# memory VB0-VB7\nLD SM0.1\nMOVB 16#19, SMB30\nMOVB 2, VB0\n\
        MOVW 16#6869, VW1\nLD I0.0\nEU\nXMT VB0, 0\n\
                   LD I0.1\nMOVB 0, SMB30\n";
    let scenario = "at 20ms receive \"abc\"\nat 25ms expect SMB2 = 99\nat 25ms expect sent \"\"\n\
        at 25ms I0.0 = 1\n\
                    at 30ms expect sent \"hi\"\nat 30ms I0.1 = 1\nat 40ms receive \"status\\r\"\n\
                    at 99ms expect SMB2 = 99\n\
                    at 99ms expect sent \"\"";
    let mut uno = uno(program, Clock::FreeRunning);
    let outcome = outcome(&mut uno, scenario);
    assert!(outcome.failures.is_empty() && outcome.fault.is_none(), "{outcome:#?}");
    let held =
        board(image(program), Clock::LockStep).act(&Action::Receive { at_ms: 0, bytes: vec![1] });
    assert!(held.is_err_and(|error| error.to_string().contains("its own clock")));
}
