//! Messages in the words of a program that is written with German mnemonics: `U` where they say
//! `A`, `E0.0` where they say `I0.0`. The sentences stay English.

use std::collections::HashSet;

use plc_isa::INSTRUCTIONS;

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Program, Statement};
use crate::text::foreign;
use crate::text::mnemonic_set::{german_address, is_german_word, written_in};

/// Puts German words into the messages of a German program.
pub(crate) fn translate(text: &str, program: &Program, diagnostics: &mut [Diagnostic]) {
    let is_german = written_in(text, program).unwrap_or_else(|| is_in_german(text, diagnostics));
    if !is_german {
        return;
    }
    let names = names(program);
    let translated = |part: &mut String| *part = in_german(part, &names);
    for diagnostic in diagnostics {
        // It tells words of both sets apart.
        if diagnostic.code == Code::MixedMnemonics {
            continue;
        }
        // What the message begins with may be quoted from the text.
        let quoted = diagnostic.span.text(text);
        diagnostic.message = match diagnostic.message.strip_prefix(quoted) {
            Some(rest) if !quoted.is_empty() => quoted.to_owned() + &in_german(rest, &names),
            _ => in_german(&diagnostic.message, &names),
        };
        diagnostic.label.iter_mut().for_each(translated);
        diagnostic.suggestion.iter_mut().for_each(translated);
        diagnostic.help.iter_mut().for_each(translated);
        diagnostic.related.iter_mut().for_each(|(_, words)| translated(words));
    }
}

/// Whether the lines that were not understood are German, if no other tells.
fn is_in_german(text: &str, diagnostics: &[Diagnostic]) -> bool {
    let tells = |word: &str| match foreign::is_german(word) {
        true => Some(true),
        false => is_german_word(word),
    };
    let mut told = diagnostics.iter().filter_map(|diagnostic| {
        // An address with a blank in it is marked as a whole.
        let marked = diagnostic.span.text(text).replace(' ', "");
        let line = text.get(diagnostic.span.start as usize..)?.lines().next()?;
        let mut words = line.split([' ', '\t', ',', ';', '(', ')']);
        tells(&marked).or_else(|| words.find_map(tells))
    });
    told.next() == Some(true)
}

/// What the program calls by names, in upper case: they are no mnemonics.
fn names(program: &Program) -> HashSet<String> {
    let symbols = program.symbols.iter().map(|symbol| symbol.name.to_uppercase());
    let locals = program.statements.iter().flat_map(|statement| match statement {
        Statement::Unit(unit) => unit.variables.as_slice(),
        Statement::Network(_) | Statement::Instruction(_) => &[],
    });
    symbols.chain(locals.map(|variable| variable.name.to_uppercase())).collect()
}

fn is_word_part(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '.' | '#' | '"')
}

/// A text with each of its words that is international in German.
fn in_german(text: &str, names: &HashSet<String>) -> String {
    let mut translated = String::with_capacity(text.len());
    let mut rest = text;
    while !rest.is_empty() {
        let len = rest.find(|c| !is_word_part(c)).unwrap_or(rest.len());
        let (word, behind) = rest.split_at(len);
        let before = translated.chars().last();
        match german_word(word, before).filter(|_| !names.contains(&word.to_uppercase())) {
            Some(german) => translated.push_str(&german),
            None => translated.push_str(word),
        }
        let sign = behind.chars().next().map_or(0, char::len_utf8);
        translated.push_str(&behind[..sign]);
        rest = &behind[sign..];
    }
    translated
}

/// A mnemonic, an address or an area by its German name, if that is another one.
fn german_word(word: &str, before: Option<char>) -> Option<String> {
    // `+I` and `=I` are the same in both.
    let is_after_sign =
        before.is_some_and(|c| matches!(c, '+' | '-' | '*' | '/' | '=' | '>' | '<'));
    match word {
        "I" | "C" | "Q" if is_after_sign => return None,
        "I" => return Some("E".to_owned()),
        "Q" => return Some("A".to_owned()),
        "C" => return Some("Z".to_owned()),
        "Cxxx" => return Some("Zxxx".to_owned()),
        _ => {}
    }
    let mnemonic = INSTRUCTIONS.iter().find(|entry| entry.mnemonics.first() == Some(&word));
    if let Some(entry) = mnemonic {
        let german = entry.mnemonics.get(1).filter(|name| !name.starts_with('T'));
        return german.map(|german| (*german).to_owned());
    }
    let stem = word.trim_end_matches('.');
    let address = Address::parse(stem).ok().filter(|address| address.to_string() == stem)?;
    Some(german_address(address) + &word[stem.len()..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_addresses_are_translated() {
        let german = |text| in_german(text, &HashSet::from(["AN".to_owned()]));
        assert_eq!(german("`A I0.0`, `AW>= AIW0, 5`"), "`U E0.0`, `UW>= AEW0, 5`");
        assert_eq!(german("`CTU C1, 10`; ALD, OLD"), "`ZV Z1, 10`; ULD, OLD");
        assert_eq!(german("I has the bits I0.0 to I15.7."), "E has the bits E0.0 to E15.7.");
        assert_eq!(german("`+I 1, VW0` and =I or TOF T37"), "`+I 1, VW0` and =I or TOF T37");
        assert_eq!(german("AN: a symbol"), "AN: a symbol");
        assert_eq!(german("A0.0 and Ain0, 'ORW'"), "A0.0 and Ain0, 'ODERW'");
    }
}
