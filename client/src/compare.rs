//! Is the program in the PLC the one in this file? If not: which networks, settings and data
//! differ. No connection here.

use awl_asm::disassemble::{disassemble, instructions};
use plc_isa::{CRC_LEN, ImageError, verify};
use similar::{Algorithm, DiffOp, capture_diff_slices};

use crate::image::{Image, Unreadable};
use crate::program::{InstructionPlace, Program};

/// What a comparison has found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// Whether it is the same program, byte by byte; translated to machine code counts too.
    pub is_same: bool,
    /// What there is to say, a line each.
    pub lines: Vec<String>,
}

/// Compares a program with the image in a PLC.
pub fn compare(program: &Program, image: &[u8]) -> Result<Comparison, Unreadable> {
    let same = |how: &str| Comparison {
        is_same: true,
        lines: vec![format!("the same program{how}, {}", size(image))],
    };
    let different = |lines| Ok(Comparison { is_same: false, lines });
    if image.is_empty() {
        return different(vec!["the PLC holds no program".to_string()]);
    }
    if image == program.image {
        return Ok(same(""));
    }
    if Image(image).plan()?.header.interface != 0 {
        return Ok(match program.native_image() {
            Some(native) if native == image => same(", translated to machine code"),
            _ => Comparison {
                is_same: false,
                lines: vec![format!(
                    "the PLC holds machine code ({}) that is not the translation of {}",
                    size(image),
                    program.source.name
                )],
            },
        });
    }
    let there = Text::of(image)?;
    let here = Text::of(&program.image)?;
    if has_only_another_name(&here, &there) {
        return Ok(Comparison {
            is_same: true,
            lines: vec![format!(
                "the same program, {}; its name is {:?} in the PLC and {:?} in {}",
                size(image),
                there.name,
                here.name,
                program.source.name
            )],
        });
    }
    let mut lines = frame_differences(&here, &there);
    lines.extend(network_differences(program, &here, &there));
    if lines.is_empty() {
        lines.push(
            "instructions, settings and data are the same, but encoded differently: by \
            another awl-asm?"
                .into(),
        );
    }
    let name = &program.source.name;
    let sizes = format!(
        "the program in the PLC is another one: {}; {name}: {}",
        size(image),
        size(&program.image)
    );
    lines.insert(0, sizes);
    different(lines)
}

/// Length and checksum of an image.
pub fn size(image: &[u8]) -> String {
    let crc =
        image.last_chunk::<{ CRC_LEN as usize }>().map_or(0, |bytes| u32::from_le_bytes(*bytes));
    format!("{} bytes, CRC {crc:08X}", image.len())
}

/// The setting of a program's name.
const NAME: &str = "//# name ";

/// An image as text.
struct Text {
    name: String,
    /// Offset and AWL of each instruction that a person wrote.
    code: Vec<(u16, String)>,
    /// Settings, one a line.
    settings: Vec<String>,
    /// Initial values, one a line.
    data: Vec<String>,
}

impl Text {
    fn of(image: &[u8]) -> Result<Text, Unreadable> {
        let fault = |error: ImageError| Unreadable { error, is_in_plc: false };
        let program = verify(image).map_err(fault)?;
        let visible = instructions(&program).into_iter().filter(|line| !line.text.is_empty());
        let code = visible.map(|line| (line.at, line.text)).collect();
        let name = program.plan().name().map(char::from).collect();
        let text = disassemble(image).map_err(fault)?;
        let settings =
            text.lines().filter(|line| line.starts_with("//#")).map(str::to_string).collect();
        let data = text
            .lines()
            .skip_while(|line| *line != "DATA_BLOCK")
            .filter(|line| line.starts_with("VB"));
        Ok(Text { name, code, settings, data: data.map(str::to_string).collect() })
    }
}

/// Whether two programs differ in their names and in nothing else.
fn has_only_another_name(here: &Text, there: &Text) -> bool {
    fn settings(text: &Text) -> impl Iterator<Item = &String> {
        text.settings.iter().filter(|line| !line.starts_with(NAME))
    }
    fn code(text: &Text) -> impl Iterator<Item = &String> {
        text.code.iter().map(|(_, line)| line)
    }
    here.name != there.name
        && settings(here).eq(settings(there))
        && code(here).eq(code(there))
        && here.data == there.data
}

/// Settings and initial values that only one of the two has.
fn frame_differences(here: &Text, there: &Text) -> Vec<String> {
    let mut lines = Vec::new();
    for (what, here, there) in
        [("setting", &here.settings, &there.settings), ("data", &here.data, &there.data)]
    {
        let only = |one: &[String], other: &[String], place: &str| -> Vec<String> {
            let missing = one.iter().filter(|line| !other.contains(line));
            missing
                .map(|line| {
                    format!("{what} only in the {place}: {}", line.trim_start_matches("//# "))
                })
                .collect()
        };
        lines.extend(only(here, there, "file"));
        lines.extend(only(there, here, "PLC"));
    }
    lines
}

/// The networks of the file in which instructions differ, each with its instructions and those of
/// the PLC.
fn network_differences(program: &Program, here: &Text, there: &Text) -> Vec<String> {
    let of = |text: &Text| text.code.iter().map(|(_, line)| line.clone()).collect::<Vec<String>>();
    let (ours, theirs) = (of(here), of(there));
    let places: Vec<InstructionPlace> = program.places().collect();
    let place_of = |index: usize| {
        let (at, _) = here.code.get(index)?;
        places.iter().find(|place| (place.offset..place.end).contains(at))
    };
    let mut lines: Vec<String> = Vec::new();
    let mut current = None;
    for op in capture_diff_slices(Algorithm::Myers, &ours, &theirs) {
        let (old, new) = match op {
            DiffOp::Equal { .. } => continue,
            DiffOp::Delete { old_index, old_len, new_index } => {
                (old_index..old_index + old_len, new_index..new_index)
            }
            DiffOp::Insert { old_index, new_index, new_len } => {
                (old_index..old_index, new_index..new_index + new_len)
            }
            DiffOp::Replace { old_index, old_len, new_index, new_len } => {
                (old_index..old_index + old_len, new_index..new_index + new_len)
            }
        };
        for index in old.clone() {
            let Some(place) = place_of(index) else { continue };
            enter(&mut current, network(program, place), &mut lines);
            lines.push(format!("  {}: {}", line(program, place.line), ours[index]));
        }
        if old.is_empty() {
            // What only the PLC has belongs to what is before it.
            let before = place_of(old.start.saturating_sub(1));
            enter(
                &mut current,
                before.map_or("the program".into(), |place| network(program, place)),
                &mut lines,
            );
        }
        lines.extend(theirs.get(new).unwrap_or(&[]).iter().map(|line| format!("  PLC: {line}")));
    }
    lines
}

fn enter(current: &mut Option<String>, network: String, lines: &mut Vec<String>) {
    if current.as_ref() != Some(&network) {
        lines.push(format!("{network} differs:"));
        *current = Some(network);
    }
}

/// The network of an instruction, with its unit where there are several.
fn network(program: &Program, place: &InstructionPlace) -> String {
    let units = &program.assembly.units;
    let unit = match units.of(place.index) {
        Some(part) if units.parts.len() > 1 => format!(" of {}", part.id),
        _ => String::new(),
    };
    match program.network_of(place.line) {
        Some(number) => format!("network {number}{unit}"),
        None => format!("{}{unit}", line(program, place.line).trim_start_matches("file, ")),
    }
}

/// The line of a file, as it is named beside the PLC.
fn line(program: &Program, line: usize) -> String {
    match program.source.line_in_file(line) {
        (name, line) if program.source.has_files() => format!("{name}, line {line}"),
        (_, line) => format!("file, line {line}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;

    fn program(text: &str) -> Program {
        Program::assembled(Source::new("p.awl", text).unwrap(), Vec::new()).unwrap()
    }

    const PROGRAM: &str = "//# watchdog 300ms\nNETWORK 1\nLD I0.0\nA I0.1\n= Q0.0\nNETWORK 2\n\
        LD I0.2\nTON T37, 10\n\
                           NETWORK 3\nLD T37\n= Q0.1\n";

    #[test]
    fn another_name_is_no_other_program() {
        let (here, there) = (PROGRAM.to_owned(), format!("//# name \"old\"\n{PROGRAM}"));
        let comparison = compare(&program(&here), &program(&there).image).unwrap();
        assert!(comparison.is_same, "{:?}", comparison.lines);
        assert!(comparison.lines[0].contains("\"old\" in the PLC"), "{:?}", comparison.lines);
    }

    fn lines(here: &str, there: &str) -> Vec<String> {
        let comparison = compare(&program(here), &program(there).image).unwrap();
        assert!(!comparison.is_same);
        comparison.lines.into_iter().skip(1).collect()
    }

    #[test]
    fn the_same_program_in_bytecode_and_machine_code() {
        let program = program(PROGRAM);
        assert!(compare(&program, &program.image).unwrap().is_same);
        let native = compare(&program, &program.native_image().unwrap()).unwrap();
        assert!(native.is_same && native.lines[0].contains("machine code"), "{native:?}");
    }

    #[test]
    fn the_network_that_differs_is_named() {
        let expected =
            ["network 2 differs:", "  file, line 8: TON   T37, 10", "  PLC: TON   T37, 20"];
        let squeezed = |lines: Vec<String>| -> Vec<String> {
            lines
                .iter()
                .map(|line| {
                    line.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
                })
                .collect()
        };
        let expected = squeezed(expected.map(str::to_string).to_vec());
        assert_eq!(squeezed(lines(PROGRAM, &PROGRAM.replace("37, 10", "37, 20"))), expected);
        let longer = squeezed(lines(PROGRAM, &PROGRAM.replace("A I0.1\n", "A I0.1\nAN I0.3\n")));
        assert_eq!(longer, ["network 1 differs:", "PLC: AN I0.3"]);
        let shorter = squeezed(lines(PROGRAM, &PROGRAM.replace("NETWORK 3\nLD T37\n= Q0.1\n", "")));
        assert_eq!(
            shorter,
            ["network 3 differs:", "file, line 10: LD T37", "file, line 11: = Q0.1"]
        );
    }

    #[test]
    fn settings_and_data_are_named() {
        let there = PROGRAM.replace("watchdog 300ms", "scan 10ms")
            + "DATA_BLOCK\nVB0 1, 2\nEND_DATA_BLOCK\n";
        let lines = lines(PROGRAM, &there);
        let expected = [
            "setting only in the file: watchdog 300ms",
            "setting only in the PLC: scan 10ms",
            "data only in the PLC: VB0 1, 2",
        ];
        for line in expected {
            assert!(lines.iter().any(|found| found == line), "{line}: {lines:#?}");
        }
        assert!(!lines.iter().any(|line| line.contains("differs:")), "{lines:#?}");
    }

    #[test]
    fn another_program_in_machine_code_and_none_at_all() {
        let other = program("LD I0.5\n= Q0.5\n").native_image().unwrap();
        let comparison = compare(&program(PROGRAM), &other).unwrap();
        assert!(
            !comparison.is_same && comparison.lines[0].contains("not the translation of p.awl"),
            "{comparison:?}"
        );
        assert_eq!(compare(&program(PROGRAM), &[]).unwrap().lines, ["the PLC holds no program"]);
        assert!(compare(&program(PROGRAM), &[0xFF; 100]).is_err());
    }
}
