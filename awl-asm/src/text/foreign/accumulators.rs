//! Values on their way through accumulators, as STEP 7 has them (`L VW0`, `L VW2`, `+I`, `T VW4`),
//! as the instructions of an S7-200 that do the same. What is more than loads, calculations,
//! conversions, one comparison and transfers is no such way.

use super::operands;
use super::together::{Flow, Lines, Together};
use super::width::Width;
use crate::text::address::Address;
use crate::text::ast::Value;
use crate::text::literal;

/// What is done with the value.
enum Step {
    /// It is combined with an operand.
    Combine { name: &'static str, width: Width, operand: String },
    /// It is changed where it is.
    Change { name: &'static str, width: Width, count: String },
    /// It becomes another.
    Convert { name: &'static str, from: Width, to: Width },
}

impl Step {
    /// How wide the value is before it.
    fn takes(&self) -> Width {
        match self {
            Step::Combine { width, .. } | Step::Change { width, .. } => *width,
            Step::Convert { from, .. } => *from,
        }
    }
}

/// The way that begins with the first load where the text begins.
pub(super) fn find(text: &str, flow: Flow) -> Option<Together> {
    let mut lines = Lines::of(text);
    let (word, first) = lines.next()?;
    // `LD` of a value is the load of an instruction list.
    let is_list = is(word, "LD") && Width::of_operand(first).is_some_and(|of| of != Width::Bit);
    let first = written(first).filter(|_| is_list || is(word, "L"))?;
    let mut steps = Vec::new();
    let mut targets: Vec<String> = Vec::new();
    let mut end = lines.end;
    while let Some((word, operand)) = lines.next() {
        if is(word, "T") || is_list && is(word, "ST") {
            targets.push(written(operand)?);
        } else if !targets.is_empty() {
            break;
        } else if is(word, "L") {
            let operand = written(operand)?;
            let (what, "") = lines.next()? else { return None };
            if let Some(compared) = compared(&first, &steps, what, &operand) {
                return Some(together(vec![compared], lines.end, Some("LDW")));
            }
            steps.push(combined(what, operand)?);
        } else if let (true, Some(relation)) = (is_list, relation_of_list(word)) {
            let width = Width::of_operand(&first)?;
            let compared = contact(&first, &steps, relation, width, &written(operand)?)?;
            return Some(together(vec![compared], lines.end, Some("LDW")));
        } else if let (true, Some(names)) = (is_list, step_of_list(word)) {
            let width = Width::of_operand(&first)?;
            let name = Some(width.of_all(names)).filter(|name| !name.is_empty())?;
            steps.push(Step::Combine { name, width, operand: written(operand)? });
        } else if let Some(step) = alone(word, operand) {
            steps.push(step);
        } else {
            break;
        }
        end = lines.end;
    }
    if first.starts_with('&') {
        return (steps.is_empty() && !targets.is_empty()).then(|| pointer(&first, end, flow));
    }
    let mut code = moved(&first, &steps, &targets)?;
    // The contact is there already.
    if flow == Flow::Contact {
        code.remove(0);
    }
    Some(together(code, end, None))
}

/// A pointer that is loaded.
fn pointer(first: &str, end: usize, flow: Flow) -> Together {
    let load = (flow != Flow::Contact).then(|| "LD SM0.0".to_owned());
    let code = load.into_iter().chain([format!("MOVD {first}, AC1")]).collect();
    let help = "`*AC1` is what it points to; pointers are in AC1, AC2, AC3 or double words of V \
                memory";
    Together { help: vec![help.to_owned()], ..together(code, end, None) }
}

/// What combines the value with an operand in an instruction list of the standard.
fn step_of_list(word: &str) -> Option<[&'static str; 5]> {
    Some(match word.to_ascii_uppercase().as_str() {
        "ADD" => ["", "", "+I", "+D", "+R"],
        "SUB" => ["", "", "-I", "-D", "-R"],
        "MUL" => ["", "", "*I", "*D", "*R"],
        "DIV" => ["", "", "/I", "/D", "/R"],
        "AND" => ["", "ANDB", "ANDW", "ANDD", ""],
        "OR" => ["", "ORB", "ORW", "ORD", ""],
        "XOR" => ["", "XORB", "XORW", "XORD", ""],
        _ => return None,
    })
}

/// What compares the value there.
fn relation_of_list(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_uppercase().as_str() {
        "GT" | ">" => ">",
        "GE" | ">=" => ">=",
        "EQ" | "==" => "=",
        "NE" | "<>" => "<>",
        "LE" | "<=" => "<=",
        "LT" | "<" => "<",
        _ => return None,
    })
}

fn together(code: Vec<String>, len: usize, stand_in: Option<&'static str>) -> Together {
    let message = "an S7-200 has no accumulators between load and transfer";
    Together { message, code, help: Vec::new(), len, stand_in }
}

fn is(word: &str, name: &str) -> bool {
    word.eq_ignore_ascii_case(name)
}

/// The comparison of STEP 7 of what was loaded first, as a contact.
fn compared(first: &str, steps: &[Step], what: &str, operand: &str) -> Option<String> {
    let (relation, width) = comparison(what)?;
    contact(first, steps, relation, width, operand)
}

/// The contact of a comparison of what was loaded first, if nothing was done with it.
fn contact(
    first: &str,
    steps: &[Step],
    relation: &str,
    width: Width,
    operand: &str,
) -> Option<String> {
    let fits = |text: &str| fits(text, width);
    let is_plain = steps.is_empty() && fits(first) && fits(operand);
    is_plain.then(|| format!("LD{}{relation} {first}, {operand}", width.letter()))
}

/// `>I` and its like: the comparison here, and how wide the values are.
pub(crate) fn comparison(word: &str) -> Option<(&str, Width)> {
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

/// What combines two accumulators, with what was in the second.
fn combined(what: &str, operand: String) -> Option<Step> {
    let (name, width) = match what.to_ascii_uppercase().as_str() {
        "+I" => ("+I", Width::Word),
        "-I" => ("-I", Width::Word),
        "*I" => ("*I", Width::Word),
        "/I" => ("/I", Width::Word),
        "+D" => ("+D", Width::Double),
        "-D" => ("-D", Width::Double),
        "*D" => ("*D", Width::Double),
        "/D" => ("/D", Width::Double),
        "+R" => ("+R", Width::Real),
        "-R" => ("-R", Width::Real),
        "*R" => ("*R", Width::Real),
        "/R" => ("/R", Width::Real),
        "AW" | "UW" => ("ANDW", Width::Word),
        "OW" => ("ORW", Width::Word),
        "XOW" => ("XORW", Width::Word),
        "AD" | "UD" => ("ANDD", Width::Double),
        "OD" => ("ORD", Width::Double),
        "XOD" => ("XORD", Width::Double),
        _ => return None,
    };
    Some(Step::Combine { name, width, operand })
}

/// What works on one accumulator.
fn alone(word: &str, operand: &str) -> Option<Step> {
    let upper = word.to_ascii_uppercase();
    let combine = |name, width, operand: &str| {
        Some(Step::Combine { name, width, operand: operand.to_owned() })
    };
    let change = |name, width| {
        let count = operand.parse::<u8>().map_or(String::new(), |count| format!(", {count}"));
        Some(Step::Change { name, width, count })
    };
    let convert = |name, from, to| Some(Step::Convert { name, from, to });
    match (upper.as_str(), operand) {
        ("+", _) => combine("+I", Width::Word, &written(operand)?),
        ("NEGI", "") => combine("*I", Width::Word, "-1"),
        ("NEGD", "") => combine("*D", Width::Double, "-1"),
        ("NEGR", "") => combine("*R", Width::Real, "-1.0"),
        ("INVI", "") => change("INVW", Width::Word),
        ("INVD", "") => change("INVD", Width::Double),
        ("TAW" | "CAW", "") => change("SWAP", Width::Word),
        ("BTI", "") => change("BCDI", Width::Word),
        ("ITB", "") => change("IBCD", Width::Word),
        ("INC", "" | "1") => {
            Some(Step::Change { name: "INCB", width: Width::Byte, count: String::new() })
        }
        ("DEC", "" | "1") => {
            Some(Step::Change { name: "DECB", width: Width::Byte, count: String::new() })
        }
        ("SLW", _) if is_count(operand) => change("SLW", Width::Word),
        ("SRW", _) if is_count(operand) => change("SRW", Width::Word),
        ("SLD", _) if is_count(operand) => change("SLD", Width::Double),
        ("SRD", _) if is_count(operand) => change("SRD", Width::Double),
        ("RLD", _) if is_count(operand) => change("RLD", Width::Double),
        ("RRD", _) if is_count(operand) => change("RRD", Width::Double),
        ("ITD", "") => convert("ITD", Width::Word, Width::Double),
        ("DTR", "") => convert("DTR", Width::Double, Width::Real),
        ("RND", "") => convert("ROUND", Width::Real, Width::Double),
        ("TRUNC", "") => convert("TRUNC", Width::Real, Width::Double),
        ("SQRT", "") => convert("SQRT", Width::Real, Width::Real),
        ("SIN", "") => convert("SIN", Width::Real, Width::Real),
        ("COS", "") => convert("COS", Width::Real, Width::Real),
        ("TAN", "") => convert("TAN", Width::Real, Width::Real),
        ("LN", "") => convert("LN", Width::Real, Width::Real),
        ("EXP", "") => convert("EXP", Width::Real, Width::Real),
        _ => None,
    }
}

fn is_count(text: &str) -> bool {
    text.parse::<u8>().is_ok()
}

/// Whether an operand can be of this width; constants can.
fn fits(text: &str, width: Width) -> bool {
    Width::of_operand(text).is_none_or(|own| is_alike(own, width))
}

/// Reals are in double words.
fn is_alike(own: Width, width: Width) -> bool {
    own == width || matches!((own, width), (Width::Double, Width::Real))
}

/// How wide the value is that is loaded first.
fn first_width(first: &str, steps: &[Step], targets: &[String]) -> Option<Width> {
    let is_real =
        matches!(literal::parse(first), Ok(Value::Real(_))) && literal::looks_like_literal(first);
    match (Width::of_operand(first), steps.first()) {
        _ if is_real => Some(Width::Real),
        (Some(own), Some(step)) if is_alike(own, step.takes()) => Some(step.takes()),
        (Some(own), None) => Some(own),
        (None, Some(step)) => Some(step.takes()),
        (None, None) => Width::of_operand(targets.first()?),
        (Some(_), Some(_)) => None,
    }
    .filter(|width| *width != Width::Bit)
}

/// Copies and calculations that leave the value in each of the targets.
fn moved(first: &str, steps: &[Step], targets: &[String]) -> Option<Vec<String>> {
    let target = targets.first()?;
    let mut width = first_width(first, steps, targets)?;
    // Where the target is read after its first value has come, or the value changes its width on
    // the way, it is made elsewhere.
    let is_read = |step: &Step| match step {
        Step::Combine { operand, .. } => operand.eq_ignore_ascii_case(target),
        Step::Change { .. } | Step::Convert { .. } => false,
    };
    let converts = steps.iter().any(|step| matches!(step, Step::Convert { .. }));
    let is_apart = converts || steps.iter().any(is_read);
    let place = if is_apart { "AC0" } else { target.as_str() };
    let mut code = vec!["LD SM0.0".to_owned()];
    let mut value = first.to_owned();
    for (index, step) in steps.iter().enumerate() {
        if step.takes() != width && !is_alike(width, step.takes()) {
            return None;
        }
        if let Step::Convert { name, to, .. } = step {
            let is_last = index + 1 == steps.len() && fits(target, *to);
            let to_place = if is_last { target.as_str() } else { place };
            code.push(format!("{name} {value}, {to_place}"));
            (value, width) = (to_place.to_owned(), *to);
            continue;
        }
        code.extend(copy(step.takes(), &value, place));
        place.clone_into(&mut value);
        width = step.takes();
        match step {
            Step::Combine { name, operand, .. } if fits(operand, width) => {
                code.push(format!("{name} {operand}, {place}"));
            }
            Step::Change { name, count, .. } => code.push(format!("{name} {place}{count}")),
            Step::Combine { .. } | Step::Convert { .. } => return None,
        }
    }
    for target in targets {
        let own = Width::of_operand(target)?;
        match (width, own) {
            _ if is_alike(own, width) => code.extend(copy(width, &value, target)),
            (Width::Byte, Width::Word) => code.push(format!("BTI {value}, {target}")),
            (Width::Word, Width::Double) => code.push(format!("ITD {value}, {target}")),
            _ => return None,
        }
    }
    (code.len() > 1).then_some(code)
}

fn copy(width: Width, from: &str, to: &str) -> Option<String> {
    (!from.eq_ignore_ascii_case(to)).then(|| format!("MOV{} {from}, {to}", width.letter()))
}

/// An operand as it is written here; `None` for what an S7-200 has otherwise.
fn written(text: &str) -> Option<String> {
    // `PEW 256`, as STEP 7 lays it out.
    let bare: String = text.split_whitespace().collect();
    let text = bare.as_str();
    if let Some(same) = operands::same(text).or_else(|| operands::pointer(text, true)) {
        return Some(same);
    }
    let is_known = Address::parse(text).is_ok()
        || literal::looks_like_literal(text) && literal::parse(text).is_ok();
    is_known.then(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> String {
        find(text, Flow::None).map_or_else(String::new, |found| found.code.join("; "))
    }

    #[test]
    fn copies_and_calculations() {
        assert_eq!(code("L VW0\nT VW2"), "LD SM0.0; MOVW VW0, VW2");
        assert_eq!(code("L 5 // five\n\n  T MB2;\n= Q0.0"), "LD SM0.0; MOVB 5, MB2");
        assert_eq!(code("L 0\nT VD0\nT VD4"), "LD SM0.0; MOVD 0, VD0; MOVD 0, VD4");
        assert_eq!(code("L 3.5\nT MD0"), "LD SM0.0; MOVR 3.5, MD0");
        assert_eq!(code("L VW0\nL VW2\n+I\nT VW4"), "LD SM0.0; MOVW VW0, VW4; +I VW2, VW4");
        assert_eq!(code("L VW0\n+ 5\nT VW0"), "LD SM0.0; +I 5, VW0");
        assert_eq!(
            code("L VW0\nL VW2\n-I\nT VW2"),
            "LD SM0.0; MOVW VW0, AC0; -I VW2, AC0; MOVW AC0, VW2"
        );
        assert_eq!(code("l DB1.DBD0\nL 2.5\n*R\nt VD4"), "LD SM0.0; MOVR VD0, VD4; *R 2.5, VD4");
        assert_eq!(code("L MW0\nL 16#FF\nUW\nT MW2"), "LD SM0.0; MOVW MW0, MW2; ANDW 16#FF, MW2");
        assert_eq!(code("L MW0\nNEGI\nT MW0"), "LD SM0.0; *I -1, MW0");
        assert_eq!(code("L MW0\nSLW 3\nT MW2"), "LD SM0.0; MOVW MW0, MW2; SLW MW2, 3");
        assert_eq!(code("L MB0\nINC 1\nT MB0"), "LD SM0.0; INCB MB0");
        assert_eq!(code("L PIW256\nT MW10"), "LD SM0.0; MOVW AIW0, MW10");
        assert_eq!(code("L PEW 256\nT MW 10"), "LD SM0.0; MOVW AIW0, MW10");
        assert_eq!(code("L P#M10.0\nT MD20"), "LD SM0.0; MOVD &MB10, AC1");
    }

    #[test]
    fn values_that_change_their_width() {
        assert_eq!(code("L MW0\nITD\nDTR\nT MD4"), "LD SM0.0; ITD MW0, AC0; DTR AC0, MD4");
        assert_eq!(
            code("L MD0\nL 2.0\n*R\nRND\nT MD4"),
            "LD SM0.0; MOVR MD0, AC0; *R 2.0, AC0; ROUND AC0, MD4"
        );
        assert_eq!(code("L MW0\nBTI\nT MW2"), "LD SM0.0; MOVW MW0, MW2; BCDI MW2");
        assert_eq!(code("L VB0\nT VW2"), "LD SM0.0; BTI VB0, VW2");
        assert_eq!(code("L VW0\nT VD2"), "LD SM0.0; ITD VW0, VD2");
    }

    #[test]
    fn comparisons() {
        assert_eq!(code("L VW0\nL 5\n>=I\n= Q0.0"), "LDW>= VW0, 5");
        assert_eq!(code("L VD0\nL VD4\n<D"), "LDD< VD0, VD4");
        assert_eq!(code("L VD0\nL 1.5\n==R"), "LDR= VD0, 1.5");
    }

    #[test]
    fn lists_of_the_standard() {
        assert_eq!(code("LD VW0\nADD 5\nST VW2"), "LD SM0.0; MOVW VW0, VW2; +I 5, VW2");
        assert_eq!(code("LD VD0\nST VD2"), "LD SM0.0; MOVD VD0, VD2");
        assert_eq!(code("LD VW0\nGT 5\nST Q0.0"), "LDW> VW0, 5");
        assert_eq!(code("LD VW0\n> 5"), "LDW> VW0, 5");
        assert_eq!(code("LD I0.0\nST Q0.0"), "");
        let found = find("L 5\nT VW0", Flow::Contact).map(|found| found.code);
        assert_eq!(found, Some(vec!["MOVW 5, VW0".to_owned()]));
    }

    #[test]
    fn what_is_more_than_that() {
        for text in [
            "L VW0",
            "L VW0\nL VW2",
            "L VW0\nL VW2\n+I\n= Q0.0",
            "L VW0\nL VW2\n+I\nL 5\n>I",
            "L VW0\nT VB2",
            "L VW0\nL VW2\n+D\nT VD4",
            "L VW0\nL VB2\n>I",
            "L S5T#2S\nT VW0",
            "L VW0\nTAK\nT VW2",
            "L I0.0\nT M0.0",
            "T VW0",
        ] {
            assert_eq!(code(text), "", "{text}");
        }
    }

    #[test]
    fn the_lines_of_it() {
        let text = "L VW0\nL VW2 // more\n>I // greater\n= Q0.0";
        assert_eq!(
            find(text, Flow::None).map(|way| &text[..way.len]),
            Some("L VW0\nL VW2 // more\n>I")
        );
        let text = "L 5\nT VW0\n\nLD I0.0";
        assert_eq!(find(text, Flow::None).map(|way| &text[..way.len]), Some("L 5\nT VW0"));
    }
}
