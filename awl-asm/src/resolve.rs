//! What the operands of a program mean: constants and addresses at once, symbols when all of them are known.

use plc_isa::{AnalogInput, Area};

use crate::address::{Address, AddressError};
use crate::ast::{Instruction, Program, Span, Statement, Unit, UnitId, UnitKind, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::literal;
use crate::locals::is_same_name;
pub(crate) use crate::locals::unit_id;
use crate::mnemonics::{Meaning, confused, meaning, takes_text};
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
        return literal::parse(text).ok();
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

/// The kind of routine that this operand of an instruction names, if it names one.
pub(crate) fn routine_kind(mnemonic: &str, operand: usize) -> Option<UnitKind> {
    match (mnemonic, operand) {
        ("CALL", 0) => Some(UnitKind::Subroutine),
        ("ATCH", 0) => Some(UnitKind::Interrupt),
        _ => None,
    }
}

/// What the place of an operand says about it.
struct Place<'p> {
    /// All units with the indices of their statements.
    units: &'p [(usize, Unit)],
    /// The unit that it stands in, if the text has blocks.
    unit: Option<&'p Unit>,
    routine: Option<UnitKind>,
    takes_text: bool,
}

impl Place<'_> {
    fn local(&self, name: &str) -> Option<Value> {
        let variable = self.unit?.variables.iter().find(|variable| is_same_name(&variable.name, name))?;
        Some(Value::Address(variable.address))
    }
}

/// What stands behind `*`.
fn pointer(span: Span, inner: Value) -> Result<Value, Box<Diagnostic>> {
    let error = |message: &str| Diagnostic::new(Code::Pointer, span, message);
    let double = |area, byte: u16| format!("*{}", Address::Double { area, byte });
    Err(Box::new(match inner {
        Value::Address(address @ Address::Double { area: Area::V | Area::L, .. }) => {
            return Ok(Value::Indirect(address));
        }
        Value::Address(address @ Address::Accumulator(1..)) => return Ok(Value::Indirect(address)),
        Value::Address(Address::Accumulator(_)) => {
            error("AC0 cannot hold a pointer").suggest("*AC1").help("pointers are held by AC1, AC2 and AC3")
        }
        Value::Address(
            Address::Byte { area: area @ (Area::V | Area::L), byte }
            | Address::Word { area: area @ (Area::V | Area::L), byte },
        ) => error("a pointer is a double word").suggest(double(area, byte)),
        Value::Invalid => return Ok(Value::Invalid),
        _ => error("a pointer is held by V or L memory or by AC1, AC2 or AC3").help("such as *VD10, *LD0 or *AC1"),
    }))
}

/// What stands behind `&`.
fn pointer_to(span: Span, inner: Value) -> Result<Value, Box<Diagnostic>> {
    let error = |message: String| Diagnostic::new(Code::Pointer, span, message);
    Err(Box::new(match inner {
        Value::Address(
            Address::Byte { area: Area::L, .. }
            | Address::Word { area: Area::L, .. }
            | Address::Double { area: Area::L, .. },
        ) => error("no pointer can lead to local memory".into()).help("keep the value in V memory"),
        Value::Address(
            Address::Byte { area, byte } | Address::Word { area, byte } | Address::Double { area, byte },
        ) => {
            return Ok(Value::AddressOf(Address::Byte { area, byte }));
        }
        Value::Address(
            address @ (Address::Timer(_)
            | Address::Counter(_)
            | Address::Analog(AnalogInput::Scaled(_))
            | Address::AnalogOutput(_)),
        ) => return Ok(Value::AddressOf(address)),
        Value::Address(address @ Address::Bit { area, byte, .. }) if area != Area::L => {
            let byte = Address::Byte { area, byte };
            error(format!("no pointer can lead to the bit {address}")).suggest(format!("&{byte}"))
        }
        Value::Address(address) => error(format!("no pointer can lead to {address}")),
        Value::Invalid => return Ok(Value::Invalid),
        _ => error("behind & stands an address, such as &VB100".into()),
    }))
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
        let units: Vec<(usize, Unit)> = program.units().map(|(index, unit)| (index, unit.clone())).collect();
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
            let own = units.partition_point(|&(start, _)| start < pending.statement).checked_sub(1);
            let place = Place {
                units: &units,
                unit: own.and_then(|own| units.get(own)).map(|(_, unit)| unit),
                routine: routine_kind(instruction.mnemonic, pending.operand),
                takes_text: takes_text(instruction.mnemonic, pending.operand),
            };
            let Some(operand) = instruction.operands.get_mut(pending.operand) else { continue };
            match self.value(operand.span, &place, &mut buffer) {
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
        if routine_kind(instruction.mnemonic, 0).is_some() {
            return None;
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

    fn value(&self, span: Span, place: &Place<'_>, buffer: &mut String) -> Result<Value, Box<Diagnostic>> {
        let text = span.text(self.text);
        let quoted = text.strip_prefix('"').and_then(|inside| inside.strip_suffix('"'));
        let error = |code, message: String| Err(Box::new(Diagnostic::new(code, span, message)));
        if let Some(kind) = place.routine {
            return self.routine(span, quoted.unwrap_or(text), kind, place, buffer);
        }
        if let Some(value) = text.strip_prefix('#').or(Some(text)).and_then(|name| place.local(name)) {
            return Ok(value);
        }
        match self.symbols.find(quoted.unwrap_or(text), buffer) {
            Some(Found::Symbol(symbol)) => return Ok(symbol.value.clone()),
            Some(Found::Ambiguous) => {
                return error(Code::SymbolDefinition, format!("{text}: symbol files give it different values"));
            }
            Some(Found::Unusable) => {
                let message = format!("{text}: the symbol stands for something that uno200 does not have");
                return error(Code::NotSupported, message);
            }
            None => {}
        }
        if let Some(name) = quoted {
            if place.takes_text {
                return literal::parse(text).or_else(|message| error(Code::ConstantRange, message));
            }
            return Err(self.unknown_symbol(span, name, true));
        }
        match text.as_bytes() {
            [b'*', _, ..] => {
                let inner = self.value(Span { start: span.start + 1, ..span }, place, buffer)?;
                pointer(span, inner)
            }
            [b'&', _, ..] => {
                let inner = self.value(Span { start: span.start + 1, ..span }, place, buffer)?;
                pointer_to(span, inner)
            }
            [b'#', _, ..] => Err(self.unknown_local(span, place)),
            _ if literal::looks_like_literal(text) => match literal::parse(text) {
                Ok(value) => Ok(value),
                Err(message) => error(Code::ConstantRange, message),
            },
            _ => self.address(span, text),
        }
    }

    /// A subroutine or interrupt routine: by number, by its name, or by a symbol.
    fn routine(
        &self,
        span: Span,
        name: &str,
        kind: UnitKind,
        place: &Place<'_>,
        buffer: &mut String,
    ) -> Result<Value, Box<Diagnostic>> {
        let units = || place.units.iter().map(|(_, unit)| unit).filter(|unit| unit.id.kind == kind);
        let numbered = || unit_id(name).or_else(|| Some(UnitId { kind, number: name.parse().ok()? }));
        let by_symbol = match self.symbols.find(name, buffer) {
            Some(Found::Symbol(symbol)) => match symbol.value {
                Value::Unit(id) => Some(id),
                _ => None,
            },
            _ => None,
        };
        let named = units().find(|unit| is_same_name(&unit.name, name)).map(|unit| unit.id);
        if let Some(id) = named.or(by_symbol).or_else(numbered).filter(|id| units().any(|unit| unit.id == *id)) {
            return Ok(Value::Unit(id));
        }
        let what = if kind == UnitKind::Interrupt { "interrupt routine" } else { "subroutine" };
        let message = format!("{}: there is no such {what}", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownRoutine, span, message);
        let known: Vec<String> = units().flat_map(|unit| [unit.name.clone(), unit.id.to_string()]).collect();
        let near = self.suggester.nearest(name, known.iter().map(String::as_str).filter(|name| !name.is_empty()));
        diagnostic.suggestion = near.map(str::to_owned);
        if known.is_empty() {
            diagnostic.help.push(format!("the program has no {what}"));
        }
        Err(Box::new(diagnostic))
    }

    fn unknown_local(&self, span: Span, place: &Place<'_>) -> Box<Diagnostic> {
        let text = span.text(self.text);
        let mut diagnostic = Diagnostic::new(Code::UnknownSymbol, span, format!("{text}: no such local variable"));
        let names = place.unit.iter().flat_map(|unit| &unit.variables).map(|variable| variable.name.as_str());
        let near = self.suggester.nearest(text.trim_start_matches('#'), names);
        diagnostic.suggestion = near.map(|near| format!("#{near}"));
        Box::new(diagnostic)
    }

    fn address(&self, span: Span, text: &str) -> Result<Value, Box<Diagnostic>> {
        if let Some(diagnostic) = part_of_analog(span, text) {
            return Err(Box::new(diagnostic));
        }
        match Address::parse(text) {
            Ok(address) => Ok(Value::Address(address)),
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

/// A bit, byte or double word of an analog input or output, which are words.
fn part_of_analog(span: Span, text: &str) -> Option<Diagnostic> {
    let (letters, number) = text.split_at(text.find(|c: char| c.is_ascii_digit())?);
    let letters = letters.to_ascii_uppercase();
    let has_bit = number.contains('.');
    let (what, prefix) = match (letters.as_str(), has_bit) {
        ("AI" | "AIW" | "AE" | "AEW", true) | ("AIB" | "AID" | "AEB" | "AED", _) => ("input", "AIW"),
        ("AQ" | "AQW" | "AA" | "AAW", true) | ("AQB" | "AQD" | "AAB" | "AAD", _) => ("output", "AQW"),
        _ => return None,
    };
    let word = Address::parse(&format!("{prefix}{}", number.split('.').next()?)).ok()?;
    let diagnostic = |message: String| Diagnostic::new(Code::AddressRange, span, message);
    if !has_bit {
        return Some(diagnostic(format!("{text}: an analog {what} is a word")).suggest(word.to_string()));
    }
    let diagnostic = diagnostic(format!("{text}: an analog {what} is a word and has no bits"));
    Some(match what {
        "input" => diagnostic.help(format!("compare it, for example `LDW>= {word}, 16000`")),
        _ => diagnostic.help(format!("write all of it, for example `MOVW 16000, {word}`")),
    })
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
