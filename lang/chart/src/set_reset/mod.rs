//! Structured Text from charts, the set/reset way: a step is set by its transitions and taken back
//! by the steps after it. What this way does and does not do is in docs/charts.md; programs that
//! run here are made by [`crate::translate`], which evaluates all transitions first.
//!
//! [`mod@plan`] is what is generated without the words of a target, `targets` writes it.

pub(crate) mod action_text;
mod assemble;
pub mod plan;
mod style;
mod table;
pub(crate) mod targets;
mod uses;
pub mod variables;
mod well_formed;

pub use assemble::plan;
pub(crate) use assemble::{Style, assembled};
pub use table::table;
pub use targets::{Target, plcopen_head, write};
