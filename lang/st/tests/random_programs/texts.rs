//! Functions of texts and conversions from them, of the naive evaluator.

use super::values::{Kind, Value, whole as number};

/// Most characters of a text.
const CHARACTERS_MAX: usize = 254;

/// `l` characters from position `p` on, those that there are.
fn part(text: &[u8], l: i64, p: i64) -> Vec<u8> {
    let (l, before) = (l.max(0) as usize, p.max(1) as usize - 1);
    text.iter().skip(before).take(l).copied().collect()
}

fn joined(texts: &[&[u8]]) -> Vec<u8> {
    let mut all = texts.concat();
    all.truncate(CHARACTERS_MAX);
    all
}

/// Another text in place of `l` characters from position `p` on.
fn replaced(text: &[u8], by: &[u8], l: i64, p: i64) -> Vec<u8> {
    let (l, before) = (l.max(0) as usize, p.max(1) as usize - 1);
    let end = text.len().min(before + l);
    joined(&[&text[..before.min(text.len())], by, &text[end..]])
}

pub fn function(name: &str, values: &[Value]) -> Value {
    let text = |at: usize| match &values[at] {
        Value::Text(text) => text.as_slice(),
        other => panic!("{name}: no text: {other:?}"),
    };
    let whole = |at: usize| number(&values[at]);
    let all: Vec<&[u8]> = (0..values.len())
        .map_while(|at| match &values[at] {
            Value::Text(text) => Some(text.as_slice()),
            _ => None,
        })
        .collect();
    Value::Text(match name {
        "LEN" => return Value::Number(Kind::Int, text(0).len() as i64),
        "FIND" => {
            let (in_it, wanted) = (text(0), text(1));
            let mut starts = (0..in_it.len()).filter(|_| !wanted.is_empty());
            let at = starts.find(|&at| in_it[at..].starts_with(wanted));
            return Value::Number(Kind::Int, at.map_or(0, |at| at as i64 + 1));
        }
        "LEFT" => part(text(0), whole(1), 1),
        "RIGHT" => {
            let all = text(0).len();
            text(0)[all - (whole(1).max(0) as usize).min(all)..].to_vec()
        }
        "MID" => part(text(0), whole(1), whole(2)),
        "CONCAT" => joined(&all),
        "INSERT" => {
            let before = (whole(2).max(0) as usize).min(text(0).len());
            joined(&[&text(0)[..before], text(1), &text(0)[before..]])
        }
        "DELETE" => replaced(text(0), b"", whole(1), whole(2)),
        "REPLACE" => replaced(text(0), text(1), whole(2), whole(3)),
        other => panic!("not evaluated: {other}"),
    })
}

/// What is after blanks: whether there is a minus, and what is after the sign.
fn signed(text: &[u8]) -> (bool, String) {
    let text: String = text.iter().map(|&byte| char::from(byte)).collect();
    let text = text.trim_start_matches(' ');
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    (text.starts_with('-'), unsigned.to_owned())
}

/// The whole number that a text begins with; 0 where there is none, or none that the type has.
pub fn whole(text: &[u8], kind: Kind) -> i64 {
    let (is_negative, text) = signed(text);
    let digits: String = text.chars().take_while(char::is_ascii_digit).collect();
    let value = digits.parse::<i64>().unwrap_or(0);
    let value = if is_negative { -value } else { value };
    let (low, high) = kind.range();
    if (low..=high).contains(&value) { value } else { 0 }
}

/// The number with at most one point or comma that a text begins with; 0 where there is none.
pub fn real(text: &[u8]) -> f32 {
    let (is_negative, text) = signed(text);
    let (mut number, mut points) = (String::new(), 0);
    for one in text.replace(',', ".").chars() {
        points += u32::from(one == '.');
        if points > 1 || !(one == '.' || one.is_ascii_digit()) {
            break;
        }
        number.push(one);
    }
    match number.parse::<f32>() {
        Ok(value) if value.is_finite() => {
            if is_negative {
                -value
            } else {
                value
            }
        }
        _ => 0.0,
    }
}
