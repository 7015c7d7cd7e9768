//! Which mnemonic set a program is written in, international (`A I0.0`) or German (`U E0.0`): it
//! has one, and is warned about words of the other. Most words are the same in both; what they mean
//! is said elsewhere.

use plc_isa::{AnalogInput, Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Instruction, Program, Span, Statement, Value};

/// A mnemonic set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Set {
    International,
    German,
}

impl Set {
    fn name(self) -> &'static str {
        match self {
            Set::International => "international",
            Set::German => "German",
        }
    }
}

/// What is U in German; of the other instructions with a German mnemonic some are known in both
/// sets.
const ONLY_INTERNATIONAL: [Op; 9] =
    [Op::A, Op::An, Op::Ai, Op::Ani, Op::Ab, Op::Aw, Op::AndDouble, Op::AndReal, Op::AndText];

/// Und, Oder, Zähler: what is different in German begins with these.
fn is_german(mnemonic: &str) -> bool {
    let begins = |start: &str| {
        mnemonic.get(..start.len()).is_some_and(|word| word.eq_ignore_ascii_case(start))
    };
    begins("U") || begins("Z") || begins("ODER")
}

/// Warns once where a program changes the set.
pub(crate) fn check(text: &str, program: &Program, diagnostics: &mut Vec<Diagnostic>) {
    let mut first: Option<(Set, Span)> = None;
    for statement in &program.statements {
        let Statement::Instruction(instruction) = statement else { continue };
        for (set, span, address) in words(text, instruction) {
            let is_symbol = || {
                address.is_some_and(|address| Address::parse(bare(span.text(text))) != Ok(address))
            };
            match first {
                None if !is_symbol() => first = Some((set, span)),
                Some((of_program, place)) if of_program != set && !is_symbol() => {
                    return diagnostics.push(mix(text, of_program, place, span, instruction));
                }
                _ => {}
            }
        }
    }
}

/// The words of an instruction that belong to one set only, with the address that an operand is
/// for.
fn words<'p>(
    text: &'p str,
    instruction: &'p Instruction,
) -> impl Iterator<Item = (Set, Span, Option<Address>)> + use<'p> {
    let span = instruction.mnemonic_span;
    // What stands in for an unknown word has no word of its own.
    let is_known = instruction
        .operands
        .first()
        .is_none_or(|operand| operand.span != instruction.mnemonic_span);
    let set = is_known.then(|| set_of_mnemonic(span.text(text), instruction.entry.op)).flatten();
    let mnemonic = set.map(|set| (set, span, None));
    let operands = instruction.operands.iter().filter_map(|operand| match operand.value {
        Value::Address(address) | Value::Indirect(address) | Value::AddressOf(address) => {
            let set = set_of_address(bare(operand.span.text(text)), address)?;
            Some((set, operand.span, Some(address)))
        }
        _ => None,
    });
    mnemonic.into_iter().chain(operands)
}

/// An address without the sign of a pointer.
fn bare(word: &str) -> &str {
    word.trim_start_matches(['*', '&'])
}

fn set_of_mnemonic(word: &str, op: Op) -> Option<Set> {
    match is_german(word) {
        true => Some(Set::German),
        false => ONLY_INTERNATIONAL.contains(&op).then_some(Set::International),
    }
}

/// The set by the letters of an address; `None` where they are the same in both. A symbol may begin
/// with such a letter.
fn set_of_address(word: &str, address: Address) -> Option<Set> {
    let (at, letters) = letters(address)?;
    let letter = word.as_bytes().get(at)?.to_ascii_uppercase();
    match letter {
        _ if letter == letters[0] => Some(Set::International),
        _ if letter == letters[1] => Some(Set::German),
        _ => None,
    }
}

/// Where the letter is that differs, and what it is in both sets: of area and size the first or the
/// second.
fn letters(address: Address) -> Option<(usize, [u8; 2])> {
    Some(match address {
        Address::Bit { area: Area::I, .. }
        | Address::Byte { area: Area::I, .. }
        | Address::Word { area: Area::I, .. }
        | Address::Double { area: Area::I, .. } => (0, *b"IE"),
        Address::Bit { area: Area::Q, .. }
        | Address::Byte { area: Area::Q, .. }
        | Address::Word { area: Area::Q, .. }
        | Address::Double { area: Area::Q, .. } => (0, *b"QA"),
        Address::Counter(_) => (0, *b"CZ"),
        Address::HighSpeedCounter(_) => (1, *b"CZ"),
        Address::Analog(AnalogInput::Scaled(_)) => (1, *b"IE"),
        Address::AnalogOutput(_) => (1, *b"QA"),
        _ => return None,
    })
}

/// Whether the program is written with German mnemonics; `None` if nothing in it tells.
pub(crate) fn written_in(text: &str, program: &Program) -> Option<bool> {
    let mut sets = program.statements.iter().filter_map(|statement| match statement {
        Statement::Instruction(instruction) => words(text, instruction).find_map(|word| {
            let (set, span, address) = word;
            let is_written =
                address.is_none_or(|address| Address::parse(bare(span.text(text))) == Ok(address));
            is_written.then_some(set)
        }),
        _ => None,
    });
    sets.next().map(|set| set == Set::German)
}

/// Whether a word that was not understood is German; `None` if it is nothing that tells.
pub(crate) fn is_german_word(word: &str) -> Option<bool> {
    let address = Address::parse(bare(word)).ok()?;
    set_of_address(bare(word), address).map(|set| set == Set::German)
}

/// An address with German letters.
pub(crate) fn german_address(address: Address) -> String {
    AddressWords { is_german: true }.address(address)
}

/// Writes values in a program's set.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct AddressWords {
    is_german: bool,
}

impl AddressWords {
    /// As the program is written; international if nothing in it tells.
    pub(crate) fn of(text: &str, program: &Program) -> AddressWords {
        AddressWords { is_german: written_in(text, program) == Some(true) }
    }

    /// An operand as text; `None` of texts and of what is no value.
    pub(crate) fn value(self, value: &Value) -> Option<String> {
        Some(match value {
            Value::Address(address) => self.address(*address),
            Value::Indirect(address) => format!("*{}", self.address(*address)),
            Value::AddressOf(address) => format!("&{}", self.address(*address)),
            Value::Constant(constant) if constant.is_pattern && constant.value >= 0 => {
                format!("16#{:X}", constant.value)
            }
            Value::Constant(constant) => constant.value.to_string(),
            Value::Real(bits) => format!("{:?}", f32::from_bits(*bits)),
            Value::Unit(unit) => unit.to_string(),
            Value::Text(_) | Value::Invalid => return None,
        })
    }

    fn address(self, address: Address) -> String {
        let mut text = address.to_string();
        if let (Some((at, [_, german])), true) = (letters(address), self.is_german) {
            text.replace_range(at..=at, char::from(german).encode_utf8(&mut [0; 4]));
        }
        text
    }
}

fn mix(
    text: &str,
    of_program: Set,
    place: Span,
    span: Span,
    instruction: &Instruction,
) -> Diagnostic {
    let word = span.text(text);
    let other = if of_program == Set::German { Set::International } else { Set::German };
    let message = format!(
        "{word} is {}, but the program is written with {} mnemonics",
        other.name(),
        of_program.name()
    );
    let mut diagnostic = Diagnostic::new(Code::MixedMnemonics, span, message)
        .related(place, "as here")
        .help("Micro/WIN reads a file in the one set or in the other");
    if span == instruction.mnemonic_span {
        let relation = instruction.relation.map_or("", |relation| relation.symbol());
        let (first, rest) = match of_program {
            Set::International => ("", instruction.mnemonic()),
            Set::German => ("U", instruction.mnemonic().get(1..).unwrap_or("")),
        };
        diagnostic = diagnostic.suggest(format!("{first}{rest}{relation}"));
    } else if of_program == Set::International
        && let Ok(address) = Address::parse(word)
    {
        diagnostic = diagnostic.suggest(address.to_string());
    }
    diagnostic
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use crate::text::parser::parse;

    fn warnings(text: &str) -> Vec<String> {
        let source = Source::new("t", text).unwrap();
        let (program, errors) = parse(&source, Vec::new());
        assert!(errors.is_empty(), "{text}: {errors:?}");
        let mut diagnostics = Vec::new();
        check(text, &program, &mut diagnostics);
        let shown = diagnostics.iter().map(|diagnostic| {
            let (line, column) = source.position(diagnostic.span.start as usize);
            format!(
                "{line}:{column} {} -> {:?}",
                diagnostic.message,
                diagnostic.suggestion.as_deref().unwrap_or("")
            )
        });
        shown.collect()
    }

    #[test]
    fn one_set_is_no_mix() {
        assert_eq!(
            warnings("LD I0.0\nA M0.0\nAW= C5, 5\nAB= QB0, 1\n= Q0.0\nMOVW AIW0, MW0"),
            [""; 0]
        );
        assert_eq!(
            warnings("LD E0.0\nU M0.0\nUW= Z5, 5\nUB= AB0, 1\n= A0.0\nMOVW AEW0, MW0"),
            [""; 0]
        );
        assert_eq!(warnings("LD M0.0\nO T37\nLPS\nNOT\n= V0.0\nTON T37, 5"), [""; 0]);
    }

    #[test]
    fn a_mix_is_reported_once() {
        assert_eq!(
            warnings("LD I0.0\nU M0.0\n= A0.0"),
            ["2:1 U is German, but the program is written with international mnemonics -> \"A\""]
        );
        assert_eq!(
            warnings("LD E0.0\nAW>= MW0, 5\n= A0.0"),
            ["2:1 AW>= is international, but the program is written with German mnemonics -> \
                 \"UW>=\""]
        );
        assert_eq!(
            warnings("LD M0.0\nA M0.1\n= A0.0"),
            ["3:3 A0.0 is German, but the program is written with international mnemonics -> \
                 \"Q0.0\""]
        );
        assert_eq!(warnings("LD E0.0\n= Q0.0").len(), 1);
    }

    #[test]
    fn symbols_belong_to_no_set() {
        assert_eq!(
            warnings(
                "//# symbol E1 I0.0\n//# symbol Z1 Q0.0\n//# symbol Any Q0.1\nLD E1\nA I0.1\n\
                 = Z1\n= Any"
            ),
            [""; 0]
        );
    }
}
