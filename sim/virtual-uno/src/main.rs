//! The command `virtual-uno`: a board on a pseudo-terminal until Ctrl-C, with pins to be driven
//! from standard input. The board is the library's.

mod pins;

use std::fs;
use std::io::{BufRead, stdin};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::thread;

use anyhow::{Context, Result};
use clap::Parser;
use virtual_uno::VirtualUno;

use pins::{Lamps, drive};

/// Steps of a millisecond between two looks whether flash or EEPROM have changed.
const SAVE_STEPS: u32 = 500;

/// An Arduino Uno on a pseudo-terminal, in real time. Its path is the first line on stdout.
///
/// Opening the port resets the board into its bootloader, as with a real one, unless the program
/// that had it open last has switched that off (HUPCL). Lines on standard input drive its pins:
/// D2=1 or I0.0=1, A0=2.5 volts or Ain0=2.5; what its outputs do is told there.
#[derive(Parser)]
#[command(name = "virtual-uno", version)]
struct Arguments {
    /// What is in the flash already, as Intel HEX. Can be repeated. Default: nothing but the
    /// bootloader.
    #[arg(long, value_name = "FILE.hex")]
    firmware: Vec<PathBuf>,

    /// Keeps flash and EEPROM in this file while the board is off.
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let mut uno = VirtualUno::new()?;
    let mut kept = Vec::new();
    if let Some(path) = arguments.state.as_deref().filter(|path| path.exists()) {
        kept = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        uno.set_memory(&kept).with_context(|| format!("{} is no board", path.display()))?;
    }
    for file in &arguments.firmware {
        uno.load(file)?;
    }
    println!("{}", uno.port().display());
    eprintln!("an Uno is at this port; Ctrl-C ends it");
    let lines = typed();
    let mut lamps = Lamps::default();
    loop {
        for _ in 0..SAVE_STEPS {
            uno.step()?;
            for line in lines.try_iter() {
                if let Err(error) = drive(uno.avr_mut(), &line) {
                    eprintln!("{error}");
                }
            }
            if let Some(text) = lamps.change(uno.avr()) {
                eprintln!("{text}");
            }
        }
        if let Some(path) = &arguments.state {
            save(path, &uno.memory(), &mut kept)?;
        }
    }
}

/// The lines on standard input, as they come.
fn typed() -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let lines = stdin().lock().lines().map_while(Result::ok);
        // Nobody is left to tell when the board is gone.
        lines.map(|line| sender.send(line)).all(|sent| sent.is_ok())
    });
    receiver
}

/// Writes what has changed, whole or not at all.
fn save(path: &Path, memory: &[u8], kept: &mut Vec<u8>) -> Result<()> {
    if memory == kept {
        return Ok(());
    }
    let part = path.with_extension("part");
    fs::write(&part, memory)
        .and_then(|()| fs::rename(&part, path))
        .with_context(|| format!("cannot write {}", path.display()))?;
    *kept = memory.to_vec();
    Ok(())
}
