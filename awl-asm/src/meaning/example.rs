//! An example of an instruction, with the operands that the text has as far as they fit.

use plc_isa::{Does, Form, Instruction, Kind, Many, Op, Role, Takes, TimerKind};

use crate::meaning::fit::{Class, class_of, fit, written_kinds};
use crate::meaning::quoted::Quoted;

/// How the instruction could be, such as `SHRB I0.1, V0.0, 8`.
pub(super) fn example(quoted: Quoted<'_>, candidates: &[&'static Instruction]) -> Option<String> {
    let instruction = candidates.first()?;
    // The form that takes most of what is there.
    let fitting = |form: &&Form| {
        let kinds = written_kinds(form.kinds).enumerate();
        kinds.filter(|&(index, kind)| given(quoted, instruction, kind, index).is_some()).count()
    };
    let form = instruction.forms.iter().max_by_key(fitting)?;
    let roles = instruction.written_roles();
    let operands: Vec<String> = written_kinds(form.kinds)
        .zip(roles)
        .enumerate()
        .map(|(index, (kind, role))| {
            given(quoted, instruction, kind, index)
                .unwrap_or_else(|| usual(instruction, kind, role, index))
        })
        .collect();
    let relation = quoted.source.relation.map_or("", |relation| relation.symbol());
    let text = format!("{}{relation} {}", instruction.mnemonic(), operands.join(", "));
    (!operands.is_empty()).then(|| text.trim_end().to_owned())
}

/// The operand that is written at this place, if it can be there.
fn given(
    quoted: Quoted<'_>,
    instruction: &Instruction,
    kind: Kind,
    index: usize,
) -> Option<String> {
    let operand = quoted.source.operands.get(index)?;
    fit(instruction, kind, index, &operand.value)?;
    quoted.operand(index)
}

/// What is usual at a place; the number of the operand keeps them apart.
fn usual(instruction: &Instruction, kind: Kind, role: Role, index: usize) -> String {
    let byte = 10 * index;
    let is_written = !matches!(role.does, Does::Nothing | Does::Reads);
    match (class_of(instruction, kind, index), role.takes) {
        (Class::AnyInt | Class::Constant(..), _) if instruction.op == Op::For => {
            if index == 1 { "1" } else { "10" }.to_owned()
        }
        (Class::AnyInt | Class::Constant(..), _)
            if index == 1 && TimerKind::started_by(instruction.op).is_some() =>
        {
            "20".to_owned()
        }
        (Class::AnyInt | Class::Constant(..), _)
            if matches!(instruction.op, Op::Ctu | Op::Ctd | Op::Ctud) =>
        {
            "10".to_owned()
        }
        (_, Takes::Count(_)) => "8".to_owned(),
        (_, Takes::Format) => "2".to_owned(),
        (_, Takes::RealFormat) => "16#82".to_owned(),
        (_, Takes::InputByte) => "IB0".to_owned(),
        (_, Takes::OutputByte) => "QB0".to_owned(),
        (_, Takes::PulseOutput) => "1".to_owned(),
        (Class::Bit, _) if matches!(role.many, Many::Register(_)) => "V0.0".to_owned(),
        (Class::Bit, _) if matches!(instruction.op, Op::Lscr | Op::Scrt) => "S0.1".to_owned(),
        (Class::Bit, _) if is_written => "Q0.0".to_owned(),
        (Class::Bit | Class::Input, _) => format!("I0.{index}"),
        (Class::Output, _) => "Q0.0".to_owned(),
        (Class::Byte | Class::AnyByte | Class::Text | Class::AnyText, _) => format!("VB{byte}"),
        (Class::Word | Class::AnyInt | Class::AnyWord, _) => format!("VW{byte}"),
        (Class::Double | Class::Real | Class::AnyDint | Class::AnyDouble | Class::AnyReal, _) => {
            format!("VD{byte}")
        }
        (Class::Shift, _) => "8".to_owned(),
        (Class::Timer, _) if instruction.op == Op::Tonr => "T5".to_owned(),
        (Class::Timer, _) => "T37".to_owned(),
        (Class::Counter, _) => "C1".to_owned(),
        (Class::Constant(least, most), _) => least.max(1).min(most).to_string(),
        (Class::Label, _) => "1".to_owned(),
        (Class::Routine, _) if instruction.op == Op::Atch => "INT0".to_owned(),
        (Class::Routine, _) => "SBR0".to_owned(),
        (Class::Number(_) | Class::Event | Class::NotWritten, _) => "0".to_owned(),
    }
}
