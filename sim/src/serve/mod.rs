//! A PLC on the network: a host machine that runs in real time and answers Modbus TCP. What it
//! answers is the business of `plc-link`, as on the board; here are time, connections, and who may
//! do what.
//!
//! [`Frames`] and [`Endpoint`] are driven from outside: bytes in, bytes out, and the time. A
//! [`Server`] drives them with sockets and a clock.

mod access;
mod endpoint;
mod frames;
#[cfg(feature = "cli")]
mod network;
mod pace;
#[cfg(feature = "cli")]
mod server;
mod service;

pub use access::{Access, is_here};
pub use endpoint::{Change, Endpoint};
pub use frames::{Frames, NoModbus};
#[cfg(feature = "cli")]
pub use server::{Server, Stopper};
pub use service::{Answer, Request};
