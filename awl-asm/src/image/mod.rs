//! From a checked and planned program to the bytes of its image.

pub mod encode;
mod eno;
pub mod hex;
mod too_large;
pub mod tools;
pub mod uf2;
