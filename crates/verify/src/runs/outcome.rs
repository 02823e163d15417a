//! The outcome of a property of runs, and why it may be unknown.

use machine::{Location, Value};
use syntax::Span;

use crate::progress::Stop;
use crate::trace::Trace;

/// The outcome of a property of runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OfRuns {
    /// It holds on all fair runs of a complete graph.
    Holds,
    /// This run violates it.
    Violated(Box<Trace>),
    /// It is unknown.
    Unknown(Why),
}

/// Why a property of runs is unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Why {
    /// States were left unexplored, because of a limit or because alternatives cannot be enumerated; or assumptions leave a state no step,
    /// and so no inputs, of which a formula or fairness speaks.
    Unexplored(Option<Stop>),
    /// A proposition has no truth value in some state: its place, and the values of that state.
    NoTruth(Span, Vec<(Location, Value)>),
    /// No run is fair.
    NoFairRun,
    /// The main rule does not choose who moves, so its choice cannot be assumed fair.
    NoScheduler,
    /// Deciding it exceeded a limit.
    TooLarge(&'static str, u64),
    /// The caller asked to stop.
    Asked,
    /// The formula, or an assumption about runs, has a fault or contains a value that cannot be written as a term; says
    /// what it is.
    Unread(String),
}
