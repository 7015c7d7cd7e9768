//! Instructions that have their result apart from their operands in other languages and in boxes,
//! as the two lines that they are here.

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
    // A number is no place for a result.
    if operands.last()?.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
        return None;
    }
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
        assert_eq!(lines("INCW", &["VW0", "5"]), "");
        assert_eq!(lines("TON", &["T37", "20", "VW0"]), "");
    }
}
