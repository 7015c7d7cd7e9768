//! Reads Intel HEX, as programmers take it. Nothing is loaded here.

use ihex::{Reader, Record};

use crate::elf::LoadError;

/// The data of a file: address and bytes, record by record.
pub(crate) fn parse(text: &str) -> Result<Vec<(u32, Vec<u8>)>, LoadError> {
    let mut parts = Vec::new();
    let mut base = 0;
    for record in Reader::new(text) {
        match record.map_err(|error| LoadError(format!("no Intel HEX: {error}")))? {
            Record::Data { offset, value } => parts.push((base + u32::from(offset), value)),
            Record::ExtendedSegmentAddress(segment) => base = u32::from(segment) << 4,
            Record::ExtendedLinearAddress(high) => base = u32::from(high) << 16,
            Record::EndOfFile => return Ok(parts),
            // Where a program starts: an AVR starts where its fuses say.
            Record::StartSegmentAddress { .. } | Record::StartLinearAddress(_) => {}
        }
    }
    Err(LoadError("no Intel HEX: the end record is missing".to_string()))
}
