//! Variables that begin anew in each call and are read before anything is written to them: they
//! are then what they began as, in every call.

use std::collections::HashSet;

use diagnostics::Span;

use super::Checker;
use super::recursion::{each_assignment, in_place, inside};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    Expression, ExpressionKind, Place, Root, RoutineArgument, SectionKind, Statement,
    StatementKind, Unit, UnitKind,
};

impl Checker<'_> {
    pub(super) fn read_before_written(&mut self) {
        let mut found = Vec::new();
        for unit in self.program.units.iter().filter(|unit| unit.file.is_some()) {
            let mut walk = Walk { unit, written: HashSet::new(), found: Vec::new() };
            walk.statements(&unit.body);
            found.extend(walk.found.into_iter().map(|(at, span)| (unit.file, at, span)));
        }
        for (file, name, span) in found {
            self.file = file;
            let message = format!("{name}: is read before anything is written to it");
            let found = Diagnostic::new(Code::ReadUnwritten, span, message);
            let help = "it begins anew in each call: VAR of a FUNCTION_BLOCK or PROGRAM keeps its \
                        value, an initial value says that this is meant";
            self.report(found.help(help));
        }
    }
}

struct Walk<'u> {
    unit: &'u Unit,
    /// Variables that something may have been written to.
    written: HashSet<usize>,
    /// Names of variables that nothing was, and where they are read.
    found: Vec<(String, Span)>,
}

impl Walk<'_> {
    fn statements(&mut self, statements: &[Statement]) {
        statements.iter().for_each(|one| self.statement(one));
    }

    fn statement(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Assign(place, value) => {
                self.reads(value);
                self.writes(place);
            }
            StatementKind::If(arms, otherwise) => {
                for (condition, body) in arms {
                    self.reads(condition);
                    self.statements(body);
                }
                self.statements(otherwise);
            }
            StatementKind::Case(selector, arms, otherwise) => {
                self.reads(selector);
                arms.iter().for_each(|(_, body)| self.statements(body));
                self.statements(otherwise);
            }
            StatementKind::For(one) => {
                self.reads(&one.from);
                self.reads(&one.to);
                self.writes(&one.variable);
                self.repeated(&one.body, None);
            }
            StatementKind::While(condition, body) => self.repeated(body, Some(condition)),
            StatementKind::Repeat(body, condition) => self.repeated(body, Some(condition)),
            StatementKind::Call(call) => {
                call.inputs.iter().for_each(|(_, value)| self.reads(value));
                call.in_outs.iter().chain(&call.outputs).for_each(|(_, one)| self.writes(one));
            }
            StatementKind::Routine(_, arguments) => {
                for argument in arguments {
                    match argument {
                        RoutineArgument::Value(value) => self.reads(value),
                        RoutineArgument::Place(place) => self.writes(place),
                    }
                }
            }
            StatementKind::AddElapsed(place) => self.writes(place),
            StatementKind::Element(_)
            | StatementKind::Exit
            | StatementKind::Continue
            | StatementKind::Return => {}
        }
    }

    /// What a pass writes, the next one may read.
    fn repeated(&mut self, body: &[Statement], condition: Option<&Expression>) {
        each_assignment(body, &mut |place, _| self.note(place));
        condition.into_iter().for_each(|condition| self.reads(condition));
        self.statements(body);
    }

    fn note(&mut self, place: &Place) {
        if let Root::Local(at) = place.root {
            self.written.insert(at);
        }
    }

    fn writes(&mut self, place: &Place) {
        let mut indexes = Vec::new();
        in_place(place, &mut |one| indexes.push(one.clone()));
        indexes.iter().for_each(|index| self.reads_one(index));
        self.note(place);
    }

    fn reads(&mut self, expression: &Expression) {
        inside(expression, &mut |one| self.reads_one(one));
    }

    fn reads_one(&mut self, expression: &Expression) {
        let ExpressionKind::Read(Place { root: Root::Local(at), .. }) = expression.kind else {
            return;
        };
        let Some(variable) = self.unit.variables.get(at) else { return };
        let begins_anew = variable.section == SectionKind::Temp
            || variable.section == SectionKind::Var && self.unit.kind == UnitKind::Function;
        if begins_anew && !variable.has_initial && self.written.insert(at) {
            self.found.push((variable.name.clone(), expression.span));
        }
    }
}
