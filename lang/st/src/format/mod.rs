//! Texts in canonical layout: a statement a line, four blanks a level, one blank around operators.
//! Only blanks and line breaks change, and keywords get capitals; comments stay where they are. It
//! looks at tokens, and gives nothing back for a text that has errors of form.

mod blocks;

use diagnostics::{Source, Span};

use crate::diagnostic::Diagnostic;
use crate::keywords::is_keyword;
use crate::lexer::{Kind, Token, cut};
use crate::parser::parse;
use blocks::{Blocks, Layout, Start};

/// The text in canonical layout; or its errors of form.
pub fn format(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let (_, errors) = parse(source);
    if !errors.is_empty() {
        return Err(errors);
    }
    let text = &source.text;
    let mut writer = Writer { text, ..Writer::default() };
    let pieces = pieces(text);
    for at in 0..pieces.len() {
        writer.piece(pieces.get(at..).unwrap_or(&[]));
    }
    let mut laid = aligned(&writer.out, &writer.columns);
    while laid.ends_with('\n') {
        laid.pop();
    }
    if !laid.is_empty() {
        laid.push('\n');
    }
    // The line ends of the text stay what they are.
    Ok(if text.contains("\r\n") { laid.replace('\n', "\r\n") } else { laid })
}

/// What says something in a text: its tokens with capitals for keywords, and its comments.
pub fn essence(text: &str) -> Vec<String> {
    let written = |piece: &Piece| match piece {
        Piece::Token(token) => written(token, text),
        Piece::Comment(span) => comment(*span, text),
    };
    pieces(text).iter().map(written).collect()
}

/// Something that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Piece {
    Token(Token),
    Comment(Span),
}

impl Piece {
    fn span(self) -> Span {
        match self {
            Piece::Token(token) => token.span,
            Piece::Comment(span) => span,
        }
    }
}

fn pieces(text: &str) -> Vec<Piece> {
    let cut = cut(text);
    let tokens = cut.tokens.into_iter().filter(|token| token.kind != Kind::End);
    // This pragma is a token.
    let is_token = |span: &Span| span.text(text).starts_with("{every scan}");
    let pragmas = cut.pragmas.iter().copied().filter(|span| !is_token(span));
    let asides = cut.settings.iter().chain(&cut.comments).copied().chain(pragmas);
    let asides = asides.map(Piece::Comment);
    let mut all: Vec<Piece> = tokens.map(Piece::Token).chain(asides).collect();
    all.sort_by_key(|piece| piece.span());
    all
}

fn written(token: &Token, text: &str) -> String {
    let word = token.span.text(text);
    match token.kind {
        Kind::Word if is_keyword(word) => word.to_ascii_uppercase(),
        _ => word.to_owned(),
    }
}

/// A comment without blanks at the ends of its lines.
fn comment(span: Span, text: &str) -> String {
    let lines: Vec<&str> = span.text(text).split('\n').map(str::trim_end).collect();
    lines.join("\n")
}

/// What is laid out so far.
#[derive(Default)]
struct Writer<'t> {
    text: &'t str,
    out: String,
    blocks: Blocks,
    /// Where the last piece ended in the text.
    end: usize,
    before: Option<Piece>,
    /// Line and column of each AT in a declaration.
    columns: Vec<(usize, usize)>,
}

impl Writer<'_> {
    /// Writes the first of the pieces that are left.
    fn piece(&mut self, left: &[Piece]) {
        let Some(&piece) = left.first() else { return };
        let span = piece.span();
        let gap = self.text.get(self.end..span.start as usize).unwrap_or("");
        let breaks = gap.matches('\n').count().max(usize::from(self.is_after_line_comment()));
        match piece {
            Piece::Comment(span) => self.comment(span, breaks, left),
            Piece::Token(token) => self.token(token, breaks, left),
        }
        self.end = span.end as usize;
        self.before = Some(piece);
    }

    fn is_after_line_comment(&self) -> bool {
        let Some(Piece::Comment(span)) = self.before else { return false };
        span.text(self.text).starts_with("//")
    }

    fn comment(&mut self, span: Span, breaks: usize, left: &[Piece]) {
        match breaks {
            // It belongs to what is before it.
            0 if !self.out.is_empty() => self.out.push(' '),
            _ => self.line(breaks, self.blocks.level_of_comment(self.text, &tokens(left))),
        }
        self.out += &comment(span, self.text);
    }

    fn token(&mut self, token: Token, breaks: usize, left: &[Piece]) {
        let layout = self.blocks.take(self.text, &tokens(left));
        let is_closing = matches!(token.kind, Kind::Sign(")" | "]"));
        let Layout { start, level, .. } = layout;
        match start {
            Start::Always => self.line(breaks, level),
            Start::AsWritten if breaks > 0 => self.line(breaks, level),
            Start::Never if breaks > 0 => self.line(1, level + usize::from(!is_closing)),
            _ if self.has_blank(token, layout) => self.out.push(' '),
            _ => {}
        }
        if layout.is_at {
            let start = self.out.rfind('\n').map_or(0, |at| at + 1);
            self.columns.push((self.out.matches('\n').count(), self.out.len() - start));
        }
        self.out += &written(&token, self.text);
    }

    /// Begins a line, after an empty one where the text has one or more.
    fn line(&mut self, breaks: usize, level: usize) {
        if !self.out.is_empty() {
            self.out += if breaks > 1 { "\n\n" } else { "\n" };
        }
        self.out.extend(std::iter::repeat_n("    ", level));
    }

    /// Whether a blank is before a token on the same line.
    fn has_blank(&self, token: Token, layout: Layout) -> bool {
        let Some(Piece::Token(before)) = self.before else { return true };
        let is_name = before.kind == Kind::Word && !is_keyword(before.span.text(self.text));
        match (before.kind, token.kind) {
            (_, Kind::Sign(";" | "," | ")" | "]" | "." | "..")) => false,
            (Kind::Sign("(" | "[" | "." | ".."), _) => false,
            (_, Kind::Sign(":")) => !layout.is_label_colon,
            // `Table[1]`, `ARRAY[1..2]`, `Rows[1][2]`; a list of values is apart.
            (Kind::Word | Kind::Sign("]"), Kind::Sign("[")) => false,
            // `Delay(`, `3(0)` in a list of values; `IF (` and `NOT (` are apart.
            (_, Kind::Sign("(")) => !(is_name || before.kind == Kind::Integer),
            _ => !layout.is_after_sign,
        }
    }
}

fn tokens(pieces: &[Piece]) -> Vec<Token> {
    let token = |piece: &Piece| match piece {
        Piece::Token(token) => Some(*token),
        Piece::Comment(_) => None,
    };
    // No decision needs more of them.
    pieces.iter().filter_map(token).take(AHEAD).collect()
}

/// So many tokens are looked at in advance: a label of CASE is rarely longer.
const AHEAD: usize = 64;

/// The text with the ATs of neighbouring lines below each other.
fn aligned(text: &str, columns: &[(usize, usize)]) -> String {
    let lines: Vec<&str> = text.split('\n').collect();
    let mut laid: Vec<String> = lines.iter().map(|&line| line.to_owned()).collect();
    let mut rest = columns;
    while let Some((first, _)) = rest.first() {
        let is_next = |(number, (line, _)): &(usize, &(usize, usize))| *line == first + number;
        let count = rest.iter().enumerate().take_while(is_next).count();
        let (group, after) = rest.split_at(count);
        rest = after;
        let width = |&(line, column): &(usize, usize)| {
            let before = lines.get(line).and_then(|line| line.get(..column));
            before.map_or(0, |before| before.chars().count())
        };
        let widest = group.iter().map(width).max().unwrap_or(0);
        for place in group {
            if let Some(line) = laid.get_mut(place.0) {
                let blanks = " ".repeat(widest - width(place));
                line.insert_str(place.1, &blanks);
            }
        }
    }
    laid.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNTIDY: &str = "\
//# name x
type State:(Idle,Run:=5);  R : struct a:int;b:BOOL;end_struct; END_TYPE


var_global  Go AT %I0.0:bool;// start
  Lamp at %Q0.0 : BOOL ; Other : INT; END_VAR
function Twice:INT VAR_INPUT x:INT; END_VAR Twice:=x*-2; END_FUNCTION
PROGRAM Main VAR CONSTANT a , b:ARRAY [1..3,0..1]OF INT:=[1,2(0)];(* two *)END_VAR
IF Go and(a[1]>-3)THEN Lamp:=NOT Go;elsif x then;
// nothing
ELSE b := Twice( x:=3 ) + 1; END_IF
case n of 1,-2..4:a:=1;b:=2; (* next *)
Idle: if a THEN b:=1; end_if;
 // last
 State#Run:
   exit;
 else a:=0; END_CASE;
for i:=1 to 10 by -1 do Delay(IN:=Go,
PT:=T#1s, // long
  Q=>Lamp
 ); end_for
repeat a:=a+1; until a>5 end_repeat;
END_PROGRAM";

    const TIDY: &str = "\
//# name x
TYPE
    State : (Idle, Run := 5);
    R : STRUCT
        a : int;
        b : BOOL;
    END_STRUCT;
END_TYPE

VAR_GLOBAL
    Go   AT %I0.0 : bool; // start
    Lamp AT %Q0.0 : BOOL;
    Other : INT;
END_VAR
FUNCTION Twice : INT
VAR_INPUT
    x : INT;
END_VAR
Twice := x * -2;
END_FUNCTION
PROGRAM Main
VAR CONSTANT
    a, b : ARRAY[1..3, 0..1] OF INT := [1, 2(0)]; (* two *)
END_VAR
IF Go AND (a[1] > -3) THEN
    Lamp := NOT Go;
ELSIF x THEN;
    // nothing
ELSE
    b := Twice(x := 3) + 1;
END_IF
CASE n OF
    1, -2..4: a := 1;
        b := 2; (* next *)
    Idle:
        IF a THEN
            b := 1;
        END_IF;
    // last
    State#Run:
        EXIT;
    ELSE
        a := 0;
END_CASE;
FOR i := 1 TO 10 BY -1 DO
    Delay(IN := Go,
        PT := T#1s, // long
        Q => Lamp
    );
END_FOR
REPEAT
    a := a + 1;
UNTIL a > 5
END_REPEAT;
END_PROGRAM
";

    fn laid(text: &str) -> String {
        format(&Source::new("t.st", text).unwrap()).unwrap_or_else(|found| panic!("{found:?}"))
    }

    #[test]
    fn a_program() {
        assert_eq!(laid(UNTIDY), TIDY);
        assert_eq!(laid(TIDY), TIDY);
    }

    #[test]
    fn line_ends_and_empty_texts() {
        assert_eq!(laid(""), "");
        assert_eq!(laid("\n\n"), "");
        assert_eq!(laid("// a \r\n\r\n\r\n\r\n(* b  \r\n  c *)"), "// a\r\n\r\n(* b\r\n  c *)\r\n");
        assert!(format(&Source::new("t.st", "PROGRAM A x := ; END_PROGRAM").unwrap()).is_err());
    }
}
