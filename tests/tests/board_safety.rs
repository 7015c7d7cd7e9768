//! What the shipped firmware promises about safety, on a simulated Uno: whatever is wrong, the
//! outputs are released.
//!
//! Serial line and settings have files of their own; what the program's instructions do is a matter
//! of `lockstep`.
#![cfg(feature = "uno")]

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{CRC_LEN, DATA_END, DATA_START, HEADER_LEN, M_START, MAGIC, SLOT_LEN, SM_START};
use plc_vm::Fault;
use simavr::Reset;
use tests::bench_board::{BenchBoard, MS, example, image};
use tests::link::{self, Command};

/// All outputs on, in every scan.
const ALL_ON: &str = "//# name on\nLD SM0.0\n= Q0.0\n= Q0.1\n= Q0.2\n= Q0.3\n= Q0.4\n= Q0.5\n";

/// Asserts that a bad image does not run for so many scans, and that the fault says so.
fn assert_refused(board: &mut BenchBoard, scans: usize, what: &str) {
    for _ in 0..scans {
        assert!(board.is_released(), "{what}: outputs driven");
        board.scan();
        assert!(!board.runs(), "{what}: RUN");
    }
    assert!(board.is_released(), "{what}: outputs driven");
    assert!(matches!(board.fault(), Some(Fault::BadImage(_))), "{what}: {:?}", board.fault());
}

#[test]
fn a_program_with_any_byte_changed_never_runs() {
    let mut board = BenchBoard::new();
    for name in ["station1", "motor", "traffic_light"] {
        let image = example(name);
        board.insert(&image);
        board.power_up();
        board.scans(2);
        assert!(board.runs() && board.outputs().is_some(), "{name}: {:?}", board.fault());
        for (at, &byte) in image.iter().enumerate() {
            for flip in [0xFF, 1 << (at % 8)] {
                board.slot()[at] = byte ^ flip;
                board.power_up();
                assert_refused(&mut board, 100, &format!("{name}, byte {at} ^ {flip:#04x}"));
            }
            board.slot()[at] = byte;
        }
    }
}

/// From the end of the watchdog time to the released outputs: whole ticks count, so up to one more,
/// the program looks at the clock once a pass, the rest of the scan follows.
const WATCHDOG_TOLERANCE_MS: u64 = 2;

/// Loops as long as I0.0 is on, and has all outputs on before.
fn endless(settings: &str, wdr: &str) -> String {
    format!("{settings}{ALL_ON}LBL 1\nLD SM0.0\n{wdr}\nLD I0.0\nJMP 1\n")
}

/// The place of the last instruction in the image: the jump back.
fn place_of_jump(program: &str) -> u32 {
    let assembly = assemble(&Source::new("bench", program).expect("a source"), Vec::new());
    assembly.lines.last().expect("there are instructions").at
}

/// Milliseconds until the watchdog ends a scan of this program.
fn time_of_watchdog(program: &str, ms_max: u64) -> f64 {
    let mut board = BenchBoard::running(program);
    assert_eq!(board.outputs(), Some(0x3F));
    board.drive_inputs(1);
    board.to_scan_start();
    let cycles = board.run_until(100, ms_max * MS, |board| board.is_released());
    let end = board.scan();
    assert!(end.cycles() - cycles < MS / 2, "the outputs are released with the end of the scan");
    let Some(Fault::Watchdog { at }) = board.fault() else { panic!("{:?}", board.fault()) };
    assert_eq!((board.runs(), u32::from(at)), (false, place_of_jump(program)));
    assert_run_starts_again(&mut board);
    cycles as f64 / MS as f64
}

/// RUN brings the same fault again as long as the loop is endless, and goes on when it is not.
fn assert_run_starts_again(board: &mut BenchBoard) {
    board.drive_inputs(0);
    let said = link::identify(board);
    assert!(!said.runs() && matches!(said.fault, Some(Fault::Watchdog { .. })), "{said:?}");
    assert!(board.is_released());
    link::run(board);
    let said = link::identify(board);
    assert!(said.runs() && board.runs() && board.outputs() == Some(0x3F), "{said:?}");
    assert_eq!((board.fault(), said.fault), (None, None));
}

fn assert_time(found_ms: f64, wanted_ms: u64) {
    let tolerance = WATCHDOG_TOLERANCE_MS as f64;
    println!("watchdog of {wanted_ms} ms: outputs released after {found_ms:.3} ms");
    let late_ms = found_ms - wanted_ms as f64;
    assert!((0.0..=tolerance).contains(&late_ms), "{found_ms} ms instead of {wanted_ms} ms");
}

#[test]
fn an_endless_loop_ends_after_the_watchdog_time() {
    assert_time(time_of_watchdog(&endless("", ""), 1_000), 500);
    assert_time(time_of_watchdog(&endless("//# watchdog 50ms\n", ""), 1_000), 50);
}

#[test]
fn wdr_puts_the_watchdog_off_but_not_for_ever() {
    assert_time(time_of_watchdog(&endless("//# watchdog 50ms\n", "WDR"), 61_000), 60_000);
}

#[test]
fn a_run_command_does_not_hide_the_fault_that_comes_before_it() {
    let mut board = BenchBoard::running(&endless("//# watchdog 50ms\n", ""));
    board.drive_inputs(1);
    board.to_scan_start();
    board.say(&link::frame(link::UNIT, &Command::Run.pdu()));
    board.scan_within(1_000 * MS);
    assert!(matches!(board.fault(), Some(Fault::Watchdog { .. })), "{:?}", board.fault());
    assert!(!board.runs() && board.is_released());
    board.drive_inputs(0);
    board.scans_for(10);
    assert!(board.runs(), "the RUN that was asked for begins when that has been answered");
    board.reset();
    let said = link::identify(&mut board);
    assert!(
        said.fault.is_none() && matches!(said.fault_before_reset, Some(Fault::Watchdog { .. })),
        "{said:?}"
    );
}

#[test]
fn a_program_without_loops_can_be_too_slow_too() {
    let slow = format!("//# watchdog 5ms\n{ALL_ON}{}", "LD I0.0\n/I 1, MW0\n".repeat(800));
    let mut board = BenchBoard::new();
    board.insert(&image(&slow));
    board.power_up();
    board.drive_inputs(1);
    board.scan_within(1_000 * MS);
    let Some(Fault::Watchdog { at }) = board.fault() else { panic!("{:?}", board.fault()) };
    assert_eq!(
        usize::from(at),
        image(&slow).len() - 5,
        "the end of the program, before its checksum"
    );
    assert!(!board.runs() && board.is_released());
}

/// Longer than the hardware watchdog waits, and not a jump in it.
#[test]
fn a_program_without_loops_may_take_long_when_it_says_so() {
    let uses: String = (0..200).map(|number| format!("MOVW 0, C{number}\n")).collect();
    let slow = format!(
        "//# watchdog 2s\n{ALL_ON}LD SM0.1\n{uses}LD I0.0\n{}",
        "R C0, 255\n".repeat(1_900)
    );
    let mut board = BenchBoard::new();
    board.insert(&image(&slow));
    board.power_up();
    board.drive_inputs(1);
    for _ in 0..3 {
        let start = board.avr.cycles();
        board.scan_within(2_000 * MS);
        assert!(board.avr.cycles() - start > 600 * MS, "the program is not slow");
        assert!(board.runs(), "{:?}", board.fault());
    }
}

#[test]
fn a_division_by_zero_is_told_and_the_program_goes_on() {
    let program =
        "LD SM0.0\nMOVW 7, MW0\n/I MW2, MW0\n= Q0.1\nLD SM1.3\n= Q0.0\nLD SM0.0\nINCW MW4\n";
    let mut board = BenchBoard::running(program);
    for scan in 1..100 {
        assert_eq!(board.byte(SM_START + 1) >> 3, 1, "SM1.3, which INCW leaves alone");
        assert_eq!(
            (board.outputs(), board.word(M_START), board.word(M_START + 4)),
            (Some(3), 7, scan)
        );
        board.scan();
        assert!(board.runs());
    }
}

/// As long as the slot allows: loops eight deep with counters and timers inside, nine levels of the
/// logic stack, and instructions of every chapter, retained values too.
fn longest_program() -> String {
    let mut program =
        "//# name longest-possible-program\n//# retain VB0-VB99, C0-C9\nLD SM0.0\n".to_string();
    (0..8).for_each(|level| program += &format!("FOR VW{}, 1, 1\n", 2 * level));
    program += "LD I0.0\nLD I0.1\nLD I0.2\nCTUD C0, 2\nLD SM0.0\nTON T32, 100\nTOF T33, 10\n\
        TONR T5, VW20\n";
    (0..9).for_each(|level| program += &format!("LD M0.{}\n", level % 8));
    program += "ALD\nOLD\n= Q0.0\n";
    program += &"NEXT\n".repeat(8);
    let rest = "LD SM0.0\nMOVW AIW0, VW30\n/I 7, VW30\n*I VW30, VW32\nS M2.0, 9\nR C3, 2\n\
        LDW>= VW30, VW32\nEU\n\
        = Q0.1\nLD I0.3\nLD I0.4\nCTU C4, VW30\nLD I0.5\nTON T37, 20\n";
    // Each repetition takes the same place, but for what looks for status windows.
    let bytes = |program: &str| image(program).len();
    let [one, more] = [1, 41].map(|times| bytes(&(program.clone() + &rest.repeat(times))));
    program += &rest.repeat((usize::from(SLOT_LEN) - one) / (more - one).div_ceil(40));
    let left = usize::from(SLOT_LEN) - bytes(&program);
    program + &"= M9.0\n".repeat((left - left / 100 - 1) / 2)
}

/// Bytes between stack and variables that must stay unused.
const STACK_SPARE_MIN: usize = 128;

/// Requests of all kinds.
const REQUESTS: [&[u8]; 8] = [
    &[1, 0, 0, 0, 1],
    &[3, 0x1F, 0x40, 0, 14],
    &[15, 0, 0, 0, 1, 1, 0],
    &[43, 14, 2, 0],
    &[65],
    &[67, 2, 0x20, 0, 0, 0x29, 0, 0],
    &[68, 1, 0x20, 0, 10, 0, 0, 0, 1],
    &[71, 0, 0, 0, 16],
];

#[test]
fn the_stack_keeps_away_from_the_variables() {
    let (mut board, image) = (BenchBoard::new(), image(&longest_program()));
    assert!(
        image.len() + 4 > usize::from(SLOT_LEN),
        "{} bytes are not the longest program",
        image.len()
    );
    board.insert(&image);
    let start = board.avr.cycles();
    board.power_up();
    let start_ms = (board.avr.cycles() - start) / MS;
    for inputs in [0x00, 0x3F, 0x15, 0x2A] {
        board.drive_inputs(inputs);
        for request in REQUESTS {
            assert!(link::exchange(&mut board, link::UNIT, request).is_some());
        }
        link::stop(&mut board);
        link::run(&mut board);
        assert!(board.runs(), "{:?}", board.fault());
    }
    let (unused, said) = (board.unused_stack(), link::identify(&mut board));
    println!(
        "{} bytes of program: start {start_ms} ms, {unused} bytes of stack never used",
        image.len()
    );
    assert_eq!(usize::from(said.free_stack), unused, "{said:?}");
    assert!(unused >= STACK_SPARE_MIN, "only {unused} bytes between stack and variables");
}

/// Counts first scans and scans, and fills memory.
const COUNT_STARTS: &str = "//# name starts\nLD SM0.1\nINCW MW0\nLD SM0.3\nINCW MW4\nLD SM0.0\n\
    INCW MW2\nMOVW -1, VW0\n\
    MOVW -1, VW90\nS M10.0, 100\nTON T37, 1\nLD SM0.6\nLD SM0.0\nLD SM0.1\nCTUD C0, 5\nLD SM0.0\n\
    S Q0.0, 6\n";

#[test]
fn a_reset_at_any_time_releases_the_outputs_and_starts_anew() {
    let (mut board, mut rng) = (BenchBoard::running(COUNT_STARTS), Rng::with_seed(1));
    let after_power_up = board.avr.data()[usize::from(DATA_START)..usize::from(DATA_END)].to_vec();
    for round in 0..300 {
        board.scans(2);
        assert_eq!(board.outputs(), Some(0x3F), "round {round}");
        board.avr.run_for(rng.u64(..10_000));
        // Whatever the program has left.
        let left = [rng.u8(..); (DATA_END - DATA_START) as usize];
        board.write(DATA_START, &left);
        board.avr.reset(Reset::External);
        // Until the outputs are written at the end of the first scan, which is where a scan is
        // called ended.
        while board.outputs().is_none() {
            assert!(
                !board.drives(),
                "round {round}: outputs driven before the end of the first scan"
            );
            board.run_on(8);
        }
        let found = &board.avr.data()[usize::from(DATA_START)..usize::from(DATA_END)];
        assert_eq!(found, after_power_up, "round {round}: something is left in memory");
        assert_eq!(
            [0, 2, 4].map(|byte| board.word(M_START + byte)),
            [1, 1, 1],
            "round {round}: no first scan"
        );
        board.scan();
        assert_eq!((board.runs(), board.fault()), (true, None), "round {round}");
    }
}

/// Longest time from a hang to released outputs: the hardware watchdog counts 65,536 cycles of its
/// 128 kHz, which are exact in simavr, and some of the firmware's.
const HANG_MS_MAX: u64 = 513;
/// From there to the reset. The firmware asks for 2,048 cycles, 16 ms, which simavr takes for its
/// next period only.
const HANG_TO_RESET_MS_MAX: u64 = 513;

/// The board hangs from now on until `mend` has been called. It must release its outputs, reset
/// itself, and stay in STOP until somebody says RUN.
fn assert_hang_is_caught(board: &mut BenchBoard, mend: impl FnOnce(&mut BenchBoard)) {
    let released = board.run_until(100, HANG_MS_MAX * MS, |board| board.is_released());
    // What it does in there is wait for its reset.
    board.avr.run_for(MS);
    mend(board);
    // It writes zeros over the status as it starts.
    let (status, start) = (board.stack_limit(), board.avr.cycles());
    board.write(status, &[0]);
    board.run_until(100, HANG_TO_RESET_MS_MAX * MS, |board| board.byte(status) != 0);
    let reset = board.avr.cycles() - start + MS;
    println!("outputs released {} ms after the hang, reset {} ms later", released / MS, reset / MS);
    for _ in 0..100 {
        board.scan();
        assert_eq!((board.runs(), board.fault()), (false, Some(Fault::Hang)));
        assert!(board.is_released());
    }
    let said = link::identify(board);
    assert!(!said.runs() && said.fault == Some(Fault::Hang), "{said:?}");
    link::run(board);
    assert!(link::identify(board).runs() && board.runs() && board.outputs() == Some(0x3F));
    board.avr.reset(Reset::External);
    board.scans_for(30);
    let said = link::identify(board);
    assert!(
        said.runs() && said.fault.is_none() && said.fault_before_reset == Some(Fault::Hang),
        "{said:?}"
    );
    assert_eq!((board.runs(), board.fault(), board.outputs()), (true, None, Some(0x3F)));
}

/// Enables the interrupt that counts the milliseconds: register and bit.
const TICK_INTERRUPT: (u16, u8) = (0x6E, 1 << 1);

#[test]
fn a_clock_that_stands_still_is_caught() {
    let mut board = BenchBoard::running(ALL_ON);
    board.scans_for(200);
    let (register, bit) = TICK_INTERRUPT;
    let value = board.byte(register) & !bit;
    board.write(register, &[value]);
    assert_hang_is_caught(&mut board, |_| {});
}

#[test]
fn a_firmware_that_hangs_is_caught() {
    let mut board = BenchBoard::running(ALL_ON);
    board.scans_for(200);
    board.to_scan_start();
    // A jump to itself, with interrupts and the clock going on.
    let place = board.avr.pc() as usize..board.avr.pc() as usize + 2;
    let instruction = board.avr.flash()[place.clone()].to_vec();
    board.avr.flash_mut()[place.clone()].copy_from_slice(&[0xFF, 0xCF]);
    assert_hang_is_caught(&mut board, |board| {
        board.avr.flash_mut()[place].copy_from_slice(&instruction)
    });
}

/// Milliseconds until a changed byte has certainly been seen: the checksum takes a byte a tick and
/// a tick for the comparison. The byte may have been passed just before, so that this pass and the
/// next one are needed.
fn ms_of_two_passes(len: usize) -> u64 {
    2 * (len as u64 + 1)
}

#[test]
fn a_program_that_changes_in_flash_is_seen_in_time() {
    let (mut board, image) = (BenchBoard::new(), image(ALL_ON));
    let ms_max = ms_of_two_passes(image.len());
    board.insert(&image);
    board.power_up();
    let mut longest = 0;
    // Of bytes that do not matter for its execution: the name, and the checksum itself.
    let (name, crc) = (usize::from(HEADER_LEN), image.len() - usize::from(CRC_LEN)..image.len());
    for (round, at) in [name, name + 1].into_iter().chain(crc).enumerate() {
        board.scans_for((7 + round * image.len() / 6) as u64);
        assert!(board.runs());
        board.slot()[at] ^= 1;
        let start = board.avr.cycles();
        while board.runs() {
            assert_eq!(board.outputs(), Some(0x3F));
            assert!(board.avr.cycles() - start <= ms_max * MS, "the change is not seen");
            board.scan();
        }
        longest = longest.max(board.avr.cycles() - start);
        assert_eq!((board.fault(), board.is_released()), (Some(Fault::ProgramChanged), true));
        // Nobody has checked it again, so the fault stays.
        assert_eq!(link::command(&mut board, Command::ClearFault), Ok(()));
        assert_eq!(board.fault(), Some(Fault::ProgramChanged));
        link::run(&mut board);
        assert!(!link::identify(&mut board).runs() && board.is_released(), "byte {at}");
        assert_refused(&mut board, 100, "RUN with the changed program");
        assert_eq!(link::command(&mut board, Command::Run), Err(4), "there is no program any more");
        board.slot()[at] ^= 1;
        board.reset();
        board.scan();
        assert!(link::identify(&mut board).runs() && board.outputs() == Some(0x3F));
    }
    println!("{} bytes: seen after at most {} ms, {ms_max} are allowed", image.len(), longest / MS);
}

#[test]
fn a_program_erased_under_way_does_not_start_again() {
    let mut board = BenchBoard::running(ALL_ON);
    board.slot().fill(0xFF);
    board.scans_for(ms_of_two_passes(image(ALL_ON).len()));
    assert!(!board.runs() && board.fault().is_some() && board.is_released());
    let _ = link::command(&mut board, Command::Run);
    assert!(!link::identify(&mut board).runs() && !board.runs() && board.is_released());
}

/// Whatever a changed instruction does until the checksum sees it, the PLC comes to STOP and the
/// firmware lives on.
#[test]
fn any_change_while_running_ends_in_stop() {
    let image = example("motor");
    let mut board = BenchBoard::new();
    for at in 0..image.len() {
        board.insert(&image);
        board.power_up();
        board.scans(2);
        assert!(board.runs());
        board.slot()[at] ^= 0xFF;
        board.scans_for(ms_of_two_passes(image.len()));
        assert!(!board.runs() && board.is_released(), "byte {at}");
        let fault = board.fault();
        let is_seen =
            matches!(fault, Some(Fault::ProgramChanged | Fault::UndefinedInstruction { .. }));
        assert!(is_seen, "byte {at}: {fault:?}");
        assert!(!link::identify(&mut board).runs(), "byte {at}");
    }
}

#[test]
fn a_stack_that_reaches_the_variables_stops_the_plc() {
    let mut board = BenchBoard::running(ALL_ON);
    for offset in 0..4 {
        board.scans(100);
        assert_eq!(board.outputs(), Some(0x3F));
        let canary = board.stack_limit() + offset;
        board.write(canary, &[0]);
        board.scan();
        assert_eq!(
            (board.runs(), board.fault(), board.is_released()),
            (false, Some(Fault::StackOverflow), true)
        );
        let _ = link::command(&mut board, Command::Run);
        for _ in 0..50 {
            board.scan();
            assert!(board.is_released() && !board.runs(), "RUN with a broken stack");
        }
        assert_eq!(board.fault(), Some(Fault::StackOverflow));
        board.reset();
        board.scan();
        assert_eq!((board.runs(), board.fault()), (true, None), "after a reset");
    }
}

#[test]
fn without_a_program_the_board_waits() {
    let mut board = BenchBoard::new();
    board.power_up();
    for _ in 0..1_000 {
        board.scan();
        assert_eq!((board.runs(), board.fault(), board.is_released()), (false, None, true));
    }
    assert_eq!(link::command(&mut board, Command::Run), Err(4));
    assert_eq!(link::command(&mut board, Command::Scans(1)), Err(4));
    let said = link::identify(&mut board);
    assert_eq!((said.state, said.fault, said.image), (0, None, (0, 0)));
    assert!(board.is_released());
}

#[test]
fn garbage_in_the_slot_never_runs() {
    let (mut board, mut rng) = (BenchBoard::new(), Rng::with_seed(1));
    let motor = example("motor");
    for round in 0..200 {
        let mut slot = [0; SLOT_LEN as usize];
        rng.fill(&mut slot);
        match round % 4 {
            1 => slot[..MAGIC.len()].copy_from_slice(&MAGIC),
            2 => slot[..usize::from(HEADER_LEN)].copy_from_slice(&motor[..usize::from(HEADER_LEN)]),
            3 => slot[..motor.len() - 1].copy_from_slice(&motor[..motor.len() - 1]),
            _ => {}
        }
        assert_ne!(slot[..motor.len()], motor);
        board.insert(&slot);
        board.power_up();
        assert_refused(&mut board, 20, &format!("round {round}"));
        assert_eq!(link::command(&mut board, Command::Run), Err(4), "round {round}");
        assert_refused(&mut board, 20, &format!("round {round}, RUN"));
    }
}
