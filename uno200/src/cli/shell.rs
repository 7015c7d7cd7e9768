//! `shell`: commands line by line over one connection, typed or from a script. What the commands do
//! is theirs.

use std::fs::File;
use std::io::{self, BufRead, BufReader, IsTerminal, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use anyhow::{Context as _, Result, bail};
use clap::{Parser, Subcommand};

use super::context::Context;
use super::{execute, mistaken};
use uno200::args::{Ask, time};

/// A line of the shell.
#[derive(Debug, Parser)]
#[command(name = "", no_binary_name = true, disable_version_flag = true)]
struct Line {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[command(flatten)]
    Ask(Ask),
    /// Lets time pass: wait 500ms
    Wait {
        /// How long
        #[arg(value_parser = time)]
        time: Duration,
    },
    /// Ends the shell
    #[command(visible_alias = "quit")]
    Exit,
}

/// What comes after a line.
enum Next {
    Line,
    End,
}

/// Executes lines until there are no more. A script ends at the first that is not good; who types
/// goes on.
pub(super) fn shell(context: &mut Context, script: Option<&Path>) -> Result<bool> {
    let input: Box<dyn BufRead> = match script {
        Some(path) => {
            let file =
                File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
            Box::new(BufReader::new(file))
        }
        None => Box::new(io::stdin().lock()),
    };
    let is_typed = script.is_none() && io::stdin().is_terminal();
    let name = script.map_or("stdin".into(), |path| path.display().to_string());
    prompt(is_typed)?;
    for (number, line) in (1..).zip(input.lines()) {
        let line = line.with_context(|| format!("cannot read {name}"))?;
        match (obey(context, &line), is_typed) {
            (Ok((Next::End, _)), _) => return Ok(true),
            (Ok((Next::Line, true)), _) => {}
            (Ok((Next::Line, false)), true) => {}
            (Ok((Next::Line, false)), false) => {
                eprintln!("{name}:{number}: ends here");
                return Ok(false);
            }
            (Err(error), true) => anstream::eprintln!("error: {error:#}"),
            (Err(error), false) => return Err(error.context(format!("{name}:{number}"))),
        }
        prompt(is_typed)?;
    }
    Ok(true)
}

fn prompt(is_typed: bool) -> Result<()> {
    if is_typed {
        print!("uno200> ");
        io::stdout().flush()?;
    }
    Ok(())
}

/// Executes a line; with it comes whether all is good.
fn obey(context: &mut Context, line: &str) -> Result<(Next, bool)> {
    let Some(words) = shlex::split(line) else { bail!("{line}: a quote is not closed") };
    // `#` begins a comment.
    if words.is_empty() {
        return Ok((Next::Line, true));
    }
    let command = match Line::try_parse_from(&words) {
        Ok(line) => line.command,
        Err(error) if !error.use_stderr() => {
            error.print()?;
            return Ok((Next::Line, true));
        }
        Err(error) => {
            let text = mistaken::told(&error, &words).unwrap_or_else(|| error.to_string());
            bail!("{}", text.trim_start_matches("error: ").trim_end())
        }
    };
    match command {
        Command::Exit => return Ok((Next::End, true)),
        Command::Wait { time } => sleep(time),
        Command::Ask(ask) => return execute(context, ask).map(|is_good| (Next::Line, is_good)),
    }
    Ok((Next::Line, true))
}
