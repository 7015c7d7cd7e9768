//! Results in the Test Anything Protocol, version 14.

use super::result::TestResult;

/// The whole document.
pub fn text(results: &[TestResult]) -> String {
    let points: String = (1..).zip(results).map(|(number, result)| point(number, result)).collect();
    format!("TAP version 14\n1..{}\n{points}", results.len())
}

fn point(number: usize, result: &TestResult) -> String {
    // These begin a directive and an escape there.
    let name = result.scenario.replace('\\', r"\\").replace('#', r"\#");
    if result.status == 0 {
        return format!("ok {number} - {name}\n");
    }
    let mut text =
        format!("not ok {number} - {name}\n  ---\n  result: {}\n  message: |\n", result.word());
    for line in result.plain_failures().join("\n").lines() {
        text += format!("    {line}").trim_end();
        text.push('\n');
    }
    text + "  ...\n"
}
