//! Writes a program to a board, with the firmware where that is asked for. avrdude does it; here it
//! is called, and its failures are explained.

mod avrdude;
mod cause;
mod failure;
mod ports;

use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use ihex::{Reader, Record, create_object_file_representation};
use tempfile::{Builder, TempPath};

use crate::host::firmware;
use crate::image::hex::intel_hex;

use avrdude::Operation;
pub use failure::Failure;

/// avrdude gives up on a silent board after about a minute. Writing and verifying the whole flash
/// takes ten seconds.
const TIME_MAX: Duration = Duration::from_secs(90);
/// On a board that has answered and falls silent later it hangs. Its progress shows many times a
/// second.
const SILENCE_MAX: Duration = Duration::from_secs(5);
/// Bytes of the firmware that tell it from others: interrupt vectors and start-up code, which know
/// where all the rest is.
const HEAD_LEN: u16 = 1024;

/// What is done about the firmware before the program is written. Both are Intel HEX.
#[derive(Debug)]
pub enum Firmware {
    /// It is written, too.
    Write(String),
    /// It must be there: a board without it is an error, and nothing is written.
    Expect(String),
}

impl Firmware {
    /// What the argument `--with-firmware`, with or without a file, asks for.
    pub fn asked_for(argument: Option<&Option<PathBuf>>) -> Result<Firmware> {
        match argument {
            Some(named) => firmware::hex(named.as_deref()).map(Firmware::Write),
            None => firmware::hex(None).map(Firmware::Expect),
        }
    }
}

/// Writes an image to the program slot of the board at a serial port and has it verified.
///
/// `name` is what avrdude's messages call the program. `echo` shows them on stderr as they come. An
/// error is a [`Failure`] if it came from avrdude or the board.
pub fn flash(port: &str, firmware: &Firmware, image: &[u8], name: &str, echo: bool) -> Result<()> {
    let first = match firmware {
        Firmware::Write(hex) => Operation::write(temporary(hex, "uno200")?),
        Firmware::Expect(hex) => Operation::verify(temporary(&head(hex)?, "uno200")?),
    };
    let second = Operation::write(temporary(&intel_hex(image)?, name)?);
    let ended = avrdude::run(
        avrdude::command(port, &[&first, &second]),
        avrdude::Patience { whole: TIME_MAX, silence: SILENCE_MAX },
        echo,
    );
    match cause::of(&ended, matches!(firmware, Firmware::Expect(_))) {
        None => Ok(()),
        Some(cause) => Err(Failure::new(port, cause, &ended, echo).into()),
    }
}

/// What tells this firmware from others, as Intel HEX.
fn head(firmware: &str) -> Result<String> {
    let mut records = Vec::new();
    for record in Reader::new(firmware) {
        match record? {
            Record::Data { offset, value } if offset < HEAD_LEN => {
                records.push(Record::Data { offset, value });
            }
            _ => {}
        }
    }
    ensure!(!records.is_empty(), "the firmware has nothing at its beginning");
    records.push(Record::EndOfFile);
    Ok(create_object_file_representation(&records)?)
}

/// A file for avrdude. It is removed when the returned path is dropped.
fn temporary(hex: &str, name: &str) -> Result<TempPath> {
    let write = || {
        let mut file = Builder::new().prefix(&format!("{name}-")).suffix(".hex").tempfile()?;
        file.write_all(hex.as_bytes())?;
        // Closed: on Windows avrdude could not open it otherwise.
        Ok::<_, std::io::Error>(file.into_temp_path())
    };
    write().context("cannot write a temporary file")
}
