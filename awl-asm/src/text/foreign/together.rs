//! Lines of other languages that only mean something together: one answer for all of them. What
//! they are here is said where their language is.

use crate::text::address::Address;

/// Lines that are something together.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Together {
    /// What an S7-200 has not.
    pub(crate) message: &'static str,
    /// What they are here, a line each; empty where it is not known.
    pub(crate) code: Vec<String>,
    /// What else there is to say.
    pub(crate) help: Vec<String>,
    /// How many bytes of the text they are.
    pub(crate) len: usize,
    /// The mnemonic that takes their place for the logic stack.
    pub(crate) stand_in: Option<&'static str>,
}

/// What is before lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flow {
    /// The beginning of a network.
    None,
    /// A contact: what follows is executed with its power flow.
    Contact,
    /// The end of a rung.
    Done,
}

/// Instructions of a text: first word and operand of each line that has one, up to a setting.
pub(super) struct Lines<'t> {
    text: &'t str,
    /// Where the next line begins.
    next: usize,
    /// Where the last instruction ends.
    pub(super) end: usize,
}

impl<'t> Lines<'t> {
    pub(super) fn of(text: &'t str) -> Lines<'t> {
        Lines { text, next: 0, end: 0 }
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = (&'t str, &'t str);

    fn next(&mut self) -> Option<(&'t str, &'t str)> {
        loop {
            let begin = self.next;
            let rest = self.text.get(begin..).filter(|rest| !rest.is_empty())?;
            let line = rest.lines().next()?;
            if line.trim_start().starts_with("//#") {
                return None;
            }
            self.next = begin + rest.find('\n').map_or(rest.len(), |len| len + 1);
            let code = line.split_once("//").map_or(line, |(code, _)| code);
            let code = code.trim_end().trim_end_matches(';').trim_end();
            if !code.is_empty() {
                self.end = begin + code.len();
                let code = code.trim_start();
                let (word, operand) = code.split_once([' ', '\t']).unwrap_or((code, ""));
                return Some((word, operand.trim()));
            }
        }
    }
}

/// An address, if a text is one, with or without blanks in it: `T 5`.
pub(super) fn address(text: &str) -> Option<Address> {
    let bare: String = text.split_whitespace().collect();
    Address::parse(&bare).ok()
}
