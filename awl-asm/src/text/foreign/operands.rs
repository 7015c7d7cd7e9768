//! Operands as other systems of the family write them: data blocks, periphery, function blocks,
//! times.

use plc_isa::{Area, Op, TimerKind, timer_resolution};

use super::{counts, data_files, system_bits};
use crate::text::address::Address;

/// The operand of an S7-200 that is the same: `DB1.DBW2` is VW2, `PEW4` is AIW4, `T37.Q` is T37.
pub(crate) fn same(text: &str) -> Option<String> {
    let upper = text.trim_start_matches('%').to_ascii_uppercase();
    let meant = data_block(&upper)
        .or_else(|| peripheral(&upper))
        .or_else(|| member(&upper))
        .or_else(|| first_module(&upper))
        .or_else(|| numbered_point(&upper))
        .or_else(|| data_files::same(&upper))
        .or_else(|| system_bits::same(&upper).map(str::to_owned))
        .or_else(|| current_value(&upper))
        .or_else(|| register(&upper))?;
    Address::parse(&meant).ok().map(|address| address.to_string())
}

/// V memory is data block 1: `DB1.W0`, `DB1.DBX0.1`; or an open one: `DBW0`.
fn data_block(upper: &str) -> Option<String> {
    let place = upper.strip_prefix("DB1.").or(upper.starts_with("DB").then_some(upper))?;
    let place = place.strip_prefix("DB").unwrap_or(place);
    Some(format!("V{}", place.strip_prefix('X').unwrap_or(place)))
}

/// Analog points: `PEW0`, `PIW2`, `PAW0`, `PQW2`, also with `:P`.
fn peripheral(upper: &str) -> Option<String> {
    // The analog modules of an S7-300 begin at 256.
    if let Some(number) = ["PEW", "PIW"].iter().find_map(|word| upper.strip_prefix(word))
        && let Ok(number @ 256..) = number.parse::<u16>()
    {
        return Some(format!("AIW{}", number - 256));
    }
    if let Some(analog) = s7_1200(upper) {
        return Some(analog);
    }
    let kinds = [
        ("PEW", "AIW"),
        ("PIW", "AIW"),
        ("PAW", "AQW"),
        ("PQW", "AQW"),
        ("PAB", "QB"),
        ("PQB", "QB"),
        ("PEB", "IB"),
        ("PIB", "IB"),
    ];
    let letters = kinds.iter().find_map(|(theirs, ours)| {
        upper.strip_prefix(theirs).map(|number| format!("{ours}{number}"))
    });
    letters.or_else(|| upper.strip_suffix(":P").map(str::to_owned))
}

/// The analog points of an S7-1200: inputs from IW64 on, outputs from QW64 or QW80 on.
fn s7_1200(upper: &str) -> Option<String> {
    let (letters, number) = upper.split_at_checked(2)?;
    let number = number.strip_suffix(":P").unwrap_or(number).parse::<u16>().ok()?;
    match letters {
        "IW" | "EW" => number.checked_sub(64).map(|number| format!("AIW{number}")),
        "QW" | "AW" if number >= 80 => Some(format!("AQW{}", number - 80)),
        "QW" | "AW" => number.checked_sub(64).map(|number| format!("AQW{number}")),
        _ => None,
    }
}

/// Whether an operand is a point of the periphery by its German name, `PEW0`.
pub(super) fn is_german(text: &str) -> bool {
    let upper = text.trim_start_matches('%').to_ascii_uppercase();
    let rest = upper.strip_prefix("PE").or(upper.strip_prefix("PA"));
    let number = rest.and_then(|rest| rest.strip_prefix(['B', 'W', 'D']));
    number.is_some_and(|number| number.starts_with(|c: char| c.is_ascii_digit()))
}

/// What a timer or counter is made of: `T37.Q`, `C1.CV`.
fn member(upper: &str) -> Option<String> {
    let (name, member) = upper.rsplit_once(['.', '/'])?;
    let is_timed = matches!(Address::parse(name), Ok(Address::Timer(_) | Address::Counter(_)));
    let is_known = matches!(member, "Q" | "ET" | "CV" | "QU" | "QD" | "DN" | "ACC" | "BIT");
    (is_timed && is_known).then(|| name.to_owned())
}

/// `X0` and `Y0` of other makers, as far as they are in the first byte.
fn numbered_point(upper: &str) -> Option<String> {
    let (letter, number) = upper.split_at_checked(1)?;
    let area = [("X", "I"), ("Y", "Q")].iter().find(|(theirs, _)| *theirs == letter)?.1;
    if let (3, true) = (number.len(), number.starts_with('0')) {
        // Of three digits they are octal.
        let point = u8::from_str_radix(number, 8).ok()?;
        return Some(format!("{area}{}.{}", point / 8, point % 8));
    }
    number.parse::<u8>().ok().filter(|bit| *bit < 8).map(|bit| format!("{area}0.{bit}"))
}

/// The current value of a timer or counter as a word of its own: `TW5`, `CW0`, `ZW0`.
fn current_value(upper: &str) -> Option<String> {
    let (letter, number) = upper.split_at_checked(1)?;
    let number = number.strip_prefix('W').filter(|_| matches!(letter, "T" | "C" | "Z"))?;
    Some(format!("{letter}{}", number.parse::<u8>().ok()?))
}

/// Data registers of other makers are words: D0, D1, ...
fn register(upper: &str) -> Option<String> {
    let number = upper.strip_prefix('D')?.parse::<u16>().ok()?;
    Some(format!("VW{}", number.checked_mul(2)?))
}

/// The first points of an S7-300 are in byte 124.
fn first_module(upper: &str) -> Option<String> {
    let (letters, number) = upper.split_at_checked(1)?;
    let (byte, bit) = number.split_once('.')?;
    let byte = byte.parse::<u8>().ok()?.checked_sub(124)?;
    matches!(letters, "I" | "E" | "Q" | "A").then(|| format!("{letters}{byte}.{bit}"))
}

/// How `:P` after an input or output is written, where the input itself is read or written.
pub(crate) fn immediate(text: &str) -> Option<String> {
    let (name, _) = text.rsplit_once(':').filter(|(_, end)| end.eq_ignore_ascii_case("P"))?;
    Some(match Address::parse(name.trim_start_matches('%')).ok()? {
        bit @ Address::Bit { area: Area::I, .. } => {
            format!("the process image is as old as the scan; `LDI {bit}` reads the input itself")
        }
        bit @ Address::Bit { area: Area::Q, .. } => format!(
            "the process image is written after the scan; `=I {bit}` writes the output at once"
        ),
        Address::Byte { area: Area::Q, .. } | Address::Word { area: Area::Q, .. } => {
            "the process image is written after the scan; `BIW VB0, QB0` writes outputs at once"
                .to_owned()
        }
        Address::Byte { area: Area::I, .. } | Address::Word { area: Area::I, .. } => {
            "the process image is as old as the scan; `BIR IB0, VB0` reads the inputs themselves"
                .to_owned()
        }
        _ => return None,
    })
}

/// How to write an operand that is no address of an S7-200.
pub(crate) fn way(text: &str) -> Option<&'static str> {
    let upper = text.trim_start_matches('%').to_ascii_uppercase();
    let begins = |letters: &str| {
        let rest = upper.strip_prefix(letters);
        rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    Some(match () {
        _ if upper.starts_with("P#") => {
            "on an S7-200 a pointer is `&VB100`, with the address of a byte, word or double word"
        }
        _ if begins("PEW") || begins("PIW") || begins("PED") || begins("PID") => {
            "analog inputs are `AIW0`, `AIW2`, ... `AIW10`"
        }
        _ if begins("PAW") || begins("PQW") || begins("PAD") || begins("PQD") => {
            "analog outputs are `AQW0` and `AQW2`"
        }
        _ if begins("DB") && !upper.contains('.') => {
            "an S7-200 has no data blocks: a call goes without, and values are in V memory: \
             `V0.0`, `VB0`, `VW0`, `VD0`"
        }
        _ if begins("DB")
            || begins("DI")
            || upper.starts_with("DBX")
            || upper.starts_with("DI") =>
        {
            "an S7-200 has no data blocks but V memory: `V0.0`, `VB0`, `VW0`, `VD0`"
        }
        _ if begins("FC") || begins("FB") || begins("SFC") || begins("SFB") || begins("UP") => {
            "on an S7-200 subroutines are `SBR0` to `SBR255`: `CALL SBR1`, and the block begins \
             with `SUBROUTINE_BLOCK Name:SBR1`"
        }
        _ if matches!(upper.as_str(), "IN" | "OUT" | "PT" | "PV" | "CU" | "CD" | "EN" | "ENO") => {
            "operands have an order and no names: `TON T37, 20`, `CTU C1, 10`, `MOVW VW0, VW2`"
        }
        _ if matches!(upper.as_str(), "AR1" | "AR2") => {
            "on an S7-200 a pointer is in AC1, AC2, AC3 or a double word of V: `MOVD &VB100, AC1`"
        }
        _ if matches!(upper.as_str(), "STW" | "OV" | "OS" | "UO" | "BR" | "BIE") => {
            "on an S7-200 flags are bits: SM1.0 zero, SM1.1 overflow, SM1.2 negative"
        }
        _ if [".Q", ".ET", ".CV", ".QU"].iter().any(|member| upper.ends_with(member)) => {
            "on an S7-200 timers and counters have numbers: `LD T37` reads the bit of T37, \
             `MOVW T37, VW0` its value"
        }
        _ if begins("TIM") || begins("TMR") => {
            "a timer is written like `T37`: `LD T37` reads its bit, `TON T37, 20` starts it"
        }
        _ if begins("CNT") => {
            "a counter is written like `C1`: `LD C1` reads its bit, `CTU C1, 10` counts"
        }
        _ if upper.starts_with("AT") && upper.contains('%') => {
            "a name for an address is a symbol: `//# symbol Start I0.0`"
        }
        _ if begins("IW") || begins("EW") || begins("ID") => {
            "inputs are `IB0`, `IW0`; analog inputs are `AIW0`, `AIW2`, ... `AIW10`"
        }
        _ if begins("QW") || begins("AW") => {
            "outputs are `QB0`, `QW0`; analog outputs are `AQW0` and `AQW2`"
        }
        _ if begins("K4M") || begins("K1M") || begins("K2M") || begins("K4X") || begins("K4Y") => {
            "bits side by side are a byte or a word: `MB0`, `MW0`, `IB0`, `QB0`"
        }
        _ if begins("X") || begins("Y") => {
            "inputs are I0.0 to I15.7, outputs Q0.0 to Q15.7: eight bits in a byte"
        }
        _ if upper.contains('[') => {
            "an array is declared by `//# var Table ARRAY[0..9] OF INT`, and its elements are \
             `Table[0]`; an index that changes needs a pointer: `MOVD &VB100, AC1`, then `*AC1`"
        }
        _ => return data_files::way(&upper).or_else(|| system_bits::way(&upper)),
    })
}

/// Several bits as one operand: `Q0.0-Q0.3`, `M0.0..M0.7`.
pub(crate) fn range(text: &str) -> Option<String> {
    let (first, last) = text.split_once("..").or_else(|| text.split_once('-'))?;
    let number = |text: &str| match Address::parse(text.trim_start_matches('%')) {
        Ok(Address::Bit { area, byte, bit }) => Some((area, u32::from(byte) * 8 + u32::from(bit))),
        _ => None,
    };
    let ((area, from), (last_area, to)) = (number(first)?, number(last)?);
    let count = to.checked_sub(from).filter(|_| area == last_area)? + 1;
    Some(format!(
        "several bits are the first one and their number, for S and R: `S {first}, {count}`, \
         `R {first}, {count}`; other instructions name each"
    ))
}

/// An address that is calculated from another: `&VB100+2`, `VW0+2`.
pub(crate) fn with_offset(text: &str) -> Option<String> {
    let (sign, rest) = match text.strip_prefix('&') {
        Some(rest) => ("&", rest),
        None => ("", text),
    };
    let (base, offset) = rest.split_once('+')?;
    let offset = offset.trim().parse::<u16>().ok()?;
    let moved = |byte: u16| byte.checked_add(offset);
    let address = match Address::parse(base.trim()).ok()? {
        Address::Byte { area, byte } => Address::Byte { area, byte: moved(byte)? },
        Address::Word { area, byte } => Address::Word { area, byte: moved(byte)? },
        Address::Double { area, byte } => Address::Double { area, byte: moved(byte)? },
        _ => return None,
    };
    let whole = address.to_string();
    Address::parse(&whole).is_ok().then(|| format!("{sign}{whole}"))
}

/// A pointer of STEP 7, `P#M10.0` or `P#DB1.DBX0.0`, as the address of a byte; with its sign where
/// a pointer is wanted.
pub(crate) fn pointer(text: &str, is_pointer: bool) -> Option<String> {
    let place = text.get(..2).filter(|sign| sign.eq_ignore_ascii_case("P#")).map(|_| &text[2..])?;
    let bit = same(place).unwrap_or_else(|| place.to_owned());
    let Ok(Address::Bit { area, byte, bit: 0 }) = Address::parse(&bit) else { return None };
    let byte = Address::Byte { area, byte };
    Some(if is_pointer { format!("&{byte}") } else { byte.to_string() })
}

/// What inverts a bit in other languages: `!I0.0`, `/I0.0`, `~I0.0`.
pub(crate) fn inverted(text: &str) -> Option<String> {
    let bit = Address::parse(text.strip_prefix(['!', '/', '~'])?).ok()?;
    Some(format!("`LDN {bit}`, `AN {bit}` and `ON {bit}` take the inverted bit"))
}

/// Whether a word may be a number with the letter H after it: `0FFH`, `FFh`. `BACH` is a name.
fn is_with_h(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_digit())
        || text.ends_with('h') && !text.contains(|c: char| ('a'..='g').contains(&c))
}

/// A number in the notation of another system: `0xFF`, `0b101`, `FFh`, `C#10`.
pub(crate) fn number(text: &str) -> Option<String> {
    let upper = text.to_ascii_uppercase();
    let (base, digits) = if let Some(digits) = upper.strip_prefix("0X") {
        (16, digits)
    } else if let Some(digits) = upper.strip_prefix("0B") {
        (2, digits)
    } else if let Some(digits) = upper.strip_prefix("8#") {
        return i64::from_str_radix(digits, 8).ok().map(|number| number.to_string());
    } else if let (true, Some(digits)) = (is_with_h(text), upper.strip_suffix('H')) {
        (16, digits)
    } else if let (true, Some(digits)) = (upper.len() > 2, upper.strip_suffix('B')) {
        (2, digits)
    } else if let Some(digits) = upper.strip_prefix('&') {
        (16, digits.strip_prefix('H')?)
    } else if let Some(digits) = upper.strip_prefix('$') {
        (16, digits)
    } else if let Some(digits) = upper.strip_prefix("H0") {
        // `HA` may be a name.
        (16, digits)
    } else {
        (10, upper.strip_prefix("C#").or(upper.strip_prefix('K'))?)
    };
    let is_number = !digits.is_empty() && digits.chars().all(|digit| digit.is_digit(base));
    is_number.then(|| match base {
        10 => digits.to_owned(),
        base => format!("{base}#{digits}"),
    })
}

const UNITS: [(&str, f64); 16] = [
    ("ms", 1.0),
    ("seconds", 1000.0),
    ("second", 1000.0),
    ("sekunden", 1000.0),
    ("sek", 1000.0),
    ("sec", 1000.0),
    ("std", 3_600_000.0),
    ("minuten", 60_000.0),
    ("stunden", 3_600_000.0),
    ("s", 1000.0),
    ("minutes", 60_000.0),
    ("min", 60_000.0),
    ("m", 60_000.0),
    ("hours", 3_600_000.0),
    ("h", 3_600_000.0),
    ("d", 86_400_000.0),
];

/// A time in milliseconds: `2s`, `T#1m30s`, `S5T#2S500MS`.
pub(super) fn milliseconds(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let (kind, mut rest) = lower.split_once('#').unwrap_or(("t", &lower));
    if !matches!(kind, "t" | "time" | "s5t" | "s5time" | "ltime" | "lt") || rest.is_empty() {
        return None;
    }
    let mut sum = 0.0;
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let (number, unit) = rest.split_at(digits);
        let (name, factor) = UNITS.iter().find(|(name, _)| unit.starts_with(name))?;
        sum += number.parse::<f64>().ok()? * factor;
        rest = unit[name.len()..].trim_start_matches(['_', ' ']);
    }
    Some(sum)
}

/// A time where the preset of a timer should be.
#[derive(Debug, Default)]
pub(crate) struct Preset {
    /// The preset, if the timer can have that time.
    pub(crate) counts: Option<u16>,
    /// What a preset is.
    pub(crate) why: String,
    /// How the time is had otherwise.
    pub(crate) help: String,
}

/// What is meant by a time where the preset of a timer should be; `None` if that is not it.
pub(crate) fn preset(op: Op, timer: Address, text: &str) -> Option<Preset> {
    let (Some(_), Address::Timer(number)) = (TimerKind::started_by(op), timer) else { return None };
    let ms = milliseconds(text)?;
    let base = timer_resolution(number).ms();
    let why = format!("a preset is a number of counts, not a time: T{number} counts {base} ms");
    if let Some(counts) = counts::exact(number, ms) {
        let why = format!("{why}, so it is {counts}");
        return Some(Preset { counts: Some(counts), why, help: String::new() });
    }
    let most = f64::from(i16::MAX) * f64::from(base) / 1000.0;
    let (why, help) = match counts::of(op, None, ms) {
        Some((other, counts)) => {
            let (mnemonic, finer) = (op.instruction().mnemonic(), timer_resolution(other).ms());
            let why = match ms > most * 1000.0 {
                true => format!("{why}, at most {most} s"),
                false => format!("{why}, and {text} is no multiple of that"),
            };
            (why, format!("a timer that counts {finer} ms can: `{mnemonic} T{other}, {counts}`"))
        }
        None => (format!("{why}, at most 32767 times, which are {most} s"), rounds(op, ms)),
    };
    Some(Preset { counts: None, why, help })
}

/// How a time is had that is too long or too fine for every timer: minutes are counted.
fn rounds(op: Op, ms: f64) -> String {
    let minutes = ms / 60_000.0;
    // The rungs below are an on-delay.
    if op != Op::Ton || minutes.fract() != 0.0 || !(1.0..=f64::from(i16::MAX)).contains(&minutes) {
        return "count the rounds of a timer with `CTU`; no timer is finer than 1 ms".to_owned();
    }
    format!(
        "{minutes} minutes are counted: `LD I0.0`, `AN T37`, `TON T37, 600` tells each minute, \
         `LD T37`, `LDN I0.0`, `CTU C1, {minutes}` counts them, and `LD C1` is 1 after that"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operands_that_are_the_same() {
        let same = |text| same(text).unwrap_or_default();
        assert_eq!(same("DB1.DBX0.3"), "V0.3");
        assert_eq!(same("%DB1.DBW2"), "VW2");
        assert_eq!(same("dbd8"), "VD8");
        assert_eq!(same("DB2.DBW2"), "");
        assert_eq!(same("PEW4"), "AIW4");
        assert_eq!(same("PQW2"), "AQW2");
        assert_eq!(same("PEW256"), "AIW0");
        assert_eq!(same("PIW258"), "AIW2");
        assert_eq!(same("PIW300"), "");
        assert_eq!(same("M8000"), "SM0.0");
        assert_eq!(same("CW0"), "C0");
        assert_eq!(same("ZW7"), "C7");
        assert_eq!(same("TW37"), "T37");
        assert_eq!(same("D3"), "VW6");
        assert_eq!(same("T37.Q"), "T37");
        assert_eq!(same("C1.CV"), "C1");
        assert_eq!(same("E124.3"), "I0.3");
        assert_eq!(same("X3"), "I0.3");
        assert_eq!(same("Y8"), "");
        assert_eq!(same("X010"), "I1.0");
        assert_eq!(same("IW66"), "AIW2");
        assert_eq!(same("QW80"), "AQW0");
        assert_eq!(same("IW20"), "");
        assert_eq!(same("Motor"), "");
    }

    #[test]
    fn addresses_that_are_calculated() {
        assert_eq!(with_offset("&VB100+2").as_deref(), Some("&VB102"));
        assert_eq!(with_offset("VW0 + 2").as_deref(), Some("VW2"));
        assert_eq!(with_offset("VB100+x"), None);
        assert_eq!(pointer("P#M10.0", true).as_deref(), Some("&MB10"));
        assert_eq!(pointer("P#DB1.DBX4.0", false).as_deref(), Some("VB4"));
        assert_eq!(pointer("P#M10.1", true), None);
        assert!(range("A0.0-A0.3").is_some_and(|range| range.contains("`S A0.0, 4`")));
        assert_eq!(range("VB0-VB3"), None);
    }

    #[test]
    fn numbers_of_other_notations() {
        let number = |text| number(text).unwrap_or_default();
        assert_eq!(number("0xFF"), "16#FF");
        assert_eq!(number("0b101"), "2#101");
        assert_eq!(number("0FFh"), "16#0FF");
        assert_eq!(number("FFh"), "16#FF");
        assert_eq!(number("each"), "");
        assert_eq!(number("C#10"), "10");
        assert_eq!(number("$FF"), "16#FF");
        assert_eq!(number("K20"), "20");
        assert_eq!(number("8#17"), "15");
        assert_eq!(number("1010B"), "2#1010");
        assert_eq!(number("&H1F"), "16#1F");
        assert_eq!(number("BACH"), "");
        assert_eq!(number("0b12"), "");
        assert_eq!(number("2h30"), "");
    }

    #[test]
    fn times_as_presets_of_the_timer_at_hand() {
        let preset = |timer, text| {
            let preset = preset(Op::Ton, Address::Timer(timer), text);
            preset.map(|preset| (preset.counts.unwrap_or_default(), preset.help))
        };
        let exact = |counts| Some((counts, String::new()));
        assert_eq!(preset(37, "2s"), exact(20));
        assert_eq!(preset(33, "T#2s"), exact(200));
        assert_eq!(preset(32, "S5T#2S_500MS"), exact(2500));
        assert_eq!(preset(37, "1.5s"), exact(15));
        let otherwise = |timer, text| preset(timer, text).unwrap_or_default().1;
        assert!(otherwise(37, "250ms").ends_with("`TON T33, 25`"));
        assert!(otherwise(32, "40s").ends_with("`TON T37, 400`"));
        assert!(otherwise(32, "2h").contains("`CTU C1, 120`"));
        assert_eq!(preset(37, "20"), None);
        assert_eq!(preset(37, "C#20"), None);
    }
}
