//! The data block: what V memory holds before the first scan. Text to bytes; how they come into the
//! image is said elsewhere.

use plc_isa::Area;

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Source;
use crate::text::address::{Address, AddressError};
use crate::text::ast::{DataLine, Name, Named, Span, Symbol, Value};
use crate::text::lexer::{Ahead, Cut, Lexer};
use crate::text::literal;
use crate::text::symbols::{Found, SymbolTable};

/// Reads a data block that is a file of its own. The spans are places in this source; `symbols` may
/// stand for addresses.
pub fn parse(source: &Source, symbols: &[Symbol]) -> (Vec<DataLine>, Vec<Diagnostic>) {
    let symbols = SymbolTable::of_files(symbols.to_vec());
    let mut block = DataBlock::default();
    let mut diagnostics = Vec::new();
    let mut lexer = Lexer::new(&source.text);
    loop {
        match lexer.ahead() {
            Ahead::End => break,
            Ahead::Text | Ahead::Comma => {
                block.line(&mut lexer, &source.text, &symbols, &mut diagnostics)
            }
            Ahead::Comment => {
                lexer.rest_of_line();
            }
            Ahead::LineEnd | Ahead::NewLine | Ahead::Semicolon => lexer.step(),
        }
    }
    if let Some(span) = lexer.unclosed_comment {
        let message = format!("{}: the comment is not closed", span.text(&source.text));
        diagnostics.push(Diagnostic::new(Code::Syntax, span, message));
    }
    (block.lines, diagnostics)
}

/// Adds the data of a file to that of a program. A byte that both give is an error of the program.
pub(crate) fn join(
    program: &mut Vec<DataLine>,
    file: &[DataLine],
    diagnostics: &mut Vec<Diagnostic>,
) {
    let range = |line: &DataLine| {
        (usize::from(line.first_byte), usize::from(line.first_byte) + line.bytes.len())
    };
    for line in program.iter() {
        let (first, end) = range(line);
        if let Some(other) = file.iter().map(range).find(|other| other.0 < end && first < other.1) {
            let message = format!("VB{}: the data file gives it a value too", first.max(other.0));
            diagnostics.push(Diagnostic::new(Code::DataBlock, line.span, message));
        }
    }
    // Places in another file mean nothing here.
    program.extend(file.iter().map(|line| DataLine { span: Span::default(), ..line.clone() }));
}

/// How the values of a line are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Size {
    /// As long as each value needs: an address without size, such as `V10`.
    OfValue,
    Byte,
    Word,
    Double,
}

impl Size {
    fn words(self) -> &'static str {
        match self {
            Size::OfValue => "data",
            Size::Byte => "a byte",
            Size::Word => "a word",
            Size::Double => "a double word",
        }
    }
}

/// The lines that have been read.
#[derive(Debug, Default)]
pub(crate) struct DataBlock {
    /// The lines that are good.
    pub(crate) lines: Vec<DataLine>,
    /// Where a line without address goes on, and in which size.
    next: Option<(u32, Size)>,
    /// For each V byte the line that gives it, counted from 1; empty before the first.
    owners: Vec<u32>,
    /// The symbols that lines begin with.
    pub(crate) names: Vec<Name>,
}

type Outcome<T> = Result<T, Box<Diagnostic>>;

impl DataBlock {
    /// Reads the line at the position, up to its comment or end.
    pub(crate) fn line(
        &mut self,
        lexer: &mut Lexer<'_>,
        text: &str,
        symbols: &SymbolTable,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let operands = operands(lexer, text, diagnostics);
        let Some((&first, &last)) = operands.first().zip(operands.last()) else { return };
        let span = Span { start: first.start, end: last.end };
        let (start, values) = match self.start(first, text, symbols) {
            Ok(Some(start)) => (start, operands.get(1..).unwrap_or(&[])),
            Ok(None) => match self.next {
                Some(next) => (next, operands.as_slice()),
                None => {
                    let message = format!(
                        "{}: the first line of a data block begins with an address",
                        first.text(text)
                    );
                    diagnostics.push(
                        Diagnostic::new(Code::DataBlock, first, message)
                            .help("such as `VB0 1, 2, 3`"),
                    );
                    return;
                }
            },
            Err(diagnostic) => {
                // What follows without address has no place either, which is no news.
                self.next = self.next.or(Some((0, Size::OfValue)));
                return diagnostics.push(*diagnostic);
            }
        };
        if values.is_empty() {
            let message = format!("{}: values are missing after the address", first.text(text));
            diagnostics.push(Diagnostic::new(Code::DataBlock, first, message));
        }
        let mut bytes = Vec::new();
        for &value in values {
            if let Err(diagnostic) = push_value(&mut bytes, start.1, value, text) {
                diagnostics.push(*diagnostic);
            }
        }
        self.next = Some((start.0 + bytes.len() as u32, start.1));
        if let Err(diagnostic) = self.add(start.0, bytes, span, text) {
            diagnostics.push(*diagnostic);
        }
    }

    /// The address that a line begins with; `None` if it begins with a value.
    fn start(
        &mut self,
        first: Span,
        text: &str,
        symbols: &SymbolTable,
    ) -> Outcome<Option<(u32, Size)>> {
        let word = first.text(text);
        let error = |code, why: String| Diagnostic::new(code, first, why);
        if literal::looks_like_literal(word) {
            return Ok(None);
        }
        if let Some(byte) = untyped(word) {
            return Ok(Some((byte, Size::OfValue)));
        }
        let quoted = word.strip_prefix('"').and_then(|inside| inside.strip_suffix('"'));
        let address = match symbols.find(quoted.unwrap_or(word), &mut String::new()) {
            Some(Found::Symbol(index, Symbol { value: Value::Address(address), .. })) => {
                let of = Named::Symbol(index);
                self.names.push(Name { span: first, of, declares: false });
                *address
            }
            _ if quoted.is_some() => return Ok(None),
            _ => match Address::parse(word) {
                Ok(address) => address,
                Err(AddressError::OutOfRange(message, suggestion)) => {
                    let mut diagnostic = error(Code::AddressRange, message);
                    diagnostic.suggestion = suggestion;
                    return Err(Box::new(diagnostic));
                }
                Err(AddressError::NotAnAddress) => {
                    let why = format!("{word}: neither an address nor a value");
                    let help = "a data block has addresses: `VW0 5`; a variable with a name is \
                                declared outside of it: `//# var Speed INT := 5`";
                    return Err(Box::new(error(Code::DataBlock, why).help(help)));
                }
            },
        };
        match address {
            Address::Byte { area: Area::V, byte } => Ok(Some((byte.into(), Size::Byte))),
            Address::Word { area: Area::V, byte } => Ok(Some((byte.into(), Size::Word))),
            Address::Double { area: Area::V, byte } => Ok(Some((byte.into(), Size::Double))),
            _ => {
                let message =
                    format!("{word}: a data block gives bytes, words and double words of V memory");
                let here = match address {
                    Address::Bit { .. } => "such as `VB0 1`: bits are set in a byte".to_owned(),
                    _ => format!(
                        "such as `VW0 5`; other memory is written in the first scan: `LD SM0.1`, \
                         `MOVW 5, {word}`"
                    ),
                };
                Err(Box::new(error(Code::DataBlock, message).help(here)))
            }
        }
    }

    /// Keeps a line, if its bytes are in V memory and nobody else's.
    fn add(&mut self, first: u32, bytes: Vec<u8>, span: Span, text: &str) -> Outcome<()> {
        let size = u32::from(Area::V.size());
        let words = span.text(text);
        let end = first + bytes.len() as u32;
        if end > size {
            let message = format!("{words}: the data ends after VB{}", size - 1);
            return Err(Box::new(Diagnostic::new(Code::AddressRange, span, message)));
        }
        self.owners.resize(size as usize, 0);
        let places = self.owners.get_mut(first as usize..end as usize).unwrap_or(&mut []);
        if let Some((byte, &owner)) = (first..).zip(places.iter()).find(|&(_, &owner)| owner != 0) {
            let mut diagnostic = Diagnostic::new(
                Code::DataBlock,
                span,
                format!("{words}: VB{byte} has a value already"),
            );
            if let Some(other) = self.lines.get(owner as usize - 1) {
                let last = other.first_byte + other.bytes.len() as u16 - 1;
                let free = format!("VB{}", last + 1);
                diagnostic = diagnostic.related(other.span, "from this line").help(match last {
                    last if last == other.first_byte => format!("the next byte is {free}"),
                    last => format!(
                        "that line gives VB{} to VB{last}: a word has two bytes, a double word \
                         four; the next byte is {free}",
                        other.first_byte
                    ),
                });
            }
            return Err(Box::new(diagnostic));
        }
        if !bytes.is_empty() {
            places.fill(self.lines.len() as u32 + 1);
            self.lines.push(DataLine { span, first_byte: first as u16, bytes });
        }
        Ok(())
    }
}

/// The number of `V10`, an address without size.
fn untyped(word: &str) -> Option<u32> {
    let digits = word.strip_prefix(['V', 'v'])?;
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    // Too many digits are after the end of V memory as well.
    is_number.then(|| digits.parse().unwrap_or(u32::from(u16::MAX)).min(u32::from(u16::MAX)))
}

/// The words of a line: an address perhaps, and values.
fn operands(lexer: &mut Lexer<'_>, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Vec<Span> {
    let mut operands = Vec::new();
    let mut comma = None;
    loop {
        match lexer.ahead() {
            Ahead::Text => {
                comma = None;
                match lexer.operand() {
                    Cut::Whole(span) => operands.push(span),
                    Cut::Unclosed(span) => {
                        let message =
                            format!("{}: the quote is not closed", span.text(text).trim_end());
                        diagnostics.push(Diagnostic::new(Code::Syntax, span, message));
                    }
                }
            }
            Ahead::Comma => {
                let span = Span::new(lexer.position(), lexer.position() + 1);
                if operands.is_empty() || comma.is_some() {
                    diagnostics.push(Diagnostic::new(
                        Code::Syntax,
                        span,
                        ",: a value is missing before the comma",
                    ));
                }
                comma = Some(span);
                lexer.step();
            }
            _ => break,
        }
    }
    // Values may go on after a comma at the end of a line: the next line has no address.
    operands
}

/// Appends a value to the bytes of a line.
fn push_value(bytes: &mut Vec<u8>, size: Size, span: Span, text: &str) -> Outcome<()> {
    let word = span.text(text);
    let error = |code, why: String| Err(Box::new(Diagnostic::new(code, span, why)));
    let is_text = word.starts_with('"');
    if word.starts_with('\'') && matches!(size, Size::Byte | Size::OfValue) {
        return match literal::quoted_characters(word, word) {
            Ok(characters) => {
                bytes.extend(characters);
                Ok(())
            }
            Err(why) => error(Code::ConstantRange, why),
        };
    }
    if !is_text && !literal::looks_like_literal(word) {
        return error(
            Code::DataBlock,
            format!("{word}: no value; there are numbers, 'characters' and \"texts\""),
        );
    }
    match literal::parse(word) {
        Ok(Value::Text(characters)) if matches!(size, Size::Byte | Size::OfValue) => {
            bytes.push(characters.len() as u8);
            bytes.extend(characters);
        }
        Ok(Value::Real(bits)) if matches!(size, Size::Double | Size::OfValue) => {
            bytes.extend(bits.to_be_bytes())
        }
        Ok(Value::Constant(constant)) => {
            let Some(len) = len_of(size, constant.value, word) else {
                let wrong = Diagnostic::new(Code::ConstantRange, span, out_of_range(size, word));
                let wider = [(Size::Word, "VW0"), (Size::Double, "VD0")].into_iter();
                let mut wider = wider.filter(|(of, _)| len_of(*of, constant.value, word).is_some());
                return Err(Box::new(match wider.next() {
                    Some((of, address)) => wrong.help(format!(
                        "{} holds it: a line of its own, such as `{address} {word}`",
                        of.words()
                    )),
                    None => wrong,
                }));
            };
            let stored = (constant.value as u32).to_be_bytes();
            bytes.extend_from_slice(stored.get(4 - len..).unwrap_or(&[]));
        }
        Ok(Value::Text(_)) => {
            return error(Code::DataBlock, format!("{word}: a text is at an address such as VB0"));
        }
        Ok(_) => {
            return error(
                Code::DataBlock,
                format!("{word}: a real number takes a double word, such as VD0"),
            );
        }
        Err(why) => return error(Code::ConstantRange, why),
    }
    Ok(())
}

/// How many bytes a whole number takes; `None` if it does not fit.
fn len_of(size: Size, value: i64, word: &str) -> Option<usize> {
    let fits = |len: usize| {
        let bits = 8 * len as u32;
        // Bytes have no sign.
        let least = if len == 1 { 0 } else { -(1i64 << (bits - 1)) };
        (least..1i64 << bits).contains(&value).then_some(len)
    };
    match size {
        Size::Byte => fits(1),
        Size::Word => fits(2),
        Size::Double => fits(4),
        Size::OfValue => match literal::prefixed_len(word) {
            Some(len) => Some(len),
            None => fits(1).or_else(|| fits(2)).or_else(|| fits(4)),
        },
    }
}

fn out_of_range(size: Size, word: &str) -> String {
    let (least, most): (i64, i64) = match size {
        Size::Byte => (0, 0xFF),
        Size::Word => (i64::from(i16::MIN), 0xFFFF),
        Size::Double | Size::OfValue => (i64::from(i32::MIN), 0xFFFF_FFFF),
    };
    format!("{word}: {} holds {least} to {most}", size.words())
}

#[cfg(test)]
#[path = "data_block_tests.rs"]
mod tests;
