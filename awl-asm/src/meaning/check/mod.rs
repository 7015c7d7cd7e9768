//! Checks of a whole program: control flow, logic stack, use of memory. Each finds all it can in
//! one pass.

mod control;
mod counting;
mod inactive;
mod local_reads;
mod mixed_coils;
mod no_result;
mod overlap;
mod parting;
mod permission;
mod placement;
mod presets;
mod rung;
mod same_answer;
mod sequence;
mod stack;
mod steps;
mod usage;
mod whole_reals;

pub use control::{Control, control, labels};
pub use counting::counting;
pub use local_reads::local_reads;
pub use mixed_coils::mixed_coils;
pub use no_result::no_result;
pub use overlap::overlap;
pub use permission::{intervals, permission};
pub use placement::placement;
pub use presets::presets;
pub use same_answer::same_answer;
pub use sequence::sequence;
pub use stack::{Depths, stack};
pub use steps::steps;
pub use usage::{Access, Usage, usage};
pub use whole_reals::whole_reals;
