//! Expressions of structured text as the instructions that they would be: contacts of AND and OR,
//! one step of arithmetic. What is more than that is no line of AWL.

use super::width::{self, Width};
use crate::text::address::Address;

/// A word or sign of an expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Token {
    And,
    Or,
    Not,
    /// `+ - * /` and all other signs.
    Sign(char),
    Operand(String),
}

impl Token {
    pub(super) fn is_logic(&self) -> bool {
        matches!(self, Token::And | Token::Or | Token::Not)
            || matches!(self, Token::Operand(text) if truth(text).is_some())
    }

    pub(super) fn text(&self) -> &str {
        match self {
            Token::Operand(text) => text,
            _ => "",
        }
    }

    fn of_word(word: &str) -> Token {
        match word.to_uppercase().as_str() {
            "AND" | "UND" => Token::And,
            "OR" | "ODER" => Token::Or,
            "NOT" | "NICHT" => Token::Not,
            _ => Token::Operand(written(word)),
        }
    }
}

/// An operand without the signs and the data block that other languages have before it: `%Q0.0`,
/// `#Start`, `"Data".Start`.
pub(super) fn bare(word: &str) -> &str {
    let bare = word.trim_start_matches(['%', '#']);
    let member = bare.strip_prefix('"').and_then(|rest| rest.split_once("\"."));
    member.map_or(bare, |(_, member)| member)
}

/// An operand as it is written here.
fn written(word: &str) -> String {
    let bare = bare(word);
    if Address::parse(bare).is_ok() { bare.to_uppercase() } else { bare.to_owned() }
}

/// The same, if it is an address or a name.
pub(super) fn operand(text: &str) -> Option<String> {
    let bare = bare(text);
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '"' | '#' | '[' | ']');
    let starts = bare.starts_with(|c: char| c.is_alphabetic() || matches!(c, '"' | '#' | '_'));
    let is_quoted = bare.len() > 2 && bare.starts_with('"') && bare.ends_with('"');
    (is_quoted || starts && bare.chars().all(is_name)).then(|| written(text))
}

/// The instructions of an expression, told in a sentence.
pub(super) fn listed(code: &[String]) -> String {
    let quoted: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
    format!("on an S7-200 that is {}: one instruction on a line", quoted.join(", "))
}

fn truth(text: &str) -> Option<bool> {
    match text.to_ascii_uppercase().as_str() {
        "TRUE" => Some(true),
        "FALSE" => Some(false),
        _ => None,
    }
}

/// The value that an operand of this width has or gets, if it is a bit. What is true or false is a
/// bit, whatever its name is.
pub(super) fn bit_value(width: Option<Width>, text: &str) -> Option<bool> {
    match (width, text.to_ascii_uppercase().as_str()) {
        (Some(Width::Bit) | None, "TRUE" | "HIGH") | (Some(Width::Bit), "1") => Some(true),
        (Some(Width::Bit) | None, "FALSE" | "LOW") | (Some(Width::Bit), "0") => Some(false),
        _ => None,
    }
}

pub(super) fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let in_word =
            |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '"' | '#' | '%' | '[' | ']');
        let len = match rest.strip_prefix('"').and_then(|inside| inside.find('"')) {
            Some(quoted) => {
                let member = rest[quoted + 2..].find(|c| !in_word(c));
                quoted + 2 + member.unwrap_or(rest.len() - quoted - 2)
            }
            None => rest.find(|c| !in_word(c)).unwrap_or(rest.len()),
        };
        let (token, len) = match first {
            _ if len > 0 => (Token::of_word(&rest[..len]), len),
            '&' => (Token::And, if rest.starts_with("&&") { 2 } else { 1 }),
            '|' => (Token::Or, if rest.starts_with("||") { 2 } else { 1 }),
            '!' => (Token::Not, 1),
            other => (Token::Sign(other), other.len_utf8()),
        };
        tokens.push(token);
        rest = rest[len..].trim_start();
    }
    tokens
}

/// The contacts of an expression without brackets: an OR of ANDs.
pub(super) fn contacts(tokens: &[Token]) -> Option<Vec<String>> {
    let mut code = Vec::new();
    for (number, product) in tokens.split(|token| *token == Token::Or).enumerate() {
        let parts: Vec<&[Token]> = product.split(|token| *token == Token::And).collect();
        let is_single = parts.len() == 1;
        for (index, part) in parts.into_iter().enumerate() {
            let contact = match (number, index) {
                (1.., 0) if is_single => "O",
                (_, 0) => "LD",
                _ => "A",
            };
            code.push(one_contact(contact, part)?);
        }
        if number > 0 && !is_single {
            code.push("OLD".to_owned());
        }
    }
    Some(code)
}

fn one_contact(contact: &str, part: &[Token]) -> Option<String> {
    let (inverted, name) = match part {
        [Token::Operand(name)] => (false, name),
        [Token::Not, Token::Operand(name)] => (true, name),
        _ => return compared(contact, part, None),
    };
    let (inverted, name) = match truth(name) {
        Some(value) => (inverted == value, "SM0.0"),
        // The output of a timer that has a name elsewhere.
        None if name.to_ascii_uppercase().ends_with(".Q") => (inverted, "T37"),
        None => (inverted, name.as_str()),
    };
    // What is no bit, such as a number, is no contact.
    let is_bit = match Address::parse(name) {
        Ok(address) => {
            matches!(address, Address::Bit { .. } | Address::Timer(_) | Address::Counter(_))
        }
        Err(_) => !name.starts_with(|c: char| c.is_ascii_digit()),
    };
    is_bit.then(|| format!("{contact}{} {name}", if inverted { "N" } else { "" }))
}

/// The contact of a comparison, `VW0 >= 5`. `unknown` is how wide names are.
fn compared(contact: &str, part: &[Token], unknown: Option<Width>) -> Option<String> {
    let (Token::Operand(left), rest) = part.split_first()? else { return None };
    let signs: String = rest
        .iter()
        .map_while(|token| match token {
            Token::Sign(sign @ ('<' | '>' | '=')) => Some(*sign),
            _ => None,
        })
        .collect();
    let relation = if signs == "==" { "=" } else { signs.as_str() };
    if !matches!(relation, "=" | "<>" | "<" | ">" | "<=" | ">=") {
        return None;
    }
    let right = match rest.get(signs.len()..)? {
        [Token::Operand(right)] => right.clone(),
        [Token::Sign('-'), Token::Operand(right)] if right.parse::<u32>().is_ok() => {
            format!("-{right}")
        }
        _ => return None,
    };
    if let (true, Some(value)) = (relation == "=", bit_value(Width::of_operand(left), &right)) {
        return Some(format!("{contact}{} {left}", if value { "" } else { "N" }));
    }
    let width = width::of(&format!("{left}, {right}")).or(unknown);
    let width = width.filter(|width| *width != Width::Bit)?;
    Some(format!("{contact}{}{relation} {left}, {right}", width.letter()))
}

/// The contacts of an expression after the mnemonic of a contact; `None` where it is none.
pub(crate) fn contacts_of(mnemonic: &str, expression: &str) -> Option<Vec<String>> {
    let tokens = tokens(expression);
    let is_logic = tokens.len() > 1 && tokens.iter().any(Token::is_logic);
    let mut code = contacts(&tokens).filter(|_| is_logic)?;
    let first = code.first_mut()?;
    let operand = first.strip_prefix("LD")?.to_owned();
    // Of an inverted contact the first one is inverted.
    match (mnemonic.ends_with('N'), operand.strip_prefix('N')) {
        (true, None) => *first = format!("{mnemonic}{operand}"),
        (true, Some(_)) => return None,
        (false, _) => *first = format!("{mnemonic}{operand}"),
    }
    // What is joined with the contacts before it goes on as it began.
    let goes_on = match mnemonic.trim_end_matches('N') {
        "A" => !tokens.contains(&Token::Or),
        "O" => !tokens.contains(&Token::And),
        _ => true,
    };
    goes_on.then_some(code)
}

/// The contact that a comparison is after a contact of a bit: `LD`, `VW10 > 5`.
pub(crate) fn contact_of(contact: &str, comparison: &str) -> Option<String> {
    // The width of names is settled later: most values are words.
    compared(contact, &tokens(comparison), Some(Width::Word))
}

/// A rung that writes a bit.
pub(super) fn coil(target: &str, tokens: &[Token]) -> Option<Vec<String>> {
    let mut code = match tokens {
        [Token::Operand(one)] if one == "1" => vec!["LD SM0.0".to_owned()],
        [Token::Operand(zero)] if zero == "0" => vec!["LDN SM0.0".to_owned()],
        tokens => contacts(tokens)?,
    };
    code.push(format!("= {target}"));
    Some(code)
}

/// The instructions that write a value.
pub(super) fn value(target: &str, width: Width, tokens: &[Token]) -> Option<Vec<String>> {
    let is_real = |token: &Token| {
        token.text().starts_with(|c: char| c.is_ascii_digit()) && token.text().contains('.')
    };
    let width = match width {
        Width::Double if tokens.iter().any(is_real) => Width::Real,
        width => width,
    };
    let copy = |from: &str| format!("MOV{} {from}, {target}", width.letter());
    match tokens {
        [Token::Operand(from)] => Some(vec![copy(from)]),
        [Token::Sign('-'), Token::Operand(from)] if from.parse::<u32>().is_ok() => {
            Some(vec![copy(&format!("-{from}"))])
        }
        [Token::Operand(left), Token::Sign(sign), Token::Operand(right)] => {
            arithmetic(target, width, left, *sign, right)
        }
        _ => None,
    }
}

fn arithmetic(
    target: &str,
    width: Width,
    left: &str,
    sign: char,
    right: &str,
) -> Option<Vec<String>> {
    let is_target = |name: &str| name.eq_ignore_ascii_case(target);
    let counts = match (sign, right) {
        ('+', "1") => Some("INC"),
        ('-', "1") => Some("DEC"),
        _ => None,
    };
    if let (Some(count), true) = (counts.filter(|_| width != Width::Real), is_target(left)) {
        return Some(vec![format!("{count}{} {target}", width.letter())]);
    }
    let letter = width.of_all(["", "", "I", "D", "R"]);
    if letter.is_empty() || !matches!(sign, '+' | '-' | '*' | '/') {
        return None;
    }
    let step = |operand: &str| format!("{sign}{letter} {operand}, {target}");
    Some(if is_target(left) {
        vec![step(right)]
    } else if !is_target(right) {
        vec![format!("MOV{} {left}, {target}", width.letter()), step(right)]
    } else if matches!(sign, '+' | '*') {
        vec![step(left)]
    } else {
        return None;
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coil_of(text: &str) -> String {
        coil("Q0.0", &tokens(text)).map_or_else(String::new, |code| code.join("; "))
    }

    fn value_of(target: &str, text: &str) -> String {
        let width = Width::of_operand(target).unwrap_or(Width::Word);
        value(target, width, &tokens(text)).map_or_else(String::new, |code| code.join("; "))
    }

    #[test]
    fn contacts_of_and_and_or() {
        assert_eq!(coil_of("I0.0"), "LD I0.0; = Q0.0");
        assert_eq!(coil_of("i0.0 AND NOT %I0.1"), "LD I0.0; AN I0.1; = Q0.0");
        assert_eq!(coil_of("Start OR Q0.0 AND !Stop"), "LD Start; LD Q0.0; AN Stop; OLD; = Q0.0");
        assert_eq!(coil_of("I0.0 & I0.1 || I0.2"), "LD I0.0; A I0.1; O I0.2; = Q0.0");
        assert_eq!(coil_of("NOT FALSE"), "LD SM0.0; = Q0.0");
        assert_eq!(coil_of("TRUE"), "LD SM0.0; = Q0.0");
        assert_eq!(coil_of("#Start AND \"Data\".Stop"), "LD Start; A Stop; = Q0.0");
        assert_eq!(coil_of("(I0.0 OR I0.1) AND I0.2"), "");
        assert_eq!(coil_of("VW0 AND I0.2"), "");
        assert_eq!(coil_of("I0.0 AND"), "");
        assert_eq!(coil_of("VW0 > 5"), "LDW> VW0, 5; = Q0.0");
        assert_eq!(coil_of("I0.0 AND VD0 <= -2"), "LD I0.0; AD<= VD0, -2; = Q0.0");
        assert_eq!(coil_of("I0.0 == 1 AND I0.1 = FALSE"), "LD I0.0; AN I0.1; = Q0.0");
        assert_eq!(coil_of("I0.0 = I0.1"), "");
        assert_eq!(coil_of("VW0 > VW2 + 1"), "");
    }

    #[test]
    fn contacts_in_one_line() {
        let code = |mnemonic, text| contacts_of(mnemonic, text).unwrap_or_default().join("; ");
        assert_eq!(code("LD", " Start AND NOT Stop"), "LD Start; AN Stop");
        assert_eq!(code("LDN", " I0.0 & I0.1"), "LDN I0.0; A I0.1");
        assert_eq!(code("A", " I0.0 AND I0.1"), "A I0.0; A I0.1");
        assert_eq!(code("A", " I0.0 OR I0.1"), "");
        assert_eq!(code("LD", " I0.0 I0.1"), "");
        assert_eq!(code("LD", " TRUE"), "");
    }

    #[test]
    fn one_step_of_arithmetic() {
        assert_eq!(value_of("VW0", "5"), "MOVW 5, VW0");
        assert_eq!(value_of("VW0", "-5"), "MOVW -5, VW0");
        assert_eq!(value_of("VW0", "VW0 + 1"), "INCW VW0");
        assert_eq!(value_of("VB0", "VB0-1"), "DECB VB0");
        assert_eq!(value_of("VW0", "VW0+2"), "+I 2, VW0");
        assert_eq!(value_of("VW0", "2 + VW0"), "+I 2, VW0");
        assert_eq!(value_of("VW0", "VW2 / VW4"), "MOVW VW2, VW0; /I VW4, VW0");
        assert_eq!(value_of("VD0", "VD4 * 2.5"), "MOVR VD4, VD0; *R 2.5, VD0");
        assert_eq!(value_of("VW0", "VW2 - VW0"), "");
        assert_eq!(value_of("VB0", "VB1 + VB2"), "");
        assert_eq!(value_of("VW0", "VW2 + VW4 * 3"), "");
    }
}
