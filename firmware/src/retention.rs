//! Retained values: kept in the EEPROM in a ring of copies, so that a power cut leaves the last
//! complete one.
//!
//! A copy is a sequence number, the values and a checksum, which also covers what the values belong
//! to. The oldest copy is overwritten, byte by byte in the background, from a snapshot after the
//! program's own memory. What is saved when, and how long the EEPROM lives: docs/retention.md.

use plc_isa::{
    Crc32, Plan, ProgramMemory, RETENTION_COPY_INTERVAL_MS, RETENTION_INTERVAL_MIN_MS,
    RETENTION_LEN, RETENTION_OVERHEAD, RetainedWalk,
};
use plc_vm::Memory;

use crate::board::clock;
use crate::board::eeprom::Eeprom;

/// Between two writes of one copy.
const COPY_INTERVAL: u16 = units(RETENTION_COPY_INTERVAL_MS);
/// However many copies there are, changes are saved no more often.
const INTERVAL_MIN: u16 = units(RETENTION_INTERVAL_MIN_MS);
/// Bytes compared, or looked at before one is written, in a scan.
const BYTES_PER_SCAN: u8 = 4;
/// Bytes of a sequence number, which begins a copy.
const SEQUENCE_LEN: u16 = 2;
/// What an erased byte holds.
const ERASED: u8 = 0xFF;

/// Waiting is measured in units of 256 ms, which is near enough and fits 16 bits.
const fn units(ms: u32) -> u16 {
    ms.div_ceil(256) as u16
}

fn unit_of(ms: u32) -> u16 {
    (ms >> 8) as u16
}

/// What is being done, a little in every scan.
#[derive(Clone, Copy)]
enum Phase {
    /// Looks for values that differ from the last copy.
    Comparing,
    /// Nothing valid was found. What others have left is erased, so that none of it is ever taken
    /// for the last copy. The first copy waits for the end of a scan, which has seen that values
    /// were lost.
    Erasing,
    /// Writes the snapshot.
    Writing,
}

/// The retained values of a program.
pub struct Retention {
    /// Bytes of values; 0: nothing is retained.
    len: u16,
    /// Checksum of what the values are: begins the checksum of every copy.
    identity: Crc32,
    /// Where the copy begins that is or was written last.
    copy: u16,
    /// Its sequence number.
    sequence: u16,
    /// When it was begun, and how long the next one waits, both in units of time.
    saved: u16,
    interval: u16,
    phase: Phase,
    /// Enough time has passed since the last copy.
    is_due: bool,
    /// Bytes that the phase is done with.
    done: u16,
    /// How far the comparison has come.
    walk: RetainedWalk,
    /// Checksum of what is written of the copy.
    crc: Crc32,
    /// A scan has been executed since the values were lost.
    has_run: bool,
}

impl Retention {
    /// Nothing is retained.
    pub const fn none() -> Retention {
        Retention {
            len: 0,
            identity: Crc32::new(),
            copy: 0,
            sequence: 0,
            saved: 0,
            interval: 0,
            phase: Phase::Comparing,
            is_due: false,
            done: 0,
            walk: RetainedWalk::START,
            crc: Crc32::new(),
            has_run: false,
        }
    }

    /// Brings the values of the last complete copy back. Returns whether there should be one and is
    /// none.
    #[inline(never)]
    pub fn restore<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        eeprom: &Eeprom,
    ) -> bool {
        self.identity = Crc32::new();
        self.len = plan.retained_into(&mut self.identity);
        if self.len == 0 {
            return false;
        }
        // A write that a reset has interrupted goes on.
        while !eeprom.is_ready() {}
        // The first change is saved at once.
        self.is_due = true;
        self.has_run = false;
        let is_found = self.find_last(plan, memory, eeprom);
        if is_found {
            self.read_copy(self.copy, plan, memory, eeprom);
            self.exchange(plan, memory, true);
        }
        self.exchange(plan, memory, false);
        self.enter(if is_found { Phase::Comparing } else { Phase::Erasing });
        !is_found
    }

    /// Bytes of the values.
    pub fn len(&self) -> u16 {
        self.len
    }

    fn copy_len(&self) -> u16 {
        self.len + RETENTION_OVERHEAD
    }

    /// Looks for the newest complete copy. The number of copies there can be gives the time between
    /// two.
    #[inline(never)]
    fn find_last<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        eeprom: &Eeprom,
    ) -> bool {
        let (mut at, mut copies, mut is_found) = (0, 0, false);
        (self.copy, self.sequence) = (0, 0);
        while at + self.copy_len() <= RETENTION_LEN {
            if self.read_copy(at, plan, memory, eeprom) {
                let sequence = u16::from_le_bytes([eeprom.read(at), eeprom.read(at + 1)]);
                // Sequence numbers wrap; all in the ring lie close together.
                if !is_found || sequence.wrapping_sub(self.sequence) as i16 > 0 {
                    (self.copy, self.sequence, is_found) = (at, sequence, true);
                }
            }
            at += self.copy_len();
            copies += 1;
        }
        self.interval = (COPY_INTERVAL / copies.max(1)).max(INTERVAL_MIN);
        is_found
    }

    /// Reads a whole copy to a place after the program's memory, which leaves room for it. Returns
    /// whether it is complete.
    #[inline(never)]
    fn read_copy<P: ProgramMemory>(
        &mut self,
        mut at: u16,
        plan: &Plan<P>,
        memory: &mut Memory,
        eeprom: &Eeprom,
    ) -> bool {
        self.enter(Phase::Comparing);
        let (mut place, end) = (plan.end(), at + self.copy_len());
        while at != end {
            let byte = eeprom.read(at);
            memory.set_byte(place, byte);
            self.crc.byte(byte);
            (at, place) = (at + 1, place + 1);
        }
        self.crc.ends()
    }

    /// Brings the values to the snapshot after the program's memory, or `back` to where they
    /// belong from a copy there.
    #[inline(never)]
    fn exchange<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, back: bool) {
        self.walk = RetainedWalk::START;
        let mut place = plan.end();
        if back {
            place += SEQUENCE_LEN;
        }
        while self.walk.next(plan, u16::MAX) {
            let (from, to) =
                if back { (place, self.walk.address) } else { (self.walk.address, place) };
            memory.copy(from, to, self.walk.len);
            place += self.walk.len;
        }
    }

    #[inline(never)]
    fn enter(&mut self, phase: Phase) {
        self.phase = phase;
        self.done = 0;
        self.walk = RetainedWalk::START;
        self.crc = self.identity;
    }

    /// Time goes on. Once it is over the wait stays over, also when the clock wraps.
    pub fn tick(&mut self, now_ms: u32) {
        self.is_due |= unit_of(now_ms).wrapping_sub(self.saved) > self.interval;
    }

    /// Whether there is anything to do after a scan. Out of RUN changes are saved at once.
    #[inline(always)]
    pub fn is_busy(&self, runs: bool) -> bool {
        self.len != 0 && (self.is_due || !runs || !matches!(self.phase, Phase::Comparing))
    }

    /// A little work after a scan in which there is, and in which the program `was_executed` or
    /// not.
    pub fn step<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        eeprom: &Eeprom,
        was_executed: bool,
    ) {
        self.has_run |= was_executed;
        if matches!(self.phase, Phase::Comparing) {
            self.compare(plan, memory);
        } else if eeprom.is_ready() {
            self.write(plan, memory, eeprom);
        }
    }

    fn compare<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        if !self.walk.next(plan, u16::from(BYTES_PER_SCAN)) {
            return self.enter(Phase::Comparing);
        }
        let copy = plan.end() + self.done;
        self.done += self.walk.len;
        for offset in 0..self.walk.len {
            if memory.byte(self.walk.address + offset) != memory.byte(copy + offset) {
                return self.begin(plan, memory);
            }
        }
    }

    /// Begins the next copy.
    #[inline(never)]
    fn begin<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        self.exchange(plan, memory, false);
        self.copy += self.copy_len();
        if self.copy + self.copy_len() > RETENTION_LEN {
            self.copy = 0;
        }
        self.sequence = self.sequence.wrapping_add(1);
        self.saved = unit_of(clock::now_ms());
        self.is_due = false;
        self.enter(Phase::Writing);
    }

    /// Goes on with the copy, or with erasing: over bytes that are right already up to one that is
    /// written.
    fn write<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom) {
        for _ in 0..BYTES_PER_SCAN {
            let is_erasing = matches!(self.phase, Phase::Erasing);
            if self.done == if is_erasing { RETENTION_LEN } else { self.copy_len() } {
                if !is_erasing {
                    self.enter(Phase::Comparing);
                } else if self.has_run {
                    self.begin(plan, memory);
                }
                return;
            }
            let byte = if is_erasing { ERASED } else { self.next_byte(plan, memory) };
            let address = self.copy + self.done;
            self.done += 1;
            if eeprom.update(address, byte) {
                return;
            }
        }
    }

    /// The next byte of the copy.
    fn next_byte<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &Memory) -> u8 {
        let byte = match self.done {
            0 => self.sequence as u8,
            1 => (self.sequence >> 8) as u8,
            done if done < SEQUENCE_LEN + self.len => memory.byte(plan.end() + done - SEQUENCE_LEN),
            _ => {
                // Its own lowest byte moves the rest of the checksum down.
                let byte = self.crc.value() as u8;
                self.crc.byte(!byte);
                return byte;
            }
        };
        self.crc.byte(byte);
        byte
    }
}
