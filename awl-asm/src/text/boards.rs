//! Which other board would do, in words. What a board lacks is said elsewhere.

use plc_isa::Profile;

/// The way for a program that a board is not enough for: another one that does.
pub(crate) fn way(board: &Profile, does: impl Fn(&'static Profile) -> bool) -> Option<String> {
    let others = Profile::BOARDS.into_iter().filter(|other| other.number != board.number);
    let other = others.into_iter().find(|other| does(other))?;
    Some(format!("{} would do: `//# board {}`", other.title, other.name))
}
