//! A number for many bytes, FNV-1a with 64 bits. What is different has another, very likely. No
//! CRC-32: images end with their own, and all such have the same.

use std::fmt;

const BASIS: u64 = 0xCBF2_9CE4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01B3;

/// The digest of what was added so far, and how many bytes that was.
#[derive(Debug, Clone, Copy)]
pub struct Digest {
    hash: u64,
    len: usize,
}

impl Default for Digest {
    fn default() -> Digest {
        Digest { hash: BASIS, len: 0 }
    }
}

impl Digest {
    /// The digest of these bytes.
    pub fn of(bytes: &[u8]) -> Digest {
        let mut digest = Digest::default();
        digest.add(bytes);
        digest
    }

    /// Adds bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        self.len += bytes.len();
        for &byte in bytes {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016X} of {} bytes", self.hash, self.len)
    }
}
