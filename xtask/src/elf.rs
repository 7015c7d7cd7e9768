//! What an ELF puts into a board's flash. Reads, and runs nothing.

use anyhow::{Context, Result, ensure};
use object::LittleEndian;
use object::elf::{FileHeader32, PT_LOAD};
use object::read::elf::{ElfFile, ProgramHeader};

/// What flash has where nothing is written.
const BLANK: u8 = 0xFF;

/// The bytes of a board's flash from an address on; gaps are as blank flash is.
pub fn flash(elf: &[u8], start: u32) -> Result<Vec<u8>> {
    let elf: ElfFile<'_, FileHeader32<LittleEndian>> =
        ElfFile::parse(elf).context("the firmware is no ELF of 32 bits")?;
    let mut flash = Vec::new();
    for header in elf.elf_program_headers() {
        let bytes = header.data(LittleEndian, elf.data()).ok().context("a part is cut off")?;
        if header.p_type(LittleEndian) != PT_LOAD || bytes.is_empty() {
            continue;
        }
        let at = header.p_paddr(LittleEndian).checked_sub(start);
        let at = at.context("a part is not in flash")? as usize;
        flash.resize(flash.len().max(at + bytes.len()), BLANK);
        flash[at..at + bytes.len()].copy_from_slice(bytes);
    }
    ensure!(!flash.is_empty(), "the firmware has nothing in flash");
    Ok(flash)
}
