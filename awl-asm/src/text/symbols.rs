//! Symbols: what they may be called and stand for, and the table that finds them by name. Where
//! they are used is not known here.

mod file;

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::{Address, AddressError};
use crate::text::ast::{Name, Named, Span, Symbol, UnitId, UnitKind, Value};
use crate::text::literal;
use crate::text::suggest::nearby_address;
pub use file::{load, load_placed};

/// Symbols by name, letter case aside.
#[derive(Debug, Default)]
pub(crate) struct SymbolTable {
    symbols: Vec<Symbol>,
    by_name: HashMap<String, Entry>,
    /// Where the text declares them.
    names: Vec<Name>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    index: usize,
    place: Option<Span>,
    /// Symbol files disagree about the value.
    is_ambiguous: bool,
}

/// What a name stands for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Found<'t> {
    /// A symbol, and its number in the order of their definition.
    Symbol(u32, &'t Symbol),
    /// A symbol to which two files give different values.
    Ambiguous,
    /// A symbol of a file for something that is no operand.
    Unusable,
}

impl SymbolTable {
    /// A table of symbols from files. Two that disagree are an error where they are used.
    pub(crate) fn of_files(symbols: Vec<Symbol>) -> Self {
        let mut table = SymbolTable::default();
        for symbol in symbols {
            let key = symbol.name.to_lowercase();
            if table.define(symbol, None).is_some()
                && let Some(entry) = table.by_name.get_mut(&key)
            {
                entry.is_ambiguous = true;
            }
        }
        table
    }

    /// Adds a symbol. A second one of the same name must have the same value.
    pub(crate) fn define(&mut self, symbol: Symbol, place: Option<Span>) -> Option<Diagnostic> {
        let key = symbol.name.to_lowercase();
        let known = self.by_name.get(&key).map_or(self.symbols.len(), |entry| entry.index);
        self.add_name(known, place);
        let Some(entry) = self.by_name.get(&key) else {
            let entry = Entry { index: self.symbols.len(), place, is_ambiguous: false };
            self.by_name.insert(key, entry);
            self.symbols.push(symbol);
            return None;
        };
        let first = self.symbols.get(entry.index)?;
        if first.value == symbol.value || symbol.value == Value::Invalid {
            return None;
        }
        let message = format!("{}: is already {}", symbol.name, words_of(&first.value));
        let diagnostic =
            Diagnostic::new(Code::SymbolDefinition, place.unwrap_or_default(), message);
        Some(match entry.place {
            Some(first_place) => diagnostic
                .related(first_place, "first defined here")
                .help("leave one of the two out, or give it another name"),
            None => diagnostic.help("it is defined in a symbol file"),
        })
    }

    /// Notes where a symbol is declared; the elements of an array are where the array is.
    fn add_name(&mut self, symbol: usize, place: Option<Span>) {
        let Some(span) = place else { return };
        if self.names.last().is_none_or(|last| last.span != span) {
            let of = Named::Symbol(symbol as u32);
            self.names.push(Name { span, of, declares: true });
        }
    }

    /// Finds a name. `buffer` is room for its lower-case form, kept between calls.
    pub(crate) fn find(&self, name: &str, buffer: &mut String) -> Option<Found<'_>> {
        buffer.clear();
        if name.is_ascii() {
            buffer.push_str(name);
            buffer.make_ascii_lowercase();
        } else {
            buffer.push_str(&name.to_lowercase());
        }
        let entry = self.by_name.get(buffer.as_str())?;
        let symbol = self.symbols.get(entry.index)?;
        Some(match symbol.value {
            _ if entry.is_ambiguous => Found::Ambiguous,
            Value::Invalid if entry.place.is_none() => Found::Unusable,
            _ => Found::Symbol(entry.index as u32, symbol),
        })
    }

    /// All names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.symbols.iter().map(|symbol| symbol.name.as_str())
    }

    /// The symbols in the order of their definition, and where they are declared.
    pub(crate) fn into_parts(self) -> (Vec<Symbol>, Vec<Name>) {
        (self.symbols, self.names)
    }
}

fn words_of(value: &Value) -> String {
    match value {
        Value::Address(address) => address.to_string(),
        Value::Constant(constant) => constant.value.to_string(),
        Value::Unit(unit) => unit.to_string(),
        Value::Real(bits) => format!("{:?}", f32::from_bits(*bits)),
        Value::Indirect(address) => format!("*{address}"),
        Value::AddressOf(address) => format!("&{address}"),
        Value::Text(_) | Value::Invalid => "defined".to_owned(),
    }
}

/// A symbol's name as it is written in a program: in quotes where it needs them.
pub fn written(name: &str) -> String {
    let is_bare = name.chars().all(|c| c.is_alphanumeric() || c == '_');
    if is_bare { name.to_owned() } else { format!("\"{name}\"") }
}

/// Refuses a name that could never be used, because it reads as something else.
pub fn check_name(name: &str, place: Span) -> Result<(), Box<Diagnostic>> {
    let error =
        |message: String| Err(Box::new(Diagnostic::new(Code::SymbolDefinition, place, message)));
    if name.is_empty() {
        return error("the name of the symbol is missing".to_owned());
    }
    // Z1 and A1.0 are likely names of valves; programs with German addresses do not use them as
    // such.
    if Address::parse(name).is_ok_and(|address| !address.is_german(name)) {
        let message = format!("{name}: a symbol cannot be named like an address");
        let other = format!("another name can be `{}_`", name.replace('.', "_"));
        let help = format!("{other}; the name is first, then what it stands for: `Start {name}`");
        return Err(Box::new(Diagnostic::new(Code::SymbolDefinition, place, message).help(help)));
    }
    if literal::truth_value(name).is_some()
        || literal::looks_like_literal(name) && literal::parse(name).is_ok()
    {
        return error(format!("{name}: a symbol cannot be named like a constant"));
    }
    Ok(())
}

/// Reads what a symbol stands for.
pub(crate) fn read_value(text: &str, place: Span) -> Result<Value, Box<Diagnostic>> {
    let error = |code, message: String| Box::new(Diagnostic::new(code, place, message));
    if literal::looks_like_literal(text) {
        return match literal::parse(text) {
            Ok(value) => Ok(value),
            Err(message) => Err(error(Code::SymbolDefinition, message)),
        };
    }
    match Address::parse(text) {
        Ok(address) => Ok(Value::Address(address)),
        Err(AddressError::OutOfRange(message, suggestion)) => {
            let mut diagnostic = error(Code::SymbolDefinition, message);
            diagnostic.suggestion = suggestion.or_else(|| nearby_address(text));
            Err(diagnostic)
        }
        Err(AddressError::NotAnAddress) => {
            match (
                literal::truth_value(text),
                UnitId::parse(text).filter(|unit| unit.kind != UnitKind::Main),
            ) {
                (Some(constant), _) => Ok(Value::Constant(constant)),
                (None, Some(unit)) => Ok(Value::Unit(unit)),
                (None, None) => {
                    let mut diagnostic = error(
                        Code::SymbolDefinition,
                        format!("{text}: a symbol stands for an address or a constant"),
                    );
                    diagnostic.suggestion = nearby_address(text);
                    if text.starts_with(['=', ':']) {
                        let help = "nothing is between name and address: `Start I0.0`";
                        diagnostic.help.push(help.to_owned());
                    }
                    Err(diagnostic)
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "symbols_tests.rs"]
mod tests;
