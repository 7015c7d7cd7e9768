//! Intel HEX as avrdude takes it: an image at the program slot, and the firmware.

use std::fmt;

use ihex::{Reader, ReaderError, Record, WriterError, create_object_file_representation};
use plc_isa::UNO;

/// The Uno's firmware as Intel HEX, built with the compilers that `awl-asm/firmware/compilers.txt`
/// names: nobody needs a compiler for the board to set one up.
pub const FIRMWARE: &str = include_str!("../../firmware/uno200.hex");

const RECORD_LEN: usize = 16;
/// What flash has where nothing is written.
const BLANK: u8 = 0xFF;

/// The image as Intel HEX records. Images fit below 64 KB, so that no extended addresses are
/// needed.
pub fn intel_hex(image: &[u8]) -> Result<String, WriterError> {
    let records = image.chunks(RECORD_LEN).zip((UNO.slot_start..).step_by(RECORD_LEN));
    let mut records: Vec<Record> =
        records.map(|(bytes, offset)| Record::Data { offset, value: bytes.to_vec() }).collect();
    records.push(Record::EndOfFile);
    create_object_file_representation(&records)
}

/// What makes that Intel HEX is no firmware.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoFirmware {
    /// It is no Intel HEX.
    Hex(ReaderError),
    /// It reaches into the program slot.
    InSlot,
    /// It lies beyond the board's flash.
    Beyond,
    /// There is nothing at address 0.
    Headless,
}

impl fmt::Display for NoFirmware {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoFirmware::Hex(error) => error.fmt(f),
            NoFirmware::InSlot => {
                let start = UNO.slot_start;
                write!(f, "it reaches into the program slot, which begins at {start:#06x}")
            }
            NoFirmware::Beyond => f.write_str("it lies beyond the board's flash"),
            NoFirmware::Headless => f.write_str("there is nothing at address 0"),
        }
    }
}

impl std::error::Error for NoFirmware {}

/// The bytes of firmware in Intel HEX, from address 0; gaps are as blank flash is.
///
/// It is refused where it is not where firmware is: a program that was taken for it would leave a
/// new board without any.
pub fn firmware(text: &str) -> Result<Vec<u8>, NoFirmware> {
    let mut bytes = Vec::new();
    let mut starts_at_zero = false;
    for record in Reader::new(text) {
        match record.map_err(NoFirmware::Hex)? {
            Record::Data { offset, value } => {
                starts_at_zero |= offset == 0;
                let (start, end) = (usize::from(offset), usize::from(offset) + value.len());
                if end > usize::from(UNO.slot_start) {
                    return Err(NoFirmware::InSlot);
                }
                bytes.resize(bytes.len().max(end), BLANK);
                bytes[start..end].copy_from_slice(&value);
            }
            Record::ExtendedSegmentAddress(base) | Record::ExtendedLinearAddress(base) => {
                if base != 0 {
                    return Err(NoFirmware::Beyond);
                }
            }
            Record::EndOfFile => {}
            Record::StartSegmentAddress { .. } | Record::StartLinearAddress(_) => {}
        }
    }
    if starts_at_zero { Ok(bytes) } else { Err(NoFirmware::Headless) }
}

/// The Uno's flash from address 0 on with this firmware, Intel HEX, and the image in the program
/// slot. What neither of them uses is erased; what follows the slot is not there.
pub fn flash(firmware: &str, image: &[u8]) -> Result<Vec<u8>, NoFirmware> {
    let slot = usize::from(UNO.slot_start);
    let mut flash = self::firmware(firmware)?;
    flash.resize(slot, BLANK);
    flash.extend_from_slice(image);
    flash.resize(slot + usize::from(UNO.slot_len), BLANK);
    Ok(flash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn firmware_and_program_lie_in_flash_where_their_records_say() {
        let image = [1, 2, 3];
        let flash = flash(FIRMWARE, &image).unwrap();
        let slot = usize::from(UNO.slot_start);
        assert_eq!(flash.len(), slot + usize::from(UNO.slot_len));
        assert_eq!(flash[slot..slot + 4], [1, 2, 3, 0xFF]);
        for record in Reader::new(FIRMWARE).chain(Reader::new(&intel_hex(&image).unwrap())) {
            if let Record::Data { offset, value } = record.unwrap() {
                assert_eq!(flash[usize::from(offset)..][..value.len()], value);
            }
        }
        assert!(super::flash(":00000001FE\n", &image).is_err(), "a wrong checksum");
    }

    #[test]
    fn what_is_part_of_this_program_is_firmware() {
        let bytes = firmware(FIRMWARE).unwrap();
        // A vector is a jump.
        assert_eq!(bytes[..2], [0x0C, 0x94]);
        assert!(bytes.len() > 8 * 1024 && bytes.len() <= usize::from(UNO.slot_start));
    }

    #[test]
    fn firmware_lies_below_the_slot() {
        let hex = |records: &[Record]| create_object_file_representation(records).unwrap();
        let data = |offset: u16| Record::Data { offset, value: vec![0x0C, 0x94] };
        let of = |records: &[Record]| firmware(&hex(records));
        let whole = of(&[data(4), data(0), Record::EndOfFile]).unwrap();
        assert_eq!(whole, [0x0C, 0x94, 0xFF, 0xFF, 0x0C, 0x94]);
        assert!(of(&[data(0), data(UNO.slot_start - 2), Record::EndOfFile]).is_ok());
        let slot = [data(0), data(UNO.slot_start - 1), Record::EndOfFile];
        assert_eq!(of(&slot), Err(NoFirmware::InSlot));
        assert_eq!(of(&[data(2), Record::EndOfFile]), Err(NoFirmware::Headless));
        let beyond = [Record::ExtendedLinearAddress(1), data(0), Record::EndOfFile];
        assert_eq!(of(&beyond), Err(NoFirmware::Beyond));
        assert_eq!(firmware(&intel_hex(&[1, 2, 3]).unwrap()), Err(NoFirmware::InSlot));
        assert!(matches!(firmware("not a hex file"), Err(NoFirmware::Hex(_))));
        let damaged = hex(&[data(0), Record::EndOfFile]).replacen("0C", "0D", 1);
        assert!(matches!(firmware(&damaged), Err(NoFirmware::Hex(_))), "wrong checksum");
    }
}
