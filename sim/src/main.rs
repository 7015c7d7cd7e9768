//! The command `awl-sim`. All it does is in the library; here are arguments, messages and exit
//! codes.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(cli::main())
}
