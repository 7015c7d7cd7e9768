//! Intel HEX of an image at the program slot, as avrdude takes it.

use ihex::{Record, WriterError, create_object_file_representation};
use plc_isa::SLOT_START;

const RECORD_LEN: usize = 16;

/// The image as Intel HEX records. Images fit below 64 KB, so that no extended addresses are needed.
pub fn intel_hex(image: &[u8]) -> Result<String, WriterError> {
    let records = image.chunks(RECORD_LEN).zip((SLOT_START..).step_by(RECORD_LEN));
    let mut records: Vec<Record> =
        records.map(|(bytes, offset)| Record::Data { offset, value: bytes.to_vec() }).collect();
    records.push(Record::EndOfFile);
    create_object_file_representation(&records)
}
