//! The way of a program and back, with the commands that people use: assembled, run by a virtual Uno in real time, read
//! from its port, disassembled, and assembled again. What else the disassembler must do, random programs say.
#![cfg(feature = "uno")]

use std::fs::{self, OpenOptions};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use awl_asm::firmware;
use tests::case::folder;
use tests::commands;
use virtual_uno::VirtualUno;

/// The bootloader waits a second after a reset, and flashes its lamp before that.
const BOOTLOADER_MS: u32 = 1_800;
/// From power to the first answer: the program is checked, and the analog inputs are waited for.
const START_MS: u32 = 200;

/// Runs a command while the board runs.
fn run(uno: &mut VirtualUno, command: &mut Command) -> Output {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
    while child.try_wait().unwrap().is_none() {
        uno.step().unwrap();
    }
    child.wait_with_output().unwrap()
}

/// What a command writes, which must be good.
#[track_caller]
fn good(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[track_caller]
fn refused(output: &Output, because: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && errors.contains(because), "{errors}");
}

fn pass(uno: &mut VirtualUno, milliseconds: u32) {
    (0..milliseconds).for_each(|_| uno.step().unwrap());
}

#[test]
fn what_is_read_from_the_board_is_what_was_assembled() {
    let awl_asm = commands::built("awl-asm");
    let uno200 = commands::built("uno200");
    let place = tempfile::tempdir().unwrap();
    let [image, hex, read, text, again] =
        ["p.bin", "p.hex", "read.bin", "read.awl", "again.bin"].map(|name| place.path().join(name));
    let assemble = |arguments: &[&str], program: &Path, to: &Path| {
        good(&Command::new(&awl_asm).arg(program).args(arguments).arg("-o").arg(to).output().unwrap());
    };

    let mut uno = VirtualUno::new().unwrap();
    uno.load(&firmware::find("hex").expect("`cargo xtask test` builds the firmware first")).unwrap();
    // Who opens the port resets the board, so someone has it open all the time.
    let port = uno.port().to_path_buf();
    let _holder = OpenOptions::new().read(true).write(true).open(&port).unwrap();
    pass(&mut uno, BOOTLOADER_MS);
    let told = |arguments: &[&str], uno: &mut VirtualUno| {
        run(uno, Command::new(&uno200).arg("--port").arg(&port).args(arguments))
    };
    refused(&told(&["read-program"], &mut uno), "the PLC holds no program");

    // Symbols, timers, counters, modules, interrupt routines, pulses. Those that take over the line cannot be read while
    // they run.
    for (name, options) in [
        ("station1", &[][..]),
        ("traffic_light", &[]),
        ("pid", &[]),
        ("cut_to_length", &[]),
        ("station1", &["--native"]),
        ("traffic_light", &["--native"]),
    ] {
        let program = folder("../examples").join(name).with_extension("awl");
        assemble(options, &program, &image);
        assemble(options, &program, &hex);
        uno.load(&hex).unwrap();
        pass(&mut uno, START_MS);
        good(&told(&["read-program", "-o", read.to_str().unwrap()], &mut uno));
        let image = fs::read(&image).unwrap();
        assert!(fs::read(&read).unwrap() == image, "{name} {options:?}: another image");
        let disassembled = Command::new(&awl_asm).arg("--disassemble").arg(&read).output().unwrap();
        let shown = told(&["read-program"], &mut uno);
        if !options.is_empty() {
            refused(&disassembled, "translated to machine code");
            refused(&shown, "machine code, which has no text");
            continue;
        }
        fs::write(&text, good(&disassembled)).unwrap();
        assert_eq!(good(&shown), good(&disassembled), "{name}");
        assemble(&[], &text, &again);
        assert!(fs::read(&again).unwrap() == image, "{name}: another image\n{}", good(&disassembled));
        println!("{name}: {} bytes, {} lines", image.len(), good(&disassembled).lines().count());
    }
}
