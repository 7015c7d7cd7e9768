//! Programs that come over the line. The memory for them has two slots, of which one is in force: a
//! program is written to the other one, and that is changed by a record.
//!
//! A slot is half of the memory. Its last sector has the record: a sequence number and its
//! checksum. The slot with the higher one is in force, without a record the first one. A record is
//! erased before anything else is written to its slot, and written when all else is; so wherever
//! the power is cut, the old program is in force or the new one, and nothing is ever copied.

use embedded_storage::nor_flash::NorFlash;
use plc_isa::Crc32;

use crate::storage::{ERASED, PIECE, read, unit};

/// Sequence number, checksum.
const RECORD_LEN: usize = 8;
/// Begins the checksum: that of erased bytes alone would be right.
const RECORD: u8 = 0xD0;

/// The memory has failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Failed;

/// What is in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InForce {
    /// 0 or 1.
    pub slot: u8,
    /// 0: there is no record.
    sequence: u32,
}

impl InForce {
    /// The slot that is in force.
    pub fn of<S: NorFlash>(storage: &mut S) -> InForce {
        let [first, second] = [0, 1].map(|slot| sequence(storage, slot));
        let is_second = second > first;
        InForce { slot: is_second.into(), sequence: first.max(second) }
    }
}

/// A program that comes.
#[derive(Debug, Clone)]
pub struct Download {
    /// Its bytes; 0: none comes.
    len: u16,
    received: u16,
    /// Those that were not written yet, each at its place.
    piece: [u8; PIECE],
}

impl Download {
    /// None comes.
    pub const NONE: Download = Download { len: 0, received: 0, piece: [ERASED; PIECE] };

    /// A program of so many bytes comes.
    pub fn begin<S: NorFlash>(&mut self, storage: &mut S, len: u16) -> Result<(), Failed> {
        *self = Download::NONE;
        let slot = target(storage);
        let record = record_at(storage, slot);
        if u32::from(len) > slot_len(storage) {
            return Err(Failed);
        }
        storage.erase(record, record + S::ERASE_SIZE as u32).map_err(|_| Failed)?;
        self.len = len;
        Ok(())
    }

    /// How many bytes have come; `None` where no program comes.
    pub fn received(&self) -> Option<u16> {
        (self.len != 0).then_some(self.received)
    }

    /// How many are still to come.
    pub fn missing(&self) -> u16 {
        self.len - self.received
    }

    /// Takes the next byte. With the last one of a piece that is written; in a sector that is
    /// erased before its first piece is.
    pub fn take<S: NorFlash>(&mut self, storage: &mut S, byte: u8) -> Result<(), Failed> {
        let place = usize::from(self.received) % PIECE;
        self.piece[place] = byte;
        self.received += 1;
        if place + 1 < PIECE && self.missing() > 0 {
            return Ok(());
        }
        let at = u32::from(self.received - 1) / PIECE as u32 * PIECE as u32;
        let written = self.write(storage, at);
        self.piece = [ERASED; PIECE];
        if written.is_err() {
            *self = Download::NONE;
        }
        written
    }

    fn write<S: NorFlash>(&self, storage: &mut S, offset: u32) -> Result<(), Failed> {
        let slot = target(storage);
        let at = slot_at(storage, slot) + offset;
        let sector_len = S::ERASE_SIZE as u32;
        if offset.is_multiple_of(sector_len) {
            storage.erase(at, at + sector_len).map_err(|_| Failed)?;
        }
        storage.write(at, &self.piece).map_err(|_| Failed)
    }

    /// The slot that has all of the program now; `None` if something is missing. No program comes
    /// after that.
    pub fn end<S: NorFlash>(&mut self, storage: &mut S) -> Option<u8> {
        let is_complete = self.len != 0 && self.missing() == 0;
        *self = Download::NONE;
        is_complete.then(|| target(storage))
    }
}

/// Brings the slot that is not in force into force.
pub fn bring_into_force<S: NorFlash>(storage: &mut S) -> Result<(), Failed> {
    let slot = target(storage);
    let sequence = InForce::of(storage).sequence.wrapping_add(1);
    let mut record = [ERASED; PIECE];
    record[..RECORD_LEN].copy_from_slice(&record_of(sequence));
    let record = &record[..RECORD_LEN.next_multiple_of(unit::<S>())];
    let at = record_at(storage, slot);
    storage.write(at, record).map_err(|_| Failed)?;
    if InForce::of(storage).slot == slot { Ok(()) } else { Err(Failed) }
}

/// The slot that is not in force, which is written.
fn target<S: NorFlash>(storage: &mut S) -> u8 {
    1 - InForce::of(storage).slot
}

/// Bytes of a slot, with its record.
fn half<S: NorFlash>(storage: &S) -> u32 {
    storage.capacity() as u32 / 2
}

/// Bytes that a program in a slot can have.
fn slot_len<S: NorFlash>(storage: &S) -> u32 {
    half(storage).saturating_sub(S::ERASE_SIZE as u32)
}

fn slot_at<S: NorFlash>(storage: &S, slot: u8) -> u32 {
    half(storage) * u32::from(slot)
}

fn record_at<S: NorFlash>(storage: &S, slot: u8) -> u32 {
    slot_at(storage, slot) + slot_len(storage)
}

fn record_of(sequence: u32) -> [u8; RECORD_LEN] {
    let [a, b, c, d] = sequence.to_le_bytes();
    let mut crc = Crc32::new();
    [RECORD, a, b, c, d].into_iter().for_each(|byte| crc.byte(byte));
    let [e, f, g, h] = crc.value().to_le_bytes();
    [a, b, c, d, e, f, g, h]
}

/// The sequence number in the record of a slot; 0 without one.
fn sequence<S: NorFlash>(storage: &mut S, slot: u8) -> u32 {
    let (at, mut bytes) = (record_at(storage, slot), [ERASED; RECORD_LEN]);
    read(storage, at, RECORD_LEN, |offset, byte| bytes[offset] = byte);
    let [a, b, c, d, ..] = bytes;
    let sequence = u32::from_le_bytes([a, b, c, d]);
    if bytes == record_of(sequence) { sequence } else { 0 }
}
