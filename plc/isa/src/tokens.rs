//! The instruction table as bytes, for those who look a token up: the decoder and the compact engine.
//!
//! On the board a constant with pointers would cost SRAM, so that the table is an array which the board keeps in flash
//! and hands out byte by byte ([`ProgramMemory::token_table`]).

use crate::image::ProgramMemory;
use crate::modules::module_of_token;
use crate::operand::{Kind, OperandReader, Raw};
use crate::rules::{KIND_RULES_LEN, read_raw};
use crate::table::{CORE_INSTRUCTIONS, Form, INSTRUCTIONS, Instruction, Op, StackEffect, WIDE_PREFIX};

/// Most operands of an instruction.
pub(crate) const OPERANDS_MAX: usize = 4;

/// Bytes of an entry: first token, instruction, effect on the stack, where its kinds stand.
const ENTRY_LEN: usize = 4;
/// The instruction in entries for tokens that are not defined.
const UNDEFINED: u8 = 0xFF;
/// Entries for tokens, then for those behind the prefix: an entry is for its first token and all up to that of the next.
const TOKEN_ENTRIES: usize = entries(false);
const WIDE_ENTRIES: usize = entries(true);
/// Where the lists of kinds begin, each ended by 0.
const KINDS_AT: usize = (TOKEN_ENTRIES + WIDE_ENTRIES) * ENTRY_LEN;

/// The form that a token of the core belongs to, and its instruction.
const fn form_of(token: u8, is_wide: bool) -> Option<(&'static Instruction, &'static Form)> {
    let (mut index, mut found) = (0, None);
    while index < CORE_INSTRUCTIONS {
        let instruction = &INSTRUCTIONS[index];
        let mut form = 0;
        while form < instruction.forms.len() {
            let candidate = &instruction.forms[form];
            let has_token = candidate.first_token <= token && token <= candidate.last_token;
            if has_token && candidate.prefix.is_some() == is_wide {
                assert!(found.is_none(), "a token belongs to two forms");
                found = Some((instruction, candidate));
            }
            form += 1;
        }
        index += 1;
    }
    found
}

/// Whether an entry begins with this token: with each form, and with each gap between forms.
const fn begins_entry(token: u8, is_wide: bool) -> bool {
    match form_of(token, is_wide) {
        Some((_, form)) => form.first_token == token,
        None => token == 0 || form_of(token - 1, is_wide).is_some(),
    }
}

const fn entries(is_wide: bool) -> usize {
    let (mut count, mut token) = (0, 0);
    while token < 256 {
        count += begins_entry(token as u8, is_wide) as usize;
        token += 1;
    }
    count
}

/// Bytes of the token table.
pub const TOKEN_TABLE_LEN: usize = LONG_TABLE.1;

/// The token table: the entries by ascending tokens, then those behind the prefix, then the lists of kinds, which many
/// forms share, then the rules for the kinds.
pub const TOKEN_TABLE: [u8; TOKEN_TABLE_LEN] = {
    let (mut table, mut at) = ([0; TOKEN_TABLE_LEN], 0);
    while at < TOKEN_TABLE_LEN {
        table[at] = LONG_TABLE.0[at];
        at += 1;
    }
    table
};

/// More than the table can take.
const LONG_TABLE_LEN: usize = KINDS_AT + 256 + KIND_RULES_LEN * Kind::ALL.len();
/// Where the rules for the kinds begin, two bytes each.
const RULES_AT: usize = TOKEN_TABLE_LEN - KIND_RULES_LEN * Kind::ALL.len();

/// Where the rules stand for the kind with this number.
pub(crate) fn rules_at(number: u8) -> u16 {
    RULES_AT as u16 + (KIND_RULES_LEN as u16) * u16::from(number - 1)
}

/// The table with room behind it, and its length.
const LONG_TABLE: ([u8; LONG_TABLE_LEN], usize) = {
    let (mut table, mut end) = ([0; LONG_TABLE_LEN], KINDS_AT);
    // Tokens, then tokens behind the prefix.
    let (mut number, mut at) = (0, 0);
    while number < 512 {
        let (token, is_wide) = (number as u8, number >= 256);
        if begins_entry(token, is_wide) {
            let (mut op, mut stack, mut kinds_at) = (UNDEFINED, 0, 0);
            if let Some((instruction, form)) = form_of(token, is_wide) {
                (op, stack) = (instruction.op as u8, packed(instruction.stack));
                (table, kinds_at, end) = with_kinds(table, end, form.kinds);
            }
            (table[at], table[at + 1], table[at + 2], table[at + 3]) = (token, op, stack, kinds_at);
            at += ENTRY_LEN;
        }
        number += 1;
    }
    let mut kind = 0;
    while kind < Kind::ALL.len() {
        (table[end], table[end + 1]) = (Kind::ALL[kind].rules()[0], Kind::ALL[kind].rules()[1]);
        end += KIND_RULES_LEN;
        kind += 1;
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
        let (mut token, mut operands_at) = (code.byte(pc), pc.wrapping_add(1));
        if let Some(module) = module_of_token(token) {
            let Some(routine) = code.routine(module, code.byte(operands_at)) else { return false };
            (self.op, self.stack) = (routine.op, unpacked(routine.stack));
            self.operands(code, routine.kinds_at, OperandReader::new(code, pc, pc.wrapping_add(2), 0));
            return true;
        }
        let (mut at, mut left) = (0, TOKEN_ENTRIES as u8);
        if token == WIDE_PREFIX {
            (token, operands_at) = (code.byte(operands_at), pc.wrapping_add(2));
            (at, left) = ((TOKEN_ENTRIES * ENTRY_LEN) as u16, WIDE_ENTRIES as u8);
        }
        // The last entry that does not begin behind the token.
        while left > 1 && code.token_table(at + ENTRY_LEN as u16) <= token {
            at += ENTRY_LEN as u16;
            left -= 1;
        }
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
            let number = code.token_table(kinds_at);
            *kind = Kind::of_number(number);
            // The 0 that ends the list is read again for every operand that there is not.
            if number != 0 {
                *operand = read_raw(code.token_table(rules_at(number)), &mut reader);
                kinds_at += 1;
            }
        }
        self.next = reader.position();
    }
}
