//! What MATLAB has no place for stands in comments: words, and texts in quotes.

/// A piece of such a comment.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    Word(String),
    Text(String),
}

/// A text in quotes, on one line.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\r' => quoted.push_str("\\r"),
            other => quoted.push(other),
        }
    }
    quoted + "\""
}

/// The end of a line with a comment; nothing where there is nothing to say.
pub(super) fn ending(words: &[String], comment: &str) -> String {
    let mut all = words.to_vec();
    if !comment.is_empty() {
        all.push(quoted(comment));
    }
    if all.is_empty() { String::new() } else { format!(" % {}", all.join(" ")) }
}

/// A line and the pieces of the comment at its end.
pub(super) fn split(line: &str) -> (&str, Vec<Piece>) {
    match outside(line) {
        Some(at) => {
            let (code, comment) = line.split_at(at);
            (code.trim(), pieces(comment.trim_start_matches('%')))
        }
        None => (line.trim(), Vec::new()),
    }
}

/// Where a comment begins, which a text in quotes does not.
fn outside(line: &str) -> Option<usize> {
    let mut is_text = false;
    line.char_indices().find_map(|(at, character)| {
        if character == '\'' {
            is_text = !is_text;
        }
        (character == '%' && !is_text).then_some(at)
    })
}

/// The pieces of a comment.
pub(super) fn pieces(comment: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut characters = comment.chars().peekable();
    while let Some(character) = characters.next() {
        if character.is_whitespace() {
            continue;
        }
        let mut piece = String::new();
        if character != '"' {
            piece.push(character);
            while let Some(next) = characters.next_if(|next| !next.is_whitespace()) {
                piece.push(next);
            }
            pieces.push(Piece::Word(piece));
            continue;
        }
        while let Some(next) = characters.next().filter(|next| *next != '"') {
            piece.push(match next {
                '\\' => match characters.next() {
                    Some('n') => '\n',
                    Some('r') => '\r',
                    Some(other) => other,
                    None => break,
                },
                other => other,
            });
        }
        pieces.push(Piece::Text(piece));
    }
    pieces
}

/// The words of a comment, up to its last text, and this text.
pub(super) fn said(mut pieces: Vec<Piece>) -> (Vec<Piece>, String) {
    match pieces.pop() {
        Some(Piece::Text(text)) => (pieces, text),
        Some(word) => {
            pieces.push(word);
            (pieces, String::new())
        }
        None => (pieces, String::new()),
    }
}

/// The words alone.
pub(super) fn words(pieces: &[Piece]) -> Vec<&str> {
    let words = pieces.iter().filter_map(|piece| match piece {
        Piece::Word(word) => Some(word.as_str()),
        Piece::Text(_) => None,
    });
    words.collect()
}
