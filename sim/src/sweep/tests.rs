//! Frequency responses of known paths against what mathematics says of them, and what cannot be
//! measured.

use std::f64::consts::TAU;

use super::*;
use crate::machine::fake::{Fake, Memory, operand};
use crate::operand::real_of;

/// Of what is set and read as reals in VD0 and VD4.
fn wanted(frequencies: Vec<f64>) -> Sweep {
    Sweep {
        excite: operand("VD0:real"),
        from: operand("VD0:real"),
        to: operand("VD4:real"),
        frequencies,
        amplitude: 2.0,
        offset: 5.0,
        rest_ms: None,
        scan_ms: 10,
    }
}

fn measured(machine: &mut Fake, wanted: &Sweep) -> Result<Vec<Point>, SweepError> {
    sweep(machine, wanted, &Scenario::default(), None, &mut |_| {})
}

fn set(memory: &mut Memory, name: &str, value: f32) {
    memory.set(name, value_of(value));
}

/// y = y + part (x - y) in every scan.
fn lag(part: f32) -> Fake {
    Fake::new(move |_, memory| {
        let [x, y] = ["VD0:real", "VD4:real"].map(|name| real_of(memory.get(name)));
        set(memory, "VD4:real", y + part * (x - y));
    })
}

#[test]
fn a_lag_has_the_gain_and_phase_of_its_equation() {
    let points = measured(&mut lag(0.1), &wanted(spread(0.1, 40.0, 30))).unwrap();
    assert_eq!(points.len(), 30);
    for point in points {
        // 0.1 / (1 - 0.9 / z) with z one scan on.
        let (sine, cosine) = (TAU * point.hertz * 0.01).sin_cos();
        let (real, imaginary) = (1.0 - 0.9 * cosine, 0.9 * sine);
        let (gain, phase) = (0.1 / real.hypot(imaginary), -imaginary.atan2(real).to_degrees());
        assert!((point.gain / gain - 1.0).abs() < 1e-4, "{point:?}, {gain}");
        assert!((point.phase.unwrap() - phase).abs() < 0.01, "{point:?}, {phase}");
        assert!(point.distortion < 1e-4 && point.is_settled, "{point:?}");
    }
}

#[test]
fn a_delay_turns_the_phase_on_and_on() {
    let mut held = [0; 10];
    let mut machine = Fake::new(move |_, memory| {
        held.rotate_right(1);
        memory.set("VD4:real", held[0]);
        held[0] = memory.get("VD0:real");
    });
    for point in measured(&mut machine, &wanted(spread(1.0, 45.0, 40))).unwrap() {
        assert!((point.gain - 1.0).abs() < 1e-5, "{point:?}");
        assert!((point.phase.unwrap() + 3.6 * 10.0 * point.hertz).abs() < 0.01, "{point:?}");
    }
}

#[test]
fn what_bends_the_sine_is_distortion() {
    let mut machine = Fake::new(|_, memory| {
        let x = f64::from(real_of(memory.get("VD0:real"))) - 5.0;
        set(memory, "VD4:real", (x.powi(3) / 4.0) as f32);
    });
    let points = measured(&mut machine, &wanted(vec![1.0])).unwrap();
    // The cube of a sine has a third of its fundamental at three times the frequency.
    assert!((points[0].gain - 0.75).abs() < 1e-6, "{points:?}");
    assert!((points[0].distortion - 1.0 / 3.0).abs() < 1e-6, "{points:?}");
}

#[test]
fn what_never_repeats_is_not_settled() {
    let mut noise = fastrand::Rng::with_seed(7);
    let mut machine = Fake::new(move |_, memory| {
        let x = real_of(memory.get("VD0:real"));
        set(memory, "VD4:real", x + noise.f32());
    });
    assert!(!measured(&mut machine, &wanted(vec![1.0])).unwrap()[0].is_settled);
}

#[test]
fn nothing_comes_out_of_what_is_cut() {
    let mut machine = Fake::new(|_, _| {});
    let point = measured(&mut machine, &wanted(vec![1.0])).unwrap()[0];
    assert_eq!((point.gain, point.phase, point.distortion), (0.0, None, 0.0));
    assert_eq!(point.decibels(), f64::NEG_INFINITY);
}

#[test]
fn whole_numbers_are_rounded() {
    let mut machine = Fake::new(|_, memory| memory.set("VW4", memory.get("VW0") / 2));
    let one = Sweep {
        excite: operand("VW0"),
        from: operand("VW0"),
        to: operand("VW4"),
        amplitude: 1000.0,
        ..wanted(vec![0.5])
    };
    let point = measured(&mut machine, &one).unwrap()[0];
    assert!((point.gain - 0.5).abs() < 1e-3, "{point:?}");
}

#[test]
fn what_cannot_be_measured_says_why() {
    let told = |machine: &mut Fake, wanted: &Sweep| {
        measured(machine, wanted).map(|_| String::new()).unwrap_or_else(|error| error.to_string())
    };
    let reals = || wanted(vec![1.0]);
    let machine = &mut lag(0.1);
    let bit = Sweep { excite: operand("M0.0"), ..reals() };
    assert_eq!(told(machine, &bit), "M0.0 is a bit, which cannot follow a sine: excite a number");
    let byte = Sweep { excite: operand("VB0"), offset: 1.0, ..reals() };
    assert_eq!(told(machine, &byte), "the sine leaves 0 to 255, which is what VB0 can be");
    let fast = wanted(vec![1.0, 50.0]);
    assert_eq!(
        told(machine, &fast),
        "50.00 Hz needs more than two scans a period: with this scan time less than 50.00 Hz"
    );
    let still = Sweep { from: operand("VD8:real"), ..reals() };
    assert_eq!(
        told(machine, &still),
        "VD8:real does not follow the sine at 1.000 Hz: the path cannot begin there"
    );
    let writes = &mut Fake::new(|_, memory| set(memory, "VD0:real", 1.0));
    assert!(told(writes, &reals()).starts_with("the program writes VD0:real itself"));
    let faulty = &mut lag(0.1);
    faulty.fault_at_ms = Some(500);
    assert!(
        told(faulty, &reals()).starts_with("PLC fault at 500ms: "),
        "{}",
        told(faulty, &reals())
    );
}

/// Points of 1 / (s (1 + s)^2), a loop with known margins.
fn known_loop() -> Vec<Point> {
    let points = spread(0.01, 1.0, 400).into_iter().map(|hertz| {
        let omega = TAU * hertz;
        Point {
            hertz,
            gain: 1.0 / (omega * (1.0 + omega * omega)),
            phase: Some(-90.0 - 2.0 * omega.atan().to_degrees()),
            distortion: 0.0,
            is_settled: true,
        }
    });
    points.collect()
}

#[test]
fn margins_are_those_of_the_loop() {
    let figures = Figures::of(&known_loop());
    let near = |crossing: Option<Crossing>, omega: f64, margin: f64| {
        let Crossing { hertz, margin: found } = crossing.unwrap();
        assert!((hertz * TAU - omega).abs() < 1e-3, "{hertz}");
        assert!((found - margin).abs() < 0.02, "{found}");
    };
    near(figures.gain_crossover, 0.682_33, 21.39);
    near(figures.phase_crossover, 1.0, 6.0206);
    assert_eq!(Figures::of(&known_loop()[..3]).gain_crossover, None);
    assert_eq!(Figures::of(&[]), Figures::default());
}

fn text(write: impl Fn(&mut dyn std::io::Write) -> std::io::Result<()>) -> String {
    let mut out = Vec::new();
    write(&mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn a_table_is_read_and_a_list_computed_with() {
    let mut points = known_loop()[..2].to_vec();
    points[1] = Point { gain: 0.0, phase: None, is_settled: false, ..points[1] };
    let expected = "   frequency          gain       phase   distortion
   10.00 mHz      24.00 dB      -97.2°        0.0 %
   10.12 mHz       -inf dB           -        0.0 %  not settled

bandwidth (-3 dB): 10.00 mHz
";
    assert_eq!(text(|out| table::write(&points, out)), expected);
    let list = text(|out| table::write_csv(&points, out));
    let rows: Vec<&str> = list.lines().collect();
    assert_eq!(rows[0], "frequency_hz,gain,gain_db,phase_deg,distortion,settled");
    assert!(rows[1].starts_with("0.01,15.85") && rows[1].ends_with(",0,1"), "{list}");
    assert!(rows[2].contains(",0,,,0,0"), "{list}");
}

#[test]
fn frequencies_have_four_digits() {
    let told = [0.000_1, 0.05, 0.999_9, 12.345, 123.45, 500.0].map(table::hertz);
    assert_eq!(told, ["0.100 mHz", "50.00 mHz", "1.000 Hz", "12.35 Hz", "123.5 Hz", "500.0 Hz"]);
}

#[test]
fn a_plot_has_both_curves_and_the_figures() {
    let plot = || text(|out| bode::write(&known_loop(), "a <b>", out));
    for part in ["a &lt;b&gt;", "gain in dB", "phase in degrees", "10 mHz", "1 Hz", "\n-180\n"] {
        assert!(plot().contains(part), "{part} is not in\n{}", &plot()[..3000]);
    }
    assert!(plot().contains("phase margin 21.4°"));
    assert_eq!(plot().matches("<polyline").count(), 2);
    assert_eq!(plot(), plot());
    // One frequency, no phase, nothing that comes out: a plot is there nevertheless.
    let none = Point { gain: 0.0, phase: None, ..known_loop()[0] };
    assert!(text(|out| bode::write(&[none], "", out)).contains("</svg>"));
}
