//! `events`: a block of IEC 61499 event by event, typed or from a script, and its service
//! sequences.

use std::fs::File;
use std::io::{self, BufRead, BufReader, IsTerminal, Write};

use anyhow::{Context as _, Result, anyhow};
use awl_asm::files::read_source;
use awl_asm::report::Report;
use diagnostics::Severity;
use fb::parsed::{Parsed, parse};
use fb::session::{Done, Mistake, Session};
use fb::{Block, service};

use uno200::args::Events;

/// Runs a block; returns whether all is as expected.
pub(super) fn events(arguments: &Events) -> Result<bool> {
    let source = read_source(&arguments.file)?;
    let fb::Read { block, diagnostics } = fb::read(&source);
    let mut report = Report::new(arguments.messages, false);
    report.show(&source, &diagnostics);
    let Some(block) = block else { return Ok(false) };
    let parsed = parse(&block, &source);
    report.show(&source, &parsed.diagnostics);
    if parsed.diagnostics.iter().any(|one| one.severity() == Severity::Error) {
        return Ok(false);
    }
    match arguments.service {
        true => Ok(sequences(&block, &parsed, |span| {
            let (line, column) = source.position(span.start as usize);
            format!("{}:{line}:{column}", source.name)
        })),
        false => work(arguments, &block, &parsed),
    }
}

/// Runs the service sequences of a block and tells which of them hold.
fn sequences(block: &Block, parsed: &Parsed, place: impl Fn(diagnostics::Span) -> String) -> bool {
    let all = block.service.iter().flat_map(|one| &one.sequences);
    let mut is_good = true;
    let mut count = 0;
    for sequence in all {
        count += 1;
        let name = &sequence.name.text;
        match service::run(block, parsed, sequence) {
            Ok(()) => println!("holds: {name}"),
            Err(broken) => {
                is_good = false;
                println!("does not hold: {name}\n  {}: {}", place(broken.span), broken.message);
            }
        }
    }
    if count == 0 {
        println!("{} has no service sequences", block.name.text);
    }
    is_good
}

fn work(arguments: &Events, block: &Block, parsed: &Parsed) -> Result<bool> {
    let mut session = Session::new(block, parsed)
        .map_err(|stopped| anyhow!("{}: {stopped}", arguments.file.display()))?;
    let input: Box<dyn BufRead> = match &arguments.script {
        Some(path) => {
            let file =
                File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
            Box::new(BufReader::new(file))
        }
        None => Box::new(io::stdin().lock()),
    };
    let is_typed = arguments.script.is_none() && io::stdin().is_terminal();
    let name = arguments.script.as_ref().map_or("stdin".into(), |path| path.display().to_string());
    prompt(is_typed)?;
    for (number, line) in (1..).zip(input.lines()) {
        let line = line.with_context(|| format!("cannot read {name}"))?;
        match session.obey(&line) {
            Ok(Done::End) => return Ok(true),
            Ok(Done::Said(text)) if text.is_empty() => {}
            Ok(Done::Said(text)) => println!("{text}"),
            Ok(Done::Failed(text)) if is_typed => println!("{text}"),
            Ok(Done::Failed(text)) => {
                println!("{name}:{number}: {text}");
                return Ok(false);
            }
            Err(mistake) if is_typed => anstream::eprintln!("{}", told(&mistake, &line)),
            Err(mistake) => {
                let column = column(&mistake, &line);
                let text = told(&mistake, &line);
                return Err(anyhow!("{name}:{number}:{column}\n{text}"));
            }
        }
        prompt(is_typed)?;
    }
    Ok(true)
}

fn prompt(is_typed: bool) -> Result<()> {
    if is_typed {
        print!("event> ");
        io::stdout().flush()?;
    }
    Ok(())
}

/// The column where a mistake begins, from 1.
fn column(mistake: &Mistake, line: &str) -> usize {
    line.get(..mistake.span.start as usize).unwrap_or(line).chars().count() + 1
}

/// A mistake under its line.
fn told(mistake: &Mistake, line: &str) -> String {
    let Mistake { span, message, help } = mistake;
    let marks = "^".repeat(span.text(line).chars().count().max(1));
    let blanks = " ".repeat(column(mistake, line) - 1);
    let help = help.iter().map(|help| format!("\n  = {help}")).collect::<String>();
    format!("  {line}\n  {blanks}{marks} {message}{help}")
}
