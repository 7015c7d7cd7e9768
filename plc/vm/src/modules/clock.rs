//! The software clock: TODR, TODW, and what sets it from outside. No instruction reads it
//! otherwise.

/// Seconds in a day.
const DAY_S: u32 = 86_400;
/// Days before each month of a year that is no leap year.
const DAYS_BEFORE: [u16; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];
/// 2000-01-01 was a Saturday; Sunday is day 1 of the week.
const FIRST_WEEKDAY: u32 = 6;
/// Bytes of the buffer of TODR and TODW.
pub(crate) const BUFFER_LEN: u16 = 8;

/// Date and time of day, 2000 to 2099.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TimeOfDay {
    /// Since 2000-01-01 00:00:00.
    seconds: u32,
}

impl TimeOfDay {
    /// From year in the century, month, day, and hour, minute, second. `None` if there is no such
    /// date or time.
    pub fn new([year, month, day]: [u8; 3], [hour, minute, second]: [u8; 3]) -> Option<TimeOfDay> {
        let is_date =
            year <= 99 && (1..=12).contains(&month) && (1..=days_in(year, month)).contains(&day);
        if !is_date || hour > 23 || minute > 59 || second > 59 {
            return None;
        }
        let days = days_before_year(year) + days_before_month(year, month) + u32::from(day) - 1;
        let seconds = (u32::from(hour) * 60 + u32::from(minute)) * 60 + u32::from(second);
        Some(TimeOfDay { seconds: days * DAY_S + seconds })
    }

    /// From the buffer of TODW: year, month, day, hour, minute, second, 0, day of the week in BCD.
    /// The day of the week may be any from 0 to 7: the date tells it.
    pub(crate) fn from_buffer(buffer: [u8; 8]) -> Option<TimeOfDay> {
        let mut numbers = [0; 8];
        for (number, byte) in numbers.iter_mut().zip(buffer) {
            let (tens, ones) = (byte >> 4, byte & 0x0F);
            if tens > 9 || ones > 9 {
                return None;
            }
            *number = 10 * tens + ones;
        }
        let [year, month, day, hour, minute, second, _, weekday] = numbers;
        if weekday > 7 {
            return None;
        }
        TimeOfDay::new([year, month, day], [hour, minute, second])
    }

    /// For the buffer of TODR.
    pub fn to_buffer(self) -> [u8; 8] {
        let (mut days, rest) = (self.seconds / DAY_S, self.seconds % DAY_S);
        let weekday = (days + FIRST_WEEKDAY) % 7 + 1;
        let year = (0..=99).rev().find(|&year| days_before_year(year) <= days).unwrap_or(0);
        days -= days_before_year(year);
        let month =
            (1..=12).rev().find(|&month| days_before_month(year, month) <= days).unwrap_or(1);
        days -= days_before_month(year, month);
        let bcd = |number: u32| (number / 10 % 10 * 16 + number % 10) as u8;
        let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
        [
            bcd(year.into()),
            bcd(month.into()),
            bcd(days + 1),
            bcd(hour),
            bcd(minute),
            bcd(second),
            0,
            weekday as u8,
        ]
    }
}

fn is_leap(year: u8) -> bool {
    year.is_multiple_of(4)
}

fn days_before_year(year: u8) -> u32 {
    365 * u32::from(year) + u32::from(year).div_ceil(4)
}

fn days_before_month(year: u8, month: u8) -> u32 {
    let days = DAYS_BEFORE.get(usize::from(month) - 1).copied().unwrap_or(0);
    u32::from(days) + u32::from(month > 2 && is_leap(year))
}

fn days_in(year: u8, month: u8) -> u8 {
    match month {
        2 if is_leap(year) => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// The clock: is at nothing until it is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct SoftwareClock {
    /// The time, and the millisecond at which it was so.
    set: Option<(TimeOfDay, u32)>,
}

impl SoftwareClock {
    /// Not set.
    pub const NOT_SET: SoftwareClock = SoftwareClock { set: None };

    /// Somebody sets it.
    pub fn set(&mut self, time: TimeOfDay, now_ms: u32) {
        self.set = Some((time, now_ms));
    }

    /// The time, once it is set. To be asked more often than the milliseconds wrap.
    pub fn now(&mut self, now_ms: u32) -> Option<TimeOfDay> {
        let (time, since_ms) = self.set.as_mut()?;
        let seconds = now_ms.wrapping_sub(*since_ms) / 1000;
        // Beyond 2099 it begins again.
        time.seconds = (time.seconds + seconds) % (days_before_year(100) * DAY_S);
        *since_ms = since_ms.wrapping_add(1000 * seconds);
        Some(*time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_day_of_the_century_comes_back() {
        let mut day_of_week = FIRST_WEEKDAY as u8 + 1;
        let mut days = 0;
        for year in 0..=99 {
            for month in 1..=12 {
                for day in 1..=days_in(year, month) {
                    let time = TimeOfDay::new([year, month, day], [23, 59, 58]).unwrap();
                    assert_eq!(time.seconds, days * DAY_S + DAY_S - 2);
                    let buffer = time.to_buffer();
                    let bcd = |number: u8| number / 10 * 16 + number % 10;
                    assert_eq!(
                        buffer,
                        [bcd(year), bcd(month), bcd(day), 0x23, 0x59, 0x58, 0, day_of_week]
                    );
                    assert_eq!(TimeOfDay::from_buffer(buffer), Some(time));
                    (days, day_of_week) = (days + 1, day_of_week % 7 + 1);
                }
            }
        }
        assert_eq!(days, 36_525);
    }

    #[test]
    fn what_is_no_date_is_refused() {
        assert!(TimeOfDay::new([24, 2, 29], [0, 0, 0]).is_some());
        for date in [[23, 2, 29], [23, 4, 31], [23, 0, 1], [23, 13, 1], [23, 1, 0], [100, 1, 1]] {
            assert_eq!(TimeOfDay::new(date, [0, 0, 0]), None, "{date:?}");
        }
        for time in [[24, 0, 0], [0, 60, 0], [0, 0, 60]] {
            assert_eq!(TimeOfDay::new([23, 1, 1], time), None, "{time:?}");
        }
        assert!(TimeOfDay::from_buffer([0x26, 0x11, 0x21, 0x15, 0, 0, 0, 7]).is_some());
        for wrong in [[0x2A, 0x11, 0x21, 0, 0, 0, 0, 1], [0x26, 0x11, 0x21, 0, 0, 0, 0, 8]] {
            assert_eq!(TimeOfDay::from_buffer(wrong), None, "{wrong:?}");
        }
    }

    #[test]
    fn it_goes_over_the_wrap_of_the_milliseconds() {
        let mut clock = SoftwareClock::NOT_SET;
        assert_eq!(clock.now(0), None);
        clock.set(TimeOfDay::new([26, 12, 31], [23, 59, 59]).unwrap(), u32::MAX - 499);
        assert_eq!(clock.now(499).unwrap().to_buffer(), [0x26, 0x12, 0x31, 0x23, 0x59, 0x59, 0, 5]);
        assert_eq!(clock.now(500).unwrap().to_buffer(), [0x27, 0x01, 0x01, 0, 0, 0, 0, 6]);
        assert_eq!(clock.now(61_499).unwrap().to_buffer()[3..6], [0, 1, 0]);
    }
}
