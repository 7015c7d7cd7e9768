//! What can be written at a place of a text in Structured Text.

use awl_asm::Address;
use st::cursor::{self, At, Cursor};
use st::library::BLOCKS;
use st::model::{ELEMENTARY, SectionKind, Type, Unit, UnitKind, Variable};
use st::names::is_same;
use st::standard::{FUNCTIONS, conversions};
use st::{Named, Program};

use super::explain::explain;
use super::signature::{Called, called, of_unit};
use super::words::{self, Word, standard_words, type_words};
use crate::answer::{Completion, CompletionKind};
use crate::explain::{address_words, board_points};
use crate::language::View;
use crate::model::Model;

/// What can be written at an offset.
pub(super) fn at(view: View<'_>, offset: usize) -> Vec<Completion> {
    let Some((model, st)) = view.model.and_then(|model| Some((model, model.st()?))) else {
        return Vec::new();
    };
    let at = cursor::at(view.text(), offset);
    let place = Place { view, model, program: &st.compiled.program, at: &at };
    match &at.cursor {
        Cursor::File => place.words(words::FILE),
        Cursor::Head => [place.words(words::SECTIONS), place.statements()].concat(),
        Cursor::Statement => place.statements(),
        Cursor::Value => place.values(),
        Cursor::Member(path) => place.members(path),
        Cursor::Argument => [place.parameters(), place.values()].concat(),
        Cursor::Type => place.types(),
        Cursor::Address => place.addresses(),
        Cursor::Declaration(end) => vec![place.one(*end, CompletionKind::Keyword, "")],
        Cursor::Nothing => Vec::new(),
    }
}

struct Place<'v, 'p> {
    view: View<'v>,
    model: &'v Model,
    program: &'v Program,
    at: &'p At,
}

impl Place<'_, '_> {
    fn one(
        &self,
        label: impl Into<String>,
        kind: CompletionKind,
        detail: impl Into<String>,
    ) -> Completion {
        Completion::new(label, kind, detail, self.at.word)
    }

    fn words(&self, words: &[Word]) -> Vec<Completion> {
        let one =
            |row: &Word| self.one(row.word, CompletionKind::Keyword, row.doc).writes(row.template);
        words.iter().map(one).collect()
    }

    fn unit(&self) -> Option<&Unit> {
        self.program.unit(self.at.unit.as_deref()?)
    }

    /// The variables that can be named here, with what they are: those of the unit, then global
    /// ones that it does not hide.
    fn variables(&self) -> Vec<(&Variable, Completion)> {
        let locals = self.unit().map_or(&[][..], |unit| &unit.variables);
        let is_hidden = |name: &str| locals.iter().any(|local| is_same(&local.name, name));
        let globals = self.program.globals.iter().filter(|one| !is_hidden(&one.name));
        let local = |variable| {
            let named =
                self.unit().map(|unit| Named::Variable(unit.name.to_uppercase(), upper(variable)));
            (variable, self.variable(variable, named, CompletionKind::Variable))
        };
        let global = |variable| {
            let named = Some(Named::Global(upper(variable)));
            (variable, self.variable(variable, named, CompletionKind::Symbol))
        };
        locals.iter().map(local).chain(globals.map(global)).collect()
    }

    fn variable(
        &self,
        variable: &Variable,
        named: Option<Named>,
        kind: CompletionKind,
    ) -> Completion {
        let doc = named.and_then(|named| explain(&named, None, self.model));
        let detail = variable.of_type.to_string();
        Completion { doc: doc.unwrap_or_default(), ..self.one(&variable.name, kind, detail) }
    }

    /// What a statement can begin with.
    fn statements(&self) -> Vec<Completion> {
        let mut all = Vec::new();
        for (variable, plain) in self.variables() {
            if variable.is_constant {
                continue;
            }
            if let Type::Block(number, _) = variable.of_type
                && let Some(block) = self.program.units.get(number)
            {
                all.push(self.call(&variable.name, &of_unit(block, None), ";"));
            }
            all.push(plain);
        }
        for routine in self.model.routines() {
            let path = vec![routine.name.clone()];
            let call = cursor::Call { path, ..cursor::Call::default() };
            if let Some(found) = called(self.view, None, &call) {
                all.push(self.call(&routine.name, &found, ";"));
            }
        }
        all.extend(self.words(words::STATEMENTS));
        let end = self.unit().map(|unit| match unit.kind {
            UnitKind::Program => "END_PROGRAM",
            UnitKind::Function => "END_FUNCTION",
            UnitKind::Block => "END_FUNCTION_BLOCK",
        });
        all.extend(end.map(|end| self.one(end, CompletionKind::Keyword, "")));
        all
    }

    /// A call with a hole for each value that it needs.
    fn call(&self, name: &str, called: &Called, end: &str) -> Completion {
        let inputs: Vec<_> = called.parameters.iter().filter(|one| !one.is_output).collect();
        let names: Vec<&str> = inputs.iter().map(|one| one.name.as_str()).collect();
        // Of functions the order says which is which.
        let holes: Vec<String> = match called.result {
            None if self.is_block(name) => {
                names.iter().map(|name| format!("{name} := |")).collect()
            }
            _ => names.iter().map(|_| "|".to_owned()).collect(),
        };
        let label = format!("{name}({})", names.join(", "));
        let detail = called.result.clone().unwrap_or_else(|| called.name.clone());
        let one = self.one(label, CompletionKind::Routine, detail);
        one.writes(&format!("{name}({}){end}", holes.join(", ")))
    }

    fn is_block(&self, name: &str) -> bool {
        let kind = self.program.type_of(self.at.unit.as_deref(), &[name.to_owned()]);
        matches!(kind, Some(Type::Block(..)))
    }

    /// What has a value.
    fn values(&self) -> Vec<Completion> {
        let mut all: Vec<Completion> = self.variables().into_iter().map(|(_, one)| one).collect();
        all.extend(self.enumerations());
        // Those of the library have rows of their own below.
        let units = self.program.units.iter().filter(|unit| unit.file.is_some());
        let own = units.filter(|unit| unit.kind == UnitKind::Function);
        all.extend(own.map(|unit| {
            let result = unit.variables.last().map(|one| one.of_type.to_string());
            let doc = explain(&Named::Unit(unit.name.to_uppercase()), None, self.model);
            let one = self.call(&unit.name, &of_unit(unit, result), "");
            Completion { doc: doc.unwrap_or_default(), ..one }
        }));
        all.extend(self.words(words::VALUES));
        // Operators have words of their own.
        let functions = FUNCTIONS.iter().filter(|one| !st::keywords::is_keyword(one.name));
        all.extend(functions.map(|one| {
            let holes: Vec<&str> = one.parameters.iter().map(|_| "|").collect();
            let names: Vec<&str> = one.parameters.iter().map(|(name, _)| *name).collect();
            let label = format!("{}({})", one.name, names.join(", "));
            let found = self.one(label, CompletionKind::Routine, one.result);
            let found = found.writes(&format!("{}({})", one.name, holes.join(", ")));
            Completion { doc: standard_words(one), ..found }
        }));
        all.extend(conversions().map(|name| {
            let one = self.one(format!("{name}(IN)"), CompletionKind::Routine, "a conversion");
            one.writes(&format!("{name}(|)"))
        }));
        all
    }

    /// The values of the enumerations that variables have.
    fn enumerations(&self) -> Vec<Completion> {
        let mut all: Vec<Completion> = Vec::new();
        for (variable, _) in self.variables() {
            let Type::Enumeration(kind) = &variable.of_type else { continue };
            for (name, number) in &kind.values {
                if !all.iter().any(|one| one.label == *name) {
                    let detail = format!("{} = {number}", kind.name);
                    all.push(self.one(name, CompletionKind::Value, detail));
                }
            }
        }
        all
    }

    /// The members of what is before the point.
    fn members(&self, path: &[String]) -> Vec<Completion> {
        let kind = self.program.type_of(self.at.unit.as_deref(), path);
        match kind {
            Some(Type::Struct(of)) => {
                let member = |one: &st::model::Member| {
                    self.one(&one.name, CompletionKind::Variable, one.of_type.to_string())
                };
                of.members.iter().map(member).collect()
            }
            Some(Type::Block(number, _)) => {
                let Some(block) = self.program.units.get(number) else { return Vec::new() };
                let is_seen = |one: &&Variable| {
                    matches!(one.section, SectionKind::Input | SectionKind::Output)
                };
                let seen = block.variables.iter().filter(is_seen);
                seen.map(|one| {
                    let named = Named::Variable(block.name.to_uppercase(), upper(one));
                    self.variable(one, Some(named), CompletionKind::Variable)
                })
                .collect()
            }
            _ => Vec::new(),
        }
    }

    /// The parameters of the call around that are not named yet.
    fn parameters(&self) -> Vec<Completion> {
        let Some(call) = &self.at.call else { return Vec::new() };
        let unit = self.at.unit.as_deref();
        let Some(called) = called(self.view, unit, call) else { return Vec::new() };
        let is_named = |name: &str| call.named.iter().any(|one| is_same(one, name));
        // Standard functions and subroutines in AWL take their arguments in order.
        let has_names = self.program.unit(&called.name).is_some();
        let left = called.parameters.iter().filter(|one| has_names && !is_named(&one.name));
        left.map(|one| {
            let sign = if one.is_output { "=>" } else { ":=" };
            let written = format!("{} {sign} ", one.name);
            self.one(written, CompletionKind::Variable, &one.kind)
        })
        .collect()
    }

    fn types(&self) -> Vec<Completion> {
        let elementary = ELEMENTARY.iter();
        let mut all: Vec<Completion> = elementary
            .map(|(name, kind)| self.one(*name, CompletionKind::Keyword, type_words(kind)))
            .collect();
        let names = self.model.st().into_iter().flat_map(|st| &st.compiled.names);
        for name in names.filter(|name| name.declares) {
            let Named::Type(_) = &name.of else { continue };
            let Some(source) = self.model.st_source(name.file) else { continue };
            let written = name.span.text(&source.text);
            let doc = explain(&name.of, None, self.model).unwrap_or_default();
            all.push(Completion { doc, ..self.one(written, CompletionKind::Value, "a type") });
        }
        let blocks = self.program.units.iter().filter(|unit| unit.kind == UnitKind::Block);
        all.extend(blocks.map(|block| {
            let doc = explain(&Named::Unit(block.name.to_uppercase()), None, self.model);
            let one = self.one(&block.name, CompletionKind::Routine, "FUNCTION_BLOCK");
            Completion { doc: doc.unwrap_or_default(), ..one }
        }));
        let others = BLOCKS.iter().filter(|block| self.program.unit(block.name).is_none());
        all.extend(others.map(|block| {
            let one = self.one(block.name, CompletionKind::Routine, "FUNCTION_BLOCK");
            Completion { doc: block.comment(), ..one }
        }));
        all.extend(self.words(words::TYPES));
        all
    }

    /// The points of the board.
    fn addresses(&self) -> Vec<Completion> {
        let points = board_points(self.model.assembly.program.profile);
        let one = |address: Address| {
            self.one(format!("%{address}"), CompletionKind::Address, address_words(address))
        };
        points.into_iter().map(one).collect()
    }
}

fn upper(variable: &Variable) -> String {
    variable.name.to_uppercase()
}
