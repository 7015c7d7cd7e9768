//! A word of another controller, and what an S7-200 has for it. Which words there are is in the
//! tables.

use super::apart::apart;
use super::width;

/// What was probably meant.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Meant {
    /// What should be there instead, where something means the same.
    pub(crate) instead: Option<Instead>,
    /// How to write it.
    pub(crate) help: Vec<String>,
    /// The mnemonic that is taken for the word, so that the next lines are not reported for it.
    pub(crate) stand_in: Option<String>,
}

/// Help alone, where no suggestion means the same.
pub(super) fn told(help: impl Into<String>) -> Meant {
    Meant { help: vec![help.into()], ..Meant::default() }
}

/// What a suggestion replaces.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Instead {
    /// The first word: the operands stay.
    Word(String),
    /// All of the line.
    Line(String),
}

/// A word of another controller.
#[derive(Debug)]
pub(super) struct Row {
    /// Its spellings that tell no language.
    pub(super) names: &'static [&'static str],
    /// Its German spellings.
    pub(super) german: &'static [&'static str],
    pub(super) here: Here,
    /// How to write it; empty where the suggestion says all.
    pub(super) way: &'static str,
}

/// What an S7-200 has for a word.
#[derive(Debug, Clone, Copy)]
pub(super) enum Here {
    /// Nothing that takes its place.
    Nothing,
    /// Nothing: it begins or ends a block.
    Block,
    /// The mnemonic that means the same with the same operands.
    Mnemonic(&'static str),
    /// The instruction that means the same, whatever the operands are.
    Instruction(&'static str),
    /// Nothing to suggest, but for the logic stack the word is like this one.
    Like(&'static str),
    /// The call of a subroutine, whose number follows.
    Routine,
    /// The mnemonics for a bit, byte, word, double word and real, empty where there is none; and
    /// the one if the operands do not tell.
    Sized([&'static str; 5], &'static str),
}

pub(super) const fn row(names: &'static [&'static str], here: Here, way: &'static str) -> Row {
    Row { names, german: &[], here, way }
}

/// A word that has a name of its own in German.
pub(super) const fn named(
    names: &'static [&'static str],
    german: &'static [&'static str],
    here: Here,
    way: &'static str,
) -> Row {
    Row { names, german, here, way }
}

impl Row {
    /// Whether the word begins or ends a block.
    pub(super) fn is_of_block(&self) -> bool {
        matches!(self.here, Here::Block)
    }

    /// What is meant by the word with these operands.
    pub(super) fn meant(&self, rest: &str) -> Meant {
        let meant = self.word(rest);
        let operands: Vec<String> =
            rest.split(',').map(|operand| operand.trim().to_owned()).collect();
        let instruction = meant.stand_in.as_deref();
        let Some(code) = instruction.and_then(|mnemonic| apart(mnemonic, &operands)) else {
            return meant;
        };
        let lines: Vec<String> = code.iter().map(|line| format!("`{line}`")).collect();
        let help = vec![format!("on an S7-200 that is {}", lines.join(", "))];
        Meant { instead: None, help, ..meant }
    }

    /// What is meant by the word, whatever else the operands tell.
    fn word(&self, rest: &str) -> Meant {
        let word = |mnemonic: &str| (!mnemonic.is_empty()).then(|| mnemonic.to_owned());
        let width = width::of(rest);
        let (instead, stand_in) = match self.here {
            Here::Nothing | Here::Block => (None, None),
            Here::Like(mnemonic) => (None, word(mnemonic)),
            Here::Routine => {
                let number = rest.trim().parse::<u8>().ok();
                (number.map(|number| Instead::Line(format!("CALL SBR{number}"))), word("CALL"))
            }
            Here::Mnemonic(mnemonic) => (word(mnemonic).map(Instead::Word), word(mnemonic)),
            Here::Instruction(text) => {
                (word(text).map(Instead::Line), text.split(' ').next().and_then(word))
            }
            Here::Sized(names, otherwise) => {
                let mnemonic = width.map_or(otherwise, |width| width.of_all(names));
                (word(mnemonic).map(Instead::Word), word(mnemonic))
            }
        };
        // Which of several it is, the operands have told.
        let is_told = match self.here {
            Here::Sized(..) => width.is_some() && instead.is_some(),
            Here::Routine => instead.is_some(),
            _ => false,
        };
        let help = word(self.way).filter(|_| !is_told).into_iter().collect();
        // One operand of two is that of an accumulator.
        let is_short = matches!(self.here, Here::Sized(..))
            && rest.split([',', ' ', '\t']).filter(|word| !word.is_empty()).count() == 1
            && stand_in.as_deref().is_some_and(|name| {
                name.starts_with(['+', '-', '*', '/']) || name.starts_with("MOV")
            });
        match is_short && !self.way.is_empty() {
            true => Meant { instead: None, help: vec![self.way.to_owned()], stand_in },
            false => Meant { instead, help, stand_in },
        }
    }
}
