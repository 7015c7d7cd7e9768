//! Tasks of the repository: `cargo xtask demo`, `test`, `firmware`, `board` and so on. Nothing here is shipped.

mod avr;
mod bench;
mod board;
mod budgets;
mod demo;
mod docs;
mod firmware;
mod modules;
mod packages;
mod process;
mod rules;
mod size;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Tasks of the repository.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// A sorting station runs its AWL program: timeline, counts, timing diagram.
    Demo,
    /// Everything that must hold: format, lints, rules, tests on host and virtual board, budgets.
    Test {
        /// Leave out what needs the AVR toolchain or the virtual board; the last line says so.
        #[arg(long)]
        host_only: bool,
    },
    /// Measures interpreter and assembler and compares them with their budgets.
    Bench,
    /// Builds the firmware for the Uno: target/firmware/uno200.elf and uno200.hex.
    Firmware,
    /// Assembles the modules of firmware/modules into awl-asm/modules, from where the assembler takes them.
    Modules {
        /// Only compare, and fail if it would change.
        #[arg(long)]
        check: bool,
    },
    /// Flash, SRAM and stack of the firmware, compared with their budgets.
    Size,
    /// Starts a virtual Uno on a pseudo-terminal and prints its port.
    Board {
        /// It has the firmware already.
        #[arg(long)]
        with_firmware: bool,
    },
    /// Writes the generated files in docs.
    Docs {
        /// Only compare, and fail if it would change.
        #[arg(long)]
        check: bool,
    },
}

fn main() -> ExitCode {
    let result = match Arguments::parse().task {
        Task::Demo => demo::run(),
        Task::Test { host_only } => test::run(host_only),
        Task::Bench => bench::run(),
        Task::Firmware => firmware::build().map(|elf| println!("{} and .hex", elf.display())),
        Task::Modules { check } => modules::run(check),
        Task::Size => size::run(),
        Task::Board { with_firmware } => board::start(with_firmware),
        Task::Docs { check } => docs::run(check),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
