//! The interface of all engines: their input and the form of their findings.
//!
//! An [`Engine`] explores the states of a program in its own way, or proves something about them. INVARIANT: what Holds
//! by one engine is never violated by another; they may find different shortest runs. [`crate::choose`] selects the
//! engine.

use explore::checkpoint::Keeper;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::Unbounded;
use program::Program;
use solve::session::Solvers;

use crate::again::made_again;
use crate::heed::Heed;
use crate::options::EngineKind;
use crate::partial_order::Unreduced;
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::report::NoStart;
use crate::solver::method::{Lacking, Left, Proof, Solved};
use crate::symmetry::Symmetry;
use crate::target::Target;
use crate::trace::Trace;
use crate::walk::Walk;

/// The input of an engine.
pub(crate) struct Task<'t, 'k, 'h> {
    pub program: &'t Arc<Program>,
    pub plan: &'t Plan,
    /// For engines that ask solvers.
    pub solvers: &'t mut dyn Solvers,
    /// For engines whose search can be kept and resumed.
    pub keeper: Option<&'k mut dyn Keeper>,
    /// Receives progress and findings.
    pub heed: &'t mut Heed<'h>,
}

/// A method of finding targets, or of proving that they are unreachable.
pub(crate) trait Engine {
    /// Carries out the task as far as possible.
    ///
    /// # Errors
    /// It cannot begin.
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart>;
}

/// The result of an engine, in the same form for all.
pub(crate) struct Ended {
    /// The targets found, each with a shortest run to it.
    pub found: BTreeMap<Target, Trace>,
    /// Targets whose run the machine does not make.
    pub odd: BTreeSet<Target>,
    /// Why it ended early; `None` if all states were explored.
    pub stop: Option<Stop>,
    /// If states were not stored in full: the expected number of omitted states.
    pub omission: Option<f64>,
    /// Why partial-order reduction was not possible, if it was requested.
    pub unreduced: Option<Unreduced>,
    /// The interchangeable elements, if symmetry reduction was requested.
    pub symmetry: Option<Symmetry>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be enumerated.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is unknown in some state.
    pub unknown: BTreeSet<usize>,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// For each rule, whether a machine ran it.
    pub executed: Vec<bool>,
    /// The graph of the states, if the search has kept it.
    pub walk: Option<Walk>,
    /// The engine.
    pub engine: EngineKind,
    /// What the assumptions leave nothing of, as a solver found.
    pub none: Option<Lacking>,
    /// Targets that a solver proved unreachable.
    pub proved: BTreeMap<Target, Proof>,
    /// Targets that a solver left open.
    pub left: BTreeMap<Target, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

impl Ended {
    /// A result of an engine that explores no states.
    pub fn without_states(engine: EngineKind) -> Ended {
        Ended {
            found: BTreeMap::new(),
            odd: BTreeSet::new(),
            stop: None,
            omission: None,
            unreduced: None,
            symmetry: None,
            progress: Progress::default(),
            unbounded: BTreeSet::new(),
            unknown: BTreeSet::new(),
            width: (0, 0),
            executed: Vec::new(),
            walk: None,
            engine,
            none: None,
            proved: BTreeMap::new(),
            left: BTreeMap::new(),
            solver: None,
        }
    }

    /// Keeps only the findings that the machine confirms by making the same runs.
    pub fn judged(mut self, program: &Arc<Program>, plan: &Plan) -> Ended {
        let Ended { found, odd, .. } = &mut self;
        found.retain(|target, trace| {
            let made = made_again(program, &plan.settings, trace, Some(*target));
            if !made {
                odd.insert(*target);
            }
            made
        });
        self
    }

    /// Adds a solver's findings and proofs; earlier findings stay.
    pub fn take(&mut self, solved: Option<Solved>) {
        let Some(solved) = solved else { return };
        for (target, trace) in solved.found {
            self.found.entry(target).or_insert(trace);
        }
        self.proved = solved.proved;
        self.none = self.none.or(solved.none);
        self.left = solved.left;
        self.solver = Some(solved.solver);
    }
}
