//! IF of structured text and of C with all that is in it, as the contacts and coils that it would
//! be. With an IF within, or ELSIF, it is said as a whole.

use super::expression;
use super::together::Together;
use super::width::Width;

const MESSAGE: &str = "AWL has no IF";
const HELP: &str = "a contact is before what it is for, as in `LD I0.0`, `= Q0.0`; or jump over it \
     with `JMP 1` and `LBL 1`";
/// Lines of one IF that are looked for its end.
const LINES_MAX: usize = 100;

/// The IF that begins where the text begins.
pub(super) fn find(text: &str) -> Option<Together> {
    let rest = after_word(text, &["IF", "WENN"])?;
    let (condition, body) = head(rest)?;
    let is_c = body.is_c;
    let (statements, len) = until_end(body.text, is_c)?;
    let len = text.len() - body.text.len() + len;
    let code = rungs(condition, statements).unwrap_or_default();
    let help = code.is_empty().then(|| HELP.to_owned());
    Some(Together { message: MESSAGE, code, help: help.into_iter().collect(), len, stand_in: None })
}

struct Body<'t> {
    text: &'t str,
    /// Whether it ends with a brace.
    is_c: bool,
}

/// What follows one of these words.
fn after_word<'t>(text: &'t str, words: &[&str]) -> Option<&'t str> {
    words.iter().find_map(|word| {
        let (first, rest) = text.split_at_checked(word.len())?;
        let is_whole = !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        (first.eq_ignore_ascii_case(word) && is_whole).then_some(rest)
    })
}

/// The condition, and what is after THEN or the brace.
fn head(rest: &str) -> Option<(&str, Body<'_>)> {
    let line = rest.lines().next()?;
    if let Some((condition, _)) = line.split_once('{') {
        return Some((condition, Body { text: &rest[condition.len() + 1..], is_c: true }));
    }
    let at = ["THEN", "DANN"].iter().find_map(|word| line.to_ascii_uppercase().find(word))?;
    Some((line.get(..at)?, Body { text: rest.get(at + 4..)?, is_c: false }))
}

/// What is before the end of the IF, and where that ends.
fn until_end(body: &str, is_c: bool) -> Option<(&str, usize)> {
    let mut position = 0;
    for line in body.split_inclusive('\n').take(LINES_MAX) {
        let code = line.split_once("//").map_or(line, |(code, _)| code);
        let found = match is_c {
            true => code.find('}').map(|at| (at, at + 1)),
            false => ["END_IF", "ENDE_WENN", "ENDIF"].iter().find_map(|word| {
                let at = code.to_ascii_uppercase().find(word)?;
                let end = at + word.len();
                let has_semicolon = code.get(end..).is_some_and(|rest| rest.starts_with(';'));
                Some((at, end + usize::from(has_semicolon)))
            }),
        };
        if let Some((at, end)) = found {
            return Some((body.get(..position + at)?, position + end));
        }
        position += line.len();
    }
    None
}

/// Contacts of the condition, then what is done while it is true; the same for what is done
/// otherwise.
fn rungs(condition: &str, statements: &str) -> Option<Vec<String>> {
    let condition = condition.trim();
    let bare = condition.strip_prefix('(').and_then(|inside| inside.strip_suffix(')'));
    let condition = expression::tokens(bare.unwrap_or(condition));
    let contacts = expression::contacts(&condition)?;
    let (then, otherwise) = branches(statements);
    let then = assignments(&then)?;
    let otherwise = match otherwise {
        Some(statements) => assignments(&statements)?,
        None => Vec::new(),
    };
    if let Some(coils) = coils(&then, &otherwise) {
        return Some([contacts, coils].concat());
    }
    // The condition is read again: what was done must not have changed it.
    let is_changed = then
        .iter()
        .any(|one| condition.iter().any(|token| token.text().eq_ignore_ascii_case(&one.target)));
    let code = |of: Vec<Assignment>| of.into_iter().flat_map(|one| one.code).collect::<Vec<_>>();
    match (otherwise.is_empty(), is_changed) {
        (true, _) => Some([contacts, code(then)].concat()),
        (false, true) => None,
        (false, false) => {
            let inverted = vec!["NOT".to_owned()];
            Some([contacts.clone(), code(then), contacts, inverted, code(otherwise)].concat())
        }
    }
}

/// The statements of the two branches, without comments.
fn branches(statements: &str) -> (String, Option<String>) {
    let mut then = Vec::new();
    let mut otherwise: Option<Vec<&str>> = None;
    for line in statements.lines() {
        let code = line.split_once("//").map_or(line, |(code, _)| code);
        let rest = after_word(code.trim_start(), &["ELSE", "SONST"]);
        match (rest, &mut otherwise) {
            (Some(rest), None) => otherwise = Some(vec![rest]),
            (_, Some(otherwise)) => otherwise.push(code),
            (None, None) => then.push(code),
        }
    }
    (then.join("\n"), otherwise.map(|lines| lines.join("\n")))
}

/// What a statement writes.
struct Assignment {
    target: String,
    /// The value, if it writes a bit.
    bit: Option<bool>,
    code: Vec<String>,
}

/// All statements of a branch, at least one.
fn assignments(statements: &str) -> Option<Vec<Assignment>> {
    let statements = statements.split([';', '\n']).map(str::trim).filter(|one| !one.is_empty());
    let all: Vec<Assignment> = statements.map(assignment).collect::<Option<_>>()?;
    (!all.is_empty()).then_some(all)
}

/// Coils, where one branch sets exactly the bits that the other resets.
fn coils(then: &[Assignment], otherwise: &[Assignment]) -> Option<Vec<String>> {
    let is_reset = |set: &Assignment| {
        let mut of_same = otherwise.iter().filter(|reset| reset.target == set.target);
        of_same.next().is_some_and(|reset| reset.bit == Some(false))
    };
    let is_all = then.len() == otherwise.len()
        && then.iter().all(|set| set.bit == Some(true) && is_reset(set));
    is_all.then(|| then.iter().map(|set| format!("= {}", set.target)).collect())
}

/// `Q0.0 := TRUE` sets, FALSE resets; a value is copied.
fn assignment(statement: &str) -> Option<Assignment> {
    let (target, value) = statement.split_once(":=").or_else(|| statement.split_once('='))?;
    let target = expression::tokens(target);
    let [target] = target.as_slice() else { return None };
    let (target, value) = (target.text(), expression::tokens(value));
    let width = Width::of_operand(target);
    let bit = match value.as_slice() {
        [value] => expression::bit_value(width, value.text()),
        _ => None,
    };
    let code = match (bit, width) {
        (None, None | Some(Width::Bit)) => return None,
        (None, Some(width)) => expression::value(target, width, &value)?,
        (Some(true), _) => vec![format!("S {target}, 1")],
        (Some(false), _) => vec![format!("R {target}, 1")],
    };
    Some(Assignment { target: target.to_owned(), bit, code })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> (String, &str) {
        let found = find(text).expect("an IF");
        (found.code.join("; "), &text[..found.len])
    }

    #[test]
    fn conditions_with_what_they_are_for() {
        let text = "IF I0.0 THEN\n  Q0.0 := TRUE;\nEND_IF;\nLD I0.1";
        let whole = "IF I0.0 THEN\n  Q0.0 := TRUE;\nEND_IF;";
        assert_eq!(found(text), ("LD I0.0; S Q0.0, 1".to_owned(), whole));
        let text = "if (I0.0 == 1) {\n  Q0.0 = 0;\n  VW0 = VW0 + 1;\n}\n";
        let whole = text.trim_end();
        assert_eq!(found(text), ("LD I0.0; R Q0.0, 1; INCW VW0".to_owned(), whole));
        let text = "IF VW0 > 5 AND NOT I0.0 THEN VW0 := 0; END_IF";
        assert_eq!(found(text).0, "LDW> VW0, 5; AN I0.0; MOVW 0, VW0");
    }

    #[test]
    fn what_is_done_otherwise() {
        let text = "IF I0.0 THEN\n  Q0.0 := TRUE;\nELSE\n  Q0.0 := FALSE;\nEND_IF";
        assert_eq!(found(text).0, "LD I0.0; = Q0.0");
        let text = "IF Start = TRUE THEN\n  Motor := TRUE;\nEND_IF";
        assert_eq!(found(text).0, "LD Start; S Motor, 1");
        let text = "IF VW0 > 5 THEN\n  VW2 := 1;\nELSE VW2 := 2;\nEND_IF";
        assert_eq!(found(text).0, "LDW> VW0, 5; MOVW 1, VW2; LDW> VW0, 5; NOT; MOVW 2, VW2");
        let text = "IF VW0 > 5 THEN\n  VW0 := 1;\nELSE VW2 := 2;\nEND_IF";
        assert_eq!(found(text).0, "");
    }

    #[test]
    fn more_than_that_is_one_answer_too() {
        let text = "IF I0.0 THEN\n  IF I0.1 THEN\n  END_IF";
        assert_eq!(found(text), (String::new(), text));
        assert_eq!(found("IF I0.0 THEN\n  CALL(5);\nEND_IF").0, "");
        assert_eq!(found("IF I0.0 THEN\n R I0.0\nELSE\n VW0 := 1;\nEND_IF").0, "");
        assert_eq!(find("IF I0.0 THEN\n"), None);
        assert_eq!(find("IFX I0.0 THEN END_IF"), None);
        assert_eq!(find("IF I0.0"), None);
    }
}
