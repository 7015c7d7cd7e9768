//! The longest scan in words: how long it is, what that goes by, what is missing for it. How it is
//! found is said elsewhere.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::assemble::Assembly;
use crate::output::cost::{Assumption, CYCLES_PER_US, Longest, Missing, Often, ProgramCost};
use crate::source::{At, Source};

/// What the listing says at its end.
pub fn report(source: &Source, assembly: &Assembly, cost: &ProgramCost) -> String {
    let report = Report { source, assembly };
    let mut text = String::from("\n");
    let native = cost.translated.as_ref().map(|longest| ("native", longest));
    for (name, longest) in [("interpreter", &cost.interpreted)].into_iter().chain(native) {
        let _ = writeln!(text, "longest scan, {name}: {}", figures(longest));
    }
    let watchdog = u64::from(assembly.program.settings.watchdog_ms) * 1_000;
    if us(cost.interpreted.scan) > watchdog {
        let _ = writeln!(
            text,
            "the watchdog ends a scan of the interpreter before, after {watchdog} us"
        );
    }
    let of = |longest: Option<&Longest>| {
        longest.map(|longest| longest.missing.clone()).unwrap_or_default()
    };
    let missing = [of(Some(&cost.interpreted)), of(cost.translated.as_ref())].concat();
    let lines = missing.into_iter().map(|one| report.missing(one));
    let lines = lines.chain(cost.interpreted.assumptions.iter().map(|one| report.assumption(one)));
    let mut seen = BTreeSet::new();
    for line in lines.filter(|line| seen.insert(line.clone())) {
        let _ = writeln!(text, "  {line}");
    }
    if cost.is_typical {
        text += "  instructions of modules: as measured with usual values, and a tenth more\n";
    }
    if cost.translated.is_none() {
        text += "native: the program cannot be translated\n";
    }
    text
}

/// The same in a few words, after the sizes of a program.
pub fn summary(source: &Source, assembly: &Assembly, longest: &Longest) -> String {
    let report = Report { source, assembly };
    match longest.missing.first() {
        None => format!("longest scan {} us", us(longest.scan)),
        Some(&first) => format!(
            "longest scan not known, {} us without it: {}",
            us(longest.scan),
            report.missing(first)
        ),
    }
}

fn figures(longest: &Longest) -> String {
    let cycles = |cycles: u64| format!("{cycles} cycles, {} us", us(cycles));
    let (program, scan) = (cycles(longest.program), cycles(longest.scan));
    match longest.is_known() {
        true => format!("program {program}, whole scan {scan}"),
        false => format!("not known; without what is missing program {program}, whole scan {scan}"),
    }
}

/// Cycles of the board in microseconds, rounded up.
pub fn us(cycles: u64) -> u64 {
    cycles.div_ceil(u64::from(CYCLES_PER_US))
}

struct Report<'a> {
    source: &'a Source,
    assembly: &'a Assembly,
}

impl Report<'_> {
    /// Where the instruction at an offset of the image is.
    fn place(&self, at: u16) -> String {
        match self.assembly.place_at(self.source, at) {
            Some(place) if place.file != self.source.name => place.to_string(),
            Some(place) => match place.at {
                At::Line { line, .. } => format!("line {line}"),
                At::Element(_) => place.to_string(),
            },
            None => format!("offset {at:04X}"),
        }
    }

    /// The instruction at an offset as it is written.
    fn words(&self, at: u16) -> String {
        let index = self.assembly.lines.iter().position(|line| line.holds(at));
        let selected = index.and_then(|index| self.assembly.code.get(index));
        let text = selected.map(|one| self.assembly.span_of(one).text(&self.source.text));
        text.unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn missing(&self, missing: Missing) -> String {
        let told = |at: u16, what: &str, ask: &str| {
            format!("{}: {}: {what}: a line {ask} before it says", self.place(at), self.words(at))
        };
        match missing {
            Missing::Bound(at) => {
                told(at, "how often this is repeated is not known", "`//# bound 10`")
            }
            Missing::Rate(at, event) => {
                let what = format!("how often event {event} occurs is not known");
                told(at, &what, "`//# rate 100` (a second)")
            }
            Missing::Pulses(at) => {
                let what = "how many edges or pulses there are is not known";
                told(at, what, "`//# rate 1000` (a second)")
            }
            Missing::Cost(at) => {
                format!("{}: {}: its cycles are not known", self.place(at), self.words(at))
            }
            Missing::NoTimeLeft => {
                "interrupts as often as stated leave the program no time: no scan ends".to_owned()
            }
        }
    }

    fn assumption(&self, assumption: &Assumption) -> String {
        let (at, what) = match *assumption {
            Assumption::Passes { at, most, is_stated: true } => {
                (at, format!("at most {most} times (`//# bound`)"))
            }
            Assumption::Passes { at, most, is_stated: false } => (
                at,
                format!(
                    "at most {most} times, by all values of its operands: `//# bound` says less"
                ),
            ),
            Assumption::Event { at, number, often } => {
                (at, format!("event {number} {}", often_text(often)))
            }
            Assumption::Hardware { at, often } => (at, often_text(often)),
        };
        format!("{}: {}: {what}", self.place(at), self.words(at))
    }
}

fn often_text(often: Often) -> String {
    match often {
        Often::Stated(rate) => format!("at most {rate} times a second (`//# rate`)"),
        Often::Period(ms) => format!("every {ms} ms at most"),
        Often::Characters => "at most as often as characters come at 115200 baud".to_owned(),
    }
}
