//! Manual pages and completions of shells, from the arguments of the tools.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use clap::CommandFactory;
use clap_complete::Shell;
use clap_complete::generate_to;

use super::tools::{TOOLS, output};
use super::tree;

/// The shells that completions are for.
const SHELLS: [Shell; 5] = [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::PowerShell, Shell::Elvish];

fn commands() -> [clap::Command; 3] {
    [
        awl_asm::args::Arguments::command(),
        awl_sim::args::command(),
        uno200::args::Arguments::command(),
    ]
}

/// Writes `man/*.1` and `completions/SHELL/*`.
pub(super) fn write(folder: &Path) -> Result<()> {
    let man = folder.join("man");
    tree::new(&man)?;
    for command in commands() {
        clap_mangen::generate_to(command, &man).context("cannot write the manuals")?;
    }
    tree::new(&folder.join("completions"))?;
    for shell in SHELLS {
        let folder = folder.join("completions").join(shell.to_string());
        tree::create(&folder)?;
        for mut command in commands() {
            let name = command.get_name().to_string();
            generate_to(shell, &mut command, name, &folder)
                .context("cannot write the completions")?;
        }
    }
    Ok(())
}

/// Whether there is a page for each tool and its commands, and whether bash takes the completions.
pub(super) fn check(folder: &Path) -> Result<()> {
    for page in ["awl-asm", "awl-sim", "awl-sim-test", "uno200", "uno200-flash"] {
        let path = folder.join("man").join(page).with_extension("1");
        let text = String::from_utf8(tree::read(&path)?)?;
        let has_title = text.lines().any(|line| line.starts_with(&format!(".TH {page} 1")));
        ensure!(has_title && text.contains("\\-\\-symbols"), "{}: no manual", path.display());
    }
    for tool in TOOLS {
        let script = folder.join(format!("completions/bash/{tool}.bash"));
        let complete = format!("source '{}' && complete -p {tool}", script.display());
        let known = output(Command::new("bash").args(["--norc", "-c", &complete]))?;
        ensure!(known.contains(tool), "{}: completes nothing", script.display());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent_and_those_of_the_tools() {
        let names = commands().map(|command| {
            command.clone().debug_assert();
            command.get_name().to_string()
        });
        assert_eq!(names, TOOLS);
    }
}
