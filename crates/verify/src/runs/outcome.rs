//! What a property of runs comes to, and why that may not be known.

use machine::{Location, Value};
use syntax::Span;

use crate::progress::Stop;
use crate::trace::Trace;

/// What a property of runs comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OfRuns {
    /// On all fair runs of a complete graph.
    Holds,
    /// Not on this run.
    Violated(Box<Trace>),
    /// Not known.
    Unknown(Why),
}

/// Why it is not known whether a property of runs holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Why {
    /// States were left unexplored, by a limit or because alternatives cannot be gone through.
    Unexplored(Option<Stop>),
    /// A proposition of it is neither true nor false in some state: where it stands, and the values of that state.
    NoTruth(Span, Vec<(Location, Value)>),
    /// No run is fair.
    NoFairRun,
    /// The main rule does not choose who moves, so that no choice of it could be fair.
    NoScheduler,
    /// Deciding it took more than a limit allows.
    TooLarge(&'static str, u64),
    /// Whoever watches has had enough.
    Asked,
    /// The formula, or an assumption about runs, has a fault, or a value in it cannot be written down: what it is.
    Unread(String),
}
