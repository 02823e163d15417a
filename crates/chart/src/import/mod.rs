//! Imports charts from the notations of other tools: SCXML.
//!
//! In: a text. Out: the text of a chart, and everything in the other notation that has no counterpart, with its place.
//! INVARIANT: nothing is left out silently; if there is an error, there is no chart.

mod names;
mod scxml;
mod tree;
mod ways;

pub use scxml::scxml;

use syntax::Diagnostic;

/// The result of an import.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The text of the chart; `None` if there is an error.
    pub text: Option<String>,
    /// What could not be imported, and faults.
    pub diagnostics: Vec<Diagnostic>,
}
