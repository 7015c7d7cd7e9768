//! The instruction table as bytes, for those who look a token up: the decoder and the compact
//! engine. With it what the loader's check looks up: the rules for kinds of operands and for data
//! addresses.
//!
//! On the board a constant with pointers would cost SRAM, so that the table is an array which the
//! board keeps in flash and hands out byte by byte
//! ([`ProgramMemory::token_table`](crate::ProgramMemory::token_table)).

use crate::access::{BESIDE_PAGE, ENTRY_LEN, IN_PAGE};
use crate::kind::Kind;
use crate::operand::OPERANDS_MAX;
use crate::rules::KIND_RULES_LEN;
use crate::table::{CORE_INSTRUCTIONS, Form, INSTRUCTIONS, Instruction, StackEffect};

/// The instruction in entries for tokens that are not defined.
const UNDEFINED: u8 = 0xFF;
/// Where the entries begin for tokens, for tokens after the prefix, for addresses in the bit page
/// and for those after it: an entry is for its first token or address and all up to that of the
/// next. A group begins with 0.
pub(crate) const TOKENS_AT: usize = 0;
pub(crate) const WIDE_AT: usize = TOKENS_AT + entries(false) * ENTRY_LEN;
pub(crate) const IN_PAGE_AT: usize = WIDE_AT + entries(true) * ENTRY_LEN;
pub(crate) const BESIDE_PAGE_AT: usize = IN_PAGE_AT + IN_PAGE.len() * ENTRY_LEN;
/// Where the lists of kinds begin, each ended by 0; the first is empty.
pub(crate) const KINDS_AT: usize = BESIDE_PAGE_AT + BESIDE_PAGE.len() * ENTRY_LEN;

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

/// The token table: the entries, then the lists of kinds, which many forms share, then the rules
/// for the kinds.
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
pub(crate) const RULES_AT: usize = TOKEN_TABLE_LEN - KIND_RULES_LEN * Kind::ALL.len();

/// The table with room after it, and its length.
const LONG_TABLE: ([u8; LONG_TABLE_LEN], usize) = {
    let (mut table, mut end) = ([0; LONG_TABLE_LEN], KINDS_AT + 1);
    // Tokens, then tokens after the prefix.
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
    table = with_entries(table, IN_PAGE_AT, &IN_PAGE);
    table = with_entries(table, BESIDE_PAGE_AT, &BESIDE_PAGE);
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

pub(crate) const fn unpacked(byte: u8) -> StackEffect {
    StackEffect { needs: byte & 7, adds: byte as i8 >> 4 }
}

/// Copies entries to an offset.
const fn with_entries(
    mut table: [u8; LONG_TABLE_LEN],
    at: usize,
    entries: &[[u8; ENTRY_LEN]],
) -> [u8; LONG_TABLE_LEN] {
    let mut byte = 0;
    while byte < entries.len() * ENTRY_LEN {
        table[at + byte] = entries[byte / ENTRY_LEN][byte % ENTRY_LEN];
        byte += 1;
    }
    table
}

/// Enters a list of kinds after the others, unless it is there already. Returns where, from
/// [`KINDS_AT`] on, and the new end.
const fn with_kinds(
    mut table: [u8; LONG_TABLE_LEN],
    end: usize,
    kinds: &[Kind],
) -> ([u8; LONG_TABLE_LEN], u8, usize) {
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
