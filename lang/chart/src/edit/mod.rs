//! Edits of charts. Each is *closed*: it leaves a chart that can be read again as it is, or is
//! refused for a reason in words, and then nothing has changed. None depends on how a chart is
//! drawn. Elements keep their identity, and [`Undo`] takes an edit back.
//!
//! What edits mean, docs/charts.md says. `draft` carries one of `kinds` out, with `steps`,
//! `transitions`, `blocks`, `places`, `naming` and `copies`; `index` finds what it needs.

mod around;
mod blocks;
mod change;
mod copies;
mod draft;
mod editing;
mod index;
mod kinds;
mod legible;
mod naming;
mod origins;
mod places;
mod refusal;
mod steps;
mod transitions;

pub use change::Undo;
pub use editing::{Done, Editing};
pub use kinds::{ChartPath, Edit, Element, Wanted};
pub use refusal::Refusal;
