//! Instructions of the S7-200 that are written by the habit of another language: a comparison
//! between its operands, a logarithm that is a contact, a coil with a letter. Each is one answer
//! for the whole line.

use plc_isa::{Instruction, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Operand, Span, Statement, Value};
use crate::text::foreign;
use crate::text::instructions::compare_like;
use crate::text::lexer::Ahead;
use crate::text::mnemonics::{meaning, written_operands};
use crate::text::parser::Parser;
use crate::text::resolve::read_plain;

impl Parser<'_> {
    /// Whether an instruction is such a habit, and is reported.
    pub(crate) fn is_habit(
        &mut self,
        entry: &'static Instruction,
        word: Span,
        operands: &[Operand],
    ) -> bool {
        is_foreign_load(entry.op, operands) && self.load_of_list(word)
            || operands.len() == 3 && self.comparison_apart(entry, word, operands)
            || self.inverted_load(entry.op, word, operands)
            || operands.len() == 2 && self.coil_with_letter(entry.op, word, operands)
            || operands.len() == 3 && self.range_in_words(entry.op, word, operands)
            || operands.len() > 1 && self.logic(entry, word, operands)
    }

    /// `TON T37; 50`: the last operand is after a semicolon instead of a comma.
    pub(crate) fn operand_after_semicolon(
        &mut self,
        entry: &Instruction,
        index: usize,
    ) -> Option<Operand> {
        let at = self.lexer.position();
        let rest = self.text.get(at + 1..)?.lines().next()?;
        let rest = rest.split_once("//").map_or(rest, |(code, _)| code).trim();
        let is_value = !rest.contains([' ', '\t', ';', ',']) && read_plain(rest).is_some();
        if !is_value || meaning(rest).is_some() {
            return None;
        }
        let message = "a semicolon ends the instruction: operands are separated by commas";
        let diagnostic = Diagnostic::new(Code::Syntax, Span::new(at, at + 1), message);
        self.diagnostics.push(diagnostic.suggest(","));
        self.lexer.step();
        (self.lexer.ahead() == Ahead::Text).then(|| {
            let cut = self.lexer.operand();
            self.operand(cut, entry, index)
        })
    }

    /// `LD VW0` as the beginning of lines of an instruction list that load a value. Whether it was,
    /// and is reported.
    fn load_of_list(&mut self, word: Span) -> bool {
        let flow = self.flow();
        let text = self.text.get(word.start as usize..).unwrap_or("");
        let found = foreign::together(text, flow);
        found.map(|way| self.together(word, way)).is_some()
    }

    /// `LD VW10 > 5`: a comparison whose sign is between its operands. Whether it was, and is
    /// reported.
    fn comparison_apart(
        &mut self,
        entry: &'static Instruction,
        word: Span,
        operands: &[Operand],
    ) -> bool {
        let [left, sign, right] = operands else { return false };
        let contact = entry.mnemonic();
        let is_plain = matches!(contact, "LD" | "A" | "O");
        let is_sign = sign.span.text(self.text).chars().all(|c| "<>=!".contains(c));
        let span = Span { start: left.span.start, end: right.span.end };
        if !(is_plain && is_sign) {
            return false;
        }
        let Some(meant) = foreign::contact_of(contact, span.text(self.text)) else { return false };
        let line = Span { start: word.start, end: right.span.end };
        let message = format!("{}: a comparison is part of the mnemonic", line.text(self.text));
        let name = meant.split([' ', '=', '<', '>']).next().and_then(compare_like);
        self.diagnostics.push(Diagnostic::new(Code::Syntax, line, message).suggest(meant));
        if let Some(compare) = name {
            self.stand_in(compare, written_operands(compare), line);
        }
        true
    }

    /// `LN I0.0`, which is the logarithm here. Whether it was, and is reported.
    fn inverted_load(&mut self, op: Op, word: Span, operands: &[Operand]) -> bool {
        let [operand] = operands else { return false };
        let bit = foreign::is_bit(operand.span.text(self.text));
        if op != Op::Ln || !bit {
            return false;
        }
        let text = word.text(self.text);
        let message = format!("{text}: the logarithm takes two double words");
        let diagnostic = Diagnostic::new(Code::UnknownMnemonic, word, message);
        self.diagnostics.push(diagnostic.suggest("LDN").help("the inverted contact is `LDN`"));
        self.first_stand_in(word);
        true
    }

    /// Parameters of a call on lines of their own. Whether these are, and are reported.
    pub(crate) fn parameters_apart(&mut self, word: Span) -> bool {
        let Some(Statement::Instruction(call)) = self.program.statements.last() else {
            return false;
        };
        let routine = call.operands.first().map(|operand| operand.span.text(self.text));
        let Some(routine) = routine.filter(|_| call.entry.op == Op::Call) else { return false };
        let text = self.text.get(word.start as usize..).unwrap_or("");
        let Some((values, len)) = foreign::parameters(text) else { return false };
        let message = "parameters are on the line of their call, without their names";
        let diagnostic = Diagnostic::new(Code::Syntax, word, message);
        let call = format!("`CALL {routine}, {}`", values.join(", "));
        self.diagnostics
            .push(diagnostic.help(format!("in the order of their declaration, such as {call}")));
        self.lexer.go_on(word.start as usize + len);
        true
    }

    /// `=N Q0.0`, `=S Q0.0`: a coil with what it does.
    fn coil_with_letter(&mut self, op: Op, word: Span, operands: &[Operand]) -> bool {
        let [letter, bit] = operands else { return false };
        let (letter, bit) = (letter.span.text(self.text), bit.span.text(self.text));
        let instead = match (op, letter.to_ascii_uppercase().as_str()) {
            (Op::Assign, "N" | "/" | "NOT" | "!" | "NICHT") => None,
            (Op::Assign, "S" | "SET") => Some(format!("S {bit}, 1")),
            (Op::Assign, "R" | "RESET") => Some(format!("R {bit}, 1")),
            _ => return false,
        };
        let line = Span { start: word.start, end: operands[1].span.end };
        let message = format!("{}: a coil has its bit alone", line.text(self.text));
        let diagnostic = Diagnostic::new(Code::Syntax, line, message);
        self.diagnostics.push(match instead {
            Some(instead) => diagnostic.suggest(instead),
            None => diagnostic.help(format!("a coil does not invert: `NOT`, then `= {bit}`")),
        });
        true
    }

    /// `S Q0.0 TO Q0.3`.
    fn range_in_words(&mut self, op: Op, word: Span, operands: &[Operand]) -> bool {
        let [first, link, last] = operands else { return false };
        let text = |operand: &Operand| operand.span.text(self.text);
        let is_link =
            ["TO", "BIS", "-", ".."].iter().any(|one| one.eq_ignore_ascii_case(text(link)));
        if !is_link || !matches!(op, Op::Set | Op::Reset) {
            return false;
        }
        let range = format!("{}-{}", text(first), text(last));
        let Some(help) = foreign::operands::range(&range) else { return false };
        let span = Span { start: first.span.start, end: last.span.end };
        let message = format!("{}: a range is no operand", span.text(self.text));
        self.diagnostics.push(Diagnostic::new(Code::Syntax, span, message).help(help));
        self.first_stand_in(word);
        true
    }

    /// `LD Start AND NOT Stop`: contacts of an expression in one line.
    fn logic(&mut self, entry: &'static Instruction, word: Span, operands: &[Operand]) -> bool {
        let is_contact = matches!(entry.op, Op::Ld | Op::Ldn | Op::A | Op::An | Op::O | Op::On);
        let Some(last) = operands.last().filter(|_| is_contact) else { return false };
        let line = Span { start: word.start, end: last.span.end };
        let expression = self.text.get(word.end as usize..last.span.end as usize).unwrap_or("");
        let Some(code) = foreign::contacts_of(entry.mnemonic(), expression) else { return false };
        let message = format!("{}: AWL has no expressions", line.text(self.text));
        let listed: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
        let help = format!("each contact is on a line of its own: {}", listed.join(", "));
        self.diagnostics.push(Diagnostic::new(Code::Syntax, line, message).help(help));
        self.stand_in(entry, 1, line);
        true
    }

    /// `LDW VW0 > 5`: the sign of a comparison is between its operands. Whether it was, and is
    /// reported.
    pub(crate) fn relation_apart(&mut self, word: Span) -> bool {
        let ahead = self.lexer.line_ahead();
        let name = word.text(self.text).to_ascii_uppercase();
        let Some(contact) = name.get(..name.len().saturating_sub(1)) else { return false };
        let Some(at) = ahead.find(['<', '>', '=']) else { return false };
        if !matches!(contact, "LD" | "A" | "O") || ahead[..at].trim().is_empty() {
            return false;
        }
        let Some(meant) = foreign::contact_of(contact, ahead.trim()) else { return false };
        let (line, _) = self.rest_of(word);
        let message = format!("{}: a comparison is part of the mnemonic", line.text(self.text));
        let compare = meant.split([' ', '=', '<', '>']).next().and_then(compare_like);
        self.diagnostics.push(Diagnostic::new(Code::Syntax, line, message).suggest(meant));
        if let Some(compare) = compare {
            self.stand_in(compare, written_operands(compare), line);
        }
        true
    }
}

/// Whether a load of a bit has a value for its operand.
fn is_foreign_load(op: Op, operands: &[Operand]) -> bool {
    let [operand] = operands else { return false };
    op == Op::Ld
        && matches!(
            operand.value,
            Value::Address(Address::Byte { .. } | Address::Word { .. } | Address::Double { .. })
        )
}
