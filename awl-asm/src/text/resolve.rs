//! What the operands of a program mean: constants and addresses at once, symbols when all of them
//! are known.

use plc_isa::{Op, TimerKind, Type};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::{Address, AddressError};
use crate::text::ast::{
    Instruction, Name, Named, Operand, Program, Span, Statement, Symbol, Unit, UnitId, UnitKind,
    Value, Variable,
};
use crate::text::foreign::operands as foreign_operands;
use crate::text::foreign::operands::Preset;
use crate::text::hints;
use crate::text::literal;
use crate::text::locals::is_same_name;
use crate::text::mnemonics::{takes_text, written_operands};
use crate::text::pointers::{pointer, pointer_to};
use crate::text::qualified;
use crate::text::suggest::{Suggester, nearby_address};
use crate::text::symbols::{Found, SymbolTable, written};

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
        // A symbol may have the name of a German address: that is decided when all symbols are
        // known.
        Ok(address) if address.is_german(text) => None,
        Ok(address) => Some(Value::Address(address)),
        Err(_) => literal::truth_value(text).map(Value::Constant),
    }
}

/// The kind of routine that this operand of an instruction names, if it names one.
pub(crate) fn routine_kind(op: Op, operand: usize) -> Option<UnitKind> {
    match (op, operand) {
        (Op::Call, 0) => Some(UnitKind::Subroutine),
        (Op::Atch, 0) => Some(UnitKind::Interrupt),
        _ => None,
    }
}

/// The type of what an operand of an instruction leads to, if it leads to anything.
fn wanted(entry: &plc_isa::Instruction, operand: usize) -> Option<Type> {
    let kinds = entry.forms.first()?.kinds.iter().filter(|kind| kind.is_written());
    kinds.clone().nth(operand)?.value_type()
}

/// What the place of an operand says about it.
struct OperandPosition<'p> {
    /// All units with the indices of their statements.
    units: &'p [(usize, Unit)],
    /// The unit that it is in, if the text has blocks.
    own: Option<&'p (usize, Unit)>,
    routine: Option<UnitKind>,
    takes_text: bool,
    /// What it leads to, as far as the instruction tells.
    wanted: Option<Type>,
    op: Op,
    /// Whether the instruction has more operands than one, and whether this is one too many.
    takes_several: bool,
    is_extra: bool,
}

impl OperandPosition<'_> {
    /// A local variable, and its address.
    fn local(&self, name: &str) -> Option<(Named, Value)> {
        let (statement, unit) = self.own?;
        let index =
            unit.variables.iter().position(|variable| is_same_name(&variable.name, name))?;
        let address = unit.variables.get(index)?.address;
        Some((Named::Local(*statement as u32, index as u32), Value::Address(address)))
    }

    fn variables(&self) -> impl Iterator<Item = &Variable> {
        self.own.into_iter().flat_map(|(_, unit)| &unit.variables)
    }
}

/// What is kept from operand to operand.
#[derive(Debug, Default)]
struct Notes {
    /// Room for a name in lower case.
    buffer: String,
    /// The names that were found.
    names: Vec<Name>,
}

impl Notes {
    fn name(&mut self, span: Span, of: Named) {
        self.names.push(Name { span, of, declares: false });
    }
}

/// Settles the operands that were left open.
pub(crate) struct Resolver<'p> {
    pub(crate) text: &'p str,
    pub(crate) symbols: &'p SymbolTable,
    pub(crate) suggester: &'p Suggester,
}

impl Resolver<'_> {
    /// Gives every pending operand its value, or an error.
    pub(crate) fn resolve(
        &self,
        program: &mut Program,
        pending: &[Pending],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let mut notes = Notes::default();
        let mut settled = None;
        let units: Vec<(usize, Unit)> =
            program.units().map(|(index, unit)| (index, unit.clone())).collect();
        // From the end, because joining two operands moves those after them.
        for &pending in pending.iter().rev() {
            let Some(Statement::Instruction(instruction)) =
                program.statements.get_mut(pending.statement)
            else {
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
            let place = OperandPosition {
                units: &units,
                own: own.and_then(|own| units.get(own)),
                routine: routine_kind(instruction.entry.op, pending.operand),
                takes_text: takes_text(instruction.entry, pending.operand),
                wanted: wanted(instruction.entry, pending.operand),
                op: instruction.entry.op,
                takes_several: written_operands(instruction.entry) > 1,
                is_extra: pending.operand >= written_operands(instruction.entry),
            };
            let timer = instruction.operands.first().cloned();
            let Some(operand) = instruction.operands.get_mut(pending.operand) else { continue };
            if let (1, Some(timer)) = (pending.operand, timer)
                && let Some(diagnostic) =
                    self.time_as_preset(instruction.entry.op, &timer, operand.span, &mut notes)
            {
                diagnostics.push(diagnostic);
                continue;
            }
            match self.value(operand.span, &place, &mut notes) {
                Ok(value) => operand.value = value,
                Err(diagnostic) if matches!(instruction.entry.op, Op::Jmp | Op::Lbl) => {
                    diagnostics.push(hints::label(*diagnostic, operand.span.text(self.text)));
                }
                Err(mut diagnostic) => {
                    // What is after the sign of a comment was not meant as operands, and what is
                    // handed over to no routine is nothing.
                    let is_comment = hints::is_comment_sign(operand.span.text(self.text));
                    if is_comment || place.routine.is_some() {
                        let after = operand.span.end..=instruction.span.end;
                        let is_after = |other: &Diagnostic| after.contains(&other.span.start);
                        while diagnostics.last().is_some_and(is_after) {
                            diagnostics.pop();
                        }
                        let mut rest = instruction.operands.iter().skip(pending.operand + 1);
                        let is_block = rest.any(|one| hints::is_block(one.span.text(self.text)));
                        let way = foreign_operands::way("DB1").filter(|_| is_block);
                        diagnostic.help.extend(way.map(str::to_owned));
                    }
                    diagnostics.push(*diagnostic);
                }
            }
        }
        program.names.append(&mut notes.names);
    }

    /// A time where a timer has its preset.
    fn time_as_preset(
        &self,
        op: Op,
        timer: &Operand,
        span: Span,
        notes: &mut Notes,
    ) -> Option<Diagnostic> {
        TimerKind::started_by(op)?;
        let (text, name) = (span.text(self.text), timer.span.text(self.text));
        let address = match timer.value {
            Value::Address(address) => address,
            // A name is settled after its preset.
            _ => match self.symbols.find(name.trim_matches('"'), &mut notes.buffer)? {
                Found::Symbol(_, Symbol { value: Value::Address(address), .. }) => *address,
                _ => return None,
            },
        };
        let Preset { counts, why, help } = foreign_operands::preset(op, address, text)?;
        let own = address.to_string();
        let named = |words: String| match name.eq_ignore_ascii_case(&own) {
            true => words,
            false => words.replacen(&format!("{own} counts"), &format!("{name} counts"), 1),
        };
        let message = named(format!("{text}: {why}"));
        let diagnostic = Diagnostic::new(Code::ConstantRange, span, message);
        Some(match counts {
            Some(counts) => diagnostic.suggest(counts.to_string()),
            None => diagnostic.help(help),
        })
    }

    /// Joins two operands that are one address with a comma or blank in it, such as `I0,0` and `I
    /// 0.0`.
    fn join(&self, instruction: &mut Instruction, index: usize) -> Option<(usize, Diagnostic)> {
        let has_more = instruction.operands.len() > written_operands(instruction.entry);
        if !has_more || routine_kind(instruction.entry.op, 0).is_some() {
            return None;
        }
        let firsts = [index.checked_sub(1), Some(index)];
        let (first, span, diagnostic) = firsts.into_iter().flatten().find_map(|first| {
            let left = instruction.operands.get(first)?.span;
            let right = instruction.operands.get(first + 1)?.span;
            let span = Span { start: left.start, end: right.end };
            let member = || self.member(left, right, wanted(instruction.entry, first));
            Some((first, span, self.joined(left, right, span).or_else(member)?))
        })?;
        instruction.operands.remove(first + 1);
        let operand = instruction.operands.get_mut(first)?;
        operand.span = span;
        operand.value = Value::Invalid;
        Some((first, diagnostic))
    }

    /// `"Data".Start`: a member of a data block.
    fn member(&self, block: Span, member: Span, wanted: Option<Type>) -> Option<Diagnostic> {
        let is_block = block.end == member.start && block.text(self.text).ends_with('"');
        let name = member.text(self.text).strip_prefix('.').filter(|_| is_block)?;
        let name = name.rsplit('.').next()?;
        let span = Span { start: block.start, end: member.end };
        let message = format!("{}: an S7-200 has no data blocks", span.text(self.text));
        let (address, kind) = hints::example(wanted);
        Some(Diagnostic::new(Code::UnknownSymbol, span, message).help(format!(
            "a variable is declared by itself, `//# var {name} {kind}`, or as a name for an \
             address, `//# symbol {name} {address}`, and used as `{name}`"
        )))
    }

    fn joined(&self, left: Span, right: Span, span: Span) -> Option<Diagnostic> {
        let between = Span { start: left.end, end: right.start }.text(self.text);
        let (left, right) = (left.text(self.text), right.text(self.text));
        let (link, why) = match between.trim() {
            "," if between == "," => (".", "a point is before the number of the bit"),
            "" => ("", "no blank is inside an address"),
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

    fn value(
        &self,
        span: Span,
        place: &OperandPosition<'_>,
        notes: &mut Notes,
    ) -> Result<Value, Box<Diagnostic>> {
        let text = span.text(self.text);
        let quoted = text.strip_prefix('"').and_then(|inside| inside.strip_suffix('"'));
        let error = |code, message: String| Err(Box::new(Diagnostic::new(code, span, message)));
        if let (None, Some(diagnostic)) = (quoted, hints::look_alike(span, text)) {
            return Err(Box::new(diagnostic));
        }
        if let Some(kind) = place.routine {
            return self.routine(span, quoted.unwrap_or(text), kind, place, notes);
        }
        if let Some(qualified) = qualified::address(text) {
            let found = self.symbols.find(qualified.name, &mut notes.buffer);
            return qualified.checked(span, found);
        }
        let bare = text.strip_prefix('#').unwrap_or(text);
        if let Some((of, value)) = place.local(bare) {
            notes.name(Span { start: span.end - bare.len() as u32, ..span }, of);
            return Ok(value);
        }
        match self.symbols.find(quoted.unwrap_or(text), &mut notes.buffer) {
            Some(Found::Symbol(index, symbol)) => {
                notes.name(span, Named::Symbol(index));
                return Ok(symbol.value.clone());
            }
            Some(Found::Ambiguous) => {
                return error(
                    Code::SymbolDefinition,
                    format!("{text}: symbol files give it different values"),
                );
            }
            Some(Found::Unusable) => {
                let message =
                    format!("{text}: the symbol stands for something that uno200 does not have");
                return error(Code::NotSupported, message);
            }
            None => {}
        }
        // An element of an array whose declaration is wrong.
        if let Some((array, _)) = text.split_once('[')
            && let Some(Found::Symbol(_, symbol)) = self.symbols.find(array, &mut notes.buffer)
            && symbol.value == Value::Invalid
        {
            return Ok(Value::Invalid);
        }
        if let Some(name) = quoted {
            if place.takes_text {
                return literal::parse(text).or_else(|message| error(Code::ConstantRange, message));
            }
            return Err(self.unknown_symbol(span, name, true, place));
        }
        match text.as_bytes() {
            [b'*', _, ..] => {
                let inner = self.value(Span { start: span.start + 1, ..span }, place, notes)?;
                pointer(span, inner)
            }
            [b'&', _, ..] => {
                let inner = self.value(Span { start: span.start + 1, ..span }, place, notes)?;
                pointer_to(span, inner)
            }
            [b'P' | b'p', b'#', ..] => Err(self.unknown_symbol(span, text, false, place)),
            [b'#', _, ..] => Err(self.unknown_local(span, place)),
            _ if literal::looks_like_literal(text) => match literal::parse(text) {
                Ok(value) => Ok(value),
                Err(message) => {
                    let mut diagnostic = Diagnostic::new(Code::ConstantRange, span, message);
                    diagnostic.suggestion = foreign_operands::number(text);
                    diagnostic.help.extend(hints::number(text, place.op, &diagnostic));
                    Err(Box::new(diagnostic))
                }
            },
            _ => self.address(span, text, place),
        }
    }

    /// A subroutine or interrupt routine: by number, by its name, or by a symbol.
    fn routine(
        &self,
        span: Span,
        name: &str,
        kind: UnitKind,
        place: &OperandPosition<'_>,
        notes: &mut Notes,
    ) -> Result<Value, Box<Diagnostic>> {
        let units = || place.units.iter().map(|(_, unit)| unit).filter(|unit| unit.id.kind == kind);
        if let Some(qualified) = qualified::routine(name, kind)
            && let Some(unit) = units().find(|unit| Value::Unit(unit.id) == qualified.value)
        {
            return match self.symbols.find(qualified.name, &mut notes.buffer) {
                _ if is_same_name(&unit.name, qualified.name) => Ok(qualified.value),
                None if unit.name.is_empty() => Ok(qualified.value),
                None => Err(qualified.other_name(span, unit)),
                found => qualified.checked(span, found),
            };
        }
        let numbered =
            || UnitId::parse(name).or_else(|| Some(UnitId { kind, number: name.parse().ok()? }));
        let by_symbol = match self.symbols.find(name, &mut notes.buffer) {
            Some(Found::Symbol(index, symbol)) => match symbol.value {
                Value::Unit(id) => Some((Named::Symbol(index), id)),
                _ => None,
            },
            _ => None,
        };
        let plain = |id: UnitId| (Named::Unit(id), id);
        let named = units().find(|unit| is_same_name(&unit.name, name)).map(|unit| plain(unit.id));
        let found = named.or(by_symbol).or_else(|| numbered().map(plain));
        if let Some((of, id)) = found.filter(|(_, id)| units().any(|unit| unit.id == *id)) {
            notes.name(span, of);
            return Ok(Value::Unit(id));
        }
        let what = if kind == UnitKind::Interrupt { "interrupt routine" } else { "subroutine" };
        let message = format!("{}: there is no such {what}", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownRoutine, span, message);
        let known: Vec<String> =
            units().flat_map(|unit| [unit.name.clone(), unit.id.to_string()]).collect();
        if let Some((bare, inside)) = name.strip_suffix(')').and_then(|name| name.split_once('(')) {
            let operands = if inside.is_empty() { "" } else { ", " };
            diagnostic.help = vec!["parameters follow after a comma, without brackets".to_owned()];
            return Err(Box::new(diagnostic.suggest(format!("{bare}{operands}{inside}"))));
        }
        let near = self
            .suggester
            .nearest(name, known.iter().map(String::as_str).filter(|name| !name.is_empty()));
        diagnostic.suggestion = near.map(str::to_owned);
        match hints::no_routine(kind, name) {
            Some(other) if near.is_none() => diagnostic.help = vec![other],
            Some(_) => {}
            None if known.is_empty() => diagnostic.help = hints::none_of(kind, name),
            None => diagnostic.help.extend(foreign_operands::way(name).map(str::to_owned)),
        }
        if diagnostic.suggestion.is_none() && diagnostic.help.is_empty() {
            let all: Vec<&str> =
                known.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
            diagnostic.help.push(format!("there are {}", all.join(", ")));
        }
        Err(Box::new(diagnostic))
    }

    fn unknown_local(&self, span: Span, place: &OperandPosition<'_>) -> Box<Diagnostic> {
        let text = span.text(self.text);
        let mut diagnostic =
            Diagnostic::new(Code::UnknownSymbol, span, format!("{text}: no such local variable"));
        let names = place.variables().map(|variable| variable.name.as_str());
        let bare = text.trim_start_matches('#');
        if literal::looks_like_literal(bare) && literal::parse(bare).is_ok() {
            diagnostic.message = format!("{text}: a number is written without #");
            return Box::new(diagnostic.suggest(bare));
        }
        let near = self.suggester.nearest(bare, names);
        let is_hexadecimal = bare.chars().all(|c| c.is_ascii_digit() || matches!(c, 'A'..='F'));
        if near.is_none() && is_hexadecimal {
            diagnostic.help.push(format!("a hexadecimal number is written `16#{bare}`"));
        }
        diagnostic.suggestion = near.map(|near| format!("#{near}"));
        if near.is_none() {
            diagnostic.help.push(match place.own {
                Some(_) => {
                    "declare it between VAR and END_VAR at the beginning of its block".into()
                }
                None => {
                    let kind = hints::example(place.wanted).1;
                    format!(
                        "a variable of the whole program is written without #, `{bare}`, and \
                         declared by `//# var {bare} {kind}`"
                    )
                }
            });
        }
        Box::new(diagnostic)
    }

    fn address(
        &self,
        span: Span,
        text: &str,
        place: &OperandPosition<'_>,
    ) -> Result<Value, Box<Diagnostic>> {
        if let Some(diagnostic) = hints::part_of_analog(span, text) {
            return Err(Box::new(diagnostic));
        }
        match Address::parse(text) {
            Ok(address) => Ok(Value::Address(address)),
            Err(AddressError::OutOfRange(message, suggestion)) => {
                let mut diagnostic = Diagnostic::new(Code::AddressRange, span, message);
                diagnostic.suggestion = suggestion
                    .or_else(|| foreign_operands::same(text))
                    .or_else(|| nearby_address(text));
                if diagnostic.suggestion.is_none() {
                    diagnostic.help.extend(hints::out_of_range(text));
                }
                let in_v =
                    text.strip_prefix(['M', 'm']).map(|rest| Address::parse(&format!("V{rest}")));
                if let (None, Some(Ok(larger))) = (&diagnostic.suggestion, in_v) {
                    diagnostic.help.push(format!("V memory has more room: `{larger}`"));
                }
                Err(Box::new(diagnostic))
            }
            Err(AddressError::NotAnAddress) if !text.contains(|c: char| c.is_alphanumeric()) => {
                let message = format!("{text}: neither an address nor a constant nor a symbol");
                let mut diagnostic = Diagnostic::new(Code::Syntax, span, message);
                diagnostic
                    .help
                    .extend(hints::sign_hint(text, place.takes_several).map(str::to_owned));
                Err(Box::new(diagnostic))
            }
            Err(AddressError::NotAnAddress) => Err(self.unknown_symbol(span, text, false, place)),
        }
    }

    /// Which elements an array has of which another was named.
    fn elements(&self, name: &str) -> Option<String> {
        let (array, index) = name.strip_suffix(']')?.split_once('[')?;
        // Another index than a number needs a pointer.
        index.trim().parse::<i64>().ok()?;
        let is_element = |known: &&str| {
            known.split_once('[').is_some_and(|(other, _)| is_same_name(other, array))
        };
        let mut elements = self.symbols.names().filter(is_element);
        let first = elements.next()?;
        let last = elements.last().unwrap_or(first);
        Some(format!("the array has the elements `{first}` to `{last}`"))
    }

    fn unknown_symbol(
        &self,
        span: Span,
        name: &str,
        is_quoted: bool,
        place: &OperandPosition<'_>,
    ) -> Box<Diagnostic> {
        let message = format!("{}: no such symbol", span.text(self.text));
        let mut diagnostic = Diagnostic::new(Code::UnknownSymbol, span, message);
        let near = self.suggester.nearest(name, self.symbols.names());
        // Another element of an array is another value.
        let near = near.filter(|_| !name.contains('['));
        diagnostic.suggestion = match near {
            Some(near) if is_quoted => Some(format!("\"{near}\"")),
            Some(near) => Some(written(near)),
            None => foreign_operands::same(name)
                .or_else(|| foreign_operands::number(name))
                .or_else(|| foreign_operands::with_offset(name))
                .or_else(|| foreign_operands::pointer(name, place.wanted == Some(Type::Double)))
                .or_else(|| hints::bare_fraction(name))
                .or_else(|| nearby_address(name)),
        };
        if let Some(range) = self.elements(name) {
            diagnostic.help.push(range);
            return Box::new(diagnostic);
        }
        diagnostic.help.extend(foreign_operands::immediate(name));
        if !is_quoted {
            let way = foreign_operands::way(name).filter(|_| diagnostic.suggestion.is_none());
            let way = way.or_else(|| hints::word_hint(name, place.wanted)).map(str::to_owned);
            let way = way.or_else(|| foreign_operands::inverted(name));
            let way = way.or_else(|| foreign_operands::range(name));
            diagnostic.help.extend(hints::immediate_contact(place.op, name).map(str::to_owned));
            diagnostic.help.extend(way.or_else(|| hints::in_mnemonic(name)));
        }
        if let (None, Some(Err(AddressError::OutOfRange(message, near)))) =
            (&diagnostic.suggestion, name.strip_prefix('%').map(Address::parse))
        {
            diagnostic.help = vec![message];
            diagnostic.suggestion = near;
        }
        if let (true, Some(value)) = (is_quoted, hints::quoted_number(name)) {
            diagnostic.help.push("a number has no quotes".to_owned());
            diagnostic.suggestion = Some(value);
        }
        let has_none = diagnostic.suggestion.is_none() && diagnostic.help.is_empty();
        if has_none && place.is_extra && place.routine.is_none() && place.op != Op::Call {
            diagnostic.help.push(hints::TOO_MANY.to_owned());
        } else if has_none {
            diagnostic.help.push(hints::declaration(
                name.trim_matches('"'),
                place.wanted,
                place.takes_text,
            ));
        }
        Box::new(diagnostic)
    }
}
