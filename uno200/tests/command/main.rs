//! The command `uno200` from outside, against a PLC that runs in this process: the simulator's, on
//! TCP and after a serial port.

mod bridge;
mod layout;
mod plc;
mod scenarios;
#[cfg(unix)]
mod serial;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use plc::Plc;
use uno200::program::Files;

/// Counts scans in MW4, copies I0.0 to Q0.0, and loops for ever when I0.7 is on.
const PROGRAM: &str = "\
//# name \"demo\"
//# symbol Start I0.0 start button
//# symbol Lamp Q0.0 the lamp
//# retain VB0-VB3, C1
NETWORK 1
LD Start
= Lamp
NETWORK 2
LD SM0.0
INCW MW4
MOVR 1.5, VD8
MOVB VB0, VB20
NETWORK 3
LD I0.1
LD I0.2
CTU C1, 100
NETWORK 4
LBL 1
LD I0.7
JMP 1
";

/// Runs the command with a PLC on TCP. `{}` in an argument is the folder for files.
fn uno200(plc: &Plc, folder: &Path, arguments: &[&str]) -> Output {
    let mut all = vec!["--tcp".to_string(), plc.address.to_string()];
    all.extend(
        arguments.iter().map(|argument| argument.replace("{}", &folder.display().to_string())),
    );
    Command::new(env!("CARGO_BIN_EXE_uno200")).args(all).output().unwrap()
}

/// Exit code, standard output, standard error.
fn told(output: &Output) -> (Option<i32>, String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// A PLC with a folder in which p.awl is its program.
struct Test {
    plc: Plc,
    folder: tempfile::TempDir,
}

impl Test {
    fn new() -> Test {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("p.awl"), PROGRAM).unwrap();
        Test { plc: Plc::start(&folder.path().join("p.awl")), folder }
    }

    fn told(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        told(&uno200(&self.plc, self.folder.path(), arguments))
    }

    /// The output of a command that must be good.
    fn good(&self, arguments: &[&str]) -> String {
        let (code, output, errors) = self.told(arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {output}{errors}");
        output
    }

    /// The only values of a row.
    fn values(&self, operands: &[&str]) -> Vec<String> {
        let output = self.good(&[&["watch", "--for", "1ms", "--format", "csv"], operands].concat());
        output.lines().nth(1).unwrap().split(',').skip(2).map(str::to_string).collect()
    }
}

#[test]
fn status_says_what_there_is() {
    let test = Test::new();
    let output = test.good(&["status"]);
    for part in [
        "plc         simulator with uno200 ",
        "mode        RUN",
        "demo, bytecode, ",
        "since RUN; shortest ",
    ] {
        assert!(output.contains(part), "{part}: {output}");
    }
    for part in ["forced      nothing\n", "fault       none\n", " bytes for a request"] {
        assert!(output.contains(part), "{part}: {output}");
    }
}

#[test]
fn values_are_set_and_watched() {
    let test = Test::new();
    assert_eq!(
        test.good(&["set", "MW20=-5", "VB0=16#FF", "Q0.3=1", "MD24=2.5", "C1.cv=7"]),
        "MW20 = -5\nVB0 = 255\nQ0.3 = 1\nMD24 = 1075838976\nC1.cv = 7\n"
    );
    test.good(&["--program", "{}/p.awl", "set", "VD8=2"]);
    let program = ["--program", "{}/p.awl"];
    let watched = test.values(&[&program[..], &["VD8", "VD8:dint", "MW20:hex"]].concat());
    assert_eq!(watched, ["1.5", "1069547520", "16#FFFB"], "the program writes it again");
    let values = test.values(&["MW20", "VB0", "Q0.3", "MD24:real", "C1.cv", "C1"]);
    assert_eq!(values, ["-5", "255", "1", "2.5", "7", "0"]);
    assert_eq!(test.values(&["--hex", "MW20", "VB0", "Q0.3"]), ["16#FFFB", "16#FF", "1"]);
    let table = test.good(&["watch", "MW20,Q0.3", "--for", "300ms", "--every", "50ms"]);
    assert_eq!(table.lines().count(), 2, "what does not change has one row: {table}");
    let rows = test.good(&["watch", "MW4", "--for", "300ms", "--every", "50ms", "--format", "csv"]);
    let scans: Vec<i64> =
        rows.lines().skip(1).map(|row| row.split(',').nth(1).unwrap().parse().unwrap()).collect();
    assert!(scans.len() >= 3 && scans.windows(2).all(|pair| pair[0] < pair[1]), "{rows}");
}

#[test]
fn forcing_holds_and_is_listed() {
    let test = Test::new();
    assert_eq!(test.good(&["force"]), "nothing is forced\n");
    assert_eq!(
        test.good(&["--program", "{}/p.awl", "force", "start=1", "VB0=3"]),
        "I0.0 (Start) = 1\nVB0 = 3\n"
    );
    assert_eq!(test.values(&["Q0.0", "VB20", "SM4.7"]), ["1", "3", "1"]);
    assert!(test.good(&["status"]).contains("forced      2 operands"));
    assert_eq!(test.good(&["unforce", "I0.0"]), "VB0 = 3\n");
    assert_eq!(test.good(&["unforce", "--all"]), "nothing is forced\n");
    assert_eq!(test.values(&["Q0.0", "SM4.7"]), ["0", "0"]);
    let (code, _, errors) = test.told(&["unforce", "I0.0"]);
    assert!(code == Some(2) && errors.contains("I0.0 is not forced"), "{errors}");
    let many: Vec<String> = (0..17).map(|bit| format!("Q{}.{}=1", bit / 8, bit % 8)).collect();
    let many: Vec<&str> = std::iter::once("force").chain(many.iter().map(String::as_str)).collect();
    let (code, _, errors) = test.told(&many);
    assert!(code == Some(1) && errors.contains("Q2.0: 16 operands are forced already"), "{errors}");
}

#[test]
fn what_ends_with_stop_is_told() {
    let test = Test::new();
    test.good(&["--program", "{}/p.awl", "force", "Start=1", "VB0=3"]);
    assert_eq!(test.good(&["stop"]), "STOP\nnot forced any more: I0.0 = 1, VB0 = 3\n");
    assert_eq!(test.good(&["stop"]), "STOP\n");
    test.good(&["force", "I0.0=1"]);
    for _ in 0..3 {
        let told = test.good(&["scan", "2"]);
        assert_eq!(told.lines().count(), 1, "it holds: {told}");
        assert_eq!(test.values(&["SM4.7"]), ["1"]);
    }
    assert_eq!(test.good(&["force"]), "I0.0 = 1\n");
    // The program stops itself: a fault.
    test.good(&["force", "I0.7=1"]);
    let (code, told, _) = test.told(&["scan", "5"]);
    assert_eq!(code, Some(1));
    assert!(told.ends_with("not forced any more: I0.0 = 1, I0.7 = 1\n"), "{told}");
}

#[test]
fn a_single_scan_is_shown() {
    let test = Test::new();
    test.good(&["stop"]);
    test.good(&["force", "I0.0=1"]);
    let scans = || {
        let status = test.good(&["status"]);
        let row = status.lines().find(|line| line.starts_with("scans")).unwrap().to_owned();
        row.split_whitespace().nth(1).unwrap().parse::<u32>().unwrap()
    };
    let before = scans();
    let show = ["show", "{}/p.awl", "--picture", "{}/view.svg"];
    test.good(&show);
    let picture = || fs::read_to_string(test.folder.path().join("view.svg")).unwrap();
    assert!(picture().contains("not\u{a0}known"), "{}", picture());
    assert!(!picture().contains('\u{25cf}') && !picture().contains('\u{b7}'));
    assert_eq!(scans(), before);
    test.good(&[&show[..], &["--scan"]].concat());
    assert_eq!(scans(), before + 1);
    assert!(picture().contains('\u{25cf}') && picture().contains("what\u{a0}it\u{a0}did"));
}

#[test]
fn the_mode_is_commanded() {
    let test = Test::new();
    let (code, _, errors) = test.told(&["scan", "2"]);
    assert!(code == Some(2) && errors.contains("`uno200 stop` first"), "{errors}");
    assert_eq!(test.good(&["run"]), "RUN\n");
    assert_eq!(test.good(&["stop"]), "STOP\n");
    let before: i64 = test.values(&["MW4"])[0].parse().unwrap();
    assert!(test.good(&["scan", "3"]).starts_with("3 scans, the last "));
    assert!(test.good(&["scan"]).starts_with("1 scan, the last "));
    assert_eq!(test.values(&["MW4"]), [((before + 4) as i16).to_string()]);
    assert_eq!(test.good(&["run"]), "RUN\n");
    assert!(test.good(&["status"]).contains("mode        RUN"));
}

#[test]
fn a_fault_is_told_with_its_line() {
    let test = Test::new();
    test.good(&["force", "I0.7=1"]);
    std::thread::sleep(std::time::Duration::from_millis(100));
    let (code, output, _) = test.told(&["--program", "{}/p.awl", "status"]);
    assert_eq!(code, Some(1), "{output}");
    assert!(
        output.contains("fault       watchdog: the scan took too long; the program was at "),
        "{output}"
    );
    assert!(
        ["p.awl:18", "p.awl:19", "p.awl:20"].iter().any(|line| output.contains(line)),
        "{output}"
    );
    let (_, output, _) = test.told(&["status"]);
    assert!(output.contains("of the image"), "{output}");
    fs::write(test.folder.path().join("q.awl"), "LD I0.0\n= Q0.1\n").unwrap();
    let (_, output, errors) = test.told(&["--program", "{}/q.awl", "status"]);
    assert!(
        output.contains("of the image") && errors.contains("another program"),
        "{output}{errors}"
    );
    assert_eq!(test.good(&["clear"]), "STOP\n");
    assert_eq!(test.good(&["run"]), "RUN\n");
}

#[test]
fn the_program_comes_back_and_is_compared() {
    let test = Test::new();
    test.good(&["read-program", "-o", "{}/r.bin"]);
    let image = Files::default().open(&[test.folder.path().join("p.awl")]).unwrap().image;
    assert_eq!(fs::read(test.folder.path().join("r.bin")).unwrap(), image);
    let text = test.good(&["read-program"]);
    assert!(text.contains("//# name \"demo\"") && text.contains("INCW   MW4"), "{text}");
    assert!(test.good(&["compare", "{}/p.awl"]).starts_with("the same program, "));
    assert!(test.good(&["compare", "{}/r.bin"]).starts_with("the same program, "));
    fs::write(test.folder.path().join("q.awl"), PROGRAM.replace("LD I0.1", "LD I0.3")).unwrap();
    let (code, output, _) = test.told(&["compare", "{}/q.awl"]);
    assert_eq!(code, Some(1));
    let expected = "network 3 differs:\n  file, line 14: LD     I0.3\n  PLC: LD     I0.1\n";
    assert!(output.ends_with(expected), "{output}");
}

#[test]
fn traces_are_recorded_around_their_trigger() {
    let test = Test::new();
    let (code, csv, errors) = test.told(&["trace", "I0.0", "MW4", "--every", "2"]);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        csv.starts_with("time_ms,scan,I0.0,MW4\n") && errors.contains(" samples; a scan takes "),
        "{errors}"
    );
    let rows: Vec<Vec<f64>> = csv
        .lines()
        .skip(1)
        .map(|row| row.split(',').map(|n| n.parse().unwrap()).collect())
        .collect();
    assert!(rows.len() > 20);
    assert!(
        rows.windows(2)
            .all(|pair| pair[1][1] - pair[0][1] == 2.0 && pair[1][3] - pair[0][3] == 2.0),
        "{csv}"
    );
    let forcing = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(std::time::Duration::from_millis(500));
            test.good(&["force", "I0.0=1"]);
        });
        test.told(&[
            "trace",
            "I0.0",
            "Q0.0",
            "--trigger",
            "I0.0 rising",
            "--before",
            "10",
            "-o",
            "{}/x.vcd",
        ])
    });
    assert!(forcing.0 == Some(0) && forcing.2.contains("trigger in scan "), "{}", forcing.2);
    let vcd = fs::read_to_string(test.folder.path().join("x.vcd")).unwrap();
    assert!(vcd.contains("\n1!\n1\"\n1#\n"), "input, output and trigger at once: {vcd}");
    test.good(&["trace", "I0.0", "MW4", "-o", "{}/x.svg"]);
    assert!(fs::read_to_string(test.folder.path().join("x.svg")).unwrap().starts_with("<svg"));
    let (code, _, errors) = test.told(&["trace", "MW4", "--trigger", "MW4 rising"]);
    assert!(code == Some(2) && errors.contains("MW4 is no bit"), "{errors}");
    let (code, _, errors) = test.told(&["trace", "MW4", "--trigger", "I0.5 on", "--for", "200ms"]);
    assert!(code == Some(1) && errors.contains("the trigger did not come"), "{code:?} {errors}");
    let (code, _, errors) = test.told(&["trace", "MW4", "--every", "1", "--for", "20s"]);
    assert!(code == Some(0) && errors.contains("the memory is full before 20s"), "{errors}");
    let (code, csv, errors) = test.told(&["trace", "MW4", "--for", "1.5s"]);
    assert!(code == Some(0) && errors.contains("so that 1.5s fit"), "{errors}");
    assert!(csv.lines().count() > 100, "{csv}");
    let (code, _, errors) = test.told(&["trace", "MW4", "--every", "100", "--for", "400ms"]);
    assert!(
        code == Some(0) && errors.contains("ended before the memory was full"),
        "{code:?} {errors}"
    );
}

#[test]
fn retentive_memory_is_a_file() {
    let test = Test::new();
    test.good(&["stop"]);
    test.good(&["set", "VB0=1", "VB1=2", "VB3=255", "C1.cv=17"]);
    test.good(&["retained", "save", "{}/r.txt"]);
    let text = fs::read_to_string(test.folder.path().join("r.txt")).unwrap();
    assert!(text.starts_with("// ") && text.ends_with("\nVB0 1, 2, 0, 255\nC1.cv 17\n"), "{text}");
    test.good(&["set", "VB0=9", "VB3=9", "C1.cv=9"]);
    assert_eq!(test.good(&["retained", "restore", "{}/r.txt"]), "5 values written\n");
    assert_eq!(test.values(&["VB0", "VB1", "VB3", "C1.cv"]), ["1", "2", "255", "17"]);
    test.good(&["run"]);
    let (code, _, errors) = test.told(&["retained", "restore", "{}/r.txt"]);
    assert!(code == Some(0) && errors.contains("within 61 s"), "{errors}");
    fs::write(test.folder.path().join("notes.txt"), "mine").unwrap();
    let (code, _, errors) = test.told(&["retained", "save", "{}/notes.txt"]);
    assert!(code == Some(2) && errors.contains("--overwrite"), "{errors}");
    test.good(&["retained", "save", "{}/notes.txt", "--overwrite"]);
    test.good(&["retained", "save", "{}/notes.txt"]);
    fs::write(test.folder.path().join("bad.txt"), "VB0 1\nVB1 x\n").unwrap();
    let (code, _, errors) = test.told(&["retained", "restore", "{}/bad.txt"]);
    assert!(code == Some(2) && errors.contains("bad.txt:2: VB1: x is no value"), "{errors}");
}

#[test]
fn what_is_wrong_is_said_with_what_was_meant() {
    let test = Test::new();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["watch", "IO.0"], 2, "IO.0 is no address"),
        (&["watch", "IO.0"], 2, "did you mean I0.0?"),
        (&["--program", "{}/p.awl", "watch", "Lmap", "I0.9"], 2, "did you mean Lamp?"),
        (
            &["--program", "{}/p.awl", "watch", "Lmap", "I0.9"],
            2,
            "error: I0.9: a byte has bits 0 to 7",
        ),
        (&["watch", "VW900"], 2, "the program in the PLC does not use VW900"),
        (&["set", "MW4"], 2, "write OPERAND=VALUE"),
        (&["set", "MW4=70000"], 2, "-32768 to 32767"),
        (&["set", "I0.0=1"], 1, "nothing was written"),
        (&["set", "MW20=1", "VD900=1"], 2, "the program in the PLC does not use VD900"),
        (&["retained", "restore", "{}/none.txt"], 2, "cannot read"),
        (&["read-program", "-o", "{}/p.awl"], 2, "p.awl is there already; --overwrite replaces it"),
        (&["read-program", "-o", "{}/new.txt"], 2, "is one of .awl, .bin"),
        (&["trace", "MW4", "-o", "{}/p.awl"], 2, "is one of .csv, .vcd, .svg"),
        (&["read-program", "-o", "{}/new.awl"], 0, "new.awl: "),
        (&["force", "MW4=1"], 0, ""),
        (&["force", "T37=1"], 1, "T37 cannot be forced"),
        (&["compare", "{}/none.awl"], 2, "cannot read"),
        (&["scan", "0"], 2, "0 is not in"),
        (&["watch", "I0.0", "--for", "5"], 2, "500ms, 2s or 1.5s"),
        (&["--baud", "9601", "status"], 2, "9600"),
        (&["--port", "/dev/ttyACM0", "status"], 2, "cannot be used with"),
    ];
    for (arguments, expected, part) in cases {
        let (code, _, errors) = test.told(arguments);
        assert!(
            code == Some(*expected) && errors.contains(part),
            "{arguments:?}: {code:?} {errors}"
        );
    }
}

#[test]
fn several_commands_over_one_connection() {
    let test = Test::new();
    let script = "# forces stay from line to line\nforce Q0.5=1\nset MW20=7\n\nwait 20ms\n\
        force\nwatch MW20 Q0.5 --for 1ms --format csv\ncompare {}/p.awl\nexit\nrubbish\n"
        .replace("{}", &test.folder.path().display().to_string());
    fs::write(test.folder.path().join("s.txt"), script).unwrap();
    let output = test.good(&["shell", "{}/s.txt"]);
    assert!(output.contains("Q0.5") && output.contains(",7,1\n"), "{output}");
    assert!(output.contains("the same program"), "{output}");

    // A script ends where something is wrong, and says where.
    for (line, expected, part) in [
        ("watch IO.0", 2, "bad.txt:2: IO.0 is no address"),
        ("rubbish", 2, "unrecognized subcommand 'rubbish'"),
        ("monitor", 2, "there is no command monitor: `uno200 show"),
        ("force T37=1", 1, "T37 cannot be forced"),
        ("set \"MW4", 2, "a quote is not closed"),
    ] {
        let script = format!("set MW20=1\n{line}\nset MW20=2\n");
        fs::write(test.folder.path().join("bad.txt"), script).unwrap();
        let (code, _, errors) = test.told(&["shell", "{}/bad.txt"]);
        assert!(code == Some(expected) && errors.contains(part), "{line}: {code:?} {errors}");
        assert_eq!(test.values(&["MW20"]), ["1"], "{line}");
    }
}

#[test]
fn a_data_block_can_be_a_file_of_its_own() {
    let test = Test::new();
    let write = |name: &str, text: &str| fs::write(test.folder.path().join(name), text).unwrap();
    write("data.txt", "VB0 5\n");
    let (code, output, _) = test.told(&["--data", "{}/data.txt", "compare", "{}/p.awl"]);
    assert!(code == Some(1) && output.contains("data only in the file: VB0"), "{output}");
    write("data.txt", "VB0 x\n");
    let (code, _, errors) = test.told(&["--data", "{}/data.txt", "compare", "{}/p.awl"]);
    assert!(code == Some(1) && errors.contains("data.txt:1:"), "{errors}");
    // An image has its data: a second one would be left out.
    write("data.txt", "VB0 5\n");
    test.good(&["read-program", "-o", "{}/p.bin"]);
    test.good(&["compare", "{}/p.bin"]);
    let (code, output, errors) = test.told(&["--data", "{}/data.txt", "compare", "{}/p.bin"]);
    assert!(code == Some(2) && errors.contains("a data block goes with AWL text"), "{errors}");
    assert_eq!(output, "");
}

#[test]
fn without_a_plc_it_is_said_what_to_try() {
    let run = |arguments: &[&str]| {
        told(&Command::new(env!("CARGO_BIN_EXE_uno200")).args(arguments).output().unwrap())
    };
    let folder = tempfile::tempdir().unwrap();
    let closed =
        std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let (code, _, errors) = run(&["--tcp", &closed, "status"]);
    assert!(code == Some(2) && errors.contains("nothing listens there"), "{errors}");
    // What is wrong with the arguments is told before anything is opened.
    for (arguments, part) in [
        (&["watch", "IO.0"][..], "did you mean I0.0?"),
        (&["set", "MW4"], "write OPERAND=VALUE"),
        (&["trace", "MW4", "--trigger", "MW4 rising"], "MW4 is no bit"),
        (&["trace", "MW4", "-o", "x.png"], "is one of .csv"),
        (&["retained", "restore", "none.txt"], "cannot read"),
        (&["show", "none.awl"], "cannot read"),
    ] {
        let (code, _, errors) = run(&[&["--tcp", &closed], arguments].concat());
        assert!(code == Some(2) && errors.contains(part), "{arguments:?}: {errors}");
    }
    fs::write(folder.path().join("lamp.scn"), "at 1s I0.0 = 1\n").unwrap();
    let scenario = folder.path().join("lamp.scn").display().to_string();
    for (arguments, part) in [
        (&["unforce"][..], "<OPERAND|--all>"),
        (&["unforce", "I0.0", "--all"], "cannot be used with"),
        (&["upload", "lamp.awl"], "`uno200 flash lamp.awl` writes a program to the board"),
        (
            &["run", "lamp.awl"],
            "run starts what the board holds; `uno200 flash lamp.awl` writes it",
        ),
        (&["trace", "I0.0", "--trigger", "I0.0 = 1"], "rising, falling, on or off: \"I0.0 on\""),
        (&["trace", "I0.0", "--trigger", "I0.0", "rising"], "--trigger \"I0.0 rising\""),
        (&["flash", &scenario], "lamp.scn is a scenario: `awl-sim "),
        (&["build", &scenario], "lamp.scn is a scenario: `awl-sim "),
    ] {
        let (code, _, errors) = run(&[&["--tcp", &closed], arguments].concat());
        assert!(code == Some(2) && errors.contains(part), "{arguments:?}: {errors}");
    }
    let (code, _, errors) = run(&["--tcp", "1502", "status"]);
    assert!(code == Some(2) && errors.contains("the host is missing: 127.0.0.1:1502"), "{errors}");
    let (code, _, errors) = run(&["--tcp", "localhost", "status"]);
    assert!(code == Some(2) && errors.contains("HOST:PORT"), "{errors}");
    let (code, _, errors) = run(&["--port", "/dev/none", "status"]);
    assert!(code == Some(2) && errors.contains("plugged in"), "{errors}");
}

#[test]
fn a_period_that_is_too_short_is_told_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let text = "PROGRAM Main\nVAR\n    Beat : EVERY := (TS := T#1ms);\n    Loop : PID;\nEND_VAR\n\
        Beat();\nLoop(EN := Beat.Q, PV := 1.0);\n%QW0 := REAL_TO_INT(Loop.U);\nEND_PROGRAM\n";
    let path = folder.path().join("fast.fbd");
    fs::write(&path, text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
    let output = command.args(["--port", "/dev/none", "flash"]).arg(&path).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    let (before, after) = errors.split_once("warning[W0502]: Beat has a period of 1 ms").unwrap();
    assert!(output.status.code() == Some(2) && before.is_empty(), "{errors}");
    assert!(after.contains("fast.fbd:3:5") && after.contains("/dev/none"), "{errors}");
}
