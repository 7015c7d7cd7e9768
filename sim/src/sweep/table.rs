//! A frequency response as text: for reading with its figures, and as comma separated values.

use std::io::{self, Write};

use super::{Figures, Point};

/// A frequency with its unit, four digits of it.
pub fn hertz(hertz: f64) -> String {
    let (number, unit) = in_unit(hertz);
    let decimals = (3.0 - number.abs().log10().floor()).clamp(0.0, 3.0) as usize;
    format!("{number:.decimals$} {unit}")
}

/// A frequency in the unit that suits it.
pub(super) fn in_unit(hertz: f64) -> (f64, &'static str) {
    match hertz {
        1000.0.. => (hertz / 1000.0, "kHz"),
        0.1.. => (hertz, "Hz"),
        _ => (hertz * 1000.0, "mHz"),
    }
}

/// Writes a row a frequency, below them the figures.
pub fn write(points: &[Point], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{:>12}{:>14}{:>12}{:>13}", "frequency", "gain", "phase", "distortion")?;
    for point in points {
        let phase = point.phase.map_or("-".to_string(), |phase| format!("{phase:.1}°"));
        let note = if point.is_settled { "" } else { "  not settled" };
        writeln!(
            out,
            "{:>12}{:>14}{phase:>12}{:>13}{note}",
            hertz(point.hertz),
            format!("{:.2} dB", point.decibels()),
            format!("{:.1} %", point.distortion * 100.0)
        )?;
    }
    let lines = figures(points);
    if !lines.is_empty() {
        writeln!(out)?;
    }
    lines.iter().try_for_each(|line| writeln!(out, "{line}"))
}

/// The figures in words, a line each; those that the band does not show are left out.
pub fn figures(points: &[Point]) -> Vec<String> {
    let figures = Figures::of(points);
    let mut lines = Vec::new();
    if let Some(at) = figures.bandwidth {
        lines.push(format!("bandwidth (-3 dB): {}", hertz(at)));
    }
    if let Some(at) = figures.gain_crossover {
        let margin = format!("{:.1}°", at.margin);
        lines.push(format!("0 dB at {}: phase margin {margin}", hertz(at.hertz)));
    }
    if let Some(at) = figures.phase_crossover {
        let margin = format!("{:.1} dB", at.margin);
        lines.push(format!("-180° at {}: gain margin {margin}", hertz(at.hertz)));
    }
    lines
}

/// Writes `frequency_hz,gain,gain_db,phase_deg,distortion,settled`, a row a frequency. A phase that
/// there is not is empty; the gain in decibels is so too where nothing comes out.
pub fn write_csv(points: &[Point], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "frequency_hz,gain,gain_db,phase_deg,distortion,settled")?;
    for point in points {
        let known = |value: f64| if value.is_finite() { value.to_string() } else { String::new() };
        writeln!(
            out,
            "{},{},{},{},{},{}",
            point.hertz,
            point.gain,
            known(point.decibels()),
            point.phase.map_or_else(String::new, known),
            point.distortion,
            u8::from(point.is_settled)
        )?;
    }
    Ok(())
}
