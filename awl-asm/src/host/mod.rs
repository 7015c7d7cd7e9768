//! What the command lines share: files, diagnostics, the firmware's place, the way to
//! a board; and the arguments of `awl-asm`.

pub mod args;
pub mod drive;
pub mod files;
pub mod firmware;
pub mod flash;
mod mistaken;
pub mod report;
