//! Lines after a call that hand over its parameters by their names, as STEP 7 has them:
//! `CALL FC1`, `Start := I0.0`, `Motor := Q0.0`.

use super::together::Lines;

/// The values of the lines where the text begins, and how long the lines are.
pub(crate) fn parameters(text: &str) -> Option<(Vec<String>, usize)> {
    let mut lines = Lines::of(text);
    let mut values = Vec::new();
    let mut end = 0;
    while let Some((word, rest)) = lines.next() {
        let line = format!("{word} {rest}");
        let Some((name, value)) = line.split_once(":=").or_else(|| line.split_once("=>")) else {
            break;
        };
        let name = name.trim();
        let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if !is_name {
            break;
        }
        values.push(value.trim().trim_end_matches([',', ';', ')']).trim().to_owned());
        end = lines.end;
    }
    (!values.is_empty()).then_some((values, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_their_order() {
        let text = "Start := I0.0,\n Motor:=Q0.0\nDone=>M0.0\nLD I0.1";
        let (values, len) = parameters(text).expect("parameters");
        assert_eq!(values, ["I0.0", "Q0.0", "M0.0"]);
        assert_eq!(&text[len..], "\nLD I0.1");
        assert_eq!(parameters("LD I0.1\nA := 5"), None);
        assert_eq!(parameters("VW0 + 1 := 5"), None);
    }
}
