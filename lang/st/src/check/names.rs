//! Names: what they stand for, and which one was probably meant.

use awl_asm::suggest::nearest;

use super::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::habits;
use crate::library::BLOCKS;
use crate::model::{ELEMENTARY, Root, Type, UnitKind, Value};
use crate::standard::{FUNCTIONS, conversions};
use crate::tree::Name;

pub(crate) fn upper(text: &str) -> String {
    text.to_uppercase()
}

impl Checker<'_> {
    /// The variable of a name: one of the unit, then a global one.
    pub(super) fn variable(&self, name: &str) -> Option<(Root, Type)> {
        let wanted = upper(name);
        let same =
            |(_, variable): &(usize, &crate::model::Variable)| upper(&variable.name) == wanted;
        if let Some((at, variable)) = self.locals().iter().enumerate().find(same) {
            return Some((Root::Local(at), variable.of_type.clone()));
        }
        let (at, variable) = self.program.globals.iter().enumerate().find(same)?;
        Some((Root::Global(at), variable.of_type.clone()))
    }

    /// A value of an enumeration by its name alone: of the wanted type, else of the only one.
    pub(super) fn enumeration_value(
        &self,
        name: &str,
        wanted: Option<&Type>,
    ) -> Option<(Type, Value)> {
        let find = |kind: &Type| {
            let Type::Enumeration(found) = kind else { return None };
            let value = found.values.iter().find(|(text, _)| upper(text) == upper(name));
            value.map(|(_, number)| (kind.clone(), Value::Int(*number)))
        };
        if let Some(found) = wanted.and_then(find) {
            return Some(found);
        }
        let variables = self.locals().iter().chain(&self.program.globals);
        let mut kinds: Vec<&Type> = self.types.values().flatten().collect();
        kinds.sort_by_key(|kind| kind.to_string());
        kinds.into_iter().chain(variables.map(|variable| &variable.of_type)).find_map(find)
    }

    pub(super) fn unknown_name(&mut self, name: &Name, what: &str) {
        let (locals, globals) = (self.locals(), &self.program.globals);
        let variables = locals.iter().chain(globals).map(|variable| variable.name.as_str());
        let units = self.program.units.iter().map(|unit| unit.name.as_str());
        let units = units.filter(|name| !name.starts_with("__"));
        let enumerations = self.types.values().flatten().filter_map(|kind| match kind {
            Type::Enumeration(kind) => Some(kind.values.iter().map(|(name, _)| name.as_str())),
            _ => None,
        });
        let conversions: Vec<String> = conversions().collect();
        let functions = FUNCTIONS.iter().map(|one| one.name);
        let functions = functions.chain(conversions.iter().map(String::as_str));
        let mut names: Vec<&str> = match what {
            "function" => units.chain(functions).collect(),
            _ => variables.chain(enumerations.flatten()).collect(),
        };
        names.sort_unstable();
        let found = nearest(&name.text, names.iter().copied()).map(str::to_owned);
        let message = format!("{}: there is no {what} of this name", name.text);
        let mut diagnostic = Diagnostic::new(Code::UnknownName, name.span, message);
        let is_type = ELEMENTARY.iter().any(|(kind, _)| kind.eq_ignore_ascii_case(&name.text));
        if is_type {
            let help = format!("{} is a type: `TO_{}(x)` converts", name.text, name.text);
            diagnostic = diagnostic.help(help);
        } else if self.variable(&name.text).is_some() {
            diagnostic =
                diagnostic.help(format!("it is a variable: `{}[1]` is an element", name.text));
        } else if let Some(Some(Type::Enumeration(kind))) = self.types.get(&upper(&name.text))
            && let Some((value, _)) = kind.values.first()
        {
            let help = format!(
                "{} is a type: its values are `{value}`, or `{}#{value}`, and so on",
                name.text, name.text
            );
            diagnostic = diagnostic.help(help);
        } else if let Some(help) = habits::help(&name.text) {
            diagnostic = diagnostic.help(help);
        } else {
            let kind = if what == "instance" { "TON" } else { "INT" };
            if found.is_none() && what != "function" {
                let help = format!("declare it: `VAR {} : {kind}; END_VAR`", name.text);
                diagnostic = diagnostic.help(help);
            }
            diagnostic.suggestion = found;
        }
        self.report(diagnostic);
    }

    /// What is wrong with the name of a type.
    pub(super) fn unknown_type(&mut self, name: &str, span: diagnostics::Span) {
        let never = [
            "LINT",
            "ULINT",
            "LREAL",
            "LWORD",
            "DATE",
            "TOD",
            "TIME_OF_DAY",
            "DT",
            "DATE_AND_TIME",
            "LTIME",
        ];
        let wanted = upper(name);
        if never.contains(&wanted.as_str()) {
            let message = format!("{wanted}: an S7-200 has no such type");
            let help = "it has 32 bits at most: DINT, UDINT, REAL, DWORD, TIME";
            self.report(Diagnostic::new(Code::NotThere, span, message).help(help));
            return;
        }
        let kinds = ELEMENTARY.iter().map(|(name, _)| *name);
        let declared = self.type_texts.values().map(|(_, kind)| kind.name.text.as_str());
        let blocks = self.program.units.iter().filter(|unit| unit.kind == UnitKind::Block);
        let blocks = blocks.map(|unit| unit.name.as_str());
        let of_library = BLOCKS.iter().map(|block| block.name);
        let mut names: Vec<&str> = kinds.chain(declared).chain(blocks).chain(of_library).collect();
        names.sort_unstable();
        let found = habits::type_name(name).or_else(|| nearest(name, names.iter().copied()));
        let message = format!("{name}: there is no type of this name");
        let mut diagnostic = Diagnostic::new(Code::UnknownName, span, message);
        if let Some(help) = habits::help(name) {
            diagnostic = diagnostic.help(help);
        }
        diagnostic.suggestion = found.map(str::to_owned);
        self.report(diagnostic);
    }
}
