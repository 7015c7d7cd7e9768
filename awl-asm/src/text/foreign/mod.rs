//! What people write who know another controller or language, and what an S7-200 has for it. The
//! words that begin a line and whole lines; what is wrong with an instruction of the S7-200 is said
//! where it is read.

mod accumulators;
mod boxes;
mod conditional;
mod controllers;
mod counts;
mod expression;
mod lines;
pub(crate) mod operands;
mod preset_first;
mod row;
mod step7;
mod structured;
pub(crate) mod together;
pub(crate) mod width;
mod words;

pub(crate) use accumulators::comparison;
pub(crate) use lines::is_structured;
pub(crate) use row::{Instead, Meant};
pub(crate) use words::{is_german, is_known};

/// What a line was meant to be that begins with no instruction of the S7-200. `rest` is what is
/// after the word.
pub(crate) fn meant(word: &str, rest: &str) -> Option<Meant> {
    // `RND+` is cut where the sign is.
    let signed = rest.get(..1).filter(|sign| matches!(*sign, "+" | "-"));
    let signed = signed.and_then(|sign| words::find(&format!("{word}{sign}")));
    signed
        .map(|row| row.meant(rest))
        .or_else(|| lines::meant(word, rest))
        .or_else(|| words::find(word).map(|row| row.meant(rest)))
}

/// The mnemonic of the size of the operands, for one that is there in several sizes: `MOVB` as
/// `MOVW` if the operands are words.
pub(crate) fn sized(mnemonic: &str, rest: &str) -> Option<&'static str> {
    width::of(rest)?.sibling(mnemonic)
}

/// The lines for an instruction that has its result apart from its operands in other languages, as
/// in `+I VW0, VW2, VW4`; `None` where it has as many operands as here.
pub(crate) fn apart(mnemonic: &str, operands: &[String]) -> Option<Vec<String>> {
    let last = mnemonic.chars().last()?;
    let letter = match last {
        'B' | 'W' | 'D' | 'R' => last,
        'I' => 'W',
        _ => return None,
    };
    let copy = |from: &String, to: &String| {
        (!from.eq_ignore_ascii_case(to)).then(|| format!("MOV{letter} {from}, {to}"))
    };
    let is_one_of = |starts: &[&str]| starts.iter().any(|start| mnemonic.starts_with(start));
    match operands {
        [one, count, to] if is_one_of(&["SL", "SR", "RL", "RR"]) => {
            Some(copy(one, to).into_iter().chain([format!("{mnemonic} {to}, {count}")]).collect())
        }
        [one, other, to] if is_one_of(&["+", "-", "*", "/", "AND", "OR", "XOR"]) => {
            let is_target = |text: &String| text.eq_ignore_ascii_case(to);
            let swaps = !is_one_of(&["-", "/"]);
            match (is_target(one), is_target(other)) {
                (true, _) => Some(vec![format!("{mnemonic} {other}, {to}")]),
                (false, true) if swaps => Some(vec![format!("{mnemonic} {one}, {to}")]),
                (false, true) => None,
                (false, false) => Some(
                    copy(one, to)
                        .into_iter()
                        .chain([format!("{mnemonic} {other}, {to}")])
                        .collect(),
                ),
            }
        }
        [one, to] if is_one_of(&["INC", "DEC", "INV"]) => {
            Some(copy(one, to).into_iter().chain([format!("{mnemonic} {to}")]).collect())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operands_tell_the_size() {
        let suggested = |word, rest| meant(word, rest).and_then(|meant| meant.instead);
        let is = |mnemonic: &str| Some(Instead::Word(mnemonic.to_owned()));
        assert_eq!(suggested("XOR", " VW0, VW2"), is("XORW"));
        assert_eq!(suggested("xor", " VB0, VB1"), is("XORB"));
        assert_eq!(suggested("AND", " I0.0"), is("A"));
        assert_eq!(suggested("UND", " MD0, MD4"), is("ANDD"));
        assert_eq!(suggested("ADD", " 1, VD0"), is("+D"));
        assert_eq!(suggested("ADD", " VB0, VB1"), None);
        assert_eq!(suggested("MOV", " 5, Level"), is("MOVW"));
        assert_eq!(suggested("CMP", " VW0, VW2"), None);
        assert_eq!(sized("MOVB", " VW0, VW2"), Some("MOVW"));
        assert_eq!(sized("SRB", " VD0, 1"), Some("SRD"));
        assert_eq!(sized("TON", " VD0, 1"), None);
    }

    #[test]
    fn results_apart_from_the_operands() {
        let lines = |mnemonic, operands: &[&str]| {
            let operands: Vec<String> = operands.iter().map(|one| (*one).to_owned()).collect();
            apart(mnemonic, &operands).map_or_else(String::new, |code| code.join("; "))
        };
        assert_eq!(lines("+I", &["VW0", "VW2", "VW4"]), "MOVW VW0, VW4; +I VW2, VW4");
        assert_eq!(lines("+I", &["1", "VW0", "VW0"]), "+I 1, VW0");
        assert_eq!(lines("-I", &["VW0", "1", "VW0"]), "-I 1, VW0");
        assert_eq!(lines("-I", &["1", "VW0", "VW0"]), "");
        assert_eq!(lines("*R", &["VD0", "2.0", "VD4"]), "MOVR VD0, VD4; *R 2.0, VD4");
        assert_eq!(lines("SLW", &["VW0", "2", "VW4"]), "MOVW VW0, VW4; SLW VW4, 2");
        assert_eq!(lines("INCW", &["VW0", "VW0"]), "INCW VW0");
        assert_eq!(lines("INCW", &["VW0", "VW2"]), "MOVW VW0, VW2; INCW VW2");
        assert_eq!(lines("TON", &["T37", "20", "VW0"]), "");
    }
}
