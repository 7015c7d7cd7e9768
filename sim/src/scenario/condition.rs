//! Conditions: comparisons of operands with values, joined by `and` and `or`. How they are written
//! in a scenario is the parser's business, where the values come from that of whoever asks.

use std::fmt;
use std::ops::RangeInclusive;

use crate::operand::{Operand, Width, real_of};

pub use plc_isa::Relation;

/// Whether a relation asks for an order: then it takes one value and no range.
pub fn is_order(relation: Relation) -> bool {
    !matches!(relation, Relation::Equal | Relation::NotEqual)
}

/// Whether a value is related so to a range: equal is what is inside it.
pub(crate) fn is_related<T: PartialOrd>(relation: Relation, value: T, low: T, high: T) -> bool {
    match relation {
        Relation::Equal => (low..=high).contains(&value),
        Relation::NotEqual => !(low..=high).contains(&value),
        Relation::Less => value < low,
        Relation::LessOrEqual => value <= high,
        Relation::Greater => value > high,
        Relation::GreaterOrEqual => value >= low,
    }
}

/// The relation that a sign of another language means: `==`, `!=`, `=>`.
pub(crate) fn foreign_relation(sign: &str) -> Option<Relation> {
    Some(match sign {
        "==" | "===" | ":=" => Relation::Equal,
        "!=" | "!==" | "=/=" | "><" => Relation::NotEqual,
        "=>" => Relation::GreaterOrEqual,
        "=<" => Relation::LessOrEqual,
        _ => return None,
    })
}

/// An operand beside the values that it is compared with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// Which operand.
    pub operand: Operand,
    /// The operand as written.
    pub name: String,
    /// How.
    pub relation: Relation,
    /// With what, words signed; of a real the bits of the least and the greatest.
    pub values: RangeInclusive<i32>,
}

impl Comparison {
    /// Whether it is true of a value of the operand.
    pub fn holds(&self, value: i32) -> bool {
        let (low, high) = (*self.values.start(), *self.values.end());
        match self.operand.width() {
            Width::Real => is_related(self.relation, real_of(value), real_of(low), real_of(high)),
            _ => is_related(self.relation, value, low, high),
        }
    }

    /// The only value that it is true of.
    pub fn only_value(&self) -> Option<String> {
        let (low, high) = (*self.values.start(), *self.values.end());
        (self.relation == Relation::Equal && low == high).then(|| self.operand.text(low))
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = (*self.values.start(), *self.values.end());
        write!(f, "{} {} {}", self.name, self.relation.symbol(), self.operand.text(low))?;
        if low == high { Ok(()) } else { write!(f, "..{}", self.operand.text(high)) }
    }
}

/// What must be true: of one of these lists, every comparison. `and` binds more closely than `or`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition(pub Vec<Vec<Comparison>>);

impl Condition {
    /// Every comparison in it, in the order of the text.
    pub fn comparisons(&self) -> impl Iterator<Item = &Comparison> {
        self.0.iter().flatten()
    }

    /// Whether it is true of the values that operands have. Asks for no more of them than it needs.
    pub fn holds<E>(&self, value: &mut impl FnMut(Operand) -> Result<i32, E>) -> Result<bool, E> {
        for all in &self.0 {
            let mut is_true = true;
            for comparison in all {
                is_true = is_true && comparison.holds(value(comparison.operand)?);
            }
            if is_true {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let join = |all: &Vec<Comparison>| {
            all.iter().map(Comparison::to_string).collect::<Vec<_>>().join(" and ")
        };
        f.write_str(&self.0.iter().map(join).collect::<Vec<_>>().join(" or "))
    }
}
