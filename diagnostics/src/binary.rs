//! Files that are no text, known by their first bytes, and the way from them to a text. Nothing is
//! read out of them.

use std::fmt;

/// A kind of file that is no text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Binary {
    /// What it is, with its article.
    what: &'static str,
    /// How a text comes out of it.
    way: &'static str,
}

const MICRO_WIN: &str = "in STEP 7-Micro/WIN, File > Export writes the blocks of an open project \
     as AWL text (.awl); a symbol table is copied there and pasted into a text file";
const UNPACK: &str = "unpack it; a project in it is opened by the software that it was made with, \
     which exports AWL: in STEP 7-Micro/WIN with File > Export";
const COPY: &str = "copy the program out of it into a text file (.awl)";
const ANOTHER_FILE: &str = "name the file with the AWL text instead";

const UTF_16: Binary = Binary {
    what: "a text in UTF-16 without byte order mark",
    way: "save it as UTF-8, or with the mark",
};
const INTEL_HEX: Binary = Binary { what: "Intel HEX, which is for avrdude", way: ANOTHER_FILE };
const UNKNOWN: Binary = Binary { what: "no text: it holds NUL bytes", way: MICRO_WIN };

/// What files begin with. The formats of Micro/WIN's projects are those that
/// github.com/wpyoga/s7-200-smart-project-file describes.
const MAGIC: [(&[u8], Binary); 20] = [
    (b"GJK\0", Binary { what: "a project of STEP 7-Micro/WIN (.mwp)", way: MICRO_WIN }),
    (
        b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1",
        Binary {
            what: "a compound file, as projects of STEP 7-Micro/WIN and documents of Office are",
            way: MICRO_WIN,
        },
    ),
    (b"DEM\0", SMART),
    (b"SH3\0", SMART),
    (b"\0\0\0\0R03.", SMART),
    (b"PK\x03\x04", ZIP),
    (b"PK\x05\x06", ZIP),
    (b"7z\xBC\xAF\x27\x1C", ARCHIVE),
    (b"Rar!\x1A", ARCHIVE),
    (b"\x1F\x8B\x08", ARCHIVE),
    (b"MSCF\0", ARCHIVE),
    (b"%PDF-", Binary { what: "a PDF document", way: COPY }),
    (b"{\\rtf", Binary { what: "a document in RTF", way: COPY }),
    (b"\x89PNG\r\n", PICTURE),
    (b"\xFF\xD8\xFF", PICTURE),
    (b"GIF8", PICTURE),
    (b"\x7FELF", Binary { what: "an ELF file, which holds machine code", way: ANOTHER_FILE }),
    (b"MZ\x90\0", Binary { what: "a program for Windows", way: ANOTHER_FILE }),
    (b"\0asm", Binary { what: "a WebAssembly module", way: ANOTHER_FILE }),
    (
        b"U200",
        Binary {
            what: "an image that awl-asm has made",
            way: "`awl-asm --disassemble` turns it into AWL",
        },
    ),
];

const SMART: Binary =
    Binary { what: "a project of STEP 7-Micro/WIN SMART (.smart)", way: MICRO_WIN };
const ZIP: Binary =
    Binary { what: "a ZIP archive, as .zip, .zap and .xlsx files are", way: UNPACK };
const ARCHIVE: Binary = Binary { what: "an archive", way: UNPACK };
const PICTURE: Binary = Binary { what: "a picture", way: "the program is needed as AWL text" };

impl Binary {
    /// What the bytes of a file are, if they are no text.
    pub fn of(bytes: &[u8]) -> Option<Binary> {
        if let Some(binary) = Binary::named(bytes) {
            return Some(binary);
        }
        let has_mark = bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF");
        if has_mark || !bytes.contains(&0) {
            return None;
        }
        Some(if is_utf_16(bytes) { UTF_16 } else { UNKNOWN })
    }

    /// What they are, if that has a name.
    pub fn named(bytes: &[u8]) -> Option<Binary> {
        let known = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic));
        known.map(|(_, binary)| *binary).or(is_intel_hex(bytes).then_some(INTEL_HEX))
    }
}

impl fmt::Display for Binary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this is {}; {}", self.what, self.way)
    }
}

/// A record: a colon, and at least length, address, type and checksum in digits.
fn is_intel_hex(bytes: &[u8]) -> bool {
    let digits = bytes.get(1..11).unwrap_or(&[]);
    bytes.first() == Some(&b':') && digits.len() == 10 && digits.iter().all(u8::is_ascii_hexdigit)
}

/// Whether every other byte of the beginning is NUL, as of letters in UTF-16.
fn is_utf_16(bytes: &[u8]) -> bool {
    let (pairs, _) = bytes.get(..bytes.len().min(32)).unwrap_or(&[]).as_chunks::<2>();
    let low_first = pairs.iter().all(|pair| pair[0] != 0 && pair[1] == 0);
    let high_first = pairs.iter().all(|pair| pair[0] == 0 && pair[1] != 0);
    pairs.len() > 1 && (low_first || high_first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(bytes: &[u8]) -> String {
        Binary::of(bytes).map_or_else(String::new, |binary| binary.to_string())
    }

    #[test]
    fn every_kind_is_known_by_its_first_bytes() {
        for (magic, binary) in MAGIC {
            assert_eq!(told(&[magic, b"\0rest"].concat()), binary.to_string());
        }
        let project = told(b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0");
        assert!(project.contains("Micro/WIN") && project.contains("File > Export"), "{project}");
        assert!(told(b":100000000C9434000C9446000C9446000C9446006A\n").contains("avrdude"));
        assert!(told(b"L\0D\0 \0").contains("UTF-16"));
        assert!(told(b"\0L\0D").contains("UTF-16"));
        assert!(told(b"LD I0.0\0").contains("NUL"));
    }

    #[test]
    fn texts_stay_texts() {
        let texts: [&[u8]; 8] = [
            b"",
            b"LD I0.0\n",
            b"\xFF\xFEL\0D\0",
            b"\xFE\xFF\0L\0D",
            b"\xEF\xBB\xBFLD",
            b"// f\xFCr",
            b"PK",
            b": 10 is no record",
        ];
        for text in texts {
            assert_eq!(told(text), "", "{text:?}");
        }
    }
}
