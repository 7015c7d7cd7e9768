//! Results of scenarios as people read them, and as JSON.

use serde_json::json;

use super::result::TestResult;
use super::words::plural;

const INDENT: &str = "        ";

/// A line, and below it what failed.
pub fn human(result: &TestResult) -> String {
    let what = if result.summary.is_empty() { "" } else { ": " };
    let word = if result.status == 0 { "ok" } else { result.word() };
    let mut text =
        format!("{}{word:<7} {}{what}{}\n", result.warnings, result.scenario, result.summary);
    if let (Some(goal), 1..) = (&result.goal, result.status) {
        text += &format!("{INDENT}missing: {goal}\n");
    }
    let notes = result.notes.iter().map(|note| format!("warning: {note}"));
    for line in result.failures.iter().cloned().chain(notes) {
        for line in line.lines() {
            text += format!("{INDENT}{line}").trim_end();
            text.push('\n');
        }
    }
    text
}

/// All of them in a line.
pub fn summary(results: &[TestResult]) -> String {
    let mut parts = vec![plural(results.len(), "scenario")];
    for (statuses, word) in
        [(&[0][..], "ok"), (&[1], "failed"), (&[3], "with a PLC fault"), (&[2], "with errors")]
    {
        let count = results.iter().filter(|result| statuses.contains(&result.status)).count();
        if count > 0 {
            parts.push(format!("{count} {word}"));
        }
    }
    let [all, counts @ ..] = &parts[..] else { return String::new() };
    format!("{all}: {}\n", counts.join(", "))
}

/// An object a line.
pub fn json(result: &TestResult) -> String {
    json!({
        "scenario": result.scenario,
        "program": result.program,
        "result": result.word(),
        "status": result.status,
        "goal": result.goal,
        "met": result.met,
        "failures": result.plain_failures(),
        "warnings": result.notes,
        "time_ms": result.time_ms,
        "elapsed_ms": result.elapsed.as_millis() as u64,
    })
    .to_string()
        + "\n"
}
