//! Finds for each parsed instruction the entry of the instruction table that its operands fit. No flow, no memory plan.

use std::collections::HashMap;
use std::sync::LazyLock;

use plc_isa::{
    INSTRUCTIONS, Instruction, Kind, Op, Relation, TimerKind, TimerResolution, timer_family, timer_resolution,
};

use crate::address::Address;
use crate::ast::{self, Constant, Span, Statement, Value};
use crate::diagnostic::{Code, Diagnostic};

/// An operand whose kind is settled, but not its place in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Argument {
    /// A bit, including those of timers and counters.
    Bit(Address),
    /// A byte or word in memory; timers and counters stand for their current values.
    Memory(Address),
    /// A constant as it is stored.
    Constant(u16),
    /// A level, count, label or other number.
    Number(u8),
    /// A timer that is started or reset.
    Timer(u8),
    /// A counter that counts or is reset.
    Counter(u8),
    /// No operand.
    None,
}

/// Most operands that stand in the text of an instruction.
pub const ARGUMENTS_MAX: usize = 3;

/// An instruction whose table entry is known.
#[derive(Debug, Clone, Copy)]
pub struct Selected {
    /// The instruction.
    pub op: Op,
    /// Its comparison, if it is one.
    pub relation: Option<Relation>,
    /// Its operands in the order of the text.
    pub arguments: [Argument; ARGUMENTS_MAX],
    /// Which of them it writes through, a bit each.
    pub written: u8,
    /// Its number among the statements of the program.
    pub statement: u32,
}

impl Selected {
    /// The operands in use, with whether each is written through.
    pub fn arguments(&self) -> impl Iterator<Item = (Argument, bool)> + '_ {
        let in_use = self.arguments.iter().take_while(|&&argument| argument != Argument::None);
        in_use.enumerate().map(|(index, &argument)| (argument, self.written >> index & 1 != 0))
    }
}

static BY_MNEMONIC: LazyLock<HashMap<&'static str, Vec<&'static Instruction>>> = LazyLock::new(|| {
    let mut map: HashMap<_, Vec<_>> = HashMap::new();
    for instruction in INSTRUCTIONS.iter().filter(|instruction| !instruction.mnemonics.is_empty()) {
        map.entry(instruction.mnemonic()).or_default().push(instruction);
    }
    map
});

/// Selects every instruction of a program. One whose operands do not fit is reported and stays without them, so that
/// its effect on the logic stack is not lost to the checks that follow.
pub fn select(program: &ast::Program, diagnostics: &mut Vec<Diagnostic>) -> Vec<Selected> {
    let mut selected = Vec::with_capacity(program.statements.len());
    for (index, statement) in program.statements.iter().enumerate() {
        if let Statement::Instruction(instruction) = statement {
            selected.extend(select_one(instruction, index as u32, diagnostics));
        }
    }
    selected
}

fn select_one(source: &ast::Instruction, statement: u32, diagnostics: &mut Vec<Diagnostic>) -> Option<Selected> {
    let candidates = BY_MNEMONIC.get(source.mnemonic)?;
    let selected = |op, (arguments, written)| Selected { op, relation: source.relation, arguments, written, statement };
    for instruction in candidates {
        if let Some(fitting) = instruction.forms.iter().find_map(|form| fit_all(form.kinds, &source.operands)) {
            let selected = selected(instruction.op, fitting);
            check_values(source, &selected, diagnostics);
            return Some(selected);
        }
    }
    if source.operands.iter().all(|operand| operand.value != Value::Invalid) {
        diagnostics.push(misfit(source, candidates));
    }
    let likely = candidates.first()?;
    Some(selected(likely.op, (fit_beginning(likely.forms.first()?.kinds, &source.operands), 0)))
}

/// The operands before the first that does not fit: they say at least which timer or counter is meant.
fn fit_beginning(kinds: &'static [Kind], operands: &[ast::Operand]) -> [Argument; ARGUMENTS_MAX] {
    let mut arguments = [Argument::None; ARGUMENTS_MAX];
    let fitting = written_kinds(kinds).zip(operands).map_while(|(kind, operand)| fit(kind, &operand.value));
    for (place, argument) in arguments.iter_mut().zip(fitting) {
        *place = argument;
    }
    arguments
}

/// The operands of a form that stand in the text.
fn written_kinds(kinds: &'static [Kind]) -> impl Iterator<Item = Kind> + Clone {
    // `One` is a count that the text spells out.
    kinds.iter().copied().filter(|kind| kind.is_written())
}

fn fit_all(kinds: &'static [Kind], operands: &[ast::Operand]) -> Option<([Argument; ARGUMENTS_MAX], u8)> {
    let mut arguments = [Argument::None; ARGUMENTS_MAX];
    let mut written = 0;
    let mut operands = operands.iter();
    for (index, kind) in written_kinds(kinds).enumerate() {
        *arguments.get_mut(index)? = fit(kind, &operands.next()?.value)?;
        written |= u8::from(kind.is_output()) << index;
    }
    operands.next().is_none().then_some((arguments, written))
}

/// The operand as an argument of this kind, if it is one.
fn fit(kind: Kind, value: &Value) -> Option<Argument> {
    match (class_of(kind), value) {
        (Class::Bit, &Value::Address(address @ Address::Bit { .. })) => Some(Argument::Bit(address)),
        (Class::Bit, &Value::Address(address @ (Address::Timer(_) | Address::Counter(_)))) => {
            let resets = matches!(kind, Kind::PageBitReset | Kind::FarBitReset);
            (!resets).then_some(Argument::Bit(address))
        }
        (Class::Byte, &Value::Address(address @ Address::Byte { .. })) => Some(Argument::Memory(address)),
        (Class::Word, &Value::Address(address)) if is_word(address) => Some(Argument::Memory(address)),
        (Class::AnyByte, value) => fit(Kind::Byte, value).or_else(|| fit(Kind::ByteConst, value)),
        (Class::AnyInt, value) => fit(Kind::Word, value).or_else(|| fit(Kind::IntConst, value)),
        (Class::Timer, &Value::Address(Address::Timer(number))) => Some(Argument::Timer(number)),
        (Class::Counter, &Value::Address(Address::Counter(number))) => Some(Argument::Counter(number)),
        (Class::Constant(least, most), &Value::Constant(constant)) => {
            let most = if constant.is_pattern && most == i64::from(i16::MAX) { 0xFFFF } else { most };
            (least..=most).contains(&constant.value).then_some(Argument::Constant(constant.value as u16))
        }
        (Class::Number(most), &Value::Constant(Constant { value, .. })) => {
            (0..=most).contains(&value).then_some(Argument::Number(value as u8))
        }
        _ => None,
    }
}

fn is_word(address: Address) -> bool {
    matches!(address, Address::Word { .. } | Address::Analog(_) | Address::Timer(_) | Address::Counter(_))
}

/// What kinds have in common as far as the text goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Class {
    Bit,
    Byte,
    Word,
    AnyByte,
    AnyInt,
    Constant(i64, i64),
    Timer,
    Counter,
    Number(i64),
    NotWritten,
}

fn class_of(kind: Kind) -> Class {
    let (least, most) = kind.range().map_or((0, 0), |(least, most)| (i64::from(least), i64::from(most)));
    match kind {
        Kind::PageBit | Kind::PageBitOut | Kind::PageBitReset | Kind::FarBit | Kind::FarBitOut | Kind::FarBitReset => {
            Class::Bit
        }
        Kind::Byte | Kind::ByteOut => Class::Byte,
        Kind::Word | Kind::WordOut => Class::Word,
        Kind::AnyByte => Class::AnyByte,
        Kind::AnyInt => Class::AnyInt,
        Kind::ByteConst | Kind::WordConst | Kind::IntConst | Kind::One | Kind::Count => Class::Constant(least, most),
        Kind::TimerSlot | Kind::TimerNumber => Class::Timer,
        Kind::CounterSlot | Kind::CounterNumber => Class::Counter,
        Kind::Level | Kind::Number | Kind::LabelIndex | Kind::LabelNumber => Class::Number(most),
        Kind::Edge | Kind::LoopEnd | Kind::LoopStart | Kind::Relation | Kind::Here => Class::NotWritten,
    }
}

fn class_words(class: Class) -> String {
    match class {
        Class::Bit => "a bit".into(),
        Class::Byte => "a byte".into(),
        Class::Word => "a word".into(),
        Class::AnyByte => "a byte or a constant 0 to 255".into(),
        Class::AnyInt => "a word or a constant -32768 to 32767".into(),
        Class::Constant(least, most) => format!("a constant {least} to {most}"),
        Class::Timer => "a timer T0 to T255".into(),
        Class::Counter => "a counter C0 to C255".into(),
        Class::Number(most) => format!("a number 0 to {most}"),
        Class::NotWritten => String::new(),
    }
}

/// Why no form of the candidates fits.
fn misfit(source: &ast::Instruction, candidates: &[&'static Instruction]) -> Diagnostic {
    let forms = || candidates.iter().flat_map(|instruction| instruction.forms);
    let counts: Vec<usize> = forms().map(|form| written_kinds(form.kinds).count()).collect();
    let (name, given) = (source.mnemonic, source.operands.len());
    if !counts.contains(&given) {
        let wanted = counts.first().copied().unwrap_or(0);
        return wrong_count(source, wanted).help(usage(candidates));
    }
    // The first operand that no form accepts; if each is accepted by some form, the last one is at odds.
    let mut position = given.saturating_sub(1);
    for (index, operand) in source.operands.iter().enumerate() {
        if !forms()
            .any(|form| written_kinds(form.kinds).nth(index).is_some_and(|kind| fit(kind, &operand.value).is_some()))
        {
            position = index;
            break;
        }
    }
    let Some(operand) = source.operands.get(position) else { return wrong_count(source, 0) };
    let prefix = &source.operands[..position];
    let classes = classes_at(candidates, prefix, position);
    wrong_operand(name, operand, &classes).help(usage(candidates))
}

/// What may stand at a position, given the operands before it.
fn classes_at(candidates: &[&'static Instruction], prefix: &[ast::Operand], position: usize) -> Vec<Class> {
    let mut classes = Vec::new();
    for form in candidates.iter().flat_map(|instruction| instruction.forms) {
        let prefix_fits =
            written_kinds(form.kinds).zip(prefix).all(|(kind, operand)| fit(kind, &operand.value).is_some());
        let Some(kind) = written_kinds(form.kinds).nth(position) else { continue };
        let class = class_of(kind);
        if prefix_fits && kind != Kind::One && !classes.contains(&class) {
            classes.push(class);
        }
    }
    // A general class says in one phrase what the others say in several, if those have a constant among them too.
    let is_general = |class: &Class| matches!(class, Class::AnyByte | Class::AnyInt);
    let has_constant = classes.iter().any(|class| matches!(class, Class::Constant(..)));
    if classes.iter().any(is_general) {
        classes.retain(|class| is_general(class) != has_constant);
    }
    classes
}

fn wrong_count(source: &ast::Instruction, wanted: usize) -> Diagnostic {
    let count = match wanted {
        0 => "no operand".into(),
        1 => "one operand".into(),
        wanted => format!("{wanted} operands"),
    };
    let message = format!("{} takes {count}, found {}", source.mnemonic, source.operands.len());
    let span = match source.operands.get(wanted) {
        Some(extra) => Span { start: extra.span.start, end: source.span.end },
        None => source.mnemonic_span,
    };
    Diagnostic::new(Code::OperandCount, span, message)
}

fn wrong_operand(name: &str, operand: &ast::Operand, classes: &[Class]) -> Diagnostic {
    let wanted = match classes.iter().map(|&class| class_words(class)).collect::<Vec<_>>().as_slice() {
        [] => "something else".to_string(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    };
    let is_constant_class =
        |class: &Class| matches!(class, Class::Constant(..) | Class::Number(_) | Class::AnyByte | Class::AnyInt);
    match operand.value {
        Value::Constant(constant) if classes.iter().any(is_constant_class) => {
            let message = format!("{}: {name} takes {wanted} here", constant.value);
            Diagnostic::new(Code::ConstantRange, operand.span, message).label("out of range")
        }
        _ => {
            let message = format!("{name} takes {wanted} here, found {}", value_words(&operand.value));
            Diagnostic::new(Code::OperandKind, operand.span, message).label("wrong kind of operand")
        }
    }
}

fn value_words(value: &Value) -> String {
    match value {
        Value::Address(address @ Address::Bit { .. }) => format!("the bit {address}"),
        Value::Address(address @ Address::Byte { .. }) => format!("the byte {address}"),
        Value::Address(address @ (Address::Word { .. } | Address::Analog(_))) => format!("the word {address}"),
        Value::Address(address @ Address::Timer(_)) => format!("the timer {address}"),
        Value::Address(address @ Address::Counter(_)) => format!("the counter {address}"),
        Value::Constant(constant) => format!("the constant {}", constant.value),
        Value::Invalid => "something invalid".into(),
    }
}

/// How the instruction is written, from the table.
fn usage(candidates: &[&'static Instruction]) -> String {
    let Some(instruction) = candidates.first() else { return String::new() };
    let Some(form) = instruction.forms.first() else { return String::new() };
    let names: Vec<String> = instruction
        .operand_names
        .iter()
        .zip(form.kinds)
        .filter(|(_, kind)| kind.is_written())
        .map(|(name, _)| operand_name(name))
        .collect();
    let relation = if instruction.has_relation() { "=" } else { "" };
    let text = format!("{}{relation} {}", instruction.mnemonic(), names.join(", "));
    format!("written as `{}`", text.trim_end())
}

/// The name of an operand in the manual's spelling.
pub fn operand_name(name: &str) -> String {
    match name {
        "input" => "IN".into(),
        "last" => "FINAL".into(),
        "timer" => "Txxx".into(),
        "counter" => "Cxxx".into(),
        "first" => "T or C".into(),
        "label" => "n".into(),
        "bit" | "n" => name.into(),
        other => other.to_ascii_uppercase(),
    }
}

/// Checks what the kinds leave open: writing to inputs, and timer numbers.
fn check_values(source: &ast::Instruction, selected: &Selected, diagnostics: &mut Vec<Diagnostic>) {
    for ((argument, written), operand) in selected.arguments().zip(&source.operands) {
        if let (Argument::Bit(address) | Argument::Memory(address), true) = (argument, written) {
            diagnostics.extend(read_only(address, operand.span));
        }
    }
    if let (Some(kind), Argument::Timer(number)) = (TimerKind::started_by(selected.op), selected.arguments[0])
        && !kind.fits(number)
        && let Some(operand) = source.operands.first()
    {
        diagnostics.push(wrong_family(source.mnemonic, number, kind, operand.span));
    }
    diagnostics.extend(past_the_end(source, selected));
}

fn read_only(address: Address, span: Span) -> Option<Diagnostic> {
    let message = match address {
        Address::Bit { area, byte, .. } | Address::Byte { area, byte } | Address::Word { area, byte } => {
            if byte >= area.first_writable() {
                return None;
            }
            match area {
                plc_isa::Area::I => format!("{address} is an input: a program cannot write it"),
                _ => format!("{address} is written by the system: a program can only read SMB0 to SMB29"),
            }
        }
        Address::Analog(_) => format!("{address} is an analog input: a program cannot write it"),
        Address::Timer(_) | Address::Counter(_) => return None,
    };
    Some(Diagnostic::new(Code::ReadOnly, span, message).label("read only"))
}

fn wrong_family(mnemonic: &str, number: u8, kind: TimerKind, span: Span) -> Diagnostic {
    let resolution = timer_resolution(number);
    let fitting: Vec<u8> =
        (0..=255).filter(|&other| kind.fits(other) && timer_resolution(other) == resolution).collect();
    let family = match timer_family(number) {
        plc_isa::TimerFamily::Tonr => "a TONR number",
        plc_isa::TimerFamily::TonTof => "a TON or TOF number",
    };
    let mut diagnostic =
        Diagnostic::new(Code::TimerFamily, span, format!("T{number} is {family}: {mnemonic} needs another one"))
            .help(format!("with {}, {mnemonic} can use {}", resolution_words(resolution), ranges(&fitting)));
    if let Some(first) = fitting.first() {
        diagnostic = diagnostic.suggest(format!("T{first}"));
    }
    diagnostic
}

fn resolution_words(resolution: TimerResolution) -> String {
    format!("{} ms", resolution.ms())
}

/// `T37-T63, T101-T255`
fn ranges(numbers: &[u8]) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut rest = numbers;
    while let Some(&first) = rest.first() {
        let run = rest.iter().zip(first..=255).take_while(|(a, b)| **a == *b).count();
        let last = rest[run - 1];
        parts.push(if run == 1 { format!("T{first}") } else { format!("T{first}-T{last}") });
        rest = &rest[run..];
    }
    parts.join(", ")
}

/// A constant count that leads out of the area.
fn past_the_end(source: &ast::Instruction, selected: &Selected) -> Option<Diagnostic> {
    let &[first, Argument::Constant(count), _] = &selected.arguments else { return None };
    let (place, size, last) = match (selected.op, first) {
        (Op::Set | Op::Reset, Argument::Bit(Address::Bit { area, byte, bit })) => (
            u32::from(byte) * 8 + u32::from(bit),
            u32::from(area.size()) * 8,
            format!("{}{}.7", area.name(), area.size() - 1),
        ),
        (Op::Set, Argument::Bit(Address::Timer(number))) | (_, Argument::Timer(number)) => {
            (u32::from(number), 256, "T255".into())
        }
        (Op::Set, Argument::Bit(Address::Counter(number))) | (_, Argument::Counter(number)) => {
            (u32::from(number), 256, "C255".into())
        }
        _ => return None,
    };
    if matches!(selected.op, Op::Set | Op::Reset | Op::ResetTimers | Op::ResetCounters)
        && u32::from(count) > size - place
    {
        let operand = source.operands.get(1)?;
        let message = format!("{count}: the range ends behind {last}");
        let most = size - place;
        return Some(
            Diagnostic::new(Code::ConstantRange, operand.span, message).help(format!("at most {most} fit here")),
        );
    }
    None
}
