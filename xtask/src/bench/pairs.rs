//! Structured Text beside hand-written AWL that does what the same scenario expects: bytes and
//! cycles, for docs/benchmarks.md, and whether they are within the budget. It needs no board:
//! cycles are those of the longest scan, as the assembler tells them.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use awl_asm::assemble::assemble;
use awl_asm::cost::cost;
use awl_asm::source::Source;

use crate::budgets;
use crate::process::root;

/// Folders of hand-written programs; those in Structured Text are below `examples/st`.
const FOLDERS: [(&str, &str); 2] =
    [("examples", "examples/st"), ("examples/tutorial", "examples/st/tutorial")];

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
    st: Size,
    /// The same with exact timers, where those of the text need not be.
    exact: Option<Size>,
    awl: Size,
}

/// The tables of the page.
pub fn tables() -> Result<String> {
    let pairs = pairs()?;
    let mut page = String::from(
        "\n## Structured Text\n\n\
         Programs of `examples/st` beside the hand-written ones of `examples`; both do what the \
         same scenario expects. *Bytes*\nare those of instructions, *interpreter* and *native* \
         the cycles of the longest scan as `awl-asm` tells them.\n\n",
    );
    let chosen = |pair: &Pair| Some(pair.st);
    table(&mut page, &pairs, &chosen);
    page.push_str(
        "\nThe same with timers that are exact, to the millisecond, in place of those of the \
         controller (without `{coarse}`):\n\n",
    );
    table(&mut page, &pairs, &|pair| pair.exact);
    Ok(page)
}

fn table(page: &mut String, pairs: &[Pair], chosen: &dyn Fn(&Pair) -> Option<Size>) {
    page.push_str("| program | bytes | AWL |  | interpreter | AWL |  | native | AWL |  |\n");
    page.push_str("|---|---|---|---|---|---|---|---|---|---|\n");
    for pair in pairs {
        let Some(st) = chosen(pair) else { continue };
        let _ = write!(page, "| {} |", pair.name);
        for (of_st, of_awl) in st.figures().into_iter().zip(pair.awl.figures()) {
            let _ = write!(page, " {of_st} | {of_awl} | {:.2} |", of_st as f64 / of_awl as f64);
        }
        page.push('\n');
    }
    let _ = write!(page, "| median |");
    for of_one in 0..3 {
        let _ = write!(page, " | | {:.2} |", median(ratios(pairs, chosen, of_one)));
    }
    page.push('\n');
}

/// Fails where Structured Text takes more than it may.
pub fn judge() -> Result<()> {
    let pairs = pairs()?;
    ensure!(pairs.len() >= 10, "only {} programs are there in both languages", pairs.len());
    for (of_one, what) in ["bytes", "cycles", "cycles in machine code"].into_iter().enumerate() {
        let all = ratios(&pairs, &|pair| Some(pair.st), of_one);
        let most = all.iter().copied().fold(0.0, f64::max);
        let middle = median(all);
        println!("Structured Text: {what}: median {middle:.2}, most {most:.2} times those of AWL");
        ensure!(
            middle <= budgets::ST_MEDIAN_MAX && most <= budgets::ST_RATIO_MAX,
            "Structured Text takes more {what} than the budget allows (median {}, most {})",
            budgets::ST_MEDIAN_MAX,
            budgets::ST_RATIO_MAX
        );
    }
    Ok(())
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

fn pairs() -> Result<Vec<Pair>> {
    let mut pairs = Vec::new();
    for (folder_awl, folder_st) in FOLDERS {
        for path in texts(&root().join(folder_st))? {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let by_hand = root().join(folder_awl).join(&name).with_extension("awl");
            if !by_hand.is_file() {
                continue;
            }
            let text = read(&path)?;
            let exact = text.replace("{coarse}", "");
            let exact = if exact == text { None } else { Some(size(&path, exact)?) };
            let (st, awl) = (size(&path, text)?, size(&by_hand, read(&by_hand)?)?);
            pairs.push(Pair { name, st, exact, awl });
        }
    }
    Ok(pairs)
}

fn texts(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "st"));
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
    let native = cost.translated.as_ref().filter(|longest| longest.is_known());
    let (true, Some(native)) = (cost.interpreted.is_known(), native) else {
        anyhow::bail!("{name}: the longest scan is not known");
    };
    Ok(Size { bytes, interpreted: cost.interpreted.program, native: native.program })
}
