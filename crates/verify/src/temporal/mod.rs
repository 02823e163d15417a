//! Temporal properties over an explored graph: CTL and LTL with past, under fairness.
//!
//! In: a [`crate::graph::Graph`], formulas over its propositions, fairness. Out: a [`FormulaVerdict`]. It knows neither
//! how the graph was made nor what the propositions mean. INVARIANT: Holds is returned only for a complete graph.

pub mod budget;
pub mod checker;
pub mod component;
pub mod ctl;
pub mod fairness;
pub mod formula;
mod lasso;
pub mod ltl;
pub mod read;
pub mod run;
mod search;
mod verdict;

pub use verdict::{FormulaVerdict, decide_ctl, decide_ltl};
