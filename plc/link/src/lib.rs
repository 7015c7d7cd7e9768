//! What the controller answers on its line: Modbus, and service functions for commissioning. Bytes
//! and byte order are docs/protocol.md; framing (RTU, TCP) is the machine's.
//!
//! This is what answers mean. The host runs it; the board answers with assembly that is compared
//! with it, so that what a client sees does not depend on which of them answers.
//!
//! A request lies in data memory, in the *frame* after the program's own memory, and the answer
//! replaces it. A machine
//!
//! * holds a [`Link`] and tells it with [`Link::place`] where the frame is, whenever a program was
//!   loaded;
//! * puts a request (function code and data, without unit and checksum) at the frame, and calls
//!   [`answer`] at the end of every scan until it returns a length;
//! * calls [`Forces::apply`] after inputs were read and before outputs are written,
//!   [`Link::status_entries`] before and [`Link::trace_step`] after the program is executed.
#![no_std]

mod answer;
mod crc16;
mod download;
mod forces;
mod identity;
mod link;
mod modbus;
mod place;
pub mod protocol;
mod request;
mod sampling;
mod service;
mod station;
pub mod status;
mod trace;

pub use answer::answer;
pub use crc16::crc16;
pub use forces::Forces;
pub use link::{Link, PDU_MAX};
pub use place::SizedAddress;
pub use request::Exception;
pub use station::{Command, ScanTimes, Station, TEXTS};
