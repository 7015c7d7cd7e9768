//! The instructions of the text: mnemonic, comparison, operands. What an operand means is read elsewhere.

use plc_isa::{Instruction, Relation};

use crate::address::Address;
use crate::ast::{self, Operand, Span, Statement, UnitKind, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::hardware;
use crate::lexer::{Ahead, Cut};
use crate::limits::relations;
use crate::locals::PARAMETERS_MAX;
use crate::mnemonics::{Meaning, comparison, comparisons, confused, first_words, meaning, written_operands};
use crate::parser::Parser;
use crate::resolve::{Pending, read_plain, routine_kind};

/// Operands of one instruction that are looked at.
const OPERANDS_KEPT: usize = 1 + PARAMETERS_MAX;

impl Parser<'_> {
    /// An instruction of the table.
    pub(crate) fn instruction(&mut self, entry: &'static Instruction, operand_count: usize, word: Span) {
        let mut mnemonic_span = word;
        let is_at_relation = self.lexer.ahead() == Ahead::Text && self.lexer.is_at_relation();
        let text = word.text(self.text);
        // OR= compares reals, but there is no OR; LDS is a stack operation, but LDS= compares texts.
        if entry.has_relation() && !is_at_relation && confused(text).is_some() {
            return self.unknown(word);
        }
        let compares = if is_at_relation && !entry.has_relation() { comparison(text) } else { None };
        let (entry, operand_count) = compares.map_or((entry, operand_count), |entry| (entry, written_operands(entry)));
        let relation = match (entry.has_relation(), is_at_relation) {
            (true, true) => {
                let sign = self.lexer.relation();
                mnemonic_span.end = sign.end;
                Some(self.relation(entry, sign))
            }
            (true, false) => {
                self.relation_missing(entry, word);
                Some(Relation::Equal)
            }
            (false, true) => return self.wrong_relation(word),
            (false, false) => None,
        };
        let operands = self.operands(entry.mnemonic(), operand_count);
        let end = operands.last().map_or(mnemonic_span.end, |operand| operand.span.end);
        let span = Span { start: word.start, end };
        let mnemonic = entry.mnemonic();
        let instruction = ast::Instruction { mnemonic, relation, mnemonic_span, operands, span };
        self.program.statements.push(Statement::Instruction(instruction));
    }

    /// An instruction of the S7-200 that no Uno can execute.
    pub(crate) fn refused(&mut self, word: Span) {
        self.diagnostics.extend(hardware::refused(word.text(self.text), word));
        self.lexer.skip_instruction();
    }

    /// A return without condition: it stands at the end of its unit, if at all.
    pub(crate) fn unconditional_return(&mut self, kind: UnitKind, word: Span) {
        let text = word.text(self.text).to_ascii_uppercase();
        let unit = self.program.units().last().map(|(_, unit)| unit.id.kind);
        if unit == Some(kind) {
            self.unit_end = Some(word);
        } else {
            let what = if kind == UnitKind::Interrupt { "an interrupt routine" } else { "a subroutine" };
            let message = format!("{text} returns from {what} only");
            let help = "not needed: a unit ends with its last line";
            self.diagnostics.push(Diagnostic::new(Code::WrongUnit, word, message).help(help));
        }
        self.lexer.skip_instruction();
    }

    /// Reports an unconditional return that something follows.
    pub(crate) fn behind_return(&mut self) {
        if let Some(word) = self.unit_end.take() {
            let text = word.text(self.text).to_ascii_uppercase();
            let message = format!("{text} returns without condition: what follows is never executed");
            let help = format!("C{text} returns with power flow");
            self.diagnostics.push(Diagnostic::new(Code::WrongUnit, word, message).help(help));
        }
    }

    /// A first word that is none.
    pub(crate) fn unknown(&mut self, word: Span) {
        let text = word.text(self.text);
        let has_relation = self.lexer.is_at_relation() && text.starts_with(is_word_start);
        let mut diagnostic = self.unknown_word(word);
        let mut stand_in = None;
        if has_relation {
            let sign = self.lexer.relation();
            diagnostic.span.end = sign.end;
            diagnostic.message = format!("{}: no such instruction", diagnostic.span.text(self.text));
            let near = self.suggester.nearest(text, comparisons());
            diagnostic.suggestion = near.map(|near| format!("{near}{}", sign.text(self.text)));
            stand_in = near;
        } else if let Some(suggestion) = &diagnostic.suggestion {
            stand_in = suggestion.split(' ').next();
        }
        let span = diagnostic.span;
        let canonical = stand_in.and_then(|word| match meaning(word) {
            Some(Meaning::Instruction(entry, _)) => Some(entry.mnemonic()),
            _ => None,
        });
        self.diagnostics.push(diagnostic);
        let from = self.lexer.position();
        self.lexer.skip_instruction();
        let operands = self.text.get(from..self.lexer.position()).unwrap_or("").trim();
        if let Some(mnemonic) = canonical.filter(|mnemonic| is_likely(mnemonic, operands)) {
            self.stand_in(mnemonic, span);
        }
    }

    fn unknown_word(&self, word: Span) -> Diagnostic {
        let text = word.text(self.text);
        if matches!(text, "*)" | "*/") {
            return Diagnostic::new(Code::Syntax, word, format!("{text}: no comment is open here"));
        }
        if !text.starts_with(is_word_start) {
            return Diagnostic::new(Code::Syntax, word, format!("{text}: an instruction begins with its mnemonic"));
        }
        let mut diagnostic = Diagnostic::new(Code::UnknownMnemonic, word, format!("{text}: no such instruction"));
        if let Ok(address) = Address::parse(text) {
            diagnostic.help.push(format!("an instruction begins with its mnemonic, such as `= {address}`"));
            return diagnostic;
        }
        if ["MEND", "BE", "BEA"].iter().any(|end| text.eq_ignore_ascii_case(end)) {
            diagnostic.help.push("not needed: a program ends with its last line".to_owned());
            return diagnostic;
        }
        if self
            .text
            .get(..word.start as usize)
            .is_some_and(|before| before.trim_end_matches([' ', '\t']).ends_with(';'))
        {
            diagnostic.help.push("a comment begins with //".to_owned());
        }
        if text.ends_with(':') {
            diagnostic.help.push("a label is an instruction of its own, such as LBL 1".to_owned());
        }
        diagnostic.suggestion = confused(text)
            .map(str::to_owned)
            .or_else(|| without_blank(text))
            .or_else(|| self.suggester.nearest(text, first_words()).map(str::to_owned));
        diagnostic
    }

    /// A comparison behind an instruction that takes none, such as `LD>=`.
    fn wrong_relation(&mut self, word: Span) {
        let text = word.text(self.text);
        let sign = self.lexer.relation();
        let span = Span { start: word.start, end: sign.end };
        let message = format!("{}: no such instruction", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownMnemonic, span, message);
        let compare = compare_like(&format!("{}W", text.to_ascii_uppercase()));
        if let Some(compare) = compare {
            diagnostic.suggestion = Some(format!("{}{}", compare.mnemonic(), sign.text(self.text)));
        }
        self.diagnostics.push(diagnostic);
        self.lexer.skip_instruction();
        if let Some(compare) = compare {
            self.stand_in(compare.mnemonic(), span);
        }
    }

    /// The comparison that is written. What the instruction does not know is reported where its operands are.
    fn relation(&mut self, entry: &Instruction, sign: Span) -> Relation {
        let text = sign.text(self.text);
        if let Some(relation) = Relation::ALL.into_iter().find(|relation| relation.symbol() == text) {
            return relation;
        }
        let possible = relations(entry.op);
        let all = possible.iter().map(|relation| relation.symbol()).collect::<Vec<_>>().join(" ");
        let message = format!("{text}: no such comparison; there are {all}");
        let mut diagnostic = Diagnostic::new(Code::Syntax, sign, message);
        let meant = [("==", "="), ("=>", ">="), ("=<", "<="), ("!=", "<>"), ("><", "<>")];
        diagnostic.suggestion = meant
            .iter()
            .find(|(wrong, right)| *wrong == text && possible.iter().any(|relation| relation.symbol() == *right))
            .map(|(_, right)| (*right).to_owned());
        self.diagnostics.push(diagnostic);
        Relation::Equal
    }

    fn relation_missing(&mut self, entry: &Instruction, word: Span) {
        let text = word.text(self.text);
        let all = relations(entry.op).iter().map(|relation| format!("{text}{}", relation.symbol()));
        let all = all.collect::<Vec<_>>().join(" ");
        let diagnostic = Diagnostic::new(Code::Syntax, word, format!("{text}: the comparison is missing"));
        self.diagnostics.push(diagnostic.help(format!("there are {all}")));
    }

    /// Puts an instruction in place of one that was reported, so that the logic stack and the pairs of the
    /// following lines are not reported because of it.
    fn stand_in(&mut self, mnemonic: &str, span: Span) {
        if let Some(Meaning::Instruction(entry, count)) = meaning(mnemonic) {
            let relation = entry.has_relation().then_some(Relation::Equal);
            let operands = vec![Operand { span, value: Value::Invalid }; count];
            let mnemonic = entry.mnemonic();
            let instruction = ast::Instruction { mnemonic, relation, mnemonic_span: span, operands, span };
            self.program.statements.push(Statement::Instruction(instruction));
        }
    }

    /// The operands up to the end of the instruction. `count` is how many are expected.
    fn operands(&mut self, mnemonic: &str, count: usize) -> Vec<Operand> {
        let mut operands = Vec::with_capacity(count);
        let mut comma = None;
        loop {
            match self.lexer.ahead() {
                // More than any instruction takes: one error about their number is enough.
                Ahead::Text if operands.len() > OPERANDS_KEPT => {
                    self.lexer.skip_instruction();
                    comma = None;
                    break;
                }
                Ahead::Text => {
                    let cut = self.lexer.operand();
                    let operand = self.operand(cut, mnemonic, operands.len());
                    operands.push(operand);
                    comma = None;
                }
                Ahead::Comma => {
                    let at = self.lexer.position();
                    let span = Span::new(at, at + 1);
                    if operands.is_empty() || comma.is_some() {
                        self.error(Code::Syntax, span, ",: an operand is missing before the comma");
                        operands.push(Operand { span, value: Value::Invalid });
                    }
                    comma = Some(span);
                    self.lexer.step();
                }
                _ => break,
            }
        }
        if let Some(span) = comma.filter(|_| !operands.is_empty()) {
            self.error(Code::Syntax, span, ",: an operand is missing behind the comma");
            operands.push(Operand { span, value: Value::Invalid });
        }
        operands
    }

    fn operand(&mut self, cut: Cut, mnemonic: &str, index: usize) -> Operand {
        let span = match cut {
            Cut::Whole(span) => span,
            Cut::Unclosed(span) => {
                let message = format!("{}: the quote is not closed", span.text(self.text).trim_end());
                self.error(Code::Syntax, span, message);
                return Operand { span, value: Value::Invalid };
            }
        };
        let plain = if routine_kind(mnemonic, index).is_none() { read_plain(span.text(self.text)) } else { None };
        let value = plain.unwrap_or_else(|| {
            self.pending.push(Pending { statement: self.program.statements.len(), operand: index });
            Value::Invalid
        });
        Operand { span, value }
    }
}

/// Whether a guessed instruction fits its operands. Only asked where a wrong guess would do harm further down.
fn is_likely(mnemonic: &str, operands: &str) -> bool {
    match mnemonic {
        "FOR" => operands.matches(',').count() == 2,
        "NEXT" => operands.is_empty(),
        "LBL" | "JMP" => !operands.is_empty() && operands.bytes().all(|byte| byte.is_ascii_digit()),
        _ => true,
    }
}

fn is_word_start(character: char) -> bool {
    character.is_alphanumeric() || !character.is_ascii() || matches!(character, '_' | '+' | '-' | '*' | '/' | '=')
}

/// The entry of a comparison.
fn compare_like(mnemonic: &str) -> Option<&'static Instruction> {
    match meaning(mnemonic) {
        Some(Meaning::Instruction(entry, _)) if entry.has_relation() => Some(entry),
        _ => None,
    }
}

/// `LDI0.0` as `LD I0.0`: mnemonic and operand without the blank between them.
fn without_blank(text: &str) -> Option<String> {
    (1..text.len().min(6)).rev().find_map(|len| {
        let (mnemonic, operand) = text.split_at_checked(len)?;
        match (meaning(mnemonic)?, read_plain(operand)?) {
            // `LDI0.1` is no LDI of a real.
            (_, Value::Real(_)) => None,
            (Meaning::Instruction(entry, count), _) if count > 0 && !entry.has_relation() => {
                Some(format!("{} {operand}", mnemonic.to_ascii_uppercase()))
            }
            _ => None,
        }
    })
}
