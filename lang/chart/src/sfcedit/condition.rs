//! Conditions of charts: variables, edges, `.` for AND, `+` for OR, complements, comparisons. They
//! are read from texts with markup, and written as people and as ST write them.

use diagnostics::Span;

use super::words::{Part, Words};
use crate::diagnostic::{Code, Diagnostic};

/// Deeper than anybody writes: a bound on what a foreign text costs.
const DEPTH_MAX: usize = 64;

/// A condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Condition {
    /// `1` or `0`.
    Constant(bool),
    /// A BOOL variable, or what a timer or counter says: `Temp1.Q`.
    Variable(String),
    /// The moment in which a variable becomes TRUE.
    Rising(String),
    /// The moment in which a variable becomes FALSE.
    Falling(String),
    /// A complement.
    Not(Box<Condition>),
    /// All of them.
    And(Vec<Condition>),
    /// One of them at least.
    Or(Vec<Condition>),
    /// Two values with their relation between them, as ST writes it.
    Comparison(String, &'static str, String),
    /// `5s/a/2s`: the times as ST writes them, `T#5s`.
    Time(String, Box<Condition>, Option<String>),
}

/// How edges are written in ST.
pub trait Edges {
    /// The moment in which a variable becomes TRUE.
    fn rising(&self, variable: &str) -> String;
    /// The moment in which a variable becomes FALSE.
    fn falling(&self, variable: &str) -> String;
}

impl Condition {
    /// As ST. Operators have brackets around them where they are operands of another one.
    pub fn st(&self, edges: &dyn Edges) -> String {
        let inner = |one: &Condition| match one.is_whole() {
            true => one.st(edges),
            false => format!("({})", one.st(edges)),
        };
        let joined =
            |all: &[Condition], word: &str| all.iter().map(inner).collect::<Vec<_>>().join(word);
        match self {
            Condition::Constant(true) => "TRUE".to_owned(),
            Condition::Constant(false) => "FALSE".to_owned(),
            Condition::Variable(name) => name.clone(),
            Condition::Rising(name) => edges.rising(name),
            Condition::Falling(name) => edges.falling(name),
            Condition::Not(one) => format!("NOT {}", inner(one)),
            Condition::And(all) => joined(all, " AND "),
            Condition::Or(all) => joined(all, " OR "),
            Condition::Comparison(left, relation, right) => format!("{left} {relation} {right}"),
            Condition::Time(on, of, off) => {
                let off = off.iter().map(|off| format!("/{off}")).collect::<String>();
                format!("{on}/{}{off}", inner(of))
            }
        }
    }

    /// Whether it needs no brackets as the operand of an operator.
    fn is_whole(&self) -> bool {
        use Condition::{And, Comparison, Or, Time};
        !matches!(self, And(_) | Or(_) | Comparison(..) | Time(..))
    }

    /// Whether a variable is compared with something in it.
    pub fn compares(&self, name: &str) -> bool {
        match self {
            Condition::Comparison(left, _, right) => left == name || right == name,
            Condition::Not(one) | Condition::Time(_, one, _) => one.compares(name),
            Condition::And(all) | Condition::Or(all) => all.iter().any(|one| one.compares(name)),
            Condition::Constant(_)
            | Condition::Variable(_)
            | Condition::Rising(_)
            | Condition::Falling(_) => false,
        }
    }

    /// With other words in the place of some of its parts: those for which there are some.
    pub fn replaced(&self, by: &dyn Fn(&Condition) -> Option<Condition>) -> Condition {
        let one = |inside: &Condition| Box::new(inside.replaced(by));
        let all = |inside: &[Condition]| inside.iter().map(|one| one.replaced(by)).collect();
        by(self).unwrap_or_else(|| match self {
            Condition::Not(inside) => Condition::Not(one(inside)),
            Condition::And(inside) => Condition::And(all(inside)),
            Condition::Or(inside) => Condition::Or(all(inside)),
            Condition::Time(on, of, off) => Condition::Time(on.clone(), one(of), off.clone()),
            other => other.clone(),
        })
    }

    /// As equations of charts have it: `a./b+c`.
    pub fn equation(&self) -> String {
        let inner = |one: &Condition| match one {
            Condition::Or(_) => format!("({})", one.equation()),
            _ => one.equation(),
        };
        match self {
            Condition::Constant(value) => u8::from(*value).to_string(),
            Condition::Variable(name) => name.clone(),
            Condition::Rising(name) => format!("↑{name}"),
            Condition::Falling(name) => format!("↓{name}"),
            Condition::Not(one) => match **one {
                Condition::And(_) | Condition::Or(_) => format!("/({})", one.equation()),
                _ => format!("/{}", one.equation()),
            },
            Condition::And(all) => all.iter().map(inner).collect::<Vec<_>>().join("."),
            Condition::Or(all) => {
                all.iter().map(Condition::equation).collect::<Vec<_>>().join(" + ")
            }
            Condition::Comparison(left, relation, right) => format!("[{left}{relation}{right}]"),
            Condition::Time(on, of, off) => {
                let off = off.iter().map(|off| format!("/{off}")).collect::<String>();
                format!("{on}/{}{off}", inner(of))
            }
        }
    }

    /// Calls `found` with each variable, and with whether it is one for an edge (`Some(rising)`).
    pub fn visit(&self, found: &mut dyn FnMut(&str, Option<bool>)) {
        match self {
            Condition::Constant(_) => {}
            Condition::Variable(name) => found(name, None),
            Condition::Rising(name) => found(name, Some(true)),
            Condition::Falling(name) => found(name, Some(false)),
            Condition::Not(one) | Condition::Time(_, one, _) => one.visit(found),
            Condition::And(all) | Condition::Or(all) => all.iter().for_each(|one| one.visit(found)),
            Condition::Comparison(left, _, right) => {
                for side in [left, right] {
                    if side.starts_with(is_first_of_name) && !side.contains('#') {
                        found(side, None);
                    }
                }
            }
        }
    }
}

/// How conditions are read.
#[derive(Clone, Copy)]
pub struct Manner<'n> {
    /// Which names are those of timers and counters, whose `.Q` is a part of theirs and no AND.
    pub is_instance: &'n dyn Fn(&str) -> bool,
    /// Whether there are times in them, `5s/X2`.
    pub has_times: bool,
}

/// Reads a condition.
pub fn parse(words: &Words, manner: Manner) -> Result<Condition, Box<Diagnostic>> {
    condition(words, manner).map_err(|wrong| {
        let found = Diagnostic::new(Code::BadCondition, wrong.span, wrong.message);
        Box::new(match wrong.help {
            Some(help) => found.help(help),
            None => found,
        })
    })
}

fn condition(words: &Words, manner: Manner) -> Result<Condition, Wrong> {
    let tokens = cut(words, manner)?;
    let mut parser = Parser { tokens: &tokens, at: 0, end: words.span };
    // GRAFCET's `=1` is what is always true.
    if let [Token { kind: Kind::Relation("="), .. }, Token { kind: Kind::Number(one), .. }] =
        &tokens[..]
        && one == "1"
    {
        return Ok(Condition::Constant(true));
    }
    let condition = parser.or(0)?;
    match parser.peek() {
        None => Ok(condition),
        Some(token) => Err(unexpected(token)),
    }
}

fn is_first_of_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn is_in_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    Name(String),
    Number(String),
    Rising,
    Falling,
    Not,
    And,
    Or,
    Open,
    Close,
    /// Between a time and what it is of.
    Slash,
    Relation(&'static str),
}

#[derive(Debug, Clone)]
struct Token {
    kind: Kind,
    span: Span,
}

const TIMES: &str = "such as 5s/X2, and 5s/a/2s with a time for which it stays";

const RELATIONS: [(&str, &str); 9] = [
    ("<=", "<="),
    (">=", ">="),
    ("<>", "<>"),
    ("!=", "<>"),
    ("≤", "<="),
    ("≥", ">="),
    ("<", "<"),
    (">", ">"),
    ("=", "="),
];

/// What is wrong with a condition.
struct Wrong {
    span: Span,
    message: String,
    help: Option<&'static str>,
}

impl Wrong {
    fn help(self, help: &'static str) -> Wrong {
        Wrong { help: Some(help), ..self }
    }
}

fn error(span: Span, message: impl Into<String>) -> Wrong {
    Wrong { span, message: message.into(), help: None }
}

fn unexpected(token: &Token) -> Wrong {
    let message = match &token.kind {
        Kind::Name(name) | Kind::Number(name) => {
            format!("{name}: an operator is missing before this")
        }
        Kind::Not => "a complement is before its operand: an operator is missing".to_owned(),
        _ => "this has no operand before it".to_owned(),
    };
    error(token.span, message).help("`.` is AND, `+` is OR, <cpl>a</cpl> is NOT a")
}

/// Cuts a text into tokens.
fn cut(words: &Words, manner: Manner) -> Result<Vec<Token>, Wrong> {
    let mut tokens: Vec<Token> = Vec::new();
    let at_part = |tokens: &[Token]| tokens.last().map_or(words.span, |last| last.span);
    for part in &words.parts {
        let span = at_part(&tokens);
        let mark = |kind| Token { kind, span };
        match part {
            Part::Rising => tokens.push(mark(Kind::Rising)),
            Part::Falling => tokens.push(mark(Kind::Falling)),
            Part::Complement => {
                tokens.push(mark(Kind::Not));
                tokens.push(mark(Kind::Open));
            }
            Part::ComplementEnd => tokens.push(mark(Kind::Close)),
            Part::Text(text, span) => cut_text(text, *span, &mut tokens, manner)?,
        }
    }
    Ok(tokens)
}

fn cut_text(text: &str, span: Span, tokens: &mut Vec<Token>, manner: Manner) -> Result<(), Wrong> {
    // Offsets hold where the text is in the file as it is; entities make it shorter than there.
    let is_plain = (span.end - span.start) as usize == text.len();
    let place = |start: usize, end: usize| match is_plain {
        true => Span::new(span.start as usize + start, span.start as usize + end),
        false => span,
    };
    let mut at = 0;
    while let Some(first) = text.get(at..).and_then(|rest| rest.chars().next()) {
        let rest = text.get(at..).unwrap_or("");
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let is_after_operand = tokens.last().is_some_and(|last| is_operand(&last.kind));
        let (kind, length) = match first {
            '/' if is_after_operand && manner.has_times => (Kind::Slash, 1),
            _ if is_first_of_name(first) => name(rest, manner.is_instance),
            _ if first.is_ascii_digit() && manner.has_times && time_length(rest).is_some() => {
                let length = time_length(rest).unwrap_or(0);
                (Kind::Number(format!("T#{}", rest.get(..length).unwrap_or(""))), length)
            }
            _ if first.is_ascii_digit() => {
                let length = number_length(rest);
                (Kind::Number(rest.get(..length).unwrap_or("").to_owned()), length)
            }
            _ => sign(rest).ok_or_else(|| {
                let message = format!("`{first}` is no part of a condition");
                error(place(at, at + first.len_utf8()), message)
                    .help("`.` is AND, `+` is OR, <cpl>a</cpl> is NOT a")
            })?,
        };
        let span = place(at, at + length);
        if rest.starts_with('/') && is_after_operand && !manner.has_times {
            return Err(error(
                span,
                "a time in a condition (`t1/X2`) is not in this style of chart",
            )
            .help("start a timer in the step, and ask for its .Q"));
        }
        tokens.push(Token { kind, span });
        at += length;
    }
    Ok(())
}

fn is_operand(kind: &Kind) -> bool {
    matches!(kind, Kind::Name(_) | Kind::Number(_) | Kind::Close)
}

/// A name, with what a timer or counter has after it: `Temp1.Q`; or an operator that is a word.
fn name(rest: &str, is_instance: &dyn Fn(&str) -> bool) -> (Kind, usize) {
    let length = rest.find(|c| !is_in_name(c)).unwrap_or(rest.len());
    let word = rest.get(..length).unwrap_or("");
    // `T#5s`, `INT#3`: a literal with its type.
    if rest.get(length..).unwrap_or("").starts_with('#') {
        let end = rest.find(|c| !(is_in_name(c) || c == '#')).unwrap_or(rest.len());
        return (Kind::Number(rest.get(..end).unwrap_or("").to_owned()), end);
    }
    let kind = match word.to_uppercase().as_str() {
        "AND" => Kind::And,
        "OR" => Kind::Or,
        "NOT" => Kind::Not,
        _ => {
            let member = rest.get(length..).and_then(|rest| rest.strip_prefix('.')).unwrap_or("");
            let end = member.find(|c| !is_in_name(c)).unwrap_or(member.len());
            let member = member.get(..end).unwrap_or("");
            if is_instance(word) && ["Q", "QU", "QD", "ET", "CV"].contains(&member) {
                let end = length + 1 + end;
                return (Kind::Name(rest.get(..end).unwrap_or("").to_owned()), end);
            }
            Kind::Name(word.to_owned())
        }
    };
    (kind, length)
}

/// Digits, with a point only where digits are after it: `5.a` is 5 AND a.
fn number_length(rest: &str) -> usize {
    let digits = |from: usize| {
        let rest = rest.get(from..).unwrap_or("");
        from + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    };
    let whole = digits(0);
    match rest.get(whole..).and_then(|rest| rest.strip_prefix('.')) {
        Some(fraction) if fraction.starts_with(|c: char| c.is_ascii_digit()) => digits(whole + 1),
        _ => whole,
    }
}

/// A number with a unit of time directly after it: `5s`, `2.5s`, `500ms`.
fn time_length(rest: &str) -> Option<usize> {
    let number = number_length(rest);
    let unit = rest.get(number..).unwrap_or("");
    let unit = unit.get(..unit.find(|c| !is_in_name(c)).unwrap_or(unit.len())).unwrap_or("");
    let is_unit = ["d", "h", "m", "s", "ms"].iter().any(|one| one.eq_ignore_ascii_case(unit));
    is_unit.then_some(number + unit.len())
}

fn sign(rest: &str) -> Option<(Kind, usize)> {
    for (text, relation) in RELATIONS {
        if rest.starts_with(text) {
            return Some((Kind::Relation(relation), text.len()));
        }
    }
    let first = rest.chars().next()?;
    let kind = match first {
        '.' | '·' | '*' | '&' => Kind::And,
        '+' | '|' => Kind::Or,
        '/' | '!' | '¬' | '~' => Kind::Not,
        '↑' => Kind::Rising,
        '↓' => Kind::Falling,
        '(' | '[' => Kind::Open,
        ')' | ']' => Kind::Close,
        _ => return None,
    };
    Some((kind, first.len_utf8()))
}

struct Parser<'t> {
    tokens: &'t [Token],
    at: usize,
    /// What the caret is at where the text ends too early.
    end: Span,
}

impl Parser<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn take(&mut self, kind: &Kind) -> bool {
        let is_next = self.peek().is_some_and(|token| token.kind == *kind);
        self.at += usize::from(is_next);
        is_next
    }

    fn or(&mut self, depth: usize) -> Result<Condition, Wrong> {
        let mut all = vec![self.and(depth)?];
        while self.take(&Kind::Or) {
            all.push(self.and(depth)?);
        }
        Ok(one_or(all, Condition::Or))
    }

    fn and(&mut self, depth: usize) -> Result<Condition, Wrong> {
        let mut all = vec![self.not(depth)?];
        while self.take(&Kind::And) {
            all.push(self.not(depth)?);
        }
        Ok(one_or(all, Condition::And))
    }

    fn not(&mut self, depth: usize) -> Result<Condition, Wrong> {
        if depth > DEPTH_MAX {
            return Err(error(self.end, "this condition is nested too deeply"));
        }
        if !self.take(&Kind::Not) {
            return self.primary(depth);
        }
        let span = self.peek().map_or(self.end, |token| token.span);
        match self.not(depth + 1)? {
            // The complement of an edge is no edge: nobody means "in all other moments".
            Condition::Rising(_) | Condition::Falling(_) => {
                Err(error(span, "the complement of an edge").help("use the other edge"))
            }
            one => Ok(Condition::Not(Box::new(one))),
        }
    }

    fn primary(&mut self, depth: usize) -> Result<Condition, Wrong> {
        let Some(token) = self.peek().cloned() else {
            return Err(error(self.end, "something is missing at the end of this condition"));
        };
        self.at += 1;
        match token.kind {
            Kind::Open => {
                let inner = self.or(depth + 1)?;
                match self.take(&Kind::Close) {
                    true => Ok(inner),
                    false => Err(error(token.span, "this bracket is not closed")),
                }
            }
            Kind::Rising => Ok(Condition::Rising(self.edge(token.span)?)),
            Kind::Falling => Ok(Condition::Falling(self.edge(token.span)?)),
            Kind::Name(text) | Kind::Number(text) => match self.take(&Kind::Slash) {
                true => self.time(text, token.span, depth),
                false => self.operand(text, token.span),
            },
            _ => Err(unexpected(&token)),
        }
    }

    fn edge(&mut self, span: Span) -> Result<String, Wrong> {
        match self.peek().map(|token| token.kind.clone()) {
            Some(Kind::Name(name)) if !name.contains('.') => {
                self.at += 1;
                Ok(name)
            }
            _ => Err(error(span, "an edge is that of a variable").help("write <re/>Start")),
        }
    }

    /// What is after `5s/`.
    fn time(&mut self, on: String, span: Span, depth: usize) -> Result<Condition, Wrong> {
        let is_time = |text: &str| text.contains('#');
        if !is_time(&on) {
            return Err(error(span, format!("{on}: a time is before `/`")).help(TIMES));
        }
        let of = self.timed(depth)?;
        let off = match self.take(&Kind::Slash) {
            false => None,
            true => match self.peek().cloned() {
                Some(Token { kind: Kind::Number(off), .. }) if is_time(&off) => {
                    self.at += 1;
                    Some(off)
                }
                _ => return Err(error(span, "the second time is missing").help(TIMES)),
            },
        };
        Ok(Condition::Time(on, Box::new(of), off))
    }

    /// What a time is of: a variable or step, a bracket, a complement of these.
    fn timed(&mut self, depth: usize) -> Result<Condition, Wrong> {
        match self.peek().cloned() {
            Some(Token { kind: Kind::Name(name), .. }) => {
                self.at += 1;
                Ok(Condition::Variable(name))
            }
            Some(Token { kind: Kind::Not | Kind::Open, .. }) => self.not(depth + 1),
            _ => Err(error(self.end, "a time of nothing").help(TIMES)),
        }
    }

    fn operand(&mut self, left: String, span: Span) -> Result<Condition, Wrong> {
        if let Some(Token { kind: Kind::Relation(relation), span: at }) = self.peek().cloned() {
            self.at += 1;
            let right = match self.peek().map(|token| token.kind.clone()) {
                Some(Kind::Name(text) | Kind::Number(text)) => text,
                _ => {
                    return Err(error(at, format!("{relation}: there is nothing to compare with")));
                }
            };
            self.at += 1;
            return Ok(Condition::Comparison(left, relation, right));
        }
        match left.to_uppercase().as_str() {
            "1" | "TRUE" => Ok(Condition::Constant(true)),
            "0" | "FALSE" => Ok(Condition::Constant(false)),
            _ if left.starts_with(is_first_of_name) && !left.contains('#') => {
                Ok(Condition::Variable(left))
            }
            _ => Err(error(
                span,
                format!("{left} is no condition: it is not compared with anything"),
            )),
        }
    }
}

fn one_or(mut all: Vec<Condition>, many: fn(Vec<Condition>) -> Condition) -> Condition {
    match all.len() {
        1 => all.swap_remove(0),
        _ => many(all),
    }
}
