//! What the words of a program stand for: from the syntax tree and the names that the parser found.

use std::collections::HashMap;

use awl_asm::assemble::Assembly;
use awl_asm::ast::{Instruction, Name, Named, Program, Statement, UnitId, Value};
use awl_asm::mnemonics::same_mnemonic;
use awl_asm::{Address, declared::Declared};
use diagnostics::Span;
use plc_isa::Op;

use crate::subject::{Mention, Subject};

/// The words of a program that stand for something, in their order.
pub(super) fn of(text: &str, assembly: &Assembly) -> Vec<Mention> {
    let program = &assembly.program;
    let reader = Reader { text, program, ops: ops(assembly), names: by_start(program) };
    let mut mentions: Vec<Mention> =
        program.names.iter().filter(|name| name.declares).map(|name| reader.name(name)).collect();
    let mut unit = None;
    for (index, statement) in program.statements.iter().enumerate() {
        match statement {
            Statement::Unit(head) => unit = Some(head.id),
            Statement::Network(_) => {}
            Statement::Instruction(one) => reader.instruction(index, one, unit, &mut mentions),
        }
    }
    // The symbols that begin lines of the data block.
    let known: Vec<Span> = mentions.iter().map(|mention| mention.span).collect();
    let rest = program.names.iter().map(|name| reader.name(name));
    mentions.extend(rest.filter(|mention| !known.contains(&mention.span)));
    mentions.sort_by_key(|mention| mention.span);
    mentions
}

struct Reader<'p> {
    text: &'p str,
    program: &'p Program,
    /// Which of several instructions with its mnemonic a statement is.
    ops: HashMap<u32, Op>,
    names: HashMap<u32, &'p Name>,
}

fn ops(assembly: &Assembly) -> HashMap<u32, Op> {
    let mut ops = HashMap::new();
    for selected in &assembly.code {
        let statement = assembly.program.statements.get(selected.statement as usize);
        let Some(Statement::Instruction(source)) = statement else { continue };
        // What the assembler adds has another mnemonic.
        if same_mnemonic(source.entry).iter().any(|entry| entry.op == selected.op) {
            ops.insert(selected.statement, selected.op);
        }
    }
    ops
}

fn by_start(program: &Program) -> HashMap<u32, &Name> {
    program.names.iter().map(|name| (name.span.start, name)).collect()
}

impl Reader<'_> {
    fn instruction(
        &self,
        index: usize,
        source: &Instruction,
        unit: Option<UnitId>,
        mentions: &mut Vec<Mention>,
    ) {
        let op = self.ops.get(&(index as u32)).copied().unwrap_or(source.entry.op);
        let word = source.mnemonic_span;
        mentions.push(Mention::of(word, Subject::Instruction(op)));
        let by = source.span.text(self.text);
        for (place, operand) in source.operands.iter().enumerate() {
            let Some(mut mention) = self.operand(op, unit, operand.span, &operand.value) else {
                continue;
            };
            mention.declares |= place == 0 && comes_to_be(op);
            mention.by = by.to_owned();
            mentions.push(mention);
        }
    }

    /// An operand: a name, a label or an address.
    fn operand(&self, op: Op, unit: Option<UnitId>, span: Span, value: &Value) -> Option<Mention> {
        let bare = span.text(self.text).trim_start_matches(['*', '&', '#']);
        let bare = Span { start: span.end - bare.len() as u32, ..span };
        if let Some(name) = self.names.get(&bare.start) {
            return Some(Mention { address: address(value), ..self.name(name) });
        }
        if let (Op::Jmp | Op::Lbl, Value::Constant(number)) = (op, value) {
            let label = u16::try_from(number.value).ok()?;
            return Some(Mention::of(span, Subject::Label(unit, label)));
        }
        let address = address(value)?;
        let mention = Mention::of(bare, Subject::Address(address));
        Some(Mention { address: Some(address), ..mention })
    }

    fn name(&self, name: &Name) -> Mention {
        let Name { span, of, declares } = *name;
        let (subject, address, span) = match of {
            Named::Unit(id) => (Subject::Unit(id), None, span),
            Named::Symbol(index) => self.symbol(index, span),
            Named::Local(statement, index) => match self.program.statements.get(statement as usize)
            {
                Some(Statement::Unit(unit)) => {
                    let variable = unit.variables.get(index as usize);
                    let name = variable.map_or("", |variable| &variable.name);
                    let subject = Subject::Local(unit.id, name.to_lowercase());
                    (subject, variable.map(|variable| variable.address), span)
                }
                _ => (Subject::Word(String::new()), None, span),
            },
        };
        Mention { address, declares, ..Mention::of(span, subject) }
    }

    /// A symbol; of an element the array.
    fn symbol(&self, index: u32, span: Span) -> (Subject, Option<Address>, Span) {
        let symbol = self.program.symbols.get(index as usize);
        let name = symbol.map_or("", |symbol| &symbol.name);
        let address = symbol.and_then(|symbol| address(&symbol.value));
        let element = name.rsplit_once('[');
        let is_array = |array: &str| {
            let is_it = |one: &Declared| one.name.eq_ignore_ascii_case(array);
            self.program.variables.iter().any(is_it)
        };
        match element.filter(|(array, _)| is_array(array)) {
            Some((array, _)) => {
                let quote = u32::from(span.text(self.text).starts_with('"'));
                let start = span.start + quote;
                let span = Span { start, end: start + array.len() as u32 };
                (Subject::Symbol(array.to_lowercase()), address, span)
            }
            None => (Subject::Symbol(name.to_lowercase()), address, span),
        }
    }
}

fn address(value: &Value) -> Option<Address> {
    match value {
        Value::Address(address) | Value::Indirect(address) | Value::AddressOf(address) => {
            Some(*address)
        }
        _ => None,
    }
}

/// Whether an instruction makes its first operand what it is: a label, a running timer.
fn comes_to_be(op: Op) -> bool {
    matches!(op, Op::Lbl | Op::Ton | Op::Tof | Op::Tonr | Op::Ctu | Op::Ctd | Op::Ctud | Op::Lscr)
}
