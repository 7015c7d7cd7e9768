//! Retained values in flash: records one after the other through its sectors, so that all of them
//! wear alike and a power cut leaves the last complete record.
//!
//! A record is a head (length, sequence number, checksum of these), the values and a checksum of
//! all, which also covers what the values belong to. It is written from a snapshot after the
//! program's own memory, which leaves room for it, a piece in every scan. A sector is erased when
//! the first record goes to it; the last complete record is always in another one.

use embedded_storage::nor_flash::NorFlash;
use plc_isa::{
    Crc32, Plan, Profile, ProgramMemory, RETENTION_COPY_INTERVAL_MS, RETENTION_INTERVAL_MIN_MS,
    RetainedWalk,
};
use plc_vm::Memory;

use crate::storage::{ERASED, PIECE, is_erased, read, unit};

/// The least there must be: what is erased is never what was written last.
pub const SECTORS_MIN: u32 = 2;

/// Length, sequence number, checksum.
const HEAD_LEN: usize = 6 + CRC_LEN;
const CRC_LEN: usize = 4;
/// In STOP, from a failure of the memory to the next attempt.
const RETRY_MS: u32 = 1000;
/// Bytes compared in a scan.
const COMPARED: u16 = 16;

/// Whether all that a program of this profile can retain fits a sector, and pieces are as memory of
/// this kind takes them.
pub const fn fits<S: NorFlash>(profile: &Profile) -> bool {
    record_len::<S>(profile.retained_max()) as usize <= S::ERASE_SIZE
        && PIECE.is_multiple_of(unit::<S>())
}

/// What is being done, a little in every scan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Looks for values that differ from the last record; so many bytes do not.
    Comparing(u16),
    /// Writes the record at `at`; so many of its bytes are written.
    Writing(u32),
}

/// The retained values of a program.
#[derive(Debug, Clone)]
pub struct Retention {
    /// Bytes of values; 0: nothing is retained.
    len: u16,
    /// Checksum of what the values are: begins the checksum of every record.
    identity: Crc32,
    /// Where the next record begins.
    at: u32,
    /// The sequence number of the last one; 0: there was none.
    sequence: u32,
    /// Where the last complete record of these values begins: its sector is never erased.
    last: Option<u32>,
    /// When it was begun, and how long the next one waits.
    saved_ms: u32,
    interval_ms: u32,
    /// The next change is saved without waiting.
    is_due: bool,
    /// There is no record of these values, and no scan has seen that yet.
    is_first: bool,
    /// The values were not saved: the memory has failed.
    is_unsaved: bool,
    phase: Phase,
    walk: RetainedWalk,
    /// Checksum of what is written of the record.
    crc: Crc32,
}

impl Retention {
    /// Nothing is retained.
    pub const NONE: Retention = Retention {
        len: 0,
        identity: Crc32::new(),
        at: 0,
        sequence: 0,
        last: None,
        saved_ms: 0,
        interval_ms: 0,
        is_due: false,
        is_first: false,
        is_unsaved: false,
        phase: Phase::Comparing(0),
        walk: RetainedWalk::START,
        crc: Crc32::new(),
    };

    /// Brings the values of the last complete record back. Returns whether there should be one and
    /// is none.
    pub fn restore<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        storage: &mut S,
        now_ms: u32,
    ) -> bool {
        *self = Retention::NONE;
        self.len = plan.retained_into(&mut self.identity);
        if self.len == 0 {
            return false;
        }
        if (storage.capacity() as u32) < SECTORS_MIN * S::ERASE_SIZE as u32 {
            self.len = 0;
            return true;
        }
        self.find_last(storage);
        if let Some(record) = self.last {
            read_values(storage, record, plan.end(), self.len, memory);
            exchange(plan, memory, true);
        }
        exchange(plan, memory, false);
        self.saved_ms = now_ms;
        // The first change is saved at once.
        self.is_due = true;
        self.is_first = self.last.is_none();
        self.is_first
    }

    /// Looks for the last complete record of these values, and where the next one goes.
    fn find_last<S: NorFlash>(&mut self, storage: &mut S) {
        if let Some(Record { sequence, end, .. }) = newest(storage, |_, _| true) {
            (self.sequence, self.at) = (sequence, end);
        }
        // From the newest down: most often that is it, and few bytes are read.
        let len = self.len;
        let mut found = newest(storage, |its_len, _| its_len == len);
        while let Some(Record { sequence, at, .. }) = found {
            if self.is_complete(storage, at) {
                self.last = Some(at);
                break;
            }
            found = newest(storage, |its_len, its| its_len == len && its < sequence);
        }
        let sectors = storage.capacity() as u32 / S::ERASE_SIZE as u32;
        let copies = sectors * (S::ERASE_SIZE as u32 / record_len::<S>(self.len)).max(1);
        let interval_ms = RETENTION_COPY_INTERVAL_MS / copies.max(1);
        self.interval_ms = interval_ms.max(RETENTION_INTERVAL_MIN_MS);
    }

    fn is_complete<S: NorFlash>(&self, storage: &mut S, at: u32) -> bool {
        let mut crc = self.identity;
        let len = HEAD_LEN + usize::from(self.len) + CRC_LEN;
        let is_read = read(storage, at, len, |_, byte| crc.byte(byte));
        is_read && crc.ends()
    }

    /// Whether there is anything to do after a scan. Out of RUN changes are saved at once.
    #[inline(always)]
    pub fn is_busy(&self, runs: bool, now_ms: u32) -> bool {
        let waits_ms = match (runs, self.is_unsaved) {
            (true, _) => self.interval_ms,
            (false, true) => RETRY_MS,
            (false, false) => 0,
        };
        self.len != 0
            && (self.is_due
                || matches!(self.phase, Phase::Writing(_))
                || now_ms.wrapping_sub(self.saved_ms) >= waits_ms)
    }

    /// A little work after a scan in which there is, and in which the program `was_executed` or
    /// not.
    pub fn step<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        storage: &mut S,
        was_executed: bool,
        now_ms: u32,
    ) {
        match self.phase {
            // The first scan has seen that values were lost.
            Phase::Comparing(_) if self.is_first && !was_executed => {}
            Phase::Comparing(_) if self.is_first || self.is_unsaved => {
                self.begin(plan, memory, storage, now_ms);
            }
            Phase::Comparing(done) => self.compare(plan, memory, storage, done, now_ms),
            Phase::Writing(done) => {
                if !self.write(plan, memory, storage, done) {
                    self.fail(S::ERASE_SIZE as u32, now_ms);
                }
            }
        }
    }

    /// Saves at once what has changed, before another program comes.
    pub fn finish<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        storage: &mut S,
        now_ms: u32,
    ) {
        if self.len == 0 || self.is_first {
            return;
        }
        // First a record that was begun, whose values are older.
        for _ in 0..2 {
            self.walk_again();
            loop {
                self.step(plan, memory, storage, true, now_ms);
                if self.phase == Phase::Comparing(0) {
                    break;
                }
            }
        }
    }

    fn walk_again(&mut self) {
        if matches!(self.phase, Phase::Comparing(_)) {
            (self.phase, self.walk) = (Phase::Comparing(0), RetainedWalk::START);
        }
    }

    fn compare<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        storage: &mut S,
        done: u16,
        now_ms: u32,
    ) {
        if !self.walk.next(plan, COMPARED) {
            self.walk = RetainedWalk::START;
            self.phase = Phase::Comparing(0);
            return;
        }
        let RetainedWalk { address, len, .. } = self.walk;
        let copy = plan.end() + done;
        self.phase = Phase::Comparing(done + len);
        if (0..len).any(|offset| memory.byte(address + offset) != memory.byte(copy + offset)) {
            self.begin(plan, memory, storage, now_ms);
        }
    }

    /// Begins the next record: in this sector where there is room, otherwise in the next one, which
    /// is erased.
    fn begin<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        storage: &mut S,
        now_ms: u32,
    ) {
        let sector_len = S::ERASE_SIZE as u32;
        let len = record_len::<S>(self.len);
        let is_free = self.at % sector_len + len <= sector_len
            && !self.at.is_multiple_of(sector_len)
            && is_erased(storage, self.at, len);
        if !is_free {
            self.at = self.next_sector(storage);
            // Where there was never a record, what reads as erased was never anything else.
            // Otherwise the power may have been cut while a sector was erased, and it looks so and
            // is not.
            let is_fresh = self.sequence == 0 && is_erased(storage, self.at, sector_len);
            if !is_fresh && storage.erase(self.at, self.at + sector_len).is_err() {
                return self.fail(sector_len, now_ms);
            }
        }
        exchange(plan, memory, false);
        self.sequence = self.sequence.wrapping_add(1);
        (self.saved_ms, self.is_due, self.is_first) = (now_ms, false, false);
        self.is_unsaved = false;
        (self.phase, self.crc) = (Phase::Writing(0), self.identity);
        self.walk = RetainedWalk::START;
    }

    /// The memory does not do what it should: the next sector is tried, after the usual time.
    fn fail(&mut self, sector_len: u32, now_ms: u32) {
        self.at = (self.at / sector_len + 1) * sector_len;
        (self.phase, self.walk) = (Phase::Comparing(0), RetainedWalk::START);
        (self.saved_ms, self.is_due, self.is_unsaved) = (now_ms, false, true);
    }

    /// The sector after the place of the next record, in a ring; not the one with the last complete
    /// record.
    fn next_sector<S: NorFlash>(&self, storage: &S) -> u32 {
        let sector_len = S::ERASE_SIZE as u32;
        let sectors = storage.capacity() as u32 / sector_len;
        let mut sector = self.at.div_ceil(sector_len) % sectors;
        if self.last.is_some_and(|last| last / sector_len == sector) {
            sector = (sector + 1) % sectors;
        }
        sector * sector_len
    }

    /// Writes the next piece of the record; whether it could be written.
    fn write<P: ProgramMemory, S: NorFlash>(
        &mut self,
        plan: &Plan<P>,
        memory: &Memory,
        storage: &mut S,
        done: u32,
    ) -> bool {
        let len = record_len::<S>(self.len);
        let mut piece = [ERASED; PIECE];
        let count = (len - done).min(PIECE as u32);
        for (place, offset) in piece.iter_mut().zip(done..done + count) {
            *place = self.byte(plan, memory, offset as usize);
        }
        let piece = piece.get(..count as usize).unwrap_or(&[]);
        if storage.write(self.at + done, piece).is_err() {
            return false;
        }
        self.phase = Phase::Writing(done + count);
        if done + count == len {
            self.last = Some(self.at);
            self.at += len;
            self.phase = Phase::Comparing(0);
        }
        true
    }

    /// The byte of the record at an offset; all of them are asked for once, in order.
    fn byte<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &Memory, offset: usize) -> u8 {
        let values_end = HEAD_LEN + usize::from(self.len);
        let byte = match offset {
            0..HEAD_LEN => head_bytes(self.len, self.sequence)[offset],
            _ if offset < values_end => memory.byte(plan.end() + (offset - HEAD_LEN) as u16),
            _ if offset < values_end + CRC_LEN => {
                // Its own lowest byte moves the rest of the checksum down.
                let byte = self.crc.value() as u8;
                self.crc.byte(!byte);
                return byte;
            }
            _ => return ERASED,
        };
        self.crc.byte(byte);
        byte
    }
}

fn head_bytes(len: u16, sequence: u32) -> [u8; HEAD_LEN] {
    let ([a, b], [c, d, e, f]) = (len.to_le_bytes(), sequence.to_le_bytes());
    let mut crc = Crc32::new();
    [a, b, c, d, e, f].into_iter().for_each(|byte| crc.byte(byte));
    let [g, h, i, j] = crc.value().to_le_bytes();
    [a, b, c, d, e, f, g, h, i, j]
}

/// A record as its head says.
#[derive(Debug, Clone, Copy)]
struct Record {
    sequence: u32,
    at: u32,
    end: u32,
}

/// The record with the highest sequence number among those of a length and a sequence number that
/// are `wanted`.
fn newest<S: NorFlash>(storage: &mut S, wanted: impl Fn(u16, u32) -> bool) -> Option<Record> {
    let mut newest: Option<Record> = None;
    let sector_len = S::ERASE_SIZE as u32;
    for sector in 0..storage.capacity() as u32 / sector_len {
        let (mut at, sector_end) = (sector * sector_len, (sector + 1) * sector_len);
        while let Some((len, sequence)) = head(storage, at, sector_end) {
            let end = at + record_len::<S>(len);
            let is_newer = newest.is_none_or(|one| sequence > one.sequence);
            if is_newer && wanted(len, sequence) {
                newest = Some(Record { sequence, at, end });
            }
            at = end;
        }
    }
    newest
}

/// Length and sequence number of the record at a place, if there is one and it ends before `end`.
fn head<S: NorFlash>(storage: &mut S, at: u32, end: u32) -> Option<(u16, u32)> {
    if at + record_len::<S>(0) > end {
        return None;
    }
    let mut bytes = [ERASED; HEAD_LEN];
    read(storage, at, HEAD_LEN, |offset, byte| {
        if let Some(place) = bytes.get_mut(offset) {
            *place = byte;
        }
    });
    let [a, b, c, d, e, f, ..] = bytes;
    let (len, sequence) = (u16::from_le_bytes([a, b]), u32::from_le_bytes([c, d, e, f]));
    let fits = at + record_len::<S>(len) <= end;
    (bytes == head_bytes(len, sequence) && fits).then_some((len, sequence))
}

/// Bytes of a record with so many bytes of values, with what fills it up to what can be written at
/// once.
const fn record_len<S: NorFlash>(len: u16) -> u32 {
    (HEAD_LEN + len as usize + CRC_LEN).next_multiple_of(unit::<S>()) as u32
}

/// Reads the values of a record to a place of data memory.
fn read_values<S: NorFlash>(
    storage: &mut S,
    record: u32,
    place: u16,
    len: u16,
    memory: &mut Memory,
) {
    read(storage, record, HEAD_LEN + usize::from(len), |offset, byte| {
        if let Some(value) = offset.checked_sub(HEAD_LEN) {
            memory.set_byte(place + value as u16, byte);
        }
    });
}

/// Brings the values to the snapshot after the program's memory, or `back` from there to where they
/// belong.
fn exchange<P: ProgramMemory>(plan: &Plan<P>, memory: &mut Memory, back: bool) {
    let (mut walk, mut place) = (RetainedWalk::START, plan.end());
    while walk.next(plan, u16::MAX) {
        let (from, to) = if back { (place, walk.address) } else { (walk.address, place) };
        memory.copy(from, to, walk.len);
        place += walk.len;
    }
}
