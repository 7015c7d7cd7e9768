//! Charts: GRAFCET of IEC 60848 and SFC of IEC 61131-3. What a chart means is in docs/charts.md.
//! It opens no files, and never runs a program.
//!
//! [`text`] reads a file into the [`model`]; [`translate`] makes Structured Text of it, which
//! becomes AWL like any other. [`interpret`] executes a chart without translating it. [`edit`]
//! changes it. [`drawing`] says what it looks like, [`svg`] writes that as a picture. [`sfcedit`]
//! reads charts of another editor, [`from_sfcedit`] makes programs of those that run here,
//! [`set_reset`] Structured Text for other controllers.

mod check;
mod concurrent;
pub mod diagnostic;
pub mod drawing;
pub mod drawn;
pub mod edit;
pub mod from_sfcedit;
mod generate;
mod hierarchy;
pub mod interpret;
pub mod model;
mod operators;
pub mod set_reset;
pub mod sfcedit;
pub mod summary;
pub mod svg;
pub mod text;
mod together;

pub use diagnostic::{Code, Diagnostic};
pub use generate::{Translation, declared, frame, translate};
pub use model::Chart;
