//! What the tests of all machines share: cases, a naive evaluator of AWL, random programs, broken
//! texts.

#[cfg(feature = "uno")]
pub mod bench_board;
pub mod beside;
pub mod case;
pub mod commands;
pub mod effort;
#[cfg(feature = "uno")]
pub mod flash_responder;
pub mod forms;
pub mod fuzz;
pub mod image;
#[cfg(feature = "uno")]
pub mod link;
#[cfg(feature = "uno")]
pub mod lockstep;
#[cfg(feature = "uno")]
pub mod measure;
pub mod mutate;
pub mod naive;
#[cfg(feature = "uno")]
pub mod own_clock;
#[cfg(feature = "pico")]
pub mod pico;
#[cfg(feature = "uno")]
pub mod plugged;
#[cfg(feature = "uno")]
pub mod power;
pub mod programs;
pub mod random;
pub mod random_runs;
pub mod retained;
pub mod still_time;
#[cfg(feature = "uno")]
pub mod vm_on_avr;
