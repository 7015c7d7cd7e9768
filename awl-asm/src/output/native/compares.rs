//! Comparisons of words and bytes, combined with the stack like contacts.

use plc_isa::{Operand, Relation};

use super::avr::{Condition, Constant, Reg, Two};
use super::bits::Combine;
use super::emitter::{Emitter, TEMP, Word};
use super::translate::Translator;

/// What is known of a comparison.
enum Outcome {
    /// Its result.
    Known(bool),
    /// The flags are set: it holds under this condition.
    Flags(Condition),
    /// It holds when this bit of a register has this value.
    Bit(Reg, u8, bool),
}

/// A comparison of something with a constant, in the form that needs only one comparison of the
/// machine.
enum WithConstant<T> {
    Known(bool),
    Equal(T),
    NotEqual(T),
    Less(T),
    GreaterOrEqual(T),
}

fn with_constant<T: Ord + Copy>(
    relation: Relation,
    value: T,
    (least, most): (T, T),
    next: T,
) -> WithConstant<T> {
    match relation {
        Relation::Equal => WithConstant::Equal(value),
        Relation::NotEqual => WithConstant::NotEqual(value),
        Relation::Less if value == least => WithConstant::Known(false),
        Relation::Less => WithConstant::Less(value),
        Relation::GreaterOrEqual if value == least => WithConstant::Known(true),
        Relation::GreaterOrEqual => WithConstant::GreaterOrEqual(value),
        Relation::Greater if value == most => WithConstant::Known(false),
        Relation::Greater => WithConstant::GreaterOrEqual(next),
        Relation::LessOrEqual if value == most => WithConstant::Known(true),
        Relation::LessOrEqual => WithConstant::Less(next),
    }
}

/// The relation with its sides exchanged.
fn mirrored(relation: Relation) -> Relation {
    match relation {
        Relation::Less => Relation::Greater,
        Relation::Greater => Relation::Less,
        Relation::LessOrEqual => Relation::GreaterOrEqual,
        Relation::GreaterOrEqual => Relation::LessOrEqual,
        same => same,
    }
}

impl Translator<'_> {
    pub(super) fn compare_words(
        &mut self,
        combine: Combine,
        relation: Relation,
        a: Operand,
        b: Operand,
    ) {
        self.prepare(combine);
        let outcome = self.emitter.words(relation, a, b);
        self.use_outcome(combine, outcome);
    }

    pub(super) fn compare_bytes(
        &mut self,
        combine: Combine,
        relation: Relation,
        a: Operand,
        b: Operand,
    ) {
        self.prepare(combine);
        let outcome = self.emitter.bytes(relation, a, b);
        self.use_outcome(combine, outcome);
    }

    fn prepare(&mut self, combine: Combine) {
        if combine == Combine::Load {
            self.push();
        }
    }

    fn use_outcome(&mut self, combine: Combine, outcome: Outcome) {
        match (outcome, combine) {
            (Outcome::Known(value), Combine::Load) => self.emitter.set_top(value),
            (Outcome::Known(value), _) => self.constant_value(combine, value),
            (Outcome::Bit(register, bit, wanted), _) => {
                self.register_bit(combine, (register, bit), wanted)
            }
            (Outcome::Flags(condition), Combine::Load) => {
                self.emitter.set_top(false);
                self.emitter.set_top_unless(condition.inverted(), true);
            }
            (Outcome::Flags(condition), Combine::And) => {
                self.emitter.set_top_unless(condition, false)
            }
            (Outcome::Flags(condition), Combine::Or) => {
                self.emitter.set_top_unless(condition.inverted(), true)
            }
        }
    }
}

impl Emitter<'_> {
    /// T := value, unless the flags are so.
    fn set_top_unless(&mut self, condition: Condition, value: bool) {
        let end = self.code.label();
        self.code.branch(condition, end);
        self.set_top(value);
        self.code.bind(end);
    }

    fn words(&mut self, relation: Relation, a: Operand, b: Operand) -> Outcome {
        match (a, b) {
            (Operand::Constant(a), Operand::Constant(b)) => {
                Outcome::Known(relation.holds(a as i16, b as i16))
            }
            (Operand::Constant(a), Operand::Memory(b)) => {
                self.word_constant(mirrored(relation), b, a as i16)
            }
            (Operand::Memory(a), Operand::Constant(b)) => self.word_constant(relation, a, b as i16),
            (Operand::Memory(a), Operand::Memory(b)) if a == b => {
                Outcome::Known(relation.holds(0, 0))
            }
            (Operand::Memory(a), Operand::Memory(b)) => {
                let (a, b) = (self.word(a, false), self.word(b, false));
                self.ordered(relation, (a, b), |emitter, (a, b)| {
                    emitter.compare(a, b);
                    (Condition::LESS, Condition::GREATER_OR_EQUAL)
                })
            }
            _ => Outcome::Known(false),
        }
    }

    fn bytes(&mut self, relation: Relation, a: Operand, b: Operand) -> Outcome {
        match (a, b) {
            (Operand::Constant(a), Operand::Constant(b)) => {
                Outcome::Known(relation.holds(a as u8, b as u8))
            }
            (Operand::Constant(a), Operand::Memory(b)) => {
                self.byte_constant(mirrored(relation), b, a as u8)
            }
            (Operand::Memory(a), Operand::Constant(b)) => self.byte_constant(relation, a, b as u8),
            (Operand::Memory(a), Operand::Memory(b)) if a == b => {
                Outcome::Known(relation.holds(0, 0))
            }
            (Operand::Memory(a), Operand::Memory(b)) => {
                let (a, b) = (self.byte(a), self.byte(b));
                self.ordered(relation, (a, b), |emitter, (a, b)| {
                    emitter.two(Two::Cp, a, b);
                    (Condition::LOWER, Condition::SAME_OR_HIGHER)
                })
            }
            _ => Outcome::Known(false),
        }
    }

    /// Compares two values: `compare` sets the flags and says which mean less, and greater or
    /// equal.
    fn ordered<T>(
        &mut self,
        relation: Relation,
        (a, b): (T, T),
        compare: impl Fn(&mut Self, (T, T)) -> (Condition, Condition),
    ) -> Outcome {
        let swapped = matches!(relation, Relation::Greater | Relation::LessOrEqual);
        let (less, greater_or_equal) = compare(self, if swapped { (b, a) } else { (a, b) });
        Outcome::Flags(match relation {
            Relation::Equal => Condition::EQUAL,
            Relation::NotEqual => Condition::NOT_EQUAL,
            Relation::Less | Relation::Greater => less,
            Relation::LessOrEqual | Relation::GreaterOrEqual => greater_or_equal,
        })
    }

    fn word_constant(&mut self, relation: Relation, address: u16, value: i16) -> Outcome {
        let (value, condition) =
            match with_constant(relation, value, (i16::MIN, i16::MAX), value.wrapping_add(1)) {
                WithConstant::Known(known) => return Outcome::Known(known),
                WithConstant::Less(0) => return Outcome::Bit(self.byte(address), 7, true),
                WithConstant::GreaterOrEqual(0) => {
                    return Outcome::Bit(self.byte(address), 7, false);
                }
                WithConstant::Equal(value) => (value, Condition::EQUAL),
                WithConstant::NotEqual(value) => (value, Condition::NOT_EQUAL),
                WithConstant::Less(value) => (value, Condition::LESS),
                WithConstant::GreaterOrEqual(value) => (value, Condition::GREATER_OR_EQUAL),
            };
        let Word { high, low } = self.word(address, true);
        let [high_value, low_value] = value.to_be_bytes();
        self.compare_constant(low, low_value);
        // Loading a constant leaves the flags as they are.
        let high_value = self.value_in(high_value, TEMP);
        self.two(Two::Cpc, high, high_value);
        Outcome::Flags(condition)
    }

    fn byte_constant(&mut self, relation: Relation, address: u16, value: u8) -> Outcome {
        let (value, condition) =
            match with_constant(relation, value, (u8::MIN, u8::MAX), value.wrapping_add(1)) {
                WithConstant::Known(known) => return Outcome::Known(known),
                WithConstant::Less(128) => return Outcome::Bit(self.byte(address), 7, false),
                WithConstant::GreaterOrEqual(128) => {
                    return Outcome::Bit(self.byte(address), 7, true);
                }
                WithConstant::Equal(value) => (value, Condition::EQUAL),
                WithConstant::NotEqual(value) => (value, Condition::NOT_EQUAL),
                WithConstant::Less(value) => (value, Condition::LOWER),
                WithConstant::GreaterOrEqual(value) => (value, Condition::SAME_OR_HIGHER),
            };
        let register = self.byte_for(address, true);
        self.compare_constant(register, value);
        Outcome::Flags(condition)
    }

    fn compare_constant(&mut self, register: Reg, value: u8) {
        if value == 0 || !register.takes_constants() {
            let value = self.value_in(value, TEMP);
            self.two(Two::Cp, register, value);
        } else {
            self.constant(Constant::Cpi, register, value);
        }
    }
}
