//! Structured Text, charts and diagrams beside hand-written AWL that does what the same scenario
//! expects: bytes and cycles, for docs/benchmarks.md, and whether they are within the budget. It
//! needs no board: cycles are those of the longest scan, as the assembler tells them.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use awl_asm::assemble::assemble;
use awl_asm::cost::{Longest, cost};
use awl_asm::source::Source;
use chart::model::Origin;
use chart::text::Piece;

use crate::budgets;
use crate::process::root;

/// A language whose programs are compared.
struct Language {
    title: &'static str,
    ending: &'static str,
    /// Folders of hand-written programs, each with that of the programs in the language.
    folders: &'static [(&'static str, &'static str)],
    /// What the page says before the tables.
    words: &'static str,
    /// How many programs there are at least.
    least: usize,
    /// How often as much as by hand it may take: the median, and the most.
    budget: (f64, f64),
    /// The text with timers of the controller, as far as it can have them.
    coarse: fn(String) -> Result<String>,
}

const LANGUAGES: [Language; 3] = [
    Language {
        title: "Structured Text",
        ending: "st",
        folders: &[("examples", "examples/st"), ("examples/tutorial", "examples/st/tutorial")],
        words: "Programs of `examples/st` beside the hand-written ones of `examples`; both do what \
                the same scenario expects. *Bytes*\nare those of instructions, *interpreter* and \
                *native* the cycles of the longest scan as `awl-asm` tells them.\n\n",
        least: 10,
        budget: (budgets::COMPILED_MEDIAN_MAX, budgets::COMPILED_RATIO_MAX),
        coarse: Ok,
    },
    Language {
        title: "Charts",
        ending: "sfc",
        folders: &[("examples", "examples/sfc"), ("examples/tutorial", "examples/sfc/tutorial")],
        words: "The same of charts, SFC of `examples/sfc` and of the exercises (by hand in \
                `tests/by_hand`), with `{coarse}`\nat each step.\n\n",
        least: 6,
        budget: (budgets::COMPILED_MEDIAN_MAX, budgets::COMPILED_RATIO_MAX),
        coarse: coarse_steps,
    },
    Language {
        title: "Diagrams",
        ending: "fbd",
        folders: &[("tests/by_hand/diagrams", "examples/fbd")],
        words: "A control loop of `examples/fbd`, with the blocks EVERY, ANALOG_IN, PID and \
                ANALOG_OUT of the library, beside one\nby hand with the instruction PID. The \
                diagram has limits, a filter, anti-windup and changes without a jump, and\neach \
                value with a name.\n\n",
        least: 1,
        budget: (budgets::DIAGRAM_RATIO_MAX, budgets::DIAGRAM_RATIO_MAX),
        coarse: Ok,
    },
];

/// Exercises that are solved by hand, too: files called like the folder of the exercise.
const EXERCISES_BY_HAND: &str = "tests/by_hand";

/// What a program takes.
#[derive(Debug, Clone, Copy)]
struct Size {
    /// Bytes of its instructions.
    bytes: u64,
    /// Cycles of the longest scan, interpreted.
    interpreted: u64,
    /// The same in machine code.
    native: u64,
}

impl Size {
    fn figures(self) -> [u64; 3] {
        [self.bytes, self.interpreted, self.native]
    }
}

/// A program in both languages.
struct Pair {
    name: String,
    compiled: Size,
    /// The same with exact timers, where those of the text need not be.
    exact: Option<Size>,
    awl: Size,
}

/// The tables of the page.
pub fn tables() -> Result<String> {
    let mut page = String::new();
    for language in &LANGUAGES {
        let pairs = language.pairs()?;
        let _ = write!(page, "\n## {}\n\n{}", language.title, language.words);
        table(&mut page, &pairs, &|pair| Some(pair.compiled));
        if pairs.iter().all(|pair| pair.exact.is_none()) {
            continue;
        }
        page.push_str(
            "\nThe same with timers that are exact, to the millisecond, in place of those of the \
             controller (without `{coarse}`):\n\n",
        );
        table(&mut page, &pairs, &|pair| pair.exact);
    }
    Ok(page)
}

fn table(page: &mut String, pairs: &[Pair], chosen: &dyn Fn(&Pair) -> Option<Size>) {
    page.push_str("| program | bytes | AWL |  | interpreter | AWL |  | native | AWL |  |\n");
    page.push_str("|---|---|---|---|---|---|---|---|---|---|\n");
    for pair in pairs {
        let Some(compiled) = chosen(pair) else { continue };
        let _ = write!(page, "| {} |", pair.name);
        for (of_one, of_awl) in compiled.figures().into_iter().zip(pair.awl.figures()) {
            let _ = write!(page, " {of_one} | {of_awl} | {:.2} |", of_one as f64 / of_awl as f64);
        }
        page.push('\n');
    }
    let _ = write!(page, "| median |");
    for of_one in 0..3 {
        let _ = write!(page, " | | {:.2} |", median(ratios(pairs, chosen, of_one)));
    }
    page.push('\n');
}

/// Fails where a language takes more than it may.
pub fn judge() -> Result<()> {
    LANGUAGES.iter().try_for_each(Language::judge)
}

impl Language {
    fn judge(&self) -> Result<()> {
        let pairs = self.pairs()?;
        let title = self.title;
        ensure!(pairs.len() >= self.least, "{title}: only {} pairs of programs", pairs.len());
        for (of_one, what) in ["bytes", "cycles", "cycles in machine code"].into_iter().enumerate()
        {
            let all = ratios(&pairs, &|pair| Some(pair.compiled), of_one);
            let most = all.iter().copied().fold(0.0, f64::max);
            let middle = median(all);
            println!("{title}: {what}: median {middle:.2}, most {most:.2} times those of AWL");
            let (middle_max, most_max) = self.budget;
            ensure!(
                middle <= middle_max && most <= most_max,
                "{title}: more {what} than the budget allows (median {middle_max}, most {most_max})"
            );
        }
        Ok(())
    }

    fn pairs(&self) -> Result<Vec<Pair>> {
        let mut pairs = Vec::new();
        for &(folder_awl, folder) in self.folders {
            for path in texts(&root().join(folder), self.ending)? {
                let by_hand = root().join(folder_awl).join(stem(&path)).with_extension("awl");
                if by_hand.is_file() {
                    pairs.push(self.pair(&path, &by_hand)?);
                }
            }
        }
        for by_hand in texts(&root().join(EXERCISES_BY_HAND), "awl")? {
            let exercise = root().join("examples/exercises").join(stem(&by_hand));
            let path = exercise.join("solution").with_extension(self.ending);
            if path.is_file() {
                pairs.push(self.pair(&path, &by_hand)?);
            }
        }
        Ok(pairs)
    }

    fn pair(&self, path: &Path, by_hand: &Path) -> Result<Pair> {
        let text = (self.coarse)(read(path)?)?;
        let exact = text.replace("{coarse}", "");
        let exact = if exact == text { None } else { Some(size(path, exact)?) };
        let (compiled, awl) = (size(path, text)?, size(by_hand, read(by_hand)?)?);
        Ok(Pair { name: stem(by_hand), compiled, exact, awl })
    }
}

fn ratios(pairs: &[Pair], chosen: &dyn Fn(&Pair) -> Option<Size>, of_one: usize) -> Vec<f64> {
    let ratio = |pair: &Pair| {
        let (st, awl) = (chosen(pair)?.figures()[of_one], pair.awl.figures()[of_one]);
        Some(st as f64 / awl as f64)
    };
    pairs.iter().filter_map(ratio).collect()
}

/// The one in the middle, or the mean of the two there.
fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    let middle = all.len() / 2;
    match (all.len() % 2, all.get(middle.wrapping_sub(1)), all.get(middle)) {
        (0, Some(before), Some(after)) => (before + after) / 2.0,
        (_, _, Some(one)) => *one,
        _ => 0.0,
    }
}

/// A text whose charts permit timers of the controller at each step.
fn coarse_steps(text: String) -> Result<String> {
    let source = Source::new("chart.sfc", text).map_err(|_| anyhow::anyhow!("too long"))?;
    let mut document = chart::text::read(&source).document;
    for piece in &mut document.pieces {
        if let Piece::Chart(chart) = piece {
            chart.steps.values_mut().for_each(|step| step.coarse = Some(Origin::default()));
        }
    }
    Ok(chart::text::write(&document))
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn texts(folder: &Path, ending: &str) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|found| found == ending));
    paths.sort();
    Ok(paths)
}

fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// What a program of either language takes.
fn size(path: &Path, text: String) -> Result<Size> {
    let name = path.display().to_string();
    let source =
        Source::new(name.as_str(), text).map_err(|_| anyhow::anyhow!("{name}: too long"))?;
    let joined =
        project::join(vec![source]).map_err(|_| anyhow::anyhow!("{name}: does not compile"))?;
    let assembly = assemble(&joined.awl, Vec::new());
    let image = assembly.image.as_deref().with_context(|| format!("{name}: no image"))?;
    let bytes = assembly.lines.iter().map(|line| u64::from(line.len)).sum();
    let cost = cost(image).with_context(|| format!("{name}: not for the board"))?;
    let known = |longest: Option<&Longest>| longest.filter(|one| one.is_known()).cloned();
    let (Some(interpreted), Some(native)) =
        (known(Some(&cost.interpreted)), known(cost.translated.as_ref()))
    else {
        anyhow::bail!("{name}: the longest scan is not known");
    };
    Ok(Size { bytes, interpreted: interpreted.program, native: native.program })
}
