//! Charts: GRAFCET of IEC 60848 and SFC of IEC 61131-3. What a chart means is in docs/charts.md.
//! It opens no files, and never runs a program.

pub mod diagnostic;
pub mod drawn;
pub mod model;
pub mod set_reset;
pub mod sfcedit;
pub mod summary;

pub use diagnostic::{Code, Diagnostic};
pub use model::Chart;
