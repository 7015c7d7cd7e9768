//! The firmware's file, and where in data memory it keeps what a harness needs. Nothing is run here.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use awl_asm::files::read;
use simavr::Elf;

/// The firmware of the board.
pub struct Firmware {
    pub(super) elf: Elf,
    /// The millisecond clock, four bytes, low byte first.
    pub(super) tick: u16,
    /// The analog inputs as the next scan takes them, six words, low byte first.
    pub(super) analog: u16,
    /// A bit for each of them that the next scan shall take; without it the firmware takes all.
    pub(super) analog_fresh: Option<u16>,
    /// Mode, and fault in four bytes.
    pub(super) status: u16,
    /// One past its variables: from here on SRAM is for the stack.
    pub(super) free: u16,
}

impl Firmware {
    /// Reads an ELF. Without the symbols that a harness needs it is an error.
    pub fn read(path: &Path) -> Result<Firmware> {
        Firmware::parse(&read(path)?).with_context(|| path.display().to_string())
    }

    fn parse(bytes: &[u8]) -> Result<Firmware> {
        let elf = Elf::parse(bytes)?;
        let names = ["UNO200_TICK", "UNO200_ANALOG", "UNO200_STATUS", "_end"];
        let missing: Vec<_> = names.into_iter().filter(|name| elf.data_symbol(name).is_none()).collect();
        ensure!(missing.is_empty(), "no firmware of uno200: it lacks {}", missing.join(", "));
        let [tick, analog, status, free] = names.map(|name| elf.data_symbol(name).unwrap_or_default());
        let analog_fresh = elf.data_symbol("UNO200_ANALOG_FRESH");
        Ok(Firmware { elf, tick, analog, analog_fresh, status, free })
    }
}

#[cfg(test)]
mod tests {
    use super::Firmware;

    #[test]
    fn another_file_is_refused() {
        let error = Firmware::parse(b"U200 an image").err().map(|error| format!("{error:#}"));
        assert!(error.is_some_and(|text| text.contains("no ELF for an AVR")));
    }
}
