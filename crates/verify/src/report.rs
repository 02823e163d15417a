//! What verification comes to: a verdict for each check, how far the search came, or why nothing could be checked.

use std::collections::BTreeMap;

use explore::{Trouble, Unbounded};
use machine::Fault;
use program::FunctionId;
use solve::Outside;
use syntax::Span;

use crate::checkpoint::keeper::Refusal;
use crate::options::EngineKind;
use crate::partial_order::Unreduced;
use crate::progress::{Progress, Stop};
use crate::question::Subject;
use crate::runs::outcome::Why;
use crate::solver::method::{Left, Proof};
use crate::storage::Storage;
use crate::symmetry::Symmetry;
use crate::trace::Trace;

/// Why it is not known whether a property holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The search ended before it had met all states.
    Stopped(Stop),
    /// Less than the states was kept, so some may be left out; [`Report::omission`] tells how likely that is.
    Compacted,
    /// Alternatives that cannot be gone through.
    Unbounded(Unbounded),
    /// An input was given only some of its values.
    Bounded(FunctionId),
    /// An assumption could not be evaluated in some state.
    Assumption(usize),
    /// It asks in some state for what cannot be gone through.
    Undecided,
    /// It speaks of runs; [`Report::runs`] tells why it is not known.
    Temporal,
    /// A solver left it open; [`Report::left`] tells why.
    Left,
    /// A run was found that the machine does not make: this program is at fault, not the model.
    Odd,
}

/// What a check comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// In every state that can be reached.
    Holds,
    /// Not at the end of this run, which is a shortest one.
    Violated(Box<Trace>),
    /// Not known; why, at least one reason.
    Unknown(Vec<Reason>),
}

/// A check and what it comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// What is checked.
    pub subject: Subject,
    /// What it comes to.
    pub outcome: Outcome,
}

/// What verification came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The verdicts, the checks that nobody asked for first, then properties in the order of the text.
    pub verdicts: Vec<Verdict>,
    /// What went through the states in the end.
    pub engine: EngineKind,
    /// How far the search came.
    pub progress: Progress,
    /// Why the search ended early, if it did.
    pub stop: Option<Stop>,
    /// Every state that can be reached was met.
    pub complete: bool,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// Rules that run in no step, though the rule around them or its caller does; only where every state was met.
    pub unreachable: Vec<Span>,
    /// By property: why it is not known whether a property of runs holds, where that is so.
    pub runs: BTreeMap<usize, Why>,
    /// What was kept of each state.
    pub storage: Storage,
    /// Where less than the states was kept: how many are to be expected to have been left out for being taken for others,
    /// which is no less than the probability that any was.
    pub omission: Option<Expected>,
    /// Where partial-order reduction was asked for: that states were reduced, or why not.
    pub reduced: Option<Result<(), Unreduced>>,
    /// Where interchangeable elements were to be found: which there are. States are counted up to their permutations.
    pub symmetry: Option<Symmetry>,
    /// How it was proved what a solver has proved.
    pub proofs: BTreeMap<Subject, Proof>,
    /// Why a solver left something open.
    pub left: BTreeMap<Subject, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

/// An expected number, which is no less than 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected(pub f64);

impl Eq for Expected {}

/// Why nothing could be checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoStart {
    /// An initial state cannot be made.
    Fault(Box<Fault>),
    /// The initial states cannot be gone through.
    Unbounded(Unbounded),
    /// Whoever waits has had enough before all initial states were made.
    Stopped(Stop),
    /// It has a part that solvers have no place for.
    Outside(Outside),
    /// There is no solver: why, as a clause.
    NoSolver(String),
    /// What was kept of a search is none to go on with.
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
