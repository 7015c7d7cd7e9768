//! Instructions of the processor as halfwords (ARMv6-M Architecture Reference Manual, chapter A6).
//! Which of them a program becomes is not decided here.

/// One of R0 to R7.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Register(pub(crate) u16);

/// Registers for what lasts no longer than an instruction of the program.
pub const R0: Register = Register(0);
pub const R1: Register = Register(1);
pub const R2: Register = Register(2);

/// On what a branch depends: whether the last result was 0, or the carry flag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Condition {
    Equal = 0,
    NotEqual = 1,
    CarrySet = 2,
    CarryClear = 3,
}

/// MOVS Rd, #value
pub fn move_constant(to: Register, value: u8) -> u16 {
    0x2000 | to.0 << 8 | u16::from(value)
}

/// ADDS Rdn, #value
pub fn add_constant(to: Register, value: u8) -> u16 {
    0x3000 | to.0 << 8 | u16::from(value)
}

/// ADDS Rd, Rn, Rm
pub fn add(to: Register, first: Register, second: Register) -> u16 {
    0x1800 | second.0 << 6 | first.0 << 3 | to.0
}

/// LSLS Rd, Rm, #count; 1 to 31.
pub fn shift_left(to: Register, from: Register, count: u8) -> u16 {
    u16::from(count & 31) << 6 | from.0 << 3 | to.0
}

/// LSRS Rd, Rm, #count; 1 to 31. The last bit that is shifted out is the carry flag.
pub fn shift_right(to: Register, from: Register, count: u8) -> u16 {
    0x0800 | u16::from(count & 31) << 6 | from.0 << 3 | to.0
}

/// LDRB Rt, [Rn, #offset]; 0 to 31.
pub fn load_byte(to: Register, base: Register, offset: u8) -> u16 {
    0x7800 | u16::from(offset & 31) << 6 | base.0 << 3 | to.0
}

/// STRB Rt, [Rn, #offset]; 0 to 31.
pub fn store_byte(from: Register, base: Register, offset: u8) -> u16 {
    0x7000 | u16::from(offset & 31) << 6 | base.0 << 3 | from.0
}

/// CMP Rn, #value
pub fn compare(register: Register, value: u8) -> u16 {
    0x2800 | register.0 << 8 | u16::from(value)
}

/// ANDS Rdn, Rm
pub fn and(to: Register, with: Register) -> u16 {
    0x4000 | with.0 << 3 | to.0
}

/// EORS Rdn, Rm
pub fn exclusive_or(to: Register, with: Register) -> u16 {
    0x4040 | with.0 << 3 | to.0
}

/// ADCS Rdn, Rm: with the carry flag.
pub fn add_with_carry(to: Register, with: Register) -> u16 {
    0x4140 | with.0 << 3 | to.0
}

/// ORRS Rdn, Rm
pub fn or(to: Register, with: Register) -> u16 {
    0x4300 | with.0 << 3 | to.0
}

/// BICS Rdn, Rm
pub fn clear_bits(to: Register, bits: Register) -> u16 {
    0x4380 | bits.0 << 3 | to.0
}

/// MVNS Rd, Rm
pub fn invert(to: Register, from: Register) -> u16 {
    0x43C0 | from.0 << 3 | to.0
}

/// BLX Rm
pub fn call(routine: Register) -> u16 {
    0x4780 | routine.0 << 3
}

/// B with a condition, over so many halfwords, 1 to 128, that come after it.
pub fn skip(condition: Condition, halfwords: u8) -> u16 {
    // From the branch on four bytes are counted before the first.
    0xD000 | (condition as u16) << 8 | u16::from(halfwords.wrapping_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_those_of_the_manual() {
        let [r2, r3, r4, r7] = [2, 3, 4, 7].map(Register);
        // As an assembler encodes them.
        assert_eq!(move_constant(r3, 0xA5), 0x23A5);
        assert_eq!(add_constant(r7, 1), 0x3701);
        assert_eq!(add(r7, r4, r2), 0x18A7);
        assert_eq!(shift_left(r2, r3, 23), 0x05DA);
        assert_eq!(shift_right(R0, R0, 8), 0x0A00);
        assert_eq!(load_byte(R0, r7, 31), 0x7FF8);
        assert_eq!(store_byte(R1, r7, 1), 0x7079);
        assert_eq!(compare(r3, 9), 0x2B09);
        assert_eq!(and(R0, R1), 0x4008);
        assert_eq!(exclusive_or(r4, R0), 0x4044);
        assert_eq!(add_with_carry(r4, r4), 0x4164);
        assert_eq!(or(r4, R0), 0x4304);
        assert_eq!(clear_bits(R0, R1), 0x4388);
        assert_eq!(invert(R0, R0), 0x43C0);
        assert_eq!(call(Register(6)), 0x47B0);
        assert_eq!(skip(Condition::CarrySet, 2), 0xD201);
        assert_eq!(skip(Condition::CarryClear, 1), 0xD300);
        assert_eq!(skip(Condition::Equal, 2), 0xD001);
        assert_eq!(skip(Condition::NotEqual, 2), 0xD101);
    }
}
