//! The TextMate grammar of AWL, from the instruction table: how editors colour a program. It knows
//! words, not meanings; those the language server has.

use awl_asm::directive_table::DIRECTIVES;
use awl_asm::mnemonics::keywords;
use plc_isa::INSTRUCTIONS;
use serde_json::{Value, json};

/// The grammar as a file.
pub fn text() -> String {
    // Maps of serde_json are sorted: the file is the same each time.
    format!("{:#}\n", grammar())
}

fn grammar() -> Value {
    json!({
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "AWL",
        "scopeName": "source.awl",
        "fileTypes": ["awl"],
        "patterns": patterns(),
    })
}

/// Addresses, German letters too: bits and what has a size, what is numbered, analog points.
const ADDRESSES: [&str; 4] = [
    r"(?:SM|[IQMVLSEA])(?:\d+\.[0-7]|[BWD]\d+)",
    r"[TCZ]\d+",
    r"AC[0-3]|H[CZ]\d",
    r"A[IQEA]W?\d+|AIN\d",
];

/// The patterns in their order: of two that match at the same place the first one counts.
fn patterns() -> Vec<Value> {
    let directives = alternatives(DIRECTIVES.iter().map(|row| row.word));
    vec![
        json!({
            "match": format!(r"^\s*(//#)\s*({directives})\b(.*)$"),
            "captures": {
                "1": { "name": "comment.line.directive.awl" },
                "2": { "name": "keyword.other.directive.awl" },
                "3": { "name": "string.unquoted.directive.awl" },
            },
        }),
        one("comment.line.double-slash.awl", r"//.*$"),
        between("comment.block.awl", r"\(\*", r"\*\)"),
        between("comment.block.awl", r"/\*", r"\*/"),
        json!({
            "match": r"(?i)^\s*(TITLE)\s*(=.*)$",
            "captures": {
                "1": { "name": "keyword.control.awl" },
                "2": { "name": "string.unquoted.title.awl" },
            },
        }),
        json!({
            "match": format!(r"(?i)(?:^|(?<=;))\s*({})\b", alternatives(keywords())),
            "captures": { "1": { "name": "keyword.control.awl" } },
        }),
        json!({
            "match": format!(r"(?i)(?:^|(?<=;))\s*({})(?![\w.])", comparisons()),
            "captures": { "1": { "name": "keyword.operator.comparison.awl" } },
        }),
        json!({
            "match": format!(r"(?i)(?:^|(?<=;))\s*({})(?![\w.=<>])", instructions()),
            "captures": { "1": { "name": "keyword.mnemonic.awl" } },
        }),
        one("string.quoted.double.awl", r#""(?:\$.|[^"\r\n])*""#),
        one("string.quoted.single.awl", r"'(?:\$.|[^'\r\n])*'"),
        one("constant.numeric.awl", r"(?i)\b(?:16#[0-9A-F_]+|2#[01_]+|[A-Z]+#[-+\w#.]+)"),
        one("variable.parameter.awl", r"#\w+"),
        one("variable.language.address.awl", &format!(r"(?i)[*&]?\b(?:{})\b", ADDRESSES.join("|"))),
        one("constant.language.awl", r"(?i)\b(?:TRUE|FALSE|ON|OFF)\b"),
        one("constant.numeric.awl", r"(?i)[-+]?\b\d+(?:\.\d+)?(?:E[-+]?\d+)?\b"),
        one("variable.other.symbol.awl", r"\b[^\W\d]\w*(?:\[\d+\])?"),
    ]
}

fn one(name: &str, pattern: &str) -> Value {
    json!({ "name": name, "match": pattern })
}

fn between(name: &str, begin: &str, end: &str) -> Value {
    json!({ "name": name, "begin": begin, "end": end })
}

fn instructions() -> String {
    let rows = INSTRUCTIONS.iter().filter(|row| !row.has_relation());
    let returns = ["RET", "RETI"];
    alternatives(rows.flat_map(|row| row.mnemonics.iter().copied()).chain(returns))
}

/// The mnemonics of comparisons, each with its sign.
fn comparisons() -> String {
    let rows = INSTRUCTIONS.iter().filter(|row| row.has_relation());
    let words = alternatives(rows.flat_map(|row| row.mnemonics.iter().copied()));
    format!("(?:{words})(?:>=|<=|<>|=|>|<)")
}

/// Words as one pattern, the longest first: the first that matches counts.
fn alternatives<'w>(words: impl Iterator<Item = &'w str>) -> String {
    let mut words: Vec<&str> = words.collect();
    words.sort_by_key(|word| (std::cmp::Reverse(word.len()), *word));
    words.dedup();
    let escaped = words.iter().map(|word| word.replace('+', r"\+").replace('*', r"\*"));
    escaped.collect::<Vec<_>>().join("|")
}

#[cfg(test)]
mod tests {
    use super::*;
    use fancy_regex::Regex;

    /// The patterns that are one match each, with the names of what they find.
    fn rules() -> Vec<(Regex, Vec<(usize, String)>)> {
        let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
        let rule = |pattern: &Value| {
            let regex = Regex::new(pattern["match"].as_str()?).unwrap();
            let names = match pattern["captures"].as_object() {
                Some(captures) => {
                    captures.iter().map(|(at, one)| (at.parse().unwrap(), name(one))).collect()
                }
                None => vec![(0, name(pattern))],
            };
            Some((regex, names))
        };
        patterns().iter().filter_map(rule).collect()
    }

    /// The words of a line with the first part of their names, as an editor finds them.
    fn tokens(line: &str) -> Vec<String> {
        let rules = rules();
        let mut found = Vec::new();
        let mut at = 0;
        while at < line.len() {
            let matches = rules.iter().filter_map(|(regex, names)| {
                let captures = regex.captures_from_pos(line, at).unwrap()?;
                Some((captures.get(0).unwrap().start(), captures, names))
            });
            // Of several at one place the first.
            let Some((_, captures, names)) = matches.min_by_key(|(start, ..)| *start) else {
                break;
            };
            let whole = captures.get(0).unwrap();
            for (group, name) in names {
                let Some(part) = captures.get(*group) else { continue };
                let name = name.rsplit_once('.').unwrap().0;
                found.push(format!("{} {name}", part.as_str()));
            }
            at = whole.end().max(at + 1);
        }
        found
    }

    #[test]
    fn lines_of_programs() {
        let cases: [(&str, &[&str]); 9] = [
            ("LD     I0.0", &["LD keyword.mnemonic", "I0.0 variable.language.address"]),
            (
                "= \"lift up\" // x",
                &[
                    "= keyword.mnemonic",
                    "\"lift up\" string.quoted.double",
                    "// x comment.line.double-slash",
                ],
            ),
            (
                "LDW>= 5, Speed",
                &[
                    "LDW>= keyword.operator.comparison",
                    "5 constant.numeric",
                    "Speed variable.other.symbol",
                ],
            ),
            ("NETWORK 1", &["NETWORK keyword.control", "1 constant.numeric"]),
            (
                "//# symbol Lamp Q0.0",
                &[
                    "//# comment.line.directive",
                    "symbol keyword.other.directive",
                    " Lamp Q0.0 string.unquoted.directive",
                ],
            ),
            (
                "+I 16#FF, AC0",
                &["+I keyword.mnemonic", "16#FF constant.numeric", "AC0 variable.language.address"],
            ),
            (
                "MOVW #Level, *VD10",
                &[
                    "MOVW keyword.mnemonic",
                    "#Level variable.parameter",
                    "*VD10 variable.language.address",
                ],
            ),
            ("LDX Q0.0", &["LDX variable.other.symbol", "Q0.0 variable.language.address"]),
            ("u e0.1", &["u keyword.mnemonic", "e0.1 variable.language.address"]),
        ];
        for (line, expected) in cases {
            assert_eq!(tokens(line), expected, "{line}");
        }
    }

    #[test]
    fn every_mnemonic_is_one() {
        for row in INSTRUCTIONS {
            for mnemonic in row.mnemonics {
                let sign = if row.has_relation() { "=" } else { "" };
                let line = format!("{mnemonic}{sign} MW0");
                let first = tokens(&line).into_iter().next().unwrap();
                assert!(first.starts_with(&format!("{mnemonic}{sign} keyword")), "{first}");
            }
        }
    }
}
