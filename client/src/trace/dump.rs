//! Value change dumps (IEEE 1364) of rows of values, as viewers of waveforms read them.

use std::io::{self, Write};

use vcd::{IdCode, TimescaleUnit, Value, VarType, Writer};

use crate::operand::Operand;
use crate::value::Form;

/// A dump that is being written, row by row. Only what is different from the row before is in it.
pub struct Dump<'a> {
    writer: Writer<&'a mut dyn Write>,
    waves: Vec<Wave>,
    trigger: Option<(IdCode, Option<bool>)>,
}

/// An operand in the dump.
struct Wave {
    code: IdCode,
    form: Form,
    /// What was written last; `Some(None)`: that nothing is known.
    last: Option<Option<u32>>,
}

impl<'a> Dump<'a> {
    /// Writes what is at the beginning. `has_trigger`: a wave more says which row the trigger was.
    pub fn begin(
        operands: &[Operand],
        has_trigger: bool,
        out: &'a mut dyn Write,
    ) -> io::Result<Dump<'a>> {
        let mut writer = Writer::new(out);
        writer.version("uno200")?;
        writer.timescale(1, TimescaleUnit::US)?;
        writer.add_module("plc")?;
        let mut waves = Vec::new();
        for operand in operands {
            let code = add_wave(&mut writer, operand)?;
            waves.push(Wave { code, form: operand.form, last: None });
        }
        let trigger = match has_trigger {
            true => Some((writer.add_var(VarType::Wire, 1, "trigger", None)?, None)),
            false => None,
        };
        writer.upscope()?;
        writer.enddefinitions()?;
        Ok(Dump { writer, waves, trigger })
    }

    /// The raw values from this time on, in the order of the operands; `None`: nothing is known of
    /// them. Times never decrease.
    pub fn row(&mut self, at_us: u64, values: Option<&[u32]>, is_trigger: bool) -> io::Result<()> {
        let mut changes = Vec::new();
        for (index, wave) in self.waves.iter_mut().enumerate() {
            let value = values.and_then(|values| values.get(index).copied());
            if wave.last.replace(value) != Some(value) {
                changes.push((wave.code, wave.form, value));
            }
        }
        let trigger = self.trigger.as_mut();
        let trigger = trigger
            .filter(|(_, last)| *last != Some(is_trigger))
            .map(|(code, last)| (*code, *last.insert(is_trigger)));
        if changes.is_empty() && trigger.is_none() {
            return Ok(());
        }
        self.writer.timestamp(at_us)?;
        for (code, form, value) in changes {
            self.change(code, form, value)?;
        }
        match trigger {
            Some((code, is_on)) => self.writer.change_scalar(code, Value::from(is_on)),
            None => Ok(()),
        }
    }

    /// Viewers end the waves at the last time stamp.
    pub fn end(mut self, at_us: u64) -> io::Result<()> {
        self.writer.timestamp(at_us)
    }

    fn change(&mut self, code: IdCode, form: Form, value: Option<u32>) -> io::Result<()> {
        match form {
            Form::Bit => {
                let value = value.map_or(Value::X, |value| Value::from(value != 0));
                self.writer.change_scalar(code, value)
            }
            Form::Real => {
                let real = value.map_or(f64::NAN, |value| f64::from(f32::from_bits(value)));
                self.writer.change_real(code, real)
            }
            Form::Byte | Form::Word | Form::Double => {
                let bit = |bit: u32| match value {
                    Some(value) => Value::from(value >> bit & 1 == 1),
                    None => Value::X,
                };
                let bits = 8 * form.bytes() as u32;
                self.writer.change_vector(code, (0..bits).rev().map(bit))
            }
        }
    }
}

fn add_wave(writer: &mut Writer<&mut dyn Write>, operand: &Operand) -> io::Result<IdCode> {
    // A point would separate levels of the hierarchy.
    let name: String =
        operand.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let (kind, bits) = match operand.form {
        Form::Bit => (VarType::Wire, 1),
        Form::Byte => (VarType::Reg, 8),
        // Viewers show integers as signed decimals.
        Form::Word => (VarType::Integer, 16),
        Form::Double => (VarType::Integer, 32),
        Form::Real => (VarType::Real, 64),
    };
    writer.add_var(kind, bits, &name, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_is_not_made_up() {
        let operands = ["Q0.0", "VB0", "VD4:real"].map(|name| Operand::parse(name, &[]).unwrap());
        let mut out = Vec::new();
        let mut dump = Dump::begin(&operands, false, &mut out).unwrap();
        let known = [1, 5, 1.5f32.to_bits()];
        for (at_us, values) in [(0, Some(&known[..])), (10, None), (20, None), (30, Some(&known))] {
            dump.row(at_us, values, false).unwrap();
        }
        dump.end(40).unwrap();
        let text = String::from_utf8(out).unwrap();
        let (_, waves) = text.split_once("$enddefinitions $end").unwrap();
        let words: Vec<&str> = waves.split_whitespace().collect();
        let expected = "#0 1! b00000101 \" r1.5 # #10 x! bxxxxxxxx \" rNaN # \
            #30 1! b00000101 \" r1.5 # #40";
        assert_eq!(words.join(" "), expected);
    }
}
