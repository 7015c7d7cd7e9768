//! Blocks as XML files (`.fbt`): reading and writing. What a block means is not asked here.

mod locals;
mod read;
mod write;

pub use read::read;
pub use write::write;
