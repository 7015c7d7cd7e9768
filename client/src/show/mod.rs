//! The live view of a program: its lines with power flow and values from the running PLC, what the
//! user selects, and what is asked for it. How it is drawn, where keys come from and how requests
//! travel is not known here.

mod keys;
pub mod model;
pub mod operands;
pub mod rounds;
mod single_scan;
pub mod state;
mod texts;

pub use keys::{Action, Key};
pub use rounds::Rounds;
