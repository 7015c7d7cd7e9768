//! The assembler as a library: AWL text to program image and back, with diagnostics. It never runs a program.

pub mod address;
pub mod ast;
pub mod diagnostic;
pub mod parser;
pub mod render;
pub mod source;
pub mod symbols;
mod blocks;
mod directives;
mod instructions;
mod lexer;
mod literal;
mod mnemonics;
mod resolve;
mod suggest;

pub mod assemble;
pub mod check;
pub mod disassemble;
pub mod encode;
pub mod files;
pub mod hex;
pub mod listing;
pub mod map;
pub mod plan;
pub mod select;

pub use address::Address;
