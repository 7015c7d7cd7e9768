//! Tests of charts: texts, pages of errors, drawings, and random charts in two implementations.

mod coarse;
mod compiled;
mod drawing;
mod edit_refusals;
mod edits;
mod evaluator;
mod grafcet;
mod large;
mod messages;
mod pages;
mod placements;
mod random_charts;
mod random_grafcet;
mod random_text;
mod text;
