//! The comment after a statement or a declaration, in the same line.

use diagnostics::Span;

/// Where its words are, after what ends at `end` and its semicolon; empty where there is none.
pub(crate) fn after(text: &str, end: u32) -> Span {
    let rest = text.get(end as usize..).and_then(|rest| rest.lines().next()).unwrap_or_default();
    let words = rest.trim_start().trim_start_matches(';').trim_start().strip_prefix("//");
    let words = words.map(str::trim).unwrap_or_default();
    let start = end + rest.rfind(words).filter(|_| !words.is_empty()).unwrap_or_default() as u32;
    Span { start, end: start + words.len() as u32 }
}
