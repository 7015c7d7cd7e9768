//! The assembler as a library: AWL text to program image and back, with diagnostics. It never runs a program.

pub mod address;
pub mod assemble;
pub mod ast;
mod blocks;
pub mod check;
pub mod cost;
pub mod diagnostic;
mod directives;
pub mod disassemble;
pub mod encode;
pub mod files;
pub mod firmware;
pub mod flash;
pub mod hex;
mod instructions;
mod lexer;
pub mod listing;
mod literal;
pub mod map;
mod mnemonics;
pub mod native;
pub mod parser;
pub mod plan;
pub mod render;
mod resolve;
pub mod select;
pub mod source;
pub mod suggest;
pub mod symbols;

pub use address::Address;
