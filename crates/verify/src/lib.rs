//! Verification: explores every state of a model; each property Holds, is Violated or is Unknown.
//!
//! In: a program, and bounds of the search. Out: verdicts with traces. The machine alone defines the meaning of a step;
//! this crate decides which steps are made and what is stored. It must not know files, clocks or wire formats.

mod again;
mod check;
mod checkpoint;
mod choose;
mod coverage;
pub mod dependence;
mod engine;
mod explicit;
mod explorers;
pub mod graph;
mod heed;
pub mod listing;
mod options;
mod partial_order;
mod plan;
mod progress;
mod question;
mod report;
mod request;
pub mod review;
pub mod runs;
mod slots;
pub mod solver;
mod storage;
pub mod survey;
mod symbolic;
mod symmetry;
mod table;
mod target;
pub mod temporal;
mod trace;
pub mod vacuity;
mod walk;

pub use check::unbegun;
pub use explore::checkpoint::{Keeper, Refusal};
pub use heed::Listener;
pub use options::{EngineKind, Options};
pub use partial_order::Unreduced;
pub use progress::{Progress, Stop};
pub use question::Subject;
pub use report::{Expected, NoStart, Outcome, Reason, Report, Verdict};
pub use request::{Conflict, NoSolvers, Part, Request, RequestBuilder, verify};
pub use storage::Storage;
pub use storage::disk::{Disk, Tape};
pub use symmetry::{Distinct, Symmetry};
pub use trace::Trace;
