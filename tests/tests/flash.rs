//! The way to the board with the real avrdude: to an Uno with its bootloader, and to boards that
//! are none.

#![cfg(feature = "uno")]

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::sync::LazyLock;
use std::thread;
use std::time::Duration;

use awl_asm::firmware;
use plc_isa::{SLOT_LEN, SLOT_START};
use tempfile::TempDir;
use tests::commands;
use tests::flash_responder::{Flaw, Responder};
use tests::plugged::{
    FOLLOW, INVERT, asked, behaviour, behaviour_after, board, expected_firmware_flash,
    firmware_flash, image, is_on, pass, said, slot_has,
};
use virtual_uno::VirtualUno;

/// From the end of avrdude to the first scan: the bootloader's 16 ms watchdog, and the firmware's
/// check of the program.
const START_MS: u32 = 300;
/// The same for a program that fills the slot.
const START_LONGEST_MS: u32 = 2_000;
/// The same for a program that fills the slot.
const SCANS_LONGEST_MS: u32 = 600;

static AWL_ASM: LazyLock<PathBuf> = LazyLock::new(|| commands::built("awl-asm"));
static UNO200: LazyLock<PathBuf> = LazyLock::new(|| commands::built("uno200"));

/// A folder with the two programs.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("follow.awl"), FOLLOW).unwrap();
    fs::write(folder.path().join("invert.awl"), INVERT).unwrap();
    folder
}

fn awl_asm(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::new(&*AWL_ASM);
    command.current_dir(folder).args(arguments).env_remove(firmware::VARIABLE);
    command
}

fn uno200(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::new(&*UNO200);
    command.current_dir(folder).args(arguments).env_remove(firmware::VARIABLE);
    command
}

/// The firmware that is part of the tools.
fn firmware_file() -> PathBuf {
    commands::kept_firmware()
}

/// Runs a command while the board does `step` over and over. Returns exit code and standard error.
fn run(mut command: Command, step: impl FnMut()) -> (Option<i32>, String) {
    let output = commands::run_beside(&mut command, step);
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// For a step that takes no time by itself.
fn wait() {
    thread::sleep(Duration::from_millis(1));
}

fn run_beside(uno: &mut VirtualUno, command: Command) -> (Option<i32>, String) {
    run(command, || uno.step().unwrap())
}

#[test]
fn one_step_for_a_new_board_and_then_for_another_program() {
    let (folder, mut uno) = (folder(), board());
    let port = uno.port().display().to_string();

    let first = awl_asm(&folder, &["follow.awl", "--flash", &port, "--with-firmware"]);
    let (code, errors) = run_beside(&mut uno, first);
    assert_eq!(
        (code, errors.starts_with(&format!("{port}: 2 instructions"))),
        (Some(0), true),
        "{errors}"
    );
    let firmware = firmware_flash(uno.avr());
    assert!(firmware == expected_firmware_flash() && slot_has(uno.avr(), FOLLOW));
    pass(&mut uno, START_MS);
    assert_eq!(behaviour(&mut uno), [false, true, false]);
    assert_eq!(asked(&mut uno), said(true, "follow"));

    let (code, errors) = run_beside(&mut uno, awl_asm(&folder, &["invert.awl", "--flash", &port]));
    assert_eq!(code, Some(0), "{errors}");
    assert!(firmware == firmware_flash(uno.avr()), "the firmware is another one");
    assert!(slot_has(uno.avr(), INVERT));
    pass(&mut uno, START_MS);
    assert_eq!(behaviour(&mut uno), [true, false, true]);
    assert_eq!(asked(&mut uno), said(true, "invert"));

    let written: Vec<String> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| !name.ends_with(".awl"))
        .collect();
    assert!(written.is_empty(), "files beside the programs: {written:?}");
}

#[test]
fn a_board_without_the_firmware_is_left_as_it_is() {
    let (folder, mut uno) = (folder(), board());
    let port = uno.port().display().to_string();
    let before = uno.avr().flash().to_vec();
    for command in [
        awl_asm(&folder, &["follow.awl", "--flash", &port]),
        uno200(&folder, &["flash", "follow.awl", "--port", &port]),
    ] {
        let (code, errors) = run_beside(&mut uno, command);
        assert_eq!(code, Some(2), "{errors}");
        assert!(errors.contains("does not hold the uno200 firmware"), "{errors}");
        assert!(errors.contains("--with-firmware"), "{errors}");
        assert!(uno.avr().flash() == before, "something was written");
    }
}

#[test]
fn the_board_is_asked_whether_the_program_is_in_force() {
    let (folder, mut uno) = (folder(), board());
    let port = uno.port().display().to_string();
    for (arguments, program) in [
        (&["flash", "follow.awl", "--with-firmware", "--port"][..], FOLLOW),
        (&["flash", "invert.awl", "--port"], INVERT),
    ] {
        let command = uno200(&folder, &[arguments, &[&port]].concat());
        let (code, errors) = run_beside(&mut uno, command);
        assert_eq!(code, Some(0), "{errors}");
        assert!(errors.ends_with("the program runs\n"), "{errors}");
        assert!(slot_has(uno.avr(), program), "{errors}");
    }
    let native = uno200(&folder, &["flash", "follow.awl", "--native", "--port", &port]);
    let (code, errors) = run_beside(&mut uno, native);
    assert_eq!((code, errors.ends_with("the program runs\n")), (Some(0), true), "{errors}");
    assert!(!slot_has(uno.avr(), FOLLOW));

    // Firmware that never was: what avrdude has written and verified does not answer.
    fs::write(folder.path().join("none.hex"), ":02000000FFCF30\n:00000001FF\n").unwrap();
    let arguments = ["flash", "follow.awl", "--with-firmware", "none.hex", "--port", &port];
    let (code, errors) = run_beside(&mut uno, uno200(&folder, &arguments));
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains("nothing on the board answers"), "{errors}");
}

/// The commands for avrdude that the documentation names, each once.
fn documented_commands() -> Vec<&'static str> {
    let pages = [include_str!("../../docs/flashing.md"), include_str!("../../README.md")];
    let lines = pages.iter().flat_map(|page| page.lines());
    let mut commands = Vec::new();
    for line in lines
        .filter(|line| line.starts_with("avrdude -c arduino -p m328p -P /dev/ttyACM0 -b 115200"))
    {
        // A remark after the command.
        let command = line.split('#').next().unwrap_or(line).trim();
        if !commands.contains(&command) {
            commands.push(command);
        }
    }
    commands
}

#[test]
fn the_documented_avrdude_commands() {
    let (folder, mut uno) = (folder(), board());
    let commands = documented_commands();
    assert_eq!(commands.len(), 2, "{commands:?}");
    fs::copy(firmware_file(), folder.path().join("uno200.hex")).unwrap();
    assert_eq!(run(awl_asm(&folder, &["follow.awl", "-o", "prog.hex"]), wait).0, Some(0));

    for (command, has_program) in commands.into_iter().zip([false, true]) {
        let command = command.replace("/dev/ttyACM0", &uno.port().display().to_string());
        let mut words = command.split_whitespace();
        let mut avrdude = Command::new(words.next().expect("a command has a name"));
        avrdude.args(words).current_dir(&folder);
        let (code, errors) = run_beside(&mut uno, avrdude);
        assert_eq!((code, errors.contains("of flash verified")), (Some(0), true), "{errors}");
        assert!(firmware_flash(uno.avr()) == expected_firmware_flash());
        pass(&mut uno, START_MS);
        let expected = if has_program { [false, true, false] } else { [false; 3] };
        assert_eq!(behaviour(&mut uno), expected, "after {command}");
        assert_eq!(asked(&mut uno), said(has_program, if has_program { "follow" } else { "" }));
    }
    assert!(slot_has(uno.avr(), FOLLOW));
}

#[test]
fn a_program_with_errors_never_resets_the_board() {
    let (folder, mut uno) = (folder(), board());
    uno.load(&firmware_file()).unwrap();
    uno.avr_mut().write_flash(SLOT_START.into(), &image(INVERT)).unwrap();
    pass(&mut uno, START_MS);
    assert_eq!(behaviour(&mut uno), [true, false, true]);
    let before = uno.avr().flash().to_vec();
    fs::write(folder.path().join("bad.awl"), "LD I0.9\n= Q0.0\n").unwrap();
    let bad = awl_asm(
        &folder,
        &["bad.awl", "--flash", &uno.port().display().to_string(), "--with-firmware"],
    );
    let mut was_always_on = true;
    let (code, errors) = run(bad, || {
        uno.step().unwrap();
        was_always_on &= is_on(uno.avr());
    });
    assert_eq!((code, errors.contains("error[E0005]")), (Some(1), true), "{errors}");
    assert!(was_always_on, "the program was interrupted");
    assert!(uno.avr().flash() == before);
}

#[test]
fn the_longest_program_fills_the_slot_and_nothing_more() {
    let (folder, mut uno) = (folder(), board());
    uno.load(&firmware_file()).unwrap();
    let bootloader = uno.avr().flash()[usize::from(SLOT_START) + usize::from(SLOT_LEN)..].to_vec();
    let mut longest = String::from("//# name longest\nLD I0.0\n= Q0.0\n");
    while image(&longest).len() < usize::from(SLOT_LEN) - 200 {
        longest.push_str(&"LD I0.1\nA M0.0\n= M0.1\n".repeat(20));
    }
    fs::write(folder.path().join("longest.awl"), &longest).unwrap();
    let command = awl_asm(&folder, &["longest.awl", "--flash", &uno.port().display().to_string()]);
    let (code, errors) = run_beside(&mut uno, command);
    assert_eq!(code, Some(0), "{errors}");
    assert!(slot_has(uno.avr(), &longest) && uno.avr().flash().ends_with(&bootloader));
    assert!(firmware_flash(uno.avr()) == expected_firmware_flash());
    pass(&mut uno, START_LONGEST_MS);
    assert_eq!(behaviour_after(&mut uno, SCANS_LONGEST_MS), [false, true, false]);
}

/// Exit code and messages of `--flash` to a board with a flaw.
fn flash_to(flaw: Flaw) -> (Option<i32>, String) {
    let (folder, mut board) = (folder(), Responder::new(flaw).unwrap());
    let command = awl_asm(&folder, &["follow.awl", "--flash", &board.port().display().to_string()]);
    run(command, || {
        board.step().unwrap();
        wait();
    })
}

#[test]
fn boards_that_are_none_get_their_explanation() {
    for (flaw, words, help) in [
        (Flaw::NoBootloader, "no bootloader answers at", "press the reset button"),
        (Flaw::OtherChip, "has another chip than an Uno: ATmega168", "ATmega328P at 16 MHz"),
        (
            Flaw::WrongBytes,
            "holds something else than was written, first at 0x6000",
            "another cable",
        ),
    ] {
        let (code, errors) = flash_to(flaw);
        let is_explained =
            errors.starts_with("error: ") && errors.contains(words) && errors.contains(help);
        assert_eq!((code, is_explained), (Some(2), true), "{flaw:?}: {errors}");
        assert!(errors.contains("avrdude's last lines:\n  "), "{flaw:?}: {errors}");
    }
}

#[test]
fn a_port_that_is_none_gets_its_explanation() {
    let folder = folder();
    let (code, errors) =
        run(awl_asm(&folder, &["follow.awl", "--flash", "/dev/no-such-port"]), wait);
    assert_eq!(
        (code, errors.starts_with("error: there is no port /dev/no-such-port")),
        (Some(2), true),
        "{errors}"
    );
    let (code, errors) = run(awl_asm(&folder, &["follow.awl", "--flash", "follow.awl"]), wait);
    assert_eq!(
        (code, errors.starts_with("error: follow.awl is no serial port")),
        (Some(2), true),
        "{errors}"
    );
}
