//! The loader's check: everything about an image is examined before its first scan, on host and
//! board alike.
//!
//! What passes can run without further checks of addresses, jumps and stack depth: an interpreter
//! cannot be led outside the plan. One pass over the code, constant memory. Machine code is taken
//! on trust but for its entry: it was made from an image that has passed.

mod code;
mod tables;

use crate::decode::{Decoded, decode};
use crate::header::{DIRECTORY_AT, TOTAL_LEN_AT};
use crate::image::{CRC_LEN, ENTRY_LEN, Header, ImageError, ImageFault};
use crate::layout::LINE_ROOM;
use crate::memory::ProgramMemory;
use crate::plan::Plan;
use crate::table::Op;
use code::CodeCheck;
use tables::check_tables;

pub use code::LOOPS_MAX;

/// An image that has passed every check.
#[derive(Debug, Clone, Copy)]
pub struct Program<P> {
    plan: Plan<P>,
}

impl<P: ProgramMemory> Program<P> {
    /// The memory plan, with header and settings.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn plan(&self) -> &Plan<P> {
        &self.plan
    }

    /// The image's bytes.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn memory(&self) -> &P {
        &self.plan.memory
    }

    /// Offset of the first instruction of bytecode.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn code_at(&self) -> u16 {
        self.plan.code_at()
    }

    /// The instructions of the main program in bytecode with their offsets, hidden ones and its end
    /// included.
    pub fn instructions(&self) -> impl Iterator<Item = (u16, Decoded)> + '_ {
        let mut next = self.entry().is_none().then(|| self.code_at());
        core::iter::from_fn(move || {
            let at = next?;
            // A verified image decodes to its end.
            let decoded = decode(self.memory(), at).ok()?;
            next = (decoded.op != Op::MainEnd).then_some(at + decoded.len);
            Some((at, decoded))
        })
    }

    /// The same of the main program and then of all routines.
    pub fn all_instructions(&self) -> impl Iterator<Item = (u16, Decoded)> + '_ {
        let end = self.plan.header.code_end();
        let mut next = if self.entry().is_none() { self.code_at() } else { end };
        core::iter::from_fn(move || {
            let at = next;
            // A verified image decodes to its end.
            let decoded = (at < end).then(|| decode(self.memory(), at).ok()).flatten()?;
            next += decoded.len;
            Some((at, decoded))
        })
    }

    /// Offset of the first instruction of machine code; `None` in bytecode.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn entry(&self) -> Option<u16> {
        is_native(&self.plan).then(|| self.memory().word(self.code_at()))
    }
}

/// Checks an image completely.
pub fn verify<P: ProgramMemory>(memory: P) -> Result<Program<P>, ImageError> {
    let mut program = None;
    verify_into(&mut program, memory)?;
    program.ok_or(ImageError { fault: ImageFault::Length, at: 0 })
}

/// The same in place, for those who cannot afford a second program on their stack. Without a valid
/// image there is no program afterwards.
#[inline(always)]
pub fn verify_into<P: ProgramMemory>(
    place: &mut Option<Program<P>>,
    memory: P,
) -> Result<(), ImageError> {
    *place = None;
    Header::check(&memory)?;
    let checked = check(P::anywhere(&mut place.insert(Program { plan: Plan::blank(memory) }).plan));
    if checked.is_err() {
        *place = None;
    }
    checked
}

/// The check of what the header leads to.
#[cfg_attr(target_arch = "avr", inline(never))]
fn check<P: ProgramMemory>(plan: &mut Plan<P>) -> Result<(), ImageError> {
    ensure_at(plan.read(), ImageFault::Length, TOTAL_LEN_AT)?;
    plan.place();
    let Some(data_end) = plan.memory.modules_end() else {
        return Err(ImageError { fault: ImageFault::Module, at: DIRECTORY_AT });
    };
    check_tables(plan, data_end - LINE_ROOM)?;
    if is_native(plan) {
        return ensure_at(entry_is_valid(plan), ImageFault::Interface, plan.code_at());
    }
    let mut check = CodeCheck::new(plan);
    check.run().map_err(|fault| ImageError { fault, at: check.at })
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
fn is_native<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    P::NATIVE_INTERFACE != 0 && plan.header.interface != 0
}

/// Whether machine code has its entry word, and there an even offset after the word in the code.
fn entry_is_valid<P: ProgramMemory>(plan: &Plan<P>) -> bool {
    let (code_at, end) = (plan.code_at(), plan.header.total_len - CRC_LEN);
    let entry = plan.memory.word(code_at);
    entry.is_multiple_of(2) && entry >= code_at + ENTRY_LEN && entry < end
}

fn ensure(holds: bool, fault: ImageFault) -> Result<(), ImageFault> {
    if holds { Ok(()) } else { Err(fault) }
}

fn ensure_at(holds: bool, fault: ImageFault, at: u16) -> Result<(), ImageError> {
    if holds { Ok(()) } else { Err(ImageError { fault, at }) }
}
