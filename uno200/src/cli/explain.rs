//! `explain`: the page of a code, of whichever language.

use anyhow::{Result, bail};
use project::Code;

use super::output::print;

/// Writes the page to standard output.
pub(super) fn explain(code: &str) -> Result<()> {
    match Code::find(code) {
        Some(found) => print(found.page().as_bytes()),
        None => {
            let known: Vec<&str> = Code::all().map(Code::text).collect();
            bail!("{code} is no code of an error or warning; known are {}", known.join(" "))
        }
    }
}
