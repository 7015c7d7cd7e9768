//! Which names can be changed, and to what. Where they are is known elsewhere.

use awl_asm::locals::wrong_name;
use awl_asm::symbols::check_name as check_symbol;
use diagnostics::Span;

use crate::answer::Refusal;
use crate::language::Text;
use crate::structured;
use crate::subject::{Mention, Subject};

fn refused<T>(words: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal(words.into()))
}

/// Whether a thing has a name of its own that can be changed.
pub(crate) fn check_subject(subject: &Subject) -> Result<(), Refusal> {
    match subject {
        Subject::Symbol(_) | Subject::Local(..) | Subject::Label(..) | Subject::Unit(_) => Ok(()),
        Subject::Structured(named) => structured::check_subject(named),
        Subject::Address(address) => {
            refused(format!("{address} is an address; a symbol for it has a name to change"))
        }
        Subject::Instruction(_) | Subject::Word(_) => {
            refused("this is a word of the language, no name")
        }
        Subject::File(_) => refused("this is a file"),
    }
}

/// Whether a thing can have this name.
pub(crate) fn check_name(subject: &Subject, name: &str) -> Result<(), Refusal> {
    if name.contains(['"', '\n', '\r', '\t']) || name.trim() != name {
        return refused(format!("{name}: a name has no quotes, and no blanks around it"));
    }
    match subject {
        Subject::Label(..) => match name.parse::<u16>() {
            Ok(_) => Ok(()),
            Err(_) => refused(format!("{name}: a label is a number, 0 to {}", u16::MAX)),
        },
        Subject::Local(..) | Subject::Unit(_) => match wrong_name(name) {
            Some(why) => refused(format!("{name}: {why}")),
            None => Ok(()),
        },
        Subject::Structured(_) => structured::check_name(name),
        _ => check_symbol(name, Span::default()).or_else(|error| refused(error.message.clone())),
    }
}

/// Whether nothing else has the name.
pub(crate) fn check_free<'m>(
    subject: &Subject,
    name: &str,
    mut others: impl Iterator<Item = &'m Mention>,
) -> Result<(), Refusal> {
    let wanted = match subject {
        Subject::Symbol(_) => Subject::Symbol(name.to_lowercase()),
        Subject::Local(unit, _) => Subject::Local(*unit, name.to_lowercase()),
        Subject::Label(unit, _) => Subject::Label(*unit, name.parse().unwrap_or_default()),
        _ => return Ok(()),
    };
    match wanted != *subject && others.any(|other| other.subject == wanted) {
        true => refused(format!("{name}: there is something of this name already")),
        false => Ok(()),
    }
}

/// Whether a thing is written there by the name that is to change: a routine has a number, too.
pub(crate) fn is_written_so(subject: &Subject, written: &str, old: &str) -> bool {
    let bare = |text: &str| text.trim_matches('"').to_lowercase();
    !matches!(subject, Subject::Unit(_)) || bare(written) == bare(old)
}

/// The new name as it is written at a place of a text.
pub(crate) fn written(
    language: &dyn Text,
    subject: &Subject,
    span: Span,
    text: &str,
    name: &str,
) -> String {
    let is_in_quotes = text.get(..span.start as usize).is_some_and(|text| text.ends_with('"'));
    match subject {
        Subject::Symbol(_) if !is_in_quotes => language.written(name),
        _ => name.to_owned(),
    }
}
