//! Runs AWL programs scan by scan: machines, scenarios, plants and traces. Assembling is the
//! business of `awl-asm`.
//!
//! A [`machine::Machine`] is driven by [`run::run`] through a [`scenario::Scenario`], beside it a
//! [`plant::Plant`]; what happened comes out as a [`run::Outcome`] with a [`trace::Trace`]. A
//! [`serve::Endpoint`] drives one in real time, as a PLC on the network.
//!
//! Without the feature `cli` it runs anywhere: no files, sockets, threads, clock or terminal. What
//! a page needs can go to another thread.

pub mod action;
#[cfg(feature = "cli")]
pub mod args;
pub mod coverage;
pub mod machine;
pub mod open;
pub mod operand;
mod piece;
pub mod plant;
pub mod problem;
pub mod pulse;
mod range;
pub mod run;
pub mod scenario;
pub mod serve;
#[cfg(feature = "cli")]
pub mod suite;
pub mod sweep;
pub mod time;
pub mod trace;

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails to compile where it is not so.
    fn can_go_to_another_thread<T: Send>() {}

    #[test]
    fn what_a_page_needs_can_go_to_another_thread() {
        can_go_to_another_thread::<machine::host::Host>();
        can_go_to_another_thread::<open::Opened<machine::host::Host>>();
        can_go_to_another_thread::<open::OpenError>();
        can_go_to_another_thread::<Box<dyn plant::Plant>>();
        can_go_to_another_thread::<scenario::Scenario>();
        can_go_to_another_thread::<run::Course>();
        can_go_to_another_thread::<run::Outcome>();
        can_go_to_another_thread::<trace::Trace>();
        can_go_to_another_thread::<serve::Endpoint<usize>>();
    }
}
