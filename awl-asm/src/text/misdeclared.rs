//! Declarations and settings that are written otherwise: several names in one, the type before the
//! name, a name with blanks, words of other languages. What is right is read elsewhere.

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Span, Symbol, Value};
use crate::text::directive_table::WORDS;
use crate::text::literal;
use crate::text::piece::{Piece, Targets, unknown};
use crate::text::symbols::check_name;
use crate::text::variables::is_type;

/// `INT Speed`: the type before the name. The name is kept.
pub(crate) fn type_first(
    word: Piece<'_>,
    values: Piece<'_>,
    targets: &mut Targets<'_>,
) -> Option<Box<Diagnostic>> {
    let (kind, rest) = values.first_word();
    let (name, behind) = rest.first_word();
    let is_kind = is_type(kind, targets.suggester);
    let name = name.split(name.text.find([':', '=', ';']).unwrap_or(name.text.len())).0;
    let is_name = check_name(name.text, name.span()).is_ok()
        && name.text.chars().all(|c| c.is_alphanumeric() || c == '_')
        && !is_type(name, targets.suggester);
    if !is_kind || !is_name || name.text.eq_ignore_ascii_case("RETAIN") || !behind.text.is_empty() {
        return None;
    }
    keep(name.text, name.span(), targets);
    let (name, kind) = (name.text, kind.text.to_uppercase());
    Some(Box::new(
        wrong(values, "the name is before the type")
            .help(format!("`//# {} {name} {kind}`", word.text)),
    ))
}

/// Takes a name that has no meaning, so that its uses are not called unknown.
pub(crate) fn keep(name: &str, span: Span, targets: &mut Targets<'_>) {
    let symbol = Symbol { name: name.to_owned(), value: Value::Invalid, comment: String::new() };
    targets.diagnostics.extend(targets.symbols.define(symbol, Some(span)));
}

/// `A INT, B INT`: several declarations in one.
pub(crate) fn several_declarations(
    word: Piece<'_>,
    values: Piece<'_>,
    targets: &mut Targets<'_>,
) -> Option<Box<Diagnostic>> {
    if values.text.contains(['[', '"', '(']) || !values.text.contains(',') {
        return None;
    }
    let mut names = Vec::new();
    for part in values.text.split(',') {
        let words: Vec<&str> =
            part.split([' ', '\t', ':', ';']).filter(|one| !one.is_empty()).collect();
        let [name, kind] = words.as_slice() else { return None };
        let piece = Piece { text: kind, start: values.start };
        if !is_type(piece, targets.suggester) || check_name(name, word.span()).is_err() {
            return None;
        }
        names.push((*name, format!("`//# var {name} {}`", kind.to_uppercase())));
    }
    let lines: Vec<&str> = names.iter().map(|(_, line)| line.as_str()).collect();
    let help = format!("each is on a line of its own: {}", lines.join(", "));
    for (name, _) in &names {
        keep(name, values.span(), targets);
    }
    Some(Box::new(wrong(values, "one name is in a declaration").help(help)))
}

/// `A, B INT` and `Motor Speed INT`: more names than one, or a name with blanks. They are kept, so
/// that their uses are not called unknown.
pub(crate) fn several_names(
    word: Piece<'_>,
    values: Piece<'_>,
    targets: &mut Targets<'_>,
) -> Option<Box<Diagnostic>> {
    let declaration = values.text.split(":=").next()?;
    let is_list = declaration.split(['[', '(', '"']).next()?.contains(',');
    let parts: Vec<&str> = declaration.split([',', ' ', '\t', ':']).map(str::trim).collect();
    let words: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    let (kind, names) = match words.as_slice() {
        [names @ .., kind] if names.len() > 1 => (*kind, names),
        _ => return None,
    };
    let is_name = |name: &&str| {
        check_name(name, word.span()).is_ok()
            && name.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    let is_kind = is_type(Piece { text: kind, start: values.start }, targets.suggester);
    let is_variable = word.text.eq_ignore_ascii_case("var");
    if !is_variable || !is_kind || !names.iter().all(is_name) {
        return None;
    }
    // `INT Speed` has the type first, and `Speed RETAIN INT` a word of its own.
    let is_other = |name: &str| {
        let piece = Piece { text: name, start: values.start };
        is_type(piece, targets.suggester)
            || ["AT", "RETAIN", "OF", "ARRAY"].iter().any(|word| word.eq_ignore_ascii_case(name))
    };
    if names.iter().any(|name| is_other(name)) {
        return None;
    }
    let long = names.join(" ");
    let kept: Vec<&str> = if is_list { names.to_vec() } else { vec![long.as_str()] };
    for name in &kept {
        keep(name, values.span(), targets);
    }
    let piece = Piece { text: declaration.trim_end(), start: values.start };
    Some(match is_list {
        true => {
            let lines: Vec<String> =
                names.iter().map(|name| format!("`//# var {name} {kind}`")).collect();
            Box::new(wrong(piece, "one name is in a declaration").help(lines.join(", ")))
        }
        false => {
            let one = names.concat();
            let joined = names.join("_");
            Box::new(wrong(piece, "a name has no blank").help(format!(
                "`//# var {joined} {kind}`, or `{one}` in one word, or in quotes `//# var \
                 \"{long}\" {kind}`"
            )))
        }
    })
}

/// A word that is no setting. What it was meant to declare is kept.
pub(crate) fn other_setting(
    word: Piece<'_>,
    values: Piece<'_>,
    targets: &mut Targets<'_>,
) -> Box<Diagnostic> {
    const OTHER: [(&[&str], &str); 3] = [
        (&["variable", "variables", "declare", "dim", "let", "ram"], "var"),
        (&["sym", "tag", "alias", "define", "const", "constant", "input", "output"], "symbol"),
        (&["zeit", "zeitglied"], "timer"),
    ];
    let mut diagnostic = unknown(word, "no such setting", &WORDS, targets.suggester);
    let is = |other: &&str| other.eq_ignore_ascii_case(word.text);
    let other = OTHER.iter().find(|(words, _)| words.iter().any(is));
    if let Some((_, setting)) = other {
        diagnostic.suggestion = Some((*setting).to_owned());
    }
    let declares = ["var", "symbol", "timer", "counter"];
    let (name, _) = values.first_word();
    let bare = name.text.trim_matches('"');
    if diagnostic.suggestion.as_deref().is_some_and(|meant| declares.contains(&meant))
        && check_name(bare, name.span()).is_ok()
    {
        keep(bare, name.span(), targets);
    }
    diagnostic
}

/// A name of several words without quotes, and the address after it: `Motor on Q0.0`.
pub(crate) fn name_of_words(rest: Piece<'_>) -> Option<(Piece<'_>, Address)> {
    let bare = rest.without_comment();
    let at = bare.text.rfind(char::is_whitespace)?;
    let (name, value) = bare.split(at);
    let (name, address) = (name.trim(), Address::parse(value.trim().text).ok()?);
    let is_address = |word: &str| Address::parse(word).is_ok();
    let mut words = name.text.split_whitespace();
    let is_plain = |word: &str| {
        !is_address(word)
            && !literal::looks_like_literal(word)
            && word.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-'))
    };
    (words.clone().count() > 1 && words.all(is_plain)).then_some((name, address))
}

/// An address in quotes, without them.
pub(crate) fn quoted_address(text: &str) -> Option<String> {
    let inside = text.trim_matches(['"', '\'']);
    (inside.len() < text.len() && Address::parse(inside).is_ok()).then(|| inside.to_owned())
}

/// `I0.0 I0.1` with the commas between the addresses.
pub(crate) fn with_commas(text: &str) -> Option<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_list = words.len() > 1 && words.iter().all(|word| Address::parse(word).is_ok());
    is_list.then(|| words.join(", "))
}

/// `VB0 to VB31` and `VB0..VB31` as a range is written.
pub(crate) fn range_in_words(text: &str) -> Option<String> {
    let upper = text.to_ascii_uppercase();
    let links = [" TO ", " BIS ", "..", ":"];
    let (first, last) = links.iter().find_map(|link| upper.split_once(link))?;
    let (first, last) = (Address::parse(first.trim()).ok()?, Address::parse(last.trim()).ok()?);
    Some(format!("{first}-{last}"))
}

fn wrong(piece: Piece<'_>, why: &str) -> Diagnostic {
    Diagnostic::new(Code::Variable, piece.span(), format!("{}: {why}", piece.text))
}
