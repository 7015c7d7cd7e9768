//! The instructions of the text: mnemonic, comparison, operands. What an operand means is read
//! elsewhere.

use plc_isa::{Instruction, Op, Relation};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::ast::{self, Constant, Operand, Span, Statement, UnitKind, Value};
use crate::text::foreign::{self, Flow, Instead, Meant, Together};
use crate::text::lexer::{Ahead, Cut};
use crate::text::locals::PARAMETERS_MAX;
use crate::text::mnemonics::{
    Keyword, Meaning, comparison, comparisons, first_words, meaning, written_operands,
};
use crate::text::parser::Parser;
use crate::text::refused;
use crate::text::resolve::{Pending, read_plain, routine_kind};

/// Operands of one instruction that are looked at.
const OPERANDS_KEPT: usize = 1 + PARAMETERS_MAX;

/// What stands for an operand that is only counted.
const NOT_READ: Value = Value::Constant(Constant { value: 0, is_pattern: false });

impl<'s> Parser<'s> {
    /// An instruction of the table.
    pub(crate) fn instruction(
        &mut self,
        entry: &'static Instruction,
        operand_count: usize,
        word: Span,
    ) {
        let mut mnemonic_span = word;
        let is_at_relation = self.lexer.ahead() == Ahead::Text && self.lexer.is_at_relation();
        let text = word.text(self.text);
        // OR= compares reals, but there is no OR; LDS is a stack operation, but LDS= compares
        // texts.
        if entry.has_relation() && !is_at_relation && foreign::is_known(text) {
            return self.unknown(word);
        }
        let compares =
            if is_at_relation && !entry.has_relation() { comparison(text) } else { None };
        let (entry, operand_count) =
            compares.map_or((entry, operand_count), |entry| (entry, written_operands(entry)));
        let relation = match (entry.has_relation(), is_at_relation) {
            (true, true) => {
                let sign = self.lexer.relation();
                mnemonic_span.end = sign.end;
                Some(self.relation(entry, sign))
            }
            (true, false) => {
                if self.relation_apart(word) {
                    return;
                }
                self.relation_missing(entry, word);
                Some(Relation::Equal)
            }
            (false, true) => return self.wrong_relation(word),
            (false, false) => None,
        };
        let pending = self.pending.len();
        let mut operands = self.operands(entry, operand_count);
        if operands.len() + 1 == operand_count && self.lexer.ahead() == Ahead::Semicolon {
            operands.extend(self.operand_after_semicolon(entry, operands.len()));
        }
        if self.is_habit(entry, word, &operands) {
            self.pending.truncate(pending);
            return;
        }
        if entry.op == Op::End && !operands.is_empty() {
            // `END OF PROGRAM`: what the words are need not be told.
            self.pending.truncate(pending);
            operands.iter_mut().for_each(|operand| operand.value = NOT_READ);
        }
        let end = operands.last().map_or(mnemonic_span.end, |operand| operand.span.end);
        if entry.has_relation() && !is_at_relation {
            // One error is enough.
            operands.resize(operand_count, Operand { span: word, value: Value::Invalid });
        }
        let span = Span { start: word.start, end };
        let instruction = ast::Instruction { entry, relation, mnemonic_span, operands, span };
        self.program.statements.push(Statement::Instruction(instruction));
    }

    /// What is before the place where the text is read. What was not understood is nothing.
    pub(crate) fn flow(&self) -> Flow {
        match self.program.statements.last() {
            Some(Statement::Instruction(last)) if is_stand_in(last) => Flow::None,
            Some(Statement::Instruction(last)) if last.entry.rung.is_contact() => Flow::Contact,
            Some(Statement::Instruction(_)) => Flow::Done,
            _ => Flow::None,
        }
    }

    /// An instruction of the S7-200 that no Uno can execute.
    pub(crate) fn refused(&mut self, word: Span) {
        // SPA is a jump on other controllers, and then has a label only.
        let is_foreign = foreign::is_known(word.text(self.text));
        if is_foreign && !self.lexer.line_ahead().contains(',') {
            return self.unknown(word);
        }
        self.diagnostics.extend(refused::refused(word.text(self.text), word));
        self.lexer.skip_instruction();
    }

    /// A return without condition: it is at the end of its unit, if at all.
    pub(crate) fn unconditional_return(&mut self, kind: UnitKind, word: Span) {
        let text = word.text(self.text).to_ascii_uppercase();
        let unit = self.program.units().last().map(|(_, unit)| unit.id.kind);
        if unit == Some(kind) {
            self.unit_end = Some(word);
        } else {
            let what =
                if kind == UnitKind::Interrupt { "an interrupt routine" } else { "a subroutine" };
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
            let message =
                format!("{text} returns without condition: what follows is never executed");
            let help = format!("C{text} returns with power flow");
            self.diagnostics.push(Diagnostic::new(Code::WrongUnit, word, message).help(help));
        }
    }

    /// A first word that is none.
    pub(crate) fn unknown(&mut self, word: Span) {
        if self.parameters_apart(word) {
            return;
        }
        let flow = self.flow();
        let text = self.text.get(word.start as usize..).unwrap_or("");
        if let Some(way) = foreign::together(text, flow) {
            return self.together(word, way);
        }
        let text = word.text(self.text);
        if foreign::is_block(text) && !self.blocks.foreign(text) {
            return self.lexer.skip_instruction();
        }
        let relation = self.lexer.is_at_relation() && text.starts_with(is_word_start);
        let relation = relation.then(|| self.lexer.relation());
        let (line, rest) = self.rest_of(word);
        let mut diagnostic = match foreign::look_alike(text) {
            Some((sign, meant, _)) => Diagnostic::new(
                Code::UnknownMnemonic,
                word,
                format!("{text}: {sign} is another character than {meant}"),
            ),
            None => self.unknown_word(word),
        };
        let stand_in = match foreign::meant(text, rest) {
            Some(meant) => understood(&mut diagnostic, self.as_first(meant), line),
            None => self.misspelt(&mut diagnostic, relation, rest),
        };
        let span = diagnostic.span;
        self.diagnostics.push(diagnostic);
        let likely = stand_in.as_deref().and_then(instruction_of);
        let operands = rest.get(relation.map_or(0, |sign| sign.text(self.text).len())..);
        let operands = operands.unwrap_or("").trim();
        match likely.filter(|(entry, _)| is_likely(entry.op, operands)) {
            Some((entry, count)) => self.stand_in(entry, count, span),
            None => self.first_stand_in(span),
        }
    }

    /// What was meant, where a rung may begin: its first contact is a load.
    fn as_first(&self, mut meant: Meant) -> Meant {
        if let (true, Some(Instead::Word(word))) = (self.begins_rung(), &meant.instead) {
            let load = match word.as_str() {
                "A" | "O" => "LD",
                "AN" | "ON" => "LDN",
                _ => return meant,
            };
            meant.instead = Some(Instead::Word(load.to_owned()));
            meant.stand_in = Some(load.to_owned());
        }
        meant
    }

    /// Lines of another language that only mean something together: one mistake.
    pub(crate) fn together(&mut self, word: Span, found: Together) {
        let end = word.start as usize + found.len;
        self.lexer.go_on(end);
        let span = Span { start: word.start, end: end as u32 };
        let code: Vec<String> = found.code.iter().map(|line| format!("`{line}`")).collect();
        let mut diagnostic = Diagnostic::new(Code::UnknownMnemonic, word, found.message);
        if !code.is_empty() {
            let help = format!("on an S7-200 these lines are {}", code.join(", "));
            diagnostic.help.push(help);
        }
        diagnostic.help.extend(found.help);
        self.diagnostics.push(diagnostic);
        match found.stand_in.and_then(instruction_of) {
            Some((entry, count)) => self.stand_in(entry, count, span),
            None => self.first_stand_in(span),
        }
    }

    /// Puts a load in place of something unknown that begins a rung: what follows is not reported
    /// for its missing load.
    pub(crate) fn first_stand_in(&mut self, span: Span) {
        if let (true, Some((load, count))) = (self.begins_rung(), instruction_of("LD")) {
            self.stand_in(load, count, span);
        }
    }

    /// Whether nothing is between here and the beginning of the network.
    fn begins_rung(&self) -> bool {
        !matches!(self.program.statements.last(), Some(Statement::Instruction(_)))
    }

    /// An instruction of the table that is written like structured text.
    pub(crate) fn structured(&mut self, word: Span) {
        let flow = self.flow();
        let text = self.text.get(word.start as usize..).unwrap_or("");
        let way = foreign::brackets(text, flow);
        let text = word.text(self.text);
        let (line, rest) = self.rest_of(word);
        if let Some(way) = way {
            return self.together(line, way);
        }
        let message = match rest.trim() {
            "(" => format!("{text}(: no such instruction"),
            _ => format!("{}: an instruction is its mnemonic and operands", line.text(self.text)),
        };
        let code = if rest.trim() == "(" { Code::UnknownMnemonic } else { Code::Syntax };
        let mut diagnostic = Diagnostic::new(code, line, message);
        let meant = foreign::meant(text, rest);
        let stand_in = meant.and_then(|meant| understood(&mut diagnostic, meant, line));
        self.diagnostics.push(diagnostic);
        match stand_in.as_deref().and_then(instruction_of) {
            Some((entry, count)) => self.stand_in(entry, count, line),
            None => self.first_stand_in(line),
        }
    }

    /// The whole instruction that begins with a word, and what is after the word. It is skipped.
    pub(crate) fn rest_of(&mut self, word: Span) -> (Span, &'s str) {
        self.lexer.skip_instruction();
        let line = self.trimmed(word.start as usize, self.lexer.position());
        let line = Span { end: line.end.max(word.end), ..line };
        (line, self.text.get(word.end as usize..line.end as usize).unwrap_or(""))
    }

    fn unknown_word(&self, word: Span) -> Diagnostic {
        let text = word.text(self.text);
        if matches!(text, "*)" | "*/") {
            return Diagnostic::new(Code::Syntax, word, format!("{text}: no comment is open here"))
                .help("leave it out, or begin the comment with (* or /*");
        }
        if text == ":=" {
            let message = format!("{text}: a coil is `=`, and a value is copied by `MOVW`");
            return Diagnostic::new(Code::Syntax, word, message).suggest("=");
        }
        if !text.starts_with(is_word_start) && !foreign::is_known(text) {
            return Diagnostic::new(
                Code::Syntax,
                word,
                format!("{text}: an instruction begins with its mnemonic"),
            );
        }
        let mut diagnostic =
            Diagnostic::new(Code::UnknownMnemonic, word, format!("{text}: no such instruction"));
        if text.ends_with(':') {
            diagnostic.help.push("a label is an instruction of its own, such as LBL 1".to_owned());
        }
        diagnostic
    }

    /// Suggests what a word may be a misspelling of, and says which mnemonic that is.
    fn misspelt(
        &self,
        diagnostic: &mut Diagnostic,
        relation: Option<Span>,
        rest: &str,
    ) -> Option<String> {
        let text = diagnostic.span.text(self.text);
        let before = self.text.get(..diagnostic.span.start as usize).unwrap_or("");
        if before.trim_end_matches([' ', '\t']).ends_with(';') {
            diagnostic.help.push("a comment begins with //".to_owned());
        }
        if let Some(sign) = relation {
            diagnostic.span.end = sign.end;
            diagnostic.message =
                format!("{}: no such instruction", diagnostic.span.text(self.text));
            let near = self.suggester.nearest(text, comparisons())?;
            let near = foreign::sized(near, rest).unwrap_or(near);
            diagnostic.suggestion = Some(format!("{near}{}", sign.text(self.text)));
            return Some(near.to_owned());
        }
        if diagnostic.code == Code::Syntax {
            if diagnostic.help.is_empty() && diagnostic.suggestion.is_none() {
                diagnostic.help.push(WHERE_ALL_ARE.to_owned());
            }
            return None;
        }
        // What is before a colon is the name of a label, but for the word itself.
        let is_label = text.ends_with(':') && !text.eq_ignore_ascii_case("LBL:");
        let near = || {
            let near = self.suggester.nearest_mnemonic(text, first_words())?;
            let near = foreign::sized(near, rest).unwrap_or(near);
            let is_likely =
                instruction_of(near).is_none_or(|(entry, _)| is_likely(entry.op, rest.trim()));
            is_likely.then(|| near.to_owned())
        };
        let suggestion = without_blank(text).or_else(|| near().filter(|_| !is_label));
        if suggestion.is_none() && diagnostic.help.is_empty() {
            diagnostic.help.push(WHERE_ALL_ARE.to_owned());
        }
        diagnostic.suggestion = suggestion;
        diagnostic.suggestion.as_deref()?.split(' ').next().map(str::to_owned)
    }

    /// A comparison after an instruction that takes none, such as `LD>=`.
    fn wrong_relation(&mut self, word: Span) {
        let text = word.text(self.text);
        let sign = self.lexer.relation();
        let span = Span { start: word.start, end: sign.end };
        let message = format!("{}: no such instruction", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownMnemonic, span, message);
        let upper = text.to_ascii_uppercase();
        let rest = self.lexer.line_ahead();
        let sized = foreign::sized(&format!("{upper}W"), rest).and_then(compare_like);
        // `LDI>`: the letter of another list.
        let lettered = upper.strip_suffix('I').map(|contact| format!("{contact}W"));
        let compare = sized
            .or_else(|| compare_like(&format!("{upper}W")))
            .or_else(|| compare_like(lettered.as_deref()?));
        if let Some(help) = coil_with_sign(&upper, sign.text(self.text)) {
            self.diagnostics.push(diagnostic.help(help));
            self.lexer.skip_instruction();
            return;
        }
        // `A !I0.1`
        let negated = sign.text(self.text) == "!";
        let negated =
            negated.then(|| format!("{upper}N")).filter(|name| instruction_of(name).is_some());
        if let Some(negated) = &negated {
            diagnostic.help.push(format!("`{negated}` takes the inverted bit, without a sign"));
        } else if let Some(compare) = compare {
            diagnostic.suggestion = Some(format!("{}{}", compare.mnemonic(), sign.text(self.text)));
        }
        self.diagnostics.push(diagnostic);
        self.lexer.skip_instruction();
        match compare {
            Some(compare) => self.stand_in(compare, written_operands(compare), span),
            None => self.first_stand_in(span),
        }
    }

    /// The comparison that is written. What the instruction does not know is reported where its
    /// operands are.
    fn relation(&mut self, entry: &Instruction, sign: Span) -> Relation {
        let text = sign.text(self.text);
        if let Some(relation) = Relation::ALL.into_iter().find(|relation| relation.symbol() == text)
        {
            return relation;
        }
        let possible = entry.relations();
        let all = possible.iter().map(|relation| relation.symbol()).collect::<Vec<_>>().join(" ");
        let message = format!("{text}: no such comparison; there are {all}");
        let mut diagnostic = Diagnostic::new(Code::Syntax, sign, message);
        let meant = [("==", "="), ("=>", ">="), ("=<", "<="), ("!=", "<>"), ("><", "<>")];
        diagnostic.suggestion = meant
            .iter()
            .find(|(wrong, right)| {
                *wrong == text && possible.iter().any(|relation| relation.symbol() == *right)
            })
            .map(|(_, right)| (*right).to_owned());
        self.diagnostics.push(diagnostic);
        Relation::Equal
    }

    fn relation_missing(&mut self, entry: &Instruction, word: Span) {
        let text = word.text(self.text);
        let all = entry.relations().iter().map(|relation| format!("{text}{}", relation.symbol()));
        let all = all.collect::<Vec<_>>().join(" ");
        let diagnostic =
            Diagnostic::new(Code::Syntax, word, format!("{text}: the comparison is missing"));
        let comparisons = format!("there are {all}");
        // `AB I0.1`
        let first = self.lexer.line_ahead().trim_start().split([' ', '\t', ',']).next();
        if let (Some(bit), Some(contact)) = (first, text.get(..text.len() - 1))
            && foreign::is_bit(bit)
        {
            let contact = contact.to_ascii_uppercase();
            self.diagnostics
                .push(diagnostic.suggest(contact).help("the contact of one bit has no letter"));
            return;
        }
        let comparisons = match self.lexer.line_ahead().trim() {
            "" => comparisons,
            operands => format!("{comparisons}, such as `{text}= {operands}`"),
        };
        self.diagnostics.push(match self.word_logic(text) {
            // Where accumulators are, it has no operands.
            Some(logic) => diagnostic
                .help(format!("the bits of two values are combined by `{logic}`, which names both"))
                .help(format!("comparisons: {comparisons}")),
            None => diagnostic.help(comparisons),
        });
    }

    /// What AW and its like are on controllers with accumulators.
    fn word_logic(&self, mnemonic: &str) -> Option<&'static str> {
        Some(match mnemonic.to_ascii_uppercase().as_str() {
            "AW" | "UW" => "ANDW",
            "AD" | "UD" => "ANDD",
            "OW" => "ORW",
            "OD" => "ORD",
            _ => return None,
        })
    }

    /// Puts an instruction in place of one that was reported, so that the logic stack and the pairs
    /// of the following lines are not reported because of it.
    pub(crate) fn stand_in(
        &mut self,
        entry: &'static Instruction,
        operand_count: usize,
        span: Span,
    ) {
        let relation = entry.has_relation().then_some(Relation::Equal);
        let operands = vec![Operand { span, value: Value::Invalid }; operand_count];
        let instruction = ast::Instruction { entry, relation, mnemonic_span: span, operands, span };
        self.program.statements.push(Statement::Instruction(instruction));
    }

    /// The operands up to the end of the instruction. `count` is how many are expected.
    fn operands(&mut self, entry: &Instruction, count: usize) -> Vec<Operand> {
        let mut operands = Vec::with_capacity(count);
        let mut comma = None;
        loop {
            match self.lexer.ahead() {
                // More than any instruction takes: they are counted, but not read, because one
                // error about their number is enough.
                Ahead::Text if operands.len() > OPERANDS_KEPT => {
                    let (Cut::Whole(span) | Cut::Unclosed(span)) = self.lexer.operand();
                    operands.push(Operand { span, value: NOT_READ });
                    comma = None;
                }
                Ahead::Text => {
                    let cut = self.lexer.operand();
                    let operand = self.operand(cut, entry, operands.len());
                    operands.push(operand);
                    comma = None;
                }
                Ahead::Comma => {
                    let at = self.lexer.position();
                    let span = Span::new(at, at + 1);
                    if operands.is_empty() || comma.is_some() {
                        let message = ",: an operand is missing before the comma";
                        self.diagnostics
                            .push(Diagnostic::new(Code::Syntax, span, message).help(ONE_COMMA));
                        operands.push(Operand { span, value: Value::Invalid });
                    }
                    comma = Some(span);
                    self.lexer.step();
                }
                _ => break,
            }
        }
        if let Some(span) = comma.filter(|_| !operands.is_empty()) {
            let message = ",: an operand is missing after the comma";
            self.diagnostics.push(Diagnostic::new(Code::Syntax, span, message).help(ONE_COMMA));
            operands.push(Operand { span, value: Value::Invalid });
        }
        operands
    }

    pub(crate) fn operand(&mut self, cut: Cut, entry: &Instruction, index: usize) -> Operand {
        let span = match cut {
            Cut::Whole(span) => span,
            Cut::Unclosed(span) => {
                let message =
                    format!("{}: the quote is not closed", span.text(self.text).trim_end());
                self.error(Code::Syntax, span, message);
                return Operand { span, value: Value::Invalid };
            }
        };
        let plain = if routine_kind(entry.op, index).is_none() {
            read_plain(span.text(self.text))
        } else {
            None
        };
        let value = plain.unwrap_or_else(|| {
            self.pending.push(Pending { statement: self.program.statements.len(), operand: index });
            Value::Invalid
        });
        Operand { span, value }
    }
}

/// Whether it stands for lines that were not understood at the beginning of a rung.
fn is_stand_in(instruction: &ast::Instruction) -> bool {
    let is_empty = |operand: &Operand| {
        operand.value == Value::Invalid && operand.span == instruction.mnemonic_span
    };
    instruction.entry.op == Op::Ld && instruction.operands.iter().all(is_empty)
}

/// `= !Q0.0`, `=> Q0.0`, `S= Q0.0`: what a coil is with a sign that it has not.
fn coil_with_sign(mnemonic: &str, sign: &str) -> Option<&'static str> {
    Some(match (mnemonic, sign) {
        ("=", "!") => "a coil does not invert: `NOT`, then `= Q0.0`",
        ("=", _) => "a coil is `= Q0.0`; a comparison is a contact, such as `LDW>= VW0, 5`",
        ("S", _) => "a bit is set by `S Q0.0, 1`, with the number of bits",
        ("R", _) => "a bit is reset by `R Q0.0, 1`, with the number of bits",
        _ => return None,
    })
}

/// Whether a guessed instruction fits its operands. Only asked where a wrong guess would do harm
/// further down.
fn is_likely(op: Op, operands: &str) -> bool {
    match op {
        Op::For => operands.matches(',').count() == 2,
        Op::Next => operands.is_empty(),
        Op::Lbl | Op::Jmp => {
            !operands.is_empty() && operands.bytes().all(|byte| byte.is_ascii_digit())
        }
        _ => true,
    }
}

const ONE_COMMA: &str = "one comma is between two operands, none before the first and after the \
     last";

/// Where nothing is near enough.
const WHERE_ALL_ARE: &str = "an instruction begins with its mnemonic, such as `LD`, `=` or `MOVW`; \
     docs/instructions.md lists all of them, and a comment begins with //";

fn instruction_of(word: &str) -> Option<(&'static Instruction, usize)> {
    match meaning(word) {
        Some(Meaning::Instruction(entry, count)) => Some((entry, count)),
        _ => None,
    }
}

/// Says what was meant, and which mnemonic that is.
fn understood(diagnostic: &mut Diagnostic, meant: Meant, line: Span) -> Option<String> {
    diagnostic.help.extend(meant.help);
    match meant.instead {
        Some(Instead::Word(word)) => diagnostic.suggestion = Some(word),
        Some(Instead::Line(text)) => {
            diagnostic.span = line;
            diagnostic.suggestion = Some(text);
        }
        None => {}
    }
    meant.stand_in
}

fn is_word_start(character: char) -> bool {
    character.is_alphanumeric()
        || !character.is_ascii()
        || matches!(character, '_' | '+' | '-' | '*' | '/' | '=')
}

/// The entry of a comparison.
pub(crate) fn compare_like(mnemonic: &str) -> Option<&'static Instruction> {
    match meaning(mnemonic) {
        Some(Meaning::Instruction(entry, _)) if entry.has_relation() => Some(entry),
        _ => None,
    }
}

/// `LDI0.0` as `LD I0.0`: mnemonic and operand without the blank between them.
fn without_blank(text: &str) -> Option<String> {
    (1..text.len().min(8)).rev().find_map(|len| {
        let (mnemonic, operand) = text.split_at_checked(len)?;
        match (meaning(mnemonic)?, read_plain(operand)?) {
            // `LDI0.1` is no LDI of a real.
            (_, Value::Real(_)) => None,
            (Meaning::Instruction(entry, count), value) if count > 0 && !entry.has_relation() => {
                // `TON37` and `CTU1` lack their letter.
                let letter = match (entry.op, value) {
                    (Op::Ton | Op::Tof | Op::Tonr, Value::Constant(_)) => "T",
                    (Op::Ctu | Op::Ctd | Op::Ctud, Value::Constant(_)) => "C",
                    _ => "",
                };
                Some(format!("{} {letter}{operand}", mnemonic.to_ascii_uppercase()))
            }
            (Meaning::Keyword(Keyword::Network), Value::Constant(_)) => {
                Some(format!("NETWORK {operand}"))
            }
            _ => None,
        }
    })
}
