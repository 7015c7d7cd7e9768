//! The command `awl-sim` from outside: arguments, exit codes, what goes where.

mod folder;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Output, Stdio};

use awl_asm::assemble::assemble;
use awl_asm::native::translate;
use awl_asm::source::Source;
use folder::{Folder, told};

const COPY: &str = "//# symbol Lamp Q0.0 the lamp\nLD I0.0\n= Lamp\nLD SM0.0\nMOVW Ain0, MW3\n";
/// Reads the bits of a counter and a timer that nothing counts and starts.
const BITS: &str = "LD C100\nA T37\n= M0.0\n";
/// Loops for ever as soon as I0.0 is on.
const LOOP: &str = "LBL 1\nLD I0.0\nJMP 1\nLD SM0.0\n= Q0.0\n";

#[test]
fn a_good_run_tells_its_summary() {
    let scenario = "at 2ms I0.0 = 1, Ain0 = 7\nat 3ms expect Lamp = 1, MW3 = 7\nrun 5s\n";
    let folder = Folder::with_files("good", &[("p.awl", COPY), ("s.scn", scenario)]);
    let expected =
        (Some(0), String::new(), "ran 5000 scans (5 s), 2 expectations met\n".to_string());
    assert_eq!(told(&folder.sim(&["p.awl", "--scenario", "s.scn"])), expected);
}

#[test]
fn a_failed_expectation_is_exit_1_with_its_place() {
    let scenario = "at 2ms I0.0 = 1\nat 3ms expect Lamp = 0, MW3 = 5..9\n";
    let folder = Folder::with_files("failed", &[("p.awl", COPY), ("s.scn", scenario)]);
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "s.scn"]));
    let expected = "s.scn:2: at 3ms expected Lamp = 0, got 1; it was 0 until 2ms\n\
        s.scn:2: at 3ms expected MW3 = 5..9, got 0; it never became so in the run\n\
                    ran 3 scans (3 ms), 0 expectations met, 2 failed\n";
    assert_eq!((code, &*errors), (Some(1), expected));
}

#[test]
fn a_fault_is_exit_3_and_wins() {
    let scenario = "at 5ms I0.0 = 1\nat 5ms expect Q0.0 = 1\nat 8ms expect Q0.0 = 1\n";
    let folder = Folder::with_files("fault", &[("p.awl", LOOP), ("s.scn", scenario)]);
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "s.scn"]));
    assert_eq!(code, Some(3));
    assert!(
        errors.contains("s.scn:3: at 8ms expected Q0.0 = 1, got 0; it was 1 until 5ms\n"),
        "{errors}"
    );
    assert!(errors.contains("error: PLC fault at 5ms: watchdog"), "{errors}");
    assert!(errors.contains("1 expectation met, 1 failed"), "{errors}");
}

#[test]
fn what_cannot_run_is_exit_2() {
    let wrong = "scna 1ms\nat 1s Lmap = 1\n";
    let bad = ("bad.awl", "LD I0.0\nJMP 7\n");
    let files = [("p.awl", COPY), ("bits.awl", BITS), bad, ("s.scn", wrong)];

    let folder = Folder::with_files("cannot", &files);
    let cases: &[(&[&str], &str)] = &[
        (&[], "Usage"),
        (&["none.awl"], "cannot read none.awl"),
        (&["bad.awl"], "bad.awl:2:5"),
        (&["p.awl", "--scenario", "none.scn"], "cannot read none.scn"),
        (&["p.awl", "--for", "5"], "needs its unit"),
        (&["p.awl", "--for", "5s", "--scans", "3"], "cannot be used with"),
        (&["p.awl", "--scan-time", "0ms"], "1ms to 60s"),
        (&["p.awl", "--plant", "press"], "there is no plant press"),
        (&["p.awl", "--plant", "tank level=200"], "0 to 100"),
        (&["p.awl", "--trace", "I0.0,Q0.9"], "--trace:1:6"),
        (&["p.awl", "--trace", "VW0"], "the program does not use VW0"),
        (
            &["bits.awl", "--trace", "C100.cv"],
            "C100 has no current value: the program neither counts C100 nor reads it as a word",
        ),
        (
            &["bits.awl", "--trace", "T37.cv"],
            "T37 has no current value: the program neither starts",
        ),
        (
            &["p.awl", "--format", "svg", "-o", "none/x.svg", "--scans", "1"],
            "cannot write none/x.svg",
        ),
        (&["bad.awl", "--serve", "127.0.0.1:0"], "bad.awl:2:5"),
        (&["p.awl", "--serve", "1502"], "the host is missing: 127.0.0.1:1502"),
        (&["p.awl", "--serve", ":1502"], "the host is missing: 127.0.0.1:1502"),
        (&["p.awl", "--serve", "localhost"], "the port is missing: localhost:1502"),
        (&["p.awl", "--serve", "127.0.0.1:what"], "is no address such as 127.0.0.1:1502"),
        (&["p.awl", "--serve", "0.0.0.0:0"], "--serve-anywhere"),
        (&["p.awl", "--serve", "[::]:0"], "Modbus has no passwords"),
        (&["p.awl", "--serve", "127.0.0.1:0", "--serve-writes"], "--serve-anywhere"),
        (&["p.awl", "--serve-anywhere"], "--serve <"),
        (&["p.awl", "--serve", "127.0.0.1:0", "--for", "5s"], "cannot be used with"),
        (&["p.awl", "--serve", "127.0.0.1:0", "--on", "uno"], "--on host only"),
    ];
    for (arguments, part) in cases {
        let (code, output, errors) = told(&folder.sim(arguments));
        assert_eq!((code, &*output), (Some(2), ""), "{arguments:?}: {errors}");
        assert!(errors.contains(part), "{arguments:?}: {errors}");
    }
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "s.scn"]));
    assert_eq!(code, Some(2));
    for part in ["s.scn:1:1", "did you mean `scan`?", "s.scn:2:7", "did you mean `Lamp`?"] {
        assert!(errors.contains(part), "{errors}");
    }
}

/// Words that belong to an option, and files that are no program.
#[test]
fn arguments_in_the_wrong_place_are_told_their_place() {
    let scenario = "at 1s I0.0 = 1\n";
    let files = [
        ("p.awl", COPY),
        ("p.scn", scenario),
        ("s.txt", scenario),
        ("door.plant", "part Door 0..100\n"),
        ("t.csv", "Lamp,Q0.0\n"),
    ];
    let folder = Folder::with_files("places", &files);
    let cases: &[(&[&str], &str)] = &[
        (&["p.awl", "p.scn"], "p.scn is a scenario: `awl-sim p.awl --scenario p.scn`"),
        (&["p.scn"], "p.scn is a scenario: `awl-sim p.awl --scenario p.scn`"),
        (&["p.awl", "s.txt"], "s.txt is a scenario: `awl-sim p.awl --scenario s.txt`"),
        (&["p.awl", "door.plant"], "door.plant is a plant: `awl-sim p.awl --plant door.plant`"),
        (
            &["p.awl", "t.csv"],
            "t.csv is a symbol table, which goes with a program: `--symbols t.csv`",
        ),
        (
            &["p.scn", "--scenario", "p.awl"],
            "p.scn is a scenario: `awl-sim p.awl --scenario p.scn`",
        ),
        (&["p.awl", "--scenario", "p.awl"], "p.awl is a program: `awl-sim p.awl --scenario F.scn`"),
        (&["p.awl", "--trace", "I0.0", "Q0.0"], "Q0.0 is an operand: `--trace I0.0,Q0.0`"),
        (
            &["p.awl", "--trace", "I0.0,", "Q0.0,", "T37.cv"],
            "Q0.0, T37.cv are operands: `--trace I0.0,Q0.0,T37.cv`",
        ),
        (&["p.awl", "--trace", "I0.0", "Lamp"], "Lamp is an operand: `--trace I0.0,Lamp`"),
        (&["p.awl", "MW3"], "MW3 is an operand: `--trace MW3`"),
        (
            &["p.awl", "--plant", "tank", "level=20", "outflow=1"],
            "level=20 is an option of the plant: `--plant \"tank level=20 outflow=1\"`",
        ),
        (&["p.awl", "level=20"], "level=20 is an option of the plant: `--plant \"tank level=20\"`"),
        (&["p.awl", "I0.0=1"], "I0.0=1 sets a value: in a scenario, `at 0ms I0.0 = 1`"),
        (&["p.awl", "5s"], "5s is a time: `--for 5s`"),
        (&["p.awl", "motor"], "cannot read motor"),
    ];
    for (arguments, expected) in cases {
        let (code, output, errors) = told(&folder.sim(arguments));
        assert_eq!((code, &*output), (Some(2), ""), "{arguments:?}: {errors}");
        assert!(errors.starts_with(&format!("error: {expected}")), "{arguments:?}: {errors}");
    }
    // A file that is there is a file, whatever its name.
    fs::write(folder.0.join("MW3"), COPY).unwrap();
    assert_eq!(told(&folder.sim(&["MW3", "--scans", "1"])).0, Some(0));
}

#[test]
fn what_the_program_overwrites_is_warned_of() {
    let scenario = "at 1ms Lamp = 1, MW3 = 2\nat 2ms expect Lamp = 0\n";
    let folder = Folder::with_files("overwritten", &[("p.awl", COPY), ("p.scn", scenario)]);
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "p.scn"]));
    let warning = "warning: Q0.0 does not keep this value: the program writes it again";
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains(warning) && errors.contains("--> p.scn:1:8"), "{errors}");
    assert_eq!(errors.matches("warning").count(), 1, "{errors}");
    let (_, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "p.scn", "--quiet"]));
    assert_eq!(errors, "");
    let (code, output, _) = told(&folder.sim(&["test", "p.scn"]));
    assert_eq!(code, Some(0));
    let warning = "warning: p.scn:1:8: Q0.0 does not keep this value";
    assert!(output.contains(warning), "{output}");
}

#[cfg(not(feature = "simavr"))]
#[test]
fn without_the_virtual_uno_it_is_said_how_to_get_it() {
    let folder = Folder::with_files("without-uno", &[("p.awl", COPY)]);
    let (code, output, errors) = told(&folder.sim(&["p.awl", "--on", "uno"]));
    assert_eq!((code, &*output), (Some(2), ""), "{errors}");
    assert!(errors.contains("cargo install --path sim --features simavr"), "{errors}");
}

#[test]
fn machine_code_is_refused_with_what_to_do() {
    let folder = Folder::new("machine-code");
    let source = Source::new("p.awl", COPY).unwrap();
    let native = translate(&assemble(&source, Vec::new()).image.unwrap()).unwrap();
    fs::write(folder.0.join("p.bin"), native.image).unwrap();
    for machine in ["host", "uno", "uno-native"] {
        let (code, output, errors) = told(&folder.sim(&["p.bin", "--on", machine]));
        assert_eq!((code, &*output), (Some(2), ""), "{errors}");
        assert!(
            errors.contains(
                "p.bin is machine code for the board; awl-sim takes AWL text or bytecode"
            ),
            "{errors}"
        );
    }
}

#[cfg(feature = "simavr")]
#[test]
fn a_program_too_large_to_be_translated_is_exit_2() {
    let text = "LD I0.0\nLD I0.1\nCTU C1, VW0\n".repeat(500);
    let folder = Folder::with_files("too-large", &[("p.awl", &text)]);
    let firmware = awl_asm::firmware::find_elf().unwrap_or_else(|error| panic!("{error:#}"));
    let arguments = ["p.awl", "--on", "uno-native", "--for", "10ms"];
    let (code, output, errors) =
        told(&folder.command(&arguments).env("UNO200_FIRMWARE", firmware).output().unwrap());
    assert_eq!((code, &*output), (Some(2), ""), "{errors}");
    assert!(errors.contains("error: translated the program needs "), "{errors}");
}

#[cfg(feature = "simavr")]
#[test]
fn a_board_is_traced_by_its_changes() {
    let scenario =
        "scan 10ms\nat 20ms I0.0 = 1\nat 50ms I0.0 = 0\nat 21ms expect Lamp = 1\nrun 100ms\n";
    let folder = Folder::with_files("board", &[("p.awl", COPY), ("s.scn", scenario)]);
    let arguments =
        |machine| ["p.awl", "--scenario", "s.scn", "--on", machine, "--trace", "I0.0,Q0.0"];
    let firmware = awl_asm::firmware::find_elf().unwrap_or_else(|error| panic!("{error:#}"));
    for machine in ["uno", "uno-native"] {
        let output =
            folder.command(&arguments(machine)).env("UNO200_FIRMWARE", &firmware).output().unwrap();
        let (code, output, errors) = told(&output);
        assert_eq!((code, &*errors), (Some(0), "ran 100 ms, 1 expectation met\n"));
        assert_eq!(output, "time_ms,scan,I0.0,Q0.0\n0,1,0,0\n20,3,1,1\n50,6,0,0\n");
    }
    let arguments = arguments("uno");
    let (code, _, errors) =
        told(&folder.command(&arguments).env("UNO200_FIRMWARE", "none.elf").output().unwrap());
    assert_eq!(code, Some(2));
    assert!(errors.contains("none.elf") && errors.contains("cargo xtask firmware"), "{errors}");
}

#[test]
fn the_trace_goes_to_stdout_and_only_the_trace() {
    let scenario = "scan 10ms\nat 10ms I0.0 = 1, Ain0 = 300\nrun 30ms\n";
    let folder = Folder::with_files("stdout", &[("p.awl", COPY), ("s.scn", scenario)]);
    let (code, output, errors) =
        told(&folder.sim(&["p.awl", "--scenario", "s.scn", "--trace", "I0.0, lamp,MW3"]));
    assert_eq!((code, &*errors), (Some(0), "ran 3 scans (30 ms)\n"));
    assert_eq!(output, "time_ms,scan,I0.0,lamp,MW3\n0,1,0,0,0\n10,2,1,1,300\n20,3,1,1,300\n");
}

#[test]
fn files_are_written_whole_and_their_name_tells_the_format() {
    let folder = Folder::with_files("files", &[("p.awl", COPY)]);
    for (file, start) in [
        ("a.csv", "time_ms,scan,I0.0,Q0.0,"),
        ("a.svg", "<svg"),
        ("a.vcd", "$version"),
        ("a.txt", "time"),
    ] {
        fs::write(folder.0.join(file), "old").unwrap();
        let (code, output, errors) = told(&folder.sim(&["p.awl", "--scans", "20", "-o", file]));
        assert_eq!((code, &*output), (Some(0), ""), "{errors}");
        let text = fs::read_to_string(folder.0.join(file)).unwrap();
        assert!(text.trim_start().starts_with(start), "{file}: {text}");
        assert!(file != "a.txt" || !text.contains(','), "a table: {text}");
    }
    assert_eq!(folder.names(), ["a.csv", "a.svg", "a.txt", "a.vcd", "p.awl"]);
}

#[test]
fn an_output_has_a_known_ending_and_is_no_source() {
    let files = [("p.awl", COPY), ("s.scn", "run 5ms\n"), ("other.awl", "LD I0.0\n= Q0.0\n")];
    let folder = Folder::with_files("endings", &files);
    let png = "-o x.png: the ending says no format: name it .csv, .vcd, .svg or .txt";
    let source = "this is the name of a source";
    let cases: &[(&[&str], &str)] = &[
        (&["-o", "x.png"], png),
        (&["-o", "x"], "the ending says no format"),
        (&["-o", "other.awl"], source),
        (&["-o", "new.awl"], source),
        (&["-o", "s.scn", "--format", "csv"], source),
        (&["-o", "p.BIN", "--format", "csv"], source),
        (&["-o", "p.awl", "--format", "csv"], "p.awl would be overwritten"),
    ];
    for (arguments, part) in cases {
        let (code, _, errors) = told(&folder.sim(&[&["p.awl"], *arguments].concat()));
        assert_eq!(code, Some(2), "{arguments:?}: {errors}");
        assert!(errors.contains(part), "{arguments:?}: {errors}");
    }
    assert_eq!(folder.names(), ["other.awl", "p.awl", "s.scn"]);
    // Who names the format may name the file as he likes.
    let arguments = ["p.awl", "--scans", "1", "-o", "x.dat", "--format", "csv"];
    assert_eq!(told(&folder.sim(&arguments)).0, Some(0));
    assert!(fs::read_to_string(folder.0.join("x.dat")).unwrap().starts_with("time_ms,scan"));
}

/// The command with this on its standard input.
fn sim_with_input(folder: &Folder, arguments: &[&str], input: &str) -> Output {
    let mut command = folder.command(arguments);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn program_or_scenario_come_from_standard_input() {
    let scenario = "at 2ms I0.0 = 1\nat 3ms expect Lamp = 1\n";
    let folder = Folder::with_files("stdin", &[("p.awl", COPY), ("s.scn", scenario)]);
    let arguments = ["-", "--scenario", "s.scn"];
    let (code, _, errors) = told(&sim_with_input(&folder, &arguments, COPY));
    assert_eq!((code, &*errors), (Some(0), "ran 3 scans (3 ms), 1 expectation met\n"));
    let wrong = "at 3ms expect Lamp = 1\n";
    let arguments = ["p.awl", "--scenario", "-"];
    let (code, _, errors) = told(&sim_with_input(&folder, &arguments, wrong));
    assert_eq!(code, Some(1));
    assert!(errors.starts_with("<stdin>:1: at 3ms expected Lamp = 1, got 0; it never"), "{errors}");
    let (code, _, errors) = told(&sim_with_input(&folder, &["-"], "LD I0.0\nJMP 7\n"));
    assert!(code == Some(2) && errors.contains("<stdin>:2:5"), "{errors}");
    let (code, _, errors) = told(&sim_with_input(&folder, &["-", "--scenario", "-"], ""));
    assert!(code == Some(2) && errors.contains("only one file can be read"), "{errors}");
}

#[test]
fn a_data_block_of_its_own() {
    let files = [
        ("p.awl", "LD SM0.0\nMOVW VW0, MW0\n"),
        ("d.txt", "VW0 4711\n"),
        ("wrong.txt", "VW0 4711\nQB0 1\n"),
        ("s.scn", "at 1ms expect MW0 = 4711\n"),
    ];
    let folder = Folder::with_files("data", &files);
    let run =
        |more: &[&str]| told(&folder.sim(&[&["p.awl", "--scenario", "s.scn"], more].concat()));
    assert_eq!(run(&["--data", "d.txt"]).0, Some(0));
    assert_eq!(run(&[]).0, Some(1), "without it there are zeros");
    let (code, _, errors) = run(&["--data", "wrong.txt"]);
    assert!(code == Some(2) && errors.contains("wrong.txt:2:1"), "{errors}");
    let (code, _, errors) = run(&["--data", "none.txt"]);
    assert!(code == Some(2) && errors.contains("cannot read none.txt"), "{errors}");
}

#[test]
fn until_ends_the_run_and_its_time_over_is_exit_1() {
    let scenario = "at 5ms I0.0 = 1\nuntil Lamp = TRUE or 1min\n";
    let late = "until Lamp = 1 or 20ms\n";
    let files = [("p.awl", COPY), ("s.scn", scenario), ("late.scn", late)];
    let folder = Folder::with_files("until", &files);
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "s.scn"]));
    assert_eq!((code, &*errors), (Some(0), "ran 6 scans (6 ms), 1 expectation met\n"));
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scenario", "late.scn"]));
    assert_eq!(code, Some(1));
    assert!(errors.contains("late.scn:1: at 20ms still waiting until Lamp = 1, got 0"), "{errors}");
}

#[test]
fn the_command_line_overrides_the_scenario_and_says_what_it_cuts_off() {
    let scenario = "scan 10ms\nat 20ms I0.0 = 1\nat 30ms expect Lamp = 1\nrun 1s\n";
    let folder = Folder::with_files("override", &[("p.awl", COPY), ("s.scn", scenario)]);
    let (code, _, errors) =
        told(&folder.sim(&["p.awl", "--scenario", "s.scn", "--scan-time", "5ms", "--scans", "4"]));
    let expected = "warning: 1 expectation not checked: the run ended before\n\
                    warning: 1 value set at the end of the run or later: no scan has seen it\n\
                    ran 4 scans (20 ms)\n";
    assert_eq!((code, &*errors), (Some(0), expected));
}

#[test]
fn the_scan_period_of_the_program_counts_where_nothing_else_is_said() {
    let folder = Folder::with_files("period", &[("p.awl", &format!("//# scan 20ms\n{COPY}"))]);
    assert_eq!(told(&folder.sim(&["p.awl", "--for", "100ms"])).2, "ran 5 scans (100 ms)\n");
    assert_eq!(
        told(&folder.sim(&["p.awl", "--for", "100ms", "--scan-time", "50ms"])).2,
        "ran 2 scans (100 ms)\n"
    );
}

#[test]
fn symbols_from_a_file_name_operands() {
    let folder = Folder::with_files(
        "symbols",
        &[("p.awl", "LD I0.0\n= Q0.0\n"), ("t.csv", "Horn,Q0.0,the horn\n")],
    );
    let (code, output, errors) =
        told(&folder.sim(&["p.awl", "--symbols", "t.csv", "--trace", "Horn", "--scans", "1"]));
    assert_eq!((code, &*output), (Some(0), "time_ms,scan,Horn\n0,1,0\n"), "{errors}");
}

#[test]
fn a_plant_reports_on_stderr() {
    let folder = Folder::with_files("plant", &[("p.awl", COPY)]);
    let (code, _, errors) = told(&folder.sim(&[
        "p.awl",
        "--plant",
        "tank level=1 outflow=1 variation=0",
        "--for",
        "2s",
    ]));
    assert_eq!(code, Some(0));
    assert!(errors.contains("1.000 s  tank empty"), "{errors}");
    assert!(errors.contains("plant tank: level_min_permille 0, "), "{errors}");
}

/// A PLC on the network, and what it said when it began to listen.
fn serve(folder: &Folder, arguments: &[&str]) -> (Child, String) {
    let mut command = folder.command(arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    (child, line)
}

/// Ctrl-C.
fn interrupt(child: Child) -> Output {
    let is_sent =
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success();
    assert!(is_sent);
    child.wait_with_output().unwrap()
}

#[test]
fn a_plc_on_the_network_runs_its_scenario_until_ctrl_c() {
    let scenario = "at 0ms I0.0 = 1, Ain0 = 7\nat 20ms expect Lamp = 1\nrun 30ms\n";
    let folder = Folder::with_files("serve", &[("p.awl", COPY), ("s.scn", scenario)]);
    let (child, line) = serve(&folder, &["p.awl", "--scenario", "s.scn", "--serve", "127.0.0.1:0"]);
    let address = line.split_whitespace().find_map(|word| word.strip_suffix(':')).unwrap();
    assert!(line.contains("this computer reads and writes; look: uno200 --tcp "), "{line}");
    let mut stream = TcpStream::connect(address).unwrap();
    // Until the scenario is over, and longer.
    for _ in 0..100 {
        std::thread::sleep(std::time::Duration::from_millis(1));
        stream.write_all(&[0, 1, 0, 0, 0, 6, 1, 1, 0, 0, 0, 1]).unwrap();
        let mut answer = [0; 10];
        stream.read_exact(&mut answer).unwrap();
        assert_eq!(answer, [0, 1, 0, 0, 0, 4, 1, 1, 1, 1]);
    }
    let (code, _, errors) = told(&interrupt(child));
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains("1 expectation met") && !errors.contains("failed"), "{errors}");
}

#[test]
fn a_plc_on_the_network_says_its_faults_and_goes_on() {
    let scenario = "at 5ms I0.0 = 1\n";
    let folder = Folder::with_files("serve-fault", &[("p.awl", LOOP), ("s.scn", scenario)]);
    let (mut child, line) = serve(
        &folder,
        &["p.awl", "--scenario", "s.scn", "--serve", "0.0.0.0:0", "--serve-anywhere"],
    );
    assert!(
        line.contains("every computer reads, this one writes; look: uno200 --tcp 127.0.0.1:"),
        "{line}"
    );
    let mut fault = String::new();
    BufReader::new(child.stderr.as_mut().unwrap()).read_line(&mut fault).unwrap();
    assert!(fault.starts_with("5ms: STOP: watchdog") && fault.contains("p.awl:3"), "{fault}");
    assert_eq!(child.try_wait().unwrap(), None);
    assert_eq!(interrupt(child).status.code(), Some(0));
}

#[test]
fn a_taken_port_is_exit_2() {
    let folder = Folder::with_files("serve-taken", &[("p.awl", COPY)]);
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--serve", &address]));
    assert_eq!(code, Some(2));
    assert!(errors.contains(&format!("cannot listen on {address}: ")), "{errors}");
}

const CALLS: &str = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nNetwork 1\nLD SM0.0\nCALL Lamp:SBR0\n\
                     END_ORGANIZATION_BLOCK\n";
const CALLED: &str = "SUBROUTINE_BLOCK Lamp:SBR0\nBEGIN\nNetwork 1\nLD I0.0\n= Q0.0\n\
                      END_SUBROUTINE_BLOCK\n";

#[test]
fn several_files_are_one_program() {
    let scenario = "program main.awl, sbr0.awl\nat 1ms I0.0 = 1\nat 3ms expect Q0.0 = 1\n";
    let files = [("main.awl", CALLS), ("sbr0.awl", CALLED), ("s.scn", scenario)];
    let folder = Folder::with_files("several", &files);
    let (code, _, errors) = told(&folder.sim(&["main.awl", "sbr0.awl", "--scenario", "s.scn"]));
    assert_eq!((code, &*errors), (Some(0), "ran 3 scans (3 ms), 1 expectation met\n"));
    let (code, output, _) = told(&folder.sim(&["test", "."]));
    assert!(code == Some(0) && output.contains("1 scenario: 1 ok"), "{output}");
    fs::write(folder.0.join("sbr0.awl"), CALLED.replace("I0.0", "I0.9")).unwrap();
    let (code, _, errors) = told(&folder.sim(&["main.awl", "sbr0.awl", "--scans", "1"]));
    assert!(code == Some(2) && errors.contains("--> sbr0.awl:4:4"), "{errors}");
    let (code, _, errors) = told(&folder.sim(&["main.awl", "main.awl", "--scans", "1"]));
    assert!(code == Some(2) && errors.contains("a program has only one"), "{errors}");
}

#[test]
fn messages_are_those_of_the_assembler() {
    let many = "LD I0.0\n".to_owned() + &"= Q0.0\n".repeat(30);
    let scenario = "at 2ms expct Q0.0 = 1\n";
    let files = [("p.awl", &*many), ("bad.awl", "LD I0.9\n= Q0.0\n= Q0.0\n"), ("s.scn", scenario)];
    let folder = Folder::with_files("messages", &files);
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scans", "1"]));
    assert!(code == Some(0) && errors.contains("and 24 more, from line 8 on"), "{errors}");
    let (code, _, errors) = told(&folder.sim(&["p.awl", "--scans", "1", "--quiet"]));
    assert_eq!((code, &*errors), (Some(0), ""));
    let arguments = ["bad.awl", "-q", "--message-format", "short"];
    let (code, _, errors) = told(&folder.sim(&arguments));
    let expected = "bad.awl:1:4: error[E0005]: I0.9: a byte has bits 0 to 7\n";
    assert_eq!((code, &*errors), (Some(2), expected));
    let (code, _, errors) = told(&folder.sim(&["bad.awl", "--message-format", "json"]));
    assert!(code == Some(2) && errors.lines().all(|line| line.starts_with('{')), "{errors}");
    let arguments = ["p.awl", "-q", "--scenario", "s.scn", "--message-format", "short"];
    let (code, _, errors) = told(&folder.sim(&arguments));
    assert_eq!(code, Some(2));
    assert!(errors.starts_with("s.scn:1:8: error: ") && errors.lines().count() == 1, "{errors}");
}

#[test]
fn files_that_are_no_text_are_told_what_they_are() {
    let folder = Folder::with_files("binary", &[("p.awl", COPY)]);
    fs::write(folder.0.join("machine.mwp"), b"GJK\0R04.00\0\0").unwrap();
    fs::write(folder.0.join("elf.bin"), b"\x7FELF\x01").unwrap();
    fs::write(folder.0.join("s.scn"), b"%PDF-1.4").unwrap();
    let runs: [(&[&str], &str); 4] = [
        (&["machine.mwp"], "machine.mwp: this is a project of STEP 7-Micro/WIN (.mwp); in "),
        (&["p.awl", "--symbols", "machine.mwp"], "machine.mwp: this is a project"),
        (&["p.awl", "--scenario", "s.scn"], "s.scn: this is a PDF document; "),
        (&["elf.bin"], "elf.bin: this is an ELF file"),
    ];
    for (arguments, part) in runs {
        let (code, _, errors) = told(&folder.sim(arguments));
        assert!(code == Some(2) && errors.contains(part), "{errors}");
    }
}
