//! A source text with its name and line starts: decoding and encoding, and offsets to lines and
//! columns; texts of several files as one. No parsing.

use std::fmt;

use crate::binary::Binary;
use crate::origins::Origins;
use crate::windows_1252;

/// A stretch of the source text, in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// From here to there.
    pub fn new(start: usize, end: usize) -> Span {
        Span { start: start as u32, end: end as u32 }
    }

    /// Whether all of it is within another one, which it may equal.
    pub fn is_in(self, outer: Span) -> bool {
        outer.start <= self.start && self.end <= outer.end
    }

    /// The covered text.
    pub fn text(self, source: &str) -> &str {
        source.get(self.start as usize..self.end as usize).unwrap_or("")
    }
}

/// Where something is, as messages name it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The name of the source.
    pub file: String,
    /// Where in it.
    pub at: At,
}

/// Where in a source something is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum At {
    /// In a text.
    Line {
        /// The line, from 1.
        line: usize,
        /// The column in characters, from 1, where it is known.
        column: Option<usize>,
    },
    /// In a drawing: the name of an element, such as a step.
    Element(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        match &self.at {
            At::Line { line, column: Some(column) } => write!(f, ":{line}:{column}"),
            At::Line { line, column: None } => write!(f, ":{line}"),
            At::Element(name) => write!(f, "#{name}"),
        }
    }
}

/// A text that was read from a file, or from [several](Source::joined).
#[derive(Debug, Clone)]
pub struct Source {
    /// The name, as given: usually a path. Of several files that of the first.
    pub name: String,
    /// The whole text, without byte order mark.
    pub text: String,
    /// How the file is encoded.
    pub encoding: Encoding,
    line_starts: Vec<u32>,
    origins: Origins,
    /// The files, if there are several.
    files: Vec<File>,
}

/// A file among several.
#[derive(Debug, Clone)]
struct File {
    name: String,
    span: Span,
    /// How many lines are before it.
    lines_before: usize,
}

/// How the characters of a file are encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-8 without byte order mark; ASCII too.
    Utf8,
    /// UTF-8 with byte order mark.
    Utf8Marked,
    /// UTF-16, low byte first, with byte order mark.
    Utf16LittleEndian,
    /// UTF-16, high byte first, with byte order mark.
    Utf16BigEndian,
    /// The code page 1252 of Windows, as Micro/WIN writes it in western Europe.
    Windows1252,
}

impl Encoding {
    /// A byte order mark decides; without one it is UTF-8 where that is valid, otherwise
    /// Windows-1252.
    fn of(bytes: &[u8]) -> Encoding {
        match bytes {
            [0xEF, 0xBB, 0xBF, ..] => Encoding::Utf8Marked,
            [0xFF, 0xFE, ..] => Encoding::Utf16LittleEndian,
            [0xFE, 0xFF, ..] => Encoding::Utf16BigEndian,
            _ if std::str::from_utf8(bytes).is_ok() => Encoding::Utf8,
            _ => Encoding::Windows1252,
        }
    }

    /// The text of a file. What is no character in its encoding is U+FFFD.
    fn decode(self, bytes: &[u8]) -> String {
        let after_mark = |mark_len| bytes.get(mark_len..).unwrap_or(&[]);
        match self {
            Encoding::Utf8 => String::from_utf8_lossy(bytes).into_owned(),
            Encoding::Utf8Marked => String::from_utf8_lossy(after_mark(3)).into_owned(),
            Encoding::Utf16LittleEndian => of_utf16(after_mark(2), u16::from_le_bytes),
            Encoding::Utf16BigEndian => of_utf16(after_mark(2), u16::from_be_bytes),
            Encoding::Windows1252 => bytes.iter().copied().map(windows_1252::character).collect(),
        }
    }

    /// The bytes of a text, with the byte order mark of its encoding; `None` if that lacks a
    /// character of it.
    pub fn encode(self, text: &str) -> Option<Vec<u8>> {
        let units = |bytes_of: fn(u16) -> [u8; 2]| {
            let mark_and_text = std::iter::once(0xFEFF).chain(text.encode_utf16());
            Some(mark_and_text.flat_map(bytes_of).collect())
        };
        match self {
            Encoding::Utf8 => Some(text.as_bytes().to_vec()),
            Encoding::Utf8Marked => Some([b"\xEF\xBB\xBF", text.as_bytes()].concat()),
            Encoding::Utf16LittleEndian => units(u16::to_le_bytes),
            Encoding::Utf16BigEndian => units(u16::to_be_bytes),
            Encoding::Windows1252 => text.chars().map(windows_1252::byte).collect(),
        }
    }
}

/// A text of 16-bit units; half a pair and half a unit are U+FFFD.
fn of_utf16(bytes: &[u8], unit_of: fn([u8; 2]) -> u16) -> String {
    let (units, half) = bytes.as_chunks::<2>();
    let characters = char::decode_utf16(units.iter().copied().map(unit_of));
    let half = half.first().map(|_| char::REPLACEMENT_CHARACTER);
    characters
        .map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER))
        .chain(half)
        .collect()
}

/// Why bytes are no source text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SourceError {
    /// Positions are 32-bit numbers.
    TooLong {
        /// Name of the file.
        name: String,
    },
    /// It is something else than a text.
    Binary {
        /// Name of the file.
        name: String,
        /// What it is.
        what: Binary,
    },
}

impl fmt::Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SourceError::TooLong { name } => {
                write!(f, "{name}: a source text has at most {} bytes", u32::MAX)
            }
            SourceError::Binary { name, what } => write!(f, "{name}: {what}"),
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
        let (line_starts, origins) = (line_starts(text.as_bytes()), Origins::of(&text));
        Ok(Source { name, text, encoding: Encoding::Utf8, line_starts, origins, files: Vec::new() })
    }

    /// The texts of several files as one, in this order; each begins on a line of its own. Lines
    /// are counted through, but [places](Source::place) are those of the files. One source stays as
    /// it is.
    pub fn joined(sources: Vec<Source>) -> Result<Source, SourceError> {
        let mut sources = sources;
        if sources.len() == 1
            && let Some(only) = sources.pop()
        {
            return Ok(only);
        }
        let mut text = String::new();
        let mut files: Vec<File> = Vec::new();
        for source in &sources {
            let start = text.len();
            text.push_str(&source.text);
            if !text.ends_with('\n') || text.len() == start {
                text.push('\n');
            }
            let name = source.name.clone();
            files.push(File { name, span: Span::new(start, text.len()), lines_before: 0 });
        }
        let name = files.first().map_or_else(String::new, |file| file.name.clone());
        let mut joined = Source::new(name, text)?;
        for file in &mut files {
            joined.origins.end_at(file.span.start);
            file.lines_before = joined.position(file.span.start as usize).0 - 1;
        }
        Ok(Source { files, ..joined })
    }

    /// The files with their stretches of the text: one, or those that were joined.
    pub fn files(&self) -> impl Iterator<Item = (&str, Span)> {
        let whole = (self.name.as_str(), Span::new(0, self.text.len()));
        let only = self.files.is_empty().then_some(whole);
        only.into_iter().chain(self.files.iter().map(|file| (file.name.as_str(), file.span)))
    }

    /// Whether the text was joined from several files.
    pub fn has_files(&self) -> bool {
        !self.files.is_empty()
    }

    /// The file of a line, counted from 1, and which of its lines that is.
    pub fn line_in_file(&self, line: usize) -> (&str, usize) {
        let after = self.files.partition_point(|file| file.lines_before < line);
        match after.checked_sub(1).and_then(|index| self.files.get(index)) {
            Some(file) => (&file.name, line - file.lines_before),
            None => (&self.name, line),
        }
    }

    /// A source from the bytes of a file: a byte order mark decides; without one UTF-8 where it is
    /// valid, otherwise Windows-1252, as Micro/WIN writes it. What is no text is an error that says
    /// what it is.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Result<Source, SourceError> {
        let name = name.into();
        if u32::try_from(bytes.len()).is_err() {
            return Err(SourceError::TooLong { name });
        }
        if let Some(what) = Binary::of(bytes) {
            return Err(SourceError::Binary { name, what });
        }
        let encoding = Encoding::of(bytes);
        Ok(Source { encoding, ..Source::new(name, encoding.decode(bytes))? })
    }

    /// The name without folders and extension.
    pub fn stem(&self) -> &str {
        std::path::Path::new(&self.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("")
    }

    /// How many lines there are; an empty text has one.
    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }

    /// The lines without their ends. After a last line end there is one more, empty line, as in an
    /// editor.
    pub fn lines(&self) -> impl Iterator<Item = &str> + '_ {
        (1..=self.line_count()).map(|line| self.line_text(line))
    }

    /// Line and column of a byte offset, both from 1; columns count characters. An offset inside a
    /// character or line end counts as the character's, one after the text as the end of the text.
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

    /// The place of a byte offset in its file, as [`position`](Source::position) counts.
    pub fn place(&self, offset: usize) -> Place {
        let (line, column) = self.position(offset);
        let (file, line) = self.line_in_file(line);
        Place { file: file.to_owned(), at: At::Line { line, column: Some(column) } }
    }

    /// Where what is at a byte offset comes from, if the text was made of something else and says
    /// so in lines `//# source`.
    pub fn origin(&self, offset: usize) -> Option<&Place> {
        self.origins.at(offset)
    }

    /// Whether the text has lines `//# source`.
    pub fn has_origins(&self) -> bool {
        !self.origins.is_empty()
    }

    /// Where a line is, counted from 1, without its line end.
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
        assert_eq!(
            (1..=5).map(|line| source.line_text(line)).collect::<Vec<_>>(),
            ["a", "b", "c", "d", ""]
        );
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
    fn several_files_are_one_text_with_their_own_places() {
        let files = ["a\n//# source x.st:7\nb", "", "c\r", "d\n"].map(source);
        let names = ["a.awl", "b.awl", "c.awl", "d.awl"];
        let named = files.into_iter().zip(names);
        let joined = named.map(|(file, name)| Source { name: name.to_owned(), ..file });
        let joined = Source::joined(joined.collect()).unwrap();
        assert_eq!(joined.name, "a.awl");
        let place = |needle: char| joined.place(joined.text.rfind(needle).unwrap()).to_string();
        assert_eq!(['b', 'c', 'd'].map(place), ["a.awl:3:1", "c.awl:1:1", "d.awl:1:1"]);
        let origin = |needle: char| joined.origin(joined.text.rfind(needle).unwrap()).is_some();
        assert_eq!(['b', 'c', 'd'].map(origin), [true, false, false], "a mark ends with its file");
        let lines: Vec<_> = (1..=6).map(|line| joined.line_in_file(line)).collect();
        assert_eq!(lines[3..], [("b.awl", 1), ("c.awl", 1), ("d.awl", 1)]);
        let texts: Vec<_> =
            joined.files().map(|(name, at)| (name, at.text(&joined.text))).collect();
        assert_eq!(texts[2..], [("c.awl", "c\r\n"), ("d.awl", "d\n")]);
        let one = Source::joined(vec![source("a")]).unwrap();
        assert_eq!((one.has_files(), one.text.as_str()), (false, "a"));
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
        assert_eq!(
            text(b"\xFF\xFEL\0\0\xD8D\0L"),
            "L\u{FFFD}D\u{FFFD}",
            "half a pair, half a unit"
        );
    }

    #[test]
    fn what_was_read_is_written_back() {
        let all: Vec<u8> = (0x80..=0xFF).collect();
        let files: [&[u8]; 6] = [
            b"",
            "// für €".as_bytes(),
            b"\xEF\xBB\xBFLD",
            b"\xFF\xFEL\0\xAC\x20=\xD8\x00\xDE",
            b"\xFE\xFF\0L\x20\xAC",
            &all,
        ];
        for file in files {
            let source = Source::from_bytes("t", file).unwrap();
            assert_eq!(
                source.encoding.encode(&source.text).as_deref(),
                Some(file),
                "{:?}",
                source.encoding
            );
        }
        assert_eq!(Encoding::Windows1252.encode("中"), None);
    }

    #[test]
    fn columns_are_those_of_the_decoded_text() {
        let files: [&[u8]; 3] = [
            b"// \xE4\xF6\r\nLD x",
            b"\xEF\xBB\xBF// \xC3\xA4\xC3\xB6\r\nLD x",
            b"\xFF\xFE/\0/\0 \0\xE4\0\xF6\0\r\0\n\0L\0D\0 \0x\0",
        ];
        for file in files {
            let source = Source::from_bytes("t", file).unwrap();
            assert_eq!(source.position(source.text.find('ö').unwrap()), (1, 5));
            assert_eq!(source.position(source.text.find('x').unwrap()), (2, 4));
        }
    }
}
