//! What is asked of solvers: terms and rules of programs as formulas, and whether a condition can hold.
//!
//! [`encode`] puts the terms and rules of a program into [`shared`] terms, of which each stands once; what a [`session`] with
//! a solver was told it keeps. `verify` makes transition relations of these.
//!
//! In: a program and a condition about a state that may be any ([`question()`]). Out: a [`Question`], first-order logic
//! without quantifiers over the locations that it reads; [`Question::decide`] looks for a state in which it holds. Where
//! all locations that matter have finitely many values, or are only compared with constants, the cases are gone through;
//! else the question is written as SMT-LIB and a [`Solver`], which the shell brings, is asked. An answer is a state, none,
//! or unknown with the reason.
//!
//! The meaning of terms is that of `machine`; tests hold the two to each other. It must not start a process.

mod answer;
mod cases;
mod decide;
pub mod encode;
mod expression;
mod question;
mod script;
pub mod session;
pub mod shared;
pub mod symbol;

pub use decide::{Decision, Solver};
pub use encode::Outside;
pub use question::{Question, question};
