//! Arguments of standard functions: by place or by name, brought into the order of the parameters.

use diagnostics::Span;

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::tree::{Argument, Name};

impl Checker<'_> {
    /// The arguments of a standard function or conversion in the order of its parameters, which are
    /// names with their types; `None` if they are wrong, which is reported. How many there have to
    /// be is not looked at.
    pub(super) fn in_order<'t>(
        &mut self,
        function: &Name,
        parameters: &[(&str, &str)],
        arguments: &'t [Argument],
        span: Span,
    ) -> Option<Vec<&'t Argument>> {
        let mut slots: Vec<Option<&Argument>> = Vec::new();
        let mut are_right = true;
        for (at, argument) in arguments.iter().enumerate() {
            if self.is_output(&function.text, argument) {
                are_right = false;
                continue;
            }
            let slot = match &argument.name {
                None => Some(at),
                Some(name) => slot_of(parameters, &upper(&name.text), arguments.len()),
            };
            let place = place(argument);
            let Some(slot) = slot else {
                let names: Vec<&str> = parameters.iter().map(|(name, _)| *name).collect();
                let message = format!("{} has no such input", function.text);
                let found = Diagnostic::new(Code::Arguments, place, message);
                self.report(found.help(format!("it has {}", names.join(", "))));
                are_right = false;
                continue;
            };
            if slots.len() <= slot {
                slots.resize(slot + 1, None);
            }
            match slots.get_mut(slot) {
                Some(free @ None) => *free = Some(argument),
                _ => {
                    self.given_twice(&name_of(parameters, slot), place);
                    are_right = false;
                }
            }
        }
        if are_right && let Some(missing) = slots.iter().position(Option::is_none) {
            let name = name_of(parameters, missing);
            self.error(Code::Arguments, span, format!("{}: {name} is not given", function.text));
            are_right = false;
        }
        are_right.then(|| slots.into_iter().flatten().collect())
    }

    /// Reports `=>` in the call of a function.
    pub(super) fn is_output(&mut self, function: &str, argument: &Argument) -> bool {
        if argument.is_output {
            let message = format!("{function}: a function has no outputs");
            self.error(Code::Arguments, argument.value.span, message);
        }
        argument.is_output
    }

    /// Reports a second value for a parameter.
    pub(super) fn given_twice(&mut self, parameter: &str, place: Span) {
        self.error(Code::Arguments, place, format!("{parameter} is given twice"));
    }
}

/// Where an argument is told to be wrong: at its name, if it has one.
pub(super) fn place(argument: &Argument) -> Span {
    argument.name.as_ref().map_or(argument.value.span, |name| name.span)
}

/// `IN1` is `IN` and 1.
fn numbered(name: &str) -> Option<(&str, usize)> {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = name.get(letters.len()..)?.parse().ok()?;
    Some((letters, number))
}

/// Which parameter has a name. Numbers of the last one go on, for functions that take more than
/// they name: `IN3` of `ADD`, but not farther than `count` arguments reach.
fn slot_of(parameters: &[(&str, &str)], name: &str, count: usize) -> Option<usize> {
    if let Some(slot) = parameters.iter().position(|(one, _)| *one == name) {
        return Some(slot);
    }
    let last = parameters.len().checked_sub(1)?;
    let (letters, number) = numbered(name)?;
    let (own, first) = numbered(parameters.get(last)?.0)?;
    let slot = last + number.checked_sub(first)?;
    (own == letters && slot < count).then_some(slot)
}

/// The name of a parameter, also of one beyond those that are named.
fn name_of(parameters: &[(&str, &str)], slot: usize) -> String {
    match (parameters.get(slot), parameters.last().and_then(|(name, _)| numbered(name))) {
        (Some((name, _)), _) => (*name).to_owned(),
        (None, Some((letters, first))) => {
            format!("{letters}{}", first + (slot + 1).saturating_sub(parameters.len()))
        }
        (None, None) => format!("argument {}", slot + 1),
    }
}
