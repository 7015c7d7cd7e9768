//! Units and their variables.

use std::collections::HashSet;

use awl_asm::Address;

use super::names::upper;
use super::{Checker, Instances};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Coarse, SectionKind, Type, Unit, UnitKind, Value, Variable};
use crate::names::{Named, is_same};
use crate::tree;

impl<'a> Checker<'a> {
    pub(super) fn collect_units(&mut self, files: &[(Option<usize>, &'a tree::File)]) {
        for &(number, file) in files {
            self.file = number;
            for unit in &file.units {
                let name = upper(&unit.name.text);
                let kind = match unit.kind {
                    tree::UnitKind::Program => UnitKind::Program,
                    tree::UnitKind::Function(_) => UnitKind::Function,
                    tree::UnitKind::Block => UnitKind::Block,
                };
                self.note(unit.name.span, Named::Unit(name.clone()), true);
                let is_new = !self.unit_names.contains_key(&name);
                // A block of one's own takes the place of a standard one.
                if is_new {
                    self.unit_names.insert(name.clone(), self.program.units.len());
                } else if number.is_some() {
                    self.twice(&unit.name, None);
                }
                match self.type_texts.get(&name).copied() {
                    Some((file, declared)) if number.is_none() => {
                        self.file = file;
                        self.type_of_the_library(&declared.name);
                        self.file = number;
                    }
                    Some(_) => self.twice(&unit.name, None),
                    None => {}
                }
                self.program.units.push(Unit {
                    kind,
                    name: unit.name.text.clone(),
                    file: number,
                    span: unit.name.span,
                    variables: Vec::new(),
                    every_scan: Vec::new(),
                    body: Vec::new(),
                });
            }
        }
    }

    pub(super) fn collect_globals(&mut self, files: &[(Option<usize>, &'a tree::File)]) {
        for &(number, file) in files {
            self.file = number;
            for section in &file.globals {
                self.section(section);
            }
        }
        self.file = files.first().and_then(|(number, _)| *number);
        self.check_types();
    }

    pub(super) fn declare_units(&mut self, files: &[(Option<usize>, &'a tree::File)]) {
        let mut at = 0;
        for &(number, file) in files {
            self.file = number;
            for unit in &file.units {
                self.unit = Some(at);
                for section in &unit.sections {
                    self.section(section);
                }
                if let tree::UnitKind::Function(result) = &unit.kind {
                    self.result(unit, result);
                }
                self.unit = None;
                at += 1;
            }
        }
    }

    /// What units do: all of the files; of the library what is used, by these or by each other.
    pub(super) fn bodies(&mut self, files: &[(Option<usize>, &'a tree::File)]) {
        let units =
            files.iter().flat_map(|&(file, of)| of.units.iter().map(move |unit| (file, unit)));
        let units: Vec<(Option<usize>, &tree::Unit)> = units.collect();
        for (number, &(file, unit)) in units.iter().enumerate() {
            if file.is_some() {
                self.body(number, file, unit);
            }
        }
        let mut done = HashSet::new();
        while let Some(number) = self.used.pop() {
            if let Some((None, unit)) = units.get(number)
                && done.insert(number)
            {
                self.body(number, None, unit);
            }
        }
    }

    fn body(&mut self, number: usize, file: Option<usize>, unit: &'a tree::Unit) {
        (self.file, self.unit) = (file, Some(number));
        let every_scan = self.statements(&unit.every_scan);
        let body = self.statements(&unit.body);
        self.unit = None;
        if let Some(unit) = self.program.units.get_mut(number) {
            (unit.every_scan, unit.body) = (every_scan, body);
        }
    }

    /// The variable of a function that is its result.
    fn result(&mut self, unit: &tree::Unit, text: &tree::TypeText) {
        let of_type = self.type_of(text, &unit.name.text);
        if !of_type.is_elementary() || of_type.characters() > 0 {
            let message =
                format!("{}: the result of a function is elementary and no STRING", of_type);
            self.error(Code::NotThere, text.span, message);
        }
        let initial = self.initial(None, text, &of_type);
        self.add(Variable {
            name: unit.name.text.clone(),
            span: unit.name.span,
            of_type,
            section: SectionKind::Output,
            is_constant: false,
            is_retained: false,
            at: None,
            initial,
            has_initial: false,
        });
    }

    fn add(&mut self, variable: Variable) {
        let named = match self.unit() {
            Some(unit) => Named::of_unit(unit, &variable),
            None => Named::Global(upper(&variable.name)),
        };
        self.note(variable.span, named, true);
        match self.unit.and_then(|at| self.program.units.get_mut(at)) {
            Some(unit) => unit.variables.push(variable),
            None => self.program.globals.push(variable),
        }
    }

    fn section(&mut self, section: &'a tree::Section) {
        for declared in &section.declarations {
            if section.kind == SectionKind::External {
                self.external(declared);
                continue;
            }
            let of_type = self.type_of(&declared.of_type, &enumeration_name(declared));
            let members = match declared.initial.as_ref().map(|initial| &initial.kind) {
                Some(tree::ExpressionKind::Members(members)) => Some(members),
                _ => None,
            };
            let members = members.filter(|_| matches!(of_type, Type::Block(..)));
            let written = declared.initial.as_ref().filter(|_| members.is_none());
            let initial = self.initial(written, &declared.of_type, &of_type);
            self.check_section(section, declared, &of_type);
            let at = declared.at.as_ref().and_then(|at| self.address(at, &of_type));
            let first = self.variables().len();
            for name in &declared.names {
                if self.is_taken(name) {
                    continue;
                }
                self.coarse(declared, &of_type);
                self.add(Variable {
                    name: name.text.clone(),
                    span: name.span,
                    of_type: of_type.clone(),
                    section: section.kind,
                    is_constant: section.is_constant,
                    is_retained: section.is_retained,
                    at: at.clone(),
                    initial: initial.clone(),
                    has_initial: declared.initial.is_some(),
                });
            }
            if let Some(members) = members {
                let (file, unit) = (self.file, self.unit);
                let variables = first..self.variables().len();
                self.instances.push(Instances { file, unit, variables, members });
            }
        }
    }

    /// The variables of the unit, or the global ones.
    fn variables(&self) -> &[Variable] {
        self.unit().map_or(&self.program.globals, |unit| &unit.variables)
    }

    /// The initial values of the inputs of instances, once all blocks are declared.
    pub(super) fn instances(&mut self) {
        for one in std::mem::take(&mut self.instances) {
            (self.file, self.unit) = (one.file, one.unit);
            let of_type = self.variables().get(one.variables.start).map(|one| &one.of_type);
            let block = of_type.and_then(Type::block);
            let Some(block) = block.and_then(|number| self.program.units.get(number)).cloned()
            else {
                continue;
            };
            let mut values: Vec<Value> =
                block.variables.iter().map(|variable| variable.initial.clone()).collect();
            for (name, value) in one.members {
                let same = |variable: &Variable| {
                    variable.section == SectionKind::Input && is_same(&variable.name, &name.text)
                };
                let at = block.variables.iter().position(same);
                let Some((variable, slot)) =
                    at.and_then(|at| block.variables.get(at).zip(values.get_mut(at)))
                else {
                    let message = format!("{}: {} has no such input", name.text, block.name);
                    self.error(Code::Arguments, name.span, message);
                    continue;
                };
                self.note(name.span, Named::of_unit(&block, variable), false);
                *slot = self.initial_value(value, &variable.of_type, slot.clone());
            }
            let variables = match self.unit.and_then(|unit| self.program.units.get_mut(unit)) {
                Some(unit) => &mut unit.variables,
                None => &mut self.program.globals,
            };
            for variable in variables.get_mut(one.variables).into_iter().flatten() {
                variable.initial = Value::List(values.clone());
            }
        }
        self.unit = None;
    }

    /// A variable of these that is added next need not be exact.
    fn coarse(&mut self, declared: &tree::Declaration, of_type: &Type) {
        let (Some(span), Some(file)) = (declared.coarse, self.file) else { return };
        let is_timer = match of_type {
            Type::Block(number, name) => {
                let unit = self.program.units.get(*number);
                unit.is_some_and(|unit| unit.file.is_none()) && ["TON", "TOF"].contains(&&**name)
            }
            _ => false,
        };
        if !is_timer {
            let message = format!("`{{coarse}}` changes nothing: no timer can be a {of_type}");
            let found = Diagnostic::new(Code::Coarse, span, message);
            self.report(found.help("TON and TOF can be timers of the controller"));
            return;
        }
        let variable = self.unit.map_or(self.program.globals.len(), |_| self.locals().len());
        self.program.coarse.push(Coarse { unit: self.unit, variable, file, span });
    }

    fn is_taken(&mut self, name: &tree::Name) -> bool {
        let first = self.variables().iter().find(|other| upper(&other.name) == upper(&name.text));
        let Some(span) = first.map(|first| first.span) else { return false };
        self.twice(name, Some(span));
        true
    }

    /// What sections and types do not go together.
    fn check_section(
        &mut self,
        section: &tree::Section,
        declared: &tree::Declaration,
        kind: &Type,
    ) {
        let span = declared.of_type.span;
        let is_plain = kind.is_elementary() && kind.characters() == 0 && declared.at.is_none();
        if self.is_in_function() && !is_plain {
            let message =
                "the variables of a function are elementary, no STRING, and at no address";
            self.error(Code::NotThere, span, message);
        }
        if self.is_in_function() && section.kind == SectionKind::InOut {
            let message = "a function has no VAR_IN_OUT: it writes nothing outside of it";
            let found = Diagnostic::new(Code::SideEffect, span, message);
            self.report(found.help("a FUNCTION_BLOCK can have it"));
        }
        if self.is_in_function() && section.kind == SectionKind::Output {
            let message = "a function has no VAR_OUTPUT: its result is all it gives";
            self.error(Code::SideEffect, span, message);
        }
        if section.is_constant && declared.initial.is_none() {
            let message = "a constant needs a value";
            self.error(Code::Declaration, span, message);
        }
        if declared.at.is_some() && declared.initial.is_some() {
            let message = "what is at an address has no initial value here";
            self.error(Code::NotThere, span, message);
        }
        let is_parameter =
            matches!(section.kind, SectionKind::Input | SectionKind::Output | SectionKind::InOut);
        if is_parameter && kind.block().is_some() {
            let message = "an instance of a function block is no parameter";
            let found = Diagnostic::new(Code::NotThere, span, message);
            self.report(found.help("declare it in VAR, or give its inputs and outputs"));
        }
    }

    /// VAR_EXTERNAL names a global variable.
    fn external(&mut self, declared: &tree::Declaration) {
        let wanted = self.type_of(&declared.of_type, "");
        for name in &declared.names {
            let found =
                self.program.globals.iter().find(|one| upper(&one.name) == upper(&name.text));
            let found = found.map(|one| (one.of_type.clone(), one.span));
            if found.is_some() {
                self.note(name.span, Named::Global(upper(&name.text)), false);
            }
            match found {
                None => {
                    let message =
                        format!("{}: there is no global variable of this name", name.text);
                    self.error(Code::UnknownName, name.span, message);
                }
                Some((of_type, _)) if of_type != wanted && wanted != Type::Invalid => {
                    let message = format!("{}: the global variable is of {of_type}", name.text);
                    self.error(Code::WrongType, name.span, message);
                }
                Some(_) => {}
            }
        }
    }

    /// The address in AWL, if it exists and is as long as the type.
    pub(super) fn address(&mut self, at: &tree::Name, of_type: &Type) -> Option<String> {
        let text = plain_address(&at.text);
        let Ok(address) = Address::parse(&text) else {
            let message = format!("{}: there is no such address", at.text);
            let found = Diagnostic::new(Code::Declaration, at.span, message);
            self.report(found.help("such as %I0.0, %QB0, %MW3, %VD10, %AIW0"));
            return None;
        };
        let wanted = match of_type.base() {
            Type::Bool => "a bit such as %M0.0",
            Type::Byte | Type::Sint | Type::Usint => "a byte such as %MB0",
            Type::Word | Type::Int | Type::Uint | Type::Enumeration(_) => "a word such as %MW0",
            Type::Dword | Type::Dint | Type::Udint | Type::Real | Type::Time => {
                "a double word such as %MD0"
            }
            Type::Invalid => return None,
            _ => {
                self.error(Code::NotThere, at.span, format!("{of_type}: not at an address yet"));
                return None;
            }
        };
        let fits = match address {
            Address::Bit { .. } => *of_type == Type::Bool,
            Address::Byte { .. } => wanted.starts_with("a byte"),
            Address::Word { .. } | Address::Analog(_) | Address::AnalogOutput(_) => {
                wanted.starts_with("a word")
            }
            Address::Double { .. } | Address::HighSpeedCounter(_) => wanted.starts_with("a double"),
            Address::Timer(_) | Address::Counter(_) => {
                matches!(of_type.base(), Type::Bool | Type::Int | Type::Uint | Type::Word)
            }
            _ => false,
        };
        if !fits {
            let message = format!("{}: {} is at {wanted}", at.text, of_type.with_article());
            self.error(Code::WrongType, at.span, message);
            return None;
        }
        self.note(at.span, Named::Address(text.clone()), false);
        Some(text)
    }
}

/// Enumerations and structures without a name are called after their variable.
fn enumeration_name(declared: &tree::Declaration) -> String {
    declared.names.first().map_or_else(String::new, |name| name.text.clone())
}

/// `IX0.0` as AWL writes it.
pub(super) fn plain_address(text: &str) -> String {
    let upper = text.to_ascii_uppercase();
    match upper.as_bytes() {
        [area, b'X', ..] if upper.contains('.') && area.is_ascii_alphabetic() => {
            upper.replacen('X', "", 1)
        }
        _ if upper.starts_with("AIN") => upper.replacen("AIN", "Ain", 1),
        _ => upper,
    }
}
