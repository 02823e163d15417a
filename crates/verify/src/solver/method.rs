//! How a solver is used, and its results for each target.

use std::collections::BTreeMap;

use solve::Outside;

use crate::target::Target;
use crate::trace::Trace;

/// How a solver is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Bounded model checking: only finds runs.
    Bounded,
    /// Bounded model checking and k-induction.
    Induction,
    /// Property-directed reachability; bounded model checking finds the runs.
    Reachability,
    /// k-induction for a while, then property-directed reachability.
    Portfolio,
}

/// How a property was proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// By induction over this many steps.
    Induction(usize),
    /// By an invariant set of states that excludes the target.
    Reachability,
}

/// Why a solver left a target open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Left {
    /// The limit of steps was reached.
    Depth(usize),
    /// The same, of runs that compute with real numbers: those that round, as the machine does, were not looked for.
    Exact(usize),
    /// The solver did not answer in time, or does not know, about runs of this many steps.
    Late(usize),
    /// The caller asked to stop.
    Stopped,
    /// The solver failed; a clause.
    Broken(String),
    /// The machine may do what was not encoded.
    Beyond(Outside),
    /// The solver found a run that the machine does not make.
    Odd,
    /// The inputs of a state cannot be enumerated.
    Untold,
}

/// What there has to be for a proof to say something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lacking {
    /// No initial state satisfies the assumptions.
    Start,
    /// No step from one does.
    Step,
}

/// The result of a solver.
#[derive(Debug, Default)]
pub(crate) struct Solved {
    pub found: BTreeMap<Target, Trace>,
    pub proved: BTreeMap<Target, Proof>,
    pub left: BTreeMap<Target, Left>,
    /// What the assumptions leave nothing of.
    pub none: Option<Lacking>,
    /// The largest number of steps that was tried.
    pub depth: u64,
    /// The solver.
    pub solver: String,
}
