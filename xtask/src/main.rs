//! Tasks of the repository: `cargo xtask demo`, `test`, `firmware`, `board` and so on. Nothing here
//! is shipped.

mod avr;
mod bench;
mod block_pages;
mod board;
mod boards_page;
mod budgets;
mod demo;
mod dist;
mod docs;
mod elf;
mod firmware;
mod grammar;
mod ide;
mod licences;
mod modules;
mod packages;
mod process;
mod rules;
mod same_names;
mod size;
mod structured_grammar;
mod test;
mod wasm;

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
        /// Leave out what needs the AVR toolchain, the virtual board or node; the last line says
        /// so.
        #[arg(long)]
        host_only: bool,
    },
    /// Checks the rules of the repository that no compiler checks, lock files, sources and licences
    /// of dependencies among them.
    Rules,
    /// Measures interpreter and assembler and compares them with their budgets.
    Bench {
        /// Measure nothing: only write again what is made of docs/benchmarks.csv.
        #[arg(long)]
        pages: bool,
    },
    /// Builds the firmware for the Uno, target/firmware/uno200.elf and uno200.hex, and replaces the
    /// one that is part of the tools, awl-asm/firmware/uno200.hex.
    Firmware {
        /// Replaces it although other compilers built it.
        #[arg(long)]
        keep: bool,
    },
    /// Builds plc-vm whole for an AVR with room, for tests: target/firmware/vm-on-avr.elf.
    VmOnAvr,
    /// Assembles the modules of firmware/modules into awl-asm/modules, from where the assembler
    /// takes them.
    Modules {
        /// Only compare, and fail if it would change.
        #[arg(long)]
        check: bool,
    },
    /// Flash, SRAM and stack of the firmware, compared with their budgets.
    Size,
    /// Builds the libraries for WebAssembly and compares what they do in node with this computer.
    Wasm,
    /// Builds the IDE into target/ide and serves it.
    Ide {
        /// Start no browser.
        #[arg(long)]
        no_open: bool,
        /// Only check: the page is what its sources say, and does what it should in Chromium.
        #[arg(long, conflicts_with = "no_open")]
        check: bool,
        /// Only build its core, and make it the one that is part of the tools.
        #[arg(long, conflicts_with_all = ["no_open", "check"])]
        keep: bool,
    },
    /// Starts a virtual Uno on a pseudo-terminal and prints its port.
    Board {
        /// It has the firmware already.
        #[arg(long)]
        with_firmware: bool,
        /// A board from the factory; without it flash and EEPROM are those of the last time.
        #[arg(long)]
        new: bool,
    },
    /// Writes manuals, completions of shells and a package for Debian: target/dist.
    Dist {
        /// Only with tools for tests: whether they compile for other systems, and whether what is
        /// in the package works.
        #[arg(long)]
        check: bool,
    },
    /// Writes the generated files in docs.
    Docs {
        /// Only compare, and fail if it would change.
        #[arg(long)]
        check: bool,
    },
}

fn main() -> ExitCode {
    if let Some(code) = same_names::compile_if_called() {
        return code;
    }
    let result = match Arguments::parse().task {
        Task::Demo => demo::run(),
        Task::Test { host_only } => test::run(host_only),
        Task::Rules => rules::check().and_then(|()| licences::check()),
        Task::Bench { pages: false } => bench::run(),
        Task::Bench { pages: true } => bench::write_pages(),
        Task::Firmware { keep } => firmware::run(keep),
        Task::VmOnAvr => firmware::build_vm().map(|elf| println!("{}", elf.display())),
        Task::Modules { check } => modules::run(check),
        Task::Size => size::run(),
        Task::Wasm => wasm::check(),
        Task::Ide { check: true, .. } => ide::check(),
        Task::Ide { keep: true, .. } => ide::keep(),
        Task::Ide { no_open, .. } => ide::start(!no_open),
        Task::Board { with_firmware, new } => board::start(with_firmware, new),
        Task::Dist { check: false } => dist::run(),
        Task::Dist { check: true } => dist::check_systems().and_then(|()| dist::check()),
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
