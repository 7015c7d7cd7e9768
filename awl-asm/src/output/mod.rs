//! What is made of an assembled program or an image: listing, map, costs, machine code, and text
//! again.

pub mod cost;
mod cycles;
pub mod disassemble;
pub mod for_tools;
pub mod listing;
pub mod longest_scan;
pub mod manual;
pub mod map;
pub mod native;
pub mod reals;
