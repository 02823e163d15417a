//! What is written as JSON, and read back: traces, states, faults, verdicts, the answers of single commands.
//!
//! In: the types of the crates below. Out: types that `serde` writes, each an object with its `type`; of traces also what they
//! were made of. Versioned; documented in docs/cli.md and spec/trace.md. The types of the crates below are not serialised
//! themselves, so that they can change while the format stays. It must not know files or who reads what is written.

mod answer;
mod conformance;
mod fault;
mod scenario;
mod trace;

pub use crate::scenario::ScenarioResult;
pub use answer::Answer;
pub use conformance::Conformance;
pub use fault::{Fault, Place, WorldFailure};
pub use trace::{Ending, Head, Line, Pairs, Reader, State, Step, VERSION, Wire};
