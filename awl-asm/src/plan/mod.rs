//! What an image has to hold besides the program's own instructions: memory plan, modules,
//! constants, hidden instructions. No bytes of instructions.

pub(crate) mod constants;
pub mod demand;
pub mod modules;
pub(crate) mod takeover;
