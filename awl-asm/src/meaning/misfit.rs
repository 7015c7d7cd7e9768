//! Says why operands fit no form of their instruction, and what would.

use plc_isa::{Form, Instruction, Kind, Profile};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::example::example;
use crate::meaning::fit::{Class, class_of, fit, written_kinds};
use crate::meaning::limits::constant_words;
use crate::meaning::order;
use crate::meaning::quoted::{Quoted, number, told};
use crate::meaning::{operand_count, operands};
use crate::text::address::Address;
use crate::text::ast::{self, Span, Value};

/// Why no form of the candidates fits.
pub(crate) fn misfit(
    quoted: Quoted<'_>,
    candidates: &[&'static Instruction],
    profile: &Profile,
) -> Diagnostic {
    let source = quoted.source;
    let forms = || {
        candidates
            .iter()
            .flat_map(|instruction| instruction.forms.iter().map(move |form| (instruction, form)))
    };
    let counts: Vec<usize> = forms().map(|(_, form)| written_kinds(form.kinds).count()).collect();
    let given = source.operands.len();
    if !counts.contains(&given) {
        let wanted = counts.first().copied().unwrap_or(0);
        let mut diagnostic = wrong_count(source, wanted);
        let takes_real = forms().any(|(instruction, form)| {
            let mut kinds = written_kinds(form.kinds).enumerate();
            kinds.any(|(index, kind)| fit(instruction, kind, index, &Value::Real(0)).is_some())
        });
        let way = operand_count::way(quoted, wanted, takes_real);
        diagnostic.help.extend(usage(quoted, candidates, way));
        return diagnostic;
    }
    // The first operand that no form accepts; if each is accepted by some form, the last one is at
    // odds.
    let mut position = given.saturating_sub(1);
    for (index, operand) in source.operands.iter().enumerate() {
        let fits = |instruction, form: &'static Form| {
            written_kinds(form.kinds)
                .nth(index)
                .is_some_and(|kind| fit(instruction, kind, index, &operand.value).is_some())
        };
        if !forms().any(|(instruction, form)| fits(instruction, form)) {
            position = index;
            break;
        }
    }
    let Some(operand) = source.operands.get(position) else { return wrong_count(source, 0) };
    let prefix = &source.operands[..position];
    let classes = classes_at(candidates, prefix, position);
    let narrower = candidates.first().and_then(|instruction| constant_words(instruction, position));
    let mut diagnostic = wrong_operand(quoted, operand, &classes, narrower, profile);
    let way = operands::way_of_kind(quoted, position).or_else(|| order::way(quoted, candidates));
    diagnostic.help.extend(usage(quoted, candidates, way));
    diagnostic
}

/// What may be at a position, given the operands before it.
fn classes_at(
    candidates: &[&'static Instruction],
    prefix: &[ast::Operand],
    position: usize,
) -> Vec<Class> {
    let mut classes = Vec::new();
    let forms = candidates
        .iter()
        .flat_map(|instruction| instruction.forms.iter().map(move |form| (instruction, form)));
    for (instruction, form) in forms {
        let prefix_fits =
            written_kinds(form.kinds).zip(prefix).enumerate().all(|(index, (kind, operand))| {
                fit(instruction, kind, index, &operand.value).is_some()
            });
        let Some(kind) = written_kinds(form.kinds).nth(position) else { continue };
        let class = class_of(instruction, kind, position);
        if prefix_fits && kind != Kind::One && !classes.contains(&class) {
            classes.push(class);
        }
    }
    // A general class says in one phrase what the others say in several, if those have a constant
    // among them too.
    let has_constant = classes.iter().any(|class| matches!(class, Class::Constant(..)));
    if classes.iter().any(|class| class.is_general()) {
        classes.retain(|class| class.is_general() != has_constant);
    }
    classes
}

fn wrong_count(source: &ast::Instruction, wanted: usize) -> Diagnostic {
    let count = match wanted {
        0 => "no operand".into(),
        1 => "one operand".into(),
        wanted => format!("{wanted} operands"),
    };
    let message = format!("{} takes {count}, found {}", source.mnemonic(), source.operands.len());
    let span = match source.operands.get(wanted) {
        Some(extra) => Span { start: extra.span.start, end: source.span.end },
        None => source.mnemonic_span,
    };
    Diagnostic::new(Code::OperandCount, span, message)
}

/// `narrower` says what may be there if the instruction takes fewer constants than their class
/// has.
fn wrong_operand(
    quoted: Quoted<'_>,
    operand: &ast::Operand,
    classes: &[Class],
    narrower: Option<String>,
    profile: &Profile,
) -> Diagnostic {
    let (program, name) = (quoted.program, quoted.source.mnemonic());
    let is_constant_class = |class: &Class| class.constants().is_some();
    let words = |class: &Class| {
        narrower
            .clone()
            .filter(|_| is_constant_class(class))
            .unwrap_or_else(|| class.words(profile))
    };
    let wanted = match classes.iter().map(words).collect::<Vec<_>>().as_slice() {
        [] => "something else".to_string(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    };
    let is_word_class =
        |class: &Class| matches!(class, Class::Word | Class::AnyInt | Class::AnyWord);
    match operand.value {
        // As an output it would have been taken.
        Value::Address(address @ Address::AnalogOutput(_)) if classes.iter().any(is_word_class) => {
            let address = told(program, operand.span, address);
            let message = format!("{name} reads this operand, but {address} can only be written");
            let diagnostic =
                Diagnostic::new(Code::OperandKind, operand.span, message).label("write only");
            diagnostic.help(format!(
                "keep the value in a word of its own, such as VW0, and copy it: \
                    `MOVW VW0, {address}`"
            ))
        }
        Value::Constant(constant) if classes.iter().any(is_constant_class) => {
            let written = number(constant);
            let message = format!("{written}: {name} takes {wanted} here");
            Diagnostic::new(Code::ConstantRange, operand.span, message).label("out of range")
        }
        _ => {
            let message =
                format!("{name} takes {wanted} here, found {}", value_words(program, operand));
            let diagnostic = Diagnostic::new(Code::OperandKind, operand.span, message)
                .label("wrong kind of operand");
            match operand.value {
                Value::Address(address @ Address::Analog(_)) if classes == [Class::Bit] => {
                    diagnostic.help(format!(
                        "an analog input is compared, for example `LDW>= {}, 16000`",
                        quoted.address(address)
                    ))
                }
                Value::Indirect(address) if name == "FOR" => {
                    let first = format!("`MOVW VW0, *{address}` as its first instruction");
                    diagnostic.help(format!(
                        "let it count in a word that is named, such as VW0, with {first}"
                    ))
                }
                _ => diagnostic,
            }
        }
    }
}

/// What an operand is, with the kind of its address.
pub(crate) fn value_words(program: &ast::Program, operand: &ast::Operand) -> String {
    match &operand.value {
        &Value::Address(address) => {
            let kind = match address {
                Address::Bit { .. } => "bit",
                Address::Byte { .. } => "byte",
                Address::Word { .. } | Address::Analog(_) | Address::AnalogOutput(_) => "word",
                Address::Double { .. } => "double word",
                Address::Timer(_) => "timer",
                Address::Counter(_) => "counter",
                Address::Accumulator(_) => "accumulator",
                Address::HighSpeedCounter(_) => "high-speed counter",
            };
            format!("the {kind} {}", told(program, operand.span, address))
        }
        Value::Constant(constant) => format!("the constant {}", constant.value),
        Value::Real(bits) => format!("the real number {:?}", f32::from_bits(*bits)),
        Value::Text(_) => "a text".into(),
        Value::Indirect(address) => format!("*{address}"),
        Value::AddressOf(address) => format!("the pointer &{address}"),
        Value::Unit(unit) => unit.to_string(),
        Value::Invalid => "something invalid".into(),
    }
}

/// How the instruction is written, from the table, and what there is to say of this one: an example
/// where that is nothing.
fn usage(
    quoted: Quoted<'_>,
    candidates: &[&'static Instruction],
    way: Option<String>,
) -> Vec<String> {
    let Some(instruction) = candidates.first() else { return Vec::new() };
    let Some(form) = instruction.forms.first() else { return Vec::new() };
    let names: Vec<String> = instruction
        .operand_names
        .iter()
        .zip(form.kinds)
        .filter(|(_, kind)| kind.is_written())
        .map(|(name, _)| operand_name(name))
        .collect();
    let relation = quoted.source.relation.map_or("", |relation| relation.symbol());
    let text = format!("{}{relation} {}", instruction.mnemonic(), names.join(", "));
    let usage = format!("written as `{}`", text.trim_end());
    match (way, example(quoted, candidates)) {
        (Some(way), _) => vec![usage, way],
        (None, Some(example)) => vec![format!("{usage}, such as `{example}`")],
        (None, None) => vec![usage],
    }
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
