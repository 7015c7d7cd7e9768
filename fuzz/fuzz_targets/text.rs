//! Fuzz target for cargo-fuzz: `tests::fuzz::text`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tests::fuzz::text(bytes));
