//! How a program is checked: which engine, how far, what is kept of states.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Bounds, EngineChoice, Interrupt, Limits};
use program::Expression;

use crate::solver::method::Method;
use crate::storage::Storage;
use crate::storage::disk::Disk;

/// How states are gone through.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EngineKind {
    /// One after the other, and a solver where that has no end.
    #[default]
    Automatic,
    /// One after the other.
    Explicit,
    /// As sets, by binary decision diagrams.
    Symbolic,
    /// Not at all: by an SMT solver.
    Solver(Method),
}

/// How a program is checked.
#[derive(Debug, Clone)]
pub struct Options {
    /// The machine's limits.
    pub limits: Limits,
    /// How states are gone through.
    pub engine: EngineKind,
    /// How many workers search.
    pub workers: usize,
    /// The search ends with the first level in which a check is violated.
    pub first: bool,
    /// The most states.
    pub max_states: u64,
    /// The most steps from an initial state.
    pub max_depth: u64,
    /// The most bytes for states.
    pub max_bytes: u64,
    /// The values that inputs are given, where they are not all those of their domains. What Holds under such a bound is
    /// Unknown without.
    pub bounds: Bounds,
    /// States in which this holds may rest.
    pub terminal: Option<Expression>,
    /// Steps are always made by a machine, never remembered.
    pub forgetful: bool,
    /// What makes the steps that are not remembered; `Automatic` compiles them where remembering does not pay.
    pub steps: EngineChoice,
    /// What is kept of each state; where that is not all of it, nothing Holds.
    pub storage: Storage,
    /// Draws the hash, where less than the state is kept.
    pub seed: u64,
    /// Where the main rule chooses who moves: of moves that do not concern each other one order is enough.
    pub partial_order: bool,
    /// States that differ by a permutation of elements that nothing tells apart are one. They are gone through one by one then;
    /// not with `partial_order`, nor where the search is kept.
    pub symmetry: bool,
    /// Where states go that memory has no room for, if all of each is kept. They are gone through one by one then.
    pub disk: Option<Arc<dyn Disk>>,
    /// Raised from another thread to end whatever takes long; looked at more often than the one who watches is asked.
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
            bounds: BTreeMap::new(),
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
