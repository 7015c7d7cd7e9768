//! Basic function blocks of IEC 61499: read, checked, written. What a block means is in
//! docs/iec61499.md. This library opens no files and reads no clock.

pub mod check;
pub mod condition;
pub mod data_type;
pub mod diagnostic;
pub mod drawing;
pub mod generate;
pub mod interpreter;
pub mod matlab;
pub mod model;
pub mod parsed;
mod read;
mod rest;
pub mod service;
pub mod session;
pub mod svg;
pub mod xml;

pub use data_type::DataType;
pub use diagnostic::{Code, Diagnostic};
pub use interpreter::Interpreter;
pub use model::Block;
pub use read::{Read, is_matlab, read};
pub use session::Session;
