//! Source texts, places in them, and errors and warnings about them: one home for every language of
//! the repository. It has no codes of its own, reads no file and writes to no terminal.

pub mod binary;
mod codes;
pub mod diagnostic;
pub mod origins;
pub mod render;
pub mod source;
pub mod traced;
pub mod windows_1252;
pub mod xml;

pub use codes::unknown_code;
pub use diagnostic::{Code, Diagnostic, Severity};
pub use source::{At, Place, Source, Span};
