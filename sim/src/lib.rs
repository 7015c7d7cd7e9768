//! Runs AWL programs scan by scan: machines, scenarios, plants and traces. Assembling is the business of `awl-asm`.
//!
//! A [`machine::Machine`] is driven by [`run::run`] through a [`scenario::Scenario`], beside it a [`plant::Plant`];
//! what happened comes out as a [`run::Outcome`] with a [`trace::Trace`]. A [`serve::Server`] drives one in real time, as a
//! PLC on the network.

pub mod action;
pub mod machine;
pub mod open;
pub mod operand;
pub mod plant;
pub mod problem;
pub mod pulse;
pub mod run;
pub mod scenario;
pub mod serve;
pub mod time;
pub mod trace;
