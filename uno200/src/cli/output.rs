//! What goes to standard output as it is.

use std::io::{ErrorKind, Write};

use anyhow::{Context as _, Result};

/// Writes to standard output; a reader that has seen enough is no error.
pub(super) fn print(bytes: &[u8]) -> Result<()> {
    match std::io::stdout().write_all(bytes) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to stdout")
        }
        _ => Ok(()),
    }
}
