//! Results as JUnit XML, the dialect that CI servers have in common: one suite, a case a scenario.

use super::result::TestResult;

/// The whole document. `tool`: what has run the scenarios.
pub fn text(tool: &str, results: &[TestResult]) -> String {
    let count = |wanted: fn(u8) -> bool| results.iter().filter(|one| wanted(one.status)).count();
    let (failures, errors) = (count(|status| status == 1), count(|status| status > 1));
    let seconds: f64 = results.iter().map(|result| result.elapsed.as_secs_f64()).sum();
    let counts = format!(
        "name=\"{tool}\" tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" \
            time=\"{seconds:.3}\"",
        results.len()
    );
    let cases: String = results.iter().map(case).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {counts}>\n  \
            <testsuite {counts}>\n{cases}  </testsuite>\n</testsuites>\n"
    )
}

fn case(result: &TestResult) -> String {
    let head = format!(
        "    <testcase name=\"{}\" classname=\"{}\" time=\"{:.3}\"",
        escaped(&result.scenario),
        escaped(&result.program),
        result.elapsed.as_secs_f64()
    );
    if result.status == 0 {
        return format!("{head}/>\n");
    }
    let element = if result.status == 1 { "failure" } else { "error" };
    let failures = result.plain_failures();
    let first = failures.first().and_then(|text| text.lines().next()).unwrap_or_default();
    format!(
        "{head}>\n      <{element} message=\"{}\">{}</{element}>\n    </testcase>\n",
        escaped(first),
        escaped(&failures.join("\n"))
    )
}

/// Text for contents and attributes. What XML has no character for is a question mark.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => escaped.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('?'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_xml_reserves_is_escaped() {
        assert_eq!(escaped("a<b> & \"c\"\n\u{1b}[0m"), "a&lt;b&gt; &amp; &quot;c&quot;\n?[0m");
    }
}
