//! Durations as they are written after `T#`, in milliseconds.

/// `1d2h3m4s5ms`, units falling, the last with a fraction; milliseconds. What is less than a
/// millisecond is rounded to the nearest, halves up.
pub(crate) fn duration(text: &str) -> Option<i64> {
    const UNITS: [(&str, i64); 5] =
        [("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1_000), ("ms", 1)];
    let (is_negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let lower = text.to_ascii_lowercase();
    let mut rest = lower.as_str();
    let (mut total, mut next_unit) = (0i64, 0);
    while !rest.is_empty() {
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let (digits, behind) = rest.split_at_checked(end)?;
        let letters = behind.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(behind.len());
        let (unit, after) = behind.split_at_checked(letters)?;
        let place = UNITS.iter().position(|(name, _)| *name == unit)?;
        if place < next_unit {
            return None;
        }
        next_unit = place + 1;
        total = total.checked_add(part(digits, UNITS.get(place)?.1, after.is_empty())?)?;
        rest = after.strip_prefix('_').unwrap_or(after);
    }
    let is_there = next_unit > 0;
    i32::try_from(if is_negative { -total } else { total }).ok().map(i64::from).filter(|_| is_there)
}

/// So many of a unit.
fn part(digits: &str, factor: i64, is_last: bool) -> Option<i64> {
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if !is_last && digits.contains('.') || fraction.len() > 9 {
        return None;
    }
    let whole = whole.parse::<i64>().ok()?.checked_mul(factor)?;
    if fraction.is_empty() {
        return (!digits.ends_with('.')).then_some(whole);
    }
    let scale = 10i64.pow(fraction.len() as u32);
    let parts = fraction.parse::<i64>().ok()?.checked_mul(factor)?;
    whole.checked_add((parts + scale / 2) / scale)
}
