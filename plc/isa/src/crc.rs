//! CRC-32 (IEEE 802.3, reflected), byte by byte, without a table: tables cost SRAM on the board.

use crate::image::ProgramMemory;

/// A CRC-32 being computed. The firmware feeds it in small slices. It holds the checksum of the bytes so far, so that it
/// begins with zero.
#[derive(Debug, Clone, Copy)]
pub struct Crc32(u32);

impl Default for Crc32 {
    fn default() -> Self {
        Self::new()
    }
}

impl Crc32 {
    /// The start value.
    pub const fn new() -> Self {
        Crc32(0)
    }

    /// Takes one byte in.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub const fn byte(&mut self, byte: u8) {
        let (mut crc, mut byte, mut bits) = (!self.0, byte, 8u8);
        while bits != 0 {
            let is_odd = (crc as u8 ^ byte) & 1 != 0;
            crc >>= 1;
            byte >>= 1;
            if is_odd {
                crc ^= 0xEDB8_8320;
            }
            bits -= 1;
        }
        self.0 = !crc;
    }

    /// The checksum of the bytes so far.
    pub const fn value(self) -> u32 {
        self.0
    }

    /// Takes bytes of program memory in, from one offset to before another.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn bytes<P: ProgramMemory>(&mut self, memory: &P, from: u16, to: u16) {
        let mut offset = from;
        while offset != to {
            self.byte(memory.byte(offset));
            offset = offset.wrapping_add(1);
        }
    }

    /// Whether what has been taken in ends with its own checksum, low byte first.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub const fn is_complete(&self) -> bool {
        // What is left after any data followed by its checksum.
        self.0 == !0xDEBB_20E3
    }

    /// The checksum of a slice.
    pub fn of(bytes: &[u8]) -> u32 {
        let mut crc = Crc32::new();
        for &byte in bytes {
            crc.byte(byte);
        }
        crc.value()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::Crc32;

    #[test]
    fn data_with_its_checksum_is_complete() {
        let mut bytes = b"any data".to_vec();
        bytes.extend(Crc32::of(&bytes).to_le_bytes());
        let mut crc = Crc32::new();
        crc.bytes(&bytes, 0, 12);
        assert!(crc.is_complete());
        crc.byte(0);
        assert!(!crc.is_complete());
    }

    #[test]
    fn check_value_of_the_standard() {
        assert_eq!(Crc32::of(b"123456789"), 0xCBF4_3926);
    }
}
