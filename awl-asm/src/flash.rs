//! Writes a program to a board, with the firmware where that is asked for. avrdude does it; here it is called, and its
//! failures are explained.

mod avrdude;
mod cause;
mod failure;
mod ports;

use std::io::Write;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result};
use tempfile::{Builder, TempPath};

use crate::hex::intel_hex;

pub use failure::Failure;

/// avrdude gives up on a silent board after about a minute, but hangs on one that falls silent later. Writing and
/// verifying the whole flash takes ten seconds.
const TIME_MAX: Duration = Duration::from_secs(90);

/// Writes an image to the program slot of the board at a serial port and has it verified.
///
/// `firmware` is an Intel HEX file that is written first. `name` is what avrdude's messages call the program. `echo`
/// shows them on stderr as they come. An error is a [`Failure`] if it came from avrdude or the board.
pub fn flash(port: &str, firmware: Option<&Path>, image: &[u8], name: &str, echo: bool) -> Result<()> {
    let program = temporary(image, name).context("cannot write a temporary file")?;
    let files: Vec<&Path> = firmware.into_iter().chain([&*program]).collect();
    let ended = avrdude::run(avrdude::command(port, &files), TIME_MAX, echo);
    match cause::of(&ended) {
        None => Ok(()),
        Some(cause) => Err(Failure::new(port, cause, &ended, echo).into()),
    }
}

/// The image as a file for avrdude. It is removed when the returned path is dropped.
fn temporary(image: &[u8], name: &str) -> Result<TempPath> {
    let mut file = Builder::new().prefix(&format!("{name}-")).suffix(".hex").tempfile()?;
    file.write_all(intel_hex(image)?.as_bytes())?;
    // Closed: on Windows avrdude could not open it otherwise.
    Ok(file.into_temp_path())
}
