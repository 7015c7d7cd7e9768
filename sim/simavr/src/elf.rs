//! Reads an ELF as avr-gcc's linker writes it: what goes into flash and EEPROM, and the symbols.
//! Nothing is loaded here.

use std::collections::HashMap;
use std::fmt;

use object::elf::{FileHeader32, PT_LOAD};
use object::read::elf::{FileHeader, ProgramHeader};
use object::{LittleEndian, Object, ObjectSymbol};

/// Where the linker places addresses of data memory, so that they differ from those of flash.
const DATA: u64 = 0x80_0000;
/// The same for EEPROM, and the end of it.
const EEPROM: u64 = 0x81_0000;
const EEPROM_END: u64 = 0x82_0000;

/// Why a program could not be loaded. Holds a sentence without full stop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadError(pub String);

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for LoadError {}

impl From<object::Error> for LoadError {
    fn from(error: object::Error) -> LoadError {
        LoadError(format!("no ELF for an AVR: {error}"))
    }
}

/// An ELF with its contents.
#[derive(Debug, Clone, Default)]
pub struct Elf {
    /// Address in flash and bytes. Initial values of data are among them, where the startup code
    /// fetches them.
    pub flash: Vec<(u32, Vec<u8>)>,
    /// Address in EEPROM and bytes.
    pub eeprom: Vec<(u16, Vec<u8>)>,
    data_symbols: HashMap<String, u16>,
    flash_symbols: HashMap<String, u32>,
}

impl Elf {
    /// Reads an ELF.
    pub fn parse(bytes: &[u8]) -> Result<Elf, LoadError> {
        let mut elf = Elf::default();
        let header = FileHeader32::<LittleEndian>::parse(bytes)?;
        for segment in header.program_headers(LittleEndian, bytes)? {
            if segment.p_type(LittleEndian) != PT_LOAD || segment.p_filesz(LittleEndian) == 0 {
                continue;
            }
            let content = segment.data(LittleEndian, bytes);
            let content =
                content.map_err(|()| LoadError("the ELF is cut off".to_string()))?.to_vec();
            // The physical address is the place of the bytes, the virtual one that of what they
            // initialise.
            let at = u64::from(segment.p_paddr(LittleEndian));
            match at {
                0..DATA => elf.flash.push((at as u32, content)),
                EEPROM..EEPROM_END => elf.eeprom.push(((at - EEPROM) as u16, content)),
                // Fuses, lock bits and signature: the simulated chip has none.
                _ => {}
            }
        }
        for symbol in object::File::parse(bytes)?.symbols() {
            if symbol.is_undefined() {
                continue;
            }
            let name = symbol.name()?.to_string();
            match symbol.address() {
                address @ DATA..EEPROM => {
                    _ = elf.data_symbols.insert(name, (address - DATA) as u16)
                }
                address @ 0..DATA => _ = elf.flash_symbols.insert(name, address as u32),
                _ => {}
            }
        }
        Ok(elf)
    }

    /// The data address of a variable.
    pub fn data_symbol(&self, name: &str) -> Option<u16> {
        self.data_symbols.get(name).copied()
    }

    /// The address in flash of a function or table, in bytes.
    pub fn flash_symbol(&self, name: &str) -> Option<u32> {
        self.flash_symbols.get(name).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::Elf;

    fn words(values: &[u32]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }

    /// An ELF with these segments (virtual address, physical address, bytes) and symbols (name,
    /// address, defined).
    fn elf(segments: &[(u32, u32, &[u8])], symbols: &[(&str, u32, bool)]) -> Vec<u8> {
        let headers_len = 52 + 32 * segments.len();
        let (mut headers, mut content) = (Vec::new(), Vec::new());
        for (virtual_at, physical_at, bytes) in segments {
            let (at, len) = ((headers_len + content.len()) as u32, bytes.len() as u32);
            headers.extend(words(&[1, at, *virtual_at, *physical_at, len, len, 5, 1]));
            content.extend_from_slice(bytes);
        }
        let (mut names, mut table) = (vec![0], vec![0; 16]);
        for (name, address, is_defined) in symbols {
            table.extend(words(&[names.len() as u32, *address, 0]));
            // Global; in section 1.
            table.extend([0x10, 0, u8::from(*is_defined), 0]);
            names.extend(name.bytes().chain([0]));
        }
        let (table_at, table_len) = ((headers_len + content.len()) as u32, table.len() as u32);
        let names_at = table_at + table_len;
        let sections_at = names_at + names.len() as u32;
        // None, the symbols, their names.
        let mut sections = vec![0; 40];
        sections.extend(words(&[0, 2, 0, 0, table_at, table_len, 2, 1, 4, 16]));
        sections.extend(words(&[0, 3, 0, 0, names_at, names.len() as u32, 0, 0, 1, 0]));
        let mut file = b"\x7fELF\x01\x01\x01\0\0\0\0\0\0\0\0\0\x02\0\x53\0".to_vec();
        file.extend(words(&[1, 0, 52, sections_at, 0]));
        file.extend(
            [52u16, 32, segments.len() as u16, 40, 3, 2].into_iter().flat_map(u16::to_le_bytes),
        );
        [file, headers, content, table, names, sections].concat()
    }

    #[test]
    fn segments_go_where_their_bytes_are_kept() {
        let file = elf(
            &[
                (0, 0, &[1, 2]),
                (0x80_0100, 2, &[3]),
                (0x80_0101, 0x80_0101, &[]),
                (0x81_0004, 0x81_0004, &[9]),
            ],
            &[
                ("main", 0x1_24, true),
                ("UNO200_TICK", 0x80_0600, true),
                ("weak", 0, false),
                ("fuse", 0x82_0000, true),
            ],
        );
        let elf = Elf::parse(&file).unwrap();
        assert_eq!(elf.flash, [(0, vec![1, 2]), (2, vec![3])]);
        assert_eq!(elf.eeprom, [(4, vec![9])]);
        assert_eq!(elf.data_symbol("UNO200_TICK"), Some(0x0600));
        assert_eq!(elf.flash_symbol("main"), Some(0x124));
        assert_eq!((elf.data_symbol("main"), elf.flash_symbol("UNO200_TICK")), (None, None));
        assert_eq!((elf.flash_symbol("weak"), elf.flash_symbol("fuse")), (None, None));
    }

    #[test]
    fn what_is_no_elf_is_refused() {
        let file = elf(&[(0, 0, &[1, 2])], &[("main", 0, true)]);
        assert!(Elf::parse(&file).is_ok());
        for wrong in [&b""[..], b"\x7fELF", b"U200", &file[..60], &file[..file.len() - 1]] {
            assert!(Elf::parse(wrong).is_err(), "{} bytes", wrong.len());
        }
    }
}
