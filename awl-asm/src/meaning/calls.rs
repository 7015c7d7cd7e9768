//! Calls with their parameters: a call becomes instructions that copy what is handed over, the call
//! itself, and instructions that copy what comes back. Where local memory lies is said elsewhere.

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::misfit::value_words;
use crate::meaning::pick::{hidden, pick};
use crate::meaning::selected::{Argument, Selected};
use crate::meaning::values::read_only;
use crate::text::address::Address;
use crate::text::ast::{
    Instruction, Operand, Program, Section, Span, Type, UnitId, Value, Variable,
};

/// Selects a call.
pub(crate) fn expand(
    program: &Program,
    source: &Instruction,
    statement: u32,
    selected: &mut Vec<Selected>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(routine) = source.operands.first() else {
        let message = "CALL names the subroutine, found nothing";
        let help = "written as `CALL SBR0`, with parameters after it";
        diagnostics
            .push(Diagnostic::new(Code::OperandCount, source.mnemonic_span, message).help(help));
        return selected.push(hidden(Op::Call, &[], statement, None));
    };
    let (Value::Unit(unit), given) = (&routine.value, &source.operands[1..]) else {
        return selected.push(hidden(Op::Call, &[], statement, None));
    };
    let parameters = parameters(program, *unit);
    if parameters.len() != given.len() {
        diagnostics.push(wrong_count(*unit, &parameters, source));
        return selected.push(hidden(Op::Call, &[Argument::Routine(*unit)], statement, None));
    }
    let call = hidden(Op::Call, &[Argument::Routine(*unit)], statement, None);
    if parameters.is_empty() {
        return selected.push(call);
    }
    selected.push(hidden(Op::CallBegin, &[], statement, None));
    let mut copies_back = Vec::new();
    for (index, (parameter, operand)) in (1..).zip(parameters.iter().zip(given)) {
        if operand.value == Value::Invalid {
            continue;
        }
        let copy = Copy { program, unit: *unit, parameter, operand, index, statement };
        if let Some(diagnostic) = copy.wrong() {
            diagnostics.push(diagnostic);
            continue;
        }
        selected.extend((parameter.section != Section::Out).then(|| copy.there()).flatten());
        copies_back.extend((parameter.section != Section::In).then(|| copy.back()).flatten());
    }
    selected.push(call);
    selected.extend(copies_back);
}

/// The parameters of a subroutine in the order of a call.
fn parameters(program: &Program, unit: UnitId) -> Vec<&Variable> {
    let found = program.units().find(|(_, other)| other.id == unit);
    let variables = found.into_iter().flat_map(|(_, unit)| &unit.variables);
    variables.filter(|variable| variable.section != Section::Temp).collect()
}

fn wrong_count(unit: UnitId, parameters: &[&Variable], source: &Instruction) -> Diagnostic {
    let words = |count: usize| match count {
        0 => "no parameter".to_owned(),
        1 => "one parameter".to_owned(),
        count => format!("{count} parameters"),
    };
    let given = source.operands.len() - 1;
    let message = format!("{unit} takes {}, found {given}", words(parameters.len()));
    let span = match source.operands.get(parameters.len() + 1) {
        Some(extra) => Span { start: extra.span.start, end: source.span.end },
        None => source.span,
    };
    let diagnostic = Diagnostic::new(Code::ParameterCount, span, message);
    if parameters.is_empty() {
        return diagnostic.help(format!(
            "`CALL {unit}` alone; what it shall get is declared in it, before its `BEGIN`: \
             `VAR_INPUT`, `Level : INT;`, `END_VAR`"
        ));
    }
    let examples: Vec<String> =
        parameters.iter().enumerate().map(|(index, one)| example(one, index)).collect();
    let list: Vec<String> = parameters.iter().map(|parameter| described(parameter)).collect();
    diagnostic.help(format!(
        "in this order: {}; such as `CALL {unit}, {}`",
        list.join(", "),
        examples.join(", ")
    ))
}

/// What can be handed over for a parameter.
fn example(parameter: &Variable, index: usize) -> String {
    let byte = 10 * index;
    match parameter.kind {
        Type::Bool => format!("M{index}.0"),
        Type::Byte | Type::Char => format!("VB{byte}"),
        Type::Word | Type::Int => format!("VW{byte}"),
        Type::Dword | Type::Dint | Type::Real => format!("VD{byte}"),
        Type::Text => format!("&VB{byte}"),
    }
}

/// `IN Speed:INT`
fn described(parameter: &Variable) -> String {
    format!("{} {}:{}", parameter.section.name(), parameter.name, parameter.kind.name())
}

/// A parameter with what a call hands over for it.
struct Copy<'a> {
    program: &'a Program,
    unit: UnitId,
    parameter: &'a Variable,
    operand: &'a Operand,
    /// The number of the operand of CALL.
    index: u8,
    statement: u32,
}

impl Copy<'_> {
    /// What is wrong with it.
    fn wrong(&self) -> Option<Diagnostic> {
        let (parameter, operand) = (self.parameter, self.operand);
        let help = format!("the parameter is {}", described(parameter));
        let error = |message: String| {
            Diagnostic::new(Code::ParameterKind, operand.span, message).help(help.clone())
        };
        let is_constant = matches!(
            operand.value,
            Value::Constant(_) | Value::Real(_) | Value::Text(_) | Value::AddressOf(_)
        );
        if is_constant && parameter.section != Section::In {
            let (name, unit) = (&parameter.name, self.unit);
            return Some(error(match parameter.section {
                Section::InOut => {
                    format!("{name} goes to {unit} and comes back: a constant cannot take it")
                }
                _ => format!("{name} comes back from {unit}: a constant cannot take it"),
            }));
        }
        if !self.fits() {
            let (wanted, found) = (type_words(parameter), value_words(self.program, operand));
            return Some(error(format!(
                "{} is handed over as {wanted}, found {found}",
                parameter.name
            )));
        }
        match operand.value {
            Value::Address(address) if parameter.section != Section::In => {
                read_only(self.program, address, operand.span)
                    .map(|diagnostic| diagnostic.help(help))
            }
            _ => None,
        }
    }

    fn fits(&self) -> bool {
        let is_pointer = matches!(self.operand.value, Value::AddressOf(_));
        match (&self.operand.value, self.parameter.kind) {
            (Value::Address(Address::Bit { .. }), Type::Bool) => true,
            (Value::Address(Address::Timer(_) | Address::Counter(_)), Type::Bool) => {
                self.parameter.section == Section::In
            }
            (Value::Constant(constant), Type::Bool) => matches!(constant.value, 0 | 1),
            (_, Type::Bool) => false,
            (Value::Real(_), kind) => kind == Type::Real,
            (Value::Constant(constant), Type::Real) => !constant.is_pattern,
            (Value::Constant(constant), Type::Int) => {
                constant.is_pattern || constant.value <= i64::from(i16::MAX)
            }
            (Value::Constant(constant), Type::Dint) => {
                constant.is_pattern || constant.value <= i64::from(i32::MAX)
            }
            (Value::Constant(_), Type::Text) => false,
            (_, kind) if is_pointer => matches!(kind, Type::Dword | Type::Dint | Type::Text),
            _ => {
                self.there().is_some()
                    && (self.parameter.section == Section::In || self.back().is_some())
            }
        }
    }

    /// The copy to the subroutine.
    fn there(&self) -> Option<Selected> {
        let place = Argument::Parameter(self.unit, self.parameter.address);
        if self.parameter.kind != Type::Bool {
            return self.copy(&self.operand.value, &Value::Address(self.parameter.address), 1);
        }
        match &self.operand.value {
            Value::Address(address) => {
                let copy = hidden(
                    Op::BitCopy,
                    &[Argument::Bit(*address), place],
                    self.statement,
                    Some(self.index),
                );
                Some(Selected { written: 2, ..copy })
            }
            Value::Constant(constant) => {
                let op = if constant.value == 0 { Op::Reset } else { Op::Set };
                let copy =
                    hidden(op, &[place, Argument::Constant(1)], self.statement, Some(self.index));
                Some(Selected { written: 1, ..copy })
            }
            _ => None,
        }
    }

    /// The copy back.
    fn back(&self) -> Option<Selected> {
        if self.parameter.kind != Type::Bool {
            return self.copy(&Value::Address(self.parameter.address), &self.operand.value, 0);
        }
        let Value::Address(address) = self.operand.value else { return None };
        let place = Argument::Parameter(self.unit, self.parameter.address);
        let copy =
            hidden(Op::BitCopy, &[place, Argument::Bit(address)], self.statement, Some(self.index));
        Some(Selected { written: 2, ..copy })
    }

    /// A move; the parameter is its operand number `own`.
    fn copy(&self, from: &Value, to: &Value, own: usize) -> Option<Selected> {
        let op = match self.parameter.kind.bytes() {
            1 => Op::Movb,
            2 => Op::Movw,
            _ => Op::Movd,
        };
        // The bits of a real are moved as they are.
        let value = |value: &Value| match (value, self.parameter.kind) {
            (Value::Real(bits), _) => Some(Argument::Literal(*bits as i32)),
            (Value::Constant(constant), Type::Real) => {
                Some(Argument::Literal((constant.value as f32).to_bits() as i32))
            }
            _ => None,
        };
        let operand = |value: &Value| Operand { span: self.operand.span, value: value.clone() };
        let place = Argument::Parameter(self.unit, self.parameter.address);
        if let Some(literal) = value(from) {
            let copy = hidden(Op::Movd, &[literal, place], self.statement, Some(self.index));
            return Some(Selected { written: 2, ..copy });
        }
        let operands = [operand(from), operand(to)];
        let mut selected = pick(op.instruction(), None, &operands, self.statement)?;
        selected.arguments[own] = place;
        selected.parameter = Some(self.index);
        Some(selected)
    }
}

/// What can be handed over: constants for an IN parameter only, and what comes back is no bit of a
/// timer or counter.
fn type_words(parameter: &Variable) -> &'static str {
    match (parameter.kind, parameter.section == Section::In) {
        (Type::Bool, true) => "a bit, TRUE or FALSE",
        (Type::Byte | Type::Char, true) => "a byte or a constant 0 to 255",
        (Type::Word, true) => "a word or a constant -32768 to 65535",
        (Type::Int, true) => "a word or a constant -32768 to 32767",
        (Type::Dword, true) => "a double word or a constant -2147483648 to 4294967295",
        (Type::Dint, true) => "a double word or a constant -2147483648 to 2147483647",
        (Type::Real, true) => "a double word or a real constant",
        (Type::Text, _) => "a double word that points to a text, such as &VB100",
        (Type::Bool, false) => "a bit of memory",
        (Type::Byte | Type::Char, false) => "a byte",
        (Type::Word | Type::Int, false) => "a word",
        (Type::Dword | Type::Dint | Type::Real, false) => "a double word",
    }
}
