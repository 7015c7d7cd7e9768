//! How slow the machine is at the moment, by work that has nothing to do with this project: a
//! machine that somebody else uses, too, must not look like a program that has become slow.

use std::hint::black_box;
use std::time::Instant;

use anyhow::Result;

/// Best time in seconds of [`work`] on the machine whose speed the budgets mean: two cores of a
/// server of 2024, nothing else running.
const USUAL_SECONDS: f64 = 0.004;

/// Rounds of measuring. Other work on the machine only makes rounds slower.
pub(crate) const ROUNDS: usize = 7;

/// Best time of several rounds, on a machine of usual speed.
pub(crate) struct Measured {
    /// Seconds, as measured.
    pub(crate) seconds: f64,
    /// How many times slower than usual the machine was in the same rounds, 1 at least: a fast
    /// machine makes no budget stricter.
    pub(crate) slowness: f64,
}

impl Measured {
    /// Seconds on a machine of usual speed.
    pub(crate) fn usual_seconds(&self) -> f64 {
        self.seconds / self.slowness
    }

    /// Both times, as a sentence's end.
    pub(crate) fn evidence(&self) -> String {
        format!(
            "in {:.4} s, best of {ROUNDS} rounds, machine slower than usual by {:.2}",
            self.seconds, self.slowness
        )
    }
}

/// Measures rounds; each begins with the work of comparison and returns its own time in seconds.
pub(crate) fn measure(mut round: impl FnMut() -> Result<f64>) -> Result<Measured> {
    let (mut seconds, mut comparison) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        let start = Instant::now();
        black_box(work());
        comparison = comparison.min(start.elapsed().as_secs_f64());
        seconds = seconds.min(round()?);
    }
    Ok(Measured { seconds, slowness: (comparison / USUAL_SECONDS).max(1.0) })
}

/// Sorting, text and numbers: branches that cannot be foreseen, memory, arithmetic.
fn work() -> u64 {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut numbers: Vec<u64> = (0..50_000)
        .map(|_| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        })
        .collect();
    numbers.sort_unstable();
    let text: String = numbers.iter().map(|number| format!("{number:x} ")).collect();
    text.split(' ').filter_map(|word| u64::from_str_radix(word, 16).ok()).fold(0, u64::wrapping_add)
}
