//! Bits that other systems have of themselves (always 1, first scan, clocks), as the special bits
//! of an S7-200.

/// Names of one bit, and the special bit that is the same.
const BITS: [(&[&str], &str); 5] = [
    (&["AlwaysTRUE", "Always_TRUE", "Always_On", "AlwaysOn", "P_On", "M8000"], "SM0.0"),
    (
        &[
            "FirstScan",
            "First_Scan",
            "First_Scan_On",
            "FirstCycle",
            "First_Cycle",
            "InitialCall",
            "P_First_Cycle",
            "S:FS",
            "M8002",
        ],
        "SM0.1",
    ),
    (&["Clock_60s", "Clock_1min", "P_1min", "M8014"], "SM0.4"),
    (&["Clock_1s", "Clock_1Hz", "P_1s", "M8013"], "SM0.5"),
    (&["Clock_Scan"], "SM0.6"),
];

/// Names of a bit that is always 0.
const NEVER: [&str; 5] = ["AlwaysFALSE", "Always_FALSE", "Always_Off", "AlwaysOff", "P_Off"];

/// The special bit that is the same.
pub(super) fn same(name: &str) -> Option<&'static str> {
    BITS.into_iter().find(|(names, _)| is_among(names, name)).map(|(_, bit)| bit)
}

/// How a bit is had that an S7-200 has not.
pub(super) fn way(name: &str) -> Option<&'static str> {
    if is_among(&NEVER, name) {
        return Some("`LDN SM0.0` is always 0");
    }
    let is_clock = name.get(..6).is_some_and(|word| word.eq_ignore_ascii_case("Clock_"));
    is_clock.then_some(
        "the clocks of an S7-200 are SM0.5 (1 s) and SM0.4 (60 s); another is a timer that \
         restarts itself: `LDN T37`, `TON T37, 2`, whose bit is 1 for one scan every 200 ms",
    )
}

fn is_among(names: &[&str], name: &str) -> bool {
    names.iter().any(|known| known.eq_ignore_ascii_case(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_by_their_names() {
        assert_eq!(same("firstscan"), Some("SM0.1"));
        assert_eq!(same("Always_On"), Some("SM0.0"));
        assert_eq!(same("Clock_1Hz"), Some("SM0.5"));
        assert_eq!(same("Clock_10Hz"), None);
        assert!(way("Clock_10Hz").is_some_and(|way| way.contains("TON")));
        assert!(way("AlwaysFALSE").is_some_and(|way| way.contains("LDN SM0.0")));
        assert_eq!(way("Clocks"), None);
    }
}
