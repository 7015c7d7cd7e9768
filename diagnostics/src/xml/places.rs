//! Where the characters of a text are in the file that it was read from: references such as `&lt;`
//! are longer there than what they stand for.

use crate::source::Span;

/// References to operators that XML does not know, and what is read in their place: as many bytes.
const OPERATORS: [(&str, &str); 2] = [("&ge;", "\u{2265} "), ("&le;", "\u{2264} ")];

/// How Structured Text writes what is read for an operator.
pub fn operator(character: char) -> Option<&'static str> {
    match character {
        '\u{2265}' => Some(">="),
        '\u{2264}' => Some("<="),
        _ => None,
    }
}

/// A file whose references XML knows, all places as they were.
pub fn with_known_references(file: &str) -> String {
    OPERATORS.iter().fold(file.to_owned(), |file, (name, text)| file.replace(name, text))
}

/// For each byte of a text where it is in the file.
#[derive(Debug, Clone)]
pub struct Places {
    whole: Span,
    starts: Vec<u32>,
}

impl Places {
    /// Those of a text. Where it cannot be found, all of it is at its place.
    pub fn of(text: &str, span: Span, file: &str) -> Places {
        let raw = with_known_references(span.text(file));
        let found = [true, false].into_iter().find_map(|is_attribute| {
            let (read, starts) = read(&raw, is_attribute);
            let first = read.find(text)?;
            Some(starts.get(first..=first + text.len())?.to_vec())
        });
        let starts = found.unwrap_or_default();
        let starts = starts.into_iter().map(|at| span.start + at).collect();
        Places { whole: span, starts }
    }

    /// All at one place.
    pub fn whole(place: Span) -> Places {
        Places { whole: place, starts: Vec::new() }
    }

    /// Those of what is behind an offset of the text.
    pub fn from(mut self, offset: usize) -> Places {
        self.starts.drain(..offset.min(self.starts.len()));
        self
    }

    /// Where a stretch of the text is.
    pub fn span(&self, inside: Span) -> Span {
        let at = |offset: u32| self.starts.get(offset as usize).copied();
        match (at(inside.start), at(inside.end)) {
            (Some(start), Some(end)) => Span { start, end },
            _ => self.whole,
        }
    }
}

/// A text as XML reads it, and where each byte of it begins, with the end.
fn read(raw: &str, is_attribute: bool) -> (String, Vec<u32>) {
    let (mut text, mut starts, mut at) = (String::new(), Vec::new(), 0);
    while let Some((mut character, len, is_written)) = unit(raw.get(at..).unwrap_or("")) {
        let start = at as u32;
        at += len;
        if character == '\r' {
            let next = unit(raw.get(at..).unwrap_or(""));
            if let Some((_, len, _)) = next.filter(|(next, ..)| *next == '\n') {
                at += len;
            }
            character = '\n';
        }
        if is_written && is_attribute && matches!(character, '\n' | '\t') {
            character = ' ';
        }
        match operator(character) {
            Some(operator) => text.push_str(operator),
            None => text.push(character),
        }
        starts.resize(text.len(), start);
    }
    starts.push(at as u32);
    (text, starts)
}

/// The next character, how many bytes it takes, and whether it is written as itself.
fn unit(raw: &str) -> Option<(char, usize, bool)> {
    let first = raw.chars().next()?;
    let reference = raw.strip_prefix('&').and_then(|rest| rest.split_once(';'));
    let known = reference.and_then(|(name, _)| Some((reference_to(name)?, name.len() + 2, false)));
    Some(known.unwrap_or((first, first.len_utf8(), true)))
}

fn reference_to(name: &str) -> Option<char> {
    Some(match name {
        "lt" => '<',
        "gt" => '>',
        "amp" => '&',
        "quot" => '"',
        "apos" => '\'',
        _ => {
            let number = name.strip_prefix('#')?;
            let number = match number.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16).ok()?,
                None => number.parse().ok()?,
            };
            char::from_u32(number)?
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_longer_in_the_file() {
        let file = "<T C=\" a &lt; b&#13;&#10;&amp; c&ge;5\"/>";
        let span = Span::new(6, file.len() - 3);
        let text = "a < b\n& c>= 5";
        let places = Places::of(text, span, file);
        let of = |word: &str| {
            let start = text.find(word).unwrap_or(0);
            places.span(Span::new(start, start + word.len())).text(file)
        };
        assert_eq!(["a", "<", "b", "&", "c", "5"].map(of), ["a", "&lt;", "b", "&amp;", "c", "5"]);
    }

    #[test]
    fn what_cannot_be_found_is_at_its_whole_place() {
        let places = Places::of("other", Span::new(1, 3), "abcd");
        assert_eq!(places.span(Span::new(0, 2)), Span::new(1, 3));
    }
}
