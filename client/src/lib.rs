//! The other end of a PLC's line, as a library that runs anywhere: what can be asked and how the
//! answers read, frames, operands and values, programs compared and shown with their power flow.
//! It opens no port, reads no clock and draws nothing: bytes and times are passed in and out.
//!
//! A [`service::Question`] becomes a request, a [`line::Line`] makes frames of it and takes the
//! bytes that come back. [`show`] is the live view of a program: keys and news in, questions out.

pub mod compare;
pub mod error;
pub mod fault;
pub mod image;
pub mod line;
pub mod operand;
pub mod program;
pub mod reference;
pub mod service;
pub mod show;
pub mod trace;
pub mod value;

pub use error::Error;
pub use operand::Operand;
pub use program::Program;
pub use reference::Reference;
