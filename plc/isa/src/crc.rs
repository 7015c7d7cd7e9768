//! CRC-32 (IEEE 802.3, reflected), byte by byte, without a table: tables cost SRAM on the board.

/// A CRC-32 being computed. The firmware feeds it in small slices.
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
        Crc32(u32::MAX)
    }

    /// Takes one byte in.
    pub const fn byte(&mut self, byte: u8) {
        self.0 ^= byte as u32;
        let mut bit = 0;
        while bit < 8 {
            let carry = self.0 & 1 != 0;
            self.0 >>= 1;
            if carry {
                self.0 ^= 0xEDB8_8320;
            }
            bit += 1;
        }
    }

    /// The checksum of the bytes so far.
    pub const fn value(self) -> u32 {
        !self.0
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
    use super::Crc32;

    #[test]
    fn check_value_of_the_standard() {
        assert_eq!(Crc32::of(b"123456789"), 0xCBF4_3926);
    }
}
