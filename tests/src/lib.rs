//! What the tests of all machines share: cases, a naive evaluator of AWL, random programs, broken texts.

pub mod case;
pub mod effort;
pub mod forms;
pub mod mutate;
pub mod naive;
pub mod random;
