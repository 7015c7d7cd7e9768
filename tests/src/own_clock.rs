//! A virtual board that has its own clock, and cases on it: for what happens between two scans.

use awl_sim::machine::uno::{Clock, Code, Uno};

use crate::bench_board::firmware;
use crate::case::{Case, Prepared, host};

/// A board with its own clock.
///
/// # Panics
/// If there is no firmware.
pub fn free_running(code: Code) -> Uno {
    Uno::new(&firmware(), code, Clock::FreeRunning, Box::new(|_| String::new()))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Runs cases on the host and on a board with its own clock, interpreted and as machine code.
///
/// # Panics
/// If one does not hold, or if there are fewer than so many.
pub fn assert_cases_hold(cases: impl Iterator<Item = Case>, at_least: usize) {
    let cases: Vec<Prepared> =
        cases.map(|case| case.prepare().unwrap_or_else(|errors| panic!("{errors}"))).collect();
    assert!(cases.len() >= at_least, "{}", cases.len());
    let mut failures = Vec::new();
    for code in [Code::Bytecode, Code::Native] {
        let mut uno = free_running(code);
        for case in &cases {
            failures.extend(case.failures(&mut host(&case.image)));
            uno.load(case.image.clone()).unwrap_or_else(|error| panic!("{error}"));
            failures.extend(
                case.failures(&mut uno).into_iter().map(|failure| format!("{code:?}: {failure}")),
            );
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
