//! Words of the command line that are taken for files of the program and belong to an option: what
//! they are, and how they are written. What the options mean is not known here.

use std::path::Path;

use anyhow::{Result, bail};
use awl_sim::args::Args;
use awl_sim::operand::Operand;
use awl_sim::plant::PLANTS;
use awl_sim::time::parse_time;

/// Refuses such words. A file that is there is none, whatever its name.
pub fn ensure_files(args: &Args) -> Result<()> {
    let missing = args.program.iter().filter(|path| *path != Path::new("-") && !path.exists());
    let words: Vec<&str> = missing.filter_map(|path| path.to_str()).collect();
    for word in &words {
        if let Some((name, value)) = word.split_once('=') {
            setting(args, &words, name, value)?;
        } else if parse_time(word).is_ok() {
            bail!("{word} is a time: `--for {word}`");
        } else if is_signal(args, word) {
            traced(args, &words)?;
        }
    }
    Ok(())
}

/// An operand, or after `--trace` a name that is that of no file.
fn is_signal(args: &Args, word: &str) -> bool {
    let word = word.trim_matches(',');
    let is_name = !word.is_empty() && !word.contains(['.', '/', '\\', '=']);
    Operand::parse(word, &[]).is_ok() || args.trace.is_some() && is_name
}

fn traced(args: &Args, words: &[&str]) -> Result<()> {
    let signals = words.iter().filter(|word| is_signal(args, word)).copied();
    let all: Vec<&str> = args.trace.as_deref().into_iter().chain(signals.clone()).collect();
    let all: Vec<&str> = all.iter().map(|part| part.trim_matches(',')).collect();
    let names: Vec<&str> = signals.map(|word| word.trim_matches(',')).collect();
    let what = if names.len() == 1 { "is an operand" } else { "are operands" };
    bail!("{} {what}: `--trace {}`", names.join(", "), all.join(","))
}

/// `level=20`, which the plant takes, or `I0.0=1`, which a scenario sets.
fn setting(args: &Args, words: &[&str], name: &str, value: &str) -> Result<()> {
    if Operand::parse(name, &[]).is_ok() {
        bail!("{name}={value} sets a value: in a scenario, `at 0ms {name} = {value}`");
    }
    let takes = |plant: &str| {
        let kind = PLANTS.iter().find(|kind| kind.name == plant);
        kind.is_some_and(|kind| kind.options.iter().any(|(option, _)| *option == name))
    };
    let plant = match &args.plant {
        Some(plant) => Some(plant.as_str()),
        None => PLANTS.iter().map(|kind| kind.name).find(|plant| takes(plant)),
    };
    let Some(plant) = plant else { return Ok(()) };
    let is_option = |word: &&&str| {
        word.split_once('=').is_some_and(|(name, _)| Operand::parse(name, &[]).is_err())
    };
    let options: Vec<&str> = words.iter().filter(is_option).copied().collect();
    bail!("{name}={value} is an option of the plant: `--plant \"{plant} {}\"`", options.join(" "))
}
