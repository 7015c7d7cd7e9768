//! What the operands of a program mean: constants and addresses at once, symbols when all of them are known.

use crate::address::{Address, AddressError};
use crate::ast::{Instruction, Program, Span, Statement, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::literal::{self, LiteralError};
use crate::mnemonics::{Meaning, confused, meaning};
use crate::suggest::{Suggester, nearby_address};
use crate::symbols::{Found, SymbolTable};

/// An operand that is a symbol, or wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Pending {
    /// Index of its statement.
    pub(crate) statement: usize,
    /// Its index among the operands.
    pub(crate) operand: usize,
}

/// Reads an operand that needs no symbol; `None` if it may be a symbol, or is wrong.
pub(crate) fn read_plain(text: &str) -> Option<Value> {
    if literal::looks_like_literal(text) {
        return literal::parse(text).ok().map(Value::Constant);
    }
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return None;
    }
    match Address::parse(text) {
        // A symbol may have the name of a German address: that is decided when all symbols are known.
        Ok(address) if is_german(text, address) => None,
        Ok(address) => Some(Value::Address(address)),
        Err(_) => literal::truth_value(text).map(Value::Constant),
    }
}

/// Whether an address is written with a German area letter, such as E0.0 or Z1.
pub(crate) fn is_german(text: &str, address: Address) -> bool {
    let letter = address.to_string().chars().next();
    text.chars().next().map(|c| c.to_ascii_uppercase()) != letter
}

/// Settles the operands that were left open.
pub(crate) struct Resolver<'p> {
    pub(crate) text: &'p str,
    pub(crate) symbols: &'p SymbolTable,
    pub(crate) suggester: &'p Suggester,
}

impl Resolver<'_> {
    /// Gives every pending operand its value, or an error.
    pub(crate) fn resolve(&self, program: &mut Program, pending: &[Pending], diagnostics: &mut Vec<Diagnostic>) {
        let mut buffer = String::new();
        let mut settled = None;
        // From the end, because joining two operands moves those behind them.
        for &pending in pending.iter().rev() {
            let Some(Statement::Instruction(instruction)) = program.statements.get_mut(pending.statement) else {
                continue;
            };
            if settled == Some(pending) {
                continue;
            }
            if let Some((first, diagnostic)) = self.join(instruction, pending.operand) {
                settled = Some(Pending { operand: first, ..pending });
                diagnostics.push(diagnostic);
                continue;
            }
            let Some(operand) = instruction.operands.get_mut(pending.operand) else { continue };
            match self.value(operand.span, &mut buffer) {
                Ok(value) => operand.value = value,
                Err(diagnostic) => diagnostics.push(*diagnostic),
            }
        }
    }

    /// Joins two operands that are one address with a comma or blank in it, such as `I0,0` and `I 0.0`.
    fn join(&self, instruction: &mut Instruction, index: usize) -> Option<(usize, Diagnostic)> {
        match meaning(instruction.mnemonic) {
            Some(Meaning::Instruction(_, count)) if instruction.operands.len() > count => {}
            _ => return None,
        }
        let firsts = [index.checked_sub(1), Some(index)];
        let (first, span, diagnostic) = firsts.into_iter().flatten().find_map(|first| {
            let left = instruction.operands.get(first)?.span;
            let right = instruction.operands.get(first + 1)?.span;
            let span = Span { start: left.start, end: right.end };
            Some((first, span, self.joined(left, right, span)?))
        })?;
        instruction.operands.remove(first + 1);
        let operand = instruction.operands.get_mut(first)?;
        operand.span = span;
        operand.value = Value::Invalid;
        Some((first, diagnostic))
    }

    fn joined(&self, left: Span, right: Span, span: Span) -> Option<Diagnostic> {
        let between = Span { start: left.end, end: right.start }.text(self.text);
        let (left, right) = (left.text(self.text), right.text(self.text));
        let (link, why) = match between.trim() {
            "," if between == "," => (".", "a point stands before the number of the bit"),
            "" => ("", "no blank stands inside an address"),
            _ => return None,
        };
        // Only what has no meaning of its own: `Q0.0 1` is an address and a count.
        if Address::parse(left).is_ok() || Address::parse(right).is_ok() {
            return None;
        }
        let address = Address::parse(&format!("{left}{link}{right}")).ok()?;
        let message = format!("{}: {why}", span.text(self.text));
        Some(Diagnostic::new(Code::AddressRange, span, message).suggest(address.to_string()))
    }

    fn value(&self, span: Span, buffer: &mut String) -> Result<Value, Box<Diagnostic>> {
        let text = span.text(self.text);
        let quoted = text.strip_prefix('"').and_then(|inside| inside.strip_suffix('"'));
        let error = |code, message: String| Err(Box::new(Diagnostic::new(code, span, message)));
        match self.symbols.find(quoted.unwrap_or(text), buffer) {
            Some(Found::Symbol(symbol)) => return Ok(symbol.value.clone()),
            Some(Found::Ambiguous) => {
                return error(Code::SymbolDefinition, format!("{text}: symbol files give it different values"));
            }
            Some(Found::Unusable) => {
                let message = format!("{text}: the symbol stands for something that uno200 does not have yet");
                return error(Code::NotSupported, message);
            }
            None => {}
        }
        if let Some(name) = quoted {
            return Err(self.unknown_symbol(span, name, true));
        }
        match text.as_bytes() {
            [b'*' | b'&', _, ..] => error(Code::NotSupported, format!("{text}: pointers are not supported yet")),
            [b'#', _, ..] => error(Code::NotSupported, format!("{text}: local variables are not supported yet")),
            _ if literal::looks_like_literal(text) => match literal::parse(text) {
                Ok(constant) => Ok(Value::Constant(constant)),
                Err(LiteralError::Malformed(message)) => error(Code::ConstantRange, message),
                Err(LiteralError::NotSupported(message)) => error(Code::NotSupported, message),
            },
            _ => self.address(span, text),
        }
    }

    fn address(&self, span: Span, text: &str) -> Result<Value, Box<Diagnostic>> {
        match Address::parse(text) {
            Ok(address) => Ok(Value::Address(address)),
            Err(AddressError::NotSupported(message)) => {
                Err(Box::new(Diagnostic::new(Code::NotSupported, span, message)))
            }
            Err(AddressError::OutOfRange(message, suggestion)) => {
                let mut diagnostic = Diagnostic::new(Code::AddressRange, span, message);
                diagnostic.suggestion = suggestion.or_else(|| nearby_address(text));
                Err(Box::new(diagnostic))
            }
            Err(AddressError::NotAnAddress) if !text.contains(|c: char| c.is_alphanumeric()) => {
                let message = format!("{text}: neither an address nor a constant nor a symbol");
                let mut diagnostic = Diagnostic::new(Code::Syntax, span, message);
                diagnostic.help.extend(sign_hint(text).map(str::to_owned));
                Err(Box::new(diagnostic))
            }
            Err(AddressError::NotAnAddress) => Err(self.unknown_symbol(span, text, false)),
        }
    }

    fn unknown_symbol(&self, span: Span, name: &str, is_quoted: bool) -> Box<Diagnostic> {
        let message = format!("{}: no such symbol", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownSymbol, span, message);
        let near = self.suggester.nearest(name, self.symbols.names());
        diagnostic.suggestion = match near {
            Some(near) if is_quoted || !is_bare_name(near) => Some(format!("\"{near}\"")),
            Some(near) => Some(near.to_owned()),
            None => nearby_address(name),
        };
        if !is_quoted {
            diagnostic.suggestion = diagnostic.suggestion.or_else(|| label_number(name));
            diagnostic.help.extend(word_hint(name).map(str::to_owned));
        }
        Box::new(diagnostic)
    }
}

const ONE_A_LINE: &str = "one instruction stands on a line";

/// What was probably meant by a sign where an operand should be.
fn sign_hint(text: &str) -> Option<&'static str> {
    match text {
        "=" | ":=" | "==" => Some(ONE_A_LINE),
        "<" | ">" | "<=" | ">=" | "<>" => Some("words are compared by LDW> MW0, 5 and its like"),
        _ if text.starts_with(['#', '-', '–', '—']) => Some("a comment begins with //"),
        _ => None,
    }
}

/// What was probably meant by a word where an operand should be.
fn word_hint(name: &str) -> Option<&'static str> {
    if name.eq_ignore_ascii_case("NOT") {
        return Some("LDN, AN and ON take the inverted bit");
    }
    (confused(name).is_some() || meaning(name).is_some()).then_some(ONE_A_LINE)
}

/// Labels have numbers, not names: LBL1 is 1.
fn label_number(name: &str) -> Option<String> {
    let (letters, digits) = name.split_at_checked(3)?;
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    (letters.eq_ignore_ascii_case("LBL") && is_number).then(|| digits.to_owned())
}

/// Whether a symbol of this name can be written without quotes.
fn is_bare_name(name: &str) -> bool {
    name.chars().all(|c| c.is_alphanumeric() || c == '_')
}
