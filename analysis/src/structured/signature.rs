//! What the call around a cursor takes: the parameters of an instance, a function or a subroutine.

use st::cursor::{self, Call};
use st::model::{Type, Unit};
use st::names::is_same;
use st::standard::Standard;

use super::explain::parameters;
use crate::answer::Signature;
use crate::language::View;

/// What is called: its name and its parameters with their types.
pub(super) struct Called {
    pub name: String,
    /// Names and types; of what a call gives back with `=>`.
    pub parameters: Vec<Parameter>,
    /// The type of the result of a function.
    pub result: Option<String>,
}

/// A parameter of something that is called.
pub(super) struct Parameter {
    pub name: String,
    pub kind: String,
    /// Whether it is taken with `=>`.
    pub is_output: bool,
}

/// What the call around an offset takes.
pub(super) fn at(view: View<'_>, offset: usize) -> Option<Signature> {
    let found = cursor::at(view.text(), offset);
    let call = found.call?;
    let called = called(view, found.unit.as_deref(), &call)?;
    let mut label = format!("{}(", called.name);
    let mut places = Vec::new();
    for (number, one) in called.parameters.iter().enumerate() {
        if number > 0 {
            label += ", ";
        }
        let start = label.len();
        let sign = if one.is_output { " => " } else { " : " };
        label += &[&one.name, sign, &one.kind].concat();
        places.push((start, label.len()));
    }
    label.push(')');
    if let Some(result) = &called.result {
        label += &format!(" : {result}");
    }
    let is_it = |name: &String| called.parameters.iter().position(|one| is_same(&one.name, name));
    let active = match call.named.get(call.number).or(call.named.last()) {
        Some(name) => is_it(name),
        None => Some(call.number).filter(|number| *number < places.len()),
    };
    Some(Signature { label, parameters: places, active })
}

/// What a call calls; `None` of what there is not.
pub(super) fn called(view: View<'_>, unit: Option<&str>, call: &Call) -> Option<Called> {
    let st = view.model?.st()?;
    let program = &st.compiled.program;
    if let Some(Type::Block(number, _)) = program.type_of(unit, &call.path) {
        return program.units.get(number).map(|block| of_unit(block, None));
    }
    let [name] = call.path.as_slice() else { return None };
    if let Some(own) = program.unit(name) {
        let result = own.variables.last().map(|one| one.of_type.to_string());
        return Some(of_unit(own, result));
    }
    if let Some(routine) = view.model?.routines().into_iter().find(|one| is_same(&one.name, name)) {
        let parameter = |one: &st::RoutineParameter| Parameter {
            name: one.name.clone(),
            kind: one.of_type.to_string(),
            is_output: false,
        };
        let parameters = routine.parameters.iter().map(parameter).collect();
        return Some(Called { name: routine.name, parameters, result: None });
    }
    let standard = Standard::find(name)?;
    let parameter = |(name, kind): &(&str, &str)| Parameter {
        name: (*name).to_owned(),
        kind: (*kind).to_owned(),
        is_output: false,
    };
    Some(Called {
        name: standard.name.to_owned(),
        parameters: standard.parameters.iter().map(parameter).collect(),
        result: Some(standard.result.to_owned()),
    })
}

pub(super) fn of_unit(unit: &Unit, result: Option<String>) -> Called {
    let parameter = |one: &st::model::Variable| Parameter {
        name: one.name.clone(),
        kind: one.of_type.to_string(),
        is_output: one.section == st::model::SectionKind::Output,
    };
    Called {
        name: unit.name.clone(),
        parameters: parameters(unit).map(parameter).collect(),
        result,
    }
}
