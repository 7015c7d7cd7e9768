//! The arguments of `awl-asm`.

use std::path::PathBuf;

use clap::Parser;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use plc_isa::Profile;

use super::firmware;
use super::report::Messages;

/// Assembles S7-200 AWL (STL) into a program image.
///
/// Exit status: 0 good, 1 errors in the program, 2 everything else: usage, files, the board.
#[derive(Debug, Parser)]
#[command(name = "awl-asm", version)]
pub struct Arguments {
    /// The program. Several files make one: the main program and its routines, as Micro/WIN exports
    /// single blocks.
    #[arg(required_unless_present_any = ["disassemble", "explain"])]
    pub program: Vec<PathBuf>,

    /// The image: .bin; .hex for Intel HEX at the program slot; .uf2 with the firmware, for the
    /// Pico's drive. Default: the program's name with .bin. With --fmt and --disassemble the text.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Lets an output replace a text that is there, such as another program.
    #[arg(long)]
    pub overwrite: bool,

    /// Translates the program to machine code: several times as fast, and several times as long.
    /// Runs on the board only.
    #[arg(long)]
    pub native: bool,

    /// The board that the program is for, as if its text named it (`//# board`).
    #[arg(long, value_name = "NAME", value_parser = board())]
    pub board: Option<&'static Profile>,

    /// Writes a listing: offset, bytes and stack depth beside each source line.
    #[arg(long, value_name = "FILE")]
    pub listing: Option<PathBuf>,

    /// Writes a map: memory plan and cross-reference.
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,

    /// Reads a symbol table: name, address, comment; separated by tabs or commas. Can be repeated.
    #[arg(long, value_name = "FILE")]
    pub symbols: Vec<PathBuf>,

    /// Reads a data block: what V memory holds before the first scan, such as `VB0 1, 2, 3`.
    #[arg(long, value_name = "FILE")]
    pub data: Option<PathBuf>,

    /// How messages are written.
    #[command(flatten)]
    pub messages: Messages,

    /// Takes warnings for errors: a program that has any is not assembled.
    #[arg(long)]
    pub deny_warnings: bool,

    /// Prints the program in canonical layout, that of Micro/WIN's exports, or writes it to the
    /// file after -o. With --check it only says whether the program is in that layout.
    #[arg(
        long,
        conflicts_with_all = ["native", "listing", "map", "data", "flash", "disassemble", "explain"]
    )]
    pub fmt: bool,

    /// With --fmt: writes addresses for symbols, as Micro/WIN wants them. With -o there is a symbol
    /// table beside the program, with the extension .csv.
    #[arg(long, requires = "fmt", conflicts_with = "check")]
    pub resolve: bool,

    /// Checks the program and writes nothing.
    #[arg(long)]
    pub check: bool,

    /// Writes the program to the Uno at this serial port, such as /dev/ttyACM0 or COM3, which needs
    /// avrdude; or with the firmware onto this drive of a Pico. Without -o no file is written.
    #[arg(long, value_name = "PORT|DRIVE", conflicts_with = "check")]
    pub flash: Option<String>,

    /// With --flash: writes the firmware first, as a new board needs it. Without a file the one
    /// that is part of this program.
    #[arg(
        long,
        value_name = "FILE.hex",
        num_args = 0..=1,
        requires = "flash",
        value_parser = firmware::hex_file
    )]
    pub with_firmware: Option<Option<PathBuf>>,

    /// Turns an image back into AWL.
    #[arg(
        long,
        value_name = "IMAGE",
        conflicts_with_all = ["program", "explain", "check", "listing", "map", "flash", "native"]
    )]
    pub disassemble: Option<PathBuf>,

    /// Explains an error or warning, such as E0012.
    #[arg(long, value_name = "CODE", conflicts_with_all = ["program", "flash"])]
    pub explain: Option<String>,
}

/// Takes the name of a board.
pub fn board() -> impl TypedValueParser<Value = &'static Profile> {
    let names = PossibleValuesParser::new(Profile::ALL.map(|profile| profile.name));
    // No other names come out of it.
    names.map(|name| Profile::named(&name).unwrap_or_default())
}
