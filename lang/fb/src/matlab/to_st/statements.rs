//! Statements.

use diagnostics::Span;

use super::{Body, Outcome, Translator};
use crate::matlab::lexer::Kind;

impl Translator<'_> {
    /// The algorithms of section 7: `case 1 % Name`, its statements, the next.
    pub(in crate::matlab) fn bodies(&mut self) -> Outcome<Vec<Body>> {
        let mut bodies = Vec::new();
        self.gap(true);
        while self.is_word("case") {
            self.step();
            self.gap(false);
            let number = self.token();
            if number.kind != Kind::Number {
                return self.expected("the number of an algorithm");
            }
            self.step();
            let note = self.token();
            if note.kind != Kind::Comment {
                return self.expected("the name of the algorithm in a comment");
            }
            self.step();
            if self.token().kind == Kind::Newline {
                self.step();
            }
            let start = self.token().span.start;
            let mut text = self.statements(&["case", "end"])?;
            // The line break before the next one is not the algorithm's.
            if text.ends_with('\n') {
                text.pop();
            }
            let span = Span { start, end: self.token().span.start.max(start) };
            bodies.push(Body { number: number.span, note: note.span, text, span });
        }
        for _ in 0..2 {
            self.gap(true);
            if !self.is_word("end") {
                return self.expected("`end`");
            }
            self.step();
        }
        self.gap(true);
        match self.token().kind {
            Kind::End => Ok(bodies),
            _ => self.expected("the end of the section"),
        }
    }

    /// Statements up to one of these words, which is not taken.
    fn statements(&mut self, stops: &[&str]) -> Outcome<String> {
        let mut out = String::new();
        loop {
            out.push_str(&self.gap(true));
            let token = self.token();
            if token.kind == Kind::End {
                return self.expected("`end`");
            }
            if token.kind == Kind::Word && stops.contains(&self.word()) {
                return Ok(out);
            }
            let statement = self.deeper(Self::statement)?;
            out.push_str(&statement);
        }
    }

    fn statement(&mut self) -> Outcome<String> {
        if self.token().kind != Kind::Word {
            return self.expected("a statement");
        }
        match self.word() {
            "if" => self.if_statement(),
            "switch" => self.switch(),
            "while" => self.while_loop(),
            "for" => self.for_loop(),
            "break" => self.alone("EXIT"),
            "continue" => self.alone("CONTINUE"),
            _ => self.assignment(),
        }
    }

    fn alone(&mut self, word: &str) -> Outcome<String> {
        self.step();
        self.ended(word.to_owned())
    }

    /// A statement with its `;`; the line or the statement is over here.
    fn ended(&mut self, statement: String) -> Outcome<String> {
        let before = self.at;
        self.gap(false);
        let is_over =
            matches!(self.token().kind, Kind::Newline | Kind::End | Kind::Sign(";" | ","));
        if !is_over {
            return self.expected("the end of the statement");
        }
        self.at = before;
        Ok(statement + ";")
    }

    fn assignment(&mut self) -> Outcome<String> {
        let name = self.word();
        if self.variable(name).is_none() {
            let message = format!("{name}: the block has no variable of this name");
            return self.wrong(message, "sections 1 and 2 declare the variables");
        }
        self.step();
        let element = self.element()?;
        let gap = self.gap(false);
        self.sign("=")?;
        let value = self.expression()?.text();
        self.ended(format!("{name}{element}{gap}:={value}"))
    }

    fn if_statement(&mut self) -> Outcome<String> {
        self.step();
        let condition = self.expression()?.text();
        let mut text = format!("IF{condition} THEN");
        loop {
            text.push_str(&self.statements(&["elseif", "else", "end"])?);
            let word = self.word();
            self.step();
            match word {
                "elseif" => {
                    let condition = self.expression()?.text();
                    text.push_str(&format!("ELSIF{condition} THEN"));
                }
                "else" => text.push_str("ELSE"),
                _ => return self.ended(text + "END_IF"),
            }
        }
    }

    fn switch(&mut self) -> Outcome<String> {
        self.step();
        let selector = self.expression()?.text();
        let mut text = format!("CASE{selector} OF");
        loop {
            text.push_str(&self.statements(&["case", "otherwise", "end"])?);
            let word = self.word();
            self.step();
            match word {
                "case" => {
                    let labels = self.labels()?;
                    text.push_str(&format!("{labels}:"));
                }
                "otherwise" => text.push_str("ELSE"),
                _ => return self.ended(text + "END_CASE"),
            }
        }
    }

    /// `1` or `{1, 3,4,5}`: numbers that follow each other without blanks are a range.
    fn labels(&mut self) -> Outcome<String> {
        self.gap(false);
        if !self.is_sign("{") {
            return self.label().map(|label| label.to_string());
        }
        self.step();
        let mut ranges: Vec<(i64, i64)> = Vec::new();
        let mut is_range = false;
        loop {
            self.gap(false);
            let value = self.label()?;
            match ranges.last_mut() {
                Some((_, last)) if is_range && last.checked_add(1) == Some(value) => *last = value,
                _ => ranges.push((value, value)),
            }
            self.gap(false);
            if self.is_sign("}") {
                self.step();
                break;
            }
            self.sign(",")?;
            is_range = self.blanks().is_empty();
        }
        let written = ranges.into_iter().map(|(first, last)| match first == last {
            true => first.to_string(),
            false => format!("{first}..{last}"),
        });
        Ok(written.collect::<Vec<_>>().join(", "))
    }

    fn label(&mut self) -> Outcome<i64> {
        let is_negative = self.is_sign("-");
        if is_negative {
            self.step();
        }
        let number = self.word().parse::<i64>().ok().filter(|_| self.token().kind == Kind::Number);
        let Some(number) = number else { return self.expected("a whole number") };
        self.step();
        Ok(if is_negative { -number } else { number })
    }

    fn while_loop(&mut self) -> Outcome<String> {
        self.step();
        let before = self.at;
        let gap = self.gap(false);
        if self.is_word("true") {
            self.step();
            if matches!(self.token().kind, Kind::Newline | Kind::Sign(",") | Kind::Comment) {
                return self.while_true(&gap);
            }
        }
        self.at = before;
        let condition = self.expression()?.text();
        let body = self.statements(&["end"])?;
        self.step();
        self.ended(format!("WHILE{condition} DO{body}END_WHILE"))
    }

    /// The rest of `while true`: a REPEAT if the last statement is `if condition, break; end`.
    fn while_true(&mut self, gap: &str) -> Outcome<String> {
        let mut body = String::new();
        loop {
            body.push_str(&self.gap(true));
            if self.token().kind == Kind::End {
                return self.expected("`end`");
            }
            if self.is_word("end") {
                self.step();
                return self.ended(format!("WHILE{gap}TRUE DO{body}END_WHILE"));
            }
            if let Some(condition) = self.until()? {
                return self.ended(format!("REPEAT{body}UNTIL{condition} END_REPEAT"));
            }
            let statement = self.deeper(Self::statement)?;
            body.push_str(&statement);
        }
    }

    /// `if condition, break; end` and the end of the loop; `None`: something else, of which nothing
    /// is taken.
    fn until(&mut self) -> Outcome<Option<String>> {
        if !self.is_word("if") {
            return Ok(None);
        }
        let (before, told) = (self.at, self.differs.len());
        self.step();
        let condition = self.expression()?.text();
        for word in ["break", "end", "end"] {
            self.gap(true);
            if !self.is_word(word) {
                self.at = before;
                self.differs.truncate(told);
                return Ok(None);
            }
            self.step();
        }
        Ok(Some(condition))
    }

    fn for_loop(&mut self) -> Outcome<String> {
        self.step();
        let gap = self.gap(false);
        let name = self.word();
        if self.variable(name).is_none() {
            return self.expected("a variable of the block");
        }
        self.step();
        let before = self.gap(false);
        self.sign("=")?;
        let from = self.expression()?.text();
        self.gap(false);
        self.sign(":")?;
        let mut to = self.expression()?.text();
        let mut by = String::new();
        self.gap(false);
        if self.is_sign(":") {
            self.step();
            by = format!(" BY {}", to.trim_start());
            to = self.expression()?.text();
        }
        let to = to.trim_start();
        let body = self.statements(&["end"])?;
        self.step();
        self.no_pass();
        self.ended(format!("FOR{gap}{name}{before}:={from} TO {to}{by} DO{body}END_FOR"))
    }

    /// Takes `, if isempty(i), i = a; end`, which gives the variable its value where there is no
    /// pass.
    fn no_pass(&mut self) {
        let before = self.at;
        self.gap(true);
        let is_it = self.is_word("if")
            && self
                .tokens
                .get(self.at + 1)
                .is_some_and(|one| one.span.text(self.text) == "isempty");
        if !is_it {
            self.at = before;
            return;
        }
        while !self.is_word("end") && self.token().kind != Kind::End {
            self.step();
        }
        self.step();
    }
}
