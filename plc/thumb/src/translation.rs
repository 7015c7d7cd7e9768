//! A program's translation: its code, and where in it the program's instructions are that something
//! leads to. How single instructions are translated is in `logic`.

use heapless::Vec;
use plc_isa::{DATA_START, Decoded, Group, Op, Program, ProgramMemory};

use crate::instructions::{R0, R1, add, add_constant, call, move_constant, shift_left};
use crate::registers::{MEMORY, STEP, WINDOW};

/// Halfwords that an instruction of the program becomes at most.
const INSTRUCTION_MAX: usize = 20;
/// Halfwords of a call of the interpreter.
const STEP_LEN: usize = 5;
/// Bytes that a load or store reaches from the window's first byte on: what their offset has room
/// for.
const WINDOW_LEN: u16 = 32;

/// Where in the code an instruction of the program begins. With offset 0, where the header is,
/// there is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Entry {
    /// Its offset in the image.
    offset: u16,
    /// Index of the halfword.
    at: u16,
}

impl Entry {
    const NONE: Entry = Entry { offset: 0, at: 0 };
}

/// Code for a program, in room for `CODE` halfwords, with entries in a table of `ENTRIES` places, a
/// power of two. What there is no room for the interpreter executes.
#[derive(Debug)]
pub struct Translation<const CODE: usize, const ENTRIES: usize> {
    code: Vec<u16, CODE>,
    /// An entry is at the place that the lowest bits of its offset say, or the next one that was
    /// free: jumps in a loop look for theirs in every pass.
    entries: [Entry; ENTRIES],
    entries_len: usize,
    /// The index in data memory that the window begins at, where that is known.
    window: Option<u16>,
}

impl<const CODE: usize, const ENTRIES: usize> Translation<CODE, ENTRIES> {
    /// Of no program.
    pub const NONE: Self = {
        assert!(ENTRIES.is_power_of_two(), "places are found by the lowest bits");
        let entries = [Entry::NONE; ENTRIES];
        Translation { code: Vec::new(), entries, entries_len: 0, window: None }
    };

    /// The halfwords.
    pub fn code(&self) -> &[u16] {
        &self.code
    }

    /// The index of the halfword where the instruction at this offset of the image begins, if
    /// code can be entered there.
    pub fn entry(&self, offset: u16) -> Option<usize> {
        let entry = self.entries.get(self.place(offset))?;
        (entry.offset == offset).then_some(usize::from(entry.at))
    }

    /// The place of the entry for this offset, or the free one where it would be.
    fn place(&self, offset: u16) -> usize {
        let mut place = usize::from(offset) & (ENTRIES - 1);
        while self.entries.get(place).is_some_and(|entry| ![0, offset].contains(&entry.offset)) {
            place = (place + 1) & (ENTRIES - 1);
        }
        place
    }

    /// Forgets the translation of before and translates a program, as much as there is room for.
    pub fn translate<P: ProgramMemory>(&mut self, program: &Program<P>) {
        self.code.clear();
        // In its place: the stack has no room for a second one.
        self.entries.fill(Entry::NONE);
        self.entries_len = 0;
        let mut is_led_to = true;
        for (offset, decoded) in program.all_instructions() {
            if self.code.len() + INSTRUCTION_MAX + STEP_LEN > CODE {
                return self.step(offset, 0);
            }
            if is_led_to || decoded.op == Op::Lbl {
                self.enter_here(offset);
            }
            let is_logic = self.logic(&decoded);
            if !is_logic {
                // None is longer; with 0 the program would go on at the next entry.
                self.step(offset, u8::try_from(decoded.len).unwrap_or(0));
            }
            is_led_to = !is_logic && may_lead_elsewhere(&decoded);
        }
    }

    /// The next instruction can be reached from elsewhere.
    fn enter_here(&mut self, offset: u16) {
        self.window = None;
        // Without room the interpreter goes on, up to the next entry.
        let (place, at) = (self.place(offset), self.code.len() as u16);
        // With some places free the search for one ends soon.
        if self.entries_len < ENTRIES / 4 * 3
            && let Some(entry) = self.entries.get_mut(place)
        {
            *entry = Entry { offset, at };
            self.entries_len += 1;
        }
    }

    /// A call of the interpreter; with length 0 the last.
    fn step(&mut self, offset: u16, len: u8) {
        let [low, high] = offset.to_le_bytes();
        self.put(move_constant(R0, high));
        self.put(shift_left(R0, R0, 8));
        self.put(add_constant(R0, low));
        self.put(move_constant(R1, len));
        self.put(call(STEP));
    }

    /// Appends a halfword.
    pub(crate) fn put(&mut self, halfword: u16) {
        // There is room: `translate` has looked before each instruction.
        let _ = self.code.push(halfword);
    }

    /// Brings the window to where it has a byte of data memory. Returns the byte's offset in it;
    /// code of at most four halfwords.
    pub(crate) fn reach(&mut self, address: u16) -> u8 {
        let index = address.wrapping_sub(DATA_START);
        let start = index - index % WINDOW_LEN;
        if self.window != Some(start) {
            self.move_window(start / WINDOW_LEN);
            self.window = Some(start);
        }
        (index - start) as u8
    }

    /// The window with this number, of as many bytes each.
    fn move_window(&mut self, number: u16) {
        // A constant has eight bits.
        let (constant, shift) = if number < 256 { (number, 5) } else { (number / 2, 6) };
        self.put(move_constant(WINDOW, constant as u8));
        self.put(shift_left(WINDOW, WINDOW, shift));
        self.put(add(WINDOW, WINDOW, MEMORY));
        if number >= 256 && !number.is_multiple_of(2) {
            self.put(add_constant(WINDOW, WINDOW_LEN as u8));
        }
    }
}

/// Whether the interpreter may go elsewhere than to the next instruction, or come back to it from
/// elsewhere.
fn may_lead_elsewhere(decoded: &Decoded) -> bool {
    use Group::*;
    matches!(decoded.op.instruction().group, Control | Call | Sequence | Interrupt | Hidden)
}
