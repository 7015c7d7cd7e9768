//! From text to syntax tree and back to canonical layout. What an instruction does is not known
//! here.

pub mod address;
pub mod ast;
mod blocks;
pub(crate) mod boards;
pub mod cursor;
pub mod data_block;
pub mod declared;
pub mod directive_table;
mod directives;
pub mod escapes;
pub(crate) mod foreign;
pub mod format;
pub(crate) mod german;
mod habits;
mod hints;
mod instructions;
mod lexer;
mod line_settings;
mod literal;
pub mod locals;
mod misdeclared;
pub(crate) mod mnemonic_set;
pub mod mnemonics;
pub mod operand;
pub mod parser;
mod piece;
mod pointers;
mod qualified;
pub mod refused;
mod resolve;
pub mod suggest;
pub mod symbols;
pub(crate) mod tree;
mod variables;
