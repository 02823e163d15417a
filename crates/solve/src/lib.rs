//! Encodes terms and rules of programs as formulas, and decides whether a condition can hold.
//!
//! [`encode`] translates the terms and rules of a program into [`shared`] terms, each stored once; a [`session`] with a
//! solver keeps what the solver was told. `verify` builds transition relations from these.
//!
//! In: a program and a condition about an arbitrary state ([`question()`]). Out: a [`Question`], first-order logic
//! without quantifiers over the locations that it reads; [`Question::decide`] searches for a state in which it holds.
//! If all relevant locations have finitely many values, or are only compared with constants, the cases are enumerated.
//! Otherwise the question is written as SMT-LIB and passed to a [`Solver`] that the shell provides. The answer is a
//! state, none, or unknown with the reason.
//!
//! The machine defines the meaning of terms; tests compare the two. It must not start a process.

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
