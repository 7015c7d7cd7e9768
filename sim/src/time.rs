//! Times as people write them: `500ms`, `2s`, `1.5s`, `2min`, `1h30min`. Whole milliseconds only;
//! no clock.

/// Longest time that can be written: 1000 days in milliseconds.
pub const TIME_MAX_MS: u64 = 1000 * 24 * 3600 * 1000;

/// Units from the largest to the smallest, in milliseconds.
const UNITS: [(&str, u64); 4] = [("h", 3_600_000), ("min", 60_000), ("s", 1000), ("ms", 1)];
/// Most digits of a part: all times have fewer, and nothing overflows.
const DIGITS_MAX: usize = 12;

/// Reads a time with its unit, or several from the largest unit to the smallest, and gives
/// milliseconds. The error says what is wrong.
pub fn parse_time(text: &str) -> Result<u64, String> {
    if is_number(text) {
        return Err(format!("{text}: a time needs its unit: {text}ms or {text}s"));
    }
    let (mut rest, mut units, mut sum) = (text, &UNITS[..], 0);
    while !rest.is_empty() || text.is_empty() {
        let unit_at = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let (number, behind) = rest.split_at(unit_at);
        let unit_end = behind.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(behind.len());
        let (unit, behind) = behind.split_at(unit_end);
        // A unit comes once, and after the larger ones.
        let index = units.iter().position(|(name, _)| name.eq_ignore_ascii_case(unit));
        let Some(index) = index.filter(|_| is_number(number)) else {
            return Err(format!("{text} is no time: write 500ms, 2s, 1.5s, 2min or 1h30min"));
        };
        sum += part_ms(text, number, units[index].1)?;
        (rest, units) = (behind, &units[index + 1..]);
    }
    if sum > TIME_MAX_MS { Err(too_long(text)) } else { Ok(sum) }
}

/// A number of units in milliseconds.
fn part_ms(text: &str, number: &str, unit_ms: u64) -> Result<u64, String> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let (whole, fraction) = (whole.trim_start_matches('0'), fraction.trim_end_matches('0'));
    if whole.len() > DIGITS_MAX {
        return Err(too_long(text));
    }
    let no_milliseconds = || format!("{text}: times are whole milliseconds");
    if fraction.len() > DIGITS_MAX {
        return Err(no_milliseconds());
    }
    // Both are digits or nothing.
    let [whole, parts] = [whole, fraction].map(|digits| digits.parse::<u64>().unwrap_or(0));
    let divisor = 10_u64.pow(fraction.len() as u32);
    if !(parts * unit_ms).is_multiple_of(divisor) {
        return Err(no_milliseconds());
    }
    Ok(whole * unit_ms + parts * unit_ms / divisor)
}

fn too_long(text: &str) -> String {
    format!("{text}: the longest time is 1000 days (86400000s)")
}
fn is_number(text: &str) -> bool {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    [whole, fraction]
        .iter()
        .all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()))
}

/// A time the way [`parse_time`] reads it: in seconds where that needs no fraction, else in ms;
/// from 10 s on always in seconds.
pub fn format_time(ms: u64) -> String {
    if ms == 0 {
        "0ms".to_string()
    } else if ms.is_multiple_of(1000) {
        format!("{}s", ms / 1000)
    } else if ms < 10_000 {
        format!("{ms}ms")
    } else {
        format!("{}.{}s", ms / 1000, format!("{:03}", ms % 1000).trim_end_matches('0'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_both_units_and_fractions() {
        assert_eq!(parse_time("500ms"), Ok(500));
        assert_eq!(parse_time("2s"), Ok(2000));
        assert_eq!(parse_time("1.5s"), Ok(1500));
        assert_eq!(parse_time("0.001s"), Ok(1));
        assert_eq!(parse_time("2.0ms"), Ok(2));
        assert_eq!(parse_time("86400000s"), Ok(TIME_MAX_MS));
    }

    #[test]
    fn reads_minutes_and_hours_and_several_units() {
        assert_eq!(parse_time("2min"), Ok(120_000));
        assert_eq!(parse_time("1H"), Ok(3_600_000));
        assert_eq!(parse_time("1.5min"), Ok(90_000));
        assert_eq!(parse_time("1min30s"), Ok(90_000));
        assert_eq!(parse_time("1h2MIN3.5s4ms"), Ok(3_723_504));
        assert_eq!(parse_time("24000h"), Ok(TIME_MAX_MS));
    }

    #[test]
    fn says_what_is_wrong() {
        assert!(parse_time("500").unwrap_err().contains("unit"));
        assert!(parse_time("0.5ms").unwrap_err().contains("whole milliseconds"));
        assert!(parse_time("1.2345s").unwrap_err().contains("whole milliseconds"));
        assert!(parse_time("86400001s").unwrap_err().contains("1000 days"));
        assert!(parse_time("0.00001min").unwrap_err().contains("whole milliseconds"));
        assert!(parse_time("24000h1ms").unwrap_err().contains("1000 days"));
        let texts = ["", "s", "-1s", "1.s", ".5s", "1d", "1e3s", "2 s", "999999999999999999999s"];
        // Units from large to small, each once.
        for text in texts.into_iter().chain(["30s1min", "1s1s", "1min30", "1m", "+1s", "1hs"]) {
            assert!(parse_time(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_written_can_be_read() {
        for (ms, text) in
            [(0, "0ms"), (500, "500ms"), (1500, "1500ms"), (2000, "2s"), (12_340, "12.34s")]
        {
            assert_eq!(format_time(ms), text);
            assert_eq!(parse_time(text), Ok(ms));
        }
    }
}
