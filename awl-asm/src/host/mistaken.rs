//! Files that are named as programs and are something else, as their ending or their first
//! statement says: a scenario, a plant, a symbol table. They are not read further.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::text::address::Address;

/// What a file is that is no program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Scenario,
    Plant,
    SymbolTable,
}

/// Endings by which files are known. Those of symbol tables need rows that are theirs, too.
const ENDINGS: [(&str, Kind); 2] = [("scn", Kind::Scenario), ("plant", Kind::Plant)];
/// So much of a file is looked at, in bytes.
const HEAD: usize = 4096;

/// Refuses a file that is no program and says where it belongs. `bytes`: what is in it; `all`: all
/// files that are named as the program.
pub fn ensure_program(path: &Path, bytes: &[u8], all: &[PathBuf]) -> Result<()> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    let Some(kind) = kind(path, &head) else { return Ok(()) };
    let is_other = |other: &&PathBuf| {
        let ending = other.extension().unwrap_or_default();
        ENDINGS.iter().all(|(known, _)| !ending.eq_ignore_ascii_case(known)) && **other != path
    };
    let others: Vec<String> =
        all.iter().filter(is_other).map(|other| other.display().to_string()).collect();
    let program = match others.is_empty() {
        true => path.with_extension("awl").display().to_string(),
        false => others.join(" "),
    };
    let file = path.display();
    match kind {
        Kind::Scenario => bail!("{file} is a scenario: `awl-sim {program} --scenario {file}`"),
        Kind::Plant => bail!("{file} is a plant: `awl-sim {program} --plant {file}`"),
        Kind::SymbolTable => {
            bail!("{file} is a symbol table, which goes with a program: `--symbols {file}`")
        }
    }
}

fn kind(path: &Path, head: &str) -> Option<Kind> {
    let ending = path.extension().unwrap_or_default();
    let known = ENDINGS.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known));
    if let Some((_, kind)) = known {
        return Some(*kind);
    }
    let mut lines = head.lines().map(|line| line.trim_start_matches('\u{feff}').trim());
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'))?;
    if is_row(first) { Some(Kind::SymbolTable) } else { kind_of_statement(first) }
}

/// A row of a symbol table: a name, a comma or the like, an address. With a tab between them it
/// could be an instruction.
fn is_row(line: &str) -> bool {
    let mut fields = line.split([',', ';']).map(|field| field.trim().trim_matches('"'));
    let is_name = |name: &str| !name.is_empty() && !name.contains([' ', '\t', ':', '=']);
    fields.next().is_some_and(is_name)
        && fields.next().is_some_and(|address| Address::parse(address).is_ok())
}

fn kind_of_statement(line: &str) -> Option<Kind> {
    let mut words = line.split_whitespace();
    let first = words.next()?.to_ascii_lowercase();
    let (second, third) = (words.next()?, words.next().unwrap_or(""));
    let is_text = |word: &str| word.starts_with('"');
    let is_range = |word: &str| {
        word.split_once("..").is_some_and(|(low, high)| is_number(low) && is_number(high))
    };
    match first.as_str() {
        "at" | "every" | "scan" | "run" if is_time(second) => Some(Kind::Scenario),
        "always" | "never" | "until" if line.contains('=') => Some(Kind::Scenario),
        "goal" if is_text(second) => Some(Kind::Scenario),
        "program" if second.trim_matches('"').ends_with(".awl") => Some(Kind::Scenario),
        "plant" if is_text(second) => Some(Kind::Plant),
        "part" | "belt" if is_range(third) => Some(Kind::Plant),
        "button" | "switch" | "slider" | "fault" | "count" if is_text(third) => Some(Kind::Plant),
        "outputs" if second == "inverted" => Some(Kind::Plant),
        _ => None,
    }
}

fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok()
}

/// `500ms`, `+2s`.
fn is_time(text: &str) -> bool {
    let unit_at = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, units) = text.split_at(unit_at);
    is_number(number) && ["ms", "s", "min", "h"].iter().any(|unit| units.starts_with(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(file: &str, text: &str, all: &[&str]) -> String {
        let all: Vec<PathBuf> = all.iter().map(PathBuf::from).collect();
        let result = ensure_program(Path::new(file), text.as_bytes(), &all);
        result.err().map_or_else(String::new, |error| error.to_string())
    }

    #[test]
    fn by_the_ending() {
        let scenario = "lamp.scn is a scenario: `awl-sim lamp.awl --scenario lamp.scn`";
        assert_eq!(told("lamp.scn", "", &["lamp.scn"]), scenario);
        assert_eq!(
            told("lamp.scn", "", &["main.awl", "sbr0.awl", "lamp.scn"]),
            "lamp.scn is a scenario: `awl-sim main.awl sbr0.awl --scenario lamp.scn`"
        );
        assert_eq!(
            told("a/door.PLANT", "", &["a/door.PLANT", "a/door.scn"]),
            "a/door.PLANT is a plant: `awl-sim a/door.awl --plant a/door.PLANT`"
        );
    }

    #[test]
    fn by_the_first_statement() {
        for text in ["# start\n\nat 1s I0.0 = 1\n", "AT 500ms expect Q0.0 = 1", "scan 5ms\n"]
            .into_iter()
            .chain(["every 1min30s I0.0 = 1", "goal \"on\"", "never Q0.0 = 1", "program m.awl"])
        {
            assert!(told("x.txt", text, &[]).starts_with("x.txt is a scenario: "), "{text}");
        }
        for text in ["plant \"Door\"\n", "part Door 0..100\n", "button Up \"up\"\n"] {
            assert!(told("x.txt", text, &[]).starts_with("x.txt is a plant: "), "{text}");
        }
        for text in ["Lamp,Q0.1,the lamp\n", "\"Start\";\"I0.0\";\"\"\n"] {
            let expected = "t.csv is a symbol table, which goes with a program: `--symbols t.csv`";
            assert_eq!(told("t.csv", text, &[]), expected);
        }
    }

    #[test]
    fn programs_are_none_of_them() {
        for text in [
            "",
            "NETWORK 1\nLD I0.0\n",
            "LD\tI0.0\n",
            "TON T37, 20\n",
            "MOVW VW0, MW0\n",
            "PROGRAM Main\nVAR\n",
            "// at 1s\nLD I0.0\n",
            "# at 1s\n",
            "VB0 1, 2\n",
            "//# symbol Lamp Q0.0\n",
            "A I0.0, I0.1\n",
        ] {
            assert_eq!(told("p.awl", text, &[]), "", "{text}");
        }
    }
}
