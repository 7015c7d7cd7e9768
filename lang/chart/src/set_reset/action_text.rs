//! What the texts of actions say: a name, a value, `S V`, `R V`.

use st::names::is_name;

/// What a text of an action says.
pub(crate) enum Does<'a> {
    /// A name: it is on, starts or counts.
    Name(&'a str),
    /// `V := value`
    Value(&'a str, &'a str),
    /// `S V`
    Set(&'a str),
    /// `R V`
    Reset(&'a str),
}

/// What it says; `None`: nothing of this.
pub(crate) fn does(text: &str) -> Option<Does<'_>> {
    if let Some((variable, value)) = text.split_once(":=") {
        let (variable, value) = (variable.trim(), value.trim().trim_end_matches(';').trim());
        return (is_name(variable) && !value.is_empty()).then_some(Does::Value(variable, value));
    }
    let mut words = text.split_whitespace();
    match (words.next(), words.next(), words.next()) {
        (Some(name), None, _) if is_name(name) => Some(Does::Name(name)),
        (Some(word), Some(name), None) if is_name(name) => match word {
            "S" | "s" => Some(Does::Set(name)),
            "R" | "r" => Some(Does::Reset(name)),
            _ => None,
        },
        _ => None,
    }
}

/// The words of a text of ST that are not part of a literal or after a point.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    pieces(text).into_iter().filter(|(is_word, _)| *is_word).map(|(_, word)| word)
}

/// A text of ST in pieces: words that can be names of variables, and what is between them.
pub(crate) fn pieces(text: &str) -> Vec<(bool, &str)> {
    let is_inside = |c: char| c.is_alphanumeric() || matches!(c, '_' | '#' | '.' | '%');
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = match is_inside(first) {
            true => rest.find(|c| !is_inside(c)).unwrap_or(rest.len()),
            false => rest.find(is_inside).unwrap_or(rest.len()),
        };
        let (piece, after) = rest.split_at(end);
        let (name, member) = piece.split_at(piece.find('.').unwrap_or(piece.len()));
        let is_word = is_name(name) && !piece.contains('#') && !after.trim_start().starts_with('(');
        pieces.push((is_word, if is_word { name } else { piece }));
        if is_word && !member.is_empty() {
            pieces.push((false, member));
        }
        rest = after;
    }
    pieces
}
