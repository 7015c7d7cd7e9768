//! Comparisons of numbers. Bytes are compared without sign, words and double words with one: types
//! that are ordered otherwise take a comparison more.

use super::logic::Logic;
use super::writer::Storage;
use crate::model::Type;

/// Whether the order of a type is not that of the instruction that compares it.
fn is_ordered_otherwise(kind: &Type) -> bool {
    matches!(kind, Type::Sint | Type::Word | Type::Uint | Type::Dword | Type::Udint)
}

/// A relation of two operands of a type, stored in this way; `known`: the value of the second one.
pub(super) fn relation(
    (kind, storage): (&Type, Storage),
    relation: &'static str,
    left: &str,
    right: &str,
    known: Option<i64>,
) -> Logic {
    let letter = storage.letter();
    let plain = Logic::Compare(letter, relation, left.to_owned(), right.to_owned());
    if !is_ordered_otherwise(kind) || matches!(relation, "=" | "<>") {
        return plain;
    }
    // The lower half of the type are the upper ones for the instruction: from here on.
    let half = if *kind == Type::Sint { "128" } else { "0" };
    let half_of = |operand: &str, is_low: bool| {
        let relation = if is_low { ">=" } else { "<" };
        Logic::Compare(letter, relation, operand.to_owned(), half.to_owned())
    };
    let is_less = relation.starts_with('<');
    let left_is_outer = half_of(left, is_less);
    if let Some(value) = known {
        let middle = kind.range().map_or(0, |(low, high)| low + (high - low) / 2 + 1);
        return match (value < middle) == is_less {
            true => Logic::All(vec![left_is_outer, plain]),
            false => Logic::Any(vec![left_is_outer, plain]),
        };
    }
    let right_is_outer = half_of(right, !is_less);
    let either = Logic::Any(vec![left_is_outer.clone(), right_is_outer.clone()]);
    Logic::Any(vec![
        Logic::All(vec![left_is_outer, right_is_outer]),
        Logic::All(vec![either, plain]),
    ])
}
