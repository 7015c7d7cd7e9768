//! Where the lines of a generated text come from: lines `//# source` in it say so. What they mean
//! to people who read a message is not known here.

use crate::source::{At, Place};

/// What such a line begins with.
const MARK: &str = "//# source";

/// The lines `//# source` of a text, in order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Origins {
    /// Where each line begins, and what it says of the text after it.
    lines: Vec<(u32, Option<Place>)>,
}

impl Origins {
    /// Reads all of a text. One that says nothing that makes sense ends the one before it.
    pub(crate) fn of(text: &str) -> Origins {
        let marks = text.match_indices(MARK).filter_map(|(at, _)| {
            let before = text.get(..at)?.trim_end_matches([' ', '\t']);
            let is_line = before.is_empty() || before.ends_with(['\n', '\r']);
            let rest = text.get(at + MARK.len()..)?.split(['\n', '\r']).next()?;
            let is_word = rest.is_empty() || rest.starts_with(char::is_whitespace);
            (is_line && is_word).then(|| (at as u32, parse_place(without_comment(rest))))
        });
        Origins { lines: marks.collect() }
    }

    /// Where what is at an offset comes from.
    pub(crate) fn at(&self, offset: usize) -> Option<&Place> {
        let after = self.lines.partition_point(|&(start, _)| start as usize <= offset);
        self.lines.get(after.checked_sub(1)?)?.1.as_ref()
    }

    /// Ends the stretch that an offset is in, where another file begins.
    pub(crate) fn end_at(&mut self, offset: u32) {
        if !self.is_empty() {
            let before = self.lines.partition_point(|&(start, _)| start < offset);
            self.lines.insert(before, (offset, None));
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }
}

/// A file's name may have `//` in it, but no blank before.
fn without_comment(rest: &str) -> &str {
    let end = rest.find(" //").or_else(|| rest.find("\t//")).unwrap_or(rest.len());
    rest.get(..end).unwrap_or(rest)
}

/// Reads `FILE:LINE`, `FILE:LINE:COLUMN` or `FILE#ELEMENT`, each number from 1 on. `None` if it is
/// none of them.
pub fn parse_place(text: &str) -> Option<Place> {
    let text = text.trim();
    if let Some((file, element)) = text.rsplit_once('#')
        && !file.is_empty()
        && !element.is_empty()
    {
        return Some(Place { file: file.to_owned(), at: At::Element(element.to_owned()) });
    }
    let number = |digits: &str| {
        let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| digits.parse::<u32>().ok()).flatten().filter(|&number| number > 0)
    };
    let (rest, last) = text.rsplit_once(':')?;
    let last = number(last)?;
    let before = rest.rsplit_once(':').and_then(|(file, line)| Some((file, number(line)?)));
    let (file, line, column) = match before {
        Some((file, line)) => (file, line, Some(last as usize)),
        None => (rest, last, None),
    };
    (!file.is_empty())
        .then(|| Place { file: file.to_owned(), at: At::Line { line: line as usize, column } })
}

/// The line that begins a stretch of text that comes from a place, without line end; of `None` the
/// one that ends it.
pub fn source_line(place: Option<&Place>) -> String {
    place.map_or_else(|| MARK.to_owned(), |place| format!("{MARK} {place}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> String {
        parse_place(text).map_or_else(|| "none".to_owned(), |place| place.to_string())
    }

    #[test]
    fn places_read_as_they_are_shown() {
        for place in ["pump.st:12", "pump.st:12:3", "a b/pump.sfc#Fill", "C:\\x\\pump.st:7:1"] {
            assert_eq!(shown(place), place);
        }
        for wrong in ["", "pump.st", "pump.st:", "pump.st:0", "pump.st:x", ":3", "#Fill", "a#"] {
            assert_eq!(shown(wrong), "none", "{wrong}");
        }
    }

    #[test]
    fn a_line_holds_up_to_the_next() {
        let text = "LD I0.0\n//# source a.st:3\n= Q0.0\n  //# source a.sfc#Fill // a step\n\
            LD I0.1\n//# source\n= Q0.1\n//# source nonsense\n//# sources x:1\nx //# source b:1\n";
        let origins = Origins::of(text);
        let place = |needle: &str| {
            let found = text.find(needle).and_then(|at| origins.at(at));
            found.map_or_else(String::new, Place::to_string)
        };
        assert_eq!(place("LD I0.0"), "");
        assert_eq!(place("= Q0.0"), "a.st:3");
        assert_eq!(place("LD I0.1"), "a.sfc#Fill");
        assert_eq!(place("= Q0.1"), "");
        assert_eq!(place("b:1"), "");
        let line = source_line(parse_place("a.st:3:9").as_ref());
        assert_eq!(line, "//# source a.st:3:9");
        assert_eq!(source_line(None), "//# source");
        assert!(Origins::of("LD I0.0\n").is_empty());
    }
}
