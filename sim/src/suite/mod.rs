//! Scenarios as tests, whatever runs them: which there are, with their programs, and how their
//! results are told.

pub mod errors;
mod find;
mod junit;
mod report;
mod reports;
mod result;
mod tap;
mod words;

pub use find::{is_program, plant_for, program_for, read_text, scenarios};
pub use reports::{Reports, Telling, ensure_no_source};
pub use result::TestResult;
pub use words::{plural, run_in_words};
