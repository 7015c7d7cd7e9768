//! Finds the sign of a comparison. What stands on its sides is not known here.

use super::super::condition::Relation;
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
