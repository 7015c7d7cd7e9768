//! Optiboot, the bootloader of the Uno: compiled from the source that Debian's package
//! arduino-core-avr brings.
//!
//! The package has a `.hex` of it as well, but the compiler it was made with needs 532 bytes where
//! an Uno has 512. The part that starts the application lies beyond the end of flash there, so no
//! programmer could write it.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use simavr::Elf;

/// Where the fuses of an Uno make a reset lead: the last 512 bytes of flash.
pub const START: u32 = 0x7E00;

const SOURCE: &str = "/usr/share/arduino/hardware/arduino/avr/bootloaders/optiboot/optiboot.c";

/// As its Makefile has it for the Uno, and two options more: without them too much is put inline
/// for 512 bytes.
const OPTIONS: [&str; 9] = [
    "-mmcu=atmega328p",
    "-DF_CPU=16000000L",
    "-DBAUD_RATE=115200",
    "-DLED_START_FLASHES=3",
    "-Os",
    "-fno-inline-small-functions",
    "-fno-inline-functions-called-once",
    "-nostartfiles",
    "-nostdlib",
];

/// The bootloader.
pub fn build() -> Result<Elf> {
    ensure!(
        Path::new(SOURCE).exists(),
        "{SOURCE} is not there: install the package arduino-core-avr"
    );
    let folder = tempfile::tempdir().context("cannot make a temporary folder")?;
    let file = folder.path().join("optiboot.elf");
    let mut compiler = Command::new("avr-gcc");
    compiler.args(OPTIONS).arg(format!("-Wl,--relax,--section-start=.text={START:#x}"));
    let output = compiler.arg("-o").arg(&file).arg(SOURCE).output();
    let output = output.context("cannot start avr-gcc: install the package gcc-avr")?;
    ensure!(
        output.status.success(),
        "avr-gcc failed:\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Elf::parse(&fs::read(&file)?).context("avr-gcc made no good ELF of the bootloader")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_fits_where_an_uno_has_room_for_it() {
        let elf = build().unwrap();
        let start = elf.flash.iter().map(|(at, _)| *at).min().unwrap();
        let end = elf.flash.iter().map(|(at, bytes)| at + bytes.len() as u32).max().unwrap();
        assert_eq!(start, START);
        // The last two bytes hold its version in builds for shipping.
        assert!(end <= 0x7FFE, "{end:#06x}");
    }
}
