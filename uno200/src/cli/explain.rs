//! `explain`: the page of a code, of whichever language.

use anyhow::{Result, bail};
use diagnostics::unknown_code;
use project::Code;

use super::output::print;

/// Writes the page to standard output.
pub(super) fn explain(code: &str) -> Result<()> {
    match Code::find(code) {
        Some(found) => print(found.page().as_bytes()),
        None => bail!("{}", unknown_code(code, Code::all().map(Code::text))),
    }
}
