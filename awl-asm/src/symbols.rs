//! Symbols: files that declare them, and the table that finds them by name. Where they are used is not known here.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::address::{Address, AddressError};
use crate::ast::{Span, Symbol, UnitKind, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::literal;
use crate::locals::unit_id;
use crate::resolve::is_german;
use crate::source::Source;
use crate::suggest::nearby_address;

/// Reads a symbol file: a symbol a line, with name, address, routine or constant, and comment, separated by tabs, commas
/// or semicolons, as Micro/WIN copies and shows its table. The spans of the diagnostics are places in this source.
pub fn load(source: &Source) -> (Vec<Symbol>, Vec<Diagnostic>) {
    let mut table = SymbolTable::default();
    let mut diagnostics = Vec::new();
    let mut is_first = true;
    for line in 1..=source.line_count() {
        let span = source.line_span(line);
        let text = span.text(&source.text);
        if text.trim().is_empty() || text.trim_start().starts_with("//") {
            continue;
        }
        match read_line(text, span.start as usize, is_first) {
            Ok(Some((symbol, place))) => diagnostics.extend(table.define(symbol, Some(place))),
            Ok(None) => {}
            Err(diagnostic) => diagnostics.push(*diagnostic),
        }
        is_first = false;
    }
    (table.into_symbols(), diagnostics)
}

/// Symbols by name, letter case aside.
#[derive(Debug, Default)]
pub(crate) struct SymbolTable {
    symbols: Vec<Symbol>,
    by_name: HashMap<String, Entry>,
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
    /// A symbol.
    Symbol(&'t Symbol),
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
        let diagnostic = Diagnostic::new(Code::SymbolDefinition, place.unwrap_or_default(), message);
        Some(match entry.place {
            Some(first_place) => diagnostic.related(first_place, "first defined here"),
            None => diagnostic.help("it is defined in a symbol file"),
        })
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
            _ => Found::Symbol(symbol),
        })
    }

    /// All names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.symbols.iter().map(|symbol| symbol.name.as_str())
    }

    /// The symbols in the order of their definition.
    pub(crate) fn into_symbols(self) -> Vec<Symbol> {
        self.symbols
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

/// Refuses a name that could never be used, because it reads as something else.
pub(crate) fn check_name(name: &str, place: Span) -> Result<(), Box<Diagnostic>> {
    let error = |message: String| Err(Box::new(Diagnostic::new(Code::SymbolDefinition, place, message)));
    if name.is_empty() {
        return error("the name of the symbol is missing".to_owned());
    }
    // Z1 and A1.0 are likely names of valves; programs with German addresses do not use them as such.
    if Address::parse(name).is_ok_and(|address| !is_german(name, address)) {
        return error(format!("{name}: a symbol cannot be named like an address"));
    }
    if literal::truth_value(name).is_some() || literal::looks_like_literal(name) && literal::parse(name).is_ok() {
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
            match (literal::truth_value(text), unit_id(text).filter(|unit| unit.kind != UnitKind::Main)) {
                (Some(constant), _) => Ok(Value::Constant(constant)),
                (None, Some(unit)) => Ok(Value::Unit(unit)),
                (None, None) => {
                    let mut diagnostic =
                        error(Code::SymbolDefinition, format!("{text}: a symbol stands for an address or a constant"));
                    diagnostic.suggestion = nearby_address(text);
                    Err(diagnostic)
                }
            }
        }
    }
}

type LineResult = Result<Option<(Symbol, Span)>, Box<Diagnostic>>;

/// A line of a symbol file; `None` for a header.
fn read_line(line: &str, start: usize, is_first: bool) -> LineResult {
    let fields = fields(line, start)?;
    let is_padding = |field: &&Field<'_>| field.text.is_empty() && !field.is_quoted;
    let padding = fields.iter().take_while(is_padding).count();
    let fields = fields.get(padding..).unwrap_or(&[]);
    let [name, rest @ ..] = fields else { return Ok(None) };
    let Some(address) = rest.first().filter(|address| !address.text.is_empty()) else {
        if is_first && rest.len() > 1 {
            return Ok(None);
        }
        let message = format!("{}: the address of the symbol is missing", name.text);
        return Err(Box::new(
            Diagnostic::new(Code::SymbolDefinition, name.span, message)
                .help("a line has a name, an address and perhaps a comment, separated by tabs or commas"),
        ));
    };
    let value = match read_value(&address.text, address.span) {
        Ok(value) => value,
        // The main program is no operand: the symbol is kept, and only using it is an error.
        Err(_) if address.text.eq_ignore_ascii_case("OB1") => Value::Invalid,
        Err(_) if is_first && is_header_word(&address.text) => return Ok(None),
        // The comment was taken for the address: the name is what is missing.
        Err(_) if padding > 0 && Address::parse(&name.text).is_ok() => return missing_name(name),
        Err(diagnostic) => return Err(diagnostic),
    };
    check_name(&name.text, name.span)?;
    let comment = rest.get(1).map_or_else(String::new, |comment| comment.text.clone().into_owned());
    Ok(Some((Symbol { name: name.text.clone().into_owned(), value, comment }, name.span)))
}

fn missing_name(address: &Field<'_>) -> LineResult {
    check_name("", address.span).map(|()| None)
}

/// A second field such as `Address` or `Adresse`: no address, nor one that is misspelt.
fn is_header_word(text: &str) -> bool {
    text.starts_with(char::is_alphabetic)
        && !literal::looks_like_literal(text)
        && Address::parse(text) == Err(AddressError::NotAnAddress)
        && nearby_address(text).is_none()
}

#[derive(Debug)]
struct Field<'t> {
    span: Span,
    text: Cow<'t, str>,
    is_quoted: bool,
}

/// Cuts a line at its separators: tabs if there are any, otherwise commas, otherwise semicolons.
fn fields(line: &str, start: usize) -> Result<Vec<Field<'_>>, Box<Diagnostic>> {
    let separator = ['\t', ',', ';'].into_iter().find(|&separator| line.contains(separator)).unwrap_or('\t');
    let mut fields = Vec::new();
    let mut at = 0;
    loop {
        let rest = line.get(at..).unwrap_or("");
        let blanks = rest.len() - rest.trim_start_matches(|c: char| c != separator && c.is_whitespace()).len();
        let (field, len) = match rest.get(blanks..).unwrap_or("").starts_with('"') {
            true => quoted_field(rest, blanks, separator, start + at)?,
            false => {
                let len = rest.find(separator).unwrap_or(rest.len());
                (plain_field(rest, len, start + at), len)
            }
        };
        fields.push(field);
        at += len;
        match line.get(at..).and_then(|rest| rest.chars().next()) {
            Some(next) => at += next.len_utf8(),
            None => return Ok(fields),
        }
    }
}

fn plain_field(rest: &str, len: usize, start: usize) -> Field<'_> {
    let whole = rest.get(..len).unwrap_or("");
    let text = whole.trim();
    let begin = start + whole.len() - whole.trim_start().len();
    Field { span: Span::new(begin, begin + text.len()), text: Cow::Borrowed(text), is_quoted: false }
}

/// A field in quotes, which may hold separators, and quotes doubled. With the length up to the next separator.
fn quoted_field(
    rest: &str,
    blanks: usize,
    separator: char,
    start: usize,
) -> Result<(Field<'_>, usize), Box<Diagnostic>> {
    let bytes = rest.as_bytes();
    let mut at = blanks + 1;
    loop {
        match (bytes.get(at), bytes.get(at + 1)) {
            (Some(b'"'), Some(b'"')) => at += 2,
            (Some(b'"'), _) => break,
            (Some(_), _) => at += 1,
            (None, _) => {
                let place = Span::new(start + blanks, start + rest.len());
                let message = format!("{}: the quote is not closed", rest.trim());
                return Err(Box::new(Diagnostic::new(Code::SymbolDefinition, place, message)));
            }
        }
    }
    let inside = rest.get(blanks + 1..at).unwrap_or("");
    let text = if inside.contains('"') { Cow::Owned(inside.replace("\"\"", "\"")) } else { Cow::Borrowed(inside) };
    let behind = rest.get(at + 1..).unwrap_or("");
    let len = at + 1 + behind.find(separator).unwrap_or(behind.len());
    Ok((Field { span: Span::new(start + blanks, start + at + 1), text, is_quoted: true }, len))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loaded(text: &str) -> (Vec<String>, Vec<String>) {
        let source = Source::new("s.csv", text).unwrap();
        let (symbols, diagnostics) = load(&source);
        let symbols = symbols.iter().map(|s| format!("{}={}={}", s.name, words_of(&s.value), s.comment)).collect();
        let shown = diagnostics.iter().map(|diagnostic| {
            let (line, column) = source.position(diagnostic.span.start as usize);
            let mut text = format!("{line}:{column} {} {}", diagnostic.code.text(), diagnostic.message);
            if let Some(suggestion) = &diagnostic.suggestion {
                text += &format!(" -> {suggestion}");
            }
            text
        });
        (symbols, shown.collect())
    }

    fn good(text: &str) -> Vec<String> {
        let (symbols, errors) = loaded(text);
        assert_eq!(errors, [""; 0], "{text}");
        symbols
    }

    #[test]
    fn separators_and_quotes() {
        assert_eq!(good("Start\tI0.0\tgreen button"), ["Start=I0.0=green button"]);
        assert_eq!(good("Start, I0.0, green button\r\nStop,I0.1"), ["Start=I0.0=green button", "Stop=I0.1="]);
        assert_eq!(good("Start;e0.0;Taster"), ["Start=I0.0=Taster"]);
        assert_eq!(good("\"Start\",\"I0.0\",\"say \"\"go\"\", then\""), ["Start=I0.0=say \"go\", then"]);
        assert_eq!(good("\"a,b\",MW3,x"), ["a,b=MW3=x"]);
        assert_eq!(good("\t\t\tStart\tI0.0\tx"), ["Start=I0.0=x"]);
        assert_eq!(good("Max,16#FF,\nMin,-5"), ["Max=255=", "Min=-5="]);
    }

    #[test]
    fn headers_comments_and_blank_lines() {
        assert_eq!(good("Symbol\tAddress\tComment\nA1\tI0.0\t"), ["A1=I0.0="]);
        assert_eq!(good("// list\n\nSymbol,Adresse,Kommentar\n\n  // x\nM1,Q0.0"), ["M1=Q0.0="]);
        assert_eq!(
            loaded("A,I0.0\nSymbol,Address").1,
            ["2:8 E0008 Address: a symbol stands for an address or a constant"]
        );
    }

    #[test]
    fn every_kind_of_address() {
        assert_eq!(
            good(
                "Sum\tVD0\t\r\nPointer\tAC1\r\nStep\tL0.1\r\nLocal\tLW2\r\nCount\tHC0\r\nOut\tAQW2\r\nClock\tSMB34\r\n"
            ),
            ["Sum=VD0=", "Pointer=AC1=", "Step=L0.1=", "Local=LW2=", "Count=HC0=", "Out=AQW2=", "Clock=SMB34="]
        );
        assert_eq!(
            good("Pi\t3.14\nMask\t16#FFFF_FFFF\nFill\tSBR0\nTick\tint3\nMAIN\tOB1\ttop"),
            ["Pi=3.14=", "Mask=4294967295=", "Fill=SBR0=", "Tick=INT3=", "MAIN=defined=top"]
        );
        let wrong = loaded("p\t*AC1\nq\t&VB0\nr\tAC4\ns\tSBR256").1;
        assert_eq!(
            wrong,
            [
                "1:3 E0008 *AC1: a symbol stands for an address or a constant",
                "2:3 E0008 &VB0: a symbol stands for an address or a constant",
                "3:3 E0008 AC4: accumulators are AC0 to AC3",
                "4:3 E0008 SBR256: a symbol stands for an address or a constant",
            ]
        );
    }

    #[test]
    fn errors() {
        let errors = |text| loaded(text).1;
        assert_eq!(errors("Start,I0.9"), ["1:7 E0008 I0.9: a byte has bits 0 to 7 -> I1.1"]);
        assert_eq!(errors("Start,IO.0"), ["1:7 E0008 IO.0: a symbol stands for an address or a constant -> I0.0"]);
        assert_eq!(errors("a,I0.0\nb,I0.1\nA,I0.2"), ["3:1 E0008 A: is already I0.0"]);
        assert_eq!(errors("a,I0.0\nA,I0.0"), [""; 0]);
        assert_eq!(errors("I0.0,I0.1"), ["1:1 E0008 I0.0: a symbol cannot be named like an address"]);
        assert_eq!(errors("TRUE,I0.1"), ["1:1 E0008 TRUE: a symbol cannot be named like a constant"]);
        assert_eq!(errors("16#F,I0.1"), ["1:1 E0008 16#F: a symbol cannot be named like a constant"]);
        assert_eq!(errors("\"\",I0.1"), ["1:1 E0008 the name of the symbol is missing"]);
        assert_eq!(errors("x,I0.0\n,I0.1,lamp"), ["2:2 E0008 the name of the symbol is missing"]);
        assert_eq!(errors("x,I0.0\nStart"), ["2:1 E0008 Start: the address of the symbol is missing"]);
        assert_eq!(errors("\"Start,I0.0"), ["1:1 E0008 \"Start,I0.0: the quote is not closed"]);
    }

    #[test]
    fn files_that_disagree_are_ambiguous() {
        let (mut symbols, _) = load(&Source::new("a", "x,I0.0\ny,I0.1").unwrap());
        symbols.extend(load(&Source::new("b", "X,I0.2\ny,I0.1").unwrap()).0);
        let table = SymbolTable::of_files(symbols);
        let mut buffer = String::new();
        assert!(matches!(table.find("x", &mut buffer), Some(Found::Ambiguous)));
        assert!(matches!(table.find("Y", &mut buffer), Some(Found::Symbol(_))));
        assert!(table.find("z", &mut buffer).is_none());
    }
}
