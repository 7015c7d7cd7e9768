//! Operands of Rockwell's controllers, which are elements of numbered data files: `I:0/3`,
//! `T4:0/DN`, `N7:1`, `B3:0/5`.

/// The operand of an S7-200 that is the same: points of the first module.
pub(super) fn same(upper: &str) -> Option<String> {
    let (module, bit) = upper.split_once('/')?;
    let (letter, word) = module.split_once(':')?;
    let area = [("I", "I"), ("O", "Q")].iter().find(|(theirs, _)| *theirs == letter)?.1;
    let bit = bit.parse::<u8>().ok().filter(|bit| *bit < 16)?;
    let is_first = word.split('.').all(|number| number.parse::<u8>().is_ok());
    is_first.then(|| format!("{area}{}.{}", bit / 8, bit % 8))
}

/// What is there for an element of another file.
pub(super) fn way(upper: &str) -> Option<&'static str> {
    let (file, element) = upper.split_once(':')?;
    let (letter, number) = file.split_at_checked(1)?;
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(number) || !element.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    Some(match letter {
        "T" if element.ends_with("ACC") => {
            "on an S7-200 the value of a timer is the timer itself, where a word is: `MOVW T37, VW0`"
        }
        "T" if element.ends_with("PRE") => {
            "on an S7-200 the preset is where the timer is started: `TON T37, 50`, or a word such \
             as `TON T37, VW0`"
        }
        "T" => "on an S7-200 the done bit of a timer is the timer itself: `LD T37`",
        "C" if element.ends_with("ACC") => {
            "on an S7-200 the value of a counter is the counter itself, where a word is: \
             `MOVW C1, VW0`"
        }
        "C" if element.ends_with("PRE") => {
            "on an S7-200 the preset is where the counter counts: `CTU C1, 10`"
        }
        "C" => "on an S7-200 the done bit of a counter is the counter itself: `LD C1`",
        "N" => "on an S7-200 whole numbers are words of V memory: `VW0`, `VW2`, `VW4` and so on",
        "F" => "on an S7-200 real numbers are double words of V memory: `VD0`, `VD4` and so on",
        "B" => "on an S7-200 bits are in M or V memory: `M0.0` to `M31.7`, `V0.0` and so on",
        "I" | "O" => "on an S7-200 inputs are `I0.0`, `I0.1`, ..., outputs `Q0.0`, `Q0.1`, ...",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_of_files() {
        assert_eq!(same("O:0/3").as_deref(), Some("Q0.3"));
        assert_eq!(same("I:0.0/9").as_deref(), Some("I1.1"));
        assert_eq!(same("T4:0/DN"), None);
        assert!(way("T4:0/DN").is_some_and(|way| way.contains("`LD T37`")));
        assert!(way("T4:0.ACC").is_some_and(|way| way.contains("`MOVW T37, VW0`")));
        assert!(way("N7:0").is_some_and(|way| way.contains("`VW0`")));
        assert_eq!(way("MAIN:OB1"), None);
        assert_eq!(way("X:0"), None);
    }
}
