//! The AVR instructions that translated programs are made of: their words and cycles on the
//! ATmega328P, as the data sheet and the instruction set manual give them. Which are needed when is
//! not known here.

/// A register, r0 to r31.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Reg(pub u8);

impl Reg {
    /// Whether instructions with a constant can use the register.
    pub fn takes_constants(self) -> bool {
        self.0 >= 16
    }
}

/// Operations on two registers; the first is the destination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Two {
    /// Adds.
    Add,
    /// Adds with carry.
    Adc,
    /// Subtracts.
    Sub,
    /// Subtracts with carry.
    Sbc,
    /// Combines by AND.
    And,
    /// Combines by OR.
    Or,
    /// Copies.
    Mov,
    /// Compares.
    Cp,
    /// Compares with carry.
    Cpc,
    /// Skips the next instruction if both are equal.
    Cpse,
}

/// Operations on a register from r16 on and a constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Constant {
    /// Loads.
    Ldi,
    /// Subtracts.
    Subi,
    /// Subtracts with carry.
    Sbci,
    /// Combines by AND.
    Andi,
    /// Combines by OR.
    Ori,
    /// Compares.
    Cpi,
}

/// Operations on a bit of a register.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OfBit {
    /// Stores the bit in T.
    Bst,
    /// Loads the bit from T.
    Bld,
    /// Skips the next instruction if the bit is 0.
    Sbrc,
    /// Skips the next instruction if the bit is 1.
    Sbrs,
}

/// A flag of SREG and the value at which a branch is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Condition {
    flag: u8,
    is_set: bool,
}

impl Condition {
    /// Carry: unsigned less.
    pub const LOWER: Condition = Condition { flag: 0, is_set: true };
    /// No carry: unsigned greater or equal.
    pub const SAME_OR_HIGHER: Condition = Condition { flag: 0, is_set: false };
    /// Zero.
    pub const EQUAL: Condition = Condition { flag: 1, is_set: true };
    /// Not zero.
    pub const NOT_EQUAL: Condition = Condition { flag: 1, is_set: false };
    /// Bit 7 of the result is 0.
    pub const PLUS: Condition = Condition { flag: 2, is_set: false };
    /// No two's complement overflow.
    pub const NO_OVERFLOW: Condition = Condition { flag: 3, is_set: false };
    /// Signed less.
    pub const LESS: Condition = Condition { flag: 4, is_set: true };
    /// Signed greater or equal.
    pub const GREATER_OR_EQUAL: Condition = Condition { flag: 4, is_set: false };
    /// T is 1.
    pub const T_SET: Condition = Condition { flag: 6, is_set: true };
    /// T is 0.
    pub const T_CLEAR: Condition = Condition { flag: 6, is_set: false };

    /// The opposite.
    pub fn inverted(self) -> Condition {
        Condition { is_set: !self.is_set, ..self }
    }
}

/// One instruction. Targets in flash are byte addresses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Avr {
    /// An operation on two registers.
    Two(Two, Reg, Reg),
    /// An operation on a register and a constant.
    Constant(Constant, Reg, u8),
    /// An operation on a bit of a register.
    Bit(OfBit, Reg, u8),
    /// Inverts a register.
    Com(Reg),
    /// T := 1.
    Set,
    /// T := 0.
    Clt,
    /// Loads from a data address.
    Lds(Reg, u16),
    /// Stores at a data address.
    Sts(u16, Reg),
    /// Loads from Y with a displacement of at most 63.
    Ldd(Reg, u8),
    /// Stores at Y with a displacement of at most 63.
    Std(u8, Reg),
    /// Branches at most 63 words.
    Branch(Condition, u16),
    /// Jumps at most 2,047 words.
    Rjmp(u16),
    /// Jumps anywhere.
    Jmp(u16),
    /// Calls.
    Call(u16),
    /// Calls at most 2,047 words away.
    Rcall(u16),
    /// Returns.
    Ret,
    /// Pushes onto the hardware stack.
    Push(Reg),
    /// Pops from there.
    Pop(Reg),
    /// Loads from an I/O address.
    In(Reg, u8),
}

/// Words that a branch can go forward from the instruction after it; back it is one more.
pub const BRANCH_WORDS: i32 = 63;
/// The same for a relative jump.
pub const RJMP_WORDS: i32 = 2047;

impl Avr {
    /// Length in words.
    pub fn words(self) -> u16 {
        match self {
            Avr::Lds(..) | Avr::Sts(..) | Avr::Jmp(_) | Avr::Call(_) => 2,
            _ => 1,
        }
    }

    /// Cycles when neither a branch is taken nor something skipped. A taken branch takes one more,
    /// a skip one more for every word skipped.
    pub fn cycles(self) -> u32 {
        match self {
            Avr::Lds(..) | Avr::Sts(..) | Avr::Ldd(..) | Avr::Std(..) | Avr::Rjmp(_) => 2,
            Avr::Push(_) | Avr::Pop(_) => 2,
            Avr::Jmp(_) | Avr::Rcall(_) => 3,
            Avr::Call(_) | Avr::Ret => 4,
            _ => 1,
        }
    }

    /// Whether the next instruction may be skipped.
    pub fn skips(self) -> bool {
        matches!(self, Avr::Bit(OfBit::Sbrc | OfBit::Sbrs, ..) | Avr::Two(Two::Cpse, ..))
    }

    /// The words of the instruction at this flash address; the second counts only if there are two.
    pub fn encode(self, at: u16) -> [u16; 2] {
        let relative = |target: u16| (i32::from(target) - i32::from(at)) / 2 - 1;
        match self {
            Avr::Two(two, d, r) => [two_registers(two) | d_field(d) | r_field(r), 0],
            Avr::Constant(constant, d, k) => {
                let k = u16::from(k);
                [
                    with_constant(constant)
                        | (k & 0xF0) << 4
                        | u16::from(d.0 & 0x0F) << 4
                        | k & 0x0F,
                    0,
                ]
            }
            Avr::Bit(of_bit, d, bit) => {
                let base = match of_bit {
                    OfBit::Bld => 0xF800,
                    OfBit::Bst => 0xFA00,
                    OfBit::Sbrc => 0xFC00,
                    OfBit::Sbrs => 0xFE00,
                };
                [base | d_field(d) | u16::from(bit & 7), 0]
            }
            Avr::Com(d) => [0x9400 | d_field(d), 0],
            Avr::Set => [0x9468, 0],
            Avr::Clt => [0x94E8, 0],
            Avr::Lds(d, address) => [0x9000 | d_field(d), address],
            Avr::Sts(address, r) => [0x9200 | d_field(r), address],
            Avr::Ldd(d, q) => [0x8008 | d_field(d) | q_field(q), 0],
            Avr::Std(q, r) => [0x8208 | d_field(r) | q_field(q), 0],
            Avr::Branch(condition, target) => {
                let base = if condition.is_set { 0xF000 } else { 0xF400 };
                [base | (relative(target) as u16 & 0x7F) << 3 | u16::from(condition.flag), 0]
            }
            Avr::Rjmp(target) => [0xC000 | relative(target) as u16 & 0x0FFF, 0],
            Avr::Jmp(target) => [0x940C, target / 2],
            Avr::Call(target) => [0x940E, target / 2],
            Avr::Rcall(target) => [0xD000 | relative(target) as u16 & 0x0FFF, 0],
            Avr::Ret => [0x9508, 0],
            Avr::Push(r) => [0x920F | d_field(r), 0],
            Avr::Pop(d) => [0x900F | d_field(d), 0],
            Avr::In(d, io) => {
                [0xB000 | d_field(d) | u16::from(io & 0x30) << 5 | u16::from(io & 0x0F), 0]
            }
        }
    }
}

fn d_field(register: Reg) -> u16 {
    u16::from(register.0 & 0x1F) << 4
}

fn r_field(register: Reg) -> u16 {
    let r = u16::from(register.0 & 0x1F);
    (r & 0x10) << 5 | r & 0x0F
}

fn q_field(q: u8) -> u16 {
    let q = u16::from(q & 0x3F);
    (q & 0x20) << 8 | (q & 0x18) << 7 | q & 0x07
}

fn two_registers(two: Two) -> u16 {
    match two {
        Two::Cpc => 0x0400,
        Two::Sbc => 0x0800,
        Two::Add => 0x0C00,
        Two::Cpse => 0x1000,
        Two::Cp => 0x1400,
        Two::Sub => 0x1800,
        Two::Adc => 0x1C00,
        Two::And => 0x2000,
        Two::Or => 0x2800,
        Two::Mov => 0x2C00,
    }
}

fn with_constant(constant: Constant) -> u16 {
    match constant {
        Constant::Cpi => 0x3000,
        Constant::Sbci => 0x4000,
        Constant::Subi => 0x5000,
        Constant::Ori => 0x6000,
        Constant::Andi => 0x7000,
        Constant::Ldi => 0xE000,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What avr-as makes of them.
    const ENCODED: &[(Avr, &[u16])] = &[
        (Avr::Two(Two::Add, Reg(2), Reg(31)), &[0x0E2F]),
        (Avr::Two(Two::Adc, Reg(18), Reg(27)), &[0x1F2B]),
        (Avr::Two(Two::Sub, Reg(19), Reg(4)), &[0x1934]),
        (Avr::Two(Two::Sbc, Reg(31), Reg(15)), &[0x09FF]),
        (Avr::Two(Two::And, Reg(2), Reg(24)), &[0x2228]),
        (Avr::Two(Two::Or, Reg(15), Reg(25)), &[0x2AF9]),
        (Avr::Two(Two::Mov, Reg(24), Reg(2)), &[0x2D82]),
        (Avr::Two(Two::Cp, Reg(26), Reg(17)), &[0x17A1]),
        (Avr::Two(Two::Cpc, Reg(27), Reg(1)), &[0x05B1]),
        (Avr::Two(Two::Cpse, Reg(24), Reg(1)), &[0x1181]),
        (Avr::Constant(Constant::Ldi, Reg(31), 0x5A), &[0xE5FA]),
        (Avr::Constant(Constant::Subi, Reg(19), 0xFF), &[0x5F3F]),
        (Avr::Constant(Constant::Sbci, Reg(18), 0x80), &[0x4820]),
        (Avr::Constant(Constant::Andi, Reg(24), 0xF8), &[0x7F88]),
        (Avr::Constant(Constant::Ori, Reg(17), 0x21), &[0x6211]),
        (Avr::Constant(Constant::Cpi, Reg(16), 0x7F), &[0x370F]),
        (Avr::Bit(OfBit::Bst, Reg(31), 7), &[0xFBF7]),
        (Avr::Bit(OfBit::Bld, Reg(2), 5), &[0xF825]),
        (Avr::Bit(OfBit::Sbrc, Reg(16), 0), &[0xFD00]),
        (Avr::Bit(OfBit::Sbrs, Reg(15), 3), &[0xFEF3]),
        (Avr::Com(Reg(0)), &[0x9400]),
        (Avr::Set, &[0x9468]),
        (Avr::Clt, &[0x94E8]),
        (Avr::Lds(Reg(20), 0x05FF), &[0x9140, 0x05FF]),
        (Avr::Sts(0x0141, Reg(1)), &[0x9210, 0x0141]),
        (Avr::Ldd(Reg(22), 63), &[0xAD6F]),
        (Avr::Ldd(Reg(3), 5), &[0x803D]),
        (Avr::Ldd(Reg(3), 0), &[0x8038]),
        (Avr::Std(32, Reg(17)), &[0xA318]),
        (Avr::Std(24, Reg(4)), &[0x8E48]),
        (Avr::Ret, &[0x9508]),
        (Avr::Jmp(0x6ABC), &[0x940C, 0x355E]),
        (Avr::Call(0x0068), &[0x940E, 0x0034]),
        // From 0x6000.
        (Avr::Branch(Condition::EQUAL, 0x6080), &[0xF1F9]),
        (Avr::Branch(Condition::NOT_EQUAL, 0x5F82), &[0xF601]),
        (Avr::Branch(Condition::LOWER, 0x6002), &[0xF000]),
        (Avr::Branch(Condition::SAME_OR_HIGHER, 0x6002), &[0xF400]),
        (Avr::Branch(Condition::PLUS, 0x6002), &[0xF402]),
        (Avr::Branch(Condition::NO_OVERFLOW, 0x6002), &[0xF403]),
        (Avr::Branch(Condition::LESS, 0x6002), &[0xF004]),
        (Avr::Branch(Condition::GREATER_OR_EQUAL, 0x6002), &[0xF404]),
        (Avr::Branch(Condition::T_SET, 0x6002), &[0xF006]),
        (Avr::Branch(Condition::T_CLEAR, 0x6002), &[0xF406]),
        (Avr::Rjmp(0x7000), &[0xC7FF]),
        (Avr::Rjmp(0x5002), &[0xC800]),
        (Avr::Rcall(0x7000), &[0xD7FF]),
        (Avr::Push(Reg(16)), &[0x930F]),
        (Avr::Pop(Reg(17)), &[0x911F]),
        (Avr::In(Reg(24), 0x09), &[0xB189]),
    ];

    #[test]
    fn instructions_are_encoded_as_the_assembler_does() {
        for &(instruction, words) in ENCODED {
            assert_eq!(usize::from(instruction.words()), words.len(), "{instruction:?}");
            let encoded = instruction.encode(0x6000);
            assert_eq!(&encoded[..words.len()], words, "{instruction:?} is {encoded:04x?}");
        }
    }
}
