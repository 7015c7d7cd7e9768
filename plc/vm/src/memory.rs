//! Data memory at the addresses of [`plc_isa`]'s layout: as much as the largest profile has that
//! this build runs. Big-endian, as on the S7-200.

use core::cell::Cell;

use plc_isa::{Bit, ByteSource, DATA_START, Profile, WordSource};

/// Bytes of data memory.
const LEN: usize = Profile::LARGEST.data_len();

/// The data memory of the controller.
///
/// An address outside reads 0 and is not written: the loader's check keeps such addresses out of
/// programs, and nothing here may panic.
#[derive(Debug, Clone, PartialEq, Eq)]
#[repr(transparent)]
pub struct Memory {
    bytes: [u8; LEN],
}

impl Default for Memory {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg_attr(not(target_arch = "avr"), inline(always))]
const fn index(address: u16) -> usize {
    address.wrapping_sub(DATA_START) as usize
}

impl Memory {
    /// Memory full of zeros.
    pub const fn new() -> Self {
        Memory { bytes: [0; LEN] }
    }

    /// Sets every byte to 0.
    pub fn clear(&mut self) {
        self.bytes.fill(0);
    }

    /// All bytes, from [`DATA_START`] on.
    pub fn bytes(&self) -> &[u8; LEN] {
        &self.bytes
    }

    /// All bytes, to be changed.
    #[inline(always)]
    pub fn bytes_mut(&mut self) -> &mut [u8; LEN] {
        &mut self.bytes
    }

    /// The byte at an address.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn byte(&self, address: u16) -> u8 {
        self.bytes.get(index(address)).copied().unwrap_or(0)
    }

    /// Writes a byte.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn set_byte(&mut self, address: u16, value: u8) {
        if let Some(byte) = self.bytes.get_mut(index(address)) {
            *byte = value;
        }
    }

    /// Bytes from an address on, where all of them are memory.
    pub(crate) fn part(&self, address: u16, len: u16) -> Option<&[u8]> {
        self.bytes.get(index(address)..)?.get(..usize::from(len))
    }

    /// Copies bytes to another place, from the first to the last.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn copy(&mut self, from: u16, to: u16, len: u16) {
        let bytes = Cell::from_mut(self.bytes.as_mut_slice()).as_slice_of_cells();
        let part = |start: usize| bytes.get(start..)?.get(..usize::from(len));
        if let (Some(from), Some(to)) = (part(index(from)), part(index(to))) {
            for (from, to) in from.iter().zip(to) {
                to.set(from.get());
            }
        }
    }

    /// The word whose high byte is at an address.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn word(&self, address: u16) -> u16 {
        u16::from_be_bytes([self.byte(address), self.byte(address.wrapping_add(1))])
    }

    /// Writes a word.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn set_word(&mut self, address: u16, value: u16) {
        let [high, low] = value.to_be_bytes();
        self.set_byte(address, high);
        self.set_byte(address.wrapping_add(1), low);
    }

    /// The word as a signed number.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn int(&self, address: u16) -> i16 {
        self.word(address) as i16
    }

    /// Writes a signed number.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn set_int(&mut self, address: u16, value: i16) {
        self.set_word(address, value as u16);
    }

    /// A bit.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn bit(&self, bit: Bit) -> bool {
        self.byte(bit.address) >> (bit.bit & 7) & 1 != 0
    }

    /// Writes a bit.
    #[cfg_attr(target_arch = "avr", inline(never))]
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub fn set_bit(&mut self, bit: Bit, value: bool) {
        let place = bit.bit & 7;
        let byte = self.byte(bit.address) & !(1 << place) | u8::from(value) << place;
        self.set_byte(bit.address, byte);
    }

    /// The value of a signed word operand.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub(crate) fn int_of(&self, source: WordSource) -> i16 {
        match source {
            WordSource::Constant(value) => value as i16,
            WordSource::At(address) => self.int(address),
        }
    }

    /// The value of a byte operand.
    #[cfg_attr(not(target_arch = "avr"), inline(always))]
    pub(crate) fn byte_of(&self, source: ByteSource) -> u8 {
        match source {
            ByteSource::Constant(value) => value,
            ByteSource::At(address) => self.byte(address),
        }
    }
}
