//! The setting `//# modbus`: how the controller is reached on its serial line.

use plc_isa::{LineSettings, Parity, Settings};

use crate::text::ast::Span;
use crate::text::directives::once;
use crate::text::piece::{Outcome, Piece, Targets, unknown};
use crate::text::suggest::Suggester;

/// What the setting `modbus` is followed by, each word with its value.
const MODBUS_WORDS: [&str; 3] = ["address", "baud", "parity"];
/// The values of `parity`.
const PARITIES: [(&str, Parity); 3] =
    [("none", Parity::None), ("even", Parity::Even), ("odd", Parity::Odd)];

/// Reads how the controller is reached on its serial line; every bad word is reported.
pub(super) fn modbus(word: Piece<'_>, list: Piece<'_>, targets: &mut Targets<'_>) {
    if list.text.is_empty() {
        targets
            .diagnostics
            .push(*word.error("address, baud or parity is missing, such as address 5"));
    }
    let mut places = [None; MODBUS_WORDS.len()];
    let mut rest = list;
    while !rest.text.is_empty() {
        let (word, behind) = rest.first_word();
        let (value, last) = behind.first_word();
        // Where the next word follows, the value is missing.
        let is_missing = MODBUS_WORDS.iter().any(|known| value.text.eq_ignore_ascii_case(known));
        let value = if is_missing { behind.split(0).0 } else { value };
        rest = if is_missing { behind } else { last };
        let outcome = modbus_word(word, value, &mut places, targets);
        targets.diagnostics.extend(outcome.err().map(|diagnostic| *diagnostic));
    }
}

/// Sets what a word of the setting `modbus` stands for. `places` are those of the words that have
/// been.
fn modbus_word(
    word: Piece<'_>,
    value: Piece<'_>,
    places: &mut [Option<Span>; MODBUS_WORDS.len()],
    targets: &mut Targets<'_>,
) -> Outcome<()> {
    let Some(index) = MODBUS_WORDS.iter().position(|known| word.text.eq_ignore_ascii_case(known))
    else {
        let mut error = unknown(word, "cannot be set for modbus", &MODBUS_WORDS, targets.suggester);
        if let Some((name, value)) = word.text.split_once(['=', ':'])
            && MODBUS_WORDS.iter().any(|known| name.eq_ignore_ascii_case(known))
        {
            let value = value.trim_start_matches('=');
            error.help = vec!["a value follows its word after a blank".to_owned()];
            error.suggestion = Some(format!("{} {value}", name.to_ascii_lowercase()));
        }
        let is_number = !word.text.is_empty() && word.text.bytes().all(|b| b.is_ascii_digit());
        if is_number && value.text.is_empty() {
            let name = if word.text.len() > 3 { "baud" } else { "address" };
            error.help =
                vec![format!("which number it is, is named: `//# modbus {name} {}`", word.text)];
        }
        return Err(error);
    };
    once(&mut places[index], word.span(), word)?;
    if value.text.is_empty() {
        let example = ["5", "38400", "none"][index];
        let help = format!("such as `//# modbus {} {example}`", word.text);
        return Err(Box::new(word.error("its value is missing").help(help)));
    }
    let settings = &mut targets.program.settings;
    let mut line = LineSettings::of_byte(settings.line);
    match index {
        0 => settings.modbus_address = modbus_address(value)?,
        1 => line.rate = baud(value)?,
        _ => line.parity = parity(value, targets.suggester)?,
    }
    settings.line = line.to_byte();
    Ok(())
}

fn modbus_address(value: Piece<'_>) -> Outcome<u8> {
    let max = Settings::MODBUS_ADDRESS_MAX;
    let address = value.text.parse().ok().filter(|address| (1..=max).contains(address));
    address.ok_or_else(|| {
        let error = value.error(format!("a Modbus address is 1 to {max}"));
        Box::new(error.help("such as `//# modbus address 5`"))
    })
}

/// The index of a rate.
fn baud(value: Piece<'_>) -> Outcome<u8> {
    let asked = value.text.parse::<u32>().ok();
    let rates = LineSettings::RATES;
    (0..).zip(rates).find(|&(_, rate)| asked == Some(rate)).map(|(index, _)| index).ok_or_else(
        || {
            let shown: Vec<String> = rates.iter().rev().map(u32::to_string).collect();
            let mut diagnostic = value.error("the board does not have this rate");
            let nearest =
                asked.and_then(|asked| rates.into_iter().min_by_key(|rate| rate.abs_diff(asked)));
            diagnostic.suggestion = nearest.map(|rate| rate.to_string());
            diagnostic.help.push(format!("there are {}", shown.join(", ")));
            diagnostic
        },
    )
}

fn parity(value: Piece<'_>, suggester: &Suggester) -> Outcome<Parity> {
    let known = PARITIES.into_iter().find(|(name, _)| value.text.eq_ignore_ascii_case(name));
    known.map(|(_, parity)| parity).ok_or_else(|| {
        let words = PARITIES.map(|(name, _)| name);
        unknown(value, "is no parity", &words, suggester)
    })
}
