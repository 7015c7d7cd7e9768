//! The assembler as a library: AWL text to program image and back, with diagnostics. It never runs
//! a program.
//!
//! The folders are its pipeline, and each uses the ones before it only: `text`, `meaning`, `plan`,
//! `image`; [`assemble`] runs them; `output` is made of what is assembled. `host` is what
//! command lines need besides.

pub mod assemble;
pub mod diagnostic;
#[cfg(feature = "cli")]
mod host;
mod image;
mod meaning;
mod output;
mod plan;
mod text;

pub use diagnostics::{render, source};
#[cfg(feature = "cli")]
pub use host::{args, drive, files, firmware, flash, report};
pub use image::{encode, hex, tools, uf2};
pub use meaning::{check, select, selected, units};
pub use output::{cost, disassemble, for_tools, listing, longest_scan, manual, map, native, reals};
pub use plan::{demand, modules};
pub use text::{
    address, ast, cursor, data_block, declared, directive_table, escapes, format, locals,
    mnemonics, operand, parser, refused, suggest, symbols,
};

pub use address::Address;
