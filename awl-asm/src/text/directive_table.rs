//! The words of `//#` lines: how each is written, and what it means. They are read elsewhere.

/// A word of `//#` lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Directive {
    /// The word.
    pub word: &'static str,
    /// An example of all that is after `//#`.
    pub example: &'static str,
    /// What it means, in a sentence or two.
    pub doc: &'static str,
}

const fn row(word: &'static str, example: &'static str, doc: &'static str) -> Directive {
    Directive { word, example, doc }
}

/// All of them (docs/language.md has more about each).
pub const DIRECTIVES: [Directive; 18] = [
    row("allow", "allow W0008 W0002", "These warnings are not given for this program."),
    row(
        "board",
        "board uno",
        "The program is for this board and must fit it everywhere. Without this line what the Uno \
         is too small for runs on the host, with a warning.",
    ),
    row("pullup", "pullup I0.0-I0.5", "These inputs have their pull-up resistor on."),
    row(
        "invert",
        "invert I0.3, Q0.0-Q0.4",
        "These points are inverted at the pin. An inverted output that is off has a high pin.",
    ),
    row(
        "retain",
        "retain VB0-VB31, C0-C9, MB0-MB13",
        "These values are kept without power; of timers those of TONR. At most 16 ranges.",
    ),
    row(
        "memory",
        "memory VB0-VB99",
        "These V bytes exist even if no instruction names them: for pointers and tables.",
    ),
    row("watchdog", "watchdog 500ms", "The longest execution of a scan, 1 ms to 60 s."),
    row("scan", "scan 10ms", "A fixed time from scan start to scan start."),
    row(
        "filter",
        "filter 8",
        "Analog inputs are smoothed over so many samples: 1, 2, 4, 8, 16, 32 or 64.",
    ),
    row(
        "modbus",
        "modbus address 5 baud 19200 parity even",
        "How the serial line is set. What is not named is address 1, 115200 baud, parity none.",
    ),
    row("name", "name \"mixer\"", "The name of the program, up to 24 characters."),
    row(
        "symbol",
        "symbol Start I0.0 the green button",
        "A name for an address, a constant or a routine, with a comment.",
    ),
    row(
        "var",
        "var Speed INT := 5 RETAIN // rpm",
        "A variable by name and type: the assembler finds its place. Types are BOOL BYTE CHAR WORD \
         INT DWORD DINT REAL TIME STRING[20], and ARRAY[0..9] OF each.",
    ),
    row(
        "timer",
        "timer Delay 10ms",
        "A timer by name and resolution (1ms, 10ms, 100ms): the assembler finds its number. One of \
         TON and TOF, unless TONR is after it.",
    ),
    row(
        "counter",
        "counter Parts",
        "A counter by name: the assembler finds its number. RETAIN keeps its value without power.",
    ),
    row(
        "source",
        "source pump.st:12:3",
        "What follows was made from this place of another text or drawing, up to the next such \
         line.",
    ),
    row(
        "bound",
        "bound 10",
        "The loop or the jump back after this line is gone through so many times at most: for the \
         longest scan.",
    ),
    row(
        "rate",
        "rate 1000",
        "The interrupt routine of the ATCH after this line is called so many times a second at \
         most: for the longest scan.",
    ),
];

/// The words alone.
pub(crate) const WORDS: [&str; DIRECTIVES.len()] = {
    let mut words = [""; DIRECTIVES.len()];
    let mut index = 0;
    while index < words.len() {
        words[index] = DIRECTIVES[index].word;
        index += 1;
    }
    words
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use crate::text::parser::parse;

    #[test]
    fn every_example_is_read() {
        for Directive { word, example, .. } in DIRECTIVES {
            assert!(example.starts_with(word), "{example}");
            let text = format!("//# {example}\nLD SM0.0\n");
            let (_, diagnostics) = parse(&Source::new("t.awl", text).unwrap(), Vec::new());
            assert!(diagnostics.is_empty(), "{example}: {diagnostics:?}");
        }
    }

    #[test]
    fn the_page_of_the_language_has_every_word() {
        let page = include_str!("../../../docs/language.md");
        for word in WORDS {
            assert!(page.contains(&format!("//# {word}")), "{word}");
        }
    }
}
