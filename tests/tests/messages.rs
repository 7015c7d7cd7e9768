//! The assembler's messages: each file in `tests/messages` states which diagnostics it gets, where,
//! in which words.
//!
//! `README.md` says how they are written. A file gets exactly what it states, no more and no less.

use std::fmt::Write;

use awl_asm::assemble::assemble;
use awl_asm::diagnostic::{Code, Diagnostic};
use awl_asm::source::Source;
use plc_isa::MODULE_NAMES;
use tests::case::{files, folder, read};

/// What a file states about one diagnostic.
#[derive(Debug, PartialEq, Eq)]
struct Stated {
    line: usize,
    column: usize,
    code: String,
    /// A part of the message; empty fits all.
    words: String,
    suggestion: Option<String>,
}

/// Reads the statements of a file: those after `//~` about their line, those after `//~^` about
/// the line above.
fn stated(text: &str) -> Result<Vec<Stated>, String> {
    let mut all = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let Some((_, list)) = line.split_once("//~") else { continue };
        let (list, line) = match list.strip_prefix('^') {
            Some(list) => (list, number - 1),
            None => (list, number),
        };
        let mut rest = list.trim();
        while !rest.is_empty() {
            let (one, behind) = statement(rest, line)
                .ok_or_else(|| format!("line {number}: not understood: {rest}"))?;
            all.push(one);
            rest = behind;
        }
    }
    Ok(all)
}

/// The first statement of a list, such as ``E0005:4 `bits 0 to 7` -> `Q1.1` ``, and what follows
/// its comma.
fn statement(text: &str, line: usize) -> Option<(Stated, &str)> {
    let end = text.find([' ', ',']).unwrap_or(text.len());
    let (code, column) = text[..end].split_once(':')?;
    let (words, rest) = quoted(text[end..].trim_start())?;
    let (suggestion, rest) = match rest.strip_prefix("->") {
        Some(rest) => {
            let (suggestion, rest) = quoted(rest.trim_start())?;
            (Some(suggestion?.to_string()), rest)
        }
        None => (None, rest),
    };
    let words = words.unwrap_or("").to_string();
    let stated =
        Stated { line, column: column.parse().ok()?, code: code.to_string(), words, suggestion };
    match rest.strip_prefix(',') {
        Some(more) => Some((stated, more.trim_start())),
        None if rest.is_empty() => Some((stated, rest)),
        None => None,
    }
}

/// A text in backquotes, if one is here, and what follows.
fn quoted(text: &str) -> Option<(Option<&str>, &str)> {
    let Some(inside) = text.strip_prefix('`') else { return Some((None, text)) };
    let (quoted, rest) = inside.split_once('`')?;
    Some((Some(quoted), rest.trim_start()))
}

impl Stated {
    fn of(source: &Source, diagnostic: &Diagnostic) -> Stated {
        let (line, column) = source.position(diagnostic.span.start as usize);
        let (code, words) = (diagnostic.code.text().to_string(), diagnostic.message.clone());
        Stated { line, column, code, words, suggestion: diagnostic.suggestion.clone() }
    }

    fn fits(&self, got: &Stated) -> bool {
        (self.line, self.column, &self.code, &self.suggestion)
            == (got.line, got.column, &got.code, &got.suggestion)
            && got.words.contains(&self.words)
    }

    /// As it would be written in a file.
    fn text(&self) -> String {
        let mut text = format!("{}:{} `{}`", self.code, self.column, self.words);
        if let Some(suggestion) = &self.suggestion {
            let _ = write!(text, " -> `{suggestion}`");
        }
        text
    }
}

/// What is wrong with the messages of a program.
fn differences(name: &str, text: &str) -> Vec<String> {
    let mut stated = match stated(text) {
        Ok(stated) => stated,
        Err(error) => return vec![format!("{name}: {error}")],
    };
    let source = Source::new(name, text).expect("a short text");
    let mut differences = Vec::new();
    for diagnostic in &assemble(&source, Vec::new()).diagnostics {
        let got = Stated::of(&source, diagnostic);
        match stated.iter().position(|stated| stated.fits(&got)) {
            Some(index) => {
                stated.remove(index);
            }
            None => differences.push(format!("{name}:{}: got      {}", got.line, got.text())),
        }
    }
    differences.extend(
        stated.iter().map(|stated| format!("{name}:{}: expected {}", stated.line, stated.text())),
    );
    differences
}

#[test]
fn every_file_gets_the_messages_it_states() {
    let mut all = Vec::new();
    for path in files(&folder("messages")) {
        let name =
            path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        all.extend(differences(&name, &read(&path)));
    }
    assert!(all.is_empty(), "{} differences\n{}", all.len(), all.join("\n"));
}

/// A line of `messages/mistakes.txt`.
struct Mistake<'t> {
    number: usize,
    text: String,
    has: Vec<&'t str>,
    has_not: Vec<&'t str>,
}

/// Reads the lines of the table; the file says how they are written.
fn mistakes(table: &str) -> Vec<Mistake<'_>> {
    let lines = (1..).zip(table.lines()).filter(|(_, line)| !line.is_empty());
    let rows = lines.filter(|(_, line)| !line.starts_with("# ") && !line.starts_with("##"));
    let rows = rows.filter(|(_, line)| *line != "#");
    rows.map(|(number, line)| {
        let columns: Vec<&str> = line.trim_end_matches(" |").split(" | ").collect();
        let list = |index: usize| {
            let column = columns.get(index).copied().unwrap_or("");
            column.split(" & ").map(str::trim).filter(|words| !words.is_empty()).collect()
        };
        let text = columns[0].replace(" \\ ", "\n");
        Mistake { number, text, has: list(1), has_not: list(2) }
    })
    .collect()
}

/// Whether an answer has these words; those after `->` are a whole suggestion.
fn says(answer: &[Diagnostic], words: &str) -> bool {
    answer.iter().any(|one| match (words.strip_prefix("->"), &one.suggestion) {
        (Some(""), suggestion) => suggestion.is_some(),
        (Some(wanted), Some(suggestion)) => suggestion == wanted.trim(),
        (Some(_), None) => false,
        (None, _) => {
            let texts = one.help.iter().chain([&one.message]);
            one.code.text() == words || texts.into_iter().any(|text| text.contains(words))
        }
    })
}

/// What is wrong with the answer to a mistake.
fn answer_lacks(mistake: &Mistake) -> Option<String> {
    let source = Source::new("t", mistake.text.as_str()).expect("a short text");
    let answer = assemble(&source, Vec::new()).diagnostics;
    // What addresses there are says the message itself.
    let helps = answer.iter().any(|one| {
        one.suggestion.is_some() || !one.help.is_empty() || one.code == Code::AddressRange
    });
    let lacks =
        mistake.has.iter().filter(|words| !says(&answer, words)).map(|one| format!("+{one}"));
    let excess = mistake.has_not.iter().filter(|words| says(&answer, words));
    let mut wrong: Vec<String> = lacks.chain(excess.map(|one| format!("-{one}"))).collect();
    wrong.extend((!helps).then(|| "how to mend it".to_owned()));
    let shown = |one: &Diagnostic| {
        let stated = Stated::of(&source, one);
        format!("\n    {}: {} {:?}", stated.line, stated.text(), one.help)
    };
    let answer: String = answer.iter().map(shown).collect();
    let (number, text) = (mistake.number, &mistake.text);
    (!wrong.is_empty()).then(|| format!("{number}: {text:?} {wrong:?}{answer}"))
}

#[test]
fn every_mistake_is_answered_with_how_to_mend_it() {
    let table = read(&folder("messages").join("mistakes.txt"));
    let mistakes = mistakes(&table);
    assert!(mistakes.len() >= 400, "{} mistakes", mistakes.len());
    let wrong: Vec<String> = mistakes.iter().filter_map(answer_lacks).collect();
    assert!(wrong.is_empty(), "{} answers\n{}", wrong.len(), wrong.join("\n"));
}

/// The codes that a file cannot show: it would be thousands of lines long.
const NOT_SHOWN: [Code; 1] = [Code::ProgramTooLarge];

#[test]
fn every_code_has_a_message() {
    let texts: Vec<String> = files(&folder("messages")).iter().map(|path| read(path)).collect();
    let shown = |code: &Code| {
        texts.iter().flat_map(|text| stated(text)).flatten().any(|one| one.code == code.text())
    };
    let missing: Vec<&str> = Code::ALL
        .iter()
        .filter(|code| !NOT_SHOWN.contains(code) && !shown(code))
        .map(|code| code.text())
        .collect();
    assert!(missing.is_empty(), "no file in tests/messages shows {missing:?}");
}

/// The diagnostics of a text that a test has made.
fn diagnostics(text: String) -> Vec<(Code, usize, String)> {
    let source = Source::new("long.awl", text).expect("a text");
    let place = |diagnostic: &Diagnostic| source.position(diagnostic.span.start as usize).0;
    let diagnostics = assemble(&source, Vec::new()).diagnostics;
    diagnostics.iter().map(|one| (one.code, place(one), one.message.clone())).collect()
}

#[test]
fn a_program_that_is_too_large() {
    // Header 68 bytes, name 4, `LD` and `=` 2 each, 50 looks for a status window of 1, end of
    // program 1, checksum 4: 7680 bytes hold 3776 of them.
    let program =
        |lines: usize| "//# board uno\nLD I0.0\n".to_string() + &"= M0.0\n".repeat(lines - 1);
    assert_eq!(diagnostics(program(3776)), []);
    let [(code, line, message)] = &diagnostics(program(3778))[..] else { panic!("one error") };
    assert_eq!((*code, *line), (Code::ProgramTooLarge, 3778));
    assert!(message.contains("7683 bytes") && message.contains("7680"), "{message}");
}

#[test]
fn the_modules_of_a_program_that_is_too_large() {
    let text = "//# board uno\nLD I0.0\nMOVD 5, VD0\n".to_string() + &"= M0.0\n".repeat(3500);
    let source = Source::new("long.awl", text).expect("a text");
    let diagnostics = assemble(&source, Vec::new()).diagnostics;
    let [error] = &diagnostics[..] else { panic!("one error") };
    let len = |name: &str| awl_asm::modules::bytes(number(name)).len();
    let (general, operands) = (len("general"), len("operands"));
    let expected = format!(
        "{} bytes of them are modules: general {general}, operands {operands}",
        general + operands
    );
    assert!(
        error.code == Code::ProgramTooLarge && error.help.contains(&expected),
        "{:?}",
        error.help
    );
}

#[test]
fn a_program_that_is_too_large_is_told_what_would_help() {
    let error = |text: String| {
        let source = Source::new("long.awl", text).expect("a text");
        let assembly = assemble(&source, Vec::new());
        assert!(assembly.is_too_large() && assembly.image.is_none() && !assembly.draft.is_empty());
        let listing = awl_asm::listing::listing(&source, &assembly);
        assert!(listing.contains("= M0.0") && listing.contains("04"), "{listing}");
        let [error] = <[_; 1]>::try_from(assembly.diagnostics).expect("one error");
        error
    };
    let lines = "= M0.0\n".repeat(2100);
    let modules = "MOVD 16#40A00000, VD0\nRTS VD0, 16#A2, VB10";
    let one = error(format!("//# board uno\nLD I0.0\n{modules}\n{lines}"));
    assert!(one.message.ends_with("bytes too many"), "{}", one.message);
    let help = one.help.join("\n");
    assert!(help.contains("without the instruction of "), "{help}");
    let places: Vec<_> = one.related.iter().map(|(_, words)| words.as_str()).collect();
    assert!(places.iter().any(|words| words.contains("numerals, ")), "{places:?}");
    let none = error(format!("//# board uno\nLD I0.0\n{}", "= M0.0\n".repeat(4000)));
    assert!(none.help.iter().any(|line| line.contains("instructions must go")), "{:?}", none.help);
}

/// The number of a module.
fn number(name: &str) -> u8 {
    MODULE_NAMES.iter().position(|&other| other == name).expect("a module") as u8
}

#[test]
fn an_edge_too_many() {
    let program = |edges: usize| format!("LD I0.0\n{}= M0.0\n", "EU\n".repeat(edges));
    assert_eq!(diagnostics(program(256)), []);
    let [(code, line, message)] = &diagnostics(program(257))[..] else { panic!("one error") };
    assert_eq!((*code, *line), (Code::TooMany, 258));
    assert!(message.contains("256"), "{message}");
}

/// The runner itself: it must see what is wrong.
#[test]
fn a_wrong_statement_is_seen() {
    let good = "LD I0.0\n= Q0.9 //~ E0005:3 `bits 0 to 7` -> `Q1.1`\n";
    assert_eq!(differences("t", good), [""; 0]);
    assert_eq!(differences("t", "LD I0.0\n= Q0.9\n//~^ E0005:3 -> `Q1.1`\n"), [""; 0]);
    let wrong = [
        "LD I0.0\n= Q0.9\n",
        "LD I0.0\n= Q0.1 //~ E0005:3\n",
        "LD I0.0\n= Q0.9 //~ E0005:3\n",
        "LD I0.0\n= Q0.9 //~ E0005:4 -> `Q1.1`\n",
        "LD I0.0\n= Q0.9 //~ E0006:3 -> `Q1.1`\n",
        "LD I0.0\n= Q0.9 //~ E0005:3 `nine` -> `Q1.1`\n",
        "LD I0.0 //~ E0005:3 -> `Q1.1`\n= Q0.9\n",
        "LD I0.0\n= Q0.9 //~ E0005 -> `Q1.1`\n",
        "LD I0.0\n= Q0.9 //~ E0005:3 -> `Q1.1` and more\n",
    ];
    for text in wrong {
        assert!(!differences("t", text).is_empty(), "{text}");
    }
}
