//! Puts rows on lines: indentation, comments after instructions, line ends. The words are given.

use super::reader::{Kind, Row};

/// Blanks between the longest instruction and the comments beside it.
const COMMENT_GAP: usize = 2;

/// The text of the rows.
pub(super) fn write(rows: &[Row<'_>]) -> String {
    let layout = Layout { line_end: usual_line_end(rows), indentation: usual_indentation(rows) };
    let mut text = String::new();
    let mut rest = rows;
    while let Some(row) = rest.first() {
        let len = rest.iter().enumerate().take_while(|&(index, _)| is_beside(rest, index)).count();
        if len == 0 {
            layout.push_alone(&mut text, row);
        } else {
            layout.push_run(&mut text, rest.get(..len).unwrap_or(&[]));
        }
        rest = rest.get(len.max(1)..).unwrap_or(&[]);
    }
    if !text.is_empty() && !text.ends_with(['\n', '\r']) {
        text.push_str(layout.line_end);
    }
    text
}

/// Whether the comment of a row is in a column with those of the rows before it: one beside
/// code, or one that goes on below such a one.
fn is_beside(rows: &[Row<'_>], index: usize) -> bool {
    let Some(row) = rows.get(index) else { return false };
    let before = index.checked_sub(1).and_then(|before| rows.get(before));
    match row.kind {
        Kind::Instruction | Kind::Declaration | Kind::Data => true,
        Kind::Plain => {
            let goes_on =
                row.code.is_empty() && !row.comment.is_empty() && !row.indentation.is_empty();
            goes_on && before.is_some_and(|before| !before.comment.is_empty())
        }
        Kind::Network | Kind::Fixed => false,
    }
}

/// The line end of the first line that has one.
fn usual_line_end<'s>(rows: &[Row<'s>]) -> &'s str {
    let ends = rows.iter().filter_map(|row| row.line_end);
    ends.into_iter().find(|end| !end.is_empty()).unwrap_or("\n")
}

/// Micro/WIN exports instructions at the beginning of the line; that for the S7-200 SMART exports
/// them after a tab.
fn usual_indentation(rows: &[Row<'_>]) -> &'static str {
    let mut instructions = rows.iter().filter(|row| row.kind == Kind::Instruction).peekable();
    let has_blocks = rows.iter().any(|row| row.kind == Kind::Fixed && row.code.starts_with("END_"));
    let is_tabbed =
        instructions.peek().is_some() && instructions.all(|row| row.indentation == "\t");
    if has_blocks && is_tabbed { "\t" } else { "" }
}

struct Layout<'s> {
    line_end: &'s str,
    indentation: &'static str,
}

impl Layout<'_> {
    fn end(&self, text: &mut String, row: &Row<'_>) {
        text.push_str(row.line_end.unwrap_or(self.line_end));
    }

    /// A row whose comment has no column.
    fn push_alone(&self, text: &mut String, row: &Row<'_>) {
        text.push_str(&row.code);
        if row.kind == Kind::Network {
            push_title(text, row.comment);
        } else {
            let is_unchanged = row.code == row.source_code;
            match row.code.is_empty() || row.comment.is_empty() {
                true => {}
                false if is_unchanged => text.push_str(row.gap),
                false => text.push(' '),
            }
            text.push_str(row.comment);
        }
        self.end(text, row);
    }

    /// Rows whose comments are below each other. Where no code changes, they stay where they are.
    fn push_run(&self, text: &mut String, rows: &[Row<'_>]) {
        let indentation_of =
            |row: &Row<'_>| if row.kind == Kind::Instruction { self.indentation } else { "" };
        let is_unchanged = |row: &Row<'_>| {
            row.code.is_empty()
                || row.code == row.source_code && indentation_of(row) == row.indentation
        };
        let stays = rows.iter().all(is_unchanged);
        let commented = rows.iter().filter(|row| !row.comment.is_empty());
        let column = COMMENT_GAP + commented.map(|row| row.code.chars().count()).max().unwrap_or(0);
        for row in rows {
            if !row.code.is_empty() {
                text.push_str(indentation_of(row));
            }
            text.push_str(&row.code);
            if row.comment.is_empty() {
                // Micro/WIN may leave blanks after a declaration.
                let is_left = row.kind == Kind::Declaration && is_unchanged(row);
                text.push_str(if is_left { row.gap } else { "" });
            } else {
                match (stays, row.code.is_empty()) {
                    (true, true) => text.push_str(row.indentation),
                    (true, false) => text.push_str(row.gap),
                    (false, _) => {
                        text.extend(std::iter::repeat_n(' ', column - row.code.chars().count()))
                    }
                }
                text.push_str(row.comment);
            }
            self.end(text, row);
        }
    }
}

/// The title of a network, with a blank after the comment signs.
fn push_title(text: &mut String, comment: &str) {
    match comment.strip_prefix("//") {
        Some(title) if title.starts_with(|c: char| !c.is_whitespace() && c != '/') => {
            text.push_str("// ");
            text.push_str(title);
        }
        _ => text.push_str(comment),
    }
}
