//! CRC-32 (IEEE 802.3, reflected), byte by byte, without a table: tables cost SRAM on the board.

/// A CRC-32 being computed. The firmware feeds it in small slices. It holds the checksum of the
/// bytes so far, so that it begins with zero.
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
        let (mut crc, mut bit) = (!self.0 ^ byte as u32, 1u8);
        while bit != 0 {
            // All bits of the polynomial, or none.
            let taken = (crc as u16 & 1).wrapping_neg();
            crc >>= 1;
            crc ^= (taken & 0x8320) as u32 | ((taken & 0xEDB8) as u32) << 16;
            bit <<= 1;
        }
        self.0 = !crc;
    }

    /// The checksum of the bytes so far.
    pub const fn value(self) -> u32 {
        self.0
    }

    /// Whether what has been taken in ends with its own checksum, low byte first. Begins anew.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub const fn ends(&mut self) -> bool {
        // What is left after any data followed by its checksum.
        let is_complete = self.0 == !0xDEBB_20E3;
        *self = Crc32::new();
        is_complete
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
        assert!(crc.ends());
        assert!(!crc.ends());
        crc.bytes(&bytes, 0, 12);
        crc.byte(0);
        assert!(!crc.ends());
    }

    #[test]
    fn check_value_of_the_standard() {
        assert_eq!(Crc32::of(b"123456789"), 0xCBF4_3926);
    }
}
