//! The TextMate grammar of Structured Text and the words that the page of the IDE colours, from the
//! tables of the language. They know words, not meanings.

use serde_json::{Value, json};
use st::keywords::{KEYWORDS, OPERATOR_WORDS};
use st::model::{ELEMENTARY, UnitKind};
use st::standard::FUNCTIONS;

/// The grammar as a file.
pub fn text() -> String {
    // Maps of serde_json are sorted: the file is the same each time.
    format!("{:#}\n", grammar())
}

/// The words as TypeScript.
pub fn words() -> String {
    let mut text = "// Words of Structured Text, written by `cargo xtask docs`; do not edit.\n\
        const words = (list: string): ReadonlySet<string> => new Set(list.trim().split(/\\s+/));\n"
        .to_owned();
    let lists = [
        ("KEYWORDS", controls()),
        ("OPERATORS", OPERATOR_WORDS.map(str::to_owned).to_vec()),
        ("TYPES", ELEMENTARY.iter().map(|(name, _)| (*name).to_owned()).collect()),
        ("FUNCTIONS", [functions(), blocks()].concat()),
    ];
    for (name, list) in lists {
        let mut lines = vec![String::new()];
        for word in list {
            if let Some(line) = lines.last_mut().filter(|line| line.len() + word.len() < 90) {
                *line += if line.is_empty() { "" } else { " " };
                *line += &word;
            } else {
                lines.push(word);
            }
        }
        text += &format!("\nexport const {name} = words(`\n{}\n`);\n", lines.join("\n"));
    }
    text
}

fn grammar() -> Value {
    json!({
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "Structured Text",
        "scopeName": "source.st",
        "fileTypes": ["st"],
        "patterns": patterns(),
    })
}

/// Keywords that are neither operators nor values.
fn controls() -> Vec<String> {
    let is_control =
        |word: &&&str| !OPERATOR_WORDS.contains(word) && !["TRUE", "FALSE"].contains(word);
    KEYWORDS.iter().filter(is_control).map(|word| (*word).to_owned()).collect()
}

/// Standard functions that are no operators.
fn functions() -> Vec<String> {
    let names = FUNCTIONS.iter().map(|one| one.name);
    names.filter(|name| !OPERATOR_WORDS.contains(name)).map(str::to_owned).collect()
}

fn blocks() -> Vec<String> {
    let standard = st::compile(&[], &st::Around::default()).program;
    let blocks = standard.units.into_iter().filter(|unit| unit.kind == UnitKind::Block);
    blocks.map(|unit| unit.name).collect()
}

/// The patterns in their order: of two that match at the same place the first one counts.
fn patterns() -> Vec<Value> {
    let types = ELEMENTARY.iter().map(|(name, _)| (*name).to_owned()).collect();
    vec![
        json!({
            "match": r"^\s*(//#)\s*(\w+)(.*)$",
            "captures": {
                "1": { "name": "comment.line.directive.st" },
                "2": { "name": "keyword.other.directive.st" },
                "3": { "name": "string.unquoted.directive.st" },
            },
        }),
        one("comment.line.double-slash.st", r"//.*$"),
        between("comment.block.st", r"\(\*", r"\*\)"),
        between("comment.block.st", r"/\*", r"\*/"),
        between("meta.preprocessor.pragma.st", r"\{", r"\}"),
        one("string.quoted.double.st", r#""(?:\$.|[^"\r\n])*""#),
        one("string.quoted.single.st", r"'(?:\$.|[^'\r\n])*'"),
        one("constant.numeric.st", r"\b\w+#[-+]?\w+(?:#\w+)?(?:\.\d+\w*)?"),
        one("variable.language.address.st", r"%\w+(?:\.\d+)*"),
        one("constant.language.st", r"(?i)\b(?:TRUE|FALSE)\b"),
        word("storage.type.st", types),
        word("keyword.operator.word.st", OPERATOR_WORDS.map(str::to_owned).to_vec()),
        word("keyword.control.st", controls()),
        one("support.function.st", r"(?i)\b(?:[A-Z]+_)?TO_[A-Z]+\b(?=\s*\()"),
        one("support.function.st", &format!(r"(?i)\b(?:{})\b(?=\s*\()", functions().join("|"))),
        word("support.class.st", blocks()),
        one("constant.numeric.st", r"(?i)\b\d[\d_]*(?:\.\d[\d_]*)?(?:E[-+]?\d+)?\b"),
        one("keyword.operator.st", r":=|=>|<=|>=|<>|\*\*|\.\.|[-+*/=<>&]"),
        one("variable.other.st", r"\b[^\W\d]\w*"),
    ]
}

fn one(name: &str, pattern: &str) -> Value {
    json!({ "name": name, "match": pattern })
}

fn between(name: &str, begin: &str, end: &str) -> Value {
    json!({ "name": name, "begin": begin, "end": end })
}

/// Any of some words. A word boundary is at both ends, so their order says nothing.
fn word(name: &str, words: Vec<String>) -> Value {
    one(name, &format!(r"(?i)\b(?:{})\b", words.join("|")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fancy_regex::Regex;

    /// The words of a line with what they are, as an editor finds them.
    fn tokens(line: &str) -> Vec<String> {
        let rule = |pattern: &Value| {
            let name = pattern["name"].as_str()?.trim_end_matches(".st").to_owned();
            let text = match pattern["begin"].as_str() {
                Some(begin) => format!("{begin}.*?{}", pattern["end"].as_str().unwrap()),
                None => pattern["match"].as_str()?.to_owned(),
            };
            Some((Regex::new(&text).unwrap(), name))
        };
        let rules: Vec<(Regex, String)> = patterns().iter().filter_map(rule).collect();
        let mut found = Vec::new();
        let mut at = 0;
        while at < line.len() {
            let matches = rules.iter().filter_map(|(regex, name)| {
                let found = regex.find_from_pos(line, at).unwrap()?;
                Some((found.start(), found.end(), name))
            });
            // Of several at one place the first.
            let Some((start, end, name)) = matches.min_by_key(|(start, ..)| *start) else { break };
            found.push(format!("{} {name}", &line[start..end]));
            at = end.max(at + 1);
        }
        found
    }

    #[test]
    fn lines_of_programs() {
        let cases: [(&str, &[&str]); 6] = [
            (
                "Delay : TON; // wait",
                &["Delay variable.other", "TON support.class", "// wait comment.line.double-slash"],
            ),
            (
                "Lamp AT %Q0.0 : bool := true;",
                &[
                    "Lamp variable.other",
                    "AT keyword.control",
                    "%Q0.0 variable.language.address",
                    "bool storage.type",
                    ":= keyword.operator",
                    "true constant.language",
                ],
            ),
            (
                "IF a AND NOT b THEN (* c *)",
                &[
                    "IF keyword.control",
                    "a variable.other",
                    "AND keyword.operator.word",
                    "NOT keyword.operator.word",
                    "b variable.other",
                    "THEN keyword.control",
                    "(* c *) comment.block",
                ],
            ),
            (
                "x := INT_TO_REAL(n) + SQRT(1.5E3);",
                &[
                    "x variable.other",
                    ":= keyword.operator",
                    "INT_TO_REAL support.function",
                    "n variable.other",
                    "+ keyword.operator",
                    "SQRT support.function",
                    "1.5E3 constant.numeric",
                ],
            ),
            (
                "t := T#1m30s; w := 16#FF; s := State#Fill;",
                &[
                    "t variable.other",
                    ":= keyword.operator",
                    "T#1m30s constant.numeric",
                    "w variable.other",
                    ":= keyword.operator",
                    "16#FF constant.numeric",
                    "s variable.other",
                    ":= keyword.operator",
                    "State#Fill constant.numeric",
                ],
            ),
            ("ABSENT END_IFS", &["ABSENT variable.other", "END_IFS variable.other"]),
        ];
        for (line, expected) in cases {
            assert_eq!(tokens(line), expected, "{line}");
        }
    }
}
