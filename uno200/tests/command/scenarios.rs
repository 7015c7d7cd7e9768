//! `uno200 test` against a PLC that runs in this process: scenarios, what cannot be done, and how
//! the PLC is afterwards.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::plc::Plc;
use crate::{told, uno200};

/// T32 counts milliseconds. VW0 comes from the data block, MW10 counts scans.
const PROGRAM: &str = "//# scan 10ms\nNETWORK 1\nLD SM0.0\nTON T32, 100\n\
    LD T32\n= Q0.0\nNETWORK 2\nLD I0.1\n= Q0.1\nLD SM0.0\nINCW MW10\nMOVW VW0, VW2\n\
    MOVW AIW2, VW4\nLD I0.2\nLD I0.3\nCTU C1, 3\nNETWORK 3\nLBL 1\nLD I0.5\nJMP 1\n\
    DATA_BLOCK\nVW0 4711\nEND_DATA_BLOCK\n";

/// A PLC with this program, and a folder with it and these scenarios.
struct Test {
    plc: Plc,
    folder: tempfile::TempDir,
}

impl Test {
    fn new(program: &str, scenarios: &[(&str, &str)]) -> Test {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("p.awl"), program).unwrap();
        for (name, text) in scenarios {
            fs::write(folder.path().join(name), text).unwrap();
        }
        Test { plc: Plc::start(&folder.path().join("p.awl")), folder }
    }

    fn told(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        told(&uno200(&self.plc, self.folder.path(), arguments))
    }

    /// Exit code and standard output of the test of the folder.
    fn tested(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let (code, output, errors) = self.told(&[&["test", "{}"], arguments].concat());
        assert_eq!(errors, "", "{output}");
        (code, output)
    }
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn what_the_plc_does_by_itself_is_judged_to_the_scan() {
    // A scan that starts at 100 ms is the first with T32 on.
    let scenarios = [
        ("p.a.scn", "at 100ms expect Q0.0 = 0, VW2 = 4711, MW10 = 10\nat 101ms expect Q0.0 = 1\n"),
        ("p.early.scn", "at 100ms expect Q0.0 = 1\nrun 200ms\n"),
        ("p.late.scn", "at 101ms expect Q0.0 = 0\nnever Q0.1 = 1 or MW10 > 30\nrun 300ms\n"),
    ];
    let test = Test::new(PROGRAM, &scenarios);
    for _ in 0..2 {
        // Memory begins anew.
        let (code, output) = test.tested(&["--junit", "{}/r.xml", "--tap", "{}/r.tap"]);
        assert_eq!(code, Some(1), "{output}");
        let lines: Vec<&str> = output.lines().map(str::trim).collect();
        assert!(lines[0].starts_with("ok") && lines[0].ends_with("every scan seen"), "{output}");
        assert!(
            lines[2].ends_with(
                "p.early.scn:1: at 100ms expected Q0.0 = 1, got 0; it became 1 \
            at 100ms"
            ),
            "{output}"
        );
        assert!(lines[4].contains("p.late.scn:1: at 101ms expected Q0.0 = 0, got 1"), "{output}");
        assert_eq!(*lines.last().unwrap(), "3 scenarios: 1 ok, 2 failed");
    }
    let junit = read(test.folder.path(), "r.xml");
    assert!(junit.contains("testsuite name=\"uno200\" tests=\"3\" failures=\"2\""), "{junit}");
    assert!(read(test.folder.path(), "r.tap").starts_with("TAP version 14\n1..3\nok 1 - "));
}

#[test]
fn inputs_are_forced_with_a_tolerance() {
    let scenario = "at 0ms I0.1 = 1, AIW2 = 1234\nat 50ms expect Q0.1 = 1, VW4 = 1234\n\
        at 200ms I0.1 = 0\nat 300ms expect Q0.1 = 0\nat 600ms I0.1 = 1, VW0 = -5\n\
        at 700ms expect Q0.1 = 1, VW2 = -5\nalways Q0.1 = 0 from 300ms to 600ms\n\
        every 60ms I0.2 = 1 from 0ms to 600ms\nevery 60ms I0.2 = 0 from 30ms to 600ms\n\
        at 800ms expect C1.cv > 4\n";
    let test = Test::new(PROGRAM, &[("p.scn", scenario)]);
    let (code, output) = test.tested(&["--tolerance", "80ms"]);
    assert_eq!(code, Some(0), "{output}");
    assert!(output.starts_with("ok"), "{output}");
    let (_, status, _) = test.told(&["status"]);
    assert!(status.contains("STOP") && status.contains("forced      nothing"), "{status}");
    let json = ["test", "{}", "--leave", "--format", "json", "--tolerance", "80ms"];
    let (code, output, _) = test.told(&json);
    assert!(code == Some(0) && output.contains("\"result\":\"passed\""), "{output}");
    let (_, status, _) = test.told(&["status"]);
    assert!(status.contains("mode        RUN") && status.contains("operands"), "{status}");
}

#[test]
fn without_a_period_it_is_the_time_of_this_computer() {
    let program = PROGRAM.replace("//# scan 10ms\n", "");
    let scenario = "at 500ms I0.1 = 1\nat 400ms expect Q0.0 = 1, Q0.1 = 0\n\
        at 500ms within 500ms expect Q0.1 = 1\n";
    let test = Test::new(&program, &[("p.scn", scenario), ("p.b.scn", "at 1s expect Q0.0 = 0\n")]);
    let (code, output) = test.tested(&["--tolerance", "90ms"]);
    assert_eq!(code, Some(1), "{output}");
    assert!(
        output.contains("ok      ") && output.contains("at times of this computer"),
        "{output}"
    );
    assert!(output.contains("(+-95ms), got 1"), "{output}");
}

#[test]
fn a_fault_is_told_with_its_line() {
    let test = Test::new(PROGRAM, &[("p.scn", "at 100ms I0.5 = 1\nat 900ms expect Q0.0 = 0\n")]);
    let (code, output) = test.tested(&[]);
    assert_eq!(code, Some(3), "{output}");
    assert!(output.contains("p.awl: PLC fault at ") && output.contains("p.awl:20"), "{output}");
}

#[test]
fn what_cannot_be_done_is_said_before_a_plc_is_asked() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("p.awl", PROGRAM);
    let cases = [
        ("scan 1ms\n", "the program's scans take 10 ms"),
        ("plant station1\n", "a plant model runs beside a simulated PLC only"),
        ("at 0ms Ain1 = 5\n", "AIW2, the same input as 0 to 32000, can"),
        ("at 0ms SMB5 = 5\n", "cannot be set in a PLC that runs"),
        ("at 0ms T32 = 1\n", "T32.cv"),
        ("at 0ms pulse I0.0 100Hz for 1s\n", "pulses cannot be forced"),
        ("at 0ms clock 2026-11-21 15:00:00\n", "the clock cannot be set"),
        ("at 0ms receive \"a\"\n", "the serial line is what the PLC is asked over"),
        ("at 1s expect sent \"a\"\n", "the serial line is what the PLC is asked over"),
        ("at 1s expect Q0.1.duty = 500\n", "cannot be read over the line"),
    ];
    for (number, (statement, _)) in cases.iter().enumerate() {
        write(&format!("p.{number}.scn"), &format!("at 0ms M0.0 = 1\n{statement}"));
    }
    write("p.scn", "scan 10ms\nat 20ms expect Q0.0 = 0\n");
    let output = Command::new(env!("CARGO_BIN_EXE_uno200"))
        .args(["--tcp", "127.0.0.1:1", "test"])
        .arg(folder.path())
        .output()
        .unwrap();
    let (code, output, errors) = told(&output);
    assert_eq!((code, &*errors), (Some(2), ""), "{output}");
    for (number, (statement, why)) in cases.iter().enumerate() {
        let place = format!("p.{number}.scn:2:");
        let told = output.split("error   ").find(|part| part.contains(&place));
        assert!(told.is_some_and(|told| told.contains(why)), "{statement}: {output}");
    }
    // The only one that can be run needs the PLC.
    assert!(output.contains("127.0.0.1:1"), "{output}");
    assert!(output.ends_with("11 scenarios: 11 with errors\n"), "{output}");
}

#[test]
fn another_program_is_refused() {
    let test = Test::new(PROGRAM, &[("q.scn", "at 20ms expect Q0.0 = 1\n")]);
    fs::write(test.folder.path().join("q.awl"), "LD SM0.0\n= Q0.0\n").unwrap();
    let (code, output) = test.tested(&[]);
    assert!(code == Some(2) && output.contains("the PLC holds another program"), "{output}");
    let (_, status, _) = test.told(&["status"]);
    assert!(status.contains("mode        RUN"), "it was left alone: {status}");
    let (code, _, errors) = test.told(&["test", "{}", "--flash"]);
    assert!(code == Some(2) && errors.contains("a PLC on the network is not flashed"), "{errors}");
}
