//! Values on their way through accumulators, as STEP 7 has them (`L VW0`, `L VW2`, `+I`, `T VW4`),
//! as the instructions of an S7-200 that do the same. What is more than loads, calculations, one
//! comparison and transfers is no such way.

use super::operands;
use super::width::Width;
use crate::text::address::Address;
use crate::text::literal;

/// Lines that are something together.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Way {
    /// What they are here, a line each.
    pub(crate) code: Vec<String>,
    /// How many bytes of the text they are.
    pub(crate) len: usize,
    /// Whether they end with a comparison, which is a contact here.
    pub(crate) compares: bool,
}

/// What an accumulator is combined with.
struct Step<'t> {
    /// `I`, `D` or `R` of arithmetic and comparisons, a mnemonic of logic.
    what: &'t str,
    operand: String,
}

/// The way that begins where the text begins, with its first load.
pub(crate) fn way(text: &str) -> Option<Way> {
    let mut lines = Lines { text, next: 0, end: 0 };
    let (word, first) = lines.next()?;
    let first = written(first).filter(|_| is(word, "L"))?;
    let mut steps: Vec<Step<'_>> = Vec::new();
    let mut targets: Vec<String> = Vec::new();
    let mut end = lines.end;
    while let Some((word, operand)) = lines.next() {
        if is(word, "T") {
            targets.push(written(operand)?);
        } else if !targets.is_empty() {
            // The accumulator is transferred once more only by transfers.
            break;
        } else if is(word, "L") {
            let operand = written(operand)?;
            let (what, "") = lines.next()? else { return None };
            if let Some((relation, width)) = comparison(what) {
                let left = value_before(&first, &steps, width)?;
                return Some(Way {
                    code: vec![format!("LD{}{relation} {left}, {operand}", width.letter())],
                    len: lines.end,
                    compares: true,
                });
            }
            steps.push(Step { what, operand });
        } else if word == "+" {
            steps.push(Step { what: "+I", operand: written(operand)? });
        } else {
            break;
        }
        end = lines.end;
    }
    let code = moved(&first, &steps, &targets)?;
    Some(Way { code, len: end, compares: false })
}

fn is(word: &str, name: &str) -> bool {
    word.eq_ignore_ascii_case(name)
}

/// A comparison is of what was loaded first, if nothing was calculated with it.
fn value_before<'v>(first: &'v str, steps: &[Step<'_>], width: Width) -> Option<&'v str> {
    let fits = Width::of_operand(first).is_none_or(|own| own == width || width == Width::Real);
    (steps.is_empty() && fits).then_some(first)
}

/// `>I` and its like.
fn comparison(word: &str) -> Option<(&str, Width)> {
    let (relation, letter) = word.split_at_checked(word.len().checked_sub(1)?)?;
    let width = match letter {
        "I" | "i" => Width::Word,
        "D" | "d" => Width::Double,
        "R" | "r" => Width::Real,
        _ => return None,
    };
    let relation = match relation {
        "==" => "=",
        "<>" | ">" | "<" | ">=" | "<=" => relation,
        _ => return None,
    };
    Some((relation, width))
}

/// What calculates with a value and the result here, and how wide both are.
fn calculation(what: &str) -> Option<(String, Width)> {
    let upper = what.to_ascii_uppercase();
    let width = match upper.as_str() {
        "+I" | "-I" | "*I" | "/I" => Width::Word,
        "+D" | "-D" | "*D" | "/D" => Width::Double,
        "+R" | "-R" | "*R" | "/R" => Width::Real,
        _ => {
            let (name, width) = match upper.as_str() {
                "AW" | "UW" => ("ANDW", Width::Word),
                "OW" => ("ORW", Width::Word),
                "XOW" => ("XORW", Width::Word),
                "AD" | "UD" => ("ANDD", Width::Double),
                "OD" => ("ORD", Width::Double),
                "XOD" => ("XORD", Width::Double),
                _ => return None,
            };
            return Some((name.to_owned(), width));
        }
    };
    Some((upper, width))
}

/// Copies and calculations that leave the value in each of the targets.
fn moved(first: &str, steps: &[Step<'_>], targets: &[String]) -> Option<Vec<String>> {
    let target = targets.first()?;
    let calculations =
        steps.iter().map(|step| calculation(step.what)).collect::<Option<Vec<_>>>()?;
    let width = match calculations.first() {
        Some((_, width)) => *width,
        None => [first, target].into_iter().find_map(Width::of_operand)?,
    };
    let fits = |text: &str| {
        let own = Width::of_operand(text);
        own.is_none_or(|own| own == width || (own, width) == (Width::Double, Width::Real))
    };
    let all = || steps.iter().map(|step| step.operand.as_str()).chain([first]);
    if width == Width::Bit
        || calculations.iter().any(|(_, other)| *other != width)
        || !all().chain(targets.iter().map(String::as_str)).all(fits)
    {
        return None;
    }
    // Where the target is read after its first value has come, the value is made elsewhere.
    let is_in_the_way = steps.iter().any(|step| step.operand.eq_ignore_ascii_case(target));
    let place = if is_in_the_way { "AC0" } else { target.as_str() };
    let copy = |from: &str, to: &str| {
        (!from.eq_ignore_ascii_case(to)).then(|| format!("MOV{} {from}, {to}", width.letter()))
    };
    let mut code = vec!["LD SM0.0".to_owned()];
    code.extend(copy(first, place));
    for ((name, _), step) in calculations.iter().zip(steps) {
        code.push(format!("{name} {}, {place}", step.operand));
    }
    code.extend(targets.iter().filter_map(|target| copy(place, target)));
    (code.len() > 1).then_some(code)
}

/// An operand as it is written here; `None` for what an S7-200 has otherwise.
fn written(text: &str) -> Option<String> {
    if let Some(same) = operands::same(text) {
        return Some(same);
    }
    let is_known = Address::parse(text).is_ok()
        || literal::looks_like_literal(text) && literal::parse(text).is_ok();
    is_known.then(|| text.to_owned())
}

/// Instructions of a text: first word and operand of each line that has one, up to a setting.
struct Lines<'t> {
    text: &'t str,
    /// Where the next line begins.
    next: usize,
    /// Where the last instruction ends.
    end: usize,
}

impl<'t> Iterator for Lines<'t> {
    type Item = (&'t str, &'t str);

    fn next(&mut self) -> Option<(&'t str, &'t str)> {
        loop {
            let begin = self.next;
            let rest = self.text.get(begin..).filter(|rest| !rest.is_empty())?;
            let line = rest.lines().next()?;
            self.next = begin + rest.find('\n').map_or(rest.len(), |len| len + 1);
            if line.trim_start().starts_with("//#") {
                return None;
            }
            let code = line.split_once("//").map_or(line, |(code, _)| code);
            let code = code.trim_end().trim_end_matches(';').trim_end();
            if !code.is_empty() {
                self.end = begin + code.len();
                let code = code.trim_start();
                let (word, operand) = code.split_once([' ', '\t']).unwrap_or((code, ""));
                return Some((word, operand.trim()));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> String {
        way(text).map_or_else(String::new, |way| way.code.join("; "))
    }

    #[test]
    fn copies_calculations_and_comparisons() {
        assert_eq!(code("L VW0\nT VW2"), "LD SM0.0; MOVW VW0, VW2");
        assert_eq!(code("L 5 // five\n\n  T MB2;\n= Q0.0"), "LD SM0.0; MOVB 5, MB2");
        assert_eq!(code("L 0\nT VD0\nT VD4"), "LD SM0.0; MOVD 0, VD0; MOVD VD0, VD4");
        assert_eq!(code("L VW0\nL VW2\n+I\nT VW4"), "LD SM0.0; MOVW VW0, VW4; +I VW2, VW4");
        assert_eq!(code("L VW0\n+ 5\nT VW0"), "LD SM0.0; +I 5, VW0");
        assert_eq!(
            code("L VW0\nL VW2\n-I\nT VW2"),
            "LD SM0.0; MOVW VW0, AC0; -I VW2, AC0; MOVW AC0, VW2"
        );
        assert_eq!(code("l DB1.DBD0\nL 2.5\n*R\nt VD4"), "LD SM0.0; MOVR VD0, VD4; *R 2.5, VD4");
        assert_eq!(code("L MW0\nL 16#FF\nUW\nT MW2"), "LD SM0.0; MOVW MW0, MW2; ANDW 16#FF, MW2");
        assert_eq!(code("L VW0\nL 5\n>=I\n= Q0.0"), "LDW>= VW0, 5");
        assert_eq!(code("L VD0\nL VD4\n<D"), "LDD< VD0, VD4");
        assert_eq!(code("L VD0\nL 1.5\n==R"), "LDR= VD0, 1.5");
    }

    #[test]
    fn what_is_more_than_that() {
        for text in [
            "L VW0",
            "L VW0\nL VW2",
            "L VW0\nL VW2\n+I\n= Q0.0",
            "L VW0\nL VW2\n+I\nL 5\n>I",
            "L VB0\nT VW2",
            "L VW0\nL VW2\n+D\nT VD4",
            "L S5T#2S\nT VW0",
            "L PEW999\nT VW0",
            "L VW0\nTAK\nT VW2",
            "T VW0",
        ] {
            assert_eq!(code(text), "", "{text}");
        }
    }

    #[test]
    fn the_lines_of_it() {
        let text = "L VW0\nL VW2 // more\n>I // greater\n= Q0.0";
        assert_eq!(way(text).map(|way| &text[..way.len]), Some("L VW0\nL VW2 // more\n>I"));
        let text = "L 5\nT VW0\n\nLD I0.0";
        assert_eq!(way(text).map(|way| &text[..way.len]), Some("L 5\nT VW0"));
    }
}
