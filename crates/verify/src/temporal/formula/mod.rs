//! Formulas of temporal logic over numbered propositions.
//!
//! Each logic has a few operators of its own; the others are built from them as the books define them: Clarke, Grumberg,
//! Peled, *Model Checking*, chapter 3; Baier, Katoen, *Principles of Model Checking*, chapters 5 and 6; for the past
//! Lichtenstein, Pnueli, Zuck, *The glory of the past*, 1985. INVARIANT: double negations and constants do not stand in a
//! formula other than as the whole of it.

mod arena;
mod ctl;
mod logic;
mod ltl;

pub use arena::{Arena, FormulaId};
pub use ctl::{Ctl, CtlFormulas};
pub use logic::{Connective, Logic, Node};
pub use ltl::{Ltl, LtlFormulas};
