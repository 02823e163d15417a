//! Everything that is written as JSON and read back: traces, states, faults, verdicts, the answers of single commands;
//! test results as JUnit XML.
//!
//! In: the types of the crates below. Out: types that `serde` writes, each an object with its `type`. Traces are also
//! read back. The formats have versions; docs/cli.md and spec/trace.md document them, and `schema/` has their JSON
//! Schema. The types of the crates below are not serialised themselves, so that they can change while the format stays.
//! It must not know files or who reads the output.

mod answer;
mod conformance;
mod coverage;
mod fault;
mod generation;
mod graph;
mod junit;
mod kept;
mod mutation;
mod proof_coverage;
mod refinement;
mod refinement_proof;
mod report;
mod review;
mod run;
mod scenario;
#[cfg(test)]
mod schema;
mod session;
mod times;
mod trace;
mod verification;

pub use crate::report::{Measured, ProgramReported, ReportMade};
pub use crate::scenario::{ScenarioResult, Told};
pub use answer::Answer;
pub use conformance::{Conformance, FollowedTold};
pub use coverage::Coverage;
pub use fault::{Fault, Place, WorldFailure};
pub use generation::{Generated, Goal};
pub use graph::{Graph, GraphState, GraphStep};
pub use junit::Junit;
pub use kept::Kept;
pub use mutation::{Became, KeptOutcome, Mutant, Mutation, ResultsHead};
pub use proof_coverage::ProofCoverage;
pub use refinement::Refinement;
pub use review::{Finding, MetaProperty};
pub use run::{RunFile, RunTold, Unseen};
pub use session::{Named, Related, SESSION_VERSION, SessionState, Waiting, Written, Wrong, written_state};
pub use times::{AgeOfData, MissedDeadlines, NewData, TaskTime, TimesTold};
pub use trace::{Ending, Head, Line, Pairs, Reader, State, Step, VERSION, Wire};
pub use verification::{Assumed, DomainLine, Explored, ExploredLine, RunChange, RunStep, Vacuity, Verdict};

/// The version of the objects that commands write. A change that would mislead a reader raises it: a key or a type is
/// removed or changes its meaning. New keys and types do not raise it.
pub const OUTPUT_VERSION: u32 = 1;
