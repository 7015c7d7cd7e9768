//! Groups of instructions against the S7-200, for docs/benchmarks.md: how much slower or faster the
//! board is. It measures nothing.

use super::record::{INTERPRETER, NATIVE, PICO, Record, TYPICAL, find};

/// A group, and what the names of its rows begin with.
type Group = (&'static str, &'static [&'static str]);

/// All groups; a row belongs to the first that names it.
const GROUPS: &[Group] = &[
    ("contacts of I and SM", &["LD I", "LD SM", "LDN I", "A I", "AN I", "O I", "ON I"]),
    ("contacts of 1 ms timers", &["LD T32"]),
    ("contacts of V", &["LD V", "LDN V", "A V", "AN V", "O V", "ON V"]),
    ("contacts of M, T, C", &["LD ", "LDN ", "A ", "AN ", "O ", "ON "]),
    (
        "NOT, logic stack, LBL",
        &["NOT", "NOP", "ALD", "OLD", "LPS", "LRD", "LPP", "LDS 1", "LDS 8", "LBL"],
    ),
    ("EU ED", &["EU", "ED"]),
    ("= of Q, M, S, V", &["= "]),
    (
        "S R of 1 bit",
        &["S Q0.{b}, 1", "S M1.{b}, 1", "S V0.{b}, 1", "R Q0.{b}, 1", "R M1.{b}, 1", "R V0.{b}, 1"],
    ),
    ("S R of a count that is read", &["S M1.{b}, MB29", "R M1.{b}, MB29", "S V100", "R V100"]),
    ("S R of 8 to 255 bits", &["S M", "S V0", "R M", "R V0"]),
    (
        "comparisons by pointer",
        &["LDB{x} *", "AB{x} *", "OB{x} *", "LDW{x} *", "AW{x} *", "OW{x} *"],
    ),
    ("comparisons of bytes and words", &["LDB", "AB", "OB", "LDW", "AW", "OW"]),
    ("comparisons of double words", &["LDD", "AD", "OD"]),
    ("comparisons of reals", &["LDR", "AR", "OR{x}"]),
    ("comparisons of strings", &["LDS=", "AS=", "OS="]),
    ("moves by pointer", &["MOVB *", "MOVW *", "MOVD *", "MOVD VD8, *"]),
    ("MOVB MOVW", &["MOVB", "MOVW"]),
    ("MOVD MOVR SWAP", &["MOVD", "MOVR", "SWAP"]),
    ("integers by pointer", &["+I *", "-I *", "*I *", "/I *", "INCW *", "DECW *"]),
    ("+I -I INCW DECW", &["+I", "-I", "INCW", "DECW"]),
    ("*I /I", &["*I", "/I"]),
    ("INCB DECB INCD DECD +D -D", &["INCB", "DECB", "INCD", "DECD", "+D", "-D"]),
    ("*D MUL", &["*D", "MUL"]),
    ("/D DIV", &["/D", "DIV"]),
    ("+R -R *R /R", &["+R", "-R", "*R", "/R"]),
    ("SQRT SIN COS TAN LN EXP", &["SQRT", "SIN", "COS", "TAN", "LN", "EXP"]),
    ("PID", &["PID"]),
    ("DTR ROUND TRUNC", &["DTR", "ROUND", "TRUNC"]),
    ("INV AND OR XOR", &["INV", "AND", "OR", "XOR"]),
    ("shifts and rotations", &["SL", "SR", "RL", "RR", "SHRB"]),
    ("BTI ITB ITD DTI BCDI IBCD", &["BTI", "ITB", "ITD", "DTI", "BCDI", "IBCD"]),
    ("DECO ENCO SEG", &["DECO", "ENCO", "SEG"]),
    ("ATT FIFO LIFO FND", &["ATT", "FIFO", "LIFO", "FND"]),
    ("FILL BMB BMW BMD", &["FILL", "BMB", "BMW", "BMD"]),
    ("SLEN SCPY SCAT", &["SLEN", "SCPY", "SCAT"]),
    ("ATH HTA ITA DTA", &["ATH", "HTA", "ITA", "DTA"]),
    ("timers", &["TON", "TOF", "TONR"]),
    ("counters", &["CTU", "CTD"]),
    ("FOR NEXT JMP END STOP WDR", &["FOR", "NEXT", "JMP", "END", "STOP", "WDR"]),
    ("CALL", &["CALL"]),
    ("LSCR SCRT SCRE CSCRE", &["LSCR", "SCRT", "SCRE", "CSCRE"]),
    ("ATCH DTCH ENI DISI", &["ATCH", "DTCH", "ENI", "DISI"]),
    ("AENO", &["AENO"]),
    ("LDI AI OI =I BIR BIW", &["LDI", "LDNI", "AI", "ANI", "OI", "ONI", "=I", "BIR", "BIW"]),
    ("HDEF HSC PLS", &["HDEF", "HSC", "PLS"]),
    ("TODR TODW", &["TODR", "TODW"]),
    ("BITIM CITIM", &["BITIM", "CITIM"]),
    ("XMT RCV", &["XMT", "RCV"]),
];

/// The name of what no group names.
const OTHERS: &str = "others";

/// Times of the CPU 226XM, an edition before, from the German manual (docs/s7-200.md 5.1): row,
/// what it is there, us.
const VERIFIED: &[(&str, &str, f64)] = &[
    ("R M1.{b}, 1", "R, length 1 as a constant, not of T and C", 5.0),
    ("R M1.{b}, 8", "R, 28 + 0.9 a bit", 28.0 + 8.0 * 0.9),
    ("RLB VB4, 3", "42 + 0.6 a bit", 42.0 + 3.0 * 0.6),
    ("RLW VW4, 4", "49 + 1.7 a bit", 49.0 + 4.0 * 1.7),
    ("RLD VD4, 4", "52 + 2.5 a bit", 52.0 + 4.0 * 2.5),
    ("ROUND VD4, VD8", "typical; 183 at most", 108.0),
    ("PID VB0, 0", "1,000 more when the constants are computed again", 750.0),
    ("RI Q0.0, 1", "18 + 22 a point on board", 18.0 + 22.0),
    ("PLS 1", "pulse width modulation", 57.0),
    ("RCV VB0, 0", "", 80.0),
];

/// A line of the comparison: the group, then our times and theirs in us, each the least and the
/// most of its rows.
pub struct Line {
    /// The group.
    pub title: &'static str,
    /// In bytecode.
    pub interpreter: [f64; 2],
    /// Translated; `None` where machine code calls the interpreter.
    pub native: Option<[f64; 2]>,
    /// What is recollected of the S7-200.
    pub quoted: [f64; 2],
    /// How many times as fast as the S7-200: bytecode, and translated.
    pub speed: [Option<f64>; 2],
}

/// The comparison of all groups that were measured.
pub fn lines(records: &[Record]) -> Vec<Line> {
    let titles = GROUPS.iter().map(|(title, _)| *title).chain([OTHERS]);
    titles.filter_map(|title| line(records, title)).collect()
}

/// The same of the Pico, whose rows are one tier: group, its times and those of the S7-200 in us,
/// and how many times as fast it is.
pub fn lines_of_pico(records: &[Record]) -> Vec<(&'static str, [f64; 2], [f64; 2], f64)> {
    let titles = GROUPS.iter().map(|(title, _)| *title).chain([OTHERS]);
    let line = |title| {
        let rows = rows(records, PICO, title);
        let taken = rows.iter().map(|row| row.us());
        let times = speed(&rows, taken.clone().sum())?;
        Some((title, spread(taken)?, spread(quoted(&rows))?, times))
    };
    titles.filter_map(line).collect()
}

/// A verified time: row, what it is there, ours in us and theirs.
pub fn verified(records: &[Record]) -> Vec<(&'static str, &'static str, f64, f64)> {
    let of = |&(name, what, us): &(&'static str, &'static str, f64)| {
        let ours = find(records, INTERPRETER, TYPICAL, name)
            .or_else(|| find(records, INTERPRETER, "cycles", name));
        Some((name, what, ours?.us(), us))
    };
    VERIFIED.iter().filter_map(of).collect()
}

fn group_of(name: &str) -> &'static str {
    let names = |group: &&Group| group.1.iter().any(|start| name.starts_with(start));
    GROUPS.iter().find(names).map_or(OTHERS, |(title, _)| title)
}

fn line(records: &[Record], title: &'static str) -> Option<Line> {
    let rows = rows(records, INTERPRETER, title);
    let taken = rows.iter().map(|row| row.us());
    let native: Vec<f64> = rows
        .iter()
        .filter_map(|row| find(records, NATIVE, &row.what, &row.name).map(Record::us))
        .collect();
    let is_whole = native.len() == rows.len();
    let by_native = is_whole.then(|| speed(&rows, native.iter().sum())).flatten();
    Some(Line {
        title,
        interpreter: spread(taken.clone())?,
        native: by_native.and_then(|_| spread(native.iter().copied())),
        quoted: spread(quoted(&rows))?,
        speed: [speed(&rows, taken.sum()), by_native],
    })
}

/// The rows of a group that something is quoted for, as they are executed in this way.
fn rows<'a>(records: &'a [Record], tier: &str, title: &str) -> Vec<&'a Record> {
    let is_row = |record: &&Record| {
        let is_time = record.what == TYPICAL || record.what == "cycles";
        record.tier == tier
            && is_time
            && record.quoted_us.is_some()
            && group_of(&record.name) == title
    };
    records.iter().filter(is_row).collect()
}

fn quoted(rows: &[&Record]) -> impl Iterator<Item = f64> {
    rows.iter().filter_map(|row| row.quoted_us)
}

/// How many times as fast rows are that take so many microseconds together.
fn speed(rows: &[&Record], taken: f64) -> Option<f64> {
    (taken > 0.0).then(|| quoted(rows).sum::<f64>() / taken)
}

/// The least and the most; `None` of nothing.
fn spread(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values
        .map(|value| [value, value])
        .reduce(|[least, most], [value, _]| [least.min(value), most.max(value)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::record::{HEAD, parse_all};

    #[test]
    fn a_row_belongs_to_the_first_group_that_names_it() {
        let titles =
            ["A I0.{b}", "A M1.{b}", "OR VD4, VD8", "ORW VW4, VW8", "MOVD *AC1, VD8", "NETR"]
                .map(group_of);
        let known =
            ["contacts of I and SM", "contacts of M, T, C", "INV AND OR XOR", "INV AND OR XOR"];
        assert_eq!(titles[..4], known);
        assert_eq!(titles[4..], ["moves by pointer", OTHERS]);
    }

    #[test]
    fn a_group_is_as_fast_as_all_of_it() {
        let text = format!(
            "{HEAD}\nx,interpreter,cycles,16,16,3,\"EU\"\nx,interpreter,cycles,32,48,5,\"ED\"\n\
                x,native,cycles,8,8,3,\"EU\"\n\
             x,native,cycles,24,24,5,\"ED\"\n"
        );
        let lines = lines(&parse_all(&text).unwrap());
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert_eq!((line.title, line.interpreter, line.quoted), ("EU ED", [1.0, 3.0], [3.0, 5.0]));
        assert_eq!((line.native, line.speed), (Some([0.5, 1.5]), [Some(2.0), Some(4.0)]));
    }
}
