//! Charts from the notations of other tools: SCXML.
//!
//! In: a text. Out: the text of a chart, and what of the other notation has no counterpart, each with its place. INVARIANT:
//! nothing is left out without a word; with an error there is no chart.

mod names;
mod scxml;
mod tree;

pub use scxml::scxml;

use syntax::Diagnostic;

/// What an import gives.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The text of the chart; none where there is an error.
    pub text: Option<String>,
    /// What could not be taken over, and faults.
    pub diagnostics: Vec<Diagnostic>,
}
