//! From a path to a machine, on the host, a virtual Uno or an emulated Pico.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use awl_asm::files::{ensure_program, read};
use plc_isa::{PICO, Profile, UNO};

use super::{File, Opened, Read, ensure_no_hex};
use crate::machine::host::Host;
use crate::machine::pico::{self, Pico};
use crate::machine::{Machine, PlaceOf};

/// What runs the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Target {
    /// The reference interpreter on this computer.
    #[default]
    Host,
    /// The firmware on a virtual Uno, interpreting.
    Uno,
    /// The firmware on a virtual Uno, with a translated program.
    UnoNative,
    /// The firmware on an emulated Raspberry Pi Pico.
    Pico,
}

impl Target {
    /// The board that the program must fit on.
    fn board(self) -> Option<&'static Profile> {
        match self {
            Target::Host => None,
            Target::Uno | Target::UnoNative => Some(&UNO),
            Target::Pico => Some(&PICO),
        }
    }
}

/// The files of a program.
#[derive(Debug, Clone, Copy)]
pub struct ProgramFiles<'a> {
    /// AWL text, in one file or several, or an image; `-` is standard input.
    pub program: &'a [PathBuf],
    /// Further symbols.
    pub symbols: &'a [PathBuf],
    /// A data block that is a file of its own.
    pub data: Option<&'a Path>,
    /// The board that its text is for, if it is asked for.
    pub board: Option<&'static Profile>,
}

impl ProgramFiles<'_> {
    /// Opens the program on a machine.
    ///
    /// Errors in the program come as [`OpenError::Errors`](super::OpenError::Errors), all at once.
    /// A bad image is none: it is opened, and the machine is in STOP with a fault, as a board would
    /// be.
    pub fn open(self, target: Target) -> Result<Opened> {
        let board = match (target.board(), self.board) {
            (Some(machine), Some(board)) if machine != board => {
                bail!("the program is asked for {}, and runs on {}", board.title, machine.title)
            }
            (machine, board) => machine.or(board),
        };
        let Read { image, place_of, about } = self.read(board)?;
        Ok(about.on(machine(image, place_of, target)?))
    }

    /// The same on the host, as a machine that can be more than run scan by scan.
    pub fn open_host(self) -> Result<Opened<Host>> {
        let Read { image, place_of, about } = self.read(self.board)?;
        Ok(about.on(Box::new(Host::new(image, place_of))))
    }

    fn read(self, board: Option<&'static Profile>) -> Result<Read> {
        for path in self.program {
            ensure_no_hex(&path.display().to_string())?;
        }
        let program = self.program.iter().map(|path| {
            let file = read_input(path)?;
            ensure_program(path, &file.bytes, self.program)?;
            Ok(file)
        });
        let program: Vec<File> = program.collect::<Result<_>>()?;
        let tables = self.symbols.iter().map(|path| read_input(path));
        let tables: Vec<File> = tables.collect::<Result<_>>()?;
        let data = self.data.map(read_input).transpose()?;
        Ok(Read::of(&program, &tables, data.as_ref(), board)?)
    }
}

/// [`ProgramFiles::open`] of a program without a data block of its own. `symbol_files`: further
/// symbols.
pub fn open_machine(program: &Path, symbol_files: &[PathBuf], target: Target) -> Result<Opened> {
    ProgramFiles { program: &[program.into()], symbols: symbol_files, data: None, board: None }
        .open(target)
}

/// [`ProgramFiles::open_host`] of such a program.
pub fn open_host(program: &Path, symbol_files: &[PathBuf]) -> Result<Opened<Host>> {
    ProgramFiles { program: &[program.into()], symbols: symbol_files, data: None, board: None }
        .open_host()
}

/// Reads a file, or standard input where its name is `-`.
pub fn read_input(path: &Path) -> Result<File> {
    if path != Path::new("-") {
        return Ok(File { name: path.display().to_string(), bytes: read(path)? });
    }
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes).context("cannot read standard input")?;
    Ok(File { name: "<stdin>".to_string(), bytes })
}

fn machine(image: Vec<u8>, place_of: PlaceOf, target: Target) -> Result<Box<dyn Machine>> {
    match target {
        Target::Host => Ok(Box::new(Host::new(image, place_of))),
        Target::Uno | Target::UnoNative => uno(image, place_of, target),
        Target::Pico => pico(image, place_of),
    }
}

/// The firmware refuses what is for another board, too; here it is said what to do.
fn pico(image: Vec<u8>, place_of: PlaceOf) -> Result<Box<dyn Machine>> {
    if let Some(other) = pico::profile(&image).filter(|board| *board != &PICO) {
        bail!(
            "the program is for {}, and the machine is the Pico: write `//# board {}` in its text",
            other.title,
            PICO.name
        );
    }
    let mut pico = Pico::new(&pico::find_firmware()?, place_of)?;
    pico.load(image);
    Ok(Box::new(pico))
}

#[cfg(feature = "simavr")]
fn uno(image: Vec<u8>, place_of: PlaceOf, target: Target) -> Result<Box<dyn Machine>> {
    use crate::machine::uno::{Clock, Code, Firmware, Uno};
    let code = if target == Target::UnoNative { Code::Native } else { Code::Bytecode };
    let mut uno = Uno::new(&Firmware::find()?, code, Clock::FreeRunning, place_of)?;
    uno.load(image)?;
    Ok(Box::new(uno))
}

#[cfg(not(feature = "simavr"))]
fn uno(_image: Vec<u8>, _place_of: PlaceOf, _target: Target) -> Result<Box<dyn Machine>> {
    bail!(
        "this awl-sim was built without the virtual Uno; on Debian:\n  \
         apt-get install libsimavr-dev libelf-dev\n  cargo install --path sim --features simavr"
    )
}
