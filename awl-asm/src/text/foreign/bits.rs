//! Lines of STEP 7 that work on one bit together: an exclusive or of contacts (`X I0.0`,
//! `X I0.1`), the preset of a counter before it is set (`L C#10`, `S C1`).

use super::together::{Flow, Lines, Together, address};
use crate::text::address::Address;

/// The lines where the text begins, if they are one of these.
pub(super) fn find(text: &str, flow: Flow) -> Option<Together> {
    exclusive_or(text, flow).or_else(|| counter(text))
}

/// Two contacts of which one is 1. More of them, or another contact before them, is more than that.
fn exclusive_or(text: &str, flow: Flow) -> Option<Together> {
    let mut lines = Lines::of(text);
    let mut contact = || {
        let (word, operand) = lines.next()?;
        let is_inverted = match word.to_ascii_uppercase().as_str() {
            "X" | "XO" => false,
            "XN" | "XON" => true,
            _ => return None,
        };
        let bit = match address(operand) {
            Some(address) => address.to_string(),
            None => operand.to_owned(),
        };
        let is_one = !bit.is_empty() && !bit.contains([' ', ',']);
        is_one.then_some((is_inverted, bit))
    };
    let (one, other) = (contact()?, contact()?);
    let len = lines.end;
    let is_third = lines.next().is_some_and(|(word, _)| word.to_ascii_uppercase().starts_with('X'));
    if flow == Flow::Contact || is_third {
        return None;
    }
    let ((one_inverted, one), (other_inverted, other)) = (one, other);
    let [first, second] = if one_inverted == other_inverted { ["AN", "A"] } else { ["A", "AN"] };
    let code = [
        format!("LD {one}"),
        format!("{first} {other}"),
        format!("LDN {one}"),
        format!("{second} {other}"),
        "OLD".to_owned(),
    ];
    Some(Together {
        message: "AWL has no exclusive or of bits",
        code: code.to_vec(),
        help: Vec::new(),
        len,
        stand_in: Some("LD"),
    })
}

/// The load of a counter's value and what sets the counter to it.
fn counter(text: &str) -> Option<Together> {
    let mut lines = Lines::of(text);
    let (load, value) = lines.next()?;
    let digits = value.get(..2).filter(|sign| sign.eq_ignore_ascii_case("C#"))?;
    let preset: u16 = value.get(digits.len()..)?.parse().ok()?;
    let (set, counter) = lines.next()?;
    let Some(counter @ Address::Counter(_)) = address(counter) else { return None };
    let is_set = load.eq_ignore_ascii_case("L") && set.eq_ignore_ascii_case("S");
    is_set.then(|| Together {
        message: "on an S7-200 a counter names its preset itself",
        code: Vec::new(),
        help: vec![format!(
            "`LD I0.0` counts, `LD I0.1` resets, `CTU {counter}, {preset}`: its bit is 1 from \
             {preset} on; `CTD` counts from {preset} down to 0, and its second load sets it"
        )],
        len: lines.end,
        stand_in: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> String {
        find(text, Flow::None).map_or_else(String::new, |found| found.code.join("; "))
    }

    #[test]
    fn exclusive_or_of_two_contacts() {
        assert_eq!(code("X I0.0\nX I0.1\n= Q0.0"), "LD I0.0; AN I0.1; LDN I0.0; A I0.1; OLD");
        assert_eq!(code("X I0.0\nXN I0.1"), "LD I0.0; A I0.1; LDN I0.0; AN I0.1; OLD");
        assert_eq!(code("X I 0.0\nX Door"), "LD I0.0; AN Door; LDN I0.0; A Door; OLD");
        assert_eq!(code("X I0.0\nX I0.1\nX I0.2"), "");
        assert_eq!(code("X I0.0\n= Q0.0"), "");
        assert_eq!(find("X I0.0\nX I0.1", Flow::Contact), None);
    }

    #[test]
    fn counters_that_are_set() {
        let help = |text| find(text, Flow::None).map(|found| found.help.join("; "));
        assert!(help("L C#10\nS C 1").is_some_and(|help| help.contains("`CTU C1, 10`")));
        assert_eq!(help("L C#10\nS M0.0"), None);
    }
}
