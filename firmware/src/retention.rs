//! Retained values: kept in the EEPROM in a ring of copies, so that a power cut leaves the last complete one.
//!
//! A copy is a sequence number, the values and a checksum, which also covers what the values belong to. The oldest
//! copy is overwritten, byte by byte in the background, from a snapshot behind the program's own memory. What is
//! saved when, and how long the EEPROM lives: docs/retention.md.

use plc_isa::{Crc32, Plan, ProgramMemory, RETENTION_LEN, RETENTION_OVERHEAD, RetainedWalk};
use plc_vm::Memory;

use crate::board::clock;
use crate::board::eeprom::Eeprom;

/// Ten years for each of the 100,000 times that a byte of the EEPROM can be written: between two writes of one copy.
const COPY_INTERVAL: u16 = units(3_155_760);
/// However many copies there are, changes are saved no more often.
const INTERVAL_MIN: u16 = units(60_000);
/// Bytes compared, or looked at before one is written, in a scan.
const BYTES_PER_SCAN: u8 = 4;
/// Bytes of a sequence number, which begins a copy.
const SEQUENCE_LEN: u16 = 2;

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
    /// Nothing valid was found. What others have left is erased, so that none of it is ever taken for the last copy.
    /// The first copy waits for the end of a scan, which has seen that values were lost.
    Erasing,
    /// Looks for values that differ from the last copy.
    Comparing,
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
    /// Nothing is retained. No constant: that would take SRAM a second time.
    #[inline(always)]
    pub fn none() -> Retention {
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

    /// Brings the values of the last complete copy back. Returns whether there should be one and is none.
    #[inline(never)]
    pub fn restore<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom) -> bool {
        self.len = plan.retained_len();
        if self.len == 0 {
            return false;
        }
        self.identity = plan.retained_identity();
        // A write that a reset has interrupted goes on.
        while !eeprom.is_ready() {}
        let is_lost = !self.find_last(eeprom);
        // The first change is saved at once.
        self.is_due = true;
        self.has_run = false;
        if is_lost {
            self.enter(Phase::Erasing);
        } else {
            self.read_back(plan, memory, eeprom);
            self.take_snapshot(plan, memory);
            self.enter(Phase::Comparing);
        }
        is_lost
    }

    fn copy_len(&self) -> u16 {
        self.len + RETENTION_OVERHEAD
    }

    /// Looks for the newest complete copy. The number of copies there can be gives the time between two.
    fn find_last(&mut self, eeprom: &Eeprom) -> bool {
        let (mut copies, mut found) = (0, false);
        (self.copy, self.sequence) = (0, 0);
        let (mut at, len) = (0, self.copy_len());
        while at + len <= RETENTION_LEN {
            let mut crc = self.identity;
            for address in at..at + len {
                crc.byte(eeprom.read(address));
            }
            let sequence = u16::from_le_bytes([eeprom.read(at), eeprom.read(at + 1)]);
            // Sequence numbers wrap; all in the ring lie close together.
            let is_newer = !found || sequence.wrapping_sub(self.sequence) as i16 > 0;
            if crc.is_complete() && is_newer {
                (self.copy, self.sequence, found) = (at, sequence, true);
            }
            at += len;
            copies += 1;
        }
        self.interval = COPY_INTERVAL.checked_div(copies).unwrap_or(0).max(INTERVAL_MIN);
        found
    }

    fn read_back<P: ProgramMemory>(&self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom) {
        let (mut walk, mut from) = (RetainedWalk::START, self.copy + SEQUENCE_LEN);
        while let Some((address, len)) = walk.next(plan, u16::MAX) {
            for to in address..address + len {
                memory.set_byte(to, eeprom.read(from));
                from += 1;
            }
        }
    }

    /// The values of this moment, behind the program's memory.
    #[inline(never)]
    fn take_snapshot<P: ProgramMemory>(&self, plan: &Plan<P>, memory: &mut Memory) {
        let (mut walk, mut place) = (RetainedWalk::START, plan.end());
        while let Some((address, len)) = walk.next(plan, u16::MAX) {
            memory.copy_up(address, place, len);
            place += len;
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

    /// A little work after a scan in which there is, and in which the program `was_executed` or not.
    pub fn step<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom, was_executed: bool) {
        self.has_run |= was_executed;
        match self.phase {
            Phase::Comparing => self.compare(plan, memory),
            _ if !eeprom.is_ready() => {}
            Phase::Erasing => self.erase(plan, memory, eeprom),
            Phase::Writing => self.write(plan, memory, eeprom),
        }
    }

    fn compare<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        let Some((address, len)) = self.walk.next(plan, u16::from(BYTES_PER_SCAN)) else {
            return self.enter(Phase::Comparing);
        };
        let copy = plan.end() + self.done;
        self.done += len;
        if (0..len).any(|offset| memory.byte(address + offset) != memory.byte(copy + offset)) {
            self.begin(plan, memory);
        }
    }

    fn erase<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom) {
        for _ in 0..BYTES_PER_SCAN {
            if self.done == RETENTION_LEN {
                if self.has_run {
                    self.begin(plan, memory);
                }
                return;
            }
            self.done += 1;
            if eeprom.update(self.done - 1, 0xFF) {
                return;
            }
        }
    }

    /// Begins the next copy.
    #[inline(never)]
    fn begin<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        self.take_snapshot(plan, memory);
        self.copy += self.copy_len();
        if self.copy + self.copy_len() > RETENTION_LEN {
            self.copy = 0;
        }
        self.sequence = self.sequence.wrapping_add(1);
        self.saved = unit_of(clock::now_ms());
        self.is_due = false;
        self.enter(Phase::Writing);
    }

    /// Goes on with the copy: over bytes that are right already up to one that is written.
    fn write<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &Memory, eeprom: &Eeprom) {
        let values_end = SEQUENCE_LEN + self.len;
        for _ in 0..BYTES_PER_SCAN {
            if self.done == self.copy_len() {
                return self.enter(Phase::Comparing);
            }
            let byte = match self.done {
                0 => self.sequence as u8,
                1 => (self.sequence >> 8) as u8,
                done if done < values_end => memory.byte(plan.end() + done - SEQUENCE_LEN),
                done => self.crc.value().to_le_bytes().get(usize::from(done - values_end)).copied().unwrap_or(0),
            };
            if self.done < values_end {
                self.crc.byte(byte);
            }
            self.done += 1;
            if eeprom.update(self.copy + self.done - 1, byte) {
                return;
            }
        }
    }
}
