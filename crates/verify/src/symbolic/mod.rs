//! Verification with sets of states: binary decision diagrams instead of single states.
//!
//! If a model's many states arise from independent parts (such as philosophers who do not know of each other), a set of
//! them is small even if it has 10¹¹ members. The verdicts are those of [`crate::verify`], on the same machine.

pub(crate) mod apart;
mod bdd;
mod large;
mod order;
mod reach;
