//! The lines that begin with `//#`: system settings and symbols. Micro/WIN sees comments in them.

use plc_isa::{Area, NAME_LEN_MAX, Profile, Retained, Settings, TimerFamily, timer_family};

use diagnostics::origins::parse_place;

use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::text::address::{Address, AddressError};
use crate::text::ast::{Promise, PromiseKind, RetainedRange, Span, Symbol, Value};
use crate::text::boards::way;
use crate::text::directive_table::WORDS;
use crate::text::line_settings::modbus;
use crate::text::misdeclared::{
    keep, name_of_words, other_setting, quoted_address, range_in_words, with_commas,
};
use crate::text::piece::{Outcome, Piece, Targets, unknown};
use crate::text::suggest::{Suggester, nearby_address};
use crate::text::symbols::{check_name, read_value};
use crate::text::variables::declare;

/// The most that `bound` and `rate` can say.
const PROMISE_MAX: u32 = 1_000_000;
/// Whether a comment is a setting, whatever is before it.
pub(crate) fn is_setting(comment: &str) -> bool {
    let word = comment.strip_prefix("//#").and_then(|rest| rest.split_whitespace().next());
    word.is_some_and(|word| WORDS.iter().any(|known| known.eq_ignore_ascii_case(word)))
}

/// Where the settings are that a program can make only once.
#[derive(Debug, Default)]
pub(crate) struct Directives {
    board: Option<Span>,
    watchdog: Option<Span>,
    scan: Option<Span>,
    filter: Option<Span>,
    modbus: Option<Span>,
    name: Option<Span>,
}

impl Directives {
    /// Reads a comment line; false if it is just a comment.
    pub(crate) fn read(&mut self, source: &str, comment: Span, targets: &mut Targets<'_>) -> bool {
        let Some(text) = comment.text(source).strip_prefix("//#") else { return false };
        let (word, rest) = Piece { text, start: comment.start as usize + 3 }.first_word();
        // `//####` and `//#1` are decoration.
        if !word.text.starts_with(char::is_alphabetic) {
            return false;
        }
        if let Err(diagnostic) = self.setting(word, rest, targets) {
            targets.diagnostics.push(*diagnostic);
        }
        true
    }

    fn setting(
        &mut self,
        word: Piece<'_>,
        rest: Piece<'_>,
        targets: &mut Targets<'_>,
    ) -> Outcome<()> {
        let values = rest.without_comment();
        let line = Span::new(word.start, values.start + values.text.len());
        let is = |name: &str| word.text.eq_ignore_ascii_case(name);
        let program = &mut *targets.program;
        match () {
            () if is("symbol") => return symbol(word, rest, targets),
            () if is("var") || is("timer") || is("counter") => return declare(word, rest, targets),
            () if is("source") => return origin(word, rest),
            () if is("bound") => promise(PromiseKind::Bound, line, values, targets)?,
            () if is("rate") => promise(PromiseKind::Rate, line, values, targets)?,
            () if is("allow") => allow(word, values, targets),
            () if is("board") => {
                let profile = board(word, values, targets.suggester)?;
                once(&mut self.board, line, word)?;
                (program.profile, program.board_named) = (profile, Some(line));
            }
            () if is("pullup") => points(word, values, targets, pullup),
            () if is("invert") => points(word, values, targets, invert),
            () if is("retain") => retain(word, values, targets),
            () if is("memory") => memory(word, values, targets),
            () if is("watchdog") => {
                let ms = time(word, values, 1)?;
                once(&mut self.watchdog, line, word)?;
                program.settings.watchdog_ms = ms;
            }
            () if is("scan") => {
                let ms = time(word, values, 0)?;
                once(&mut self.scan, line, word)?;
                program.settings.scan_ms = ms;
            }
            () if is("filter") => {
                let power = filter(values)?;
                once(&mut self.filter, line, word)?;
                program.settings.filter = power;
            }
            () if is("modbus") => {
                once(&mut self.modbus, line, word)?;
                modbus(word, values, targets);
            }
            () if is("name") => {
                let name = name(word, values)?;
                once(&mut self.name, line, word)?;
                program.name = Some(name);
            }
            () => return Err(other_setting(word, values, targets)),
        }
        Ok(())
    }
}

/// The codes of warnings that a program does not want to hear of.
fn allow(word: Piece<'_>, values: Piece<'_>, targets: &mut Targets<'_>) {
    let mut rest = values;
    if rest.text.is_empty() {
        let error = word.error("the code of a warning follows").help("such as `//# allow W0008`");
        targets.diagnostics.push(error);
    }
    while !rest.text.is_empty() {
        let (code, behind) = rest.first_word();
        let bare = code.text.trim_matches(',');
        match Code::find(bare) {
            Some(code) if code.severity() == Severity::Warning => {
                targets.program.allowed.push(code)
            }
            Some(_) => {
                let error = code.error("only warnings can be allowed, not errors");
                targets.diagnostics.push(error.help("codes of warnings begin with W"));
            }
            None => {
                let known: Vec<&str> = Code::ALL.iter().map(|code| code.text()).collect();
                let mut error = *code.error("there is no such warning");
                error.suggestion =
                    targets.suggester.nearest(bare, known.into_iter()).map(str::to_owned);
                targets.diagnostics.push(error.help("`awl-asm --explain` tells about a code"));
            }
        }
        rest = behind;
    }
}

/// Checks a line `//# source`; what it means for the lines after it is the source's business.
fn origin(word: Piece<'_>, rest: Piece<'_>) -> Outcome<()> {
    let place = rest.without_comment();
    if place.text.is_empty() || parse_place(place.text).is_some() {
        return Ok(());
    }
    let help = "such as `pump.st:12`, `pump.st:12:3` or `pump.sfc#Fill`";
    let piece = if word.text == "source" { place } else { word };
    Err(Box::new(piece.error("names no line and no element of a file").help(help)))
}

/// A line `//# bound` or `//# rate`; which instruction it is about is found later.
fn promise(
    kind: PromiseKind,
    span: Span,
    value: Piece<'_>,
    targets: &mut Targets<'_>,
) -> Outcome<()> {
    let most = value.text.parse().ok().filter(|most| (1..=PROMISE_MAX).contains(most));
    let Some(most) = most else {
        let what = match kind {
            PromiseKind::Bound => "a bound is how often a loop is passed at most",
            PromiseKind::Rate => "a rate is how many events there are in a second at most",
        };
        let message = format!("{}: {what}, 1 to {PROMISE_MAX}", value.text);
        let message = message.trim_start_matches(": ").to_owned();
        let error = Diagnostic::new(Code::Setting, span, message);
        return Err(Box::new(error.help(format!("such as `//# {} 10`", kind.word()))));
    };
    let statement = targets.program.statements.len();
    targets.program.promises.push(Promise { kind, most, span, statement });
    Ok(())
}

/// Refuses the second of two settings that exclude each other.
pub(super) fn once(first: &mut Option<Span>, line: Span, word: Piece<'_>) -> Outcome<()> {
    match *first {
        None => {
            *first = Some(line);
            Ok(())
        }
        Some(place) => {
            let mut diagnostic = word.error("is already set");
            diagnostic.related.push((place, "first set here".to_owned()));
            Err(diagnostic)
        }
    }
}

fn symbol(word: Piece<'_>, rest: Piece<'_>, targets: &mut Targets<'_>) -> Outcome<()> {
    let whole = rest;
    let (name, rest) = rest.first_word();
    let (value, comment) = rest.first_word();
    if value.text.is_empty() {
        let piece = if name.text.is_empty() { word } else { name };
        let message = format!("{}: //# symbol is followed by a name and an address", piece.text);
        let diagnostic = Diagnostic::new(Code::SymbolDefinition, piece.span(), message);
        if !name.text.is_empty() && check_name(name.text, name.span()).is_ok() {
            keep(name.text, name.span(), targets);
        }
        return Err(Box::new(diagnostic.help("such as `//# symbol Start I0.0`")));
    }
    if let Some((long, address)) = name_of_words(whole) {
        keep(long.text, whole.span(), targets);
        let message = format!("{}: a name with blanks is in double quotes", long.text);
        let diagnostic = Diagnostic::new(Code::SymbolDefinition, long.span(), message);
        let meant = format!("\"{}\"", long.text);
        return Err(Box::new(
            diagnostic
                .help(format!("`//# symbol {meant} {address}`, and where it is used `LD {meant}`"))
                .suggest(meant),
        ));
    }
    let bare = name
        .text
        .strip_prefix('"')
        .and_then(|inside| inside.strip_suffix('"'))
        .unwrap_or(name.text);
    let (name, bare) = match bare.strip_suffix([':', ',', '=']) {
        Some(without) if !without.is_empty() => {
            let sign = name.split(without.len()).1;
            let message = format!("{}: nothing is between the name and its address", sign.text);
            let diagnostic = Diagnostic::new(Code::SymbolDefinition, sign.span(), message);
            let help = format!("`//# symbol {without} {}`", value.text);
            targets.diagnostics.push(diagnostic.help(help));
            (name.split(without.len()).0, without)
        }
        _ => (name, bare),
    };
    check_name(bare, name.span())?;
    let comment = comment.text.strip_prefix("//").unwrap_or(comment.text).trim().to_owned();
    // A symbol whose value is wrong is kept, so that its uses are not called unknown.
    let (value, error) = match read_value(value.text, value.span()) {
        Ok(value) => (value, None),
        Err(mut error) => {
            if error.suggestion.is_none() {
                error.suggestion = pin(value.text).or_else(|| quoted_address(value.text));
            }
            if error.suggestion.is_none() && error.help.is_empty() {
                error.help.push(format!("such as `//# symbol {} I0.0`", name.text));
            }
            (Value::Invalid, Some(error))
        }
    };
    let duplicate =
        targets.symbols.define(Symbol { name: bare.to_owned(), value, comment }, Some(name.span()));
    targets.diagnostics.extend(error.map(|error| *error).into_iter().chain(duplicate));
    Ok(())
}

/// The items of a list with commas; each is a range, or an address alone.
fn ranges<'t>(list: Piece<'t>) -> impl Iterator<Item = Outcome<(Piece<'t>, Address, Address)>> {
    let mut rest = Some(list);
    std::iter::from_fn(move || {
        let piece = rest?;
        let comma = piece.text.find(',');
        let (item, behind) = piece.split(comma.unwrap_or(piece.text.len()));
        rest = comma.map(|_| behind.split(1).1);
        Some(range(item.trim()))
    })
}

fn range(item: Piece<'_>) -> Outcome<(Piece<'_>, Address, Address)> {
    let Some(dash) = item.text.find('-') else {
        let only = address(item)?;
        return Ok((item, only, only));
    };
    let (first, behind) = item.split(dash);
    Ok((item, address(first.trim())?, address(behind.split(1).1.trim())?))
}

/// The point at a pin of the Uno, `D2`.
fn pin(text: &str) -> Option<String> {
    let number = text.strip_prefix(['D', 'd'])?.parse::<u8>().ok()?;
    Some(match number {
        2..=7 => format!("I0.{}", number - 2),
        8..=13 => format!("Q0.{}", number - 8),
        _ => return None,
    })
}

fn address(piece: Piece<'_>) -> Outcome<Address> {
    Address::parse(piece.text).map_err(|error| match error {
        AddressError::NotAnAddress if piece.text.is_empty() => {
            Box::new(Diagnostic::new(Code::Setting, piece.span(), "an address is missing here"))
        }
        AddressError::NotAnAddress => {
            let mut diagnostic = piece.error("is no address");
            diagnostic.suggestion = pin(piece.text)
                .or_else(|| range_in_words(piece.text))
                .or_else(|| with_commas(piece.text))
                .or_else(|| nearby_address(piece.text));
            if diagnostic.suggestion.is_none() {
                let help = "addresses are separated by commas, a range has a minus sign: \
                            `I0.0-I0.5`, `VB0-VB31, C1`; a variable is retained by its own line, \
                            `//# var Speed INT RETAIN`";
                diagnostic.help.push(help.to_owned());
            }
            diagnostic
        }
        AddressError::OutOfRange(message, suggestion) => {
            let mut diagnostic = Diagnostic::new(Code::AddressRange, piece.span(), message);
            diagnostic.suggestion = suggestion.or_else(|| nearby_address(piece.text));
            Box::new(diagnostic)
        }
    })
}

/// Reads a list of points and sets their bits; every bad item is reported.
fn points(
    word: Piece<'_>,
    list: Piece<'_>,
    targets: &mut Targets<'_>,
    field: fn(&mut Settings, Area) -> Option<&mut u8>,
) {
    if list.text.is_empty() {
        targets.diagnostics.push(*word.error("points are missing, such as I0.0-I0.5"));
        return;
    }
    for item in ranges(list) {
        let outcome = item.and_then(|(item, first, last)| {
            let (area, bits) = point_bits(item, first, last)?;
            let name = area.name();
            let field = field(&mut targets.program.settings, area).ok_or_else(|| {
                item.error(format!("{} is for inputs, not for {name}", word.text))
            })?;
            let board = targets.program.profile;
            let pins = board.points(area);
            if u32::from(bits) >> pins != 0 {
                let mut diagnostic = item.error(format!("{} has no pin for it", board.title));
                diagnostic.help.push(format!("{name}0.0 to {name}0.{} have a pin", pins - 1));
                let has_pins = |other: &Profile| u32::from(bits) >> other.points(area) == 0;
                diagnostic.help.extend(way(board, has_pins));
                return Err(diagnostic);
            }
            *field |= bits as u8;
            Ok(())
        });
        targets.diagnostics.extend(outcome.err().map(|diagnostic| *diagnostic));
    }
}

fn pullup(settings: &mut Settings, area: Area) -> Option<&mut u8> {
    (area == Area::I).then_some(&mut settings.pullup)
}

fn invert(settings: &mut Settings, area: Area) -> Option<&mut u8> {
    Some(if area == Area::I { &mut settings.invert_inputs } else { &mut settings.invert_outputs })
}

/// The points of a range of inputs or outputs as bits, I0.0 the lowest. Those of I1.0 and up count
/// as one.
fn point_bits(item: Piece<'_>, first: Address, last: Address) -> Outcome<(Area, u16)> {
    let (
        Address::Bit { area: area @ (Area::I | Area::Q), byte, bit },
        Address::Bit { area: last_area, byte: last_byte, bit: last_bit },
    ) = (first, last)
    else {
        return Err(item.error("only single inputs and outputs such as I0.0 and Q0.0 have pins"));
    };
    let (from, to) =
        (8 * u32::from(byte) + u32::from(bit), 8 * u32::from(last_byte) + u32::from(last_bit));
    check_order(item, area == last_area, from, to)?;
    Ok((area, (from..=to).fold(0, |bits, point| bits | 1 << point.min(15))))
}

fn check_order(item: Piece<'_>, is_same_kind: bool, first: u32, last: u32) -> Outcome<()> {
    if !is_same_kind {
        return Err(item.error("a range goes from one address to another of the same kind"));
    }
    if first > last {
        return Err(item.error("a range begins with its lower address"));
    }
    Ok(())
}

fn retain(word: Piece<'_>, list: Piece<'_>, targets: &mut Targets<'_>) {
    if list.text.is_empty() {
        targets.diagnostics.push(*word.error("ranges are missing, such as VB0-VB31, C0-C9"));
        return;
    }
    for item in ranges(list) {
        let outcome = item.and_then(|(item, first, last)| {
            let range = retained(item, first, last)?;
            if targets.program.retained.len() == usize::from(Retained::RANGES_MAX) {
                let message = format!(
                    "{}: a program can retain {} ranges at most",
                    item.text,
                    Retained::RANGES_MAX
                );
                return Err(Box::new(Diagnostic::new(Code::TooMany, item.span(), message)));
            }
            targets.program.retained.push(range);
            Ok(())
        });
        targets.diagnostics.extend(outcome.err().map(|diagnostic| *diagnostic));
    }
}

/// Reads the ranges of V memory that the program shall have, whether it names them or not.
fn memory(word: Piece<'_>, list: Piece<'_>, targets: &mut Targets<'_>) {
    if list.text.is_empty() {
        targets.diagnostics.push(*word.error("ranges are missing, such as VB0-VB99"));
        return;
    }
    for item in ranges(list) {
        let outcome = item.and_then(|(item, first, last)| {
            let (Some((Area::V, from, from_len)), Some((area, to, len))) =
                (unit(first), unit(last))
            else {
                return Err(
                    item.error("only bytes, words and double words of V memory are asked for")
                );
            };
            check_order(item, area == Area::V && from_len == len, u32::from(from), u32::from(to))?;
            targets.program.memory.push((from, to - from + len, item.span()));
            Ok(())
        });
        targets.diagnostics.extend(outcome.err().map(|diagnostic| *diagnostic));
    }
}

/// Area, first byte or number, and how many of them a value has, where ranges of it are kept.
fn unit(address: Address) -> Option<(Area, u16, u16)> {
    match address {
        Address::Byte { area: area @ (Area::V | Area::M), byte } => Some((area, byte, 1)),
        Address::Word { area: area @ (Area::V | Area::M), byte } => Some((area, byte, 2)),
        Address::Double { area: area @ (Area::V | Area::M), byte } => Some((area, byte, 4)),
        Address::Timer(number) => Some((Area::T, u16::from(number), 1)),
        Address::Counter(number) => Some((Area::C, u16::from(number), 1)),
        _ => None,
    }
}

fn retained(item: Piece<'_>, first: Address, last: Address) -> Outcome<RetainedRange> {
    let (Some((area, from, from_len)), Some((last_area, to, len))) = (unit(first), unit(last))
    else {
        let help = "what can be retained: bytes, words and double words of V and M, timers of \
            TONR, counters";
        let mut error = item.error("cannot be retained").help(help);
        if let Address::Bit { area: area @ (Area::M | Area::V), byte, .. } = first {
            error.suggestion = Some(Address::Byte { area, byte }.to_string());
        }
        return Err(Box::new(error));
    };
    check_order(item, area == last_area && from_len == len, u32::from(from), u32::from(to))?;
    let loses = |number: u16| {
        u8::try_from(number).is_ok_and(|number| timer_family(number) != TimerFamily::Tonr)
    };
    if let Some(number) = (from..=to).find(|&number| area == Area::T && loses(number)) {
        let help = "these are T0 to T31 and T64 to T95: `//# retain T5`, started by `TONR T5, 20`";
        return Err(Box::new(
            item.error(format!("T{number} is no timer of TONR, and only those are retained"))
                .help(help),
        ));
    }
    Ok(RetainedRange {
        span: item.span(),
        range: Retained { area, first: from, count: to - from + len },
    })
}

/// Reads a time such as `500ms` or `2s`, in milliseconds.
fn time(word: Piece<'_>, value: Piece<'_>, min: u32) -> Outcome<u16> {
    if value.text.is_empty() {
        return Err(word.error("a time is missing, such as 500ms"));
    }
    let digits_len = value.text.find(|c: char| !c.is_ascii_digit()).unwrap_or(value.text.len());
    let (digits, unit) = value.split(digits_len);
    let factor = match unit.trim().text {
        unit if unit.eq_ignore_ascii_case("ms") => 1,
        unit if unit.eq_ignore_ascii_case("s") => 1000,
        "" => {
            let mut diagnostic = value.error("a time has a unit, ms or s");
            diagnostic.suggestion = Some(format!("{}ms", digits.text));
            return Err(diagnostic);
        }
        _ => return Err(no_time(word, value)),
    };
    if digits.text.is_empty() {
        return Err(no_time(word, value));
    }
    let ms = digits.text.parse::<u32>().unwrap_or(u32::MAX).saturating_mul(factor);
    let max = Settings::TIME_MAX_MS;
    match u16::try_from(ms) {
        Ok(time) if ms >= min && time <= max => Ok(time),
        _ => Err(value.error(format!(
            "the time for {} is {min} to {max} ms",
            word.text.to_ascii_lowercase()
        ))),
    }
}

fn no_time(word: Piece<'_>, value: Piece<'_>) -> Box<Diagnostic> {
    let error = value.error("is no time; write a whole number with ms or s");
    let help = format!("such as `//# {} 100ms`", word.text.to_ascii_lowercase());
    Box::new(error.help(help))
}

/// The number of samples, as a power of two.
fn filter(value: Piece<'_>) -> Outcome<u8> {
    let samples = value.text.parse::<u32>().ok();
    let power = (0..=Settings::FILTER_MAX).find(|&power| samples == Some(1 << power));
    power.ok_or_else(|| {
        let error = value.error("a filter has 1, 2, 4, 8, 16, 32 or 64 samples");
        Box::new(error.help("such as `//# filter 8`"))
    })
}

/// A character in a message.
fn shown(character: char) -> String {
    match character.is_control() {
        true => character.escape_default().to_string(),
        false => character.to_string(),
    }
}

fn board(word: Piece<'_>, value: Piece<'_>, suggester: &Suggester) -> Outcome<&'static Profile> {
    if value.text.is_empty() {
        return Err(word.error("the name of a board is missing, such as `uno`"));
    }
    Profile::named(value.text).ok_or_else(|| {
        let names = Profile::ALL.map(|profile| profile.name);
        unknown(value, "is no board", &names, suggester)
    })
}

fn name(word: Piece<'_>, value: Piece<'_>) -> Outcome<String> {
    let bare = match value.text.strip_prefix('"') {
        Some(inside) => {
            inside.strip_suffix('"').ok_or_else(|| value.error("the quote is not closed"))?
        }
        None => value.text,
    };
    if value.text.is_empty() {
        return Err(word.error("a name is missing"));
    }
    if let Some(odd) = bare.chars().find(|&c| !(' '..='~').contains(&c) || c == '"') {
        return Err(
            value.error(format!("{} cannot be in a name, only printable ASCII", shown(odd)))
        );
    }
    if bare.len() > usize::from(NAME_LEN_MAX) {
        return Err(value.error(format!("a name has at most {NAME_LEN_MAX} characters")));
    }
    Ok(bare.to_owned())
}
