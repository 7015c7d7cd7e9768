//! Times as people write them: `500ms`, `2s`, `1.5s`. Whole milliseconds only; no clock.

/// Longest time that can be written: 1000 days in milliseconds.
pub const TIME_MAX_MS: u64 = 1000 * 24 * 3600 * 1000;

/// Reads a time with its unit and gives milliseconds. The error says what is wrong.
pub fn parse_time(text: &str) -> Result<u64, String> {
    let unit_at = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(unit_at);
    let decimals = match unit.to_ascii_lowercase().as_str() {
        "ms" => 0,
        "s" => 3,
        "" if is_number(number) => return Err(format!("{text}: a time needs its unit: {text}ms or {text}s")),
        _ => return Err(format!("{text} is no time: write 500ms, 2s or 1.5s")),
    };
    if !is_number(number) {
        return Err(format!("{text} is no time: write 500ms, 2s or 1.5s"));
    }
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let significant = fraction.trim_end_matches('0');
    if significant.len() > decimals {
        return Err(format!("{text}: times are whole milliseconds"));
    }
    // Zeros up to the last decimal make it a number of milliseconds.
    let digits = format!("{whole}{significant:0<decimals$}");
    match digits.parse() {
        Ok(ms) if ms <= TIME_MAX_MS => Ok(ms),
        _ => Err(format!("{text}: the longest time is 1000 days (86400000s)")),
    }
}

fn is_number(text: &str) -> bool {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
    [whole, fraction].iter().all(|part| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit()))
}

/// A time the way [`parse_time`] reads it: in seconds where that needs no fraction, else in ms; from 10 s on always in
/// seconds.
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
    fn says_what_is_wrong() {
        assert!(parse_time("500").unwrap_err().contains("unit"));
        assert!(parse_time("0.5ms").unwrap_err().contains("whole milliseconds"));
        assert!(parse_time("1.2345s").unwrap_err().contains("whole milliseconds"));
        assert!(parse_time("86400001s").unwrap_err().contains("1000 days"));
        for text in ["", "s", "-1s", "1.s", ".5s", "1h", "1e3s", "2 s", "999999999999999999999s"] {
            assert!(parse_time(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_written_can_be_read() {
        for (ms, text) in [(0, "0ms"), (500, "500ms"), (1500, "1500ms"), (2000, "2s"), (12_340, "12.34s")] {
            assert_eq!(format_time(ms), text);
            assert_eq!(parse_time(text), Ok(ms));
        }
    }
}
