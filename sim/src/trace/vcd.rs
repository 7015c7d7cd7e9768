//! The trace as a value change dump (IEEE 1364), for GTKWave and other wave viewers.

use std::io::{self, Write};

use vcd::{IdCode, TimescaleUnit, Value, VarType, Writer};

use super::{Signal, Trace};
use crate::operand::{Width, real_of};

/// Writes the trace. Values are at the start of the scan that made them; words are two's
/// complement.
pub fn write(trace: &Trace, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = Writer::new(out);
    writer.version("awl-sim")?;
    writer.timescale(1, TimescaleUnit::MS)?;
    writer.add_module("plc")?;
    let codes = declare(&mut writer, trace.signals())?;
    writer.upscope()?;
    writer.enddefinitions()?;
    let mut steps = trace.steps();
    let mut shown: Vec<Option<i32>> = vec![None; codes.len()];
    let mut is_first = true;
    while let Some(scan) = steps.advance() {
        writer.timestamp(scan * trace.scan_ms())?;
        if is_first {
            writer.begin(vcd::SimulationCommand::Dumpvars)?;
        }
        for (index, &value) in steps.values().iter().enumerate() {
            if shown[index] != Some(value) {
                shown[index] = Some(value);
                change(&mut writer, codes[index], trace.signals()[index].operand.width(), value)?;
            }
        }
        if std::mem::take(&mut is_first) {
            writer.end()?;
        }
    }
    // Viewers end the waves at the last time stamp.
    writer.timestamp(trace.scans() * trace.scan_ms())
}

fn declare(writer: &mut Writer<&mut dyn Write>, signals: &[Signal]) -> io::Result<Vec<IdCode>> {
    let mut names: Vec<String> = Vec::new();
    let mut codes = Vec::new();
    for signal in signals {
        let mut name = identifier(&signal.name);
        while names.contains(&name) {
            name.push('_');
        }
        let (kind, bits) = match signal.operand.width() {
            Width::Bit => (VarType::Wire, 1),
            Width::Byte => (VarType::Reg, 8),
            // Viewers show integers as signed decimals.
            Width::Word => (VarType::Integer, 16),
            Width::Double => (VarType::Integer, 32),
            Width::Real => (VarType::Real, 64),
        };
        codes.push(writer.add_var(kind, bits, &name, None)?);
        names.push(name);
    }
    Ok(codes)
}

/// A point would separate levels of the hierarchy, a blank would end the name. Umlauts are written
/// out, so that names stay readable and different.
fn identifier(name: &str) -> String {
    let mut identifier = String::new();
    for c in name.chars() {
        match c {
            'ä' => identifier.push_str("ae"),
            'ö' => identifier.push_str("oe"),
            'ü' => identifier.push_str("ue"),
            'Ä' => identifier.push_str("Ae"),
            'Ö' => identifier.push_str("Oe"),
            'Ü' => identifier.push_str("Ue"),
            'ß' => identifier.push_str("ss"),
            c if c.is_ascii_alphanumeric() => identifier.push(c),
            _ => identifier.push('_'),
        }
    }
    identifier
}

fn change(
    writer: &mut Writer<&mut dyn Write>,
    code: IdCode,
    width: Width,
    value: i32,
) -> io::Result<()> {
    let bits = match width {
        Width::Bit => return writer.change_scalar(code, Value::from(value != 0)),
        Width::Byte => 8,
        Width::Word => 16,
        Width::Double => 32,
        Width::Real => return writer.change_real(code, f64::from(real_of(value))),
    };
    writer.change_vector(code, (0..bits).rev().map(|bit| Value::from(value >> bit & 1 == 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::test_traces::trace;

    #[test]
    fn exact_text() {
        let trace = trace(
            10,
            &[
                ("Q0.1", &[0, 1, 1]),
                ("MW3", &[-2, -2, 5]),
                ("MB9", &[255, 255, 255]),
                ("MD4:real", &[0x3FC0_0000; 3]),
            ],
        );
        let mut out = Vec::new();
        write(&trace, &mut out).unwrap();
        let expected = "\
$version
    awl-sim
$end
$timescale 1 ms $end
$scope module plc $end
$var wire 1 ! Q0_1 $end
$var integer 16 \" MW3 $end
$var reg 8 # MB9 $end
$var real 64 $ MD4_real $end
$upscope $end
$enddefinitions $end
#0
$dumpvars
0!
b1111111111111110 \"
b11111111 #
r1.5 $
$end
#10
1!
#20
b0000000000000101 \"
#30
";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }

    #[test]
    fn names_stay_different() {
        let trace = trace(1, &[("Q0.1", &[0]), ("q0.1", &[0]), ("Q0.1", &[1])]);
        let mut out = Vec::new();
        write(&trace, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(
            text.contains("! Q0_1 $") && text.contains("\" q0_1 $") && text.contains("# Q0_1_ $"),
            "{text}"
        );
    }

    #[test]
    fn umlauts_are_written_out() {
        let mut trace = trace(1, &[("Q0.1", &[0]), ("Q0.2", &[0]), ("Q0.3", &[1]), ("Q0.4", &[1])]);
        for (signal, name) in trace.signals.iter_mut().zip(["Füller", "Fäller", "Fueller", "Größe"])
        {
            signal.name = name.to_string();
        }
        let mut out = Vec::new();
        write(&trace, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        for name in ["! Fueller $", "\" Faeller $", "# Fueller_ $", "$ Groesse $"] {
            assert!(text.contains(name), "{name}: {text}");
        }
    }
}
