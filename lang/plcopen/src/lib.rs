//! Projects in XML of PLCopen (TC6): read as Structured Text with charts, and written from that and
//! from diagrams of blocks. It opens no files, and never runs a program. What is read and what is
//! not is in docs/charts.md.

pub mod diagnostic;
mod operators;
mod read;
mod write;

pub use diagnostic::{Code, Diagnostic};
pub use read::{Imported, is_project, read, read_diagrams};
pub use write::{Exported, write, write_diagrams};
