//! Verification: every state of a model is explored, and each property Holds, is Violated or is Unknown.
//!
//! In: a program, and bounds of the search. Out: verdicts with traces. The meaning of a step is the machine's alone; this
//! crate decides which steps are made and what is kept of them. It must not know files, clocks or wire formats.

pub mod graph;
pub mod temporal;
