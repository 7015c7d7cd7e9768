//! What people write who know another controller or language, and what an S7-200 has for it. The
//! words that begin a line and whole lines; what is wrong with an instruction of the S7-200 is said
//! where it is read.

mod accumulators;
mod apart;
mod bits;
mod boxes;
mod brackets;
mod calls;
mod conditional;
mod controllers;
mod counts;
mod data_files;
mod expression;
mod lines;
mod look_alike;
pub(crate) mod operands;
mod parameters;
mod preset_first;
mod row;
mod step7;
mod structured;
mod system_bits;
pub(crate) mod system_functions;
mod together;
pub(crate) mod width;
mod words;

pub(crate) use accumulators::comparison;
pub(crate) use apart::apart;
pub(crate) use expression::{contact_of, contacts_of};
pub(crate) use lines::is_structured;
pub(crate) use look_alike::look_alike;
pub(crate) use parameters::parameters;
pub(crate) use row::{Instead, Meant};
pub(crate) use together::{Flow, Together};
pub(crate) use words::{is_german, is_known};

/// What a line was meant to be that begins with no instruction of the S7-200. `rest` is what is
/// after the word.
pub(crate) fn meant(word: &str, rest: &str) -> Option<Meant> {
    // `RND+` is cut where the sign is.
    let signed = rest.get(..1).filter(|sign| matches!(*sign, "+" | "-"));
    let signed = signed.and_then(|sign| words::find(&format!("{word}{sign}")));
    signed
        .map(|row| row.meant(rest))
        .or_else(|| lines::meant(word, rest))
        .or_else(|| words::find(word).map(|row| row.meant(rest)))
}

/// The mnemonic of the size of the operands, for one that is there in several sizes: `MOVB` as
/// `MOVW` if the operands are words.
pub(crate) fn sized(mnemonic: &str, rest: &str) -> Option<&'static str> {
    width::of(rest)?.sibling(mnemonic)
}

/// What the lines are together that begin where the text begins, if they are anything. `flow` is
/// what is before them.
pub(crate) fn together(text: &str, flow: Flow) -> Option<Together> {
    accumulators::find(text, flow)
        .or_else(|| preset_first::find(text))
        .or_else(|| bits::find(text, flow))
        .or_else(|| conditional::find(text))
        .or_else(|| brackets(text, flow))
}

/// Contacts with brackets, where the text begins with one.
pub(crate) fn brackets(text: &str, flow: Flow) -> Option<Together> {
    brackets::find(text, flow)
}

/// Whether an operand is the address of a bit, here or in another system.
pub(crate) fn is_bit(text: &str) -> bool {
    let here = operands::same(text);
    width::Width::of_operand(here.as_deref().unwrap_or(text)) == Some(width::Width::Bit)
}

/// Whether a word begins or ends a block of another language.
pub(crate) fn is_block(word: &str) -> bool {
    words::find(word).is_some_and(row::Row::is_of_block)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operands_tell_the_size() {
        let suggested = |word, rest| meant(word, rest).and_then(|meant| meant.instead);
        let is = |mnemonic: &str| Some(Instead::Word(mnemonic.to_owned()));
        assert_eq!(suggested("XOR", " VW0, VW2"), is("XORW"));
        assert_eq!(suggested("xor", " VB0, VB1"), is("XORB"));
        assert_eq!(suggested("AND", " I0.0"), is("A"));
        assert_eq!(suggested("UND", " MD0, MD4"), is("ANDD"));
        assert_eq!(suggested("ADD", " 1, VD0"), is("+D"));
        assert_eq!(suggested("ADD", " VB0, VB1"), None);
        assert_eq!(suggested("MOV", " 5, Level"), is("MOVW"));
        assert_eq!(suggested("CMP", " VW0, VW2"), None);
        assert_eq!(sized("MOVB", " VW0, VW2"), Some("MOVW"));
        assert_eq!(sized("SRB", " VD0, 1"), Some("SRD"));
        assert_eq!(sized("TON", " VD0, 1"), None);
    }
}
