//! `awl-sim sweep` from outside: the blocks' frequency responses, and what it says of mistakes.

mod folder;

use std::f64::consts::TAU;

use folder::{Folder, told};

const FILTERS: &str = "\
PROGRAM Main
VAR
    Input : REAL;
    Count : INT := 7;
    Lamp AT %Q0.0 : BOOL;
    Slow : LAG;
    Flat : LOW_PASS_2;
    Error, Measure : REAL;
END_VAR
Slow(X := Input, T1 := T#200ms, TS := T#10ms);
Flat(X := Input, F := 5.0, TS := T#10ms);
Lamp := Slow.Y > 0.0;
Error := Input - Measure;
Measure := Measure + 0.1 * (3.0 * Error - Measure);
END_PROGRAM
";

/// What every call here has.
const CALL: [&str; 6] = ["sweep", "f.st", "--scan-time", "10ms", "--excite", "Main.Input"];

fn sweep(folder: &Folder, more: &[&str]) -> (Option<i32>, String, String) {
    told(&folder.sim(&[&CALL, more].concat()))
}

/// Frequency, gain and phase of each row.
fn measured(folder: &Folder, more: &[&str]) -> Vec<[f64; 3]> {
    let (code, list, errors) = sweep(folder, &[more, &["--format", "csv"]].concat());
    assert_eq!((code, &*errors), (Some(0), ""), "{list}");
    let rows = list.lines().skip(1).map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        [0, 1, 3].map(|column| cells[column].parse().unwrap())
    });
    rows.collect()
}

/// Gain and phase of 1 / (real + j imaginary).
fn inverse(real: f64, imaginary: f64) -> [f64; 2] {
    [1.0 / real.hypot(imaginary), -imaginary.atan2(real).to_degrees()]
}

fn assert_near(rows: &[[f64; 3]], expected: impl Fn(f64) -> [f64; 2]) {
    assert_eq!(rows.len(), 25);
    for &[hertz, gain, phase] in rows {
        let [wanted, angle] = expected(hertz);
        assert!((gain / wanted - 1.0).abs() < 1e-3, "{hertz} Hz: {gain}, not {wanted}");
        assert!((phase - angle).abs() < 0.1, "{hertz} Hz: {phase}, not {angle}");
    }
}

#[test]
fn filters_have_the_response_of_their_equations() {
    let folder = Folder::with_files("filters", &[("f.st", FILTERS)]);
    let rows = measured(&folder, &["--to", "Main.Slow.Y"]);
    assert!((rows[0][0] - 0.1).abs() < 1e-3 && (rows[24][0] - 10.0).abs() < 0.1, "{rows:?}");
    let part = 1.0 - (-10.0_f64 / 200.0).exp();
    assert_near(&rows, |hertz| {
        let (sine, cosine) = (TAU * hertz * 0.01).sin_cos();
        let [gain, phase] = inverse(1.0 - (1.0 - part) * cosine, (1.0 - part) * sine);
        [part * gain, phase]
    });
    // Bilinear: the frequencies of the circuit are the tangents.
    assert_near(&measured(&folder, &["--to", "Main.Flat.Y"]), |hertz| {
        let bent = (TAU * hertz * 0.005).tan() / (TAU * 5.0 * 0.005).tan();
        inverse(1.0 - bent * bent, 2.0_f64.sqrt() * bent)
    });
}

#[test]
fn an_open_loop_is_measured_in_the_closed_one() {
    let folder = Folder::with_files("loop", &[("f.st", FILTERS)]);
    let path = ["--from", "Main.Error", "--to", "Main.Measure", "--offset", "1"];
    assert_near(&measured(&folder, &path), |hertz| {
        let (sine, cosine) = (TAU * hertz * 0.01).sin_cos();
        let [gain, phase] = inverse(1.0 - 0.9 * cosine, 0.9 * sine);
        [0.3 * gain, phase]
    });
}

#[test]
fn the_table_ends_with_the_figures_and_the_plot_is_a_file() {
    let folder = Folder::with_files("figures", &[("f.st", FILTERS)]);
    let (code, table, errors) = sweep(&folder, &["--to", "Main.Slow.Y", "--points", "60"]);
    assert_eq!((code, &*errors), (Some(0), ""));
    assert_eq!(table.lines().count(), 63, "{table}");
    // 1 / (2 pi 0.2 s) = 0.796 Hz; the equation with samples of 10 ms has 0.808.
    assert!(table.ends_with("\nbandwidth (-3 dB): 0.808 Hz\n"), "{table}");
    let written = sweep(&folder, &["--to", "Main.Slow.Y", "-o", "slow.svg"]);
    assert_eq!(written, (Some(0), String::new(), String::new()));
    let svg = std::fs::read_to_string(folder.0.join("slow.svg")).unwrap();
    assert!(svg.contains("Main.Input to Main.Slow.Y"), "{svg}");
}

#[test]
fn mistakes_are_told_at_their_place() {
    let folder = Folder::with_files("mistakes", &[("f.st", FILTERS)]);
    for (more, expected) in [
        (&["--to", "Main.Slow.Z"][..], "--to:1:1"),
        (&["--to", "Main.Slow.Y", "--set", "Main.Count = 9, Main.Lmp = 1"], "--set:1:17"),
        (&["--to", "Main.Slow.Y", "--set", "expect Main.Count = 9"], "nothing can be expected"),
        (&["--to", "Main.Slow.Y", "--band", "1Hz..100Hz"], "100.0 Hz needs more than two scans"),
        (&["--to", "Main.Slow.Y", "--from", "Main.Count"], "VW"),
        (&["--to", "Main.Slow.Y", "--band", "10..1"], "the lower frequency is first"),
        (&["--to", "Main.Slow.Y", "--band", "1"], "write lowest and highest frequency"),
        (&["--to", "Main.Slow.Y", "--amplitude", "0"], "an amplitude is above 0"),
        (&["--to", "Main.Slow.Y", "--offset", "1e39"], "no number that a REAL can hold"),
        (&["--to", "Main.Slow.Y", "-o", "f.st"], "f.st"),
        (&["--to", "Main.Slow.Y", "-o", "f.pdf"], "name it .csv, .svg or .txt"),
    ] {
        let (code, output, errors) = sweep(&folder, more);
        assert_eq!((code, &*output), (Some(2), ""), "{more:?}");
        assert!(errors.contains(expected), "{more:?}: {errors}");
    }
    let written = ["sweep", "f.st", "--excite", "Main.Error", "--to", "Main.Measure"];
    let (code, _, errors) = told(&folder.sim(&written));
    assert!(code == Some(2) && errors.contains("itself, so the sine does not stay"), "{errors}");
    assert_eq!(folder.names(), ["f.st"]);
}
