//! The rule that a board is a value: what it has is in its profile, and nobody else knows its
//! numbers. What is for the Uno alone may.

/// Sources that must ask a profile.
const GENERAL: [&str; 6] =
    ["plc/", "runtime/src/", "awl-asm/src/", "sim/src/", "uno200/src/", "client/src/"];
/// Those among them that are for the Uno alone, or say what all boards have in common.
const OF_THE_UNO: [&str; 5] = [
    "plc/isa/src/profile.rs",
    "plc/isa/src/modules.rs",
    "plc/isa/src/layout.rs",
    "awl-asm/src/output/native/",
    "sim/src/machine/uno/",
];
/// Numbers and constants of the Uno.
const NUMBERS: [&str; 18] = [
    "m328p",
    "atmega328p",
    "0x0100",
    "0x0600",
    "0x6000",
    "0x7E00",
    "7680",
    "7_680",
    "DATA_END",
    "DATA_LEN",
    "SLOT_START",
    "SLOT_LEN",
    "SLOT_END",
    "DIGITAL_INPUTS",
    "DIGITAL_OUTPUTS",
    "RETENTION_LEN",
    "NATIVE_VECTORS",
    "JUMP_TABLE",
];

/// The lines of a file that know a board's number.
pub fn breaches(file: &str, text: &str) -> Vec<String> {
    let is_test = file.contains("/tests/") || file.ends_with("tests.rs");
    let is_bound = GENERAL.iter().any(|place| file.starts_with(place))
        && !OF_THE_UNO.iter().any(|place| file.starts_with(place));
    if !file.ends_with(".rs") || is_test || !is_bound {
        return Vec::new();
    }
    let mut breaches = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if line.contains("#[cfg(test)]") {
            break;
        }
        let code = line.split("//").next().unwrap_or_default();
        for number in words(code).filter(|word| NUMBERS.contains(word)) {
            let place = format!("{file}:{}", index + 1);
            breaches.push(format!("{place}: {number} is the Uno's; ask a profile"));
        }
    }
    breaches
}

/// The names and numbers in a line.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
}

#[cfg(test)]
mod tests {
    use super::breaches;

    #[test]
    fn numbers_of_the_uno_are_in_few_places() {
        let line = "let end = SLOT_START + COUNTER_SLOT_LEN; // 7680\n";
        assert_eq!(breaches("awl-asm/src/image/hex.rs", line).len(), 1);
        assert_eq!(breaches("sim/src/machine/uno/board.rs", line).len(), 0);
        assert_eq!(breaches("plc/link/tests/machine/mod.rs", line).len(), 0);
        assert_eq!(breaches("plc/vm/src/plc.rs", "use x::{A, DATA_END};\n").len(), 1);
    }
}
