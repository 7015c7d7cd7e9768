//! The instruction table as bytes, for those who look a token up: the decoder and the compact engine. With it what the
//! loader's check looks up: the rules for kinds of operands and for data addresses.
//!
//! On the board a constant with pointers would cost SRAM, so that the table is an array which the board keeps in flash
//! and hands out byte by byte ([`ProgramMemory::token_table`]).

use crate::access::{BESIDE_PAGE, IN_PAGE};
use crate::image::ProgramMemory;
use crate::layout::{DATA_START, PAGE_START};
use crate::modules::{Routine, module_of_token};
use crate::operand::{Kind, MODE_MEMORY, Raw};
use crate::rules::{KIND_RULES_LEN, Storage};
use crate::table::{CORE_INSTRUCTIONS, Form, INSTRUCTIONS, Instruction, Op, StackEffect, WIDE_PREFIX};

/// Most operands of an instruction.
pub(crate) const OPERANDS_MAX: usize = 4;

/// Bytes of an entry: first token, instruction, effect on the stack, where its kinds stand. So long are entries for data
/// addresses too.
pub(crate) const ENTRY_LEN: usize = 4;
/// The instruction in entries for tokens that are not defined.
const UNDEFINED: u8 = 0xFF;
/// Where the entries begin for tokens, for tokens behind the prefix, for addresses in the bit page and for those behind it:
/// an entry is for its first token or address and all up to that of the next. A group begins with 0.
const TOKENS_AT: usize = 0;
const WIDE_AT: usize = TOKENS_AT + entries(false) * ENTRY_LEN;
pub(crate) const IN_PAGE_AT: usize = WIDE_AT + entries(true) * ENTRY_LEN;
pub(crate) const BESIDE_PAGE_AT: usize = IN_PAGE_AT + IN_PAGE.len() * ENTRY_LEN;
/// Where the lists of kinds begin, each ended by 0; the first is empty.
const KINDS_AT: usize = BESIDE_PAGE_AT + BESIDE_PAGE.len() * ENTRY_LEN;

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

/// The token table: the entries, then the lists of kinds, which many forms share, then the rules for the kinds.
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
    let (mut table, mut end) = ([0; LONG_TABLE_LEN], KINDS_AT + 1);
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
const fn with_entries(mut table: [u8; LONG_TABLE_LEN], at: usize, entries: &[[u8; ENTRY_LEN]]) -> [u8; LONG_TABLE_LEN] {
    let mut byte = 0;
    while byte < entries.len() * ENTRY_LEN {
        table[at + byte] = entries[byte / ENTRY_LEN][byte % ENTRY_LEN];
        byte += 1;
    }
    table
}

/// Where in the token table the entry is for a token or the low byte of an address, in the group that begins at `at`.
#[cfg_attr(target_arch = "avr", inline(never))]
pub(crate) fn entry_for<P: ProgramMemory>(memory: &P, at: usize, key: u8) -> u16 {
    let mut at = at as u16;
    loop {
        let next = at + ENTRY_LEN as u16;
        // Behind the last entry stands the 0 of the next group, which wraps.
        let [first, _] = memory.token_table(next);
        if first.wrapping_sub(1) >= key {
            return at;
        }
        at = next;
    }
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
    /// The effect on the stack, [`packed`].
    pub stack: u8,
    /// How far the token is from the first one of its form.
    in_token: u8,
    /// Offset of the first byte behind the instruction.
    pub next: u16,
    /// The operands; behind the last there are none.
    pub operands: [Raw; OPERANDS_MAX],
}

impl Fetched {
    /// Nothing yet: all 0. Anything else the board would keep in SRAM to copy it from there.
    pub const NOTHING: Fetched =
        Fetched { op: Op::Ld, stack: 0, in_token: 0, next: 0, operands: [Raw::NONE; OPERANDS_MAX] };

    /// Fetches the instruction at `pc`. Returns whether its token is in the table.
    #[cfg_attr(target_arch = "avr", inline(never))]
    pub fn fetch<P: ProgramMemory>(&mut self, code: &P, pc: u16) -> bool {
        let (mut token, mut group) = (code.byte(pc), TOKENS_AT);
        self.next = pc.wrapping_add(1);
        self.in_token = 0;
        let routine = if let Some(module) = module_of_token(token) {
            let number = self.byte(code);
            code.routine(module, number)
        } else {
            if token == WIDE_PREFIX {
                (token, group) = (self.byte(code), WIDE_AT);
            }
            self.core_routine(code, group, token)
        };
        let Some(routine) = routine else { return false };
        (self.op, self.stack) = (routine.op, routine.stack);
        self.operands(code, pc, routine.kinds_at);
        true
    }

    /// Looks up a token of the core.
    #[inline(always)]
    fn core_routine<P: ProgramMemory>(&mut self, code: &P, group: usize, token: u8) -> Option<Routine> {
        let at = entry_for(code, group, token);
        let ([first, op], [stack, kinds]) = (code.token_table(at), code.token_table(at + 2));
        self.in_token = token.wrapping_sub(first);
        Some(Routine { op: Op::of_number(op)?, stack, kinds_at: code.kinds_at(KINDS_AT as u16 + u16::from(kinds)) })
    }

    /// Fetches the operands of the instruction at `pc`, whose kinds stand at `kinds_at`.
    #[inline(always)]
    fn operands<P: ProgramMemory>(&mut self, code: &P, pc: u16, mut kinds_at: u16) {
        for index in 0..OPERANDS_MAX {
            let kind = code.kind(kinds_at);
            self.operands[index].kind = kind;
            // The 0 that ends the list is read again for every operand that there is not.
            if kind != 0 {
                let (tag, value) = self.operand(code, pc, kind);
                (self.operands[index].tag, self.operands[index].value) = (tag, value);
                kinds_at += 1;
            }
        }
    }

    /// Reads the next operand of the instruction at `pc`: tag and value.
    #[cfg_attr(target_arch = "avr", inline(never))]
    fn operand<P: ProgramMemory>(&mut self, code: &P, pc: u16, kind: u8) -> (u8, u16) {
        let [rule, _] = code.token_table(rules_at(kind));
        let storage = Storage::of_rule(rule);
        let (mut tag, mut value) = (0, 0);
        if storage.has_byte() {
            value = u16::from(self.byte(code));
        }
        if storage.has_word() {
            tag = value as u8;
            value = code.word(self.next);
            self.next = self.next.wrapping_add(2);
        }
        match storage {
            Storage::HERE => value = pc,
            Storage::ONE => value = 1,
            Storage::IN_TOKEN => value = u16::from(self.in_token),
            Storage::PAGE_BIT => (tag, value) = (self.in_token, value + PAGE_START),
            Storage::SOURCE => tag = MODE_MEMORY,
            Storage::FAR_BIT => (tag, value) = (value as u8 & 7, DATA_START + (value >> 3)),
            _ => {}
        }
        (tag, value)
    }

    /// The next byte.
    #[inline(always)]
    fn byte<P: ProgramMemory>(&mut self, code: &P) -> u8 {
        let byte = code.byte(self.next);
        self.next = self.next.wrapping_add(1);
        byte
    }
}
