//! Talking to a running PLC as a library: client, operands, programs, the terminal view. Arguments and exit codes are
//! the binary's.

pub mod client;
pub mod compare;
pub mod error;
pub mod fault;
pub mod image;
pub mod operand;
pub mod program;
pub mod reference;
pub mod service;
pub mod show;
pub mod trace;
pub mod transport;
pub mod value;

pub use client::Client;
pub use error::Error;
pub use operand::Operand;
pub use program::Program;
pub use reference::Reference;
