//! Options of a verification: the engine, the extent of the search, how states are stored.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Bounds, EngineChoice, Interrupt, Limits};
use program::{Expression, FunctionId};

use crate::solver::method::Method;
use crate::storage::Storage;
use crate::storage::disk::Disk;

/// How states are explored.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EngineKind {
    /// One after another, then a solver if that has no end.
    #[default]
    Automatic,
    /// One after another.
    Explicit,
    /// As sets, by binary decision diagrams.
    Symbolic,
    /// Not at all: an SMT solver is asked.
    Solver(Method),
}

/// Options of a verification.
#[derive(Debug, Clone)]
pub struct Options {
    /// The machine's limits.
    pub limits: Limits,
    /// How states are explored.
    pub engine: EngineKind,
    /// The number of workers.
    pub workers: usize,
    /// End the search with the first level that contains a violation.
    pub first: bool,
    /// The largest number of states.
    pub max_states: u64,
    /// The largest number of steps from an initial state.
    pub max_depth: u64,
    /// The largest number of bytes for states.
    pub max_bytes: u64,
    /// When states take so many bytes, they are packed more tightly, if their locations have few values. By default 64 MiB.
    pub census: Option<u64>,
    /// One of several workers explores alone where a level leaves fewer states to the others. By default 64.
    pub alone: Option<u64>,
    /// The values to try for inputs, if not all of their domains. What would Hold is Unknown with such a bound.
    pub bounds: Bounds,
    /// Inputs that may also be undef. What Holds then holds for these, too.
    pub undefined: BTreeSet<FunctionId>,
    /// States in which this holds are no deadlocks.
    pub terminal: Option<Expression>,
    /// Make all steps by a machine, remembering none.
    pub forgetful: bool,
    /// What makes the steps that are not remembered; `Automatic` compiles them where remembering does not pay.
    pub steps: EngineChoice,
    /// How states are stored; unless they are stored in full, nothing Holds.
    pub storage: Storage,
    /// Selects the hash, if states are not stored in full.
    pub seed: u64,
    /// Partial-order reduction: if the main rule chooses who moves, make independent moves in one order only.
    pub partial_order: bool,
    /// Symmetry reduction: treat states as one if they differ only by a permutation of interchangeable elements. Needs
    /// explicit search; excludes `partial_order` and checkpoints.
    pub symmetry: bool,
    /// Stores states on the disk when memory is full, if they are stored in full. Needs explicit search.
    pub disk: Option<Arc<dyn Disk>>,
    /// Ends long work when raised from another thread; checked more often than the listener is asked.
    pub interrupt: Interrupt,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            limits: Limits::default(),
            engine: EngineKind::Automatic,
            workers: 1,
            first: false,
            max_states: u64::MAX,
            max_depth: u64::MAX,
            max_bytes: u64::MAX,
            census: None,
            alone: None,
            bounds: BTreeMap::new(),
            undefined: BTreeSet::new(),
            terminal: None,
            forgetful: false,
            steps: EngineChoice::Automatic,
            storage: Storage::Exact,
            seed: 0,
            partial_order: false,
            symmetry: false,
            disk: None,
            interrupt: Interrupt::default(),
        }
    }
}
