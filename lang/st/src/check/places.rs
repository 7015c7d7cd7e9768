//! Places: variables with members and elements, and what may be written.

use diagnostics::Span;

use super::Checker;
use super::declarations::plain_address;
use super::expressions::invalid;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    Expression, ExpressionKind, Place, Root, SectionKind, Step, Type, Value, Variable,
};
use crate::names::Named;
use crate::tree::{self, Name, Selector};

impl Checker<'_> {
    /// The place that is meant; reported where there is none.
    pub(super) fn place(
        &mut self,
        name: &Name,
        selectors: &[Selector],
        _span: Span,
    ) -> Option<Place> {
        let Some((root, mut kind)) = self.variable(&name.text) else {
            self.unknown_name(name, "variable");
            return None;
        };
        self.note_variable(&root, name.span);
        let mut steps = Vec::new();
        for selector in selectors {
            let step = match selector {
                Selector::Field(member) => self.member(&kind, member)?,
                Selector::Index(indexes) => self.element(&kind, indexes, name)?,
            };
            kind = step.1;
            steps.push(step.0);
        }
        (kind != Type::Invalid).then_some(Place { root, steps, of_type: kind })
    }

    fn note_variable(&mut self, root: &Root, span: Span) {
        let named = match root {
            Root::Local(at) => {
                let unit = self.unit();
                unit.and_then(|unit| Some(Named::of_unit(unit, unit.variables.get(*at)?)))
            }
            Root::Global(at) => {
                self.program.globals.get(*at).map(|one| Named::Global(upper(&one.name)))
            }
            Root::Address(_) => None,
        };
        if let Some(named) = named {
            self.note(span, named, false);
        }
    }

    fn member(&mut self, kind: &Type, name: &Name) -> Option<(Step, Type)> {
        let wanted = upper(&name.text);
        let (found, names): (Option<(usize, Type)>, Vec<String>) = match kind {
            Type::Struct(found) => {
                let at = found.members.iter().position(|one| upper(&one.name) == wanted);
                let kind = at.and_then(|at| Some((at, found.members.get(at)?.of_type.clone())));
                (kind, found.members.iter().map(|one| one.name.clone()).collect())
            }
            Type::Block(number, _) => {
                let variables = &self.program.units.get(*number)?.variables;
                let is_seen = |one: &&Variable| {
                    matches!(one.section, SectionKind::Input | SectionKind::Output)
                };
                let at = variables.iter().position(|one| upper(&one.name) == wanted);
                let kind = at.and_then(|at| {
                    let found = variables.get(at).filter(is_seen)?;
                    Some((at, found.of_type.clone()))
                });
                (kind, variables.iter().filter(is_seen).map(|one| one.name.clone()).collect())
            }
            Type::Invalid => return None,
            _ => (None, Vec::new()),
        };
        if let Some((at, found)) = found {
            if let Some((named, _)) = self.program.member(kind, &name.text) {
                self.note(name.span, named, false);
            }
            let kind = found;
            return Some((Step::Member(at), kind));
        }
        let message = match names.is_empty() {
            true => format!("{}: {} has no members", name.text, kind.with_article()),
            false => format!("{}: {kind} has no such member", name.text),
        };
        let mut diagnostic = Diagnostic::new(Code::UnknownName, name.span, message);
        let near = awl_asm::suggest::nearest(&name.text, names.iter().map(String::as_str));
        diagnostic.suggestion = near.map(str::to_owned);
        if !names.is_empty() {
            diagnostic = diagnostic.help(format!("there are {}", names.join(", ")));
        }
        self.report(diagnostic);
        None
    }

    fn element(
        &mut self,
        kind: &Type,
        indexes: &[tree::Expression],
        name: &Name,
    ) -> Option<(Step, Type)> {
        let Type::Array(array) = kind else {
            if *kind != Type::Invalid {
                let message = format!("{}: {} has no elements", name.text, kind.with_article());
                self.error(Code::WrongType, name.span, message);
            }
            return None;
        };
        let array = array.clone();
        if indexes.len() != array.bounds.len() {
            let (wanted, given) = (array.bounds.len(), indexes.len());
            let message = format!("{}: {wanted} indexes are needed, {given} given", name.text);
            self.error(Code::Arguments, name.span, message);
            return None;
        }
        let mut found = Vec::new();
        for (index, bounds) in indexes.iter().zip(&array.bounds) {
            let one = self.index(index, *bounds);
            let is_known = matches!(one.kind, ExpressionKind::Constant(_));
            if array.of.block().is_some() && !is_known {
                let message = format!("{}: the index of an instance must be known", name.text);
                let found = Diagnostic::new(Code::BadConstant, index.span, message);
                let text = "is the variable of a loop such as `FOR i := 1 TO 4 DO`, or a constant";
                self.report(found.help(text));
                return None;
            }
            found.push(one);
        }
        Some((Step::Element(found), array.of.clone()))
    }

    fn index(&mut self, text: &tree::Expression, (low, high): (i64, i64)) -> Expression {
        let index = self.expression(text, Some(&Type::Int));
        let index = match index.of_type {
            Type::Int | Type::Invalid => index,
            // What an INT does not have is outside of every array: the nearest one is the same.
            ref kind if kind.is_whole() => self.convert(index, &Type::Int),
            _ => self.coerce(index, &Type::Int),
        };
        if let ExpressionKind::Constant(Value::Int(value)) = index.kind
            && index.of_type != Type::Invalid
            && !(low..=high).contains(&value)
        {
            let message = format!("{value}: the index is {low} to {high}");
            self.error(Code::BadConstant, text.span, message);
            return invalid(text.span);
        }
        index
    }

    /// What is at an address in an expression.
    pub(super) fn read_address(
        &mut self,
        text: &str,
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let Some(place) = self.address_place(text, wanted, span) else { return invalid(span) };
        let of_type = place.of_type.clone();
        Expression { kind: ExpressionKind::Read(place), of_type, span }
    }

    /// An address as a place: of the wanted type where it is as long, else a bit string or INT.
    fn address_place(&mut self, text: &str, wanted: Option<&Type>, span: Span) -> Option<Place> {
        let plain = plain_address(text);
        let size = awl_asm::Address::parse(&plain).ok().map(|address| address_size(&address));
        let of_type = match (size, wanted) {
            (Some(1), _) => Type::Bool,
            (Some(8), Some(kind @ (Type::Sint | Type::Usint))) => kind.clone(),
            (Some(8), _) => Type::Byte,
            (Some(16), Some(kind @ (Type::Word | Type::Uint))) => kind.clone(),
            (Some(16), _) => Type::Int,
            (_, Some(kind @ (Type::Dword | Type::Udint | Type::Real | Type::Time))) => kind.clone(),
            _ => Type::Dint,
        };
        let name = Name { text: text.to_owned(), span };
        let address = self.address(&name, &of_type)?;
        Some(Place { root: Root::Address(address), steps: Vec::new(), of_type })
    }

    /// A place that is written. What may not be is reported.
    pub(super) fn target(&mut self, text: &tree::Expression) -> Option<Place> {
        match &text.kind {
            tree::ExpressionKind::Address(address) => {
                let place = self.address_place(address, None, text.span)?;
                self.check_outside(&place, text.span);
                Some(place)
            }
            tree::ExpressionKind::Variable(name, selectors) => {
                let place = self.place(name, selectors, text.span)?;
                self.check_writable(&place, name, text.span);
                Some(place)
            }
            tree::ExpressionKind::Missing => None,
            _ => {
                self.error(Code::NotWritable, text.span, "a variable is needed here");
                None
            }
        }
    }

    fn check_outside(&mut self, place: &Place, span: Span) {
        let is_outside = !matches!(place.root, Root::Local(_));
        if is_outside && self.is_in_function() {
            let message = "a function writes nothing outside of it";
            let found = Diagnostic::new(Code::SideEffect, span, message);
            self.report(found.help("a FUNCTION_BLOCK or PROGRAM can"));
        }
    }

    fn check_writable(&mut self, place: &Place, name: &Name, span: Span) {
        self.check_outside(place, span);
        let variable = match &place.root {
            Root::Local(at) => self.locals().get(*at),
            Root::Global(at) => self.program.globals.get(*at),
            Root::Address(_) => None,
        };
        let Some(variable) = variable.cloned() else { return };
        if variable.is_constant {
            let message = format!("{}: is a constant", name.text);
            self.error(Code::NotWritable, span, message);
        } else if variable.section == SectionKind::Input {
            let message = format!("{}: an input is given by the caller, not written", name.text);
            self.error(Code::NotWritable, span, message);
        } else if let (Some(number), Some(Step::Member(at))) = (
            variable.of_type.block(),
            place.steps.iter().find(|step| matches!(step, Step::Member(_))),
        ) {
            let member = self.program.units.get(number).and_then(|unit| unit.variables.get(*at));
            if member.is_some_and(|member| member.section == SectionKind::Output) {
                let message = "an output of an instance is written by the block alone";
                self.error(Code::NotWritable, span, message);
            }
        }
        let is_control = |one: &Option<String>| one.as_deref() == Some(upper(&name.text).as_str());
        if self.loops.iter().any(is_control) {
            let message = format!("{}: the loop around counts with it", name.text);
            let found = Diagnostic::new(Code::Loop, span, message);
            self.report(found.help("leave the loop with EXIT, or write WHILE"));
        }
    }
}

fn address_size(address: &awl_asm::Address) -> u8 {
    use awl_asm::Address;
    match address {
        Address::Bit { .. } => 1,
        Address::Byte { .. } => 8,
        Address::Word { .. } | Address::Analog(_) | Address::AnalogOutput(_) => 16,
        Address::Timer(_) | Address::Counter(_) => 16,
        _ => 32,
    }
}
