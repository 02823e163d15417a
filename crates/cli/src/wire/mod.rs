//! Wire types: what is written as JSON, and read back. Versioned; documented in docs/cli.md and spec/trace.md.

mod answer;
mod conformance;
mod fault;
mod scenario;
mod trace;

pub use answer::Answer;
pub use conformance::Conformance;
pub use fault::{Fault, Place, WorldFailure};
pub use scenario::ScenarioResult;
pub use trace::{Line, Reader, Wire};
