//! The rules for the kinds of operands, two bytes each: how one is stored, and what may be in
//! it. The decoder and the loader's check look them up in the token table, which on the board is in
//! flash.

use crate::access::Access;
use crate::kind::{Kind, Limit, Type, Use, Written};
use crate::stack::STACK_LEVELS;

/// Bytes of the rules for a kind: how it is stored, what may be in it.
pub(crate) const KIND_RULES_LEN: usize = 2;
/// In the first byte, beside the [`Storage`](crate::shape::Storage): the operand is a reference.
pub(crate) const REFERENCE: u8 = 0x80;
/// In the first byte, from bit 4 on: bytes of the value that it leads to; 0 for bits, [`NUMBER`]
/// where it leads nowhere.
const LEN: u8 = 0x70;
pub(crate) const NUMBER: u8 = 7;

/// In the lower half of the second byte for addresses: what must be allowed there, as in
/// [`Access::traits`].
pub(crate) const WANTS: u8 = 0x0F;
/// In the upper half, for references: a number can be there, or a string. For other addresses
/// the areas that are allowed.
pub(crate) const CONSTANT: u8 = 6;
pub(crate) const TEXT: u8 = 7;

/// The second byte for numbers: any; one of as many as there are of its kind, together with the
/// count; a count.
pub(crate) const ANY: u8 = 0;
pub(crate) const NUMBERS: u8 = 1;
pub(crate) const COUNT: u8 = 2;
/// From here on to [`LEVEL`], a level of the logic stack: below that. After: what the plan has so
/// many of, as the offset in the image where it says how many.
pub(crate) const RELATION: u8 = 6;
const LOOP: u8 = 8;
pub(crate) const LEVEL: u8 = STACK_LEVELS;

/// Bytes of the value, from the first byte of the rules.
pub(crate) const fn len_of_rule(rule: u8) -> u8 {
    (rule & LEN) >> 4
}

impl Kind {
    /// How an operand of this kind is stored and what may be in it, for those who look that up:
    /// the decoder and the loader's check.
    pub(crate) const fn rules(self) -> [u8; KIND_RULES_LEN] {
        let (row, is_reference) = (self.row(), self.is_reference());
        let rule = match row.limit {
            Limit::Areas(_) if is_reference => self.wanted() | self.constants() << 4,
            Limit::Areas(areas) => self.wanted() | areas << 4,
            Limit::Any => ANY,
            Limit::Numbered => NUMBERS,
            Limit::Count => COUNT,
            Limit::Relation => RELATION,
            Limit::Loop => LOOP,
            Limit::Level => LEVEL,
            Limit::Planned(at) => at,
        };
        let len = match row.used {
            Use::Is => NUMBER,
            Use::Reads(Type::Bit) | Use::Writes(Type::Bit) => 0,
            Use::Reads(of) | Use::Writes(of) => of.bytes() as u8,
        };
        let reference = if is_reference { REFERENCE } else { 0 };
        [row.shape.storage().0 | len << 4 | reference, rule]
    }

    /// What must be allowed at the address, as in [`Access::traits`].
    const fn wanted(self) -> u8 {
        match self.used() {
            Use::Is => 0,
            Use::Reads(Type::Bit) => Access::READ | Access::BITS,
            Use::Reads(_) => Access::READ | Access::VALUES,
            Use::Writes(Type::Bit) => Access::WRITE | Access::BITS,
            Use::Writes(_) => Access::WRITE | Access::VALUES,
        }
    }

    /// The constants that can be in a reference.
    const fn constants(self) -> u8 {
        match (self.written(), self.value_type()) {
            (Written::Value, Some(Type::Text)) => TEXT,
            (Written::Value, _) => CONSTANT,
            _ => 0,
        }
    }
}
