//! The way to the board without avrdude: the crate flash and the real Optiboot, whole and cut off.

#![cfg(feature = "uno")]

use std::fs::File;
use std::io::{ErrorKind, Read, Write};

use awl_asm::hex;
use flash::{Cause, Failure, Firmware, Flasher, Holds, Job, Output};
use plc_isa::UNO;
use simavr::{Avr, Pin};
use tests::commands::kept_firmware;
use tests::plugged::{
    BOOTLOADER_MS, FOLLOW, INVERT, asked, behaviour, board, expected_firmware_flash,
    firmware_flash, image, open, pass, said, slot_has,
};
use virtual_uno::VirtualUno;

/// From the end of writing to the first scan.
const START_MS: u32 = 300;
/// Writing and reading back all of the flash, and more.
const LONGEST_MS: u64 = 60_000;
/// The first byte of the command that writes a page, and its length up to the page.
const WRITE_PAGE: u8 = b'd';
const HEAD_LEN: usize = 4;

/// Where the cable is pulled out.
#[derive(Debug, Clone, Copy)]
enum Cut {
    Never,
    /// After so many pages.
    After(usize),
    /// When the page with this number is announced, and some of it sent: it is erased.
    Within(usize),
}

/// Writes a board by its port. A pseudo-terminal has no DTR: its port is closed and opened.
fn flash(uno: &mut VirtualUno, job: Job, cut: Cut) -> Result<(), Failure> {
    let mut flasher = Flasher::new(job);
    let mut terminal: Option<File> = Some(open(uno));
    let mut pages = 0;
    for now_ms in 0..LONGEST_MS {
        while let Some(output) = flasher.poll(now_ms) {
            match output {
                Output::Lines(false) => terminal = None,
                Output::Lines(true) => terminal = Some(open(uno)),
                Output::Send(bytes) => {
                    let port = terminal.as_mut().expect("it is open");
                    pages += usize::from(bytes[0] == WRITE_PAGE);
                    let is_page = bytes[0] == WRITE_PAGE;
                    match cut {
                        Cut::Within(page) if is_page && pages == page => {
                            port.write_all(&bytes[..HEAD_LEN + 20]).unwrap();
                            pass(uno, 20);
                            flasher.lost("the cable is out");
                        }
                        _ => port.write_all(&bytes).unwrap(),
                    }
                }
            }
        }
        uno.step().unwrap();
        let mut bytes = [0; 512];
        if let Some(port) = &mut terminal {
            match port.read(&mut bytes) {
                Ok(len) => flasher.receive(&bytes[..len], now_ms),
                Err(error) => assert_eq!(error.kind(), ErrorKind::WouldBlock, "{error}"),
            }
        }
        // The answer to a page that is written is its end.
        if let Cut::After(last) = cut
            && pages == last
            && flasher.progress().done > 0
            && uno.avr().uart_waiting() == 0
        {
            pass(uno, 40);
            flasher.lost("the cable is out");
        }
        if let Some(result) = flasher.result() {
            // What came last is not left to who opens the port next.
            while terminal.as_mut().is_some_and(|port| port.read(&mut bytes).is_ok()) {}
            drop(terminal);
            pass(uno, 2);
            return result.clone();
        }
    }
    panic!("it does not end");
}

fn firmware() -> Vec<u8> {
    hex::firmware(hex::FIRMWARE).unwrap()
}

fn only(program: &str) -> Job {
    Job::new(Firmware::Expect(&firmware()), &image(program)).unwrap()
}

fn with_firmware(program: &str) -> Job {
    Job::new(Firmware::Write(&firmware()), &image(program)).unwrap()
}

/// A board with the firmware and a program.
fn with_program(program: &str) -> VirtualUno {
    let mut uno = board();
    uno.load(&kept_firmware()).unwrap();
    uno.avr_mut().write_flash(UNO.slot_start.into(), &image(program)).unwrap();
    pass(&mut uno, START_MS);
    uno
}

/// Whether a lamp is on at any output: D13 is the bootloader's own.
fn has_lamp_on(avr: &Avr) -> bool {
    (8..13).map(Pin::of_uno).any(|pin| avr.is_output(pin) && avr.level(pin))
}

/// Whether all outputs stay off after a reset, with all inputs on.
fn stays_off(uno: &mut VirtualUno) -> bool {
    for pin in 2..=7 {
        uno.avr_mut().drive(Pin::of_uno(pin), true);
    }
    drop(open(uno));
    let is_off = (0..BOOTLOADER_MS + START_MS).all(|_| {
        uno.step().unwrap();
        !has_lamp_on(uno.avr())
    });
    for pin in 2..=7 {
        uno.avr_mut().drive(Pin::of_uno(pin), false);
    }
    is_off
}

#[test]
fn a_new_board_and_then_another_program() {
    let mut uno = board();
    flash(&mut uno, with_firmware(FOLLOW), Cut::Never).unwrap();
    assert!(firmware_flash(uno.avr()) == expected_firmware_flash());
    assert!(slot_has(uno.avr(), FOLLOW));
    pass(&mut uno, START_MS);
    assert_eq!(behaviour(&mut uno), [false, true, false]);
    assert_eq!(asked(&mut uno), said(true, "follow"));

    flash(&mut uno, only(INVERT), Cut::Never).unwrap();
    assert!(firmware_flash(uno.avr()) == expected_firmware_flash());
    assert!(slot_has(uno.avr(), INVERT));
    pass(&mut uno, START_MS);
    assert_eq!(behaviour(&mut uno), [true, false, true]);
    assert_eq!(asked(&mut uno), said(true, "invert"));
}

#[test]
fn a_board_without_the_firmware_is_left_as_it_is() {
    let mut uno = board();
    let before = uno.avr().flash().to_vec();
    let failure = flash(&mut uno, only(FOLLOW), Cut::Never).unwrap_err();
    assert_eq!((failure.cause, failure.holds), (Cause::OtherFirmware, Holds::Before));
    assert!(uno.avr().flash() == before, "something was written");
}

/// A program of some pages that is on at all inputs.
fn long() -> String {
    format!("//# name long\nLDN SM0.0\nEU\n{}", "LD SM0.0\n= Q0.0\n".repeat(60))
}

#[test]
fn cut_off_after_and_within_every_page_the_firmware_refuses_the_program() {
    let long = long();
    let pages = image(&long).len().div_ceil(flash::PAGE_LEN);
    assert!((3..6).contains(&pages), "{pages} pages");
    let mut uno = with_program(INVERT);
    // The first page is written twice.
    for page in 1..=pages + 1 {
        for cut in [Cut::Within(page), Cut::After(page)] {
            let failure = flash(&mut uno, only(&long), cut).unwrap_err();
            assert_eq!(failure.cause, Cause::Lost("the cable is out".into()), "{cut:?}");
            let is_whole = matches!(cut, Cut::After(last) if last > pages);
            assert_eq!(stays_off(&mut uno), !is_whole, "{cut:?}");
            let expected = if is_whole { said(true, "long") } else { said(false, "") };
            assert_eq!(asked(&mut uno), expected, "{cut:?}");
            let is_told = match failure.holds {
                Holds::BeforeOrNothing => page == 1,
                Holds::NoProgram => !is_whole,
                Holds::NewOrNothing => page > pages,
                Holds::New => is_whole,
                Holds::Before | Holds::NoFirmware => false,
            };
            assert!(is_told, "{cut:?}: {failure}");
        }
    }
    flash(&mut uno, only(FOLLOW), Cut::Never).unwrap();
    pass(&mut uno, START_MS);
    assert_eq!(asked(&mut uno), said(true, "follow"));
}

#[test]
fn cut_off_while_the_firmware_is_written_nothing_starts() {
    let mut uno = with_program(INVERT);
    let all = firmware().len().div_ceil(flash::PAGE_LEN) + 1 + 2;
    // Page 0 twice, some in between, the program's first page, page 0 at last.
    let cuts = [
        Cut::Within(1),
        Cut::After(1),
        Cut::After(2),
        Cut::Within(3),
        Cut::After(all / 2),
        Cut::Within(all - 1),
        Cut::After(all - 1),
        Cut::Within(all),
    ];
    for cut in cuts {
        let failure = flash(&mut uno, with_firmware(FOLLOW), cut).unwrap_err();
        assert!(stays_off(&mut uno), "{cut:?}: {failure}");
        assert!(!slot_has(uno.avr(), FOLLOW) || !matches!(cut, Cut::After(page) if page < all - 1));
        let first = firmware_flash(uno.avr())[..flash::PAGE_LEN].to_vec();
        assert!(first != expected_firmware_flash()[..flash::PAGE_LEN], "{cut:?}");
    }
    flash(&mut uno, with_firmware(FOLLOW), Cut::Never).unwrap();
    pass(&mut uno, START_MS);
    assert_eq!(asked(&mut uno), said(true, "follow"));
}
