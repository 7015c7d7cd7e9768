//! The instruction table as bytes, for those who look a token up: the decoder and the compact engine.
//!
//! On the board a constant with pointers would cost SRAM, so that the table is an array which the board keeps in flash
//! and hands out byte by byte ([`ProgramMemory::token_table`]).

use crate::image::ProgramMemory;
use crate::operand::{Kind, OperandReader, Raw};
use crate::table::{CORE_INSTRUCTIONS, Form, INSTRUCTIONS, MODULE_PREFIX, Op, StackEffect, WIDE_PREFIX};

/// Most operands of an instruction.
pub(crate) const OPERANDS_MAX: usize = 4;

/// Tokens behind [`WIDE_PREFIX`] that the table has room for.
const WIDE_TOKENS: usize = 64;
/// Bytes of an entry: first token, instruction, effect on the stack, where its kinds stand.
const ENTRY_LEN: usize = 4;
/// Where the entries begin: behind an index byte for every token and every wide token.
const ENTRIES_AT: usize = 256 + WIDE_TOKENS;
/// Where the lists of kinds begin, each ended by 0.
const KINDS_AT: usize = ENTRIES_AT + FORMS * ENTRY_LEN;

/// How many forms the instructions of the core have together.
const FORMS: usize = {
    let (mut forms, mut index) = (0, 0);
    while index < CORE_INSTRUCTIONS {
        forms += INSTRUCTIONS[index].forms.len();
        index += 1;
    }
    forms
};

/// Bytes of the token table.
pub const TOKEN_TABLE_LEN: usize = LONG_TABLE.1;

/// The token table: for every token the number of its entry, 0 for undefined tokens; then the entries, then the lists of
/// kinds, which many forms share.
pub const TOKEN_TABLE: [u8; TOKEN_TABLE_LEN] = {
    let (mut table, mut at) = ([0; TOKEN_TABLE_LEN], 0);
    while at < TOKEN_TABLE_LEN {
        table[at] = LONG_TABLE.0[at];
        at += 1;
    }
    table
};

/// More than the table can take.
const LONG_TABLE_LEN: usize = KINDS_AT + 256;

/// The table with room behind it, and its length.
const LONG_TABLE: ([u8; LONG_TABLE_LEN], usize) = {
    let (mut table, mut end) = ([0; LONG_TABLE_LEN], KINDS_AT);
    let (mut index, mut entry) = (0, 0);
    while index < CORE_INSTRUCTIONS {
        let instruction = &INSTRUCTIONS[index];
        let mut form = 0;
        while form < instruction.forms.len() {
            let kinds_at;
            (table, kinds_at, end) = with_kinds(table, end, instruction.forms[form].kinds);
            let head = [instruction.op as u8, packed(instruction.stack), kinds_at];
            table = with_entry(table, entry, head, &instruction.forms[form]);
            entry += 1;
            form += 1;
        }
        index += 1;
    }
    (table, end)
};

/// The effect on the stack in a byte: values needed below, values added above.
pub(crate) const fn packed(effect: StackEffect) -> u8 {
    assert!(effect.needs < 8 && -8 <= effect.adds && effect.adds < 8);
    assert!(effect.needs as i8 + effect.adds >= 0, "more is taken than is needed");
    effect.needs | (effect.adds as u8) << 4
}

const fn unpacked(byte: u8) -> StackEffect {
    StackEffect { needs: byte & 7, adds: byte as i8 >> 4 }
}

/// Enters a list of kinds behind the others, unless it is there already. Returns where, from [`KINDS_AT`] on, and the
/// new end.
const fn with_kinds(mut table: [u8; LONG_TABLE_LEN], end: usize, kinds: &[Kind]) -> ([u8; LONG_TABLE_LEN], u8, usize) {
    assert!(kinds.len() <= OPERANDS_MAX && end - KINDS_AT < 256);
    let mut at = KINDS_AT;
    while at < end {
        let mut same = 0;
        while same < kinds.len() && table[at + same] == kinds[same].number() {
            same += 1;
        }
        if same == kinds.len() && table[at + same] == 0 {
            return (table, (at - KINDS_AT) as u8, end);
        }
        at += 1;
    }
    let mut index = 0;
    while index < kinds.len() {
        table[end + index] = kinds[index].number();
        index += 1;
    }
    (table, (end - KINDS_AT) as u8, end + kinds.len() + 1)
}

const fn with_entry(
    mut table: [u8; LONG_TABLE_LEN],
    entry: usize,
    [op, stack, kinds_at]: [u8; 3],
    form: &Form,
) -> [u8; LONG_TABLE_LEN] {
    assert!(entry < 255);
    let first_index = if form.prefix.is_some() { 256 } else { 0 };
    let mut token = form.first_token as usize;
    assert!(form.prefix.is_none() || (form.last_token as usize) < WIDE_TOKENS);
    while token <= form.last_token as usize {
        assert!(table[first_index + token] == 0, "a token belongs to two forms");
        table[first_index + token] = entry as u8 + 1;
        token += 1;
    }
    let at = ENTRIES_AT + entry * ENTRY_LEN;
    (table[at], table[at + 1], table[at + 2], table[at + 3]) = (form.first_token, op, stack, kinds_at);
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
    /// The operands' kinds, `None` behind the last.
    pub kinds: [Option<Kind>; OPERANDS_MAX],
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
            kinds: [None; OPERANDS_MAX],
        }
    }

    /// Fetches the instruction at `pc`. Returns whether its token is in the table.
    pub fn fetch<P: ProgramMemory>(&mut self, code: &P, pc: u16) -> bool {
        let (mut token, mut operands_at, mut index_at) = (code.byte(pc), pc.wrapping_add(1), 0);
        if token & !7 == MODULE_PREFIX {
            let Some(routine) = code.routine(token - MODULE_PREFIX, code.byte(operands_at)) else { return false };
            (self.op, self.stack) = (routine.op, unpacked(routine.stack));
            self.operands(code, routine.kinds_at, OperandReader::new(code, pc, pc.wrapping_add(2), 0));
            return true;
        }
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
        self.stack = unpacked(code.token_table(at + 2));
        let kinds_at = KINDS_AT as u16 + u16::from(code.token_table(at + 3));
        let in_token = token.wrapping_sub(code.token_table(at));
        self.operands(code, kinds_at, OperandReader::new(code, pc, operands_at, in_token));
        true
    }

    /// Fetches the operands whose kinds stand at `kinds_at` in the token table.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn operands<P: ProgramMemory>(&mut self, code: &P, mut kinds_at: u16, mut reader: OperandReader<'_, P>) {
        for (operand, kind) in self.operands.iter_mut().zip(&mut self.kinds) {
            *kind = Kind::of_number(code.token_table(kinds_at));
            // The 0 that ends the list is read again for every operand that there is not.
            if let Some(kind) = *kind {
                *operand = kind.read_raw(&mut reader);
                kinds_at += 1;
            }
        }
        self.next = reader.position();
    }
}
