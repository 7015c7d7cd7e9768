//! Fetching an instruction from the code: its token and its operands, by the token table.

use crate::access::ENTRY_LEN;
use crate::layout::{DATA_START, PAGE_START};
use crate::memory::ProgramMemory;
use crate::modules::module_of_token;
use crate::operand::{MODE_MEMORY, OPERANDS_MAX, Raw};
use crate::routines::Routine;
use crate::rules::KIND_RULES_LEN;
use crate::shape::Storage;
use crate::table::{Op, WIDE_PREFIX};
use crate::token_table::{KINDS_AT, RULES_AT, TOKENS_AT, WIDE_AT};

/// Where the rules stand for the kind with this number.
pub(crate) fn rules_at(number: u8) -> u16 {
    RULES_AT as u16 + (KIND_RULES_LEN as u16) * u16::from(number - 1)
}

/// Where in the token table the entry is for a token or the low byte of an address, in the group
/// that begins at `at`.
#[cfg_attr(target_arch = "avr", inline(never))]
pub(crate) fn entry_for<P: ProgramMemory>(memory: &P, at: usize, key: u8) -> u16 {
    let mut at = at as u16;
    loop {
        let next = at + ENTRY_LEN as u16;
        // After the last entry is the 0 of the next group, which wraps.
        let [first, _] = memory.token_table(next);
        if first.wrapping_sub(1) >= key {
            return at;
        }
        at = next;
    }
}

/// An instruction as it stands in the code: what its token says, and its operands. Filled in place,
/// because on the board every copy costs more than what is copied.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fetched {
    pub op: Op,
    /// The effect on the stack, [`packed`].
    pub stack: u8,
    /// How far the token is from the first one of its form.
    in_token: u8,
    /// Offset of the first byte after the instruction.
    pub next: u16,
    /// The operands; after the last there are none.
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
    fn core_routine<P: ProgramMemory>(
        &mut self,
        code: &P,
        group: usize,
        token: u8,
    ) -> Option<Routine> {
        let at = entry_for(code, group, token);
        let ([first, op], [stack, kinds]) = (code.token_table(at), code.token_table(at + 2));
        self.in_token = token.wrapping_sub(first);
        Some(Routine {
            op: Op::of_number(op)?,
            stack,
            kinds_at: code.kinds_at(KINDS_AT as u16 + u16::from(kinds)),
        })
    }

    /// Fetches the operands of the instruction at `pc`, whose kinds are at `kinds_at`.
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
        if code.is_wide()
            && let Some(operand) = self.wide_operand(code, storage)
        {
            return operand;
        }
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

    /// The next operand of a wide image, if it is one that is stored otherwise there.
    fn wide_operand<P: ProgramMemory>(&mut self, code: &P, storage: Storage) -> Option<(u8, u16)> {
        let bit = match storage {
            Storage::FAR_BIT => self.byte(code) & 7,
            Storage::LABEL => 0,
            _ => return None,
        };
        let value = code.word(self.next);
        self.next = self.next.wrapping_add(2);
        Some((bit, value))
    }

    /// The next byte.
    #[inline(always)]
    fn byte<P: ProgramMemory>(&mut self, code: &P) -> u8 {
        let byte = code.byte(self.next);
        self.next = self.next.wrapping_add(1);
        byte
    }
}
