//! The instruction table as bytes, for those who look a token up: the decoder and the compact engine.
//!
//! On the board a constant with pointers would cost SRAM, so that the table is an array which the board keeps in flash
//! and hands out byte by byte ([`ProgramMemory::token_table`]).

use crate::image::ProgramMemory;
use crate::operand::{Kind, OperandReader, Raw};
use crate::table::{Form, INSTRUCTIONS, Op, StackEffect, WIDE_PREFIX};

/// Most operands of an instruction.
pub(crate) const OPERANDS_MAX: usize = 4;

/// Tokens behind [`WIDE_PREFIX`] that the table has room for.
const WIDE_TOKENS: usize = 64;
/// Bytes of an entry: first token, instruction, values needed, values added, kinds.
const ENTRY_LEN: usize = 4 + OPERANDS_MAX;
/// Where the entries begin: behind an index byte for every token and every wide token.
const ENTRIES_AT: usize = 256 + WIDE_TOKENS;

/// How many forms the instructions have together.
const FORMS: usize = {
    let (mut forms, mut index) = (0, 0);
    while index < INSTRUCTIONS.len() {
        forms += INSTRUCTIONS[index].forms.len();
        index += 1;
    }
    forms
};

/// Bytes of the token table.
pub const TOKEN_TABLE_LEN: usize = ENTRIES_AT + FORMS * ENTRY_LEN;

/// The token table: for every token the number of its entry, 0 for undefined tokens; then the entries.
pub const TOKEN_TABLE: [u8; TOKEN_TABLE_LEN] = {
    let mut table = [0; TOKEN_TABLE_LEN];
    let (mut index, mut entry) = (0, 0);
    while index < INSTRUCTIONS.len() {
        let instruction = &INSTRUCTIONS[index];
        let mut form = 0;
        while form < instruction.forms.len() {
            let head = [instruction.op as u8, instruction.stack.needs, instruction.stack.adds as u8];
            table = with_entry(table, entry, head, &instruction.forms[form]);
            entry += 1;
            form += 1;
        }
        index += 1;
    }
    table
};

const fn with_entry(
    mut table: [u8; TOKEN_TABLE_LEN],
    entry: usize,
    [op, needs, adds]: [u8; 3],
    form: &Form,
) -> [u8; TOKEN_TABLE_LEN] {
    assert!(entry < 255 && form.kinds.len() <= OPERANDS_MAX);
    let first_index = if form.wide { 256 } else { 0 };
    let mut token = form.first_token as usize;
    assert!(!form.wide || (form.last_token as usize) < WIDE_TOKENS);
    while token <= form.last_token as usize {
        assert!(table[first_index + token] == 0, "a token belongs to two forms");
        table[first_index + token] = entry as u8 + 1;
        token += 1;
    }
    let at = ENTRIES_AT + entry * ENTRY_LEN;
    (table[at], table[at + 1], table[at + 2], table[at + 3]) = (form.first_token, op, needs, adds);
    let mut kind = 0;
    while kind < form.kinds.len() {
        table[at + 4 + kind] = form.kinds[kind].number();
        kind += 1;
    }
    table
}

/// An instruction as it stands in the code: what its token says, and its operands. Filled in place, because on the
/// board every copy costs more than what is copied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fetched {
    pub op: Op,
    pub stack: StackEffect,
    /// The operands, as many as there are kinds.
    pub operands: [Raw; OPERANDS_MAX],
    /// Offset of the first byte behind the instruction.
    pub next: u16,
    /// Where the numbers of the operands' kinds stand in the table; 0 ends them.
    kinds_at: u16,
}

impl Fetched {
    /// Nothing yet. No constant: the board would keep it in SRAM to copy it from there.
    #[inline(always)]
    pub fn nothing() -> Fetched {
        Fetched {
            op: Op::MainEnd,
            stack: StackEffect { needs: 0, adds: 0 },
            operands: [Raw::ZERO; OPERANDS_MAX],
            next: 0,
            kinds_at: 0,
        }
    }

    /// Fetches the instruction at `pc`. Returns whether its token is in the table.
    pub fn fetch<P: ProgramMemory>(&mut self, code: &P, pc: u16) -> bool {
        let (mut token, mut operands_at, mut index_at) = (code.byte(pc), pc.wrapping_add(1), 0);
        if token == WIDE_PREFIX {
            (token, operands_at, index_at) = (code.byte(operands_at), pc.wrapping_add(2), 256);
            if usize::from(token) >= WIDE_TOKENS {
                return false;
            }
        }
        let entry = code.token_table(index_at + u16::from(token));
        if entry == 0 {
            return false;
        }
        let at = ENTRIES_AT as u16 + u16::from(entry - 1) * ENTRY_LEN as u16;
        let Some(op) = Op::of_number(code.token_table(at + 1)) else { return false };
        self.op = op;
        self.stack = StackEffect { needs: code.token_table(at + 2), adds: code.token_table(at + 3) as i8 };
        self.kinds_at = at + 4;
        let in_token = token.wrapping_sub(code.token_table(at));
        let mut reader = OperandReader::new(code, pc, operands_at, in_token);
        for index in 0..OPERANDS_MAX {
            let (Some(kind), Some(operand)) = (self.kind(code, index), self.operands.get_mut(index)) else { break };
            *operand = kind.read_raw(&mut reader);
        }
        self.next = reader.position();
        true
    }

    /// The kind of operand `index`, if there are so many.
    #[inline]
    pub fn kind<P: ProgramMemory>(&self, code: &P, index: usize) -> Option<Kind> {
        if index >= OPERANDS_MAX {
            return None;
        }
        Kind::of_number(code.token_table(self.kinds_at + index as u16))
    }
}
