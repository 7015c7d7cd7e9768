//! Talking to a running PLC from this computer: ports and sockets, files, the terminal view; and
//! to editors, as a language server. What a PLC is asked and how it is understood is in [`client`];
//! exit codes are the binary's.

pub mod args;
mod connection;
pub mod ide;
pub mod lsp;
pub mod program;
mod service;
pub mod show;
pub mod transport;

pub use connection::Client;
