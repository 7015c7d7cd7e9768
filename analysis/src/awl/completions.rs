//! What can be written at a place of a program.

use std::collections::BTreeSet;

use awl_asm::Address;
use awl_asm::ast::{Program, Statement, Symbol, Type, Unit, UnitKind, Value};
use awl_asm::cursor::{self, Cursor};
use awl_asm::directive_table::DIRECTIVES;
use awl_asm::mnemonics::keywords;
use awl_asm::parser::with_sign;
use awl_asm::select::{taken, takes};
use awl_asm::symbols::written;
use diagnostics::Span;
use plc_isa::{INSTRUCTIONS, Instruction, Op, Profile, Written};

use crate::answer::{Completion, CompletionKind};
use crate::explain::{
    address_words, board_points, instruction, operand_names, short, symbol_line, system_bits,
    value_words,
};
use crate::language::View;
use crate::model::Model;

/// What can be written at an offset.
pub(super) fn at(view: View<'_>, offset: usize) -> Vec<Completion> {
    let Some(model) = view.model else { return Vec::new() };
    let text = view.text();
    match cursor::at(text, offset) {
        Cursor::First(span) => first_words(span),
        Cursor::Operand { entry, index, span } => {
            let file = view.file().unwrap_or_default();
            let at = model.offset_in_all(file, offset).unwrap_or_default() as u32;
            operands(text, model, entry, index, span, at)
        }
        Cursor::Directive(span) => directives(span),
        Cursor::Setting(word, rest) => settings(word.text(text), rest, text),
        Cursor::Declaration => types(Span::new(offset, offset), text),
        Cursor::Other => Vec::new(),
    }
}

// ---- the beginning of a line

fn first_words(span: Span) -> Vec<Completion> {
    let mut all: Vec<Completion> = Vec::new();
    let mut seen = BTreeSet::new();
    for row in INSTRUCTIONS {
        for &mnemonic in row.mnemonics {
            for label in labels(row, mnemonic) {
                if seen.insert(label.clone()) {
                    let detail = format!("{} - {}", operand_names(row), short(row.op));
                    let one = Completion::new(label, CompletionKind::Instruction, detail, span);
                    all.push(Completion { doc: instruction(row), ..one });
                }
            }
        }
    }
    all.extend(keywords().map(|word| Completion::new(word, CompletionKind::Keyword, "", span)));
    all
}

/// A mnemonic with each of its comparisons.
fn labels(row: &Instruction, mnemonic: &str) -> Vec<String> {
    match row.relations() {
        [] => vec![mnemonic.to_owned()],
        signs => signs.iter().map(|sign| format!("{mnemonic}{}", sign.symbol())).collect(),
    }
}

// ---- operands

/// What fits an operand of an instruction: names first, then addresses. `at` is where in the text
/// of all files it is.
fn operands(
    text: &str,
    model: &Model,
    entry: &'static Instruction,
    index: usize,
    span: Span,
    at: u32,
) -> Vec<Completion> {
    let program = &model.assembly.program;
    let typed = span.text(text);
    let sign = typed.chars().next().filter(|sign| ['*', '&'].contains(sign));
    let span = Span { start: span.start + sign.map_or(0, |_| 1), ..span };
    let unit = unit_at(program, at);
    let place = Place { program, entry, index, sign, span, unit };
    let mut all = Vec::new();
    if let Some(unit) = unit {
        all.extend(unit.variables.iter().filter(|one| place.takes_address(one.address)).map(
            |one| {
                let detail = format!("{} {}", one.section.name(), one.kind.name());
                let label = format!("#{}", one.name);
                Completion::new(label, CompletionKind::Variable, detail, place.span)
            },
        ));
    }
    all.extend(program.symbols.iter().filter_map(|symbol| place.symbol(symbol)));
    all.extend(place.routines());
    all.extend(place.labels());
    let addresses = addresses(model).into_iter().filter(|address| place.takes_address(*address));
    all.extend(addresses.map(|address| {
        let detail = address_words(address);
        Completion::new(address.to_string(), CompletionKind::Address, detail, place.span)
    }));
    let forms = taken(entry, index, program.profile).join(", or ");
    for one in &mut all {
        one.doc = [std::mem::take(&mut one.doc), expected(entry, &forms)].join("");
    }
    all
}

/// What an instruction takes at the place.
fn expected(entry: &Instruction, forms: &str) -> String {
    format!("`{} {}` takes {forms} here", entry.mnemonic(), operand_names(entry))
}

struct Place<'p> {
    program: &'p Program,
    entry: &'static Instruction,
    index: usize,
    /// `*` or `&`, written before it.
    sign: Option<char>,
    span: Span,
    /// The unit around it.
    unit: Option<&'p Unit>,
}

impl Place<'_> {
    fn takes(&self, value: &Value) -> bool {
        // Parameters are whatever the subroutine declares.
        if self.entry.op == Op::Call && self.index > 0 {
            return matches!(value, Value::Address(_));
        }
        match self.sign {
            Some(sign) => with_sign(sign, value.clone())
                .is_some_and(|value| takes(self.entry, self.index, &value)),
            None => takes(self.entry, self.index, value),
        }
    }

    fn takes_address(&self, address: Address) -> bool {
        self.takes(&Value::Address(address))
    }

    fn symbol(&self, symbol: &Symbol) -> Option<Completion> {
        // The elements of an array are too many.
        let is_wanted = !symbol.name.ends_with(']') && self.takes(&symbol.value);
        is_wanted.then(|| {
            let detail = match symbol.comment.as_str() {
                "" => value_words(&symbol.value),
                comment => format!("{}, {comment}", value_words(&symbol.value)),
            };
            let label = written(&symbol.name);
            let one = Completion::new(label, CompletionKind::Symbol, detail, self.span);
            Completion { doc: format!("{}\n\n", symbol_line(symbol)), ..one }
        })
    }

    fn routines(&self) -> Vec<Completion> {
        let units = self.program.units().map(|(_, unit)| unit);
        let fitting = units.filter(|unit| {
            let is_kind = match self.entry.op {
                Op::Call => unit.id.kind == UnitKind::Subroutine,
                Op::Atch => unit.id.kind == UnitKind::Interrupt,
                _ => false,
            };
            is_kind && takes(self.entry, self.index, &Value::Unit(unit.id))
        });
        let label = |unit: &Unit| match unit.name.as_str() {
            "" => unit.id.to_string(),
            name => written(name),
        };
        fitting
            .map(|unit| {
                let detail = format!("{} {}", unit.id, unit.title);
                Completion::new(label(unit), CompletionKind::Routine, detail.trim_end(), self.span)
            })
            .collect()
    }

    /// The labels of the unit, where one is named.
    fn labels(&self) -> Vec<Completion> {
        let kinds = self.entry.forms.iter().filter_map(|form| form.kinds.get(self.index));
        if !kinds.into_iter().any(|kind| kind.written() == Written::Label) {
            return Vec::new();
        }
        let mut is_inside = true;
        let mut numbers = BTreeSet::new();
        let unit = self.unit.map(|unit| unit.id);
        for statement in &self.program.statements {
            match statement {
                Statement::Unit(head) => is_inside = Some(head.id) == unit,
                Statement::Instruction(one) if one.entry.op == Op::Lbl && is_inside => {
                    let value = one.operands.first().map(|operand| operand.value.clone());
                    if let Some(Value::Constant(number)) = value {
                        numbers.insert(number.value);
                    }
                }
                _ => {}
            }
        }
        let label = |number: i64| {
            Completion::new(number.to_string(), CompletionKind::Label, "a label", self.span)
        };
        numbers.into_iter().map(label).collect()
    }
}

fn unit_at(program: &Program, offset: u32) -> Option<&Unit> {
    program.units().map(|(_, unit)| unit).take_while(|unit| unit.span.start <= offset).last()
}

/// What the program names, the points of its board, and what the system has.
fn addresses(model: &Model) -> Vec<Address> {
    let used = model.assembly.usage.accesses.keys().copied();
    let points = board_points(model.assembly.program.profile);
    let accumulators = (0..4).map(Address::Accumulator);
    let mut seen = BTreeSet::new();
    let all = used.chain(points).chain(system_bits()).chain(accumulators);
    all.filter(|address| seen.insert(*address)).collect()
}

// ---- `//#` lines and declarations

fn directives(span: Span) -> Vec<Completion> {
    let rows = DIRECTIVES.iter().map(|row| Completion {
        doc: format!("{}\n\n`//# {}`", row.doc, row.example),
        ..Completion::new(row.word, CompletionKind::Keyword, row.example, span)
    });
    rows.collect()
}

/// What can follow the word of a `//#` line, where there are a few possibilities.
fn settings(word: &str, rest: Span, text: &str) -> Vec<Completion> {
    let span = last_word(rest, text);
    let values = |values: &[&str]| {
        let one = |value: &&str| Completion::new(*value, CompletionKind::Value, "", span);
        values.iter().map(one).collect()
    };
    match word.to_ascii_lowercase().as_str() {
        "board" => values(&Profile::ALL.map(|board| board.name)),
        "modbus" => values(&["address", "baud", "parity", "none", "even", "odd"]),
        "timer" => values(&["1ms", "10ms", "100ms", "TONR", "RETAIN"]),
        "counter" => values(&["RETAIN"]),
        "var" => {
            let more = ["TIME", "ARRAY[0..9] OF", "RETAIN"];
            types(span, text).into_iter().chain(values(&more)).collect()
        }
        _ => Vec::new(),
    }
}

fn types(place: Span, text: &str) -> Vec<Completion> {
    let line_start = text.get(..place.end as usize).and_then(|before| before.rfind('\n'));
    let line = Span::new(line_start.map_or(0, |at| at + 1), place.end as usize);
    let span = last_word(line, text);
    let all = Type::NAMES.iter();
    all.map(|(name, _)| Completion::new(*name, CompletionKind::Value, "a type", span)).collect()
}

/// The word that the span ends in; empty after a blank or sign.
fn last_word(span: Span, text: &str) -> Span {
    let typed = span.text(text);
    let len = typed.len() - typed.trim_end_matches(|c: char| c.is_alphanumeric()).len();
    Span { start: span.end - len as u32, ..span }
}
