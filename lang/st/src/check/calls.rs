//! Calls as statements: instances of function blocks, subroutines in AWL.

use diagnostics::Span;

use super::Checker;
use super::arguments::place;
use super::expressions::needed;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    BlockCall, Place, RoutineArgument, SectionKind, Statement, StatementKind, Type, UnitKind,
};
use crate::names::{Named, is_same};
use crate::tree::{self, Argument, Name};

impl Checker<'_> {
    pub(super) fn call(
        &mut self,
        target: &tree::Expression,
        arguments: &[Argument],
        span: Span,
    ) -> Option<StatementKind> {
        let tree::ExpressionKind::Variable(name, selectors) = &target.kind else {
            self.error(Code::Syntax, span, "this cannot be called");
            return None;
        };
        if self.variable(&name.text).is_none() && selectors.is_empty() {
            return self.call_of_name(name, arguments, span);
        }
        let instance = self.place(name, selectors, target.span)?;
        let Type::Block(block, _) = instance.of_type else {
            let message =
                format!("{}: {} cannot be called", name.text, instance.of_type.with_article());
            self.error(Code::WrongType, target.span, message);
            return None;
        };
        if self.is_in_function() {
            let message = "a function calls no function blocks";
            let found = Diagnostic::new(Code::SideEffect, span, message);
            self.report(found.help("a FUNCTION_BLOCK or PROGRAM can"));
        }
        let Some(enable) = self.enable(block, arguments) else {
            return self.block_call(instance, block, arguments, span);
        };
        let mut others = arguments.to_vec();
        let condition = self.value_of(&others.remove(enable).value, &Type::Bool);
        let call = self.block_call(instance, block, &others, span)?;
        Some(StatementKind::If(vec![(condition, vec![Statement { kind: call, span }])], vec![]))
    }

    /// Which argument is EN, a condition without which nothing of the call happens. A block can
    /// have an input of this name.
    fn enable(&self, block: usize, arguments: &[Argument]) -> Option<usize> {
        let is_it = |name: &str| is_same(name, "EN");
        let unit = self.program.units.get(block);
        let mut variables = unit.into_iter().flat_map(|unit| &unit.variables);
        if variables.any(|one| one.section == SectionKind::Input && is_it(&one.name)) {
            return None;
        }
        arguments.iter().position(|one| {
            !one.is_output && one.name.as_ref().is_some_and(|name| is_it(&name.text))
        })
    }

    fn call_of_name(
        &mut self,
        name: &Name,
        arguments: &[Argument],
        span: Span,
    ) -> Option<StatementKind> {
        let routines = &self.around.routines;
        if let Some(routine) = routines.iter().find(|one| upper(&one.name) == upper(&name.text)) {
            let routine = routine.clone();
            self.note(name.span, Named::Routine(upper(&routine.name)), false);
            return self.routine(&routine, arguments, span);
        }
        let unit = self.unit_names.get(&upper(&name.text));
        let kind = unit.and_then(|&number| self.program.units.get(number)).map(|unit| unit.kind);
        let (message, help) = match kind {
            Some(UnitKind::Block) => (
                format!("{}: is a type of blocks, not an instance", name.text),
                format!("declare one: `VAR {}1 : {}; END_VAR`", name.text, name.text),
            ),
            Some(UnitKind::Function) => (
                format!("{}: the result of the function is not used", name.text),
                format!("a function does nothing else: `x := {}(...);`", name.text),
            ),
            Some(UnitKind::Program) => (
                format!("{}: a program is not called", name.text),
                "it runs once in each scan".to_owned(),
            ),
            None => {
                self.unknown_name(name, "instance");
                return None;
            }
        };
        self.report(Diagnostic::new(Code::WrongType, name.span, message).help(help));
        None
    }

    fn block_call(
        &mut self,
        instance: Place,
        block: usize,
        arguments: &[Argument],
        span: Span,
    ) -> Option<StatementKind> {
        let unit = self.program.units.get(block)?.clone();
        let mut call = BlockCall {
            instance,
            block,
            inputs: Vec::new(),
            in_outs: Vec::new(),
            outputs: Vec::new(),
        };
        let parameters: Vec<usize> = (0..unit.variables.len())
            .filter(|&at| {
                let section = unit.variables.get(at).map(|one| one.section);
                matches!(section, Some(SectionKind::Input | SectionKind::InOut))
            })
            .collect();
        for (number, argument) in arguments.iter().enumerate() {
            if self.is_compared_parameter(&unit, argument) {
                continue;
            }
            let found = match &argument.name {
                None => parameters.get(number).copied(),
                Some(name) => {
                    unit.variables.iter().position(|one| upper(&one.name) == upper(&name.text))
                }
            };
            let Some(at) = found else {
                self.no_parameter(&unit, argument);
                continue;
            };
            if let (Some(name), Some(variable)) = (&argument.name, unit.variables.get(at)) {
                self.note(name.span, Named::of_unit(&unit, variable), false);
            }
            self.argument(&unit, at, argument, &mut call);
        }
        for (at, variable) in unit.variables.iter().enumerate() {
            let is_given = call.in_outs.iter().any(|(given, _)| *given == at);
            if variable.section == SectionKind::InOut && !is_given {
                let message = format!("{}: {} is not given", unit.name, variable.name);
                self.error(Code::Arguments, span, message);
            }
        }
        call.inputs.sort_by_key(|(at, _)| *at);
        call.in_outs.sort_by_key(|(at, _)| *at);
        call.outputs.sort_by_key(|(at, _)| *at);
        Some(StatementKind::Call(Box::new(call)))
    }

    /// Reports `PT = T#1s` for `PT := T#1s`: a comparison with a variable that is not there, but
    /// would be a parameter.
    fn is_compared_parameter(&mut self, unit: &crate::model::Unit, argument: &Argument) -> bool {
        let tree::ExpressionKind::Binary(tree::BinaryOperator::Equal, left, _) =
            &argument.value.kind
        else {
            return false;
        };
        let tree::ExpressionKind::Variable(name, selectors) = &left.kind else { return false };
        let is_parameter = unit.variables.iter().any(|one| upper(&one.name) == upper(&name.text));
        if argument.name.is_some() || !selectors.is_empty() || !is_parameter {
            return false;
        }
        if self.variable(&name.text).is_some() {
            return false;
        }
        let message = format!("{}: `:=` gives a parameter its value", name.text);
        let span = argument.value.span;
        self.report(Diagnostic::new(Code::Assignment, span, message).help("`=` compares"));
        true
    }

    fn no_parameter(&mut self, unit: &crate::model::Unit, argument: &Argument) {
        let Some(name) = &argument.name else {
            let message = format!("{}: there are too many arguments", unit.name);
            self.error(Code::Arguments, argument.value.span, message);
            return;
        };
        let is_seen = |one: &&crate::model::Variable| {
            matches!(one.section, SectionKind::Input | SectionKind::Output | SectionKind::InOut)
        };
        let names: Vec<&str> =
            unit.variables.iter().filter(is_seen).map(|one| one.name.as_str()).collect();
        let message = format!("{}: {} has no such parameter", name.text, unit.name);
        let mut found = Diagnostic::new(Code::Arguments, name.span, message);
        found.suggestion =
            awl_asm::suggest::nearest(&name.text, names.iter().copied()).map(str::to_owned);
        self.report(found.help(format!("there are {}", names.join(", "))));
    }

    fn argument(
        &mut self,
        unit: &crate::model::Unit,
        at: usize,
        argument: &Argument,
        call: &mut BlockCall,
    ) {
        let Some(variable) = unit.variables.get(at) else { return };
        let span = argument.value.span;
        let is_twice = call.inputs.iter().any(|(given, _)| *given == at)
            || call.in_outs.iter().chain(&call.outputs).any(|(given, _)| *given == at);
        if is_twice {
            self.given_twice(&variable.name, place(argument));
        }
        match (variable.section, argument.is_output) {
            (SectionKind::Input, false) => {
                let value = self.value_of(&argument.value, &variable.of_type);
                call.inputs.push((at, value));
            }
            (SectionKind::InOut, false) => {
                let Some(place) = self.target(&argument.value) else { return };
                self.same_type(&place, &variable.of_type, span);
                call.in_outs.push((at, place));
            }
            (SectionKind::Output, true) => {
                let Some(place) = self.target(&argument.value) else { return };
                self.same_type(&place, &variable.of_type, span);
                call.outputs.push((at, place));
            }
            (SectionKind::Output, false) => {
                let message = format!("{}: an output is taken with `=>`", variable.name);
                let found = Diagnostic::new(Code::Arguments, span, message);
                self.report(found.help(format!("`{} => x`", variable.name)));
            }
            (SectionKind::Input | SectionKind::InOut, true) => {
                let message = format!("{}: an input is given with `:=`", variable.name);
                self.error(Code::Arguments, span, message);
            }
            _ => {
                let message = format!("{}: is no parameter of {}", variable.name, unit.name);
                self.error(Code::Arguments, span, message);
            }
        }
    }

    fn same_type(&mut self, place: &Place, wanted: &Type, span: Span) {
        let is_same = place.of_type.base() == wanted.base();
        if is_same && wanted.is_within(&place.of_type) || place.of_type == *wanted {
            return;
        }
        if place.of_type != Type::Invalid {
            self.error(Code::WrongType, span, needed(wanted, &place.of_type));
        }
    }

    fn routine(
        &mut self,
        routine: &crate::around::Routine,
        arguments: &[Argument],
        span: Span,
    ) -> Option<StatementKind> {
        if self.is_in_function() {
            let message = "a function calls no subroutines in AWL: they may write anything";
            self.error(Code::SideEffect, span, message);
        }
        let (wanted, given) = (routine.parameters.len(), arguments.len());
        if wanted != given {
            let message = format!("{}: {wanted} arguments needed, {given} given", routine.name);
            self.error(Code::Arguments, span, message);
            return None;
        }
        let mut all = Vec::new();
        for (parameter, argument) in routine.parameters.iter().zip(arguments) {
            if parameter.is_written {
                let place = self.target(&argument.value)?;
                self.same_type(&place, &parameter.of_type, argument.value.span);
                all.push(RoutineArgument::Place(place));
            } else {
                let value = self.value_of(&argument.value, &parameter.of_type);
                all.push(RoutineArgument::Value(value));
            }
        }
        Some(StatementKind::Routine(routine.name.clone(), all))
    }
}
