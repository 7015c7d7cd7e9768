//! Structured Text from charts, the set/reset way: a step is set by its transitions and taken back
//! by the steps after it. What this way does and does not do is in docs/charts.md; programs that
//! run here are made by [`crate::translate`], which evaluates all transitions first.
//!
//! [`mod@plan`] is what is generated without the words of a target, `targets` writes it.

mod assemble;
pub mod plan;
mod style;
mod table;
mod targets;
pub mod variables;

pub use assemble::plan;
pub use table::table;
pub use targets::{Target, plcopen_head, write};
