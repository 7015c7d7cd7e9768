//! The command `virtual-uno`: a board on a pseudo-terminal until Ctrl-C. The work is done by the library.

use std::path::PathBuf;

use anyhow::Result;
use clap::Parser;
use virtual_uno::VirtualUno;

/// An Arduino Uno on a pseudo-terminal, in real time. Its path is the first line on stdout.
///
/// Opening the port resets the board into its bootloader, as with a real one.
#[derive(Parser)]
#[command(name = "virtual-uno", version)]
struct Arguments {
    /// What is in the flash already, as Intel HEX. Can be repeated. Default: nothing but the bootloader.
    #[arg(long, value_name = "FILE.hex")]
    firmware: Vec<PathBuf>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let mut uno = VirtualUno::new()?;
    for file in &arguments.firmware {
        uno.load(file)?;
    }
    println!("{}", uno.port().display());
    eprintln!("an Uno is at this port; Ctrl-C ends it");
    loop {
        uno.step()?;
    }
}
