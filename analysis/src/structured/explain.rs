//! What is known of a name of Structured Text, in Markdown: its type, section, value, address, and
//! the comment at its declaration.

use awl_asm::Address;
use diagnostics::{Source, Span};
use st::library::Block;
use st::model::{SectionKind, Type, Unit, UnitKind, Value, Variable};
use st::names::{Named, is_same};

use crate::explain::address_words;
use crate::model::Model;

/// What is known of a name; `None` of what the program does not have.
pub(crate) fn explain(named: &Named, address: Option<Address>, model: &Model) -> Option<String> {
    let program = &model.st()?.compiled.program;
    let mut text = match named {
        Named::Global(name) => {
            let is_it = |one: &&Variable| {
                is_same(&one.name, name) || is_same(&st::names::safe_name(&one.name), name)
            };
            let variable = program.globals.iter().find(is_it)?;
            return Some(of_global(variable, address, model));
        }
        Named::Variable(unit, name) => {
            let unit = program.unit(unit)?;
            let variable = unit.variables.iter().find(|one| is_same(&one.name, name))?;
            of_variable(variable, &format!(" of {}", unit.name), address)
        }
        Named::Unit(name) => of_unit(program.unit(name)?, model),
        Named::Type(name) => of_type(name, model)?,
        Named::Member(of, name) => {
            let kind =
                find_type(model, |kind| matches!(kind, Type::Struct(it) if is_same(&it.name, of)));
            let Some(Type::Struct(structure)) = kind else { return None };
            let member = structure.members.iter().find(|one| is_same(&one.name, name))?;
            let at = address.map_or_else(String::new, |address| format!(", {address}"));
            format!("**{}**: {}, a member of {}{at}", member.name, member.of_type, structure.name)
        }
        Named::Value(of, name) => {
            let kind = find_type(
                model,
                |kind| matches!(kind, Type::Enumeration(it) if is_same(&it.name, of)),
            );
            let Some(Type::Enumeration(kind)) = kind else { return None };
            let (name, number) = kind.values.iter().find(|(value, _)| is_same(value, name))?;
            format!("**{name}**: {number}, a value of {}", kind.name)
        }
        Named::Routine(name) => format!("**{name}**: a subroutine in AWL"),
        Named::Address(_) => return None,
    };
    text += &comment_of(named, model);
    Some(text)
}

fn of_global(variable: &Variable, address: Option<Address>, model: &Model) -> String {
    let named = Named::Global(variable.name.to_uppercase());
    of_variable(variable, "", address) + &comment_of(&named, model)
}

fn comment_of(named: &Named, model: &Model) -> String {
    match comment(named, model) {
        Some(comment) => format!("\n\n{comment}"),
        None => String::new(),
    }
}

/// `**Speed**: INT, VAR of Main, at first 5, VW2, a word of V memory`.
fn of_variable(variable: &Variable, of: &str, address: Option<Address>) -> String {
    let retained = if variable.is_retained { " RETAIN" } else { "" };
    let mut parts = vec![format!("**{}**: {}", variable.name, variable.of_type)];
    if variable.is_constant {
        parts.push(format!("CONSTANT{of}"));
    } else {
        parts.push(format!("{}{retained}{of}", section_words(variable.section)));
    }
    let value = value_words(&variable.initial, &variable.of_type);
    match value.filter(|_| variable.has_initial) {
        Some(value) if variable.is_constant => parts.push(value),
        Some(value) => parts.push(format!("at first {value}")),
        None => {}
    }
    if let Some(address) = address {
        parts.push(format!("{address}, {}", address_words(address)));
    }
    parts.join(", ")
}

/// The word that begins a section.
pub(super) fn section_words(section: SectionKind) -> &'static str {
    match section {
        SectionKind::Var => "VAR",
        SectionKind::Input => "VAR_INPUT",
        SectionKind::Output => "VAR_OUTPUT",
        SectionKind::InOut => "VAR_IN_OUT",
        SectionKind::Temp => "VAR_TEMP",
        SectionKind::Global => "VAR_GLOBAL",
        SectionKind::External => "VAR_EXTERNAL",
    }
}

fn value_words(value: &Value, kind: &Type) -> Option<String> {
    Some(match (value, kind) {
        (Value::Bool(true), _) => "TRUE".to_owned(),
        (Value::Bool(false), _) => "FALSE".to_owned(),
        (Value::Real(value), _) => format!("{value:?}"),
        (Value::Int(ms), Type::Time) if ms % 1000 == 0 => format!("T#{}s", ms / 1000),
        (Value::Int(ms), Type::Time) => format!("T#{ms}ms"),
        (Value::Int(number), Type::Enumeration(of)) => {
            of.values.iter().find(|(_, one)| one == number).map(|(name, _)| name.clone())?
        }
        (Value::Int(value), kind) if kind.is_bits() => format!("16#{value:X}"),
        (Value::Int(value), _) => value.to_string(),
        _ => return None,
    })
}

/// What kind of unit it is.
pub(super) fn kind_words(kind: UnitKind) -> &'static str {
    match kind {
        UnitKind::Program => "PROGRAM",
        UnitKind::Function => "FUNCTION",
        UnitKind::Block => "FUNCTION_BLOCK",
    }
}

/// The parameters of a unit that a call gives or takes, in their order.
pub(super) fn parameters(unit: &Unit) -> impl Iterator<Item = &Variable> {
    unit.variables.iter().filter(|one| match one.section {
        SectionKind::Input | SectionKind::InOut => true,
        SectionKind::Output => unit.kind == UnitKind::Block,
        _ => false,
    })
}

/// A unit with its parameters.
fn of_unit(unit: &Unit, model: &Model) -> String {
    let result = match (unit.kind, unit.variables.last()) {
        (UnitKind::Function, Some(result)) => format!(" : {}", result.of_type),
        _ => String::new(),
    };
    let mut text = format!("**{}**: {}{result}", unit.name, kind_words(unit.kind));
    for variable in parameters(unit) {
        let named = Named::Variable(unit.name.to_uppercase(), variable.name.to_uppercase());
        let comment = comment(&named, model).map_or_else(String::new, |text| format!(", {text}"));
        let section = section_words(variable.section);
        text += &format!("\n* {section} {} : {}{comment}", variable.name, variable.of_type);
    }
    text
}

fn of_type(name: &str, model: &Model) -> Option<String> {
    let is_it = |kind: &Type| match kind {
        Type::Enumeration(of) => is_same(&of.name, name),
        Type::Struct(of) => is_same(&of.name, name),
        _ => false,
    };
    match find_type(model, is_it) {
        Some(Type::Enumeration(of)) => {
            let values = of.values.iter().map(|(name, number)| format!("\n* {name} = {number}"));
            Some(format!("**{}**: an enumeration{}", of.name, values.collect::<String>()))
        }
        Some(Type::Struct(of)) => {
            let members =
                of.members.iter().map(|one| format!("\n* {} : {}", one.name, one.of_type));
            Some(format!("**{}**: a structure{}", of.name, members.collect::<String>()))
        }
        _ => Some(format!("**{name}**: a type")),
    }
}

/// A type that is used somewhere, at any depth.
fn find_type(model: &Model, is_it: impl Fn(&Type) -> bool) -> Option<Type> {
    let program = &model.st()?.compiled.program;
    let units = program.units.iter().flat_map(|unit| &unit.variables);
    let mut open: Vec<Type> =
        units.chain(&program.globals).map(|variable| variable.of_type.clone()).collect();
    while let Some(kind) = open.pop() {
        if is_it(&kind) {
            return Some(kind);
        }
        match &kind {
            Type::Array(array) => open.push(array.of.clone()),
            Type::Struct(of) => open.extend(of.members.iter().map(|one| one.of_type.clone())),
            _ => {}
        }
    }
    None
}

/// The comment at a declaration: the one after it in its line, else that in the lines before.
fn comment(named: &Named, model: &Model) -> Option<String> {
    let st = model.st()?;
    if let Named::Unit(unit) | Named::Variable(unit, _) = named
        && st.compiled.program.unit(unit).is_some_and(|unit| unit.file.is_none())
    {
        return of_library(named);
    }
    let declared = st.compiled.names.iter().find(|name| name.declares && name.of == *named)?;
    let source = model.st_source(declared.file)?;
    after(source, declared.span).or_else(|| before(source, declared.span))
}

/// What the library of signal blocks says of a block or its parameter.
fn of_library(named: &Named) -> Option<String> {
    let text = match named {
        Named::Unit(name) => Block::find(name)?.comment(),
        Named::Variable(of, name) => {
            let parameters = Block::find(of)?.parameters();
            let parameter = parameters.into_iter().find(|one| is_same(one.name, name))?;
            parameter.comment.to_owned()
        }
        _ => return None,
    };
    (!text.is_empty()).then_some(text)
}

fn after(source: &Source, span: Span) -> Option<String> {
    let (line, _) = source.position(span.start as usize);
    let line_end = source.line_span(line).end as usize;
    let rest = source.text.get(span.end as usize..line_end)?;
    let starts = ["//", "(*", "/*"].iter().filter_map(|start| rest.find(start));
    bare(rest.get(starts.min()?..)?)
}

/// The lines before it that are comments and nothing else.
fn before(source: &Source, span: Span) -> Option<String> {
    let (line, _) = source.position(span.start as usize);
    let lines = (1..line).rev().map(|line| source.line_text(line).trim());
    let is_comment = |text: &&str| {
        text.starts_with("//") && !text.starts_with("//#")
            || text.starts_with("(*") && text.ends_with("*)")
    };
    let mut all: Vec<String> = lines.take_while(is_comment).filter_map(bare).collect();
    all.reverse();
    (!all.is_empty()).then(|| all.join(" "))
}

/// What a comment says.
fn bare(comment: &str) -> Option<String> {
    let inside = match comment.get(..2)? {
        "//" => comment.trim_start_matches('/'),
        "(*" => comment.get(2..)?.split("*)").next()?,
        _ => comment.get(2..)?.split("*/").next()?,
    };
    let text = inside.trim().trim_matches('*').trim();
    (!text.is_empty()).then(|| text.to_owned())
}
