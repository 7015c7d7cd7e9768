//! The firmware's file, and where in data memory it keeps what a harness needs. Nothing is run
//! here.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use awl_asm::files::read;
use awl_asm::firmware;
use simavr::Elf;

/// The firmware of the board.
pub struct Firmware {
    /// The file's content, with all its symbols.
    pub elf: Elf,
    pub(super) places: Places,
}

/// Data addresses of the firmware's variables.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    /// The millisecond clock, four bytes, low byte first.
    pub tick: u16,
    /// The analog inputs as the next scan takes them, six words, low byte first.
    pub analog: u16,
    /// A bit for each of them that the next scan shall take.
    pub analog_fresh: u16,
    /// Mode, and fault in four bytes.
    pub status: u16,
    /// The time of day: year in the century, month, day, hour, minute, second, and the millisecond
    /// clock then. Only in a firmware with modules.
    pub time_of_day: Option<u16>,
    /// One past its variables: from here on SRAM is for the stack.
    pub free: u16,
}

impl Firmware {
    /// The firmware where it is built, beside the program, or where the environment says.
    pub fn find() -> Result<Firmware> {
        Firmware::read(&firmware::find_elf()?)
    }

    /// Reads an ELF. Without the symbols that a harness needs it is an error.
    pub fn read(path: &Path) -> Result<Firmware> {
        Firmware::parse(&read(path)?).with_context(|| path.display().to_string())
    }

    fn parse(bytes: &[u8]) -> Result<Firmware> {
        let elf = Elf::parse(bytes)?;
        let names =
            ["UNO200_TICK", "UNO200_ANALOG", "UNO200_ANALOG_FRESH", "UNO200_STATUS", "_end"];
        let missing: Vec<_> =
            names.into_iter().filter(|name| elf.data_symbol(name).is_none()).collect();
        ensure!(missing.is_empty(), "no firmware of uno200: it lacks {}", missing.join(", "));
        let [tick, analog, analog_fresh, status, free] =
            names.map(|name| elf.data_symbol(name).unwrap_or_default());
        let time_of_day = elf.data_symbol("TIME_OF_DAY");
        Ok(Firmware {
            elf,
            places: Places { tick, analog, analog_fresh, status, time_of_day, free },
        })
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
