//! Retained values: kept in the EEPROM in a ring of copies, so that a power cut leaves the last complete one.
//!
//! A copy is a sequence number, the values and a checksum, which also covers what the values belong to. The oldest
//! copy is overwritten, byte by byte in the background, from a snapshot behind the program's own memory. What is
//! saved when, and how long the EEPROM lives: docs/retention.md.

use plc_isa::{Crc32, Plan, ProgramMemory, RETENTION_LEN, RETENTION_OVERHEAD, RetainedWalk};
use plc_vm::Memory;

use crate::board::clock;
use crate::board::eeprom::Eeprom;

/// Saves of one byte that the EEPROM is good for, spread over ten years, in milliseconds for a single copy.
const TEN_YEARS_MS_PER_COPY: u32 = 3_155_760;
/// However many copies there are, changes are saved no more often.
const INTERVAL_MIN_MS: u32 = 60_000;
/// Values compared, or bytes looked at before one is written, in a scan.
const BYTES_PER_SCAN: u8 = 4;

/// What is being done.
#[derive(Clone, Copy)]
enum State {
    /// Looks for values that differ from the last copy.
    Comparing { walk: RetainedWalk, place: u16 },
    /// Writes the snapshot; so many bytes of the copy are done.
    Writing { offset: u16, crc: Crc32 },
}

/// The retained values of a program.
pub struct Retention {
    /// Bytes of values; 0: nothing is retained.
    len: u16,
    /// Checksum of what the values are: begins the checksum of every copy.
    identity: Crc32,
    /// Copies in the ring.
    copies: u16,
    /// The copy that is or was written last.
    copy: u16,
    /// Its sequence number.
    sequence: u16,
    saved_ms: u32,
    interval_ms: u32,
    /// RUN has ended: changes are saved without delay.
    is_urgent: bool,
    state: State,
}

impl Retention {
    /// Nothing is retained. No constant: that would take SRAM a second time.
    #[inline(always)]
    pub fn none() -> Retention {
        Retention {
            len: 0,
            identity: Crc32::new(),
            copies: 0,
            copy: 0,
            sequence: 0,
            saved_ms: 0,
            interval_ms: 0,
            is_urgent: false,
            state: State::Comparing { walk: RetainedWalk::START, place: 0 },
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
        self.copies = RETENTION_LEN.checked_div(self.copy_len()).unwrap_or(0);
        let interval_ms = TEN_YEARS_MS_PER_COPY.checked_div(u32::from(self.copies)).unwrap_or(0);
        self.interval_ms = interval_ms.max(INTERVAL_MIN_MS);
        // The first change is saved at once.
        self.saved_ms = clock::now_ms().wrapping_sub(self.interval_ms);
        // A write that a reset has interrupted goes on.
        while !eeprom.is_ready() {}
        let is_lost = !self.find_last(eeprom);
        if !is_lost {
            self.read_back(plan, memory, eeprom);
        }
        self.take_snapshot(plan, memory);
        self.is_urgent = false;
        self.state = State::Comparing { walk: RetainedWalk::START, place: plan.end() };
        if is_lost {
            // The next power-up finds a copy even if nothing changes until then.
            self.begin(plan, memory);
        }
        is_lost
    }

    fn copy_len(&self) -> u16 {
        self.len + RETENTION_OVERHEAD
    }

    fn address(&self, offset: u16) -> u16 {
        self.copy * self.copy_len() + offset
    }

    /// Looks for the newest complete copy.
    fn find_last(&mut self, eeprom: &Eeprom) -> bool {
        let mut newest = None;
        for copy in 0..self.copies {
            self.copy = copy;
            let Some(sequence) = self.complete(eeprom) else { continue };
            // Sequence numbers wrap; all in the ring lie close together.
            if newest.is_none_or(|(_, other): (u16, u16)| (sequence.wrapping_sub(other) as i16) > 0) {
                newest = Some((copy, sequence));
            }
        }
        (self.copy, self.sequence) = newest.unwrap_or((0, 0));
        newest.is_some()
    }

    /// The sequence number of the current copy, if its checksum is right.
    fn complete(&self, eeprom: &Eeprom) -> Option<u16> {
        let mut crc = self.identity;
        for offset in 0..self.copy_len() {
            crc.byte(eeprom.read(self.address(offset)));
        }
        crc.is_complete().then(|| u16::from_le_bytes([eeprom.read(self.address(0)), eeprom.read(self.address(1))]))
    }

    fn read_back<P: ProgramMemory>(&self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom) {
        let (mut walk, mut offset) = (RetainedWalk::START, 2);
        while let Some(address) = walk.next(plan) {
            memory.set_byte(address, eeprom.read(self.address(offset)));
            offset += 1;
        }
    }

    /// The values of this moment, behind the program's memory.
    fn take_snapshot<P: ProgramMemory>(&self, plan: &Plan<P>, memory: &mut Memory) {
        let (mut walk, mut place) = (RetainedWalk::START, plan.end());
        while let Some(address) = walk.next(plan) {
            memory.set_byte(place, memory.byte(address));
            place += 1;
        }
    }

    /// A little work in every scan. `at_once`: RUN has ended, changes are saved without delay.
    #[inline(never)]
    pub fn step<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory, eeprom: &Eeprom, at_once: bool) {
        if self.len == 0 {
            return;
        }
        if at_once {
            self.is_urgent = true;
        }
        match self.state {
            // Values compared before the end of RUN may have changed since.
            State::Comparing { .. } if at_once => self.compare(plan, memory, RetainedWalk::START, plan.end()),
            State::Comparing { walk, place } => {
                let waited_ms = clock::now_ms().wrapping_sub(self.saved_ms);
                if self.is_urgent || waited_ms >= self.interval_ms {
                    self.compare(plan, memory, walk, place);
                }
            }
            State::Writing { offset, crc } if eeprom.is_ready() => self.write(plan, memory, eeprom, offset, crc),
            State::Writing { .. } => {}
        }
    }

    fn compare<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &mut Memory,
        mut walk: RetainedWalk,
        mut place: u16,
    ) {
        for _ in 0..BYTES_PER_SCAN {
            let Some(address) = walk.next(plan) else {
                self.is_urgent = false;
                self.state = State::Comparing { walk: RetainedWalk::START, place: plan.end() };
                return;
            };
            if memory.byte(address) != memory.byte(place) {
                return self.begin(plan, memory);
            }
            place += 1;
        }
        self.state = State::Comparing { walk, place };
    }

    /// Begins the next copy.
    #[inline(never)]
    fn begin<P: ProgramMemory>(&mut self, plan: &Plan<P>, memory: &mut Memory) {
        self.take_snapshot(plan, memory);
        self.copy = if self.copy + 1 < self.copies { self.copy + 1 } else { 0 };
        self.sequence = self.sequence.wrapping_add(1);
        self.saved_ms = clock::now_ms();
        self.state = State::Writing { offset: 0, crc: self.identity };
    }

    /// Goes on with the copy: over bytes that are right already up to one that is written.
    fn write<P: ProgramMemory>(
        &mut self,
        plan: &Plan<P>,
        memory: &Memory,
        eeprom: &Eeprom,
        mut offset: u16,
        mut crc: Crc32,
    ) {
        let values_end = 2 + self.len;
        for _ in 0..BYTES_PER_SCAN {
            if offset == self.copy_len() {
                self.state = State::Comparing { walk: RetainedWalk::START, place: plan.end() };
                return;
            }
            let byte = match offset {
                0 => self.sequence as u8,
                1 => (self.sequence >> 8) as u8,
                _ if offset < values_end => memory.byte(plan.end() + offset - 2),
                _ => (crc.value() >> (8 * (offset - values_end))) as u8,
            };
            if offset < values_end {
                crc.byte(byte);
            }
            let address = self.address(offset);
            offset += 1;
            if eeprom.read(address) != byte {
                eeprom.start_write(address, byte);
                break;
            }
        }
        self.state = State::Writing { offset, crc };
    }
}
