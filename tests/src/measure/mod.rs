//! Measuring on the virtual Uno with the shipped firmware: cycles of scans, of programs, of single
//! instructions. What is fast enough is for others to say.
//!
//! simavr counts every instruction as the data sheet does, except the 4 cycles with which an
//! interrupt begins.

mod executable;
pub mod forms;
mod meter;
pub mod module_rows;
#[cfg(feature = "pico")]
pub mod pico;
pub mod record;
pub mod rows;
pub mod s7_200;
pub mod scans;
pub mod table;
pub mod values;

pub use executable::{Executable, Tier};
pub use meter::{Execution, Meter, Step, elf};
