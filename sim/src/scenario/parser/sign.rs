//! Finds the sign of a comparison. What stands on its sides is not known here.

use super::super::condition::{Relation, foreign_relation};
use crate::piece::Piece;

/// The places of the sign of a comparison and of what is behind it. A name may have other signs in
/// it than `=`.
pub(super) fn sign(piece: Piece<'_>) -> Option<(Relation, usize, usize)> {
    let place = |wanted: &[char]| piece.unquoted().find(|(_, c)| wanted.contains(c));
    let (mut at, _) = place(&['=']).or_else(|| place(&['<', '>']))?;
    if piece.text[at..].starts_with('=') && piece.text[..at].ends_with(['<', '>']) {
        at -= 1;
    }
    // The longest sign that fits.
    let fits = Relation::ALL.into_iter().filter(|sign| piece.text[at..].starts_with(sign.symbol()));
    let relation = fits.max_by_key(|relation| relation.symbol().len())?;
    Some((relation, at, at + relation.symbol().len()))
}

/// All signs around this place, if another language compares or sets by them, and what they are
/// here.
pub(super) fn foreign_sign(piece: Piece<'_>, at: usize) -> Option<(Piece<'_>, Relation)> {
    let is_sign = |c: char| "=<>!:/".contains(c);
    let begin = piece.text[..at].trim_end_matches(is_sign).len();
    let end = piece.text.len() - piece.text[at..].trim_start_matches(is_sign).len();
    let sign = piece.part(begin..end);
    Some((sign, foreign_relation(sign.text)?))
}
