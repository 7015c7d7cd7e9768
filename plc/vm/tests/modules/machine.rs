//! A controller for single instructions: VB0 to VB399, SMB34 and SMB35, T5, C5; memory stays from
//! one program to the next.

use plc_isa::{
    AC_START, ARENA_START, Bit, CRC_LEN, Crc32, ENO, Header, LogicStack, Op, Operand, Reference,
    Referent, Relation, SM_START, UNO,
};
use plc_vm::{Environment, Fault, Memory, Plc};

/// Bytes of V memory.
pub const V_LEN: u16 = 400;
/// Where SMB34 is, after V memory.
pub const SMB34: u16 = ARENA_START + V_LEN;
/// Where the current value of T5 is.
pub const T5: u16 = SMB34 + 2;
/// Where the current value of C5 is.
pub const C5: u16 = T5 + 5;

/// Bits of SMB1.
pub const ZERO: u8 = 1 << 0;
pub const OVERFLOW: u8 = 1 << 1;
pub const NEGATIVE: u8 = 1 << 2;
pub const BY_ZERO: u8 = 1 << 3;

/// How an instruction ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// It is no box: ENO is what it was.
    NoBox,
    /// ENO = 1.
    Good,
    /// ENO = 0.
    NoResult,
    /// ENO = 0 and SM4.3.
    BadOperand,
    /// The controller has gone to STOP.
    Faulted(Fault),
}

/// Time, and the stack after the instruction that was executed last but one.
struct Outside {
    now_ms: u32,
    stacks: Vec<LogicStack>,
}

impl Environment for Outside {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        false
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, _at: u16, stack: LogicStack, _memory: &mut Memory) {
        self.stacks.push(stack);
    }
}

pub struct Machine {
    pub memory: Memory,
    constants: Vec<u8>,
    plc: Plc<Vec<u8>>,
    outside: Outside,
}

/// An instruction and its operands.
pub type Line<'a> = (Op, &'a [Operand]);

/// A value that no box gives ENO.
const ENO_OF_OTHERS: u8 = 2;

impl Machine {
    pub fn new() -> Machine {
        let outside = Outside { now_ms: 0, stacks: Vec::new() };
        Machine { memory: Memory::new(), constants: Vec::new(), plc: Plc::new(), outside }
    }

    /// Executes an instruction in a first scan, with power flow.
    pub fn run(&mut self, op: Op, operands: &[Operand]) -> End {
        let power = Operand::Bit(Bit { address: SM_START, bit: 0 });
        self.load(&[(Op::Ld, &[power]), (op, operands)]);
        self.scan()
    }

    /// The same without power flow.
    pub fn run_without_power(&mut self, op: Op, operands: &[Operand]) -> End {
        let power = Operand::Bit(Bit { address: SM_START, bit: 0 });
        self.load(&[(Op::Ldn, &[power]), (op, operands)]);
        self.scan()
    }

    /// Loads a program and goes to RUN.
    pub fn load(&mut self, lines: &[Line]) {
        let image = self.image(lines);
        self.plc = Plc::new();
        // Loading clears memory, which is to stay.
        self.plc
            .load(&mut Memory::new(), image)
            .unwrap_or_else(|error| panic!("{lines:?}: {error:?}"));
        self.plc.run();
    }

    pub fn scan(&mut self) -> End {
        self.memory.set_byte(SM_START + 4, 0);
        self.memory.set_byte(ENO, ENO_OF_OTHERS);
        self.outside.stacks.clear();
        self.plc.execute(&mut self.memory, &mut self.outside);
        match (self.plc.fault(), self.memory.byte(ENO), self.memory.byte(SM_START + 4)) {
            (Some(fault), ..) => End::Faulted(fault),
            (None, 1, 0) => End::Good,
            (None, ENO_OF_OTHERS, 0) => End::NoBox,
            (None, 0, 0) => End::NoResult,
            (None, 0, 8) => End::BadOperand,
            (None, eno, smb4) => panic!("ENO {eno}, SMB4 {smb4}"),
        }
    }

    pub fn set_time(&mut self, now_ms: u32) {
        self.outside.now_ms = now_ms;
    }

    /// The stack that the last instruction left, S0 in bit 0.
    pub fn stack(&self) -> u16 {
        self.outside.stacks.iter().rev().nth(1).map_or(0, |stack| stack.bits())
    }

    fn image(&self, lines: &[Line]) -> Vec<u8> {
        let mut code: Vec<u8> = Vec::new();
        for &(op, operands) in lines.iter().chain(&[(Op::MainEnd, &[] as &[Operand])]) {
            let encoded = op
                .instruction()
                .encode(operands, &UNO)
                .unwrap_or_else(|| panic!("{op:?} {operands:?}"));
            code.extend(encoded.bytes());
        }
        let ranges = [(0, V_LEN), (0x8000 + 34, V_LEN + 2)];
        let mut header = Header {
            code_len: code.len() as u16,
            arena_len: C5 + 3 + 1 - ARENA_START,
            edges: 8,
            v_ranges: 2,
            timers: 1,
            counters: 1,
            constants_len: self.constants.len() as u16,
            ..Header::default()
        };
        header.total_len = header.code_end() + CRC_LEN;
        let mut image = header.to_bytes(&UNO).to_vec();
        for (first, end) in ranges {
            image.extend(u16::to_le_bytes(first));
            image.extend(u16::to_le_bytes(end));
        }
        // T5 is not started; C5.
        image.extend([5, 3, 5]);
        image.extend(&self.constants);
        image.extend(code);
        image.extend(Crc32::of(&image).to_le_bytes());
        image
    }

    /// A constant of the pool.
    pub fn pool(&mut self, bytes: &[u8]) -> Operand {
        let tables = Header { v_ranges: 2, timers: 1, counters: 1, ..Header::default() };
        let offset = tables.constants_at() + self.constants.len() as u16;
        self.constants.extend(bytes);
        Operand::Reference(Reference::to(Referent::Pool(offset)))
    }

    /// A real constant.
    pub fn real(&mut self, value: f32) -> Operand {
        self.pool(&value.to_bits().to_be_bytes())
    }

    /// A text constant.
    pub fn text(&mut self, text: &str) -> Operand {
        let mut bytes = vec![text.len() as u8];
        bytes.extend(text.as_bytes());
        self.pool(&bytes)
    }

    /// SMB1.
    pub fn sm1(&self) -> u8 {
        self.memory.byte(SM_START + 1)
    }

    pub fn set_sm1(&mut self, value: u8) {
        self.memory.set_byte(SM_START + 1, value);
    }

    /// V memory from byte `byte` on.
    pub fn bytes(&self, byte: u16, len: u16) -> Vec<u8> {
        (byte..byte + len).map(|byte| self.memory.byte(ARENA_START + byte)).collect()
    }

    pub fn set_bytes(&mut self, byte: u16, bytes: &[u8]) {
        (ARENA_START + byte..)
            .zip(bytes)
            .for_each(|(address, &byte)| self.memory.set_byte(address, byte));
    }

    /// Words of V memory.
    pub fn words(&self, byte: u16, count: u16) -> Vec<i16> {
        (0..count).map(|index| self.memory.int(ARENA_START + byte + 2 * index)).collect()
    }

    pub fn set_words(&mut self, byte: u16, words: &[i16]) {
        words
            .iter()
            .zip(0..)
            .for_each(|(&word, index)| self.memory.set_int(ARENA_START + byte + 2 * index, word));
    }

    pub fn double(&self, byte: u16) -> i32 {
        i32::from(self.memory.int(ARENA_START + byte)) << 16
            | i32::from(self.memory.word(ARENA_START + byte + 2))
    }

    pub fn set_double(&mut self, byte: u16, value: u32) {
        self.set_bytes(byte, &value.to_be_bytes());
    }

    pub fn set_real(&mut self, byte: u16, value: f32) {
        self.set_double(byte, value.to_bits());
    }

    pub fn real_at(&self, byte: u16) -> f32 {
        f32::from_bits(self.double(byte) as u32)
    }

    /// The characters of a string in V memory.
    pub fn text_at(&self, byte: u16) -> String {
        let len = self.bytes(byte, 1)[0];
        String::from_utf8(self.bytes(byte + 1, u16::from(len))).unwrap_or_default()
    }

    pub fn set_text(&mut self, byte: u16, text: &str) {
        self.set_bytes(byte, &[text.len() as u8]);
        self.set_bytes(byte + 1, text.as_bytes());
    }
}

/// A data address.
pub fn data(address: u16) -> Operand {
    Operand::Reference(Reference::to(Referent::Direct(address)))
}

/// A byte of V memory, or what begins there.
pub fn v(byte: u16) -> Operand {
    data(ARENA_START + byte)
}

/// What the pointer in a double word of V memory leads to.
pub fn at(byte: u16) -> Operand {
    Operand::Reference(Reference::to(Referent::Indirect(ARENA_START + byte)))
}

/// What the pointer in an accumulator leads to.
pub fn at_accumulator(number: u16) -> Operand {
    Operand::Reference(Reference::to(Referent::Indirect(AC_START + 4 * number)))
}

/// A constant.
pub fn c(value: i16) -> Operand {
    assert!((Reference::CONSTANT_MIN..=Reference::CONSTANT_MAX).contains(&i32::from(value)));
    Operand::Reference(Reference::to(Referent::Constant(value)))
}

/// A comparison.
pub fn relation(relation: Relation) -> Operand {
    Operand::Relation(relation)
}

/// A bit at a data address.
pub fn bit(address: u16, bit: u8) -> Operand {
    Operand::Bit(Bit { address, bit })
}
