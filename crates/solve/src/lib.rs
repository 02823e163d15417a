//! Whether a condition over a model can hold: in which state, by cases or by a solver of SMT-LIB.
//!
//! In: a checked term ([`translate()`]). Out: a [`Formula`], first-order logic without quantifiers over the locations that
//! the term reads; [`Formula::decide`] looks for a state in which it holds. Where all locations that matter have finitely
//! many values, or are only compared with constants, the cases are gone through; else the formula is written as SMT-LIB
//! and a [`Solver`], which the shell brings, is asked. An answer is a state, none, or unknown with the reason.
//!
//! Transition relations are too large for such trees: [`shared`] terms stand once, and a [`session`] with a solver keeps what
//! it was told. [`encode`] puts the rules and terms of a program into them; `verify` makes relations of these.
//!
//! The meaning of terms is that of `machine`; tests hold the two to each other. It must not start a process.

mod answer;
mod cases;
mod decide;
pub mod encode;
mod formula;
mod script;
pub mod session;
pub mod shared;
pub mod symbol;
mod translate;

pub use decide::{Decision, Solver};
pub use formula::{Arithmetic, Carrier, Formula, Order, Sort, Symbol, SymbolId, Term, Value};
pub use translate::{Outside, translate};
