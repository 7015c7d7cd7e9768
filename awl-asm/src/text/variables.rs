//! The lines `//# var`, `//# timer` and `//# counter`: what they declare, and its symbols. Where it
//! gets its place is not known here.

use plc_isa::{Area, TimerFamily, TimerResolution, timer_family, timer_resolution};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Symbol, Type, Value};
use crate::text::declared::{Declared, Memory, TEXT_LEN_MAX, TEXT_LEN_USUAL, VariableType, Wanted};
use crate::text::literal;
use crate::text::locals::is_same_name;
use crate::text::misdeclared::{keep, several_declarations, several_names, type_first};
use crate::text::piece::{Outcome, Piece, Targets};
use crate::text::suggest::Suggester;
use crate::text::symbols::check_name;

/// Takes a declaration, whose first word is `word`, into the program and its symbols.
pub(crate) fn declare(word: Piece<'_>, rest: Piece<'_>, targets: &mut Targets<'_>) -> Outcome<()> {
    let values = rest.without_comment();
    let comment = rest.text.get(values.text.len()..).unwrap_or("").trim();
    let comment = comment.strip_prefix("//").unwrap_or(comment).trim().to_owned();
    let several = several_names(word, values, targets)
        .or_else(|| several_declarations(word, values, targets));
    if let Some(diagnostic) = several {
        return Err(diagnostic);
    }
    if let Some(diagnostic) = type_first(word, values, targets) {
        return Err(diagnostic);
    }
    let (name, declaration) = name_of(word, values)?;
    let wanted = match word.text.to_ascii_lowercase().as_str() {
        "timer" => timer(name, declaration),
        "counter" => counter(declaration),
        _ => variable(name, declaration, targets.suggester),
    };
    let bare = bare(name);
    check_name(bare, name.span()).map_err(|mut diagnostic| {
        if Address::parse(bare).is_ok() {
            let help = format!("what is declared gets its place by itself: {}", example(word.text));
            diagnostic.help = vec![help];
        }
        diagnostic
    })?;
    let same = |other: &&Declared| is_same_name(&other.name, bare);
    if let Some(first) = targets.program.variables.iter().find(same) {
        let diagnostic =
            Diagnostic::new(Code::Variable, name.span(), format!("{bare}: is declared already"));
        let help = "leave one of the two out, or give it another name";
        return Err(diagnostic.related(first.span, "first declared here").help(help).into());
    }
    // A symbol without a meaning is kept, so that its uses are not called unknown.
    let (wanted, is_retained) = match wanted {
        Ok(wanted) => wanted,
        Err(diagnostic) => {
            keep(bare, name.span(), targets);
            return Err(diagnostic);
        }
    };
    let placed = targets.placed.get(targets.program.variables.len()).copied();
    let has_none = placed == Some(None);
    let address = placed.flatten().unwrap_or_else(|| anywhere(&wanted));
    let span = name.span();
    let declared = Declared { name: bare.to_owned(), wanted, is_retained, address, span };
    define(&declared, comment, has_none, targets);
    targets.program.variables.push(declared);
    Ok(())
}

/// The name of what is declared, and what is after it. A colon may be between them.
fn name_of<'t>(word: Piece<'t>, values: Piece<'t>) -> Outcome<(Piece<'t>, Piece<'t>)> {
    let (first, _) = values.first_word();
    let end = match first.text.starts_with('"') {
        true => first.text.len(),
        false => first.text.find(':').unwrap_or(first.text.len()),
    };
    let name = first.split(end).0;
    if name.text.is_empty() {
        let message = format!("{}: the name is missing", word.text);
        return Err(Diagnostic::new(Code::Variable, word.span(), message)
            .help(example(word.text))
            .into());
    }
    let behind = values.split(name.start + end - values.start).1.trim();
    let after = behind.text.strip_prefix(':').filter(|after| !after.starts_with('='));
    let behind = if after.is_some() { behind.split(1).1.trim() } else { behind };
    Ok((name, behind))
}

fn bare(name: Piece<'_>) -> &str {
    let inside = name.text.strip_prefix('"').and_then(|inside| inside.strip_suffix('"'));
    inside.unwrap_or(name.text)
}

fn example(word: &str) -> &'static str {
    match word.to_ascii_lowercase().as_str() {
        "timer" => "such as `//# timer Delay 10ms`",
        "counter" => "such as `//# counter Parts`",
        _ => "such as `//# var Speed INT := 5`",
    }
}

fn error(piece: Piece<'_>, why: impl AsRef<str>) -> Box<Diagnostic> {
    let message = match piece.text {
        "" => why.as_ref().to_owned(),
        text => format!("{text}: {}", why.as_ref()),
    };
    Box::new(Diagnostic::new(Code::Variable, piece.span(), message))
}

/// Takes a word off the end, if it is this one.
fn without_last<'t>(piece: Piece<'t>, word: &str) -> (Piece<'t>, bool) {
    let at = piece.text.rfind(char::is_whitespace).map_or(0, |at| at + 1);
    let (before, last) = piece.split(at);
    match last.text.eq_ignore_ascii_case(word) {
        true => (before.trim(), true),
        false => (piece, false),
    }
}

// ---- timers and counters

const RESOLUTIONS: [(&str, TimerResolution); 3] = [
    ("1ms", TimerResolution::Ms1),
    ("10ms", TimerResolution::Ms10),
    ("100ms", TimerResolution::Ms100),
];

fn timer(name: Piece<'_>, rest: Piece<'_>) -> Outcome<(Wanted, bool)> {
    let (rest, is_retained) = without_last(rest, "RETAIN");
    let (rest, is_tonr) = without_last(rest, "TONR");
    let (rest, _) = without_last(rest, "TON");
    let found = RESOLUTIONS.iter().find(|(text, _)| rest.text.eq_ignore_ascii_case(text));
    let Some(&(_, resolution)) = found else {
        let piece = if rest.text.is_empty() { name } else { rest };
        let mut resolution = error(piece, "the resolution of a timer is 1ms, 10ms or 100ms");
        let joined: String = rest.text.split_whitespace().collect();
        resolution.suggestion = RESOLUTIONS
            .iter()
            .find(|(text, _)| joined.eq_ignore_ascii_case(text))
            .map(|(text, _)| (*text).to_owned());
        let preset = "its time is the preset where it is started, in counts: `TON Delay, 50`";
        return Err(resolution.help(example("timer")).help(preset).into());
    };
    if is_retained && !is_tonr {
        let why = "only timers of TONR are retained";
        return Err(error(name, why).help("such as `//# timer Runtime 100ms TONR RETAIN`").into());
    }
    let family = if is_tonr { TimerFamily::Tonr } else { TimerFamily::TonTof };
    Ok((Wanted::Timer(family, resolution), is_retained))
}

fn counter(rest: Piece<'_>) -> Outcome<(Wanted, bool)> {
    let (rest, is_retained) = without_last(rest, "RETAIN");
    match rest.text {
        "" => Ok((Wanted::Counter, is_retained)),
        _ => Err(error(rest, "nothing but RETAIN is after the name of a counter")
            .help("its preset is where it counts: `//# counter Parts`, then `CTU Parts, 10`")
            .into()),
    }
}

// ---- variables

fn variable(name: Piece<'_>, rest: Piece<'_>, suggester: &Suggester) -> Outcome<(Wanted, bool)> {
    let rest = rest.text.strip_suffix(';').map_or(rest, |text| rest.split(text.len()).0.trim());
    let (rest, is_retained) = without_last(rest, "RETAIN");
    if let Some(address) = at_address(rest) {
        let bare = bare(name);
        let help = format!("a name for an address is a symbol: `//# symbol {bare} {address}`");
        return Err(error(rest, "a variable gets a free place").help(help).into());
    }
    let (kind, value) = match rest.text.find(":=") {
        Some(at) => (rest.split(at).0.trim(), Some(rest.split(at).1.split(2).1.trim())),
        None => (rest, None),
    };
    if kind.text.is_empty() {
        return Err(error(name, "the type is missing").help(example("var")).into());
    }
    let (kind, array) = array_of(kind, suggester)?;
    let initial = match value {
        None => Vec::new(),
        Some(value) => initial(kind, array, value)?,
    };
    Ok((Wanted::Memory(Memory { kind, array, initial }), is_retained))
}

/// The address of `AT %QX0.0 : BOOL`, where the standard has the place of a variable.
fn at_address(rest: Piece<'_>) -> Option<Address> {
    let mut words = rest.text.split([' ', '\t', ':']).filter(|word| !word.is_empty());
    let is_at = words.next()?.eq_ignore_ascii_case("AT");
    Address::parse(words.next()?.trim_start_matches('%')).ok().filter(|_| is_at)
}

/// What is at the place of a type: that of the value or of each element, and the array's lowest
/// index and length.
fn array_of(
    piece: Piece<'_>,
    suggester: &Suggester,
) -> Outcome<(VariableType, Option<(i64, u16)>)> {
    let is_array = piece.text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case("ARRAY"));
    if !is_array {
        return Ok((single(piece, suggester)?, None));
    }
    let wrong = || {
        error(piece, "an array is declared with its first and last index")
            .help("such as `ARRAY[0..9] OF INT`")
    };
    let bounds = piece.split(5).1.trim();
    let close = bounds.text.find(']').filter(|_| bounds.text.starts_with('['));
    let close = close.ok_or_else(wrong)?;
    let (inside, rest) = (bounds.split(close).0.split(1).1.trim(), bounds.split(close + 1).1);
    let (of, kind) = rest.first_word();
    let (low, high) = inside.text.split_once("..").ok_or_else(wrong)?;
    let (low, high) = (low.trim().parse::<i64>(), high.trim().parse::<i64>());
    let (Ok(low), Ok(high), true) = (low, high, of.text.eq_ignore_ascii_case("OF")) else {
        return Err(wrong().into());
    };
    let kind = single(kind, suggester)?;
    let count = high.checked_sub(low).and_then(|span| span.checked_add(1));
    let count = count.filter(|&count| count > 0).and_then(|count| u16::try_from(count).ok());
    let fits = |count: &u16| {
        let memory = Memory { kind, array: Some((low, *count)), initial: Vec::new() };
        memory.bytes().is_some_and(|bytes| bytes <= Area::V.size().into())
    };
    match count.filter(fits) {
        Some(count) => Ok((kind, Some((low, count)))),
        None => {
            let why = format!("an array has 1 element or more, in {} bytes", Area::V.size());
            Err(error(inside, why))
        }
    }
}

/// Whether a word is a type.
pub(crate) fn is_type(piece: Piece<'_>, suggester: &Suggester) -> bool {
    single(piece, suggester).is_ok()
}

fn single(piece: Piece<'_>, suggester: &Suggester) -> Outcome<VariableType> {
    let is = |word: &str| piece.text.eq_ignore_ascii_case(word);
    let plain = Type::NAMES.iter().filter(|(_, kind)| *kind != Type::Text);
    if let Some(&(_, kind)) = plain.clone().find(|(name, _)| is(name)) {
        return Ok(VariableType::Plain(kind));
    }
    if is("TIME") {
        return Ok(VariableType::Time);
    }
    if piece.text.get(..6).is_some_and(|word| word.eq_ignore_ascii_case("STRING")) {
        return text_type(piece);
    }
    let names: Vec<&str> = plain.map(|&(name, _)| name).chain(["TIME", "STRING"]).collect();
    let mut diagnostic = error(piece, "there is no such type");
    diagnostic.suggestion = elsewhere(piece.text)
        .or_else(|| suggester.nearest(piece.text, names.iter().copied()))
        .map(str::to_owned);
    diagnostic.help.push(match piece.text.split_once('=') {
        Some((kind, value)) => {
            format!("a first value is after `:=`, as in `{} := {}`", kind.trim(), value.trim())
        }
        None if first_value(piece, suggester).is_some() => {
            diagnostic.suggestion = first_value(piece, suggester);
            "a first value is after `:=`".to_owned()
        }
        None if piece.text.contains('[') => {
            let kind = piece.text.split('[').next().unwrap_or_default().trim();
            format!("an array is declared with its first and last index: `ARRAY[0..9] OF {kind}`")
        }
        None if ["TIMER", "TON", "TOF", "TONR"].iter().any(|word| is(word)) => {
            diagnostic.suggestion = None;
            "a timer is declared by `//# timer Delay 100ms`".to_owned()
        }
        None if ["COUNTER", "CTU", "CTD"].iter().any(|word| is(word)) => {
            diagnostic.suggestion = None;
            "a counter is declared by `//# counter Parts`".to_owned()
        }
        None => format!(
            "there are {}, and ARRAY of each; the name is before the type, as in `//# var Speed \
             INT`",
            names.join(", ")
        ),
    });
    Err(diagnostic)
}

/// `INT 5` with the sign between type and first value.
fn first_value(piece: Piece<'_>, suggester: &Suggester) -> Option<String> {
    let (kind, value) = piece.first_word();
    let is_value = literal::looks_like_literal(value.text) && literal::parse(value.text).is_ok();
    (is_value && single(kind, suggester).is_ok())
        .then(|| format!("{} := {}", kind.text, value.text))
}

/// What a type of another language is called here.
fn elsewhere(name: &str) -> Option<&'static str> {
    const NAMES: [(&[&str], &str); 6] = [
        (&["FLOAT", "DOUBLE", "SINGLE", "LREAL"], "REAL"),
        (&["BOOLEAN", "BIT"], "BOOL"),
        (&["SHORT", "INTEGER", "INT16", "INT16_T"], "INT"),
        (&["LONG", "INT32", "INT32_T"], "DINT"),
        (&["UINT", "UINT16", "UINT16_T"], "WORD"),
        (&["USINT", "UINT8", "UINT8_T"], "BYTE"),
    ];
    let is = |other: &&str| other.eq_ignore_ascii_case(name);
    NAMES.iter().find(|(names, _)| names.iter().any(is)).map(|(_, here)| *here)
}

/// `STRING`, `STRING[20]` or `STRING(20)`.
fn text_type(piece: Piece<'_>) -> Outcome<VariableType> {
    let rest = piece.split(6).1.trim();
    if rest.text.is_empty() {
        return Ok(VariableType::Text(TEXT_LEN_USUAL));
    }
    let inside = rest.text.strip_prefix('[').and_then(|inside| inside.strip_suffix(']'));
    let inside =
        inside.or_else(|| rest.text.strip_prefix('(').and_then(|inside| inside.strip_suffix(')')));
    let len = inside.and_then(|inside| inside.trim().parse::<u8>().ok());
    len.filter(|len| (1..=TEXT_LEN_MAX).contains(len)).map(VariableType::Text).ok_or_else(|| {
        error(piece, format!("a text has 1 to {TEXT_LEN_MAX} characters"))
            .help("such as `STRING[20]`")
            .into()
    })
}

// ---- initial values

/// Reads what is after `:=`.
fn initial(
    kind: VariableType,
    array: Option<(i64, u16)>,
    value: Piece<'_>,
) -> Outcome<Vec<Vec<u8>>> {
    let inside = value.text.strip_prefix('[').and_then(|inside| inside.strip_suffix(']'));
    match (array, inside) {
        (None, _) => Ok(vec![bytes(kind, value)?]),
        (Some((_, count)), Some(inside)) => {
            let mut values = Vec::new();
            let mut rest = Some(Piece { text: inside, start: value.start + 1 });
            while let Some(piece) = rest {
                let end = comma(piece.text);
                let (item, behind) = piece.split(end.unwrap_or(piece.text.len()));
                rest = end.map(|_| behind.split(1).1);
                if values.len() == usize::from(count) {
                    return Err(error(item.trim(), format!("the array has {count} elements")));
                }
                values.push(bytes(kind, item.trim())?);
            }
            Ok(values)
        }
        (Some(_), None) => {
            let why = "the values of an array are in brackets";
            Err(error(value, why).help("such as `[1, 2, 3]`").into())
        }
    }
}

/// Where the first comma outside of quotes is.
fn comma(text: &str) -> Option<usize> {
    let mut is_quoted = false;
    text.bytes().position(|byte| {
        is_quoted ^= byte == b'"';
        byte == b',' && !is_quoted
    })
}

/// The bytes of a value; of a bit one byte, 0 or 1.
fn bytes(kind: VariableType, piece: Piece<'_>) -> Outcome<Vec<u8>> {
    if piece.text.is_empty() {
        return Err(error(piece, "a value is missing here"));
    }
    if kind == VariableType::Time
        && let Some(ms) = duration(piece.text)
    {
        return Ok(ms.to_be_bytes().to_vec());
    }
    let value = match literal::truth_value(piece.text) {
        Some(constant) => Value::Constant(constant),
        None => literal::parse(piece.text)
            .map_err(|message| Box::new(Diagnostic::new(Code::Variable, piece.span(), message)))?,
    };
    let refused = || error(piece, format!("is no value of {kind}"));
    let number = |low: i64, high: i64| match value {
        Value::Constant(constant) if (low..=high).contains(&constant.value) => Ok(constant.value),
        _ => {
            let wrong = error(piece, format!("a value of {kind} is {low} to {high}"));
            Err(match larger(&value) {
                Some(other) => Box::new(wrong.help(format!("{other} holds it"))),
                None => wrong,
            })
        }
    };
    // A pattern may use the sign bit as a digit.
    let low_of = |low: i64, high: i64| match value {
        Value::Constant(constant) if constant.is_pattern => (low, 2 * high + 1),
        _ => (low, high),
    };
    let (len, number) = match kind {
        VariableType::Plain(Type::Bool) => (1, number(0, 1)?),
        VariableType::Plain(Type::Byte | Type::Char) => (1, number(0, u8::MAX.into())?),
        VariableType::Plain(Type::Word) => (2, number(0, u16::MAX.into())?),
        VariableType::Plain(Type::Int) => {
            let (low, high) = low_of(i16::MIN.into(), i16::MAX.into());
            (2, number(low, high)?)
        }
        VariableType::Plain(Type::Dword) => (4, number(0, u32::MAX.into())?),
        VariableType::Plain(Type::Dint | Type::Text) | VariableType::Time => {
            let (low, high) = low_of(i32::MIN.into(), i32::MAX.into());
            (4, number(low, high)?)
        }
        VariableType::Plain(Type::Real) => {
            let bits = match value {
                Value::Real(bits) => bits,
                Value::Constant(constant) => (constant.value as f32).to_bits(),
                _ => return Err(refused()),
            };
            (4, bits.into())
        }
        VariableType::Text(len) => return text(len, &value, piece),
    };
    number.to_be_bytes().get(8 - len..).map(<[u8]>::to_vec).ok_or_else(refused)
}

/// The type that holds a value which another does not hold.
fn larger(value: &Value) -> Option<&'static str> {
    Some(match value {
        Value::Real(_) => "REAL",
        Value::Constant(constant) => match constant.value {
            0..=0xFF => "BYTE",
            -0x8000..=0x7FFF => "INT",
            0x8000..=0xFFFF => "WORD",
            -0x8000_0000..=0x7FFF_FFFF => "DINT",
            0x8000_0000..=0xFFFF_FFFF => "DWORD",
            _ => return None,
        },
        Value::Text(_) => "STRING",
        _ => return None,
    })
}

fn text(len: u8, value: &Value, piece: Piece<'_>) -> Outcome<Vec<u8>> {
    match value {
        Value::Text(characters) if characters.len() <= usize::from(len) => {
            Ok([&[characters.len() as u8], characters.as_slice()].concat())
        }
        Value::Text(characters) => {
            Err(error(piece, format!("{} characters, there is room for {len}", characters.len())))
        }
        _ => Err(error(piece, "a text is in double quotes")),
    }
}

/// Milliseconds of `T#1h20m3s500ms`, `-T#1s`, `250ms`; `None` if it is none, or too long.
fn duration(text: &str) -> Option<i32> {
    const UNITS: [(&str, i64); 5] =
        [("ms", 1), ("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1_000)];
    let upper = text.to_ascii_uppercase();
    let (rest, is_negative) = match upper.strip_prefix('-') {
        Some(rest) => (rest, true),
        None => (upper.as_str(), false),
    };
    let mut rest = rest.strip_prefix("TIME#").or(rest.strip_prefix("T#")).unwrap_or(rest);
    let mut ms = 0i64;
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit()).filter(|&len| len > 0)?;
        let (number, behind) = rest.split_at_checked(digits)?;
        let (unit, factor) = UNITS.into_iter().find(|(unit, _)| {
            behind.get(..unit.len()).is_some_and(|start| start.eq_ignore_ascii_case(unit))
        })?;
        ms = ms.checked_add(number.parse::<i64>().ok()?.checked_mul(factor)?)?;
        rest = behind.get(unit.len()..)?.trim_start_matches('_');
    }
    i32::try_from(if is_negative { -ms } else { ms }).ok()
}

// ---- symbols

/// A place of the right kind while nothing is known of the free ones: at the end of V memory, where
/// hardly anything else is.
fn anywhere(wanted: &Wanted) -> Address {
    match wanted {
        Wanted::Memory(memory) => {
            let len = memory.bytes().unwrap_or(1).min(Area::V.size().into()) as u16;
            memory.kind.at(Area::V, Area::V.size() - len)
        }
        Wanted::Timer(family, resolution) => Address::Timer(
            (0..=u8::MAX)
                .find(|&number| {
                    timer_family(number) == *family && timer_resolution(number) == *resolution
                })
                .unwrap_or(0),
        ),
        Wanted::Counter => Address::Counter(0),
    }
}

/// Its name, and of an array those of its elements, become symbols.
fn define(declared: &Declared, comment: String, has_none: bool, targets: &mut Targets<'_>) {
    let mut add = |name: String, address: Address, comment: String| {
        let value = if has_none { Value::Invalid } else { Value::Address(address) };
        let symbol = Symbol { name, value, comment };
        let problem = targets.symbols.define(symbol, Some(declared.span));
        targets.diagnostics.extend(problem);
    };
    add(declared.name.clone(), declared.address, comment);
    if let Wanted::Memory(memory @ Memory { array: Some((low, count)), .. }) = &declared.wanted {
        for index in 0..*count {
            let name = format!("{}[{}]", declared.name, low + i64::from(index));
            add(name, memory.element(declared.address, index), String::new());
        }
    }
}
