//! Formulas of temporal logic over numbered propositions.
//!
//! Each logic has a few basic operators; the others are derived from them as in the books: Clarke, Grumberg, Peled,
//! *Model Checking*, chapter 3; Baier, Katoen, *Principles of Model Checking*, chapters 5 and 6; for the past
//! Lichtenstein, Pnueli, Zuck, *The glory of the past*, 1985. INVARIANT: formulas contain no double negations, and
//! constants only as the whole formula.

mod arena;
mod ctl;
mod logic;
mod ltl;

pub use arena::{Arena, FormulaId};
pub use ctl::{Ctl, CtlFormulas};
pub use logic::{Connective, Logic, Node};
pub use ltl::{Ltl, LtlFormulas};
