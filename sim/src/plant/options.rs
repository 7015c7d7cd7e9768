//! Options of a plant, `key=value`: typed access with limits. Where they were written is not known
//! here.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// Options as written.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Options(pub(super) Vec<(String, String)>);

/// A value that an option does not take.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OptionError {
    /// The option.
    pub key: &'static str,
    /// What is wrong, a sentence without full stop.
    pub message: String,
}

impl OptionError {
    /// An error in the value of `key`.
    pub fn new(key: &'static str, message: impl Into<String>) -> OptionError {
        OptionError { key, message: message.into() }
    }
}

impl Options {
    /// The text of an option, if it was given.
    pub fn text(&self, key: &str) -> Option<&str> {
        self.0.iter().find(|(known, _)| known == key).map(|(_, value)| &**value)
    }

    /// A whole number.
    pub fn number(
        &self,
        key: &'static str,
        range: RangeInclusive<u64>,
        default: u64,
    ) -> Result<u64, OptionError> {
        let Some(text) = self.text(key) else { return Ok(default) };
        match text.parse() {
            Ok(number) if range.contains(&number) => Ok(number),
            _ => Err(out_of_range(key, text, range.start(), range.end())),
        }
    }

    /// A number with up to three decimals, in thousandths. The range is in thousandths too.
    pub fn thousandths(
        &self,
        key: &'static str,
        range: RangeInclusive<u64>,
        default: u64,
    ) -> Result<u64, OptionError> {
        let Some(text) = self.text(key) else { return Ok(default) };
        let error = || out_of_range(key, text, range.start() / 1000, range.end() / 1000);
        let (whole, fraction) = text.split_once('.').unwrap_or((text, "0"));
        let is_digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        if !is_digits(whole) || !is_digits(fraction) || fraction.len() > 3 {
            return Err(error());
        }
        format!("{whole}{fraction:0<3}")
            .parse()
            .ok()
            .filter(|number| range.contains(number))
            .ok_or_else(error)
    }

    /// One of several words, by its place in `words`.
    pub fn word(
        &self,
        key: &'static str,
        words: &[&str],
        default: usize,
    ) -> Result<usize, OptionError> {
        let Some(text) = self.text(key) else { return Ok(default) };
        words.iter().position(|word| *word == text).ok_or_else(|| {
            OptionError::new(key, format!("{key}={text}: {key} is one of {}", words.join(", ")))
        })
    }
}

fn out_of_range(
    key: &'static str,
    text: &str,
    low: impl Display,
    high: impl Display,
) -> OptionError {
    OptionError::new(key, format!("{key}={text}: {key} takes a number from {low} to {high}"))
}
