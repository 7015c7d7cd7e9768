//! Lines that are no instruction as a whole: expressions of structured text, drawings of ladders,
//! an operand by itself. Calls with brackets have a module of their own.

use plc_isa::{Area, Op, TimerKind};

use super::calls::called;
use super::counts;
use super::expression::{self, Token, listed, operand};
use super::operands;
use super::row::{Instead, Meant, told};
use super::width::{self, Width};
use super::words::find;
use crate::text::address::Address;
use crate::text::ast::{Type, UnitId, UnitKind};
use crate::text::directive_table;

const DRAWING: &str = "a drawn ladder cannot be read: a contact is `LD I0.0` or `A I0.0`, a \
     contact that is normally closed `AN I0.0`, a branch `O I0.1`, a coil `= Q0.0`";
const COMMENT: &str = "a comment begins with //";
const SETTING: &str = "a setting begins with `//#`, without a blank: `//# symbol Start I0.0`";
const COMPARE: &str = "a comparison is a contact with both operands, such as `LDW>= VW0, 5`; \
     `AW>=` and `OW>=` go on from there";
const EXPRESSION_OF_BITS: &str = "AWL has no expressions: each contact is an instruction on a line \
     of its own, such as `LD I0.0`, `A I0.1`, then `= Q0.0`";
const EXPRESSION: &str = "AWL has no expressions: `MOVW VW2, VW0` copies, `+I 1, VW0` adds to VW0, \
     `LDW> VW0, 5` compares, each on a line of its own";
const COMMAS: &str = "operands are separated by commas, and the target is the last: `MOVW 5, VW0`";
const NEEDS_CONTACT: &str = "it executes while the contact before it is 1; `LD SM0.0` always is";
/// What blocks of other systems call their parameters.
const PARAMETERS: [&str; 10] = ["IN", "PT", "Q", "ET", "CU", "CD", "PV", "CV", "EN", "ENO"];
const INSTANCE: &str = "an S7-200 has no instances of blocks: the inputs of a timer or counter are \
     the contacts before it, `LD I0.0`, `TON T37, 20`, and `LD T37` is its output; a subroutine is \
     called by `CALL SBR0`";
const NO_NAMES: &str = "operands have an order and no names: `LD I0.0`, `TON T37, 20`, and \
     `LD T37` is what comes out";
const LOOP: &str = "AWL loops with `FOR VW0, 1, 10` and `NEXT`, after a contact such as `LD SM0.0`";

/// Whether an instruction of the S7-200 is written as in structured text: with brackets or `:=`
/// after its name.
pub(crate) fn is_structured(rest: &str) -> bool {
    let rest = rest.trim_start();
    rest.starts_with('(') && !rest.starts_with("(*")
        || rest.contains(":=") && !rest.contains('"')
        || rest.contains('=')
            && rest.as_bytes().windows(4).any(|word| word.eq_ignore_ascii_case(b" TO "))
}

/// What a line was meant to be; `None` where its first word says it.
pub(super) fn meant(word: &str, rest: &str) -> Option<Meant> {
    if let Some(call) =
        ["CAL", "CALC"].iter().any(|cal| cal.eq_ignore_ascii_case(word)).then(|| rest.trim())
    {
        let name_len = call.find(['(', ' ']).unwrap_or(call.len());
        let (name, inside) = call.split_at(name_len);
        return Some(match inside.trim_start().starts_with('(') {
            true => called(name, inside.trim()),
            false => told(INSTANCE),
        });
    }
    if let Some(help) = member_of_instance(word, rest.trim()) {
        return Some(told(help));
    }
    if rest.trim().is_empty() {
        let load = [("SET", "LD"), ("CLR", "LDN")].into_iter();
        let mut load =
            load.filter(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, load)| load);
        if let Some(load) = load.next() {
            let instead = Some(Instead::Line(format!("{load} SM0.0")));
            return Some(Meant { instead, help: Vec::new(), stand_in: Some(load.to_owned()) });
        }
    }
    let line = format!("{word}{rest}");
    let line = line.trim();
    if let Some(coil) = coil(line) {
        return Some(coil);
    }
    if let Some(help) = drawing(line) {
        return Some(told(help));
    }
    if rest.trim_start().starts_with('(') {
        return Some(called(word, rest.trim()));
    }
    if word.eq_ignore_ascii_case("CALL") && rest.contains(":=") && !rest.contains('(') {
        let values: Vec<&str> = rest
            .split(',')
            .map(|one| one.split_once(":=").map_or(one, |(_, value)| value).trim())
            .collect();
        return Some(Meant {
            instead: Some(Instead::Line(format!("CALL {}", values.join(", ")))),
            help: vec!["parameters follow in their order, without their names".to_owned()],
            stand_in: None,
        });
    }
    if word.eq_ignore_ascii_case("FOR") && is_structured(rest) {
        return Some(counted_loop(rest));
    }
    started(word, rest)
        .or_else(|| sign_apart(word, rest))
        .or_else(|| compound(line))
        .or_else(|| loaded_time(word, rest))
        .or_else(|| joined(word, rest))
        .or_else(|| declared(line))
        .or_else(|| assignment(line))
        .or_else(|| compared(line))
        .or_else(|| signed(word, rest))
        .or_else(|| operand_first(line))
        .or_else(|| (find(word).is_none() && is_structured(rest)).then(|| told(COMMAS)))
}

/// `ST Delay.IN`: the parameter of a block is written or read like a variable.
fn member_of_instance(word: &str, operand: &str) -> Option<&'static str> {
    let is_list = ["ST", "STN", "S", "R"].iter().any(|name| name.eq_ignore_ascii_case(word));
    let (name, member) = operand.rsplit_once('.')?;
    let is_name = name.starts_with(char::is_alphabetic) && !name.contains([' ', ',']);
    let is = |names: &[&str]| names.iter().any(|known| known.eq_ignore_ascii_case(member));
    (is_list && is_name && is(&PARAMETERS)).then_some(INSTANCE)
}

/// `FOR VW0 := 1 TO 10 DO`
fn counted_loop(rest: &str) -> Meant {
    let upper = rest.to_ascii_uppercase();
    let parts = || {
        let (index, range) = upper.split_once('=')?;
        let (first, last) = range.split_once(" TO ")?;
        let last = last.trim().trim_end_matches([';', ':']).trim().trim_end_matches(" DO");
        let parts = [index.trim_end_matches(':'), first, last].map(str::trim);
        let is_one = |part: &&str| !part.is_empty() && !part.contains([' ', '(', ',']);
        parts.iter().all(is_one).then(|| format!("FOR {}", parts.join(", ")))
    };
    let instead = parts().map(Instead::Line);
    Meant { instead, help: vec![LOOP.to_owned()], stand_in: Some("FOR".to_owned()) }
}

/// `OUT T0 K50`: timers and counters that are written like a coil.
fn started(word: &str, rest: &str) -> Option<Meant> {
    let mut operands = rest.split([',', ' ', '\t']).filter(|part| !part.is_empty());
    let (target, preset, None) = (operands.next()?, operands.next()?, operands.next()) else {
        return None;
    };
    let preset: u16 = preset.trim_start_matches(['K', 'k', '#']).parse().ok()?;
    let is_coil = ["OUT", "ST", "="].iter().any(|name| name.eq_ignore_ascii_case(word));
    match Address::parse(target).ok().filter(|_| is_coil)? {
        Address::Timer(_) => Some(told(format!(
            "a timer is started by `TON T37, {preset}`, {preset} times 100 ms, after the contact \
             that is its input; `LD T37` is its bit"
        ))),
        counter @ Address::Counter(_) => Some(told(format!(
            "a counter is `LD I0.0` for what it counts, `LD I0.1` for its reset, `CTU {counter}, \
             {preset}`"
        ))),
        _ => None,
    }
}

/// `+ I VW0, VW2` and `I+ VW0, VW2` for `+I VW0, VW2`.
fn sign_apart(word: &str, rest: &str) -> Option<Meant> {
    let is_sign = |text: &str| matches!(text, "+" | "-" | "*" | "/");
    let is_letter = |text: &str| ["I", "D", "R"].iter().any(|one| one.eq_ignore_ascii_case(text));
    let (next, operands) = rest.trim_start().split_at_checked(1)?;
    let (sign, letter) = match (is_sign(word) && is_letter(next), is_letter(word) && is_sign(next))
    {
        (true, _) => (word, next),
        (_, true) => (next, word),
        _ => return None,
    };
    let is_apart = operands.starts_with([' ', '\t']) && operands.contains(',');
    is_apart.then(|| Meant {
        instead: Some(Instead::Line(format!(
            "{sign}{} {}",
            letter.to_ascii_uppercase(),
            operands.trim()
        ))),
        help: Vec::new(),
        stand_in: None,
    })
}

/// `VW0++` and `VW0 += 5`, as the assignments that they are short for.
fn compound(line: &str) -> Option<Meant> {
    let line = line.trim_end_matches(';').trim_end();
    for (signs, sign) in [("++", '+'), ("--", '-')] {
        if let Some(target) = line.strip_suffix(signs) {
            let target = target.trim();
            return assignment(&format!("{target} := {target} {sign} 1"));
        }
    }
    let (left, value) = line.split_once('=')?;
    let sign = left.chars().last().filter(|sign| "+-*/".contains(*sign))?;
    let target = left[..left.len() - 1].trim();
    Width::of_operand(target)?;
    assignment(&format!("{target} := {target} {sign} {value}"))
}

/// `L S5T#2S` before the start of a timer.
fn loaded_time(word: &str, rest: &str) -> Option<Meant> {
    let ms = operands::milliseconds(rest.trim()).filter(|_| word.eq_ignore_ascii_case("L"))?;
    let (timer, counts) = counts::of(Op::Ton, None, ms)?;
    Some(told(format!(
        "on an S7-200 the time is the preset of the timer, in its counts: `TON T{timer}, {counts}`"
    )))
}

/// Two words that are one mnemonic here: `AND NOT I0.0`, `OR LD`.
fn joined(word: &str, rest: &str) -> Option<Meant> {
    let rest = rest.trim();
    let (second, operand) = rest.split_once([' ', '\t']).unwrap_or((rest, ""));
    let first = match expression::tokens(word).as_slice() {
        [Token::And] => "A",
        [Token::Or] => "O",
        _ => return None,
    };
    let line = match expression::tokens(second).as_slice() {
        [Token::Not] => format!("{first}N {operand}"),
        _ if second.eq_ignore_ascii_case("LD") && first == "A" => "ALD".to_owned(),
        _ if second.eq_ignore_ascii_case("LD") => "OLD".to_owned(),
        _ => return None,
    };
    if operand.starts_with(|c: char| c.is_ascii_digit()) {
        return Some(told("an address begins with its area, such as `AN I0.0` or `ON Q0.0`"));
    }
    let stand_in = line.split(' ').next().map(str::to_owned);
    Some(Meant { instead: Some(Instead::Line(line)), help: Vec::new(), stand_in })
}

/// Whether a text begins with the word of a setting.
fn is_setting(text: &str) -> bool {
    let word = text.split([' ', '\t']).next().unwrap_or_default();
    directive_table::WORDS.iter().any(|known| known.eq_ignore_ascii_case(word))
}

/// `== Q0.0`, `-> Q0.0` and `(Q0.0)`: a coil with another sign.
fn coil(line: &str) -> Option<Meant> {
    let inside = line.strip_prefix('(').and_then(|inside| inside.strip_suffix(')'));
    let signs = ["==", "=>", "->", "=:", ":="];
    let bit = inside.or_else(|| signs.iter().find_map(|sign| line.strip_prefix(sign)))?.trim();
    // `==I` is a comparison of STEP 7.
    let is_name = || line.contains(' ') && operand(bit).is_some() && inside.is_none();
    let is_bit = Width::of_operand(bit) == Some(Width::Bit) || is_name();
    is_bit.then(|| Meant {
        instead: Some(Instead::Line(format!("= {bit}"))),
        help: Vec::new(),
        stand_in: Some("=".to_owned()),
    })
}

/// Lines of a drawn ladder, and of comments with the sign of another language.
fn drawing(line: &str) -> Option<&'static str> {
    let is_drawn = line.starts_with(['|', '-', '[', '(', '├', '│', '─', '┤']);
    let has = |part: &&str| line.contains(*part);
    let wires = ["--", "| |", "|/|", "[ ]", "]-", "-[", "-(", "──", "|-", "-|"];
    if is_drawn && wires.iter().any(has) && line.contains(['|', '[', '(', '─']) {
        return Some(DRAWING);
    }
    let setting = line.strip_prefix("/#").or(line.strip_prefix('#')).map(str::trim_start);
    if setting.is_some_and(is_setting) {
        return Some(SETTING);
    }
    let signs = ["--", "**", "==", "##", "# ", "'", "%%", "!", "/ ", "\\"];
    let is_comment = signs.iter().any(|sign| line.starts_with(sign))
        && find(line.split([' ', '\t']).next().unwrap_or_default()).is_none();
    is_comment.then_some(COMMENT)
}

/// `Speed : INT;`
fn declared(line: &str) -> Option<Meant> {
    let (name, kind) = line.split_once(':')?;
    let kind = kind.trim().split([' ', ';', ':', '(', '[']).next()?;
    let is_type = Type::NAMES.iter().any(|(known, _)| known.eq_ignore_ascii_case(kind))
        || ["TIME", "ARRAY", "TON", "TOF"].iter().any(|known| known.eq_ignore_ascii_case(kind));
    let name = operand(name.trim())?;
    is_type.then(|| {
        told(format!(
            "a variable is declared by `//# var {name} {}`, in a subroutine between VAR and \
             END_VAR",
            kind.to_uppercase()
        ))
    })
}

/// `VW0 := VW0 + 1` and `Q0.0 = I0.0 AND I0.1`.
fn assignment(line: &str) -> Option<Meant> {
    let (target, value) = match line.split_once(":=") {
        Some(parts) => parts,
        None => {
            let at = line.find('=')?;
            let is_relation = line[..at].ends_with(['<', '>', '=', '!'])
                || line[at + 1..].starts_with(['=', '>', '<']);
            if is_relation {
                return None;
            }
            (&line[..at], &line[at + 1..])
        }
    };
    // `LDX= VW0, 5`
    if value.contains(',') && !line.contains(":=") {
        return None;
    }
    let target = operand(target.trim())?;
    if PARAMETERS.iter().any(|name| name.eq_ignore_ascii_case(&target)) {
        return Some(told(NO_NAMES));
    }
    // `TITLE = Motor`
    if target.len() > 2 && find(&target).is_some() {
        return None;
    }
    if value.trim().is_empty() {
        return Some(told(
            "an instruction begins with its mnemonic, and operands follow: `MOVW 5, VW0`",
        ));
    }
    let tokens = expression::tokens(value.trim_end_matches(';'));
    let is_logic = tokens.iter().any(Token::is_logic);
    let width = match Width::of_operand(&target) {
        // The bit of a timer is not written.
        Some(width) => Some(width),
        None if is_logic => Some(Width::Bit),
        None => width::of(value),
    };
    let code = match width {
        Some(Width::Bit) => expression::coil(&target, &tokens),
        Some(width) => expression::value(&target, width, &tokens),
        None => None,
    };
    Some(match code.as_deref() {
        Some([one]) => Meant {
            instead: Some(Instead::Line(one.clone())),
            help: vec![NEEDS_CONTACT.to_owned()],
            stand_in: None,
        },
        Some(code) if width != Some(Width::Bit) => {
            Meant { help: vec![listed(code), NEEDS_CONTACT.to_owned()], ..Meant::default() }
        }
        Some(code) => told(listed(code)),
        None if width == Some(Width::Bit) => told(EXPRESSION_OF_BITS),
        None => told(EXPRESSION),
    })
}

/// `VW0 >= 5`
fn compared(line: &str) -> Option<Meant> {
    let at = line.find(['<', '>', '=', '!'])?;
    let sign_len = line[at..].bytes().take_while(|byte| b"<>=!".contains(byte)).count();
    let (left, relation, right) =
        (line[..at].trim(), &line[at..at + sign_len], line[at + sign_len..].trim());
    let width = Width::of_operand(left);
    // A misspelt mnemonic of a comparison is no operand.
    width?;
    let is_number = right.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    if let Some(code) = compared_with_sum(line, left, relation, right) {
        return Some(told(listed(&code)));
    }
    if relation == "=" || right.contains([' ', ',']) || operand(right).is_none() && !is_number {
        return Some(told(COMPARE));
    }
    let left = operand(left)?;
    Some(Meant {
        instead: Some(Instead::Line(comparison(width::of(line), relation, &left, right))),
        help: vec![COMPARE.to_owned()],
        stand_in: None,
    })
}

/// `VW0 > VW2 + 1`: what is calculated comes first.
fn compared_with_sum(line: &str, left: &str, relation: &str, right: &str) -> Option<Vec<String>> {
    let (left, width) = (operand(left)?, width::of(line)?);
    let sum = expression::value("AC0", width, &expression::tokens(right))?;
    let compare = comparison(Some(width), relation, &left, "AC0");
    let is_sum = sum.len() > 1;
    is_sum.then(|| ["LD SM0.0".to_owned()].into_iter().chain(sum).chain([compare]).collect())
}

/// `+VW0`: a sign with an operand, and no instruction.
fn signed(word: &str, rest: &str) -> Option<Meant> {
    let (sign, name) = word.split_at_checked(1)?;
    let width = Width::of_operand(name).filter(|_| rest.trim().is_empty())?;
    let what = match sign {
        "+" => "adds to",
        "-" => "subtracts from",
        "*" => "multiplies",
        "/" => "divides",
        _ => return None,
    };
    let letter = width.of_all(["", "", "I", "D", "R"]);
    let name = operand(name)?;
    let target = if width == Width::Double { "VD10" } else { "VW10" };
    let target = if name == target { "AC0" } else { target };
    (!letter.is_empty()).then(|| {
        told(format!(
            "an instruction names both operands, and the second is the result: `{sign}{letter} \
             {name}, {target}` {what} {target}"
        ))
    })
}

/// What a comparison is that other controllers have in another form, such as `VW0 >= 5`.
fn comparison(width: Option<Width>, relation: &str, left: &str, right: &str) -> String {
    let relation = match relation {
        "==" => "=",
        "!=" => "<>",
        "=>" => ">=",
        "=<" => "<=",
        other => other,
    };
    let letter = width.map_or("W", Width::letter);
    format!("LD{letter}{relation} {left}, {right}")
}

/// A line that begins with an operand, or is only one.
fn operand_first(line: &str) -> Option<Meant> {
    let tokens = expression::tokens(line);
    let [first, rest @ ..] = tokens.as_slice() else { return None };
    let address = Address::parse(first.text().trim_start_matches('%')).ok();
    let name = operand(first.text())?;
    if let (true, Some(unit)) = (rest.is_empty(), UnitId::parse(&name)) {
        return routine(unit);
    }
    if rest.is_empty() {
        return Some(told(single(&name, address?)));
    }
    if address.is_none() && (!rest.iter().any(Token::is_logic) || find(&name).is_some()) {
        return None;
    }
    Some(told(match expression::contacts(&tokens) {
        Some(code) => listed(&code),
        None => format!(
            "an instruction begins with its mnemonic and operands follow, such as {}",
            example(&name, address)
        ),
    }))
}

fn example(name: &str, address: Option<Address>) -> String {
    match address.and_then(Width::of_address) {
        Some(Width::Bit) | None => format!("`LD {name}`"),
        Some(width) => format!("`LD{}> {name}, 5`", width.letter()),
    }
}

/// A subroutine or interrupt routine by itself.
fn routine(unit: UnitId) -> Option<Meant> {
    match unit.kind {
        UnitKind::Subroutine => Some(told(format!(
            "a subroutine is called by `CALL {unit}`; its text begins with \
             `SUBROUTINE_BLOCK Name:{unit}`"
        ))),
        UnitKind::Interrupt => Some(told(format!(
            "an interrupt routine is attached by `ATCH {unit}, 0`; its text begins with \
             `INTERRUPT_BLOCK Name:{unit}`"
        ))),
        UnitKind::Main => None,
    }
}

/// What to write for an operand by itself.
fn single(name: &str, address: Address) -> String {
    let ways = match address {
        Address::Bit { area: Area::I, .. } => format!("`LD {name}`"),
        Address::Bit { .. } => format!("`LD {name}` to read it or `= {name}` to write it"),
        Address::Timer(number) => {
            let mnemonic = if TimerKind::OnDelay.fits(number) { "TON" } else { "TONR" };
            format!("`LD {name}` to read it or `{mnemonic} {name}, 20` to start it")
        }
        Address::Counter(_) => format!("`LD {name}` to read it or `CTU {name}, 10` to count"),
        Address::Analog(_) => {
            format!("`LDW> {name}, 16000` to compare it or `MOVW {name}, VW0` to copy it")
        }
        Address::AnalogOutput(_) => format!("`MOVW 16000, {name}` to write it"),
        Address::HighSpeedCounter(_) => {
            format!("`LDD> {name}, 5` to compare it or `MOVD {name}, VD0` to copy it")
        }
        Address::Byte { .. }
        | Address::Word { .. }
        | Address::Double { .. }
        | Address::Accumulator(_) => {
            let letter = Width::of_address(address).map_or("W", Width::letter);
            format!("`LD{letter}> {name}, 5` to compare it or `MOV{letter} 5, {name}` to write it")
        }
    };
    format!("an instruction begins with its mnemonic, such as {ways}")
}
