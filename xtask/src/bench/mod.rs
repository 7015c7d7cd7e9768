//! `cargo xtask bench`: speed of the board, of the host interpreter and of the assembler, compared
//! with their budgets and with what was measured before. Writes docs/benchmarks.md.

mod board;
mod budget;
mod comparison;
mod costs;
mod exceptions;
mod page;
mod pairs;
mod record;
mod text;

use anyhow::Result;

use crate::process::{cargo, run as run_command};

/// Measures everything and writes the page, unless the board has become slower.
pub fn run() -> Result<()> {
    pairs::judge()?;
    let host = gate();
    board::write()?;
    host
}

/// Tries of the gate. One process can be twice as slow as the next without a change of the program:
/// where its pages and branches fall is luck. A program that has become slow is slow in all of
/// them.
const TRIES: usize = 3;

/// The budgets of the host: an optimised build does the measuring.
pub fn gate() -> Result<()> {
    let measure =
        || run_command(cargo().args(["run", "--quiet", "--release", "--package", "speed"]));
    let mut result = measure();
    for _ in 1..TRIES {
        if result.is_ok() {
            break;
        }
        println!("missed: measuring again");
        result = measure();
    }
    result
}

/// Writes again what is made of the figures that were measured last, such as with other words.
pub fn write_pages() -> Result<()> {
    board::write_pages()
}

/// What is made of the measured figures says what they say, and Structured Text is within its
/// budget. Needs no board.
pub fn check_files() -> Result<()> {
    pairs::judge()?;
    board::check_files()
}

/// The budgets of the board, and that it is as fast as the page says.
pub fn board_gate() -> Result<()> {
    board::check()
}
