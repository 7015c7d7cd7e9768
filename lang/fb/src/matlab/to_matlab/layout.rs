//! Writes the text: tokens with what becomes of them, comments, and line breaks, which need `...`
//! in the middle of a statement.

use diagnostics::Span;
use st::lexer::{Kind, cut};

use super::Translator;

/// A construct that is open.
enum Open {
    If,
    Case,
    Loop,
    Repeat,
    /// A loop with its control variable and first value.
    For(String, Span),
}

/// A token or comment.
struct Piece {
    span: Span,
    is_comment: bool,
}

impl Translator<'_> {
    /// A stretch of the text as MATLAB.
    pub(super) fn laid(&mut self, part: Span) -> String {
        let mut out = String::new();
        let mut open = Vec::new();
        let mut end = part.start;
        let pieces = pieces(self.text, part);
        for (at, piece) in pieces.iter().enumerate() {
            let start = piece.span.start;
            if let Some(skipped) = self.skipped.iter().find(|skipped| is_in(piece.span, **skipped))
            {
                if let Some(label) = self.label(piece.span, *skipped) {
                    out.push_str(&self.gap(end, start));
                    out.push_str(label);
                }
                end = piece.span.end;
                continue;
            }
            let gap = self.gap(end, start);
            let is_close = self.close.contains(&start) || self.is_separator(piece.span);
            let is_kept = !is_close || !gap.trim().is_empty();
            out.push_str(if is_kept { &gap } else { "" });
            let next = pieces.get(at + 1).map_or(part.end, |next| next.span.start);
            let follows = self.text.get(piece.span.end as usize..next as usize).unwrap_or("");
            let is_last_of_line = follows.contains('\n') || pieces.get(at + 1).is_none();
            end = piece.span.end;
            if piece.is_comment {
                let is_done = self.comment(piece.span, is_last_of_line, &mut out);
                if is_done && follows.contains('\n') {
                    let after = follows.find('\n').map_or(0, |at| at + 1);
                    end += u32::try_from(after).unwrap_or(0);
                }
                continue;
            }
            let comes = is_last_of_line
                || pieces.get(at + 1).is_some_and(|next| {
                    next.is_comment && !next.span.text(self.text).starts_with("(*")
                });
            self.token(piece.span, comes, &mut open, &mut out);
        }
        out.push_str(self.text.get(end as usize..part.end as usize).unwrap_or(""));
        out
    }

    /// The labels of a CASE, which stand where the first of them was.
    fn label(&self, span: Span, skipped: Span) -> Option<&str> {
        let text = self.before.get(&span.start).filter(|_| span.start == skipped.start)?;
        text.starts_with("case ").then_some(text.as_str())
    }

    /// What is between two pieces.
    fn gap(&self, from: u32, to: u32) -> String {
        let gap = self.text.get(from as usize..to as usize).unwrap_or("");
        if self.is_inside { gap.replace('\n', " ...\n") } else { gap.to_owned() }
    }

    fn is_separator(&self, span: Span) -> bool {
        let word = span.text(self.text);
        ["THEN", "DO", "OF", "END_REPEAT"].iter().any(|one| one.eq_ignore_ascii_case(word))
    }

    /// Writes a comment; returns whether its line is ended with it.
    fn comment(&mut self, span: Span, is_last_of_line: bool, out: &mut String) -> bool {
        let text = span.text(self.text);
        let lines: Vec<&str> = text.split('\n').collect();
        let is_open = self.is_inside || !is_last_of_line;
        if is_open {
            out.push_str(&format!("...{}\n", lines.join(" ")));
            return true;
        }
        let text = text.strip_prefix("//").unwrap_or(text);
        let lines: Vec<String> = text.split('\n').map(|line| format!("%{line}")).collect();
        out.push_str(&lines.join("\n"));
        false
    }

    /// Writes a token. `is_last`: the line ends after it.
    fn token(&mut self, span: Span, is_last: bool, open: &mut Vec<Open>, out: &mut String) {
        let separator = if is_last { "" } else { "," };
        let word = span.text(self.text).to_uppercase();
        self.is_inside = true;
        let mut ends = |this: &mut Self, text: &str| {
            this.is_inside = false;
            out.push_str(text);
            out.push_str(separator);
        };
        match word.as_str() {
            "THEN" | "DO" | "OF" => ends(self, ""),
            "ELSE" if matches!(open.last(), Some(Open::Case)) => ends(self, "otherwise"),
            "ELSE" => ends(self, "else"),
            ":" => ends(self, ""),
            "REPEAT" => {
                open.push(Open::Repeat);
                ends(self, "while true");
            }
            ";" => {
                self.is_inside = false;
                out.push(';');
            }
            "END_IF" | "END_CASE" | "END_WHILE" | "END_FOR" | "END_REPEAT" => {
                self.is_inside = false;
                let text = self.end(open.pop());
                out.push_str(&text);
            }
            _ => {
                if let Some(found) = self.opened(&word, span) {
                    open.push(found);
                }
                self.other(&word, span, out);
            }
        }
    }

    fn opened(&self, word: &str, span: Span) -> Option<Open> {
        Some(match word {
            "IF" => Open::If,
            "CASE" => Open::Case,
            "WHILE" => Open::Loop,
            "FOR" => {
                let (name, from) = self.loops.get(&span.start)?.clone();
                Open::For(name, from)
            }
            _ => return None,
        })
    }

    /// What ends a construct.
    fn end(&mut self, open: Option<Open>) -> String {
        match open {
            Some(Open::Repeat) => ", break; end, end".to_owned(),
            Some(Open::For(name, from)) => {
                let from = self.laid(from);
                self.is_inside = false;
                format!("end, if isempty({name}), {name} = {from}; end")
            }
            _ => "end".to_owned(),
        }
    }

    fn other(&mut self, word: &str, span: Span, out: &mut String) {
        out.push_str(self.before.get(&span.start).map_or("", String::as_str));
        match (self.replaced.get(&span.start), word) {
            (Some(text), _) => out.push_str(&text.clone()),
            (None, "IF" | "UNTIL") => out.push_str("if"),
            (None, "ELSIF") => out.push_str("elseif"),
            (None, "CASE") => out.push_str("switch"),
            (None, "WHILE") => out.push_str("while"),
            (None, "FOR") => out.push_str("for"),
            (None, "EXIT") => out.push_str("break"),
            (None, "CONTINUE") => out.push_str("continue"),
            (None, _) => out.push_str(&span.text(self.text).replace('_', "")),
        }
        if let Some(step) = self.steps.get(&span.start).copied() {
            let skipped = std::mem::take(&mut self.skipped);
            let step = self.laid(step);
            self.skipped = skipped;
            out.push_str(&format!("{step}:"));
        }
        out.push_str(self.after.get(&span.end).map_or("", String::as_str));
    }
}

fn is_in(span: Span, around: Span) -> bool {
    around.start <= span.start && span.end <= around.end
}

fn pieces(text: &str, part: Span) -> Vec<Piece> {
    let cut = cut(text);
    let tokens = cut.tokens.into_iter().filter(|token| token.kind != Kind::End);
    let tokens = tokens.map(|token| Piece { span: token.span, is_comment: false });
    let comments = cut.comments.into_iter().chain(cut.settings).chain(cut.pragmas);
    let comments = comments.map(|span| Piece { span, is_comment: true });
    let mut all: Vec<Piece> =
        tokens.chain(comments).filter(|piece| is_in(piece.span, part)).collect();
    all.sort_by_key(|piece| piece.span);
    all
}
