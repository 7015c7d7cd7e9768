//! The checksum of Modbus RTU, for both ends of a serial line. What it is around is theirs.

/// The CRC-16 of Modbus over these bytes, which a frame has the low byte first; over a whole frame
/// it is 0.
pub fn crc16(bytes: &[u8]) -> u16 {
    let mut crc = 0xFFFF;
    for &byte in bytes {
        crc ^= u16::from(byte);
        for _ in 0..8 {
            crc = if crc & 1 != 0 { crc >> 1 ^ 0xA001 } else { crc >> 1 };
        }
    }
    crc
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_of_the_standard() {
        // Slave 2, function 7: MODBUS over serial line 1.02, appendix B.
        assert_eq!(crc16(&[0x02, 0x07]).to_le_bytes(), [0x41, 0x12]);
        assert_eq!(crc16(&[0x02, 0x07, 0x41, 0x12]), 0);
    }
}
