//! What the tests of all machines share: a naive evaluator of AWL, random programs, broken texts. Runs no machine.

pub mod mutate;
pub mod naive;
pub mod random;
