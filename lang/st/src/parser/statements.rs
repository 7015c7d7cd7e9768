//! Statements.

use diagnostics::Span;

use super::expressions::joined;
use super::{Failed, Outcome, Parser};
use crate::diagnostic::{Code, Diagnostic};
use crate::habits;
use crate::keywords::is_keyword;
use crate::lexer::Kind;
use crate::tree::{CaseArm, Expression, ExpressionKind, ForLoop, Statement, StatementKind};

impl Parser<'_> {
    /// Statements up to a word that ends them, which stays.
    pub(super) fn statements(&mut self) -> Vec<Statement> {
        let mut statements = Vec::new();
        while !self.is_at_end() && !self.ends_statements() {
            if self.take_sign(";") {
                continue;
            }
            let before = self.at;
            match self.deeper(Parser::statement) {
                Ok(statement) => statements.push(statement),
                Err(Failed) => {
                    if self.at == before {
                        self.step();
                    }
                    self.skip_statement();
                }
            }
        }
        statements
    }

    fn ends_statements(&self) -> bool {
        let ends = [
            "ELSE",
            "ELSIF",
            "UNTIL",
            "PROGRAM",
            "FUNCTION",
            "FUNCTION_BLOCK",
            "TYPE",
            "VAR_GLOBAL",
        ];
        let word = self.word_at(0);
        let is_end = word.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("END_"))
            && is_keyword(word);
        is_end || self.is_one_of(&ends) || self.is_case_label()
    }

    /// `1:`, `-5..7:`, `Fill, Stir:`: a label of the CASE around.
    fn is_case_label(&self) -> bool {
        let mut at = 0;
        loop {
            if matches!(self.ahead(at).kind, Kind::Sign("-" | "+")) {
                at += 1;
            }
            match self.ahead(at).kind {
                Kind::Integer | Kind::Prefixed => {}
                Kind::Word if !is_keyword(self.word_at(at)) => {}
                _ => return false,
            }
            match self.ahead(at + 1).kind {
                Kind::Sign(":") => return true,
                Kind::Sign("," | "..") => at += 2,
                _ => return false,
            }
        }
    }

    fn statement(&mut self) -> Outcome<Statement> {
        let start = self.token().span;
        let word = self.word_at(0).to_ascii_uppercase();
        let (kind, span) = match word.as_str() {
            "IF" => self.if_statement()?,
            "CASE" => self.case()?,
            "FOR" => self.for_loop()?,
            "WHILE" => self.while_loop()?,
            "REPEAT" => self.repeat()?,
            "EXIT" | "CONTINUE" | "RETURN" => {
                self.step();
                if word == "RETURN" && (self.is_name() || self.token().kind == Kind::Integer) {
                    let message = "RETURN gives no value";
                    let help = "a function gives what its name has: `Area := x; RETURN;`";
                    let span = self.token().span;
                    self.report(Diagnostic::new(Code::Syntax, span, message).help(help));
                    return Err(Failed);
                }
                let kind = match word.as_str() {
                    "EXIT" => StatementKind::Exit,
                    "CONTINUE" => StatementKind::Continue,
                    _ => StatementKind::Return,
                };
                (kind, start)
            }
            "GOTO" => {
                let message = "GOTO: Structured Text here has no jumps";
                let help = "IF, CASE, loops, EXIT, CONTINUE and RETURN say the same";
                self.report(Diagnostic::new(Code::NotThere, start, message).help(help));
                return Err(Failed);
            }
            _ => self.assignment_or_call()?,
        };
        // After END_IF and the like nothing can be misunderstood without it.
        let is_closed = matches!(
            kind,
            StatementKind::If(..)
                | StatementKind::Case(..)
                | StatementKind::For(_)
                | StatementKind::While(..)
                | StatementKind::Repeat(..)
        );
        if !is_closed || self.is_sign(";") {
            self.semicolon();
        }
        Ok(Statement { kind, span })
    }

    fn assignment_or_call(&mut self) -> Outcome<(StatementKind, Span)> {
        let target = self.target()?;
        if self.is_sign("(") {
            let arguments = self.arguments()?;
            let span = joined(target.span, self.previous());
            return Ok((StatementKind::Call(target, arguments), span));
        }
        if self.is_sign("=") {
            let span = self.token().span;
            let message = "`=` compares, `:=` assigns";
            self.report(Diagnostic::new(Code::Assignment, span, message).suggest(":="));
            self.step();
        } else if !self.take_sign(":=") {
            return Err(self.no_statement(&target));
        }
        let value = self.expression()?;
        let span = joined(target.span, value.span);
        Ok((StatementKind::Assign(target, value), span))
    }

    /// Reports a name that nothing is done with.
    fn no_statement(&mut self, target: &Expression) -> Failed {
        let name = target.span.text(self.text);
        let help = match (self.token().kind, self.ahead(1).kind) {
            (Kind::Sign(sign @ ("+" | "-")), Kind::Sign(again)) if sign == again => {
                format!("`{name} := {name} {sign} 1;` counts")
            }
            (Kind::Sign(";"), _) if habits::help(name).is_none() => {
                format!("`{name} := ...;` gives it a value, `{name}();` calls an instance")
            }
            _ => return self.expected("`:=`"),
        };
        let message = format!("`{name}`: this is no statement");
        self.report(Diagnostic::new(Code::Syntax, target.span, message).help(help));
        Failed
    }

    /// The word that closes a statement; where another is there, it is reported as missing: before
    /// the first line that is indented no more than the statement, else here.
    fn close(&mut self, word: &str, opened: Span, head: Span) {
        let is_reported = self.is_before_brace(head.end as usize);
        if self.take_word(word) || is_reported {
            return;
        }
        let after = self.end_by_layout(opened).unwrap_or(self.previous());
        self.missing_after(after, word, Some((opened, "for this one")));
    }

    /// What is before the line where the layout says that a statement has ended.
    fn end_by_layout(&self, opened: Span) -> Option<Span> {
        let column = self.indentation(opened)?;
        let first = self.tokens.partition_point(|token| token.span.start <= opened.start);
        let inside = self.tokens.get(first..self.at)?;
        let mut lines = inside.iter().filter_map(|token| self.indentation(token.span));
        if lines.next().is_none_or(|inner| inner <= column) {
            return None;
        }
        let parts = ["ELSE", "ELSIF", "UNTIL"];
        let outside = inside.iter().position(|token| {
            let is_part = parts.iter().any(|part| part.eq_ignore_ascii_case(self.text_of(*token)));
            !is_part && self.indentation(token.span).is_some_and(|other| other <= column)
        });
        let before = (first + outside?).checked_sub(1)?;
        self.tokens.get(before).map(|token| token.span).filter(|span| span.start > opened.start)
    }

    /// How far the first token of a line is indented; `None` of others.
    fn indentation(&self, span: Span) -> Option<usize> {
        let before = self.text.get(..span.start as usize)?;
        let line = before.rsplit('\n').next()?;
        line.chars().all(char::is_whitespace).then(|| line.chars().count())
    }

    fn if_statement(&mut self) -> Outcome<(StatementKind, Span)> {
        let opened = self.step().span;
        let mut arms = Vec::new();
        let condition = self.condition_with("THEN");
        let head = joined(opened, self.previous());
        arms.push((condition, self.statements()));
        while self.take_word("ELSIF") {
            let condition = self.condition_with("THEN");
            arms.push((condition, self.statements()));
        }
        let mut otherwise = Vec::new();
        if self.take_word("ELSE") {
            let inner = self.token().span;
            let is_if = self.is_word("IF");
            otherwise = self.statements();
            if is_if && !self.is_word("END_IF") {
                let message = "`END_IF` is missing: this IF has an end of its own";
                let found = Diagnostic::new(Code::Missing, inner, message);
                self.report(found.help("ELSIF goes on with the IF before"));
                return Ok((StatementKind::If(arms, otherwise), head));
            }
        }
        self.close("END_IF", opened, head);
        Ok((StatementKind::If(arms, otherwise), head))
    }

    /// A condition and the word after it. What cannot be read is reported and passed over.
    fn condition_with(&mut self, word: &str) -> Expression {
        let start = self.token().span;
        let condition = self.condition();
        if condition.is_err() {
            let is_there = |parser: &Self| parser.is_word(word) || parser.is_sign(";");
            while !self.is_at_end() && !is_there(self) && !self.is_boundary() {
                self.step();
            }
            self.take_word(word);
        } else if !self.take_word(word) {
            self.missing(word, None);
            if self.is_before_brace(self.previous().end as usize) {
                return Expression { kind: ExpressionKind::Missing, span: start };
            }
        }
        condition.unwrap_or(Expression { kind: ExpressionKind::Missing, span: start })
    }

    fn case(&mut self) -> Outcome<(StatementKind, Span)> {
        let opened = self.step().span;
        let selector = self.condition_with("OF");
        let head = joined(opened, self.previous());
        let mut arms = Vec::new();
        while self.is_case_label() {
            let labels = self.labels()?;
            arms.push(CaseArm { labels, body: self.statements() });
        }
        if arms.is_empty() && !self.is_one_of(&["ELSE", "END_CASE"]) {
            self.expected("a label such as `1:`");
            self.statements();
        }
        let mut otherwise = Vec::new();
        if self.take_word("ELSE") {
            if self.is_sign(":") {
                let span = self.step().span;
                self.report(Diagnostic::new(Code::Syntax, span, "ELSE has no `:` after it"));
            }
            otherwise = self.statements();
        }
        self.close("END_CASE", opened, head);
        Ok((StatementKind::Case(selector, arms, otherwise), head))
    }

    fn labels(&mut self) -> Outcome<Vec<(Expression, Option<Expression>)>> {
        let mut labels = Vec::new();
        loop {
            let first = self.expression()?;
            let last = if self.take_sign("..") { Some(self.expression()?) } else { None };
            labels.push((first, last));
            if !self.take_sign(",") {
                break;
            }
        }
        self.need_sign(":")?;
        Ok(labels)
    }

    fn for_loop(&mut self) -> Outcome<(StatementKind, Span)> {
        let opened = self.step().span;
        let counted = self.for_head();
        if counted.is_err() {
            while !self.is_at_end() && !self.is_word("DO") && !self.is_boundary() {
                self.step();
            }
        }
        if !self.take_word("DO") && counted.is_ok() {
            self.missing("DO", None);
        }
        let head = joined(opened, self.previous());
        let body = self.statements();
        if counted.is_err() {
            self.take_word("END_FOR");
        } else {
            self.close("END_FOR", opened, head);
        }
        let (variable, from, to, by) = counted?;
        Ok((StatementKind::For(Box::new(ForLoop { variable, from, to, by, body })), head))
    }

    /// The variable, the first and the last value, the step.
    fn for_head(&mut self) -> Outcome<(Expression, Expression, Expression, Option<Expression>)> {
        if !self.is_name() {
            return Err(self.expected("a variable to count with, `FOR i := 1 TO 5 DO`,"));
        }
        let variable = self.target()?;
        if self.is_sign("=") {
            let span = self.token().span;
            let message = "`=` compares, `:=` assigns";
            self.report(Diagnostic::new(Code::Assignment, span, message).suggest(":="));
            self.step();
        } else {
            self.need_sign(":=")?;
        }
        let from = self.expression()?;
        self.need_word("TO")?;
        let to = self.expression()?;
        let by = if self.take_word("BY") { Some(self.expression()?) } else { None };
        Ok((variable, from, to, by))
    }

    fn while_loop(&mut self) -> Outcome<(StatementKind, Span)> {
        let opened = self.step().span;
        let condition = self.condition_with("DO");
        let head = joined(opened, self.previous());
        let body = self.statements();
        self.close("END_WHILE", opened, head);
        Ok((StatementKind::While(condition, body), head))
    }

    fn repeat(&mut self) -> Outcome<(StatementKind, Span)> {
        let opened = self.step().span;
        let body = self.statements();
        if !self.take_word("UNTIL") {
            self.missing("UNTIL", Some((opened, "for this one")));
            self.close("END_REPEAT", opened, opened);
            let missing = Expression { kind: ExpressionKind::Missing, span: opened };
            return Ok((StatementKind::Repeat(body, missing), opened));
        }
        let condition = self.condition()?;
        self.take_sign(";");
        self.close("END_REPEAT", opened, opened);
        Ok((StatementKind::Repeat(body, condition), opened))
    }
}
