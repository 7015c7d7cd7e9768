//! Intel HEX as avrdude takes it: an image at the program slot, and the firmware.

use ihex::{Reader, ReaderError, Record, WriterError, create_object_file_representation};
use plc_isa::UNO;

/// The Uno's firmware as Intel HEX, built with the compilers that `awl-asm/firmware/compilers.txt`
/// names: nobody needs a compiler for the board to set one up.
pub const FIRMWARE: &str = include_str!("../../firmware/uno200.hex");

const RECORD_LEN: usize = 16;

/// The image as Intel HEX records. Images fit below 64 KB, so that no extended addresses are
/// needed.
pub fn intel_hex(image: &[u8]) -> Result<String, WriterError> {
    let records = image.chunks(RECORD_LEN).zip((UNO.slot_start..).step_by(RECORD_LEN));
    let mut records: Vec<Record> =
        records.map(|(bytes, offset)| Record::Data { offset, value: bytes.to_vec() }).collect();
    records.push(Record::EndOfFile);
    create_object_file_representation(&records)
}

/// The Uno's flash from address 0 on with this firmware, Intel HEX, and the image in the program
/// slot. What neither of them uses is erased, 0xFF; what follows the slot is not there.
pub fn flash(firmware: &str, image: &[u8]) -> Result<Vec<u8>, ReaderError> {
    let slot = usize::from(UNO.slot_start);
    let mut flash = vec![u8::MAX; slot + usize::from(UNO.slot_len)];
    for record in Reader::new(firmware) {
        if let Record::Data { offset, value } = record? {
            lay(&mut flash, usize::from(offset), &value);
        }
    }
    lay(&mut flash, slot, image);
    Ok(flash)
}

/// Writes bytes as far as there is room for them.
fn lay(flash: &mut [u8], at: usize, bytes: &[u8]) {
    let room = flash.get_mut(at..).unwrap_or_default();
    let len = bytes.len().min(room.len());
    room[..len].copy_from_slice(&bytes[..len]);
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
        assert_eq!(flash[0..2], [0x0C, 0x94], "a jump");
        for record in Reader::new(FIRMWARE).chain(Reader::new(&intel_hex(&image).unwrap())) {
            if let Record::Data { offset, value } = record.unwrap() {
                assert_eq!(flash[usize::from(offset)..][..value.len()], value);
            }
        }
        assert!(super::flash(":00000001FE\n", &image).is_err(), "a wrong checksum");
        assert!(super::flash("", &vec![0; 0x9000]).is_ok(), "too long");
    }
}
