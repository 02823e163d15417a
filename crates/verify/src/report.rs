//! The result of a verification: a verdict for each check, the extent of the search, or why nothing could be checked.

use explore::checkpoint::Refusal;
use std::collections::BTreeMap;

use explore::{Trouble, Unbounded};
use machine::Fault;
use program::FunctionId;
use solve::Outside;
use syntax::Span;

use crate::options::EngineKind;
use crate::partial_order::Unreduced;
use crate::progress::{Progress, Stop};
use crate::question::Subject;
use crate::runs::outcome::Why;
use crate::solver::method::{Left, Proof};
use crate::storage::Storage;
use crate::symmetry::Symmetry;
use crate::trace::Trace;

/// Why it is unknown whether a property holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The search ended before it had explored all states.
    Stopped(Stop),
    /// States were not stored in full, so some may be omitted; [`Report::omission`] tells how likely that is.
    Compacted,
    /// Alternatives that cannot be enumerated.
    Unbounded(Unbounded),
    /// Only some values of an input were tried.
    Bounded(FunctionId),
    /// An assumption could not be evaluated in some state.
    Assumption(usize),
    /// No initial state satisfies the assumptions, so nothing was checked.
    Vacuous,
    /// No step satisfies the assumptions, so only the initial states were looked at.
    Stepless,
    /// States or steps were left out in which an invariant does not hold.
    Unlawful,
    /// In some state it depends on something that cannot be enumerated.
    Undecided,
    /// It is a property of runs; [`Report::runs`] tells why it is unknown.
    Temporal,
    /// A solver left it open; [`Report::left`] tells why.
    Left,
    /// The machine does not make the run that was found: this program is at fault, not the model.
    Odd,
}

/// The outcome of a check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It holds in every reachable state.
    Holds,
    /// It is violated at the end of this run, which is a shortest one.
    Violated(Box<Trace>),
    /// It is unknown, for at least one reason.
    Unknown(Vec<Reason>),
}

/// The verdict of a check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// The check.
    pub subject: Subject,
    /// Its outcome.
    pub outcome: Outcome,
}

/// The result of a verification.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The verdicts: built-in checks first, then properties in the order of the text.
    pub verdicts: Vec<Verdict>,
    /// The engine that produced the verdicts.
    pub engine: EngineKind,
    /// How far the search came.
    pub progress: Progress,
    /// Why the search ended early, if it did.
    pub stop: Option<Stop>,
    /// Whether every reachable state was explored.
    pub complete: bool,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// Rules that run in no step, although the enclosing rule or a caller does; known only if every state was explored.
    pub unreachable: Vec<Span>,
    /// For each property of runs that is unknown, why.
    pub runs: BTreeMap<usize, Why>,
    /// How states were stored.
    pub storage: Storage,
    /// If states were not stored in full: the expected number of states that were mistaken for others and omitted. It
    /// is an upper bound of the probability that any was.
    pub omission: Option<Expected>,
    /// If partial-order reduction was requested: whether it was possible, or why not.
    pub reduced: Option<Result<(), Unreduced>>,
    /// If symmetry reduction was requested: the interchangeable elements. States are then counted up to permutations.
    pub symmetry: Option<Symmetry>,
    /// How a solver proved what it proved.
    pub proofs: BTreeMap<Subject, Proof>,
    /// Why a solver left a check open.
    pub left: BTreeMap<Subject, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

/// An expected number, at least 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected(pub f64);

impl Eq for Expected {}

/// Why nothing could be checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoStart {
    /// An initial state cannot be made.
    Fault(Box<Fault>),
    /// The initial states cannot be enumerated.
    Unbounded(Unbounded),
    /// The caller asked to stop before all initial states were found.
    Stopped(Stop),
    /// A part of the model cannot be encoded for solvers.
    Outside(Outside),
    /// There is no solver; a clause says why.
    NoSolver(String),
    /// The search cannot continue from its checkpoint.
    Refused(Refusal),
}

impl From<Trouble> for NoStart {
    fn from(trouble: Trouble) -> NoStart {
        match trouble {
            Trouble::Fault(fault) => NoStart::Fault(fault),
            Trouble::Unbounded(unbounded) => NoStart::Unbounded(unbounded),
            Trouble::Interrupted(cause) => NoStart::Stopped(cause.into()),
            Trouble::TooNarrow(_) => unreachable!("the search widens its states"),
        }
    }
}
