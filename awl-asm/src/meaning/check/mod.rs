//! Checks of a whole program: control flow, logic stack, use of memory. Each finds all it can in
//! one pass.

mod control;
mod counting;
mod inactive;
mod mixed_coils;
mod overlap;
mod parting;
mod permission;
mod placement;
mod rung;
mod sequence;
mod stack;
mod usage;

pub use control::{Control, control, labels};
pub use counting::counting;
pub use mixed_coils::mixed_coils;
pub use overlap::overlap;
pub use permission::permission;
pub use placement::placement;
pub use sequence::sequence;
pub use stack::{Depths, stack};
pub use usage::{Access, Usage, usage};
