//! Conditions of a plant file: `Q0.0 and not Jam or Door = 0..20`.

use plc_isa::Relation;

use super::cursor::{Read, number, wrong};
use super::diagnostic::Code;
use super::model::{Condition, Description, Subject, Term};
use crate::piece::Piece;
use crate::scenario::condition::{foreign_relation, is_order};

/// Most terms of a condition.
const TERMS_MAX: usize = 32;

const FORM: &str = "write names, or comparisons such as Door = 0..20, joined by and, or, not";

/// Reads a condition to its end.
pub(super) fn condition(names: &Description, text: Piece<'_>) -> Read<Condition> {
    let mut tokens = Tokens { rest: text, next: None };
    let mut any = vec![Vec::new()];
    let mut count = 0;
    loop {
        count += 1;
        if count > TERMS_MAX {
            let message = format!("a condition has at most {TERMS_MAX} terms");
            return Err(wrong(Code::TooMuch, text, message));
        }
        let term = term(names, &mut tokens)?;
        if let Some(all) = any.last_mut() {
            all.push(term);
        }
        let joint = tokens.take();
        match joint.text.to_ascii_lowercase().as_str() {
            "" => return Ok(Condition(any)),
            "and" => {}
            "or" => any.push(Vec::new()),
            _ => {
                let message = format!("{} does not join conditions", joint.text);
                return Err(wrong(Code::Statement, joint, message).help(FORM));
            }
        }
    }
}

fn term(names: &Description, tokens: &mut Tokens<'_>) -> Read<Term> {
    let mut name = tokens.take();
    let is_negated = name.is("not");
    if is_negated {
        name = tokens.take();
    }
    if name.text.is_empty() {
        return Err(wrong(Code::Statement, name, "a condition is missing").help(FORM));
    }
    if name.is("!") {
        return Err(wrong(Code::Statement, name, "! negates nothing").suggest("not "));
    }
    let subject = names.subject(name)?;
    let sign = tokens.peek();
    if let Some(meant) = foreign_relation(sign.text) {
        let message = format!("{} is no sign of a comparison", sign.text);
        return Err(wrong(Code::Statement, sign, message).suggest(meant.symbol()));
    }
    let Some(relation) = Relation::ALL.into_iter().find(|one| one.symbol() == sign.text) else {
        if let Subject::Part(_) = subject {
            let message = format!("{} is a number: with what is it compared?", name.text);
            let help = format!("write {} = 0, or < > <= >= <>", name.text);
            return Err(wrong(Code::Statement, name, message).help(help));
        }
        // By itself: not 0.
        return Ok(Term { subject, is_negated, relation: Relation::NotEqual, values: 0..=0 });
    };
    tokens.take();
    let value = tokens.take();
    let (low, high) = value.text.split_once("..").unwrap_or((value.text, value.text));
    let (low, high) = (number(value, low)?, number(value, high)?);
    if low > high {
        let message = format!("{}: the first number of a range is the smaller one", value.text);
        return Err(wrong(Code::Number, value, message));
    }
    if is_order(relation) && low != high {
        let message = format!("{} compares with one number, not with a range", sign.text);
        return Err(wrong(Code::Statement, value, message));
    }
    let is_place = matches!(subject, Subject::Belt(_));
    if is_place && is_order(relation) {
        let message = format!("{} {} asks nothing of a belt", name.text, sign.text);
        let help = format!(
            "{0} = 40..60: a piece is there; {0}.out, {0}.taken: how many have left it",
            name.text
        );
        return Err(wrong(Code::Statement, sign, message).help(help));
    }
    Ok(Term { subject, is_negated, relation, values: low..=high })
}

/// Words and signs of a condition.
struct Tokens<'a> {
    rest: Piece<'a>,
    next: Option<Piece<'a>>,
}

impl<'a> Tokens<'a> {
    /// The next one; empty at the end.
    fn take(&mut self) -> Piece<'a> {
        match self.next.take() {
            Some(next) => next,
            None => self.cut(),
        }
    }

    fn peek(&mut self) -> Piece<'a> {
        let next = self.take();
        self.next = Some(next);
        next
    }

    fn cut(&mut self) -> Piece<'a> {
        let piece = self.rest.trim();
        let is_sign = |c: char| ['=', '<', '>', '!'].contains(&c);
        let begins_with_sign = piece.text.starts_with(is_sign);
        let ends = |c: char| match begins_with_sign {
            true => !is_sign(c),
            false => c.is_whitespace() || is_sign(c),
        };
        let end = piece.text.find(ends).unwrap_or(piece.text.len());
        self.rest = piece.behind(end);
        piece.part(0..end)
    }
}
