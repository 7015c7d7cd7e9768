//! What a plant tells: a timeline and named counts. It judges nothing.

use std::borrow::Cow;

/// Most events that a timeline keeps; later ones are only counted.
pub const EVENTS_MAX: usize = 10_000;

/// Something that happened in a plant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Event {
    /// When, in milliseconds.
    pub time_ms: u64,
    /// What.
    pub text: String,
}

/// Timeline and summary of a plant.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Report {
    /// What happened, in order of time.
    pub events: Vec<Event>,
    /// Events beyond [`EVENTS_MAX`].
    pub events_left_out: u64,
    /// Named counts, in the order they are shown.
    pub summary: Vec<(Cow<'static, str>, i64)>,
}

impl Report {
    /// Adds to the timeline.
    pub fn event(&mut self, time_ms: u64, text: impl Into<String>) {
        if self.events.len() < EVENTS_MAX {
            self.events.push(Event { time_ms, text: text.into() });
        } else {
            self.events_left_out += 1;
        }
    }

    /// The same with these counts.
    pub(super) fn with_summary(&self, summary: Vec<(&'static str, i64)>) -> Report {
        let summary = summary.into_iter().map(|(name, count)| (name.into(), count)).collect();
        Report { summary, ..self.clone() }
    }

    /// A count of the summary.
    pub fn count(&self, name: &str) -> Option<i64> {
        self.summary.iter().find(|(known, _)| known == name).map(|&(_, count)| count)
    }
}
