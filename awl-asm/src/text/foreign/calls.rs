//! Calls with brackets after their name, as other languages have them: timers, counters, bistable
//! blocks, instructions and routines. What is no call is read elsewhere.

use plc_isa::Op;

use super::counts;
use super::expression::{self, Token, listed, operand};
use super::operands;
use super::row::{Here, Instead, Meant, told};
use super::words::find;
use crate::text::address::Address;
use crate::text::mnemonics::{self, Meaning};

/// A word with a bracket after it: `A(`, `TON(IN := I0.0, PT := 20)`.
pub(super) fn called(word: &str, rest: &str) -> Meant {
    let inside = rest.trim_start_matches('(').trim_end_matches(';').trim_end_matches(')').trim();
    if let Some(meant) = opened(word, rest, inside) {
        return meant;
    }
    let bracket = find(&format!("{word}("));
    if let Some(row) = bracket.filter(|_| inside.is_empty()) {
        return row.meant("");
    }
    let upper = word.to_ascii_uppercase();
    match (upper.as_str(), Address::parse(word)) {
        ("TON" | "TOF" | "TONR", _) => timer(&upper, None, inside),
        (_, Ok(timer_bit @ Address::Timer(_))) => timer("TON", Some(timer_bit), inside),
        ("CTU" | "CTD" | "CTUD", _) => counter(&upper, "C1", inside),
        (_, Ok(Address::Counter(_))) => counter("CTU", &upper, inside),
        _ => plain_call(word, inside),
    }
}

/// `AND( I0.1`: a bracket with its first contact, which a later line closes.
fn opened(word: &str, rest: &str, inside: &str) -> Option<Meant> {
    let joins = match expression::tokens(word).as_slice() {
        [Token::And] => "ALD",
        [Token::Or] => "OLD",
        _ => return None,
    };
    (!inside.is_empty() && !rest.contains(')')).then(|| {
        told(format!(
            "AWL has no brackets: what is inside begins with `LD {inside}`, and `{joins}` is where \
             the bracket is closed"
        ))
    })
}

/// The value of a parameter in `IN := I0.0, PT := 20`.
fn argument(inside: &str, names: &[&str]) -> Option<String> {
    inside.split(',').find_map(|argument| {
        let (name, value) = argument.split_once(":=")?;
        let is = names.iter().any(|known| known.eq_ignore_ascii_case(name.trim()));
        is.then(|| operand(value.trim()).unwrap_or_else(|| value.trim().to_owned()))
    })
}

/// The inputs of a bistable block.
fn set_and_reset(inside: &str) -> Option<String> {
    let set = argument(inside, &["S", "S1", "SET", "SET1"])?;
    let reset = argument(inside, &["R", "R1", "RESET", "RESET1"])?;
    Some(format!(
        "a bit is set and reset by two rungs, of which the later one wins: `LD {set}`, `S Q0.0, \
         1`, then `LD {reset}`, `R Q0.0, 1`"
    ))
}

fn timer(mnemonic: &str, named: Option<Address>, inside: &str) -> Meant {
    let op = match mnemonic {
        "TOF" => Op::Tof,
        "TONR" => Op::Tonr,
        _ => Op::Ton,
    };
    let wanted = match named {
        Some(Address::Timer(number)) => Some(number),
        _ => None,
    };
    let usual = wanted.unwrap_or(if op == Op::Tonr { 5 } else { 37 });
    let input = argument(inside, &["IN"]).unwrap_or_else(|| "I0.0".to_owned());
    let preset = argument(inside, &["PT"]);
    let plain = preset.as_deref().and_then(|text| text.parse::<u16>().ok());
    let (timer, counts) = match plain {
        Some(counts) => (usual, counts),
        None => preset
            .and_then(|text| counts::of(op, wanted, operands::milliseconds(&text)?))
            .unwrap_or((usual, 20)),
    };
    told(format!(
        "AWL has no brackets, and the input of a timer is the contact before it: `LD {input}`, \
         `{mnemonic} T{timer}, {counts}`; `LD T{timer}` is its output"
    ))
}

fn counter(mnemonic: &str, name: &str, inside: &str) -> Meant {
    let input = |names: &[&str], otherwise: &str| {
        argument(inside, names).unwrap_or_else(|| otherwise.to_owned())
    };
    let up = input(&["CU"], "I0.0");
    let down = input(&["CD"], if mnemonic == "CTUD" { "I0.1" } else { "I0.0" });
    let preset = input(&["PV"], "10");
    let loads = match mnemonic {
        "CTD" => format!("`LD {down}` counts, `LD {}` loads", input(&["LD", "LOAD"], "I0.1")),
        "CTUD" => format!(
            "`LD {up}` counts up, `LD {down}` down, `LD {}` resets",
            input(&["R", "RESET"], "I0.2")
        ),
        _ => format!("`LD {up}` counts, `LD {}` resets", input(&["R", "RESET"], "I0.1")),
    };
    told(format!(
        "AWL has no brackets, and the inputs of a counter are the contacts before it: {loads}, \
         `{mnemonic} {name}, {preset}`"
    ))
}

/// An instruction or routine whose operands are in brackets.
fn plain_call(word: &str, inside: &str) -> Meant {
    const NO_BRACKETS: &str = "operands follow after a blank, without brackets";
    let is_plain = !inside.is_empty() && !inside.contains([':', '(', ')']);
    if let Some(code) = expression::contacts_of(&word.to_uppercase(), inside) {
        return told(listed(&code));
    }
    if let Some(Meaning::Instruction(entry, _)) = mnemonics::meaning(word) {
        let instead = is_plain.then(|| format!("{} {inside}", word.to_uppercase()));
        return Meant {
            instead: instead.map(Instead::Line),
            help: vec![NO_BRACKETS.to_owned()],
            stand_in: Some(entry.mnemonic().to_owned()),
        };
    }
    match find(word) {
        Some(row) => {
            let mut meant = row.meant(inside);
            if !matches!(row.here, Here::Nothing | Here::Block) {
                meant.help.push(NO_BRACKETS.to_owned());
            }
            meant
        }
        // An instance of a block, by the names of its parameters.
        None if argument(inside, &["CLK"]).is_some() => told(format!(
            "an edge is `EU` after the contact: `LD {}`, `EU`; `ED` is the falling one",
            argument(inside, &["CLK"]).unwrap_or_default()
        )),
        None if set_and_reset(inside).is_some() => told(set_and_reset(inside).unwrap_or_default()),
        None if argument(inside, &["PT"]).is_some() => timer("TON", None, inside),
        None if argument(inside, &["PV"]).is_some() => {
            let counter_of = if argument(inside, &["CU"]).is_some() { "CTU" } else { "CTD" };
            counter(counter_of, "C1", inside)
        }
        None => told(
            "a subroutine is called by `CALL SBR0`, and its parameters follow: `CALL SBR0, 5, VW0`",
        ),
    }
}
