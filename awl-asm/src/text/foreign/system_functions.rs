//! Blocks that S7-300, S7-400 and the TIA portal have of themselves, by number or by name: what an
//! S7-200 has in their place.

/// Their names, and what is there.
const BLOCKS: [(&[&str], &str); 21] = [
    (
        &["SFC20", "BLKMOV", "MOVE_BLK", "SFC81", "UBLKMOV"],
        "`BMB VB0, VB100, 10` copies ten bytes, `BMW` words, `BMD` double words",
    ),
    (&["SFC21", "FILL", "FILL_BLK"], "`FILL 0, VW0, 10` fills ten words"),
    (&["SFC0", "SET_CLK", "WR_SYS_T"], "`TODW VB0` sets the clock"),
    (&["SFC1", "READ_CLK", "RD_SYS_T"], "`TODR VB0` reads the clock"),
    (
        &["SFC28", "SFC30", "SFC32", "SFC39", "SFC41"],
        "`DISI` holds interrupts back, `DTCH 10` detaches one",
    ),
    (&["SFC40", "SFC42"], "`ENI` permits interrupts"),
    (&["SFC43", "RE_TRIGR"], "`WDR` restarts the watchdog"),
    (&["SFC46", "STP"], "`STOP` stops the program"),
    (&["SFC47"], "a program never waits: `TON T37, 20` runs while the contact before it is 1"),
    (
        &["SFC64", "TIME_TCK"],
        "`BITIM VD0` reads the milliseconds, `CITIM VD0, VD4` what has passed since",
    ),
    (
        &["SFB0", "IEC_COUNTER"],
        "`CTU C1, 10` counts up: `LD` of what counts and `LD` of what resets are before it",
    ),
    (
        &["SFB1"],
        "`CTD C1, 10` counts down: `LD` of what counts and `LD` of what loads are before it",
    ),
    (&["SFB2"], "`CTUD C1, 10` counts both ways: three loads are before it"),
    (&["SFB3"], "a pulse is made of `EU`, `S M0.0, 1`, `TON T37, 20` and `R M0.0, 1`"),
    (&["SFB4", "IEC_TIMER"], "`TON T37, 20` is the on-delay, after the contact that is its input"),
    (&["SFB5"], "`TOF T37, 20` is the off-delay, after the contact that is its input"),
    (
        &["FB41", "CONT_C", "PID_COMPACT"],
        "`PID VB100, 0` calculates one step of a controller whose table begins at VB100",
    ),
    (
        &["FC105"],
        "a value is scaled by arithmetic: `ITD AIW0, VD0`, `DTR VD0, VD0`, `/R 32000.0, VD0`, `*R 100.0, VD0`",
    ),
    (
        &["FC106"],
        "a value is scaled by arithmetic: `*R 320.0, VD0`, `ROUND VD0, VD0`, `DTI VD0, VW4`, `MOVW VW4, AQW0`",
    ),
    (
        &["SFB14", "SFB15", "SFC14", "SFC15", "SFC58", "SFC59"],
        "other stations are reached by Modbus: docs/protocol.md",
    ),
    (&["SFC17", "SFC18", "SFC51", "SFC52"], "there are no diagnostic messages"),
];

/// What an S7-200 has in the place of a block.
pub(crate) fn way(name: &str) -> Option<String> {
    let bare: String = name.chars().filter(|c| !c.is_whitespace() && *c != '"').collect();
    let is = |known: &&str| known.eq_ignore_ascii_case(&bare);
    let (_, way) = BLOCKS.iter().find(|(names, _)| names.iter().any(is))?;
    Some(format!("on an S7-200 that is no block: {way}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_by_number_and_name() {
        assert!(way("SFC20").is_some_and(|way| way.contains("`BMB VB0")));
        assert!(way("sfc 1").is_some_and(|way| way.contains("TODR")));
        assert!(way("\"BLKMOV\"").is_some_and(|way| way.contains("`BMB VB0")));
        assert_eq!(way("FC1"), None);
    }
}
