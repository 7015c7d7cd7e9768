//! `build --fmt`: a text in canonical layout. A file is written whole or not at all.

use anyhow::{Context as _, Result, bail, ensure};
use awl_asm::files::{ensure_no_source, is_same_file, read, write_whole};
use awl_asm::format::first_difference;
use awl_asm::report::Report;
use awl_asm::source::Source;
use project::{Language, format};

use super::args::Build;
use super::output::print;

/// Returns whether the text has no errors of form and, with --check, is in canonical layout.
pub(super) fn layout(arguments: &Build) -> Result<bool> {
    let [path] = arguments.files.as_slice() else { bail!("--fmt takes one file at a time") };
    let source = Source::from_bytes(path.display().to_string(), &read(path)?)?;
    let text = match format(&source) {
        Ok(text) => text,
        Err(errors) => {
            Report::new(arguments.messages, false).show(&source, &errors);
            return Ok(false);
        }
    };
    if arguments.check {
        let difference = first_difference(&source.text, &text);
        if let Some(line) = difference {
            let name = path.display();
            eprintln!("{name}:{line}: not in canonical layout; `uno200 build --fmt` writes it");
        }
        return Ok(difference.is_none());
    }
    let bytes =
        source.encoding.encode(&text).context("a character is not in the file's code page")?;
    let Some(output) = &arguments.output else { return print(&bytes).map(|()| true) };
    let name = output.display().to_string();
    ensure!(
        Language::of(&name) == Language::of(&source.name),
        "{name}: the layout of a text changes, not its language; without --fmt it becomes AWL"
    );
    if !is_same_file(path, output) {
        ensure_no_source(output, arguments.overwrite)?;
    }
    write_whole(output, &bytes).map(|()| true)
}
