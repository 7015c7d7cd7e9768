//! Files with symbols: tables as Micro/WIN shows, copies and prints them, and as spreadsheets write
//! them. What a symbol may be is said elsewhere.

use std::borrow::Cow;

use super::{SymbolTable, check_name, read_value};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Source;
use crate::text::address::{Address, AddressError};
use crate::text::ast::{Name, Span, Symbol, Value};
use crate::text::literal;
use crate::text::suggest::nearby_address;

/// Reads a symbol file: a symbol a line, with name, address, routine or constant, and comment,
/// separated by tabs, commas or semicolons. Numbers of rows and empty columns before them are left
/// out; a line with the names of the columns says their order. The spans of the diagnostics are
/// places in this source.
pub fn load(source: &Source) -> (Vec<Symbol>, Vec<Diagnostic>) {
    let (symbols, _, diagnostics) = load_placed(source);
    (symbols, diagnostics)
}

/// The same, with the places at which names are declared.
pub fn load_placed(source: &Source) -> (Vec<Symbol>, Vec<Name>, Vec<Diagnostic>) {
    let mut table = SymbolTable::default();
    let mut diagnostics = Vec::new();
    let mut reader = Reader { columns: None, is_first: true };
    for line in 1..=source.line_count() {
        let span = source.line_span(line);
        let text = span.text(&source.text);
        if text.trim().is_empty() || text.trim_start().starts_with("//") {
            continue;
        }
        match reader.line(text, span.start as usize) {
            Ok(Some((symbol, place))) => diagnostics.extend(table.define(symbol, Some(place))),
            Ok(None) => {}
            Err(diagnostic) => diagnostics.push(*diagnostic),
        }
        reader.is_first = false;
    }
    let (symbols, names) = table.into_parts();
    (symbols, names, diagnostics)
}

/// What columns are called, in the languages of Micro/WIN and by STEP 7 and spreadsheets.
const NAMES: [&str; 6] = ["symbol", "name", "symbole", "símbolo", "simbolo", "symbolname"];
const ADDRESSES: [&str; 7] =
    ["address", "adresse", "adr.", "dirección", "direccion", "indirizzo", "operand"];
const COMMENTS: [&str; 5] = ["comment", "kommentar", "commentaire", "comentario", "commento"];
/// Types of STEP 7's tables, which have a column for them.
const TYPES: [&str; 10] =
    ["BOOL", "BYTE", "WORD", "DWORD", "INT", "DINT", "REAL", "CHAR", "TIMER", "COUNTER"];

/// Where a header says that things are.
#[derive(Debug, Clone, Copy)]
struct Columns {
    name: usize,
    address: usize,
    comment: Option<usize>,
}

impl Columns {
    /// The columns of a header; `None` if the line is none.
    fn of(fields: &[Field<'_>]) -> Option<Columns> {
        let column = |words: &[&str]| {
            let is_it = |field: &Field<'_>| words.contains(&field.text.to_lowercase().as_str());
            fields.iter().position(is_it)
        };
        let (name, address) = (column(&NAMES)?, column(&ADDRESSES)?);
        Some(Columns { name, address, comment: column(&COMMENTS) })
    }
}

struct Reader {
    columns: Option<Columns>,
    /// Nothing was read yet.
    is_first: bool,
}

/// Name, address and comment of a line.
struct Row<'t> {
    name: Field<'t>,
    address: Option<Field<'t>>,
    comment: String,
    /// There are columns before the name.
    has_padding: bool,
}

type LineResult = Result<Option<(Symbol, Span)>, Box<Diagnostic>>;

impl Reader {
    /// A line of the file; `None` for a header, and for a row that is empty but for its number.
    fn line(&mut self, line: &str, start: usize) -> LineResult {
        let fields = fields(line, start)?;
        if let Some(columns) = Columns::of(&fields) {
            self.columns = Some(columns);
            return Ok(None);
        }
        match self.row(&fields, line, start) {
            Some(row) => self.symbol(row, fields.len()),
            None => Ok(None),
        }
    }

    fn row<'t>(&self, fields: &[Field<'t>], line: &str, start: usize) -> Option<Row<'t>> {
        if let Some(columns) = self.columns
            && fields.get(columns.address).is_some()
        {
            let field = |index: usize| fields.get(index).cloned();
            let comment = columns.comment.and_then(field).map(|comment| comment.text.into_owned());
            let (name, address) = (field(columns.name)?, field(columns.address));
            let is_empty = name.is_empty() && address.as_ref().is_none_or(Field::is_empty);
            let comment = comment.unwrap_or_default();
            return (!is_empty).then_some(Row { name, address, comment, has_padding: false });
        }
        let mut rest = without_padding(fields);
        if rest.first().is_some_and(Field::is_number) && fields.len() != 2 {
            rest = without_padding(&rest[1..]);
        }
        let [name, others @ ..] = rest else { return None };
        let is_type = |field: &Field<'_>| TYPES.iter().any(|name| field.text.trim() == *name);
        let comment_at = 1 + usize::from(others.len() > 2 && others.get(1).is_some_and(is_type));
        let comment = others.get(comment_at).map_or_else(String::new, |comment| {
            let is_last = others.len() == comment_at + 1;
            let rest = line.get(comment.span.start as usize - start..).unwrap_or("");
            if is_last { comment.text.to_string() } else { joined(rest) }
        });
        let has_padding = rest.len() < fields.len();
        Some(Row { name: name.clone(), address: others.first().cloned(), comment, has_padding })
    }

    fn symbol(&self, row: Row<'_>, field_count: usize) -> LineResult {
        let Row { name, address, comment, has_padding } = row;
        let error =
            |message: String| Box::new(Diagnostic::new(Code::SymbolDefinition, name.span, message));
        let Some(address) = address.filter(|address| !address.is_empty()) else {
            if self.is_first && field_count > 2 && !has_padding {
                return Ok(None);
            }
            let message = format!("{}: the address of the symbol is missing", name.text);
            return Err(Box::new(error(message).help(
                "a line has a name, an address and perhaps a comment, separated by tabs or commas",
            )));
        };
        let value = match read_value(&address.compact(), address.span) {
            Ok(value) => value,
            // The main program is no operand: the symbol is kept, and only using it is an error.
            Err(_) if address.text.eq_ignore_ascii_case("OB1") => Value::Invalid,
            Err(_) if self.is_first && is_header_word(&address.text) => return Ok(None),
            // The comment was taken for the address: the name is what is missing.
            Err(_) if has_padding && Address::parse(&name.text).is_ok() => {
                return check_name("", name.span).map(|()| None);
            }
            Err(diagnostic) => return Err(diagnostic),
        };
        if name.text.contains('"') {
            return Err(error(format!("{}: a quote in the name of a symbol", name.text)));
        }
        check_name(&name.text, name.span)?;
        Ok(Some((Symbol { name: name.text.into_owned(), value, comment }, name.span)))
    }
}

fn without_padding<'f, 't>(fields: &'f [Field<'t>]) -> &'f [Field<'t>] {
    let padding = fields.iter().take_while(|field| field.is_empty()).count();
    fields.get(padding..).unwrap_or(&[])
}

/// A comment with separators in it, or further columns: tabs as blanks.
fn joined(rest: &str) -> String {
    rest.split('\t').map(str::trim).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// A second field such as `Place` or `Ort`: no address, nor one that is misspelt.
fn is_header_word(text: &str) -> bool {
    text.starts_with(char::is_alphabetic)
        && !literal::looks_like_literal(text)
        && Address::parse(text) == Err(AddressError::NotAnAddress)
        && nearby_address(text).is_none()
}

#[derive(Debug, Clone)]
struct Field<'t> {
    span: Span,
    text: Cow<'t, str>,
    is_quoted: bool,
}

impl Field<'_> {
    fn is_empty(&self) -> bool {
        self.text.is_empty() && !self.is_quoted
    }

    /// Whether it is the number of a row: no symbol is called so.
    fn is_number(&self) -> bool {
        !self.text.is_empty() && self.text.bytes().all(|byte| byte.is_ascii_digit())
    }

    /// The text without the blanks that STEP 7 has in addresses: `E    0.0`.
    fn compact(&self) -> Cow<'_, str> {
        let compact = || self.text.split_whitespace().collect::<String>();
        match self.text.contains(char::is_whitespace) && Address::parse(&compact()).is_ok() {
            true => Cow::Owned(compact()),
            false => Cow::Borrowed(&*self.text),
        }
    }
}

/// Cuts a line at its separators: tabs if there are any, otherwise commas, otherwise semicolons.
fn fields(line: &str, start: usize) -> Result<Vec<Field<'_>>, Box<Diagnostic>> {
    let separator =
        ['\t', ',', ';'].into_iter().find(|&separator| line.contains(separator)).unwrap_or('\t');
    let mut fields = Vec::new();
    let mut at = 0;
    loop {
        let rest = line.get(at..).unwrap_or("");
        let (field, len) = field(rest, separator, start + at)?;
        fields.push(field);
        at += len;
        match line.get(at..).and_then(|rest| rest.chars().next()) {
            Some(next) => at += next.len_utf8(),
            None => return Ok(fields),
        }
    }
}

/// The first field of a text, and its length.
fn field(rest: &str, separator: char, start: usize) -> Result<(Field<'_>, usize), Box<Diagnostic>> {
    let blanks =
        rest.len() - rest.trim_start_matches(|c: char| c != separator && c.is_whitespace()).len();
    let plain = rest.find(separator).unwrap_or(rest.len());
    if !rest.get(blanks..).unwrap_or("").starts_with('"') {
        return Ok((plain_field(rest, plain, start), plain));
    }
    match quoted_field(rest, blanks, separator, start) {
        Some(quoted) => Ok(quoted),
        // What is copied out of a table is not in quotes: they are part of the text.
        None if separator == '\t' => Ok((plain_field(rest, plain, start), plain)),
        None => {
            let place = Span::new(start + blanks, start + rest.len());
            let message = format!("{}: the quote is not closed", rest.trim());
            Err(Box::new(Diagnostic::new(Code::SymbolDefinition, place, message)))
        }
    }
}

fn plain_field(rest: &str, len: usize, start: usize) -> Field<'_> {
    let whole = rest.get(..len).unwrap_or("");
    let text = whole.trim();
    let begin = start + whole.len() - whole.trim_start().len();
    Field {
        span: Span::new(begin, begin + text.len()),
        text: Cow::Borrowed(text),
        is_quoted: false,
    }
}

/// A field in quotes, which may hold separators, and quotes doubled, with its length; `None` if the
/// quotes are not around all of it.
fn quoted_field(
    rest: &str,
    blanks: usize,
    separator: char,
    start: usize,
) -> Option<(Field<'_>, usize)> {
    let bytes = rest.as_bytes();
    let mut at = blanks + 1;
    loop {
        match (bytes.get(at)?, bytes.get(at + 1)) {
            (b'"', Some(b'"')) => at += 2,
            (b'"', _) => break,
            _ => at += 1,
        }
    }
    let inside = rest.get(blanks + 1..at)?;
    let after = rest.get(at + 1..)?;
    let len = after.find(separator).unwrap_or(after.len());
    if !after.get(..len)?.trim().is_empty() {
        return None;
    }
    let text = match inside.contains('"') {
        true => Cow::Owned(inside.replace("\"\"", "\"")),
        false => Cow::Borrowed(inside),
    };
    let span = Span::new(start + blanks, start + at + 1);
    Some((Field { span, text, is_quoted: true }, at + 1 + len))
}
