//! A program without symbols, for Micro/WIN: its operands as addresses, its declarations as
//! settings and data; and its symbol table. Blanks and letter case are the layout's business.

use std::collections::HashMap;
use std::fmt::Write;

use plc_isa::{Area, Retained};

use crate::source::Source;
use crate::text::address::{Address, range_text};
use crate::text::ast::{Operand, Program, Span, Statement, Symbol, Value};
use crate::text::mnemonic_set::AddressWords;

/// The text of a program that was read from this source and has no errors, with addresses for
/// symbols.
pub fn resolved(source: &Source, program: &Program) -> String {
    let resolver = Resolver {
        source,
        program,
        words: AddressWords::of(&source.text, program),
        symbols: program.symbols.iter().map(|one| (one.name.to_lowercase(), one)).collect(),
    };
    let mut edits = resolver.operands();
    edits.extend(resolver.data_lines());
    edits.extend(resolver.declarations());
    edits.sort_by_key(|(span, _)| *span);
    let (mut text, mut at) = (String::new(), 0);
    for (span, words) in edits {
        text.push_str(source.text.get(at..span.start as usize).unwrap_or(""));
        text.push_str(&words);
        at = span.end as usize;
    }
    text.push_str(source.text.get(at..).unwrap_or(""));
    text.push_str(&resolver.initial_values(text.ends_with(['\n', '\r']) || text.is_empty()));
    text
}

/// The symbols of a program as a table that Micro/WIN and `--symbols` read: name, address and
/// comment, separated by tabs.
pub fn symbol_table(program: &Program) -> String {
    let words = AddressWords::default();
    let mut table = String::new();
    for Symbol { name, value, comment } in &program.symbols {
        if let Some(value) = words.value(value) {
            // Quotes keep blanks and separators in a field.
            let quoted = |field: &str| match field.contains(['\t', '"']) {
                true => format!("\"{}\"", field.replace('"', "\"\"")),
                false => field.to_owned(),
            };
            let _ = writeln!(table, "{}\t{value}\t{}", quoted(name), quoted(comment));
        }
    }
    table
}

/// What is put in the place of a span.
type Edit = (Span, String);

struct Resolver<'p> {
    source: &'p Source,
    program: &'p Program,
    words: AddressWords,
    symbols: HashMap<String, &'p Symbol>,
}

impl Resolver<'_> {
    /// The symbol that a word is, without the sign of a pointer and quotes.
    fn symbol(&self, word: &str) -> Option<&Symbol> {
        let name = word.trim_start_matches(['*', '&']).trim_matches('"');
        self.symbols.get(&name.to_lowercase()).copied()
    }

    fn operands(&self) -> Vec<Edit> {
        let instructions = self.program.statements.iter().filter_map(|statement| match statement {
            Statement::Instruction(instruction) => Some(instruction),
            _ => None,
        });
        let operands = instructions.flat_map(|instruction| &instruction.operands);
        let edit = |operand: &Operand| {
            let symbol = self.symbol(operand.span.text(&self.source.text))?;
            // A local variable may have the name of a symbol.
            let is_meant = match (&operand.value, &symbol.value) {
                (Value::Indirect(_) | Value::AddressOf(_), Value::Address(_)) => true,
                (value, other) => value == other,
            };
            is_meant.then(|| self.words.value(&operand.value)).flatten()
        };
        operands.filter_map(|operand| Some((operand.span, edit(operand)?))).collect()
    }

    /// The symbols that lines of data blocks begin with.
    fn data_lines(&self) -> Vec<Edit> {
        let lines = self.program.data.iter().filter(|line| !self.is_declared(line.span));
        let edit = |span: Span| {
            let text = span.text(&self.source.text);
            let len = text.find(char::is_whitespace).unwrap_or(text.len());
            let word = Span { start: span.start, end: span.start + len as u32 };
            let symbol = self.symbol(word.text(&self.source.text))?;
            Some((word, self.words.value(&symbol.value)?))
        };
        lines.filter_map(|line| edit(line.span)).collect()
    }

    /// Whether something is there because of a declaration that is here.
    fn is_declared(&self, span: Span) -> bool {
        self.program.variables.iter().any(|one| one.span == span)
    }

    /// Declarations become symbols; after the last one is what they asked for besides.
    fn declarations(&self) -> Vec<Edit> {
        let Some(last) = self.program.variables.last() else { return Vec::new() };
        let line = |span: Span| self.source.line_span(self.source.position(span.start as usize).0);
        let mut edits: Vec<Edit> = Vec::new();
        for one in &self.program.variables {
            let address = self.words.value(&Value::Address(one.address)).unwrap_or_default();
            let name = one.span.text(&self.source.text);
            let comment = self.symbol(&one.name).map_or("", |symbol| symbol.comment.as_str());
            let mut words = format!("//# symbol {name} {address} // {}", one.type_name());
            if !comment.is_empty() {
                words = format!("{words}: {comment}");
            }
            edits.push((line(one.span), words));
        }
        let line_end = if self.source.text.contains("\r\n") { "\r\n" } else { "\n" };
        if let Some((_, words)) = edits.iter_mut().find(|(span, _)| *span == line(last.span)) {
            for setting in self.settings() {
                words.push_str(line_end);
                words.push_str(&setting);
            }
        }
        edits
    }

    fn settings(&self) -> Vec<String> {
        let memory = self.program.memory.iter().filter(|(.., span)| self.is_declared(*span));
        let memory = memory
            .map(|&(first, count, _)| format!("//# memory {}", range_text(Area::V, first, count)));
        let retained = self.program.retained.iter().filter(|one| self.is_declared(one.span));
        let retained = retained.map(|one| {
            let Retained { area, first, count } = one.range;
            // What is no counter of the program is there for its name and type.
            let is_stamp = area == Area::C && !self.has_counter(first);
            let comment = if is_stamp { " // tells whose values they are" } else { "" };
            format!("//# retain {}{comment}", range_text(area, first, count))
        });
        memory.chain(retained).collect()
    }

    /// Whether a counter is one that the program declares.
    fn has_counter(&self, number: u16) -> bool {
        let is_it = |address| matches!(address, Address::Counter(of) if u16::from(of) == number);
        self.program.variables.iter().any(|one| is_it(one.address))
    }

    /// A data block with the values that declarations give.
    fn initial_values(&self, is_at_line_start: bool) -> String {
        const IN_A_LINE: usize = 16;
        let line_end = if self.source.text.contains("\r\n") { "\r\n" } else { "\n" };
        let mut lines = Vec::new();
        for line in self.program.data.iter().filter(|line| self.is_declared(line.span)) {
            for (index, bytes) in line.bytes.chunks(IN_A_LINE).enumerate() {
                let first = usize::from(line.first_byte) + IN_A_LINE * index;
                let values: Vec<String> = bytes.iter().map(u8::to_string).collect();
                lines.push(format!("VB{first} {}", values.join(", ")));
            }
        }
        if lines.is_empty() {
            return String::new();
        }
        lines.insert(0, "DATA_BLOCK".to_owned());
        lines.push("END_DATA_BLOCK".to_owned());
        let before = if is_at_line_start { "" } else { line_end };
        format!("{before}{}{line_end}", lines.join(line_end))
    }
}
