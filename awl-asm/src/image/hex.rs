//! Intel HEX as avrdude takes it: an image at the program slot, and the firmware.

use ihex::{Record, WriterError, create_object_file_representation};
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
