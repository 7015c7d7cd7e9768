//! `retained`: what the program retains without power, as a text file and back.

use std::io::{self, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use anyhow::{Context as _, Result, anyhow, bail};
use awl_asm::Address;
use awl_asm::files::{read, read_source, write_whole};
use client::Operand;
use client::compare::size;
use client::image::Image;
use client::service::SET_MAX;
use client::value::Base;
use plc_isa::{Area, Retained, UNO};

use super::context::Context;

/// Values in a line of the file.
const IN_LINE: usize = 16;

/// How long a board in STOP takes to find what has changed, with room to spare.
const COMPARING: Duration = Duration::from_millis(500);
/// How a file begins that `save` writes.
const HEAD: &str = "// Retentive memory of the program";

/// Whether the values can be saved to this file: one that is there must be one of those.
pub(super) fn check_output(path: &Path, overwrite: bool) -> Result<()> {
    if overwrite || !path.is_file() || read(path)?.starts_with(HEAD.as_bytes()) {
        return Ok(());
    }
    bail!("{} is another file; --overwrite replaces it", path.display())
}

pub(super) fn save(context: &mut Context, path: &Path) -> Result<bool> {
    let image = context.client.read_program()?;
    let rows = retained(&image)?;
    if rows.is_empty() {
        println!("the program retains nothing");
        return Ok(false);
    }
    let mut text = format!("{HEAD} with {}\n", size(&image));
    let identity = context.client.identify()?;
    if identity.is_running {
        anstream::eprintln!("the PLC is in RUN: values may be of different scans");
    }
    let mut count = 0;
    for row in rows.chunk_by(follows).flat_map(|run| run.chunks(IN_LINE)) {
        let mut values: Vec<String> = Vec::new();
        for operands in row.chunks(at_once(identity.room)) {
            let watched = context.client.watch_operands(operands)?;
            let texts = operands.iter().zip(watched.values);
            values.extend(texts.map(|(operand, value)| operand.form.text(value, Base::Decimal)));
        }
        count += row.len();
        text += &format!("{} {}\n", row[0].name, values.join(", "));
    }
    if path == Path::new("-") {
        io::stdout().write_all(text.as_bytes())?;
    } else {
        write_whole(path, text.as_bytes())?;
        eprintln!("{}: {count} values", path.display());
    }
    Ok(true)
}

/// How many bytes or words go into a request: a word to set takes five bytes.
fn at_once(room: u16) -> usize {
    (usize::from(room.saturating_sub(2)) / 5).clamp(1, SET_MAX)
}

/// The operands that the program of an image retains, in the order of its ranges.
fn retained(image: &[u8]) -> Result<Vec<Operand>> {
    if image.is_empty() {
        bail!("the PLC holds no program");
    }
    let plan = Image(image).plan()?;
    let mut operands = Vec::new();
    for Retained { area, first, count } in plan.retained() {
        for number in first..first.saturating_add(count) {
            let name = match (area, number as u8) {
                (Area::T, timer) if plan.timer_slot(timer).is_some() => format!("T{number}.cv"),
                (Area::C, counter) if plan.counter_slot(counter).is_some() => {
                    format!("C{number}.cv")
                }
                // What the program does not use has no memory.
                (Area::T | Area::C, _) => continue,
                (area, _) => Address::Byte { area, byte: number }.to_string(),
            };
            operands.push(Operand::parse(&name, &[])?);
        }
    }
    Ok(operands)
}

/// Whether a value can be after another in a line.
fn follows(a: &Operand, b: &Operand) -> bool {
    match (a.address, b.address) {
        (Address::Byte { area, byte }, Address::Byte { area: other, byte: next }) => {
            area == other && byte + 1 == next
        }
        _ => false,
    }
}

pub(super) fn restore(context: &mut Context, path: &Path) -> Result<bool> {
    let source = read_source(path)?;
    let mut values = Vec::new();
    for (number, line) in (1..).zip(source.lines()) {
        let line = line.split("//").next().unwrap_or("").trim();
        if !line.is_empty() {
            values
                .extend(assignments(line).with_context(|| format!("{}:{number}", path.display()))?);
        }
    }
    if values.is_empty() {
        bail!("{}: there are no values", path.display());
    }
    // All exist before the first is written.
    let identity = context.client.identify()?;
    for part in values.chunks(at_once(identity.room)) {
        let operands: Vec<Operand> = part.iter().map(|(operand, _)| operand.clone()).collect();
        context.client.watch_operands(&operands)?;
    }
    for part in values.chunks(at_once(identity.room)) {
        let pairs: Vec<_> =
            part.iter().map(|(operand, value)| (operand.reference, *value)).collect();
        context.client.set(&pairs)?;
    }
    println!("{} values written", values.len());
    wait_until_kept(context, identity.is_running)
}

/// Values that were written are lost when the power goes before they are in the EEPROM. In STOP
/// that is soon, and waited for; in RUN it is said when.
fn wait_until_kept(context: &mut Context, is_running: bool) -> Result<bool> {
    let image = context.client.read_program()?;
    let len = Image(&image).plan()?.retained_len();
    if len == 0 {
        eprintln!("the program retains nothing: without power the values are lost");
        return Ok(true);
    }
    let write_ms = UNO.retention_write_ms(len);
    if is_running {
        let seconds = (UNO.retention_interval_ms(len) + write_ms).div_ceil(1000);
        eprintln!(
            "they are kept without power when they are saved next, within {seconds} s; \
             `uno200 stop` has them saved at once"
        );
        return Ok(true);
    }
    sleep(Duration::from_millis(u64::from(write_ms)) + COMPARING);
    eprintln!("they are kept without power");
    Ok(true)
}

/// `VB0 1, 2, 3` and `C5.cv 17`.
fn assignments(line: &str) -> Result<Vec<(Operand, u32)>> {
    let (name, values) = line
        .split_once(char::is_whitespace)
        .ok_or_else(|| anyhow!("{line}: a value is missing"))?;
    let first = Operand::parse(name, &[])?;
    let mut result = Vec::new();
    for (index, text) in values.split(',').enumerate() {
        let operand = match (index, first.address) {
            (0, _) => first.clone(),
            (_, Address::Byte { area, byte }) => {
                let address = Address::Byte { area, byte: byte.saturating_add(index as u16) };
                Operand::at(&address.to_string(), address)?
            }
            _ => bail!("{name}: only bytes have several values in a line"),
        };
        let value =
            operand.form.parse(text).map_err(|error| anyhow!("{}: {error}", operand.name))?;
        result.push((operand, value));
    }
    Ok(result)
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;

    #[test]
    fn what_a_program_retains() {
        let text = "//# retain VB0-VB2, C0-C9, MB5\nLD I0.0\nLD I0.1\nCTU C3, 5\nLD SM0.0\n\
            MOVB 1, VB0\nMOVB 1, VB2\n";
        let image = assemble(&Source::new("p.awl", text).unwrap(), Vec::new()).image.unwrap();
        let names: Vec<String> =
            retained(&image).unwrap().into_iter().map(|operand| operand.name).collect();
        assert_eq!(names, ["VB0", "VB1", "VB2", "C3.cv", "MB5"]);
    }

    #[test]
    fn lines_of_the_file() {
        let shown = |line: &str| match assignments(line) {
            Ok(list) => {
                list.iter().map(|(operand, value)| format!("{}={value}", operand.name)).collect()
            }
            Err(error) => vec![error.to_string()],
        };
        assert_eq!(shown("VB0 1, 2, 16#FF"), ["VB0=1", "VB1=2", "VB2=255"]);
        assert_eq!(shown("C5.cv 17"), ["C5.cv=17"]);
        assert_eq!(shown("VB0"), ["VB0: a value is missing"]);
        assert_eq!(shown("VB0 1, 256"), ["VB1: 256 is out of range: 0 to 255"]);
        assert_eq!(shown("C5.cv 1, 2"), ["C5.cv: only bytes have several values in a line"]);
    }
}
