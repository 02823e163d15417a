//! What every engine has in common: what it is given, and in which form it tells what it found.
//!
//! An [`Engine`] goes through the states of a program in its own way, or proves something about them. INVARIANT: whichever it
//! is, nothing Holds by one that is violated by another; a shortest run may be another one. Which is taken is chosen in
//! [`crate::choose`].

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::Unbounded;
use program::Program;
use solve::session::Solvers;

use crate::again::made_again;
use crate::checkpoint::keeper::Keeper;
use crate::heed::Heed;
use crate::options::EngineKind;
use crate::partial_order::Unreduced;
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::report::NoStart;
use crate::solver::method::{Left, Proof, Solved};
use crate::symmetry::Symmetry;
use crate::target::Target;
use crate::trace::Trace;

/// What an engine is given.
pub(crate) struct Task<'t, 'k, 'h> {
    pub program: &'t Arc<Program>,
    pub plan: &'t Plan,
    /// For who asks solvers.
    pub solvers: &'t mut dyn Solvers,
    /// For who can be kept and resumed.
    pub keeper: Option<&'k mut dyn Keeper>,
    /// Who is told how far it is.
    pub heed: &'t mut Heed<'h>,
}

/// A way to find what is looked for, or to prove that it is nowhere.
pub(crate) trait Engine {
    /// Does what the task asks for, as far as it comes.
    ///
    /// # Errors
    /// It cannot begin.
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart>;
}

/// What an engine came to: the same form for all.
pub(crate) struct Ended {
    /// What was found, with a shortest run to it.
    pub found: BTreeMap<Target, Trace>,
    /// What was found with a run that the machine does not make.
    pub odd: BTreeSet<Target>,
    /// Why it ended early; none where all states were met.
    pub stop: Option<Stop>,
    /// Where less than the states was kept: how many are to be expected to have been left out.
    pub omission: Option<f64>,
    /// Why all steps were made, where fewer were wanted.
    pub unreduced: Option<Unreduced>,
    /// Which elements were interchangeable, where that was to be found out.
    pub symmetry: Option<Symmetry>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be gone through.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is not known in some state.
    pub unknown: BTreeSet<usize>,
    /// How many words a state has, and how many bits of them are used.
    pub width: (usize, usize),
    /// By rule, whether a machine ran it.
    pub executed: Vec<bool>,
    /// Which engine it was.
    pub engine: EngineKind,
    /// What a solver has proved not to be found.
    pub proved: BTreeMap<Target, Proof>,
    /// What a solver has left open.
    pub left: BTreeMap<Target, Left>,
    /// The solver that was asked.
    pub solver: Option<String>,
}

impl Ended {
    /// Nothing is known of states.
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
            engine,
            proved: BTreeMap::new(),
            left: BTreeMap::new(),
            solver: None,
        }
    }

    /// Keeps of what was found only what the machine comes to by the same runs.
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

    /// Adds what a solver has found and proved; what has been found before stays.
    pub fn take(&mut self, solved: Option<Solved>) {
        let Some(solved) = solved else { return };
        for (target, trace) in solved.found {
            self.found.entry(target).or_insert(trace);
        }
        self.proved = solved.proved;
        self.left = solved.left;
        self.solver = Some(solved.solver);
    }
}
