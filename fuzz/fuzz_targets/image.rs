//! Fuzz target for cargo-fuzz: `tests::fuzz::image`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| tests::fuzz::image(bytes));
