//! Fuzz target for cargo-fuzz: `tests::fuzz::scenario`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tests::fuzz::scenario(bytes));
