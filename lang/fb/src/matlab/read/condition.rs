//! The condition of a transition.

use diagnostics::Span;

use super::lines::Outcome;
use crate::matlab::to_st::Translator;
use crate::matlab::vocabulary::BEFORE;

/// What a line of section 5 asks for.
pub(super) struct Condition {
    pub(super) source: String,
    pub(super) event: Option<String>,
    pub(super) guard: Option<String>,
    pub(super) place: Span,
}

/// `if CE(1) && e_CU && (guard) && ~E(2)`
pub(super) fn condition(translator: &mut Translator) -> Outcome<Condition> {
    translator.step();
    let start = translator.token().span.start;
    if !translator.is_word(BEFORE) {
        let help = "such as: if CE(1) && e_REQ && (X > 5)";
        return translator.wrong("a transition begins with the state that it leaves", help);
    }
    translator.step();
    translator.sign("(")?;
    let source = translator.word().to_owned();
    translator.step();
    let mut end = translator.sign(")")?.span.end;
    let (mut event, mut guard) = (None, None);
    while translator.sign("&&").is_ok() {
        let word = translator.word();
        if word == "~" {
            break;
        }
        match word.strip_prefix("e_") {
            Some(name) if event.is_none() && guard.is_none() => {
                event = Some(name.to_owned());
                end = translator.step().span.end;
            }
            _ if guard.is_some() => {
                return translator.wrong("a second guard", "write one: (a && b)");
            }
            _ => {
                translator.sign("(")?;
                let text = translator.expression()?.text();
                translator.gap(false);
                end = translator.sign(")")?.span.end;
                guard = Some(text.trim().to_owned());
            }
        }
    }
    Ok(Condition { source, event, guard, place: Span { start, end } })
}
