//! Programs in Structured Text: what editors ask about one. What its names stand for, the checker
//! of the language has noted; AWL and scenarios ask here for the names that they have of it.

mod completions;
mod explain;
mod outline;
mod signature;
mod words;

use awl_asm::Address;
use diagnostics::{Source, Span};
use st::format::format;
use st::keywords::is_keyword;
use st::names::{Named, is_same, safe_name};
use st::parser::parse;
use st::tree::UnitKind;

use crate::answer::{Completion, Outline, Problem, Refusal, Signature};
use crate::language::{Text, View, word_around};
use crate::model::Model;
use crate::subject::{Mention, Subject};

pub(crate) use explain::explain;

/// Structured Text as its compiler reads it.
pub(crate) struct StructuredText;

impl Text for StructuredText {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        view.model.map_or_else(Vec::new, |model| model.problems(&view.source.name))
    }

    fn mentions(&self, view: View<'_>) -> Vec<Mention> {
        let Some(model) = view.model else { return Vec::new() };
        let number = model.st_file(&view.source.name);
        let names = model.st().into_iter().flat_map(|st| &st.compiled.names);
        let here = names.filter(|name| Some(name.file) == number);
        let mention = |name: &st::Name| {
            let (line, _) = view.source.position(name.span.start as usize);
            let by = view.source.line_text(line).trim().to_owned();
            let declares = name.declares;
            Mention { declares, by, ..mention(name.span, &name.of, model) }
        };
        here.map(mention).collect()
    }

    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention> {
        let word = word_around(view.text(), offset);
        let text = words::explained(word.text(view.text()))?;
        // A word of a comment says nothing.
        let before = st::cursor::at(view.text(), word.start as usize).cursor;
        let is_code = before != st::cursor::Cursor::Nothing;
        is_code.then(|| Mention::word(word, text))
    }

    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion> {
        completions::at(view, offset)
    }

    fn signature(&self, view: View<'_>, offset: usize) -> Option<Signature> {
        signature::at(view, offset)
    }

    fn outline(&self, view: View<'_>) -> Vec<Outline> {
        outline::of(view.source)
    }

    fn formatted(&self, view: View<'_>) -> Result<String, Refusal> {
        format(view.source).map_err(|errors| {
            let first = errors.first().map(|error| error.message.as_str()).unwrap_or_default();
            Refusal(format!("the text has errors of form: {first}"))
        })
    }

    fn written(&self, name: &str) -> String {
        name.to_owned()
    }
}

/// Whether a text has no PROGRAM.
pub(crate) fn is_library(source: &Source) -> bool {
    let (file, _) = parse(source);
    !file.units.iter().any(|unit| matches!(unit.kind, UnitKind::Program))
}

/// A name of Structured Text. What AWL and scenarios have the same name for is that.
fn mention(span: Span, named: &Named, model: &Model) -> Mention {
    let symbol = |name: &str| {
        let symbol = model.symbol(&name.to_lowercase())?;
        match symbol.value {
            awl_asm::ast::Value::Address(address) => Some(address),
            _ => None,
        }
    };
    let (subject, address) = match named {
        Named::Global(name) => {
            let name = safe_name(name).to_lowercase();
            let address = symbol(&name);
            (Subject::Symbol(name), address)
        }
        Named::Variable(unit, name) => {
            (Subject::Structured(named.clone()), symbol(&format!("{unit}.{name}")))
        }
        Named::Address(text) => match Address::parse(text) {
            Ok(address) => (Subject::Address(address), Some(address)),
            Err(_) => (Subject::Structured(named.clone()), None),
        },
        Named::Routine(name) => {
            let mut units = model.assembly.program.units();
            match units.find(|(_, unit)| is_same(&unit.name, name)) {
                Some((_, unit)) => (Subject::Unit(unit.id), None),
                None => (Subject::Structured(named.clone()), None),
            }
        }
        _ => (Subject::Structured(named.clone()), None),
    };
    Mention { address, ..Mention::of(span, subject) }
}

/// The names of Structured Text in a name as AWL and scenarios write it, which begins at an offset:
/// of `Main.Delay.ET` three. Empty where it is none of them.
pub(crate) fn mentions_in(written: &str, start: usize, model: &Model) -> Vec<Mention> {
    let Some(st) = model.st() else { return Vec::new() };
    let parts = st.compiled.program.path(written);
    let mut mentions: Vec<Mention> = parts
        .iter()
        .map(|(range, named, _)| {
            mention(Span::new(start + range.start, start + range.end), named, model)
        })
        .collect();
    // The address of the whole name is that of its last part.
    let whole = model.symbol(&written.to_lowercase()).map(|symbol| &symbol.value);
    if let (Some(last), Some(awl_asm::ast::Value::Address(address))) = (mentions.last_mut(), whole)
    {
        last.address = Some(*address);
    }
    mentions
}

/// A word of AWL, as Structured Text means it where it is a name of that.
pub(crate) fn of_awl(text: &str, found: Mention, model: &Model) -> Vec<Mention> {
    let Some(st) = model.st() else { return vec![found] };
    match &found.subject {
        Subject::Unit(id) => {
            let mut units = model.assembly.program.units();
            let unit = units.find(|(_, unit)| unit.id == *id).map(|(_, unit)| &unit.name);
            let own = unit.and_then(|name| st.compiled.program.unit(name));
            let subject = match own {
                Some(own) => Subject::Structured(Named::Unit(own.name.to_uppercase())),
                None => found.subject,
            };
            vec![Mention { subject, ..found }]
        }
        Subject::Symbol(_) => {
            let written = found.span.text(text);
            let start = found.span.start as usize + usize::from(written.starts_with('"'));
            let mut parts = mentions_in(written.trim_matches('"'), start, model);
            let by = |one: Mention| Mention { by: found.by.clone(), ..one };
            match parts.len() {
                0 => vec![found],
                _ => parts.drain(..).map(by).collect(),
            }
        }
        _ => vec![found],
    }
}

/// Whether a name can be changed.
pub(crate) fn check_subject(named: &Named) -> Result<(), Refusal> {
    match named {
        Named::Address(address) => {
            Err(Refusal(format!("{address} is an address; a variable at it has a name to change")))
        }
        _ => Ok(()),
    }
}

/// Whether something can have this name.
pub(crate) fn check_name(name: &str) -> Result<(), Refusal> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') || !name.chars().all(is_word) {
        let why = "a name begins with a letter or `_` and has letters, digits and `_`";
        return Err(Refusal(format!("{name}: {why}")));
    }
    let is_type = st::model::ELEMENTARY.iter().any(|(kind, _)| kind.eq_ignore_ascii_case(name));
    match is_keyword(name) || is_type {
        true => Err(Refusal(format!("{name}: is a word of the language"))),
        false => Ok(()),
    }
}

/// Whether nothing of the program has a name that something is to have. What would hide another
/// thing of this name, or be hidden by it, is refused, too: the text would mean something else.
pub(crate) fn check_free(subject: &Subject, name: &str, model: &Model) -> Result<(), Refusal> {
    let Some(st) = model.st() else { return Ok(()) };
    let named = match subject {
        Subject::Structured(named) => named.clone(),
        Subject::Symbol(old) => Named::Global(old.to_uppercase()),
        _ => return Ok(()),
    };
    if matches!(subject, Subject::Symbol(_)) {
        check_name(name)?;
    }
    let wanted = name.to_uppercase();
    let clashes = |other: &Named| match (&named, other) {
        (_, same) if *same == named => false,
        (Named::Member(of, _), Named::Member(other, taken))
        | (Named::Value(of, _), Named::Value(other, taken)) => of == other && *taken == wanted,
        (Named::Member(..), _) | (_, Named::Member(..) | Named::Routine(_) | Named::Address(_)) => {
            false
        }
        (Named::Variable(unit, _), Named::Variable(other, taken)) => {
            unit == other && *taken == wanted
        }
        (_, Named::Variable(_, taken) | Named::Value(_, taken)) => *taken == wanted,
        (_, Named::Global(taken) | Named::Unit(taken) | Named::Type(taken)) => *taken == wanted,
    };
    let is_block = st.compiled.program.unit(name).is_some();
    match is_block || st.compiled.names.iter().any(|other| clashes(&other.of)) {
        true => Err(Refusal(format!("{name}: there is something of this name already"))),
        false => Ok(()),
    }
}
