//! Jobs carried out on a model of a board: whole, cut off at every byte, on boards that are none.

use awl_asm::assemble::assemble;
use awl_asm::hex;
use awl_asm::source::Source;
use flash::bootloader::Bootloader;
use flash::{Cause, Failure, Firmware, Flasher, Holds, Job, Output, Phase};
use plc_isa::{UNO, verify};

/// Longer than any job may take, in milliseconds.
const FOREVER_MS: u64 = 600_000;

fn image(instructions: usize) -> Vec<u8> {
    let text = "LD I0.0\n= Q0.0\n".repeat(instructions / 2);
    assemble(&Source::new("p.awl", &text).unwrap(), Vec::new()).image.unwrap()
}

fn firmware() -> Vec<u8> {
    hex::firmware(hex::FIRMWARE).unwrap()
}

/// A board that holds the firmware and this program.
fn board(program: &[u8]) -> Bootloader {
    let mut board = Bootloader::default();
    let firmware = firmware();
    board.flash_mut()[..firmware.len()].copy_from_slice(&firmware);
    let start = usize::from(UNO.slot_start);
    board.flash_mut()[start..start + program.len()].copy_from_slice(program);
    board
}

/// Carries a job out until it ends, or until so many bytes have been sent; then the cable is out.
fn flash(board: &mut Bootloader, job: Job, mut bytes_left: usize) -> Result<(), Failure> {
    let mut flasher = Flasher::new(job);
    for now_ms in 0..FOREVER_MS {
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(on) => board.lines(on),
                Output::Send(bytes) => {
                    let sent = &bytes[..bytes.len().min(bytes_left)];
                    bytes_left -= sent.len();
                    let answer = board.receive(sent);
                    if bytes_left == 0 {
                        flasher.lost("the cable is out");
                    }
                    flasher.receive(&answer, now_ms);
                }
            }
        }
        if let Some(result) = flasher.result() {
            return result.clone();
        }
    }
    panic!("it does not end");
}

/// What a board does that is switched on again.
#[derive(Debug, PartialEq)]
enum Starts {
    Nothing,
    NoProgram,
    Program(Vec<u8>),
}

/// Pages are whole or erased in the model: of page 0 only the firmware's own may start it.
fn starts(board: &Bootloader) -> Starts {
    let firmware = firmware();
    let first = &board.flash()[..flash::PAGE_LEN];
    if *first != firmware[..flash::PAGE_LEN] {
        let is_trap = first.starts_with(&[0xFF, 0xCF]);
        assert!(is_trap || first.iter().all(|byte| *byte == 0xFF), "another page 0: {first:?}");
        return Starts::Nothing;
    }
    assert!(board.flash().starts_with(&firmware), "page 0 without the rest of the firmware");
    let slot = &board.flash()[usize::from(UNO.slot_start)..][..usize::from(UNO.slot_len)];
    match verify(slot) {
        Err(_) => Starts::NoProgram,
        Ok(program) => {
            Starts::Program(slot[..usize::from(program.plan().header.total_len)].to_vec())
        }
    }
}

#[test]
fn a_program_and_with_it_the_firmware() {
    let (old, new) = (image(400), image(1000));
    let mut one = board(&old);
    flash(&mut one, Job::new(Firmware::Expect(&firmware()), &new).unwrap(), usize::MAX).unwrap();
    assert_eq!(starts(&one), Starts::Program(new.clone()));
    let mut blank = Bootloader::default();
    flash(&mut blank, Job::new(Firmware::Write(&firmware()), &new).unwrap(), usize::MAX).unwrap();
    assert_eq!(starts(&blank), Starts::Program(new));
}

#[test]
fn cut_off_after_every_byte_it_never_runs_half_a_program() {
    let (old, new) = (image(400), image(300));
    let code = firmware();
    for firmware in [Firmware::Expect(&code), Firmware::Write(&code)] {
        let job = Job::new(firmware, &new).unwrap();
        let is_written = matches!(firmware, Firmware::Write(_));
        // Every byte of the program's writing; of the firmware's, which is long, some.
        let stride = if is_written { 61 } else { 1 };
        let mut seen = [0; 3];
        for bytes in (1..).step_by(stride) {
            let mut board = board(&old);
            let Err(Failure { cause, holds }) = flash(&mut board, job.clone(), bytes) else {
                break;
            };
            assert_eq!(cause, Cause::Lost("the cable is out".into()));
            let starts = starts(&board);
            seen[match starts {
                Starts::Nothing => 0,
                Starts::NoProgram => 1,
                Starts::Program(_) => 2,
            }] += 1;
            let (old, new) = (Starts::Program(old.clone()), Starts::Program(new.clone()));
            let none = if is_written { Starts::Nothing } else { Starts::NoProgram };
            let is_told = match holds {
                Holds::Before => starts == old,
                Holds::BeforeOrNothing => starts == old || starts == none,
                Holds::NoProgram | Holds::NoFirmware => starts == none,
                Holds::NewOrNothing => starts == none || starts == new,
                Holds::New => starts == new,
            };
            assert!(is_told, "after {bytes} bytes: told {holds:?}");
        }
        let expected = if is_written { [true, false, true] } else { [false, true, true] };
        assert_eq!(seen.map(|count| count > 0), expected, "{seen:?}");
    }
}

#[test]
fn what_it_told_helps_after_a_cut() {
    let (old, new) = (image(400), image(300));
    let mut board = board(&old);
    let code = firmware();
    let again = || Job::new(Firmware::Write(&code), &new).unwrap();
    assert_eq!(flash(&mut board, again(), 9_000).unwrap_err().holds, Holds::NoFirmware);
    // The firmware is not there: it is asked for, and then all is well.
    let only = Job::new(Firmware::Expect(&code), &new).unwrap();
    let failure = flash(&mut board, only, usize::MAX).unwrap_err();
    assert_eq!((failure.cause, failure.holds), (Cause::OtherFirmware, Holds::Before));
    flash(&mut board, again(), usize::MAX).unwrap();
    assert_eq!(starts(&board), Starts::Program(new));
}

#[test]
fn boards_that_are_none_are_left_as_they_are() {
    let code = firmware();
    let job = || Job::new(Firmware::Write(&code), &image(10)).unwrap();
    let mut other = board(&image(4));
    other.signature = [0x1E, 0x94, 0x06];
    let before = other.flash().to_vec();
    let failure = flash(&mut other, job(), usize::MAX).unwrap_err();
    assert_eq!(failure.cause, Cause::OtherChip([0x1E, 0x94, 0x06]));
    assert_eq!((failure.holds, other.flash()), (Holds::Before, &before[..]));

    let mut flasher = Flasher::new(job());
    let end = (0..FOREVER_MS).find(|&now_ms| {
        while flasher.poll(now_ms).is_some() {}
        flasher.result().is_some()
    });
    assert!((8_000..15_000).contains(&end.unwrap()), "{end:?} ms");
    let failure = flasher.result().cloned().unwrap().unwrap_err();
    assert_eq!((failure.cause, failure.holds), (Cause::NoAnswer, Holds::Before));
}

/// Carries a job out over a line that `spoils` the answers.
fn over(job: Job, mut spoil: impl FnMut(&mut Bootloader, Vec<u8>) -> Vec<u8>) -> Flasher {
    let (mut flasher, mut board) = (Flasher::new(job), board(&image(4)));
    for now_ms in 0..FOREVER_MS {
        let mut answers = Vec::new();
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(on) => board.lines(on),
                Output::Send(bytes) => answers.extend(board.receive(&bytes)),
            }
        }
        let answers = spoil(&mut board, answers);
        flasher.receive(&answers, now_ms);
        if flasher.result().is_some() {
            return flasher;
        }
    }
    panic!("it does not end");
}

#[test]
fn a_wrong_byte_is_found_and_its_place_told() {
    let code = firmware();
    let job = Job::new(Firmware::Expect(&code), &image(300)).unwrap();
    let place = (0x80..).find(|&place| image(300)[place] != 0).unwrap();
    let (at, worn) = (0x6000 + place, 1 << image(300)[place].trailing_zeros());
    let flasher = over(job, |board, answers| {
        // A bit of the flash that does not hold.
        board.flash_mut()[at] &= !worn;
        answers
    });
    let failure = flasher.result().cloned().unwrap().unwrap_err();
    assert_eq!((failure.cause, failure.holds), (Cause::Mismatch(at as u16), Holds::NoProgram));
}

#[test]
fn an_answer_that_is_lost_now_and_then_does_no_harm() {
    let code = firmware();
    let job = Job::new(Firmware::Expect(&code), &image(300)).unwrap();
    let mut count = 0;
    let flasher = over(job, |_, answers| {
        count += usize::from(!answers.is_empty());
        if matches!(count, 7 | 31) { Vec::new() } else { answers }
    });
    assert_eq!(flasher.result(), Some(&Ok(())));
}

#[test]
fn what_the_program_says_before_the_reset_is_not_taken_for_answers() {
    let code = firmware();
    let job = Job::new(Firmware::Expect(&code), &image(20)).unwrap();
    let (mut flasher, mut board) = (Flasher::new(job), board(&image(4)));
    let mut is_reset = false;
    for now_ms in 0..FOREVER_MS {
        if !is_reset {
            flasher.receive(&[0x14, 0x10, 0x14], now_ms);
        }
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(on) => {
                    is_reset |= on;
                    board.lines(on);
                }
                Output::Send(bytes) => flasher.receive(&board.receive(&bytes), now_ms),
            }
        }
        if flasher.result().is_some() {
            break;
        }
    }
    assert_eq!(flasher.result(), Some(&Ok(())));
}

#[test]
fn random_bytes_neither_end_in_a_panic_nor_in_a_good_board() {
    let mut random = fastrand::Rng::with_seed(1);
    let code = firmware();
    let job = Job::new(Firmware::Expect(&code), &image(40)).unwrap();
    let usual = [0x14, 0x10, 0x1E, 0x95, 0x0F, 0x00, 0xFF];
    for round in 0..300 {
        let mut flasher = Flasher::new(job.clone());
        let mut now_ms = 0;
        while flasher.result().is_none() {
            assert!(now_ms < FOREVER_MS, "it does not end in round {round}");
            while flasher.poll(now_ms).is_some() {}
            // Half of the rounds know what a bootloader says.
            let byte = |random: &mut fastrand::Rng| match round % 2 {
                0 => random.u8(..),
                _ => usual[random.usize(..usual.len())],
            };
            let bytes: Vec<u8> = (0..random.usize(..8)).map(|_| byte(&mut random)).collect();
            flasher.receive(&bytes, now_ms);
            now_ms += random.u64(1..40);
        }
        assert!(flasher.result().unwrap().is_err(), "round {round}");
        // Whatever is said to it afterwards changes nothing.
        let result = flasher.result().cloned();
        flasher.lost("later");
        flasher.receive(&[0x14, 0x10], now_ms);
        assert_eq!((flasher.poll(now_ms + 1), flasher.result()), (None, result.as_ref()));
    }
}

#[test]
fn progress_goes_on_to_the_end() {
    let code = firmware();
    let mut flasher = Flasher::new(Job::new(Firmware::Write(&code), &image(300)).unwrap());
    let mut board = Bootloader::default();
    let mut phases = vec![flasher.progress().phase];
    let mut done = 0;
    for now_ms in 0..FOREVER_MS {
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(on) => board.lines(on),
                Output::Send(bytes) => flasher.receive(&board.receive(&bytes), now_ms),
            }
            let progress = flasher.progress();
            assert!(progress.done >= done && progress.done <= progress.total);
            done = progress.done;
            if phases.last() != Some(&progress.phase) {
                phases.push(progress.phase);
            }
        }
        if flasher.result().is_some() {
            break;
        }
    }
    assert_eq!(done, flasher.progress().total);
    assert_eq!((phases[0], phases[1]), (Phase::Connecting, Phase::Writing));
    assert_eq!(phases.last(), Some(&Phase::Starting));
    // All is written once and read once, and the two first pages twice.
    let pages =
        firmware().len().div_ceil(flash::PAGE_LEN) + image(300).len().div_ceil(flash::PAGE_LEN);
    assert_eq!(done as usize, 2 * (pages + 2) * flash::PAGE_LEN);
}
