//! Changes of a text: what is put where, and where statements and declarations end in it.

use diagnostics::Span;

/// Replacements that do not overlap, in any order.
#[derive(Debug, Default)]
pub(super) struct Changes(Vec<(Span, String)>);

impl Changes {
    pub(super) fn replace(&mut self, span: Span, text: impl Into<String>) {
        self.0.push((span, text.into()));
    }

    pub(super) fn insert(&mut self, at: u32, text: impl Into<String>) {
        self.replace(Span { start: at, end: at }, text);
    }

    pub(super) fn remove_all(&mut self, spans: Vec<Span>) {
        self.0.extend(spans.into_iter().map(|span| (span, String::new())));
    }

    /// Takes something out, and its line if nothing else is there.
    pub(super) fn remove(&mut self, text: &str, span: Span) {
        let before = text.get(..span.start as usize).unwrap_or_default();
        let after = text.get(span.end as usize..).unwrap_or_default();
        let begin = before.rfind('\n').map_or(0, |at| at + 1);
        let is_alone = before.get(begin..).unwrap_or_default().trim().is_empty();
        let end = after.find('\n').map_or(after.len(), |at| at + 1);
        let rest = after.get(..end).unwrap_or_default().trim();
        let whole = Span { start: begin as u32, end: span.end + end as u32 };
        match is_alone && (rest.is_empty() || rest.starts_with("//")) {
            true => self.replace(whole, ""),
            false => self.replace(span, ""),
        }
    }

    /// Takes something out that is before something else, with the blanks between them.
    pub(super) fn remove_before(&mut self, text: &str, span: Span) {
        let after = text.get(span.end as usize..).unwrap_or_default();
        let blanks = after.len() - after.trim_start().len();
        self.replace(Span { start: span.start, end: span.end + blanks as u32 }, "");
    }

    /// The text with all of them.
    pub(super) fn carry_out(mut self, text: &str) -> String {
        self.0.sort_by_key(|(span, _)| (span.start, span.end));
        let mut changed = String::with_capacity(text.len() + 64);
        let mut done = 0;
        for (span, new) in self.0 {
            changed.push_str(text.get(done..span.start as usize).unwrap_or_default());
            changed.push_str(&new);
            done = span.end as usize;
        }
        changed.push_str(text.get(done..).unwrap_or_default());
        changed
    }
}

/// What is taken out of a list with commas, so that they are between those that are left: of each
/// item where it is, and whether it goes.
pub(super) fn taken_out(items: &[(Span, bool)]) -> Vec<Span> {
    let mut has_left = false;
    let mut end_before = 0;
    let mut found = Vec::new();
    for (at, (span, goes)) in items.iter().enumerate() {
        let next = items.get(at + 1).map_or(span.end, |(next, _)| next.start);
        match (goes, has_left) {
            (false, _) => has_left = true,
            (true, true) => found.push(Span { start: end_before, end: span.end }),
            (true, false) => found.push(Span { start: span.start, end: next }),
        }
        end_before = span.end;
    }
    found
}

/// Where something begins with the pragmas that are before it.
pub(super) fn begin(text: &str, start: u32) -> u32 {
    let mut from = start as usize;
    loop {
        let before = text.get(..from).unwrap_or_default().trim_end();
        match before.rfind('{').filter(|_| before.ends_with('}')) {
            Some(open) => from = open,
            None => return from as u32,
        }
    }
}

/// After the semicolon that ends a statement or a declaration.
pub(super) fn end(text: &str, end: u32) -> u32 {
    let rest = text.get(end as usize..).unwrap_or_default();
    let blanks = rest.len() - rest.trim_start().len();
    match rest.trim_start().starts_with(';') {
        true => end + blanks as u32 + 1,
        false => end,
    }
}

/// A statement from its pragmas to its semicolon.
pub(super) fn statement(text: &str, Span { start, end: last }: Span) -> Span {
    Span { start: begin(text, start), end: end(text, last) }
}

/// Puts something into a line of its own after what ends at `end`, indented as that; in the same
/// line where more is in it.
pub(super) fn insert_after(changes: &mut Changes, text: &str, at: Span, new: &str) {
    let end = end(text, at.end) as usize;
    let line = text.get(end..).unwrap_or_default().lines().next().unwrap_or_default();
    let is_last = line.trim().is_empty() || line.trim_start().starts_with("//");
    if !is_last {
        return changes.insert(end as u32, format!(" {new}"));
    }
    let before = text.get(..at.start as usize).unwrap_or_default();
    let begin = before.rfind('\n').map_or(0, |at| at + 1);
    let line_begin = before.get(begin..).unwrap_or_default();
    let blanks = line_begin.len() - line_begin.trim_start().len();
    let indent = line_begin.get(..blanks).unwrap_or_default();
    let line = line.trim_end_matches('\r');
    changes.insert((end + line.len()) as u32, format!("\n{indent}{new}"));
}
