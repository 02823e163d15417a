//! Temporal properties over an explored graph: CTL and LTL with past, under fairness.
//!
//! In: a [`crate::graph::Graph`], formulas over its propositions, fairness. Out: a [`FormulaVerdict`]. It knows neither how the
//! graph came about nor what the propositions say. INVARIANT: Holds is said only of a complete graph.

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
