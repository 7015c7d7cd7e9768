//! The files that are part of the tools, as the build has found them.

include!(concat!(env!("OUT_DIR"), "/files.rs"));
