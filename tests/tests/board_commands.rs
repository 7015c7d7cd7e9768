//! The commands that people use, beside a virtual Uno in real time: a program is assembled, run,
//! read from the port, disassembled and assembled again; a trace is recorded. What else the
//! disassembler must do, random programs say.
#![cfg(feature = "uno")]

use std::fs::File;
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use simavr::Reset;
use tests::case::folder;
use tests::commands;
use virtual_uno::VirtualUno;

/// The bootloader waits a second after a reset, and flashes its lamp before that.
const BOOTLOADER_MS: u32 = 1_800;
/// From power to the first answer: the program is checked, and the analog inputs are waited for.
const START_MS: u32 = 200;

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

/// A board that has its firmware and no program, and the commands.
struct Bench {
    uno: VirtualUno,
    port: PathBuf,
    awl_asm: PathBuf,
    uno200: PathBuf,
    /// Who opens the port resets the board, so someone has it open all the time.
    _holder: File,
}

impl Bench {
    fn new() -> Bench {
        let mut uno = VirtualUno::new().unwrap();
        uno.load(&commands::kept_firmware()).unwrap();
        let port = uno.port().to_path_buf();
        let holder = OpenOptions::new().read(true).write(true).open(&port).unwrap();
        let [awl_asm, uno200] = ["awl-asm", "uno200"].map(commands::built);
        let mut bench = Bench { uno, port, awl_asm, uno200, _holder: holder };
        bench.pass(BOOTLOADER_MS);
        bench
    }

    fn pass(&mut self, milliseconds: u32) {
        (0..milliseconds).for_each(|_| self.uno.step().unwrap());
    }

    fn assemble(&self, arguments: &[&str], program: &Path, to: &Path) {
        good(
            &Command::new(&self.awl_asm)
                .arg(program)
                .args(arguments)
                .arg("-o")
                .arg(to)
                .output()
                .unwrap(),
        );
    }

    fn disassemble(&self, image: &Path) -> Output {
        Command::new(&self.awl_asm).arg("--disassemble").arg(image).output().unwrap()
    }

    /// Has the board run what is in a HEX file.
    fn start(&mut self, hex: &Path) {
        self.uno.load(hex).unwrap();
        self.pass(START_MS);
    }

    /// `uno200` with these arguments, while the board runs.
    fn uno200(&mut self, arguments: &[&str]) -> Output {
        let Bench { uno, port, uno200, .. } = self;
        commands::run_beside(Command::new(uno200).arg("--port").arg(port).args(arguments), || {
            uno.step().unwrap()
        })
    }
}

#[test]
fn what_is_read_from_the_board_is_what_was_assembled() {
    let mut bench = Bench::new();
    let place = tempfile::tempdir().unwrap();
    let [image, hex, read, text, again] =
        ["p.bin", "p.hex", "read.bin", "read.awl", "again.bin"].map(|name| place.path().join(name));
    refused(&bench.uno200(&["read-program"]), "the PLC holds no program");

    // Symbols, timers, counters, modules, interrupt routines, pulses. Those that take over the line
    // cannot be read while they run.
    for (name, options) in [
        ("station1", &[][..]),
        ("traffic_light", &[]),
        ("pid", &[]),
        ("cut_to_length", &[]),
        ("station1", &["--native"]),
        ("traffic_light", &["--native"]),
    ] {
        let program = folder("../examples").join(name).with_extension("awl");
        bench.assemble(options, &program, &image);
        bench.assemble(options, &program, &hex);
        bench.start(&hex);
        good(&bench.uno200(&["read-program", "-o", read.to_str().unwrap()]));
        let image = fs::read(&image).unwrap();
        assert!(fs::read(&read).unwrap() == image, "{name} {options:?}: another image");
        let disassembled = bench.disassemble(&read);
        let shown = bench.uno200(&["read-program"]);
        if !options.is_empty() {
            refused(&disassembled, "translated to machine code");
            refused(&shown, "machine code, which has no text");
            continue;
        }
        fs::write(&text, good(&disassembled)).unwrap();
        assert_eq!(good(&shown), good(&disassembled), "{name}");
        bench.assemble(&[], &text, &again);
        assert!(
            fs::read(&again).unwrap() == image,
            "{name}: another image\n{}",
            good(&disassembled)
        );
        println!("{name}: {} bytes, {} lines", image.len(), good(&disassembled).lines().count());
    }
}

/// VB0 to VB3 are kept.
const KEEPING: &str = "//# name keeping\n//# retain VB0-VB3\nLD SM0.0\nMOVB VB0, VB8\n\
    MOVB VB3, VB9\n";

#[test]
fn what_is_restored_in_stop_outlives_the_power() {
    let mut bench = Bench::new();
    let place = tempfile::tempdir().unwrap();
    let [program, hex, values] = ["p.awl", "p.hex", "r.txt"].map(|name| place.path().join(name));
    fs::write(&program, KEEPING).unwrap();
    fs::write(&values, "VB0 11, 22, 33, 44\n").unwrap();
    bench.assemble(&[], &program, &hex);
    bench.start(&hex);
    good(&bench.uno200(&["stop"]));
    let told = bench.uno200(&["retained", "restore", values.to_str().unwrap()]);
    good(&told);
    assert!(String::from_utf8_lossy(&told.stderr).contains("they are kept without power"));
    bench.uno.avr_mut().reset(Reset::PowerOn);
    bench.pass(BOOTLOADER_MS + START_MS);
    let shown = good(&bench.uno200(&["watch", "VB8", "VB9", "--for", "1ms", "--format", "csv"]));
    assert!(shown.lines().nth(1).is_some_and(|row| row.ends_with(",11,44")), "{shown}");
}

/// MW2 counts scans; M3.7 is its bit of 128.
const COUNTING: &str = "//# name counting\nLD SM0.0\nINCW MW2\n";

/// Scan, MW2 and M3.7 of each sample, and which of them the trigger was in.
fn traced(bench: &mut Bench, csv: &Path) -> (Vec<[i64; 3]>, usize) {
    let arguments =
        ["trace", "MW2", "M3.7", "--every", "3", "--before", "5", "--trigger", "M3.7 rising", "-o"];
    let told = bench.uno200(&[&arguments[..], &[csv.to_str().unwrap()]].concat());
    let said = String::from_utf8_lossy(&told.stderr).into_owned();
    println!("{said}");
    good(&told);
    let text = fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time_ms,scan,MW2,M3.7"));
    let rows: Vec<[i64; 3]> = lines
        .map(|line| {
            line.split(',')
                .skip(1)
                .map(|field| field.parse().unwrap())
                .collect::<Vec<_>>()
                .try_into()
                .unwrap()
        })
        .collect();
    let scan =
        said.split("trigger in scan ").nth(1).and_then(|said| said.split(';').next()?.parse().ok());
    let trigger = rows.iter().position(|row| Some(row[0]) == scan);
    (rows, trigger.unwrap_or_else(|| panic!("{said}")))
}

#[test]
fn a_trace_is_recorded_on_the_board() {
    let mut bench = Bench::new();
    let place = tempfile::tempdir().unwrap();
    let [program, hex, csv] = ["p.awl", "p.hex", "trace.csv"].map(|name| place.path().join(name));
    fs::write(&program, COUNTING).unwrap();
    bench.assemble(&[], &program, &hex);
    bench.start(&hex);
    for _ in 0..10 {
        let (rows, trigger) = traced(&mut bench, &csv);
        // What the frame and the program leave of the arena.
        assert!(rows.len() > 150, "{} samples", rows.len());
        let bit = |value: i64| value >> 7 & 1;
        for (index, &[scan, count, on]) in rows.iter().enumerate() {
            assert_eq!((scan as u16).wrapping_sub(rows[0][0] as u16), 3 * index as u16);
            assert_eq!(
                (count as u16).wrapping_sub(rows[0][1] as u16),
                3 * index as u16,
                "in every third scan"
            );
            assert_eq!(on, bit(count));
        }
        assert!((1..=5).contains(&trigger), "{trigger} samples are from before the trigger");
        assert_eq!((rows[trigger - 1][2], rows[trigger][2]), (0, 1), "it was the rising bit");
        // There are fewer of them when the bit rises soon after the start.
        if trigger == 5 {
            return;
        }
    }
    panic!("the bit always rises soon after the start");
}

/// T32 counts milliseconds.
const TIMED: &str = "//# name timed\n//# scan 10ms\nNETWORK 1\nLD SM0.0\nTON T32, 100\nLD T32\n\
    = Q0.0\nNETWORK 2\nLD I0.1\n= Q0.1\nLD SM0.0\nINCW MW2\nMOVW AIW2, VW4\n";

/// How often a scenario may be begun anew because other programs on this computer have kept the
/// tool from its line: the board goes on meanwhile.
const TRIES: u32 = 5;

/// What of scenarios comes out on the board: the files of a folder beside the program.
fn tested(bench: &mut Bench, folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let folder = folder.to_str().unwrap();
    let mut last = (None, String::new());
    for _ in 0..TRIES {
        let output = bench.uno200(&[&["test", folder], arguments].concat());
        println!("{}", String::from_utf8_lossy(&output.stderr));
        last = (output.status.code(), String::from_utf8(output.stdout).unwrap());
        println!("{}", last.1);
        if !last.1.contains("scans were missed") {
            break;
        }
    }
    last
}

#[test]
fn scenarios_run_on_the_board() {
    let mut bench = Bench::new();
    let place = tempfile::tempdir().unwrap();
    let [program, hex] = ["p.awl", "p.hex"].map(|name| place.path().join(name));
    let write = |name: &str, text: &str| fs::write(place.path().join(name), text).unwrap();
    fs::write(&program, TIMED).unwrap();
    // What the board does by itself is judged to the scan, what is forced with a tolerance.
    write("p.a.scn", "at 100ms expect Q0.0 = 0, MW2 = 10\nat 101ms expect Q0.0 = 1\nrun 200ms\n");
    write("p.early.scn", "at 100ms expect Q0.0 = 1\nat 110ms expect Q0.0 = 1\n");
    write(
        "p.inputs.scn",
        "at 0ms I0.1 = 1, AIW2 = 1600\nat 50ms expect Q0.1 = 1, VW4 = 1600\n\
         at 200ms I0.1 = 0\nat 300ms expect Q0.1 = 0\nalways Q0.1 = 0 from 350ms to 500ms\n",
    );
    bench.assemble(&[], &program, &hex);
    bench.start(&hex);
    for _ in 0..2 {
        let (code, text) = tested(&mut bench, place.path(), &["--tolerance", "120ms"]);
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains("p.early.scn:1: at 100ms expected Q0.0 = 1, got 0"), "{text}");
        assert_eq!(text.matches("every scan seen").count(), 3, "{text}");
        assert!(text.ends_with("3 scenarios: 2 ok, 1 failed\n"), "{text}");
        let status = good(&bench.uno200(&["status"]));
        assert!(status.contains("mode        STOP"), "{status}");
        assert!(status.contains("forced      nothing"), "{status}");
    }
    // Without a period, by the clock of this computer: the board of this test may be slower.
    fs::write(&program, TIMED.replace("//# scan 10ms\n", "")).unwrap();
    write("p.a.scn", "at 5s expect Q0.0 = 1\nat 0ms I0.1 = 1\nat 1s within 4s expect Q0.1 = 1\n");
    for name in ["p.early.scn", "p.inputs.scn"] {
        fs::remove_file(place.path().join(name)).unwrap();
    }
    let (code, text) = tested(&mut bench, place.path(), &[]);
    assert!(code == Some(2) && text.contains("--flash writes"), "{text}");
    bench.assemble(&[], &program, &hex);
    bench.start(&hex);
    let (code, text) = tested(&mut bench, place.path(), &["--leave"]);
    assert!(code == Some(0) && text.contains("at times of this computer"), "{text}");
    let forced = good(&bench.uno200(&["force"]));
    assert!(forced.contains("IB0 = 2") && forced.contains("AIW2 = 0"), "{forced}");
}

#[test]
fn a_single_scan_is_shown_on_the_board() {
    let mut bench = Bench::new();
    let place = tempfile::tempdir().unwrap();
    let [program, hex, view] = ["p.awl", "p.hex", "view.svg"].map(|name| place.path().join(name));
    fs::write(&program, "LD I0.0\n= Q0.0\nLD SM0.0\nINCW MW2\n").unwrap();
    bench.assemble(&[], &program, &hex);
    bench.start(&hex);
    good(&bench.uno200(&["force", "I0.0=1"]));
    assert!(good(&bench.uno200(&["stop"])).contains("not forced any more: I0.0 = 1"));
    good(&bench.uno200(&["force", "I0.0=1"]));
    good(&bench.uno200(&["set", "MW2=41"]));
    let show = ["show", program.to_str().unwrap(), "--picture", view.to_str().unwrap()];
    good(&bench.uno200(&show));
    assert!(!fs::read_to_string(&view).unwrap().contains('\u{25cf}'), "nothing is known");
    good(&bench.uno200(&[&show[..], &["--scan"]].concat()));
    let picture = fs::read_to_string(&view).unwrap();
    assert_eq!(picture.matches('\u{25cf}').count(), 4, "power flow in every line: {picture}");
    let values = ["watch", "MW2", "SM4.7", "--for", "1ms", "--format", "csv"];
    let values = good(&bench.uno200(&values));
    assert!(values.lines().nth(1).is_some_and(|row| row.ends_with(",42,1")), "{values}");
}
