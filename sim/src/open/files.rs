//! From a path to a machine, on the host or on a virtual Uno.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use awl_asm::files::{ensure_program, read};

use super::{File, Opened, Read, ensure_no_hex};
use crate::machine::host::Host;
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
}

impl ProgramFiles<'_> {
    /// Opens the program on a machine.
    ///
    /// Errors in the program come as [`OpenError::Errors`](super::OpenError::Errors), all at once.
    /// A bad image is none: it is opened, and the machine is in STOP with a fault, as a board would
    /// be.
    pub fn open(self, target: Target) -> Result<Opened> {
        let Read { image, place_of, about } = self.read(target != Target::Host)?;
        Ok(about.on(machine(image, place_of, target)?))
    }

    /// The same on the host, as a machine that can be more than run scan by scan.
    pub fn open_host(self) -> Result<Opened<Host>> {
        let Read { image, place_of, about } = self.read(false)?;
        Ok(about.on(Box::new(Host::new(image, place_of))))
    }

    fn read(self, needs_board: bool) -> Result<Read> {
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
        Ok(Read::of(&program, &tables, data.as_ref(), needs_board)?)
    }
}

/// [`ProgramFiles::open`] of a program without a data block of its own. `symbol_files`: further
/// symbols.
pub fn open_machine(program: &Path, symbol_files: &[PathBuf], target: Target) -> Result<Opened> {
    ProgramFiles { program: &[program.into()], symbols: symbol_files, data: None }.open(target)
}

/// [`ProgramFiles::open_host`] of such a program.
pub fn open_host(program: &Path, symbol_files: &[PathBuf]) -> Result<Opened<Host>> {
    ProgramFiles { program: &[program.into()], symbols: symbol_files, data: None }.open_host()
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
    }
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
    anyhow::bail!(
        "this awl-sim was built without the virtual Uno; on Debian:\n  \
         apt-get install libsimavr-dev libelf-dev\n  cargo install --path sim --features simavr"
    )
}
