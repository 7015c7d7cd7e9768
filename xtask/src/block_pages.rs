//! The pages of the library of signal blocks in docs/blocks.md: what each file says of its block,
//! its parameters, and what it costs on the board.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result, ensure};
use awl_asm::assemble::assemble;
use awl_asm::cost::cost;
use awl_asm::source::Source;
use plc_isa::{Header, Plan};
use st::library::{BLOCKS, Block};
use st::{Around, compile};

use crate::process::root;

/// The file, and the line after which it is written by this program.
pub const FILE: &str = "docs/blocks.md";
const MARK: &str =
    "<!-- Written by `cargo xtask docs` from lang/st/blocks; do not edit below. -->\n";

/// The file with the pages as they are now.
pub fn text() -> Result<String> {
    let before = fs::read_to_string(root().join(FILE)).with_context(|| format!("no {FILE}"))?;
    let (by_hand, _) = before.split_once(MARK).context("docs/blocks.md: its mark is missing")?;
    let mut text = format!(
        "{by_hand}{MARK}\n| block | | program, bytes | memory, bytes | cycles at most |\n\
         |---|---|---|---|---|\n"
    );
    for block in &BLOCKS {
        let Cost { bytes, memory, cycles } = Cost::of(block)?;
        let (name, anchor) = (block.name, block.name.to_lowercase());
        let comment = block.comment();
        let first = comment.lines().next().unwrap_or_default().trim_end_matches('.');
        let row = format!("[{name}](#{anchor}) | {first} | {bytes} | {memory} | {cycles}");
        let _ = writeln!(text, "| {row} |");
    }
    BLOCKS.iter().for_each(|block| page(block, &mut text));
    Ok(text)
}

fn page(block: &Block, text: &mut String) {
    let (outputs, inputs): (Vec<_>, Vec<_>) =
        block.parameters().into_iter().partition(|one| one.is_output);
    let [of_inputs, of_outputs] =
        [&inputs, &outputs].map(|all| all.iter().map(|one| one.name).collect::<Vec<_>>());
    let picture = picture(block.name, &of_inputs, &of_outputs);
    let _ = write!(text, "\n### {}\n\n```text\n{picture}```\n", block.name);
    let _ = write!(text, "\n{}\n", block.comment());
    for (title, all) in [("input", inputs), ("output", outputs)] {
        let _ = write!(text, "\n| {title} | type | |\n|---|---|---|\n");
        for one in all {
            let _ = writeln!(text, "| `{}` | `{}` | {} |", one.name, one.declared, one.comment);
        }
    }
}

/// A block as diagrams draw it: inputs on the left, outputs on the right.
fn picture(name: &str, inputs: &[&str], outputs: &[&str]) -> String {
    let left = inputs.iter().map(|one| one.len()).max().unwrap_or(0);
    let (line, blanks) = ("─".repeat(name.len()), " ".repeat(name.len()));
    let mut picture = format!("{:left$} ┌─{line}─┐\n", "");
    for row in 0..inputs.len().max(outputs.len()) {
        let input =
            inputs.get(row).map_or(format!("{:left$} │", ""), |one| format!("{one:>left$} ┤"));
        let output = outputs.get(row).map_or("│".to_owned(), |one| format!("├ {one}"));
        let inside = if row == 0 { name } else { &blanks };
        let _ = writeln!(picture, "{input} {inside} {output}");
    }
    let _ = writeln!(picture, "{:left$} └─{line}─┘", "");
    picture
}

/// What an instance more costs that is called once, without arguments.
struct Cost {
    /// Of the image.
    bytes: usize,
    /// Of data memory.
    memory: u16,
    /// Of the longest way through it, interpreted.
    cycles: u64,
}

impl Cost {
    fn of(block: &Block) -> Result<Cost> {
        let [one, two] = [1, 2].map(|count| image(block, count));
        let (one, two) = (one?, two?);
        let [of_one, of_two] = [&one, &two].map(|image| longest(image));
        Ok(Cost {
            bytes: two.len() - one.len(),
            memory: end(&two)? - end(&one)?,
            cycles: of_two? - of_one?,
        })
    }
}

/// The image of a program with so many instances.
fn image(block: &Block, count: usize) -> Result<Vec<u8>> {
    let numbers = 0..count;
    let names: Vec<String> = numbers.map(|number| format!("Block{number}")).collect();
    let calls: String = names.iter().map(|name| format!("{name}();\n")).collect();
    let declared = names.join(", ");
    let kind = block.name;
    let text = format!("PROGRAM Main\nVAR {declared} : {kind}; END_VAR\n{calls}END_PROGRAM\n");
    let compiled = compile(&[Source::new("main.st", text)?], &Around::default());
    let awl = compiled.awl.with_context(|| format!("{kind}: {:?}", compiled.diagnostics))?;
    let assembly = assemble(&Source::new("main.awl", awl)?, Vec::new());
    let diagnostics = assembly.diagnostics;
    assembly.image.with_context(|| format!("{kind}: {diagnostics:?}"))
}

fn longest(image: &[u8]) -> Result<u64> {
    let found = cost(image).context("an image for a board")?.interpreted;
    ensure!(found.is_known(), "not known: {:?}", found.missing);
    Ok(found.program)
}

/// One past the last byte of its data.
fn end(image: &[u8]) -> Result<u16> {
    let header = Header::read(&image).ok().context("a header")?;
    Ok(Plan::trusted(image, header).end())
}
