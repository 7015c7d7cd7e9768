//! What helps where an operand means nothing: what was probably meant, how a name or routine is
//! declared. That it means nothing is found where operands are settled.

use plc_isa::{Op, TimerKind, Type};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Span, UnitId, UnitKind, Value};
use crate::text::foreign::{self, system_functions};
use crate::text::literal;
use crate::text::mnemonics::{Meaning, meaning};
use crate::text::symbols::written;

/// A sign that looks like one of AWL and is another character.
pub(super) fn look_alike(span: Span, text: &str) -> Option<Diagnostic> {
    let (sign, meant, whole) = foreign::look_alike(text)?;
    let message = format!("{text}: {sign} is another character than {meant}");
    let diagnostic = Diagnostic::new(Code::Syntax, span, message);
    Some(diagnostic.suggest(whole).help(
        "signs that word processors and web pages put in the place of \" ' , - are typed again",
    ))
}

/// An address of this type, and the type as a variable has it.
pub(super) fn example(wanted: Option<Type>) -> (&'static str, &'static str) {
    match wanted {
        None | Some(Type::Bit) => ("M0.0", "BOOL"),
        Some(Type::Byte | Type::Text) => ("VB0", "BYTE"),
        Some(Type::Word) => ("VW0", "INT"),
        Some(Type::Double) => ("VD0", "DINT"),
        Some(Type::Real) => ("VD0", "REAL"),
    }
}

/// How a name is declared that the program has not.
pub(super) fn declaration(name: &str, wanted: Option<Type>, takes_text: bool) -> String {
    if let Some(unit) = UnitId::parse(name) {
        return format!(
            "{unit} is a routine, and only the first operand of its instruction names one"
        );
    }
    if takes_text {
        return format!("a text is in double quotes: `\"{name}\"`");
    }
    if name.starts_with('(') {
        return "a comment begins with //".to_owned();
    }
    let digits = name.strip_prefix(['B', 'b']).unwrap_or("");
    if digits.len() > 2 && digits.chars().all(|c| matches!(c, '0' | '1')) {
        return format!("a binary number is `2#{digits}`");
    }
    if name.contains(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | ' ' | '-'))) {
        return "an address is written like I0.0, Q0.0, M0.0, VB0, VW0 or VD0, a number like 10, \
                16#FF or 1.5; a name has letters, digits and `_`"
            .to_owned();
    }
    let (address, kind) = example(wanted);
    if address == "VB0" && name.chars().count() == 1 {
        return format!(
            "a character is in single quotes, `'{name}'`; a symbol is declared by `//# symbol {name} {address}`"
        );
    }
    let written = written(name);
    format!(
        "a symbol is declared by `//# symbol {written} {address}`, with its own address, or in a \
         table for --symbols; `//# var {written} {kind}` gives it a free one"
    )
}

/// `==I` as in `LD VW0 ==I 5`.
pub(super) fn in_mnemonic(name: &str) -> Option<String> {
    let (relation, width) = foreign::comparison(name)?;
    let letter = width.letter();
    Some(format!("the comparison is part of the mnemonic: `LD{letter}{relation} V{letter}0, 5`"))
}

/// What helps where a program has no routine of a kind.
pub(super) fn none_of(kind: UnitKind, name: &str) -> Vec<String> {
    let (header, end, what, letters) = match kind {
        UnitKind::Interrupt => {
            ("INTERRUPT_BLOCK", "END_INTERRUPT_BLOCK", "interrupt routine", "INT")
        }
        _ => ("SUBROUTINE_BLOCK", "END_SUBROUTINE_BLOCK", "subroutine", "SBR"),
    };
    if let Some(way) = system_functions::way(name) {
        return vec![way];
    }
    // `FC1`, `SBR_1` and `1` are numbers.
    let digits = name.trim_start_matches(|c: char| c.is_alphabetic() || c == '_');
    let is_number = ["", "FC", "FB", "SFC", "SFB", "UP", "SBR_", "INT_", "SBR", "INT"]
        .iter()
        .any(|letters| letters.len() + digits.len() == name.len() && name.starts_with(letters));
    let number = digits.parse::<u8>().ok().filter(|_| is_number);
    let routine = match number {
        Some(number) => format!("Name:{letters}{number}"),
        None => format!("{name}:{letters}0"),
    };
    let mut help = vec![format!(
        "the program has no {what}. With one, all of it is in blocks: `ORGANIZATION_BLOCK \
         MAIN:OB1`, `BEGIN`, the main program, `END_ORGANIZATION_BLOCK`, then `{header} \
         {routine}`, `BEGIN`, its lines, `{end}`, in this file or one that is given with it"
    )];
    let call = if kind == UnitKind::Interrupt { "ATCH" } else { "CALL" };
    let is_written = number.is_some_and(|number| name == format!("{letters}{number}"));
    if let Some(number) = number.filter(|_| !is_written) {
        help.push(format!("it is called by its number, `{call} {letters}{number}`, or its name"));
    }
    help
}

/// What is no routine, but was meant as something else.
pub(super) fn no_routine(kind: UnitKind, name: &str) -> Option<String> {
    let is_number = name.bytes().all(|byte| byte.is_ascii_digit());
    if kind == UnitKind::Interrupt && is_number {
        return Some(format!("the routine is first, then the event: `ATCH INT0, {name}`"));
    }
    if let Some(way) = system_functions::way(name) {
        return Some(way);
    }
    if let Some(unit) = UnitId::parse(name).filter(|unit| unit.kind != kind) {
        return match unit.kind {
            UnitKind::Interrupt => Some(format!(
                "an interrupt routine is not called but attached to an event: `ATCH {unit}, 10`, \
                 and `ENI` permits it"
            )),
            UnitKind::Subroutine => Some(format!(
                "{unit} is a subroutine, which is called: `CALL {unit}`; an interrupt routine is \
                 `INT0`, in `INTERRUPT_BLOCK Name:INT0`"
            )),
            UnitKind::Main => None,
        };
    }
    let Meaning::Instruction(entry, _) = meaning(name)? else { return None };
    let instruction = entry.mnemonic();
    Some(match plc_isa::TimerKind::started_by(entry.op) {
        Some(_) => format!(
            "{instruction} is an instruction: `LD I0.0` is its input, then `{instruction} T37, \
             20`, and `LD T37` its output"
        ),
        None => format!("{instruction} is an instruction of its own, without CALL"),
    })
}

/// What is wrong with the number of a label.
pub(super) fn label(mut diagnostic: Diagnostic, text: &str) -> Diagnostic {
    diagnostic.message = format!("{text}: a label is a number 0 to 255");
    diagnostic.suggestion = label_number(text);
    diagnostic.help = vec!["labels are numbers: `JMP 1` goes to `LBL 1`".to_owned()];
    diagnostic
}

/// A bit, byte or double word of an analog input or output, which are words.
pub(super) fn part_of_analog(span: Span, text: &str) -> Option<Diagnostic> {
    let (letters, number) = text.split_at(text.find(|c: char| c.is_ascii_digit())?);
    let letters = letters.to_ascii_uppercase();
    let has_bit = number.contains('.');
    let (what, prefix) = match (letters.as_str(), has_bit) {
        ("AI" | "AIW" | "AE" | "AEW", true) | ("AIB" | "AID" | "AEB" | "AED", _) => {
            ("input", "AIW")
        }
        ("AQ" | "AQW" | "AA" | "AAW", true) | ("AQB" | "AQD" | "AAB" | "AAD", _) => {
            ("output", "AQW")
        }
        _ => return None,
    };
    let word = Address::parse(&format!("{prefix}{}", number.split('.').next()?)).ok()?;
    let diagnostic = |message: String| Diagnostic::new(Code::AddressRange, span, message);
    if !has_bit {
        return Some(
            diagnostic(format!("{text}: an analog {what} is a word"))
                .suggest(word.to_string())
                .help(match what {
                    "input" => {
                        format!("`MOVW {word}, VW0` copies it, `LDW>= {word}, 16000` compares it")
                    }
                    _ => format!("`MOVW VW0, {word}` writes it"),
                }),
        );
    }
    let diagnostic = diagnostic(format!("{text}: an analog {what} is a word and has no bits"));
    Some(match what {
        "input" => diagnostic.help(format!("compare it, for example `LDW>= {word}, 16000`")),
        _ => diagnostic.help(format!("write all of it, for example `MOVW 16000, {word}`")),
    })
}

const ONE_A_LINE: &str = "one instruction is on a line";

/// Whether an operand is the data block of a call: `DB1`, `IEC_Timer_0_DB`.
pub(super) fn is_block(text: &str) -> bool {
    let upper = text.trim_matches('"').to_ascii_uppercase();
    let digits = upper.strip_prefix("DB").unwrap_or("");
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    is_number || upper.ends_with("_DB")
}

/// Whether a comment was probably meant to begin here.
pub(super) fn is_comment_sign(text: &str) -> bool {
    text.starts_with(['#', '-', '–', '—', '\'', '!', '|', '/', '\\'])
        && !text.contains(char::is_alphanumeric)
}

/// What was probably meant by a sign where an operand should be.
pub(super) fn sign_hint(text: &str, takes_several: bool) -> Option<&'static str> {
    match text {
        ":=" => Some("operands are separated by commas, without signs between them"),
        "=" | "==" if takes_several => {
            Some("operands are separated by commas, such as `TON T37, 20`")
        }
        "=" | "==" => Some(ONE_A_LINE),
        "&" | "*" | "|" | "||" | "&&" => {
            Some("contacts are combined by `A` and `O`, each on a line of its own")
        }
        "<" | ">" | "<=" | ">=" | "<>" => Some("words are compared by LDW> MW0, 5 and its like"),
        "+" => Some("a sign belongs to a number, such as +5; operands are added by `+I VW0, VW2`"),
        _ if is_comment_sign(text) => Some("a comment begins with //"),
        _ => None,
    }
}

/// What was probably meant by a word where an operand should be.
pub(super) fn word_hint(name: &str, wanted: Option<Type>) -> Option<&'static str> {
    let is_binary = name.len() > 3 && name.bytes().skip(1).all(|byte| matches!(byte, b'0' | b'1'));
    let is_number = !matches!(wanted, None | Some(Type::Bit)) && !is_binary;
    if is_number && name.chars().all(|c| c.is_ascii_hexdigit()) {
        return Some(
            "a hexadecimal number is written `16#A`, a character in single quotes, `'A'`; other \
             words are names, which are declared by `//# symbol` or `//# var`",
        );
    }
    if name.eq_ignore_ascii_case("LD") {
        return Some(
            "two branches that begin with LD are joined by `ALD` (and) or `OLD` (or), without an \
             operand",
        );
    }
    if name.eq_ignore_ascii_case("NOT") {
        return Some("LDN, AN and ON take the inverted bit");
    }
    let is_word = foreign::comparison(name).is_none()
        // Small letters alone are names of variables.
        && (name.len() > 1 || name.chars().all(char::is_uppercase))
        && (foreign::is_known(name) || meaning(name).is_some());
    is_word.then_some(ONE_A_LINE)
}

/// A real without the digit before its point: `-.5` as `-0.5`.
pub(super) fn bare_fraction(text: &str) -> Option<String> {
    let (sign, fraction) = text.split_at(text.find('.')?);
    let meant = format!("{sign}0{fraction}");
    let is_real = matches!(literal::parse(&meant), Ok(Value::Real(_)));
    (matches!(sign, "" | "+" | "-") && is_real).then_some(meant)
}

/// Labels have numbers, not names: LBL1 is 1.
pub(super) fn label_number(name: &str) -> Option<String> {
    let (letters, digits) = name.split_at_checked(3)?;
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    (letters.eq_ignore_ascii_case("LBL") && is_number).then(|| digits.to_owned())
}

/// A word after the last operand of an instruction.
pub(super) const TOO_MANY: &str = "the instruction has all its operands before that: a comment \
     begins with //, and another instruction is on a line of its own";

/// A number in quotes, without them.
pub(super) fn quoted_number(name: &str) -> Option<String> {
    let is_number = literal::looks_like_literal(name) && !name.starts_with('\'');
    is_number.then(|| name.to_owned())
}

/// What helps with a number that none is: the form of it, as far as its place or its letters tell.
pub(super) fn number(text: &str, op: Op, diagnostic: &Diagnostic) -> Option<String> {
    if diagnostic.suggestion.is_some() {
        return None;
    }
    let timer = TimerKind::started_by(op).map(|_| Address::Timer(37));
    if let Some(counts) = timer.and_then(|timer| {
        foreign::operands::preset(op, timer, text).and_then(|preset| preset.counts)
    }) {
        return Some(format!("the timer is first, then its counts: `TON T37, {counts}`"));
    }
    if diagnostic.message.contains("T37") {
        return None;
    }
    if let Some(address) = text.split_once('.').filter(|(byte, bit)| {
        let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        is_digits(byte) && is_digits(bit)
    }) {
        return Some(format!(
            "an address begins with its area, such as `I{}.{}`",
            address.0, address.1
        ));
    }
    if let Some(inside) = text.strip_prefix('\'').and_then(|rest| rest.strip_suffix('\'')) {
        return Some(format!("a text is in double quotes: `\"{inside}\"`"));
    }
    if TimerKind::started_by(op).is_some() {
        return Some(
            "a preset is a number of counts, such as 50: of T37, which counts 100 ms, these are 5 s"
                .to_owned(),
        );
    }
    Some(
        "numbers are written like 10, -5, 16#FF, 2#1010 or 1.5; a name begins with a letter".into(),
    )
}

/// What helps where an address has no bit or byte like that.
pub(super) fn out_of_range(text: &str) -> Option<String> {
    let upper = text.to_ascii_uppercase();
    if upper.starts_with("SM") && upper.contains('.') {
        return Some(
            "special bits are SM0.0 (always 1), SM0.1 (the first scan), SM0.4 (a clock of 60 s), \
             SM0.5 (a clock of 1 s), SM1.0 to SM1.2 (of a calculation: zero, overflow, negative)"
                .to_owned(),
        );
    }
    counted_from_one(&upper).or_else(|| foreign::operands::way(text).map(str::to_owned))
}

/// `I1` and `Q3`, as a LOGO! has them.
fn counted_from_one(upper: &str) -> Option<String> {
    let (letter, number) = upper.split_at_checked(1)?;
    let number = number.parse::<u8>().ok().filter(|number| (1..=24).contains(number))?;
    let point = number - 1;
    matches!(letter, "I" | "Q").then(|| {
        format!(
            "points are counted from `{letter}0.0` on, eight a byte: {upper} of a LOGO! is \
             `{letter}{}.{}`",
            point / 8,
            point % 8
        )
    })
}

/// `LDI X0` of other makers is a contact that is inverted.
pub(super) fn immediate_contact(op: Op, name: &str) -> Option<&'static str> {
    let is_foreign = name.starts_with(['X', 'Y', 'x', 'y']);
    (is_foreign && matches!(op, Op::Ldi | Op::Ai | Op::Oi)).then_some(
        "`LDI`, `AI` and `OI` read the input itself and do not invert: the inverted contacts are \
         `LDN`, `AN` and `ON`",
    )
}
