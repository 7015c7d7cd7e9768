//! Literals: what their characters mean as values.

use awl_asm::escapes;
use diagnostics::Span;

use super::Parser;
use crate::diagnostic::{Code, Diagnostic};
use crate::durations::duration;
use crate::model::LITERAL_MAX;
use crate::tree::{Expression, ExpressionKind, Name};

impl Parser<'_> {
    pub(super) fn integer(&mut self, span: Span) -> ExpressionKind {
        match number(span.text(self.text), 10) {
            Some(value) => ExpressionKind::Integer(value),
            None => self.bad_literal(span, "is no whole number that a type here has"),
        }
    }

    pub(super) fn real(&mut self, span: Span) -> ExpressionKind {
        let digits = span.text(self.text).replace('_', "");
        match digits.parse::<f32>() {
            Ok(value) if value.is_finite() => ExpressionKind::Real(value),
            _ => self.bad_literal(span, "is no number that a REAL has"),
        }
    }

    /// A text in single quotes, with what `$` begins in it.
    pub(super) fn text(&mut self, span: Span) -> ExpressionKind {
        let text = span.text(self.text);
        let inside = text.strip_prefix('\'').and_then(|rest| rest.strip_suffix('\''));
        if text.starts_with('\'') && (inside.is_none() || text.len() < 2) {
            return ExpressionKind::Missing;
        }
        let Some(inside) = inside else {
            let meant = format!("'{}'", text.trim_matches('"'));
            let message = "a text is in single quotes";
            self.report(Diagnostic::new(Code::Syntax, span, message).suggest(meant));
            return ExpressionKind::Missing;
        };
        match escapes::read(inside) {
            Ok(text) if text.len() <= LITERAL_MAX => ExpressionKind::Text(text),
            Ok(text) => {
                let message =
                    format!("{} characters: a text has {LITERAL_MAX} at most", text.len());
                let found = Diagnostic::new(Code::BadConstant, span, message);
                self.report(found.help("CONCAT joins two"));
                ExpressionKind::Missing
            }
            Err(why) => self.bad_literal(span, &format!("is no text: {why}")),
        }
    }

    fn bad_literal(&mut self, span: Span, why: &str) -> ExpressionKind {
        let message = format!("{} {why}", super::short(span.text(self.text)));
        self.report(Diagnostic::new(Code::Syntax, span, message));
        ExpressionKind::Missing
    }

    /// `16#FF`, `INT#5`, `DINT#16#FF`, `T#1s`, `State#Fill`.
    pub(super) fn prefixed(&mut self, span: Span) -> ExpressionKind {
        let text = span.text(self.text);
        let Some((prefix, rest)) = text.split_once('#') else { return ExpressionKind::Missing };
        if let Ok(base) = prefix.parse::<u32>() {
            return match Some(base).filter(|base| [2, 8, 10, 16].contains(base)) {
                Some(base) => match number(rest, base) {
                    Some(value) => ExpressionKind::Integer(value),
                    None => self.bad_literal(span, "has digits that its base does not have"),
                },
                None => self.bad_literal(span, "has no base: there are 2#, 8#, 10# and 16#"),
            };
        }
        let kind = prefix.to_ascii_uppercase();
        let after = span.start as usize + prefix.len() + 1;
        let value_span = Span::new(after, span.end as usize);
        match kind.as_str() {
            "S5T" | "S5TIME" => {
                let meant = format!("T#{rest}");
                let message = format!("{text}: a duration begins with `T#`");
                self.report(Diagnostic::new(Code::Syntax, span, message).suggest(meant));
                ExpressionKind::Missing
            }
            "T" | "TIME" => match duration(rest) {
                Some(ms) => ExpressionKind::Duration(ms),
                None => self.bad_literal(span, "is no duration: write T#1m30s, T#1.5s or T#200ms"),
            },
            "BOOL" => match rest.to_ascii_uppercase().as_str() {
                "1" | "TRUE" => ExpressionKind::Bool(true),
                "0" | "FALSE" => ExpressionKind::Bool(false),
                _ => self.bad_literal(span, "is no BOOL: TRUE, FALSE, 1 or 0"),
            },
            _ if rest.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                let name = Name { text: rest.to_owned(), span: value_span };
                ExpressionKind::Member(prefix.to_owned(), name)
            }
            _ => self.typed(prefix, rest, span, value_span),
        }
    }

    fn typed(&mut self, prefix: &str, rest: &str, span: Span, value_span: Span) -> ExpressionKind {
        let (sign, digits) = match rest.strip_prefix('-') {
            Some(digits) => (-1, digits),
            None => (1, rest.strip_prefix('+').unwrap_or(rest)),
        };
        let value = match digits.split_once('#') {
            Some((base, digits)) => {
                let base = base.parse().ok().filter(|base| [2, 8, 10, 16].contains(base));
                base.and_then(|base| number(digits, base))
            }
            None => number(digits, 10),
        };
        let real = || digits.replace('_', "").parse::<f32>().ok().filter(|real| real.is_finite());
        let kind = match (value, real()) {
            (Some(value), _) => ExpressionKind::Integer(sign * value),
            (None, Some(real)) => ExpressionKind::Real(sign as f32 * real),
            (None, None) => return self.bad_literal(span, "is no number"),
        };
        ExpressionKind::Typed(prefix.to_owned(), Box::new(Expression { kind, span: value_span }))
    }
}

/// Digits of a base with `_` between them; 0 to 2^32 - 1.
fn number(text: &str, base: u32) -> Option<i64> {
    let is_sound = !text.starts_with('_') && !text.ends_with('_') && !text.contains("__");
    let digits = text.replace('_', "");
    let is_plain = digits.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let value = i64::from_str_radix(&digits, base).ok().filter(|_| is_sound && is_plain)?;
    (value <= i64::from(u32::MAX)).then_some(value)
}
