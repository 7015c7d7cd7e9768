//! The tools section: what only tools read, after an image in its file (docs/image.md). Machines
//! never see it.

use plc_isa::{Crc32, MAGIC};

use crate::source::{self, At};
use crate::text::address::Address;
use crate::text::ast::{Symbol, Value};

/// First bytes of the section.
const SECTION_MAGIC: [u8; 4] = *b"TOOL";
/// Bytes before the entries: magic, length of the entries.
const HEAD_LEN: usize = 8;
/// Bytes of the section's checksum.
const CRC_LEN: usize = 4;
/// Where the image says how long it is.
const TOTAL_LEN_AT: usize = 6;

// Kinds of entries. Readers pass over those that they do not know.
const FILE: u8 = 1;
const PLACE: u8 = 2;
const VARIABLE: u8 = 3;

/// Where an instruction comes from, and all after it up to the next place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodePlace {
    /// Offset of the instruction in the image.
    pub offset: u16,
    /// Index in [`Tools::files`].
    pub file: u16,
    /// Line from 1 on; 0: not in lines.
    pub line: u32,
    /// Column from 1 on; 0: not known.
    pub column: u16,
    /// An element of a chart, such as a step; empty: none.
    pub element: String,
}

/// A name for a place in memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Its name, with the names of what it is in.
    pub name: String,
    /// Its type as in its declaration.
    pub of_type: String,
    /// Its address as in AWL.
    pub address: String,
}

/// What a tools section says.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tools {
    /// Names of source files.
    pub files: Vec<String>,
    /// Places by their offsets.
    pub places: Vec<CodePlace>,
    /// Variables.
    pub variables: Vec<Variable>,
}

/// The image at the beginning of a file, without what is after it; all of it if it is no image.
pub fn image_in(file: &[u8]) -> &[u8] {
    let len = match file.get(TOTAL_LEN_AT..TOTAL_LEN_AT + 2) {
        Some(&[low, high]) if file.starts_with(&MAGIC) => u16::from_le_bytes([low, high]),
        _ => return file,
    };
    file.get(..usize::from(len)).unwrap_or(file)
}

impl Tools {
    /// The section as bytes, to be put after the image. Of texts the first 65,000 bytes or so
    /// count.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut entries = Vec::new();
        for file in &self.files {
            entry(&mut entries, FILE, file.as_bytes());
        }
        for place in &self.places {
            let mut content = place.offset.to_le_bytes().to_vec();
            content.extend(place.file.to_le_bytes());
            content.extend(place.line.to_le_bytes());
            content.extend(place.column.to_le_bytes());
            content.extend(place.element.as_bytes());
            entry(&mut entries, PLACE, &content);
        }
        for variable in &self.variables {
            let content =
                [&variable.name, &variable.of_type, &variable.address].map(|s| s.as_str());
            entry(&mut entries, VARIABLE, content.join("\0").as_bytes());
        }
        let mut section = SECTION_MAGIC.to_vec();
        section.extend((entries.len() as u32).to_le_bytes());
        section.extend(entries);
        let crc = Crc32::of(&section);
        section.extend(crc.to_le_bytes());
        section
    }

    /// What the section after an image says; `None` where there is none, or no whole one.
    pub fn in_file(file: &[u8]) -> Option<Tools> {
        let section = file.get(image_in(file).len()..)?;
        let len = section.strip_prefix(&SECTION_MAGIC)?.first_chunk::<4>()?;
        let end = usize::try_from(u32::from_le_bytes(*len)).ok()?.checked_add(HEAD_LEN)?;
        let crc = section.get(end..)?.first_chunk::<CRC_LEN>()?;
        if Crc32::of(section.get(..end)?) != u32::from_le_bytes(*crc) {
            return None;
        }
        let (mut tools, mut entries) = (Tools::default(), section.get(HEAD_LEN..end)?);
        while let [kind, low, high, rest @ ..] = entries {
            let (content, after) =
                rest.split_at_checked(usize::from(u16::from_le_bytes([*low, *high])))?;
            tools.take(*kind, content)?;
            entries = after;
        }
        entries.is_empty().then_some(tools)
    }

    /// Where the instruction at an offset of the image comes from.
    pub fn place_at(&self, offset: u16) -> Option<source::Place> {
        let place = self.places.iter().take_while(|place| place.offset <= offset).last()?;
        let file = self.files.get(usize::from(place.file))?.clone();
        let column = Some(usize::from(place.column)).filter(|&column| column > 0);
        let at = match place.element.as_str() {
            "" => At::Line { line: place.line as usize, column },
            name => At::Element(name.to_owned()),
        };
        Some(source::Place { file, at })
    }

    /// The variables as symbols.
    pub fn symbols(&self) -> Vec<Symbol> {
        let symbol = |variable: &Variable| {
            let value = Value::Address(Address::parse(&variable.address).ok()?);
            let (name, comment) = (variable.name.clone(), variable.of_type.clone());
            Some(Symbol { name, value, comment })
        };
        self.variables.iter().filter_map(symbol).collect()
    }

    /// Takes an entry.
    fn take(&mut self, kind: u8, content: &[u8]) -> Option<()> {
        match kind {
            FILE => self.files.push(str::from_utf8(content).ok()?.to_owned()),
            PLACE => {
                let (&[o0, o1, f0, f1, l0, l1, l2, l3, c0, c1], element) =
                    content.split_first_chunk()?;
                self.places.push(CodePlace {
                    offset: u16::from_le_bytes([o0, o1]),
                    file: u16::from_le_bytes([f0, f1]),
                    line: u32::from_le_bytes([l0, l1, l2, l3]),
                    column: u16::from_le_bytes([c0, c1]),
                    element: str::from_utf8(element).ok()?.to_owned(),
                });
            }
            VARIABLE => {
                let mut texts = str::from_utf8(content).ok()?.split('\0').map(str::to_owned);
                let (name, of_type, address) = (texts.next()?, texts.next()?, texts.next()?);
                self.variables.push(Variable { name, of_type, address });
            }
            _ => {}
        }
        Some(())
    }
}

/// Appends an entry; a content that is too long is cut.
fn entry(entries: &mut Vec<u8>, kind: u8, content: &[u8]) {
    let content = &content[..content.len().min(usize::from(u16::MAX))];
    entries.push(kind);
    entries.extend((content.len() as u16).to_le_bytes());
    entries.extend(content);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assemble::assemble;
    use crate::source::Source;

    fn tools() -> Tools {
        let place = |offset, line, element: &str| CodePlace {
            offset,
            file: 0,
            line,
            column: 3,
            element: element.to_string(),
        };
        Tools {
            files: vec!["straße.st".to_string()],
            places: vec![place(70, 12, ""), place(90, 0, "Fill")],
            variables: vec![Variable {
                name: "Main.Speed".to_string(),
                of_type: "INT".to_string(),
                address: "VW20".to_string(),
            }],
        }
    }

    fn image() -> Vec<u8> {
        assemble(&Source::new("a.awl", "LD I0.0\n= Q0.0\n").unwrap(), Vec::new()).image.unwrap()
    }

    #[test]
    fn what_is_written_is_read() {
        let file = [image(), tools().to_bytes()].concat();
        assert_eq!(image_in(&file), image());
        assert_eq!(Tools::in_file(&file), Some(tools()));
        assert!(plc_isa::verify(file.as_slice()).is_ok());
        assert_eq!(Tools::in_file(&image()), None);
        assert_eq!(image_in(b"LD I0.0"), b"LD I0.0");
    }

    #[test]
    fn unknown_entries_are_passed_over() {
        let mut bytes = tools().to_bytes();
        let end = bytes.len() - CRC_LEN;
        bytes.truncate(end);
        entry(&mut bytes, 200, b"of a later version");
        let len = (bytes.len() - HEAD_LEN) as u32;
        bytes[4..8].copy_from_slice(&len.to_le_bytes());
        let crc = Crc32::of(&bytes);
        bytes.extend(crc.to_le_bytes());
        assert_eq!(Tools::in_file(&[image(), bytes].concat()), Some(tools()));
    }

    #[test]
    fn no_damaged_section_is_read() {
        let (image, section) = (image(), tools().to_bytes());
        for len in 0..section.len() {
            assert_eq!(Tools::in_file(&[&image, &section[..len]].concat()), None, "{len}");
        }
        for at in 0..section.len() {
            let mut damaged = section.clone();
            damaged[at] ^= 0x41;
            assert_eq!(Tools::in_file(&[&image[..], &damaged].concat()), None, "{at}");
        }
    }
}
