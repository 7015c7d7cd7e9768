//! Boards that show a drive for their flash to be written: the file for it, and the way onto it.
//! What UF2 is says `image`.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use plc_isa::{Drive, Profile};

use crate::image::uf2::uf2;

/// The Pico's firmware from the beginning of its flash on, built with the compilers that
/// `awl-asm/firmware/pico-compilers.txt` names.
const PICO_FIRMWARE: &[u8] = include_bytes!("../../firmware/pico.bin");

/// The file of a drive that says which board it is.
const INFO: &str = "INFO_UF2.TXT";
const BOARD_ID: &str = "Board-ID:";

/// Firmware and image as a UF2 file.
///
/// # Errors
/// If the board of the program has no drive: which one has.
pub fn uf2_file(profile: &Profile, image: &[u8]) -> Result<Vec<u8>> {
    Ok(uf2(drive_of(profile)?, PICO_FIRMWARE, image))
}

fn drive_of(profile: &Profile) -> Result<&Drive> {
    profile.drive.as_ref().with_context(|| {
        let others = Profile::BOARDS.iter().filter(|board| board.drive.is_some());
        let ways: Vec<String> = others
            .map(|board| format!("`--board {}` builds it for {}", board.name, board.title))
            .collect();
        format!(
            "the program is for {}, which takes no UF2 file: {}",
            profile.title,
            ways.join(", ")
        )
    })
}

/// Writes a UF2 file onto a board's drive. The board restarts when it has all of it.
///
/// # Errors
/// If there is no such drive, it is another board's, or it cannot be written.
pub fn write(folder: &Path, profile: &Profile, name: &str, image: &[u8]) -> Result<()> {
    let file = uf2_file(profile, image)?;
    ensure_drive(folder, profile, drive_of(profile)?)?;
    let path = folder.join(name).with_extension("uf2");
    // Not by way of another file: the drive is no real one, and is gone with the last block.
    fs::write(&path, file).with_context(|| format!("cannot write {}", path.display()))?;
    // Written now and not when the computer has time. The board may be gone before it has answered,
    // which is no error.
    let _ = fs::File::open(&path).and_then(|file| file.sync_all());
    Ok(())
}

/// Refuses what is not the drive of this board.
fn ensure_drive(folder: &Path, profile: &Profile, drive: &Drive) -> Result<()> {
    let (place, title) = (folder.display(), profile.title);
    let Ok(info) = fs::read_to_string(folder.join(INFO)) else {
        bail!(
            "{place} is not the drive of {title}: there is no {INFO}\n  \
             = help: hold its button BOOTSEL while you plug it in; then there is a drive {}\n  \
             = help: or write a .uf2 with -o, and drag it there\n  \
             = help: on a board that has the firmware, `uno200 flash` writes over its line",
            drive.board_id
        )
    };
    let id = info.lines().find_map(|line| line.strip_prefix(BOARD_ID)).unwrap_or_default().trim();
    ensure!(
        id == drive.board_id,
        "{place} is the drive of another board: {id}, not {}",
        drive.board_id
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use plc_isa::{PICO, PICO_DRIVE, UNO};

    use super::*;

    #[test]
    fn only_onto_the_drive_of_the_board() {
        let folder = tempfile::tempdir().unwrap();
        let refused = || format!("{:#}", write(folder.path(), &PICO, "p", &[1]).unwrap_err());
        assert!(refused().contains("hold its button BOOTSEL"), "{}", refused());
        let says = |text: &str| fs::write(folder.path().join(INFO), text).unwrap();
        says("UF2 Bootloader v2.0\nModel: BBC micro:bit\nBoard-ID: NRF51\n");
        assert!(refused().contains("another board: NRF51, not RPI-RP2"), "{}", refused());
        assert!(!folder.path().join("p.uf2").exists());
        says("UF2 Bootloader v3.0\r\nModel: Raspberry Pi RP2\r\nBoard-ID: RPI-RP2\r\n");
        write(folder.path(), &PICO, "p", &[1]).unwrap();
        let written = fs::read(folder.path().join("p.uf2")).unwrap();
        assert!(written == uf2_file(&PICO, &[1]).unwrap());
    }

    #[test]
    fn a_board_without_a_drive_is_told_which_has_one() {
        let error = uf2_file(&UNO, &[1]).unwrap_err().to_string();
        assert!(error.contains("for the Uno") && error.contains("--board pico"), "{error}");
    }

    #[test]
    fn what_is_part_of_this_program_is_firmware() {
        let room = PICO_DRIVE.slot_start - PICO_DRIVE.flash_start;
        assert!((0x1000..room as usize).contains(&PICO_FIRMWARE.len()));
        // After the second boot stage: stack, then the address where it starts, in flash.
        let vector = PICO_FIRMWARE[0x104..0x108].first_chunk().copied().unwrap();
        let start = u32::from_le_bytes(vector);
        assert!((PICO_DRIVE.flash_start..PICO_DRIVE.slot_start).contains(&start), "{start:#x}");
    }
}
