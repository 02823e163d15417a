//! Verification: every state of a model is explored, and each property Holds, is Violated or is Unknown.
//!
//! In: a program, and bounds of the search. Out: verdicts with traces. The meaning of a step is the machine's alone; this
//! crate decides which steps are made and what is kept of them. It must not know files, clocks or wire formats.

mod again;
mod assumed;
mod check;
mod checkpoint;
mod coverage;
mod engine;
pub mod graph;
mod heed;
mod lineage;
mod partial_order;
mod request;
pub mod review;
pub mod runs;
mod search;
mod shard;
pub mod solver;
mod storage;
pub mod survey;
mod symbolic;
mod symmetry;
mod table;
pub mod temporal;
mod trace;

pub use check::{Engine, Expected, NoStart, Options, Outcome, Reason, Report, Subject, Verdict};
pub use checkpoint::{Keeper, Refusal};
pub use heed::Listener;
pub use partial_order::Unreduced;
pub use request::{Conflict, NoSolvers, Part, Request, RequestBuilder, verify};
pub use search::{Progress, Stop};
pub use storage::Storage;
pub use storage::disk::{Disk, Tape};
pub use symmetry::{Distinct, Symmetry};
pub use trace::Trace;
