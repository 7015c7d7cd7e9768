//! A timer of STEP 7, whose time is loaded before it (`L S5T#2S`, `SD T1`), as the timer of an
//! S7-200, which names it.

use plc_isa::Op;

use super::together::{Lines, Together, address};
use super::{counts, operands};
use crate::text::address::Address;

/// How a timer is started there, and here.
const STARTS: [(&str, Op); 5] =
    [("SD", Op::Ton), ("SE", Op::Ton), ("SS", Op::Tonr), ("SF", Op::Tof), ("SA", Op::Tof)];

const MESSAGE: &str = "on an S7-200 a timer names its time itself";

/// A pulse, which an S7-200 makes of an on-delay.
fn pulse(number: u8, ms: f64, len: usize) -> Option<Together> {
    let (here, counts) = counts::of(Op::Ton, Some(number), ms)?;
    let help = format!(
        "an S7-200 has no pulse: `TON T{here}, {counts}` after the contact, and where the bit of \
         the timer was read the contact and `AN T{here}`, such as `LD I0.0`, `AN T{here}`"
    );
    Some(Together {
        message: MESSAGE,
        code: Vec::new(),
        help: vec![help],
        len,
        stand_in: Some("TON"),
    })
}

/// The load of a time and the start after it.
pub(super) fn find(text: &str) -> Option<Together> {
    let mut lines = Lines::of(text);
    let (load, time) = lines.next()?;
    let ms = operands::milliseconds(time).filter(|_| load.eq_ignore_ascii_case("L"))?;
    let (start, timer) = lines.next()?;
    let Some(timer @ Address::Timer(number)) = address(timer) else { return None };
    if ["SP", "SI", "SV"].iter().any(|word| word.eq_ignore_ascii_case(start)) {
        return pulse(number, ms, lines.end);
    }
    let (_, op) = STARTS.into_iter().find(|(word, _)| word.eq_ignore_ascii_case(start))?;
    let (here, counts) = counts::of(op, Some(number), ms)?;
    let mnemonic = op.instruction().mnemonic();
    let renamed = (here != number).then(|| {
        format!(
            "timers of this kind and base have other numbers: T{here} takes the place of {timer}"
        )
    });
    let is_extended_pulse = start.eq_ignore_ascii_case("SE");
    let pulse = is_extended_pulse.then(|| {
        "that is `SE` of German STEP 7; the extended pulse of international STEP 7 is made of \
         `EU`, `S`, `TON` and `R`"
            .to_owned()
    });
    Some(Together {
        message: MESSAGE,
        code: vec![format!("{mnemonic} T{here}, {counts}")],
        help: renamed.into_iter().chain(pulse).collect(),
        len: lines.end,
        stand_in: Some(mnemonic),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_that_are_loaded_first() {
        let code = |text| find(text).map_or_else(String::new, |found| found.code.join("; "));
        assert_eq!(code("L S5T#5S\nSD T1"), "TON T37, 50");
        assert_eq!(code("L S5T#5S\nSD T37"), "TON T37, 50");
        assert_eq!(code("L S5T#50MS\nSD T37"), "TON T33, 5");
        assert_eq!(code("L T#2s\nSS T1"), "TONR T1, 200");
        assert_eq!(code("L S5T#2S\nSA T38"), "TOF T38, 20");
        assert_eq!(code("L S5T#2S\nSD T 38"), "TON T38, 20");
        assert_eq!(code("L S5T#2S\nSP T1"), "");
        let help = find("L S5T#5S\nSI T 5").map(|found| found.help.join("; "));
        assert!(help.is_some_and(|help| help.contains("`TON T37, 50`")));
        assert_eq!(code("L VW0\nSD T1"), "");
    }
}
