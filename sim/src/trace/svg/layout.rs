//! Where everything of the diagram is, in pixels. Draws nothing.

use super::text;
use crate::operand::Width;
use crate::trace::Trace;

/// Free space at the sides.
pub(super) const MARGIN: f64 = 18.0;
pub(super) const NAME_SIZE: f64 = 13.0;
pub(super) const DESCRIPTION_SIZE: f64 = 11.0;
pub(super) const VALUE_SIZE: f64 = 11.0;

/// Width of the part with the waves.
const PLOT_WIDTH: f64 = 1000.0;
const NAMES_WIDTH: std::ops::RangeInclusive<f64> = 60.0..=280.0;
/// Place for the limits of a word's scale, left of the waves.
const SCALE_WIDTH: f64 = 50.0;
const HEAD_HEIGHT: f64 = 70.0;
const FOOT_HEIGHT: f64 = 34.0;
const BIT_HEIGHT: f64 = 38.0;
const WORD_HEIGHT: f64 = 78.0;

/// A signal's place.
pub(super) struct Row {
    pub(super) top: f64,
    pub(super) height: f64,
}

/// The places of everything.
pub(super) struct Layout {
    pub(super) width: f64,
    pub(super) height: f64,
    /// Edges of the part with the waves.
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    pub(super) names_width: f64,
    pub(super) rows: Vec<Row>,
    /// Length of the trace in milliseconds, at least 1.
    pub(super) total_ms: u64,
    scan_ms: u64,
}

impl Layout {
    pub(super) fn new(trace: &Trace) -> Layout {
        let signals = trace.signals();
        let widest = signals
            .iter()
            .flat_map(|signal| {
                [
                    text::width(&signal.name, NAME_SIZE),
                    text::width(&signal.description, DESCRIPTION_SIZE),
                ]
            })
            .fold(0.0, f64::max);
        let names_width = widest.clamp(*NAMES_WIDTH.start(), *NAMES_WIDTH.end()).ceil();
        let has_words = signals.iter().any(|signal| signal.operand.width() != Width::Bit);
        let left = MARGIN + names_width + if has_words { SCALE_WIDTH } else { 12.0 };
        let mut bottom = HEAD_HEIGHT;
        let mut rows = Vec::new();
        for signal in signals {
            let height =
                if signal.operand.width() == Width::Bit { BIT_HEIGHT } else { WORD_HEIGHT };
            rows.push(Row { top: bottom, height });
            bottom += height;
        }
        Layout {
            width: left + PLOT_WIDTH + MARGIN + 12.0,
            height: bottom + FOOT_HEIGHT,
            left,
            right: left + PLOT_WIDTH,
            top: HEAD_HEIGHT,
            bottom,
            names_width,
            rows,
            total_ms: (trace.scans() * trace.scan_ms()).max(1),
            scan_ms: trace.scan_ms(),
        }
    }

    /// Where a time is.
    pub(super) fn x(&self, ms: u64) -> f64 {
        self.left + PLOT_WIDTH * ms as f64 / self.total_ms as f64
    }

    /// Where the start of a scan is.
    pub(super) fn scan_x(&self, scan: u64) -> f64 {
        self.x(scan * self.scan_ms)
    }
}
