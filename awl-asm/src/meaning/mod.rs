//! What the instructions of a syntax tree are, and what is wrong with them. Nothing has a place in
//! memory yet.

pub(crate) mod boards;
mod calls;
pub mod check;
mod example;
pub(crate) mod extent;
mod fit;
pub(crate) mod free_places;
pub(crate) mod hardware;
pub(crate) mod limits;
mod misfit;
mod operand_constants;
mod operand_count;
mod operand_widths;
mod operands;
mod order;
mod pick;
mod pointers;
pub mod promises;
pub(crate) mod quoted;
pub(crate) mod segments;
pub mod select;
pub mod selected;
pub(crate) mod special;
pub mod units;
mod values;
