//! What calls or contains what: nothing itself, and no chain deeper than the controller's eight
//! levels. And outputs that two programs write.

use std::collections::HashMap;

use super::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    Expression, ExpressionKind, Place, Root, Statement, StatementKind, Step, UnitKind,
    each_statement,
};

/// Calls below the main program at most (docs/s7-200.md 1.8).
const DEPTH_MAX: usize = 8;

impl Checker<'_> {
    pub(super) fn recursion(&mut self) {
        let count = self.program.units.len();
        let mut uses: Vec<Vec<usize>> = Vec::new();
        for unit in &self.program.units {
            let mut used = Vec::new();
            used.extend(unit.variables.iter().filter_map(|variable| variable.of_type.block()));
            each_expression(&unit.body, &mut |expression| {
                if let ExpressionKind::Call(number, _) = expression.kind {
                    used.push(number);
                }
            });
            uses.push(used);
        }
        let mut depths = vec![None; count];
        for unit in 0..count {
            let mut path = Vec::new();
            self.depth(unit, &uses, &mut depths, &mut path);
        }
    }

    /// How many functions deep a unit calls.
    fn depth(
        &mut self,
        unit: usize,
        uses: &[Vec<usize>],
        depths: &mut [Option<usize>],
        path: &mut Vec<usize>,
    ) -> usize {
        if let Some(Some(depth)) = depths.get(unit) {
            return *depth;
        }
        if path.contains(&unit) {
            self.at_unit(unit, Code::Recursion, "calls or contains itself");
            return 0;
        }
        path.push(unit);
        let below = uses.get(unit).cloned().unwrap_or_default();
        let deepest = below.into_iter().map(|next| self.depth(next, uses, depths, path)).max();
        path.pop();
        let kind = self.program.units.get(unit).map(|unit| unit.kind);
        let depth = deepest.unwrap_or(0) + usize::from(kind == Some(UnitKind::Function));
        if let Some(slot) = depths.get_mut(unit) {
            *slot = Some(depth);
        }
        if depth == DEPTH_MAX + 1 {
            self.at_unit(unit, Code::Recursion, "is the ninth of functions that call each other");
        }
        depth
    }

    fn at_unit(&mut self, number: usize, code: Code, what: &str) {
        let Some(unit) = self.program.units.get(number) else { return };
        let message = format!("{}: {what}", unit.name);
        let (file, span) = (unit.file, unit.span);
        let around = std::mem::replace(&mut self.file, file);
        let help = "an S7-200 has no recursion, and calls 8 levels deep at most";
        self.report(Diagnostic::new(code, span, message).help(help));
        self.file = around;
    }

    /// An output that two programs assign: the later one wins in every scan.
    pub(super) fn written_in_two_programs(&mut self) {
        let mut first: HashMap<String, usize> = HashMap::new();
        let mut found = Vec::new();
        for (number, unit) in self.program.units.iter().enumerate() {
            if unit.kind != UnitKind::Program {
                continue;
            }
            each_assignment(&unit.body, &mut |place, span| {
                // What an element of a drawing does is told at its unit.
                let span = if span == diagnostics::Span::default() { unit.span } else { span };
                let variable = match &place.root {
                    Root::Local(at) => unit.variables.get(*at),
                    Root::Global(at) => self.program.globals.get(*at),
                    Root::Address(text) => {
                        let other = *first.entry(text.clone()).or_insert(number);
                        found.extend((other != number).then(|| (unit.file, span, text.clone())));
                        return;
                    }
                };
                let Some(text) = variable.and_then(|variable| variable.at.clone()) else { return };
                let other = *first.entry(text.clone()).or_insert(number);
                found.extend((other != number).then_some((unit.file, span, text)));
            });
        }
        found.retain(|(_, _, text)| text.starts_with('Q'));
        for (file, span, text) in found {
            self.file = file;
            let message = format!("{text}: another program writes this output, too");
            self.error(Code::WrittenTwice, span, message);
        }
    }
}

/// Each assignment with its place.
pub(crate) fn each_assignment(
    statements: &[Statement],
    found: &mut dyn FnMut(&Place, diagnostics::Span),
) {
    each_statement(statements, &mut |statement| match &statement.kind {
        StatementKind::Assign(place, _) | StatementKind::AddElapsed(place) => {
            found(place, statement.span);
        }
        StatementKind::For(one) => found(&one.variable, statement.span),
        StatementKind::Call(call) => {
            let places = call.in_outs.iter().chain(&call.outputs);
            places.for_each(|(_, place)| found(place, statement.span));
        }
        _ => {}
    });
}

/// Each expression in statements, those inside others too.
pub(crate) fn each_expression(statements: &[Statement], found: &mut dyn FnMut(&Expression)) {
    for statement in statements {
        match &statement.kind {
            StatementKind::Assign(place, value) => {
                in_place(place, found);
                inside(value, found);
            }
            StatementKind::If(arms, otherwise) => {
                for (condition, body) in arms {
                    inside(condition, found);
                    each_expression(body, found);
                }
                each_expression(otherwise, found);
            }
            StatementKind::Case(selector, arms, otherwise) => {
                inside(selector, found);
                arms.iter().for_each(|(_, body)| each_expression(body, found));
                each_expression(otherwise, found);
            }
            StatementKind::For(one) => {
                in_place(&one.variable, found);
                inside(&one.from, found);
                inside(&one.to, found);
                each_expression(&one.body, found);
            }
            StatementKind::While(condition, body) | StatementKind::Repeat(body, condition) => {
                inside(condition, found);
                each_expression(body, found);
            }
            StatementKind::Call(call) => {
                in_place(&call.instance, found);
                call.inputs.iter().for_each(|(_, value)| inside(value, found));
                call.in_outs.iter().chain(&call.outputs).for_each(|(_, one)| in_place(one, found));
            }
            StatementKind::Routine(_, arguments) => {
                for argument in arguments {
                    match argument {
                        crate::model::RoutineArgument::Value(value) => inside(value, found),
                        crate::model::RoutineArgument::Place(place) => in_place(place, found),
                    }
                }
            }
            StatementKind::AddElapsed(place) => in_place(place, found),
            StatementKind::Exit
            | StatementKind::Continue
            | StatementKind::Return
            | StatementKind::Element(_) => {}
        }
    }
}

pub(crate) fn in_place(place: &Place, found: &mut dyn FnMut(&Expression)) {
    for step in &place.steps {
        if let Step::Element(indexes) = step {
            indexes.iter().for_each(|index| inside(index, found));
        }
    }
}

/// An expression and all in it.
pub(crate) fn inside(expression: &Expression, found: &mut dyn FnMut(&Expression)) {
    found(expression);
    match &expression.kind {
        ExpressionKind::Constant(_) => {}
        ExpressionKind::Read(place) => in_place(place, found),
        ExpressionKind::Negate(one) | ExpressionKind::Not(one) | ExpressionKind::Convert(one) => {
            inside(one, found);
        }
        ExpressionKind::Binary(_, left, right) => {
            inside(left, found);
            inside(right, found);
        }
        ExpressionKind::Call(_, arguments) | ExpressionKind::Standard(_, arguments) => {
            arguments.iter().for_each(|argument| inside(argument, found));
        }
    }
}
