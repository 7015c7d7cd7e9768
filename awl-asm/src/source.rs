//! A source text with its name and line starts: decoding, and offsets to lines and columns. No parsing.

use std::fmt;

use crate::ast::Span;

/// A text that was read from a file.
#[derive(Debug, Clone)]
pub struct Source {
    /// The name, as given: usually a path.
    pub name: String,
    /// The whole text, without byte order mark.
    pub text: String,
    line_starts: Vec<u32>,
}

/// Why bytes are no source text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SourceError {
    /// Positions are 32-bit numbers.
    TooLong {
        /// Name of the file.
        name: String,
    },
}

impl fmt::Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SourceError::TooLong { name } => write!(f, "{name}: a source text has at most {} bytes", u32::MAX),
        }
    }
}

impl std::error::Error for SourceError {}

impl Source {
    /// A source from a text.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Result<Source, SourceError> {
        let (name, text) = (name.into(), text.into());
        if u32::try_from(text.len()).is_err() {
            return Err(SourceError::TooLong { name });
        }
        let line_starts = line_starts(text.as_bytes());
        Ok(Source { name, text, line_starts })
    }

    /// A source from the bytes of a file: a byte order mark decides; without one UTF-8 where it is valid,
    /// otherwise Windows-1252, as Micro/WIN writes it.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Result<Source, SourceError> {
        let name = name.into();
        if u32::try_from(bytes.len()).is_err() {
            return Err(SourceError::TooLong { name });
        }
        Source::new(name, decode(bytes))
    }

    /// The name without folders and extension.
    pub fn stem(&self) -> &str {
        std::path::Path::new(&self.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("")
    }

    /// How many lines there are; an empty text has one.
    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }

    /// The lines without their ends. Behind a last line end there is one more, empty line, as in an editor.
    pub fn lines(&self) -> impl Iterator<Item = &str> + '_ {
        (1..=self.line_count()).map(|line| self.line_text(line))
    }

    /// Line and column of a byte offset, both from 1; columns count characters. An offset inside a character or
    /// line end counts as the character's, one behind the text as the end of the text.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let mut offset = offset.min(self.text.len());
        if offset > 0 && self.text.as_bytes().get(offset - 1..=offset) == Some(b"\r\n") {
            offset -= 1;
        }
        let line = self.line_starts.partition_point(|&start| start as usize <= offset).max(1);
        let start = self.line_starts.get(line - 1).copied().unwrap_or(0) as usize;
        let before = self.text.as_bytes().get(start..offset).unwrap_or(&[]);
        let characters = before.iter().filter(|&&byte| !is_continuation(byte)).count();
        let inside = self.text.as_bytes().get(offset).is_some_and(|&byte| is_continuation(byte));
        (line, characters + usize::from(!inside))
    }

    /// Where a line stands, counted from 1, without its line end.
    pub fn line_span(&self, line: usize) -> Span {
        let index = line.max(1) - 1;
        let text_end = self.text.len() as u32;
        let start = self.line_starts.get(index).copied().unwrap_or(text_end);
        let end = self.line_starts.get(index + 1).copied().unwrap_or(text_end);
        let line = self.text.get(start as usize..end as usize).unwrap_or("");
        Span { start, end: start + line.trim_end_matches(['\n', '\r']).len() as u32 }
    }

    /// The text of a line, counted from 1, without its line end.
    pub fn line_text(&self, line: usize) -> &str {
        self.line_span(line).text(&self.text)
    }
}

fn is_continuation(byte: u8) -> bool {
    byte & 0xC0 == 0x80
}

/// Offsets at which lines begin; LF, CR LF and CR end one.
fn line_starts(text: &[u8]) -> Vec<u32> {
    let mut starts = vec![0];
    for (at, &byte) in text.iter().enumerate() {
        if byte == b'\n' || byte == b'\r' && text.get(at + 1) != Some(&b'\n') {
            starts.push(at as u32 + 1);
        }
    }
    starts
}

fn decode(bytes: &[u8]) -> String {
    if let Some((encoding, mark_len)) = encoding_rs::Encoding::for_bom(bytes) {
        let behind = bytes.get(mark_len..).unwrap_or(&[]);
        return encoding.decode_without_bom_handling(behind).0.into_owned();
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => encoding_rs::WINDOWS_1252.decode_without_bom_handling(bytes).0.into_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source::new("t.awl", text).unwrap()
    }

    #[test]
    fn every_kind_of_line_end_counts_once() {
        let source = source("a\nb\r\nc\rd");
        assert_eq!(source.line_count(), 4);
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position(2), (2, 1));
        assert_eq!(source.position(5), (3, 1));
        assert_eq!(source.position(7), (4, 1));
        assert_eq!((1..=5).map(|line| source.line_text(line)).collect::<Vec<_>>(), ["a", "b", "c", "d", ""]);
    }

    #[test]
    fn columns_are_characters() {
        let source = source("äöü€x\n\tq");
        assert_eq!(source.position(9), (1, 5));
        assert_eq!(source.position(1), (1, 1), "inside the first character");
        assert_eq!(source.position(12), (2, 2));
        assert_eq!(source.position(9999), (2, 3));
    }

    #[test]
    fn an_empty_text_has_one_line() {
        let source = source("");
        assert_eq!(source.line_count(), 1);
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.line_text(1), "");
    }

    #[test]
    fn names_and_lines() {
        let mut source = source("a\r\nb\n");
        assert_eq!(source.lines().collect::<Vec<_>>(), ["a", "b", ""]);
        source.name = "/tmp/x/station.awl".to_owned();
        assert_eq!(source.stem(), "station");
    }

    #[test]
    fn encodings() {
        let text = |bytes: &[u8]| Source::from_bytes("t", bytes).unwrap().text;
        assert_eq!(text(b"\xEF\xBB\xBFLD I0.0"), "LD I0.0");
        assert_eq!(text("// für".as_bytes()), "// für");
        assert_eq!(text(b"// f\xFCr \x80"), "// für €");
        assert_eq!(text(b"\xFF\xFEL\0D\0"), "LD");
        assert_eq!(text(b"\xFE\xFF\0L\0D"), "LD");
        assert_eq!(text(b"\xEF\xBB\xBF\xFF"), "\u{FFFD}", "a mark wins");
    }
}
