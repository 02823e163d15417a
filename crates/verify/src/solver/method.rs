//! How a solver is asked, and what it says of each thing that is looked for.

use std::collections::BTreeMap;

use solve::Outside;

use crate::target::Target;
use crate::trace::Trace;

/// How a solver is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Bounded model checking: runs only.
    Bounded,
    /// Bounded model checking and k-induction.
    Induction,
    /// Property-directed reachability; runs by bounded model checking.
    Reachability,
    /// k-induction for a while, then property-directed reachability.
    Portfolio,
}

/// How a property was proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// By induction over so many steps.
    Induction(usize),
    /// By a set of states that leaves out what is looked for.
    Reachability,
}

/// Why a solver left something open.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Left {
    /// So many steps were looked at.
    Depth(usize),
    /// The solver did not answer in time, or does not know; of runs of so many steps.
    Late(usize),
    /// Whoever waits has had enough.
    Stopped,
    /// The solver has failed: a clause.
    Broken(String),
    /// The machine may do what the solver was not told.
    Beyond(Outside),
    /// The solver told of a run that the machine does not make.
    Odd,
    /// Inputs without number would have to be gone through.
    Untold,
}

/// What came out.
#[derive(Debug, Default)]
pub(crate) struct Solved {
    pub found: BTreeMap<Target, Trace>,
    pub proved: BTreeMap<Target, Proof>,
    pub left: BTreeMap<Target, Left>,
    /// How many steps were looked at.
    pub depth: u64,
    /// The solver.
    pub solver: String,
}
