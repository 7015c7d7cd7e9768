//! Times as presets of timers: a number of counts that is exact, of the timer at hand or of one
//! that can count so finely.

use plc_isa::{Op, TimerKind, timer_resolution};

/// Timers with each base, the coarse ones first.
const ON_AND_OFF: [u8; 3] = [37, 33, 32];
const RETENTIVE: [u8; 3] = [5, 1, 0];

/// A timer and its preset for a time in milliseconds: the timer that is wanted if it can have the
/// time exactly, otherwise the coarsest that can.
pub(super) fn of(op: Op, wanted: Option<u8>, ms: f64) -> Option<(u8, u16)> {
    let kind = TimerKind::started_by(op)?;
    let others = if kind == TimerKind::RetentiveOnDelay { RETENTIVE } else { ON_AND_OFF };
    let candidates = wanted.filter(|number| kind.fits(*number)).into_iter().chain(others);
    candidates.into_iter().find_map(|number| Some((number, exact(number, ms)?)))
}

/// The preset of this timer, if it can have the time exactly.
pub(super) fn exact(number: u8, ms: f64) -> Option<u16> {
    let counts = ms / f64::from(timer_resolution(number).ms());
    let is_possible = (1.0..=f64::from(i16::MAX)).contains(&counts) && counts.fract() == 0.0;
    is_possible.then_some(counts as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_timer_at_hand_or_one_that_can() {
        assert_eq!(of(Op::Ton, Some(38), 2000.0), Some((38, 20)));
        assert_eq!(of(Op::Ton, Some(37), 50.0), Some((33, 5)));
        assert_eq!(of(Op::Ton, Some(37), 7.0), Some((32, 7)));
        assert_eq!(of(Op::Ton, Some(1), 2000.0), Some((37, 20)));
        assert_eq!(of(Op::Tonr, Some(1), 2000.0), Some((1, 200)));
        assert_eq!(of(Op::Tonr, None, 2000.0), Some((5, 20)));
        assert_eq!(of(Op::Tof, None, 0.5), None);
        assert_eq!(of(Op::Tof, None, 4e9), None);
        assert_eq!(of(Op::Ld, None, 100.0), None);
    }
}
